// Every entry of the catalogue must change what it says: it is set to another value, and something that is computed or
// written must differ. An entry that nobody has listed here or in test_analysis_entries.cc fails; so does one that
// changes nothing.

#include "../states/scenes.h"

#include "catalogued.h"

using namespace samara;

namespace
{
  const Changes     ends   = {{"Body A", "ground"}, {"Body B", "ground"}, {"Position", "0.5, 0.1, 0.3"}};
  const Changes     gap    = {{"Gap", "refused", {"Joints/it/Body B = b.other", "Joints/it/Gap = allowed"}, true}};
  const Changes     axis   = {{"Axis", "0.3, 1, 0.2"}};
  const Changes     on_b   = {{"Axis on B", "0.3, 1, 0.2", {}, true}}; // not parallel, and nothing turns it
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
  EXPECT_EQ(kinds,
            (std::set<std::string>{"model",
                                   "isotropic",
                                   "orthotropic",
                                   "anisotropic",
                                   "layup",
                                   "engineering constants",
                                   "matrices",
                                   "table",
                                   "file",
                                   "BeamDyn",
                                   "rectangle",
                                   "tube",
                                   "ellipse",
                                   "box",
                                   "I",
                                   "C",
                                   "mesh",
                                   "airfoil",
                                   "first order",
                                   "control",
                                   "PID",
                                   "transfer function",
                                   "state space",
                                   "delay",
                                   "analytic",
                                   "C81",
                                   "AeroDyn",
                                   "air",
                                   "prescribed inflow",
                                   "uniform inflow",
                                   "Pitt-Peters inflow",
                                   "Peters-He inflow",
                                   "annular inflow",
                                   "helical wake",
                                   "lifting line",
                                   "rigid body",
                                   "beam",
                                   "shell",
                                   "geodesic beam",
                                   "MITC4 shell",
                                   "revolute",
                                   "prismatic",
                                   "screw",
                                   "cylindrical",
                                   "planar",
                                   "spherical",
                                   "universal",
                                   "skew universal",
                                   "constant velocity",
                                   "in line",
                                   "in plane",
                                   "point on curve",
                                   "sliding point",
                                   "sliding sleeve",
                                   "sliding prismatic",
                                   "sliding screw",
                                   "springs in fixed axes",
                                   "rigid",
                                   "spring",
                                   "distance",
                                   "buffer",
                                   "gear",
                                   "flexible joint",
                                   "rolling ball",
                                   "rolling disc",
                                   "knife edge",
                                   "ball on plane",
                                   "ball on ball",
                                   "ball on cylinder",
                                   "ellipsoid on plane",
                                   "contacts",
                                   "support",
                                   "distributing",
                                   "gravity",
                                   "point load",
                                   "line load",
                                   "area load",
                                   "pressure",
                                   "steady rotation",
                                   "static",
                                   "modal",
                                   "linear system",
                                   "periodic linear system",
                                   "dynamic",
                                   "floquet",
                                   "harmonics",
                                   "lyapunov",
                                   "trim",
                                   "verification",
                                   "section",
                                   "expression",
                                   "subsystem",
                                   "study",
                                   "method"}));
}



// Prototypes give strains: their entries are read by what they are prototypes of.
TEST_F(Catalogued, Prototypes)
{
  EXPECT_EQ(documented_entries()["geodesic beam"], documented_entries()["beam"]);
  EXPECT_EQ(documented_entries()["MITC4 shell"], documented_entries()["shell"]);
}



namespace
{
  /** Moments press where something rubs. */
  Changes
  bearing_length(const std::string &motion)
  {
    const std::string        path = "Joints/it/" + motion + "/";
    std::vector<std::string> rubs = {path + "Friction = 0.3"};
    if (motion == "rotation")
      rubs.push_back(path + "Friction radius = 0.1");
    return {{"Bearing length", "0.3", rubs}};
  }

  /** What the entries of a friction against several motions at once, or of a thread, are worth trying with, in their
   * subsection. */
  Changes
  changes_of_vector_friction(const std::string &motion)
  {
    const std::string        path  = "Joints/it/" + motion + "/";
    std::vector<std::string> slips = {path + "Friction = 0.3", path + "Friction preload = 100"};
    Changes                  changes;
    if (motion == "rotation")
      {
        slips.push_back(path + "Friction radius = 0.1");
        changes.push_back({"Friction radius", "0.2", slips});
      }
    if (motion == "thread")
      {
        slips.push_back(path + "Radius = 0.1");
        changes = {{"Radius", "0.2", slips}, {"Flank angle", "0.5", slips}};
      }
    std::vector<std::string> sticks = slips, bends = slips;
    sticks.insert(sticks.end(), {path + "Static friction = 0.5", path + "Stribeck speed = 0.5"});
    bends.push_back(path + "Bristle stiffness = 200");
    const Changes all = {{"Friction", "0.4", slips},
                         {"Friction preload", "50", slips},
                         {"Static friction", "0.6", sticks},
                         {"Stribeck speed", "0.8", sticks},
                         {"Sticking speed", "0.01", slips},
                         {"Bristle stiffness", "300", slips},
                         {"Bristle damping", "20", bends}};
    changes.insert(changes.end(), all.begin(), all.end());
    for (auto &change : changes)
      change.entry = motion + " / " + change.entry;
    return changes;
  }
} // namespace



TEST_F(Catalogued, LowerPairs)
{
  check_joint("revolute",
              tilted,
              "it.force 1",
              joined(ends, {gap, axis, on_b, axis_1, bearing_length("rotation")}),
              {"rotation"});
  check_joint("prismatic",
              tilted,
              "it.force 1",
              joined(ends, {gap, axis, on_b, axis_1, bearing_length("displacement")}),
              {"displacement"});
  check_joint("screw",
              tilted + "\n    set Pitch = 0.2",
              "it.force 1",
              joined(ends, {gap, axis, on_b, axis_1, {{"Pitch", "0.3"}}, changes_of_vector_friction("thread")}),
              {"displacement", "rotation"});
  check_joint("cylindrical",
              tilted,
              "it.force 1",
              joined(ends, {gap, axis, on_b, axis_1, bearing_length("displacement")}),
              {"displacement", "rotation"});
  check_joint("planar",
              tilted,
              "it.force 3, it.displacement 1",
              joined(ends, {gap, axis, on_b, axis_1, changes_of_vector_friction("displacement")}),
              {"displacement 1", "displacement 2", "rotation"});
  check_joint("spherical", "", "it.force 1", joined(ends, {gap, axis, axis_1, changes_of_vector_friction("rotation")}));
}



TEST_F(Catalogued, OtherJoints)
{
  const std::string second = "    set Axis = 1, 0, 0\n    set Second axis = 0, 1, 0";
  check_joint("universal",
              second,
              "it.force 1",
              joined(ends, {gap, {{"Axis", "1, 0, 0.5"}, {"Second axis", "0, 1, 0.4"}}}),
              {"rotation 1", "rotation 2"});
  check_joint("skew universal",
              "    set Axis = 1, 0, 0\n    set Second axis = 1, 1, 0",
              "it.force 1",
              joined(ends, {gap, {{"Axis", "1, 0, 0.5"}, {"Second axis", "0, 1, 0.4"}}}),
              {"rotation 1", "rotation 2"});
  check_joint("constant velocity",
              tilted,
              "it.force 1",
              joined(ends, {gap, axis, axis_1, {{"Second axis", "1, 2, 0"}}, changes_of_vector_friction("rotation")}));
  check_joint("in line",
              tilted,
              "it.force 1",
              joined(ends, {gap, axis, axis_1, changes_of_vector_friction("rotation")}),
              {"displacement"});
  check_joint(
    "in plane",
    tilted,
    "it.force 3, it.displacement 1",
    joined(ends,
           {gap, axis, axis_1, changes_of_vector_friction("displacement"), changes_of_vector_friction("rotation")}),
    {"displacement 1", "displacement 2"});
  check_joint("springs in fixed axes",
              tilted + "\n    set Stiffness = 10, 20, 30",
              "it.force 1",
              joined({{"Body A", "ground"}, {"Body B", "ground"}},
                     {axis, {{"Axis 2", "0.3, 1, 0.2"}, {"Stiffness", "10, 25, 30"}, {"Damping", "1, 2, 3"}}}));
  check_joint(
    "point on curve",
    "    set Expressions = 1 + s, 0.4 + s^2, 0.2 + s\n    set Axis = 1, 2, -1",
    "it.force 1",
    joined({{"Body A", "ground"}, {"Body B", "ground", {}, true}, {"Expressions", "1 + s, 0.4 + s^2, 0.2 - s"}},
           {axis, axis_1, changes_of_vector_friction("displacement"), changes_of_vector_friction("rotation")}));
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
  check_joint("rolling disc",
              tilted + "\n    set Radius = 0.4\n    set Axle = 2, -1, 0.3",
              "it.force 1, it.tilt, it.displacement 1",
              joined({{"Body A", "ground"}, {"Body B", "ground"}},
                     {axis,
                      axis_1,
                      {{"Radius", "0.3"},
                       {"Axle", "2, -1, 1"},
                       {"Position",
                        "1 - 0.4*sqrt(1 - 0.09/30.54)/sqrt(6), 0.4 - 0.8*sqrt(1 - 0.09/30.54)/sqrt(6), "
                        "0.2 + 0.4*sqrt(1 - 0.09/30.54)/sqrt(6)"}}}));
  check_joint("knife edge", tilted, "it.force 1", joined(ends, {axis}));
  const std::vector<std::string> teeth   = {"Joints/it/Backlash = 0.001", "Joints/it/Mesh stiffness = 1000"};
  std::vector<std::string>       bounces = teeth;
  bounces.insert(bounces.end(), {"Joints/it/Mesh restitution = 0.5", "Joints/it/Mesh speed = 1"});
  const std::vector<std::string> rubs = {"Joints/it/Efficiency = 0.9", "Joints/it/Pitch radius = 0.1"};
  check("gear",
        models::gear,
        "Joints/it",
        {{"Joint A", "on c"},
         {"Joint B", "on c.rotation"},
         {"Ratio", "-1.5"},
         {"Backlash", "0.01", teeth},
         {"Mesh stiffness", "2000", teeth},
         {"Mesh damping", "3", teeth},
         {"Mesh exponent", "1.5", teeth},
         {"Mesh restitution", "0.8", bounces},
         {"Mesh speed", "2", bounces},
         {"Mesh force", "50*s", teeth, true},
         {"Efficiency", "0.8", rubs},
         {"Pitch radius", "0.2", rubs},
         {"Sticking speed", "0.01", rubs}});
}



TEST_F(Catalogued, GroupsOfContacts)
{
  Changes of_law = changes_of_contact("Joints/it"), changes;
  for (const Change &change : of_law)
    if (const std::string &e = change.entry; e != "Body A" && e != "Body B" && e != "Axis 1")
      changes.push_back(change);
  for (Change &change : changes)
    if (change.entry == "Damping") // not of beams
      {
        change.is_refusal = true;
        change.with       = {"Joints/it/Friction = 0.3"};
      }
  check("contacts",
        models::contacts,
        "Joints/it",
        joined(changes,
               {{{"Balls", "a, b radius 0.3"},
                 {"Ball radius", "0.25"},
                 {"Planes", "ground at 0 0 0.1 normal 0 0.1 1"},
                 {"Cylinders", "ground at 0 0 -0.9 axis 0 1 0 radius 1"},
                 {"Tubes", "ground at 0 0 0.7 axis 0 1 0 radius 0.8"},
                 {"Hollow balls", "ground at 0 0 0.7 radius 0.8"},
                 {"Beams", "rod radius 0.3"},
                 {"Rods", "ground from -0.2 -1 0.1 to -0.2 1 0.1 radius 0.2"},
                 {"Stations", "3"},
                 {"Laws", "a with ground stiffness 500"},
                 {"Line stiffness", "70"},
                 {"Touching", "surfaces"},
                 {"Overlap", "refused", {}, true}}}));
}



TEST_F(Catalogued, Contacts)
{
  const std::string entries = "\n    set Radius = 0.2\n    set Stiffness = 100\n    set Friction = 0";
  check_joint("ball on plane",
              "    set Axis = 1, 2, -1\n    set Position = 0.9, 0.3, 0.3" + entries,
              "it.gap, it.force",
              joined(changes_of_contact("Joints/it"),
                     {{{"Axis", "0.3, 1, 0.2"}, {"Position", "0.9, 0.31, 0.3"}, {"Radius", "0.25"}}}));
  const std::vector<std::string> turned = {"Joints/it/Axis on B = 0.2, 0.3, 1", "Joints/it/Axis 1 on B = 1, 0, 0.1"};
  check_joint(
    "ellipsoid on plane",
    "    set Axis = 1, 2, -1\n    set Position = 0.9, 0.3, 0.3\n    set Semi-axes = 0.15, 0.2, 0.1\n    set Rounding = 0.05"
    "\n    set Stiffness = 100\n    set Friction = 0",
    "it.gap, it.force",
    joined(changes_of_contact("Joints/it"),
           {{{"Axis", "0.3, 1, 0.2"},
             {"Position", "0.9, 0.31, 0.3"},
             {"Semi-axes", "0.15, 0.21, 0.1"},
             {"Rounding", "0.06"},
             {"Axis on B", "0, 1, 1", turned},
             {"Axis 1 on B", "0, 1, 0", turned}}}));
  const Changes other = {{"Position", "0.9, 0.31, 0.3"},
                         {"Radius", "0.25"},
                         {"Radius A", "0.12"},
                         {"Side", "inside", {}, true}};
  check_joint("ball on ball",
              "    set Position = 0.9, 0.3, 0.3\n    set Radius A = 0.1" + entries,
              "it.gap, it.force",
              joined(changes_of_contact("Joints/it"),
                     {other,
                      {{"Axis", "0.3, 1, 0.2", {"Joints/it/Friction = 0.3", "Output/Probes = it.friction 3"}}}}));
  check_joint("ball on cylinder",
              "    set Position = 0.9, 0.3, 0.3\n    set Radius A = 0.1" + entries,
              "it.gap, it.force",
              joined(changes_of_contact("Joints/it"), {other, axis}));
}



TEST_F(Catalogued, SlidingJoints)
{
  const Changes ends     = {{"Body A", "other"},
                            {"Body B", "ground"},
                            {"Position", "0, 0, 0"},
                            {"Gap", "refused", {"Joints/it/Body B = b.arm", "Joints/it/Gap = allowed"}, true},
                            {"At the ends", "stop", {}, true}},
                of_screw = joined({{"Turn per length", "3"}}, {changes_of_vector_friction("thread")}),
                of_bore  = {{"displacement / Friction radius",
                             "0.2",
                             {"Joints/it/displacement/Friction = 0.3",
                              "Joints/it/displacement/Friction preload = 100",
                              "Joints/it/displacement/Friction radius = 0.1"}}};
  for (const std::string kind : {"sliding point", "sliding sleeve", "sliding prismatic", "sliding screw"})
    check(kind,
          models::sliding(kind, kind == "sliding screw" ? "    set Turn per length = 2" : ""),
          "Joints/it",
          joined(ends,
                 {changes_of_motion("displacement", "Joints/it", true),
                  kind == "sliding screw"  ? of_screw :
                  kind == "sliding sleeve" ? of_bore :
                  kind == "sliding point"  ? changes_of_vector_friction("rotation") :
                                             Changes{},
                  kind == "sliding point" ? Changes{} : bearing_length("displacement")}));
}



TEST_F(Catalogued, Buffers)
{
  Changes changes = {{"Joint A", "at d"}, {"Joint B", "at d"}, {"Length", "0.4"}};
  for (const Change &change : changes_of_contact("Joints/it"))
    for (const std::string entry : {"Stiffness", "Damping", "Exponent", "Restitution", "Impact speed", "Force"})
      if (change.entry == entry)
        changes.push_back(change);
  check("buffer", models::buffer, "Joints/it", changes);
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
         {"Angular velocity", "0.3, 0.2, -0.6"},
         {"Velocity field", "0, 0, s"},
         {"Angular velocity field", "s, 0, 0"},
         {"Displacement field", "0, 0, 0.01*s"},
         {"Rotation field", "0.01*s, 0, 0"}});
}



TEST_F(Catalogued, States)
{
  const std::string model =
    "set Analyses = dynamic\n" +
    on_a_slide("subsection it\n set Rate = 3*sin(t) - 30*it^3 + 0.01*slide.displacement rate\n"
               " set Initial = 1\n end\n",
               "set Force = -2*it") +
    "subsection Dynamic\n set End time = 0.5\n set Step = 0.05\n set Newton tolerance = 1e-4\nend\n"
    "subsection Output\n set Probes = it, slide.displacement\nend\n";
  check("first order",
        model,
        "States/it",
        {{"Rate", "3*sin(t) - it"},
         {"Initial", "0.7"},
         {"Unit", "m"},
         {"Scale", "1e6"},
         {"Weight", "1", {"Dynamic/Step control = adaptive"}}});
}



TEST_F(Catalogued, Controls)
{
  const std::string model =
    "set Analyses = dynamic\n" +
    on_a_slide(
      "subsection it\n set Type = control\n set Value = 0.3\n end\n subsection other\n set Rate = -slide.displacement\n"
      " end\n",
      "set Force = -2*it") +
    "subsection Dynamic\n set End time = 0.5\n set Step = 0.05\n set Newton tolerance = 1e-4\nend\n"
    "subsection Output\n set Probes = it, slide.displacement\nend\n";
  check(
    "control", model, "States/it", {{"Value", "0.7"}, {"Unit", "m"}}, {{"Scale", "only trim looks at it: tests/trim"}});
}



TEST_F(Catalogued, Controllers)
{
  const auto model = [](const std::string &entries) {
    return "set Analyses = dynamic\n" +
           on_a_slide("subsection it\n" + entries + " end\n", "set Spring = 30\n set Force = -2*it") +
           "subsection Dynamic\n set End time = 0.5\n set Step = 0.05\n set Newton tolerance = 1e-4\nend\n"
           "subsection Output\n set Probes = it, slide.displacement\nend\n";
  };
  // in two iterations they are there, whatever counts for convergence
  const std::map<std::string, std::string> linear = {{"Scale", "states that are linear converge at once"}};
  const std::string                        signal = " set Signal = slide.displacement + slide.displacement^3\n",
                    limit                         = "States/it/Upper limit = 0";
  check("PID",
        model(" set Type = PID\n" + signal +
              " set Proportional gain = 3\n set Integral gain = 4\n set Derivative gain = 1\n set Filter time = 0.1\n"),
        "States/it",
        {{"Signal", "0.5*slide.displacement"},
         {"Signal unit", "m", {}, false, {"States/it/Proportional gain = 4/(1 m)"}},
         {"Target", "0.2"},
         {"Signal rate", "slide.displacement rate"},
         {"Unit", "N"},
         {"Proportional gain", "4"},
         {"Integral gain", "5"},
         {"Derivative gain", "2"},
         {"Filter time", "0.2"},
         {"Lower limit", "0.01"},
         {"Upper limit", "-0.01"},
         {"Tracking time", "0.3", {limit}},
         {"Initial", "0.5"}},
        linear);
  const std::string input = " set Input = slide.displacement + slide.displacement^3\n";
  check("transfer function",
        model(" set Type = transfer function\n set Numerator = 2, 3\n set Denominator = 1, 4\n" + input),
        "States/it",
        {{"Input", "sin(t)"}, {"Numerator", "3"}, {"Denominator", "1, 2, 5"}, {"Unit", "m"}},
        linear);
  check("state space",
        model(" set Type = state space\n set A = -1, 2; -3, -0.5\n set B = 1; 2\n set C = 1, 1\n"
              " set Inputs = slide.displacement + slide.displacement^3\n"),
        "States/it",
        {{"Inputs", "sin(t)"},
         {"A", "-1, 2; -3, -1"},
         {"B", "1; 3"},
         {"C", "1, 2"},
         {"D", "0.5"},
         {"Unit", "m"},
         {"Initial", "0.1, 0"}},
        linear);
  check("delay",
        model(" set Type = delay\n set Time = 0.2\n" + input),
        "States/it",
        {{"Input", "sin(t)"}, {"Time", "0.1"}, {"Order", "2"}, {"Unit", "m"}, {"Initial", "0.1"}},
        linear);
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
        {{"Body", "second"},
         {"Edge",
          "edge u1",
          {"Loads/it/Body = plate", "Loads/it/Edge = edge v0", "Output/Probes = plate.at 1 1.displacement z"}},
         {"Force", "1, 2, 4"},
         {"Moment", "1, 2, 3"},
         {"Variation", "1 - s"},
         {"Axes", "body"}});
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
