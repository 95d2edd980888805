// Every entry of the catalogue must change what it says: it is set to another value, and something that is computed or
// written must differ. An entry that nobody has listed here fails; so does one that changes nothing.

#include <gtest/gtest.h>

#include <set>

#include "models.h"
#include "outcome.h"

using namespace samara;

namespace
{
  /** An entry, "rotation / Spring", another value for it, and what else is different in both runs. */
  struct Change
  {
    std::string              entry, value;
    std::vector<std::string> with       = {};
    bool                     is_refusal = false; ///< the other value is one that forbids something
    std::vector<std::string> also       = {};    ///< what must be different with the other value
  };
  using Changes = std::vector<Change>;

  /** Entries by kind, from the documentation that users read. */
  std::map<std::string, std::set<std::string>>
  documented_entries()
  {
    std::ostringstream text;
    print_reference(text);
    std::istringstream                           lines(text.str());
    std::map<std::string, std::set<std::string>> entries;
    std::string                                  kind;
    bool                                         in_table = false;
    for (std::string line; std::getline(lines, line);)
      {
        if (line.rfind("### ", 0) == 0)
          kind = line.substr(4);
        else if (line == "## The model")
          kind = "model";
        else if (line == "## Studies")
          kind = "study";
        else if (line.find("`subsection Methods`") != std::string::npos)
          kind = "method";
        in_table = line.rfind("| entry |", 0) == 0 || (in_table && line.rfind("|", 0) == 0);
        if (in_table && line.rfind("| entry |", 0) != 0 && line.rfind("|-", 0) != 0)
          entries[kind].insert(line.substr(2, line.find(" |", 2) - 2));
      }
    return entries;
  }



  /** What the entries of a free motion are worth trying with; the lengths of springs are 2 m. */
  Changes
  changes_of_motion(const std::string &motion, const std::string &object)
  {
    const bool        is_angle = motion.substr(0, 8) == "rotation", is_length = motion == "length";
    const std::string path = object + "/" + motion + "/", spring = path + "Spring = 7",
                      stiff = path + "Stop stiffness = 50",
                      upper = path + "Upper stop = " + (is_length ? "0.1" : "-0.1");
    Changes changes         = {{"Spring", "5", {path + "Rest = 0.3"}},
                               {"Rest", "0.4", {spring}},
                               {"Damper", "0.5"},
                               {"Lower stop", is_length ? "10" : "0.1", {stiff}},
                               {"Upper stop", is_length ? "0.1" : "-0.1", {stiff}},
                               {"Stop stiffness", "80", {upper, stiff}},
                               {"Stop damping", "3", {upper, stiff}},
                               {is_angle ? "Moment" : "Force", "2"},
                               {"Prescribed", is_length ? "2 + 0.3*t" : "0.3*t"}};
    for (auto &change : changes)
      change.entry = motion + " / " + change.entry;
    return changes;
  }

  Changes
  joined(Changes a, const std::vector<Changes> &others)
  {
    for (const auto &b : others)
      a.insert(a.end(), b.begin(), b.end());
    return a;
  }



  class Catalogued : public testing::Test
  {
  protected:
    /** Whether each change of an object's entries, but for those with a @p reason, makes a difference in @p model. */
    void
    check(const std::string                        &kind,
          const std::string                        &model,
          const std::string                        &object,
          const Changes                            &changes,
          const std::map<std::string, std::string> &reasons = {})
    {
      std::set<std::string> listed;
      for (const auto &reason : reasons)
        listed.insert(reason.first);
      for (const auto &change : changes)
        {
          listed.insert(change.entry);
          std::string path = (object.empty() ? "" : object + "/") + change.entry;
          path             = std::regex_replace(path, std::regex(" / "), "/");
          auto overrides   = change.with;
          overrides.push_back(path + " = " + change.value);
          overrides.insert(overrides.end(), change.also.begin(), change.also.end());
          const Outcome &before = outcome(model, change.with),
                        after(with_subsections(model, overrides), overrides, files);
          EXPECT_FALSE(before.refused) << kind << ", " << change.entry << ": " << before.text.substr(0, 500);
          EXPECT_EQ(after.refused, change.is_refusal)
            << kind << ", " << change.entry << ": " << after.text.substr(0, 500);
          EXPECT_NE(before.text, after.text)
            << kind << ": <" << change.entry << " = " << change.value << "> changes nothing";
        }
      EXPECT_EQ(listed, documented_entries()[kind])
        << kind << ": list every entry, with a value that makes a difference";
    }

    /** The same for a kind of joint, with @p motions that it leaves free. */
    void
    check_joint(const std::string              &kind,
                const std::string              &entries,
                const std::string              &probes,
                const Changes                  &changes,
                const std::vector<std::string> &motions = {})
    {
      std::vector<Changes> of_motions;
      for (const auto &motion : motions)
        of_motions.push_back(changes_of_motion(motion, "Joints/it"));
      check(kind, models::joint(kind, entries, probes), "Joints/it", joined(changes, of_motions));
    }

    std::map<std::string, std::string> files; ///< that models name

  private:
    std::map<std::string, Outcome> outcomes;

    /** Overrides find only subsections that are there: empty ones for the motions that they name. */
    static std::string
    with_subsections(std::string model, const std::vector<std::string> &overrides)
    {
      const std::regex      motion("Joints/it/([^/=]+)/.*");
      std::set<std::string> names;
      for (const auto &override : overrides)
        {
          std::smatch match;
          if (std::regex_match(override, match, motion))
            names.insert(match[1]);
        }
      const auto place = model.find('\n', model.find("  subsection it\n")) + 1;
      for (const auto &name : names)
        if (model.find("subsection " + name + "\n") == std::string::npos)
          model.insert(place, "    subsection " + name + "\n    end\n");
      return model;
    }

    const Outcome &
    outcome(const std::string &model, const std::vector<std::string> &overrides)
    {
      std::string key = model;
      for (const auto &override : overrides)
        key += override + "\n";
      const auto found = outcomes.find(key);
      if (found != outcomes.end())
        return found->second;
      return outcomes.emplace(key, Outcome(with_subsections(model, overrides), overrides, files)).first->second;
    }
  };

  const Changes     ends   = {{"Body A", "ground"}, {"Body B", "ground"}, {"Position", "0.5, 0.1, 0.3"}};
  const Changes     gap    = {{"Gap", "refused", {"Joints/it/Body B = b.other", "Joints/it/Gap = allowed"}, true}};
  const Changes     axis   = {{"Axis", "0.3, 1, 0.2"}};
  const Changes     axis_1 = {{"Axis 1", "0.3, 1, 0.2"}};
  const std::string tilted = "    set Axis = 1, 2, -1";
} // namespace



// If two equal runs differed, nothing here could be told.
TEST_F(Catalogued, EqualRunsAreEqual)
{
  for (const auto &model : {models::rigid_body, models::blade("set Type = gravity\n"), models::rotor})
    EXPECT_EQ(Outcome(model, {}).text, Outcome(model, {}).text);
}



// A kind that this file does not know would go unseen.
TEST_F(Catalogued, AllKinds)
{
  std::set<std::string> kinds;
  for (const auto &kind : documented_entries())
    kinds.insert(kind.first);
  EXPECT_EQ(kinds, (std::set<std::string>{"model",        "engineering constants",
                                          "matrices",     "table",
                                          "rectangle",    "tube",
                                          "rigid body",   "beam",
                                          "revolute",     "prismatic",
                                          "screw",        "cylindrical",
                                          "planar",       "spherical",
                                          "universal",    "rigid",
                                          "spring",       "distance",
                                          "gear",         "flexible joint",
                                          "rolling ball", "knife edge",
                                          "gravity",      "point load",
                                          "line load",    "steady rotation",
                                          "static",       "modal",
                                          "dynamic",      "study",
                                          "method"}));
}



TEST_F(Catalogued, LowerPairs)
{
  check_joint("revolute", tilted, "it.force 1", joined(ends, {gap, axis, axis_1}), {"rotation"});
  check_joint("prismatic", tilted, "it.force 1", joined(ends, {gap, axis, axis_1}), {"displacement"});
  check_joint("screw",
              tilted + "\n    set Pitch = 0.2",
              "it.force 1",
              joined(ends, {gap, axis, axis_1, {{"Pitch", "0.3"}}}),
              {"displacement", "rotation"});
  check_joint("cylindrical", tilted, "it.force 1", joined(ends, {gap, axis, axis_1}), {"displacement", "rotation"});
  check_joint("planar",
              tilted,
              "it.force 3, it.displacement 1",
              joined(ends, {gap, axis, axis_1}),
              {"displacement 1", "displacement 2", "rotation"});
  check_joint("spherical", "", "it.force 1", joined(ends, {gap, axis, axis_1}));
}



TEST_F(Catalogued, OtherJoints)
{
  const std::string second = "    set Axis = 1, 0, 0\n    set Second axis = 0, 1, 0";
  check_joint("universal",
              second,
              "it.force 1",
              joined(ends, {gap, {{"Axis", "1, 0, 0.5"}, {"Second axis", "0, 1, 0.4"}}}),
              {"rotation 1", "rotation 2"});
  check_joint("rigid",
              "    set Reaction = true",
              "it.moment 1",
              joined(ends, {gap, axis, axis_1, {{"Reaction", "false", {"Output/Probes = a.position x"}}}}));
  check_joint("spring", "", "it.length", ends, {"length"});
  check_joint("distance", "", "it.force", joined(ends, {{{"Length", "2.1", {}, true}}}));
  check_joint("flexible joint",
              tilted + "\n    set Stiffness = 10, 20, 30\n    set Rotational stiffness = 4, 5, 6",
              "it.force 1",
              joined(ends,
                     {gap,
                      axis,
                      {{"Axis 2", "0.3, 1, 0.2"},
                       {"Stiffness", "10, 25, 30"},
                       {"Rotational stiffness", "4, 5, 7"},
                       {"Damping", "1, 2, 3"},
                       {"Rotational damping", "0.1, 0.2, 0.3"},
                       {"Coupling", "1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0"}}}));
  check_joint("rolling ball",
              tilted + "\n    set Radius = 0.4",
              "it.force 1, it.displacement 1",
              joined({{"Body A", "ground"}, {"Body B", "ground"}},
                     {axis,
                      axis_1,
                      {{"Radius", "0.3"}, {"Position", "1.1 - 0.4/sqrt(6), 0.4 - 0.8/sqrt(6), 0.3 + 0.4/sqrt(6)"}}}));
  check_joint("knife edge", tilted, "it.force 1", joined(ends, {axis}));
  check("gear", models::gear, "Joints/it", {{"Joint A", "on c"}, {"Joint B", "on c.rotation"}, {"Ratio", "-1.5"}});
}



TEST_F(Catalogued, Sections)
{
  const Change radii = {"Drawn radii", "0.02, 0.03"};
  check("engineering constants",
        models::beam(models::engineering_constants),
        "Sections/it",
        {{"EA", "2e4"},
         {"GA2", "6e3"},
         {"GA3", "6e3"},
         {"GJ", "25"},
         {"EI2", "35"},
         {"EI3", "45"},
         {"EI23", "5"},
         {"Shear centre", "0.01, 0.02"},
         {"Tension centre", "0.01, 0.02"},
         {"Mass", "3"},
         {"Mass centre", "0.01, 0.02"},
         {"I2", "0.02"},
         {"I3", "0.01"},
         {"I23", "0.001"},
         radii});
  check("matrices",
        models::beam(models::matrices),
        "Sections/it",
        {{"Stiffness", "1e4, 5e3, 4e3, 20, 30, 50"},
         {"Compliance", "1e-4, 2e-4, 3e-4, 0.1, 0.02, 0.03", {}, false, {"Sections/it/Stiffness = "}},
         {"Inertia", "2, 2, 2, 0.03, 0.01, 0.03"},
         radii});
  check("rectangle",
        models::beam(models::rectangle),
        "Sections/it",
        {{"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Density", "900"},
         {"Width 2", "0.06"},
         {"Width 3", "0.09"},
         {"Shear factor", "0.5"}});
  check("tube",
        models::beam(models::tube),
        "Sections/it",
        {{"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Density", "900"},
         {"Outer radius", "0.06"},
         {"Inner radius", "0.04"},
         {"Shear factor", "0.5"}});

  const std::string folder = ScratchFolder().path; // that of the runs
  files["table.csv"]       = "x,EA,GA2,GA3,GJ,EI2,EI3,mass,I2,I3\n0,1e4,1e4,1e4,30,20,20,2,.01,.01\n"
                             "1,1e4,1e4,1e4,30,20,20,2,.01,.01\n";
  check("table",
        models::beam(models::table),
        "Sections/it",
        {{"Stations", "other at 0, thick at 1"},
         {"File", folder + "/table.csv", {}, false, {"Sections/it/Stations = "}}});
}



TEST_F(Catalogued, Bodies)
{
  check("rigid body",
        models::rigid_body,
        "Bodies/it",
        {{"Mass", "3"},
         {"Position", "0.3, -0.2, 0.2"},
         {"Rotation", "0.4, 0.2, -0.6"},
         {"Rotation sequence", "123"},
         {"Centre of mass", "0.1, 0.2, 0.3"},
         {"Inertia", "1, 1.6, 2"},
         {"Frames", "end at 1 0.4 0.3"},
         {"Velocity", "0.1, 0, 0"},
         {"Angular velocity", "0.3, 0.2, -0.6"},
         {"Shape", "box"},
         {"Size", "0.3"}});
  check("beam",
        models::beam(models::rectangle),
        "Bodies/beam",
        {{"Shape", "arc", {"Bodies/beam/Points = 0, 0, 0; 0.4, 0.1, 0.2; 1, 0, 0.2", "Bodies/beam/Elements = 4"}},
         {"Points", "0, 0, 0; 1, 0, 0.3"},
         {"Expressions", "s, 0, 0.3*s", {"Bodies/beam/Shape = expressions", "Bodies/beam/Expressions = s, 0, 0.2*s"}},
         {"Axis 2", "0, 1, 1"},
         {"Twist", "0.5*s"},
         {"Elements", "4"},
         {"Degree", "3"},
         {"Mesh", "2 to 0.5, 3 to 1"},
         {"Section", "other"},
         {"Frames", "place at 0.75"},
         {"Rigid", "true"},
         {"Damping", "0.01"},
         {"Damping ratio", "0.01", {"Bodies/beam/Damping frequency = 10"}, false},
         {"Damping frequency", "20", {"Bodies/beam/Damping ratio = 0.01", "Bodies/beam/Damping frequency = 10"}},
         {"Velocity", "0.1, 0, 0"},
         {"Angular velocity", "0.3, 0.2, -0.6"}});
}



TEST_F(Catalogued, Loads)
{
  check("gravity", models::blade("set Type = gravity\n"), "Loads/it", {{"Acceleration", "0, 1, -9"}});
  check("point load",
        models::blade("set Type = point load\n set At = blade.end\n set Force = 1, 2, 3\n"),
        "Loads/it",
        {{"At", "blade.middle"}, {"Force", "1, 2, 4"}, {"Moment", "1, 2, 3"}, {"Axes", "body"}});
  check("line load",
        models::blade("set Type = line load\n set Body = blade\n set Force = 1, 2, 3\n"),
        "Loads/it",
        {{"Body", "second"}, {"Force", "1, 2, 4"}, {"Moment", "1, 2, 3"}, {"Variation", "1 - s"}, {"Axes", "body"}});
  // the whole model turns, or the blade at its root; held there at an angle
  const std::string turning = "set Type = steady rotation\n set Speed = 10\n";
  check("steady rotation",
        models::blade(turning, true),
        "Loads/it",
        joined({{"Azimuth", "0.3", {"Loads/it/Joint = root"}}},
               {{{"Speed", "12", {"Loads/it/Joint = root"}},
                 {"Joint", "root"},
                 {"Axis", "0, 0.1, 1", {"Joints/root/Type = rigid"}},
                 {"Through", "0.3, 0, 0", {"Joints/root/Type = rigid"}}}}));
}



TEST_F(Catalogued, Statics)
{
  // a weight of 60 N goes beyond the limit point of the arch, 20 N does not
  const std::string arc = "Static/Path = arc length", heavy = "Bodies/top/Mass = 60";
  // springs hold an inverted pendulum up to 550 N: a bifurcation
  const std::vector<std::string> pendulum = {"Joints/slide/Type = revolute",
                                             "Joints/slide/Axis = 0, 1, 0",
                                             "Joints/slide/Position = 0, 0, 0",
                                             "Bodies/top/Mass = 600"};
  check("static",
        models::arch(20),
        "Static",
        {{"Load steps", "7"},
         {"Smallest step", "0.1", {heavy}},
         {"Stability limits", "pass", pendulum},
         {"Time", "2", {"Loads/weight/Acceleration = 0, 0, -1 + 0.1*t"}},
         {"Tolerance", "1e-3"},
         {"Iterations", "2"},
         {"Path", "arc length"},
         {"Largest arc", "0.02", {arc}},
         {"Weight of the load", "1", {arc}},
         {"End load factor", "0.5", {arc}},
         {"Passages", "2", {arc, heavy}},
         {"Largest load factor", "0.3", {arc}},
         {"Most steps", "2", {arc}}});
}



TEST_F(Catalogued, Modes)
{
  check("modal",
        models::rotor,
        "Modal",
        {{"Modes", "3"},
         {"Shift", "40", {"Modal/Modes = 2"}},
         {"Hold rotations", "true"},
         {"Axes", "fixed"},
         {"Animations", "1"}},
        {{"Unsteady motion", "only where parts do not turn steadily: tests/modes/test_rotors.cc"}});
}



TEST_F(Catalogued, Dynamics)
{
  const std::string adaptive = "Dynamic/Step control = adaptive", fast = "Dynamic/Step = 0.2";
  check("dynamic",
        models::oscillator,
        "Dynamic",
        {{"Start time", "0.1"},
         {"End time", "0.3"},
         {"Step", "0.02"},
         {"Step control", "adaptive"},
         {"Tolerance", "1e-8", {adaptive}},
         {"Tolerance holds for", "0.05", {adaptive, "Dynamic/Tolerance = 1e-8"}},
         {"Length", "1000", {adaptive, "Dynamic/Tolerance = 1e-8"}},
         {"Smallest step", "0.01", {"Dynamic/Iterations = 2", "Dynamic/Newton tolerance = 1e-15"}},
         {"Largest step", "0.011", {adaptive}},
         {"Integrator", "trapezoidal"},
         {"Stages", "2"},
         {"Spectral radius", "1"},
         {"Newton tolerance", "1e-3"},
         {"Iterations", "2"},
         {"Inconsistent velocities", "refuse", {"Bodies/b/Velocity = 1, 0, 0"}, true},
         {"Output every", "2"},
         {"Pictures", "2"},
         {"Second estimate", "true"}},
        {{"Checkpoint interval", "only what is on disk before the end depends on it: tests/output/test_resume.cc"},
         {"Energy balance", "only a run whose account misses depends on it: tests/input/energy_balance*.prm"}});
}



TEST_F(Catalogued, Model)
{
  check("model",
        models::oscillator,
        "",
        {{"Title", "Another"},
         {"Analyses", "static"},
         {"Output / Probes", "h.rotation, b.position x"},
         {"Output / Pictures", "false", {"Dynamic/Pictures = 1"}},
         {"Rotor speeds", "1, 2", {}, true}},
        {{"Linear solver", "numbers do not depend on it: tests/solvers/test_libraries.cc"},
         {"Threads", "numbers do not depend on it: tests/cosserat"},
         {"Redundant constraints", "no effect any more, which the run says"}});
}



TEST_F(Catalogued, Studies)
{
  const std::string load = "set Type = point load\n set At = blade.end\n set Force = 1, 2, 3\n";
  files["inner.prm"]     = models::blade(load);
  files["other.prm"]     = models::blade("set Type = point load\n set At = blade.end\n set Force = 1, 2, 4\n");
  const std::string study =
    "set Analyses = study\nset Model = inner.prm\nsubsection Study\n set Quantity = static: blade.end.displacement z\n"
    " set Vary = Bodies/blade/Elements\n set Values = 2\n set Reference = 0.1\nend\nsubsection Methods\n subsection it\n end\nend\n";
  check("study",
        study,
        "Study",
        {{"Quantity", "static: blade.end.displacement x"},
         {"Norm", "RMS"},
         {"Error", "absolute"},
         {"Reference", "0.2"},
         {"Reference overrides", "Bodies/blade/Elements = 4", {}, false, {"Study/Reference = finest"}},
         {"Overrides", "Loads/it/Force = 1, 2, 5"},
         {"Vary", "Bodies/blade/Degree"},
         {"Values", "3"},
         {"Tolerance", "0.1"},
         {"Cost", "unknowns", {"Study/Tolerance = 0.1"}},
         {"Time limit", "0.001"}});
  check("method",
        study,
        "Methods/it",
        {{"Overrides", "Loads/it/Force = 1, 2, 5"},
         {"Vary", "Bodies/blade/Degree"},
         {"Values", "3"},
         {"Model", "other.prm"}});
}
