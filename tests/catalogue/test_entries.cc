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
                                   "rectangle",
                                   "tube",
                                   "ellipse",
                                   "box",
                                   "I",
                                   "C",
                                   "first order",
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
                                   "lifting line",
                                   "rigid body",
                                   "beam",
                                   "shell",
                                   "revolute",
                                   "prismatic",
                                   "screw",
                                   "cylindrical",
                                   "planar",
                                   "spherical",
                                   "universal",
                                   "rigid",
                                   "spring",
                                   "distance",
                                   "gear",
                                   "flexible joint",
                                   "rolling ball",
                                   "knife edge",
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
                                   "dynamic",
                                   "section",
                                   "subsystem",
                                   "study",
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
  const std::map<std::string, std::string> analysed = {{"Material", "analysed, see there"},
                                                       {"Layup", "analysed, see there"},
                                                       {"Degree", "analysed, see there"},
                                                       {"Elements", "analysed, see there"},
                                                       {"Elements per ply", "analysed, see there"},
                                                       {"Position", "analysed, see there"},
                                                       {"Rotation", "analysed, see there"},
                                                       {"Initial curvature", "analysed, see there"}};
  check("rectangle",
        models::beam(models::rectangle),
        "Sections/it",
        {{"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Density", "900"},
         {"Width 2", "0.06"},
         {"Width 3", "0.09"},
         {"Shear factor", "0.5"}},
        analysed);
  check("tube",
        models::beam(models::tube),
        "Sections/it",
        {{"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Density", "900"},
         {"Outer radius", "0.06"},
         {"Inner radius", "0.04"},
         {"Shear factor", "0.5"}},
        analysed);

  const std::string folder = ScratchFolder().path; // that of the runs
  files["table.csv"]       = "x,EA,GA2,GA3,GJ,EI2,EI3,mass,I2,I3\n0,1e4,1e4,1e4,30,20,20,2,.01,.01\n"
                             "1,1e4,1e4,1e4,30,20,20,2,.01,.01\n";
  check("table",
        models::beam(models::table),
        "Sections/it",
        {{"Stations", "other at 0, thick at 1"},
         {"File", folder + "/table.csv", {}, false, {"Sections/it/Stations = "}}});
}



TEST_F(Catalogued, MaterialsAndLayups)
{
  const std::string rectangle = "    set Type = rectangle\n    set Width 2 = 0.1\n    set Width 3 = 0.05\n",
                    metal     = models::analysed(rectangle + "    set Material = metal\n"),
                    ply       = models::analysed(rectangle + "    set Material = ply\n"),
                    lattice   = models::analysed(rectangle + "    set Material = lattice\n"),
                    skin = models::analysed("    set Type = rectangle\n    set Width 2 = 0.1\n    set Layup = skin\n");
  const Changes common   = {{"Density", "900"},
                            {"Tensile strength", "1e3"},
                            {"Compressive strength", "1e3"},
                            {"Shear strength", "1e3"}};
  check("isotropic",
        metal,
        "Materials/metal",
        joined(common, {{{"E", "2e6"}, {"Poisson ratio", "0.2"}, {"Yield stress", "1e3"}}}));
  check("orthotropic",
        ply,
        "Materials/ply",
        joined(common,
               {{{"E1", "3e6"},
                 {"E2", "1.1e6"},
                 {"E3", "1.1e6"},
                 {"G12", "4e5"},
                 {"G13", "4e5"},
                 {"G23", "4e5"},
                 {"nu12", "0.3"},
                 {"nu13", "0.3"},
                 {"nu23", "0.3"}}}));
  check(
    "anisotropic",
    lattice,
    "Materials/lattice",
    joined(common,
           {{{"Stiffness", "1e6, 2e6, 4e6, 4e5, 5e5, 7e5"},
             {"Compliance", "1e-6, 1e-6, 1e-6, 2e-6, 2e-6, 2e-6", {}, false, {"Materials/lattice/Stiffness = "}}}}));
  const std::vector<std::string> no_short = {
    "Layups/skin/Material = ", "Layups/skin/Angles = ", "Layups/skin/Ply thickness = 0"};
  check("layup",
        skin,
        "Layups/skin",
        {{"Material", "metal"},
         {"Angles", "0/40"},
         {"Ply thickness", "0.02"},
         {"Symmetric", "true"},
         {"Plies", "ply, 0, 0.01; metal, 0, 0.02", {}, false, no_short}});
}



TEST_F(Catalogued, AnalysedSections)
{
  const Changes                            common      = {{"Degree", "3"},
                                                          {"Elements", "8"},
                                                          {"Elements per ply", "2"},
                                                          {"Position", "0.01, 0.02"},
                                                          {"Rotation", "0.3"},
                                                          {"Initial curvature", "none"}};
  const std::map<std::string, std::string> closed_form = {{"E", "closed form, see there"},
                                                          {"Poisson ratio", "closed form, see there"},
                                                          {"Density", "closed form, see there"},
                                                          {"Shear factor", "closed form, see there"}};
  const Change                             material    = {"Material", "ply"};
  check("rectangle",
        models::analysed(
          "    set Type = rectangle\n    set Width 2 = 0.1\n    set Width 3 = 0.05\n    set Material = metal\n"),
        "Sections/it",
        joined(common, {{material, {"Width 2", "0.2"}, {"Width 3", "0.2"}, {"Layup", "skin", {}, true}}}),
        closed_form);
  check("tube",
        models::analysed(
          "    set Type = tube\n    set Outer radius = 0.1\n    set Inner radius = 0.05\n    set Material = metal\n"),
        "Sections/it",
        joined(common, {{material, {"Outer radius", "0.2"}, {"Inner radius", "0.02"}, {"Layup", "skin", {}, true}}}),
        closed_form);
  auto of_ellipse = common;
  of_ellipse.erase(of_ellipse.begin() + 2);
  check("ellipse",
        models::analysed(
          "    set Type = ellipse\n    set Radius 2 = 0.1\n    set Radius 3 = 0.05\n    set Material = metal\n"),
        "Sections/it",
        joined(of_ellipse, {{material, {"Radius 2", "0.2"}, {"Radius 3", "0.2"}}}),
        {{"Elements per ply", "there are no plies"}});
  check("box",
        models::analysed("    set Type = box\n    set Width 2 = 0.2\n    set Width 3 = 0.15\n    set Thickness = 0.02\n"
                         "    set Material = metal\n"),
        "Sections/it",
        joined(common,
               {{material,
                 {"Width 2", "0.3"},
                 {"Width 3", "0.3"},
                 {"Thickness", "0.03"},
                 {"Layup", "skin"},
                 {"Layup of bottom", "skin"},
                 {"Layup of right", "skin"},
                 {"Layup of top", "skin"},
                 {"Layup of left", "skin"}}}));
  check("I",
        models::analysed(
          "    set Type = I\n    set Height = 0.2\n    set Lower width = 0.1\n    set Lower thickness = 0.01\n"
          "    set Web thickness = 0.01\n    set Material = metal\n"),
        "Sections/it",
        joined(common,
               {{material,
                 {"Height", "0.3"},
                 {"Lower width", "0.2"},
                 {"Upper width", "0.2"},
                 {"Lower thickness", "0.02"},
                 {"Upper thickness", "0.02"},
                 {"Web thickness", "0.02"},
                 {"Lower layup", "skin"},
                 {"Upper layup", "skin"},
                 {"Web layup", "skin"}}}));
  check("C",
        models::analysed(
          "    set Type = C\n    set Height = 0.2\n    set Width = 0.1\n    set Flange thickness = 0.01\n"
          "    set Web thickness = 0.01\n    set Material = metal\n"),
        "Sections/it",
        joined(common,
               {{material,
                 {"Height", "0.3"},
                 {"Width", "0.2"},
                 {"Flange thickness", "0.02"},
                 {"Web thickness", "0.02"},
                 {"Lower layup", "skin"},
                 {"Upper layup", "skin"},
                 {"Web layup", "skin"}}}));
  check("section",
        models::analysed(
          "    set Type = ellipse\n    set Radius 2 = 0.1\n    set Radius 3 = 0.05\n    set Material = metal\n"),
        "Section",
        {{"Sections", "other"}, {"Stresses at", "beam at 0.3"}});
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



TEST_F(Catalogued, Shells)
{
  const std::string plate = models::shell(""), folder = ScratchFolder().path, no_patches = "Bodies/it/Patches = ";
  // two cells that are bent between them by less than the crease angle
  files["mesh.inp"] = "*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,.3\n4,0,1,0\n5,1,1,0\n6,2,1,.3\n*ELEMENT, TYPE=S4\n"
                      "1,1,2,5,4\n2,2,3,6,5\n";
  const auto joined = [](std::vector<std::string> a, const std::vector<std::string> &b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const std::vector<std::string> places = {"Loads/pull/At = it.at 0 0 0", "Output/Probes = it.at 0 0 0.position x"},
                                 grid   = {no_patches, "Bodies/it/Grid = hyper_cube", "Bodies/it/Grid arguments = 0 : 1 : true"};
  check("shell",
        plate,
        "Bodies/it",
        {{"Patches", "u, 0.5*v, 0; 1 + u*cos(0.5), 0.5*v, u*sin(0.4)"},
         {"Elements", "3, 1"},
         {"Merge", "false"},
         {"Grid", "hyper_cube", joined(places, {"Bodies/it/Grid arguments = 0 : 1 : true"}), false, {no_patches}},
         {"Grid arguments", "0 : 2 : true", joined(places, grid)},
         {"Refinements", "1", joined(places, grid)},
         {"Mesh file", folder + "/mesh.inp", places, false, {no_patches}},
         {"Curved", "false", joined(places, {no_patches, "Bodies/it/Mesh file = " + folder + "/mesh.inp"})},
         {"Degree", "3", {"Loads/pull/Force = 0, 0, 500"}},
         {"Crease angle", "0.6"},
         {"Axis 1", "1, 1, 0"},
         {"Layup", "single", {}, true}, // beside E
         {"E", "2e6"},
         {"Poisson ratio", "0.2"},
         {"Thickness", "0.06"},
         {"Density", "900"},
         {"Offset", "0.02"},
         {"Damping", "0.01"},
         {"Frames", "place at 0.5 1", {"Loads/pull/At = it.place"}},
         {"Rigid edges", "root at edge u0"},
         {"Rigid", "true", {"Output/Probes = it.at 0 0.position x"}},
         {"Velocity", "0.1, 0, 0"},
         {"Angular velocity", "0.3, 0.2, -0.6"}});
  check("support",
        models::shell("",
                      "subsection it\n set Type = support\n set Along = it.edge u0\n set Fixed = displacement 3\nend\n"),
        "Joints/it",
        {{"Along", "it.edge v0"},
         {"Fixed", "displacement 3, rotation 1"},
         {"Axis", "1, 0, 1"},
         {"Axis 1", "1, 1, 0", {"Joints/it/Fixed = displacement 1"}}});
  check("distributing",
        models::shell("",
                      "subsection it\n set Type = distributing\n set Along = it.edge u0\n set Body = other.at 0 0\nend\n"),
        "Joints/it",
        {{"Along", "it.edge v0"}, {"Body", "other.at 1 0"}});
  check("area load",
        models::shell("subsection it\n set Type = area load\n set Body = it\n set Force = 1, 2, 3\nend\n"),
        "Loads/it",
        {{"Body", "other"}, {"Force", "1, 2, 4"}, {"Moment", "1, 2, 3"}, {"Axes", "body"}});
  check("pressure",
        models::shell("subsection it\n set Type = pressure\n set Body = it\n set Pressure = 10\nend\n"),
        "Loads/it",
        {{"Body", "other"}, {"Pressure", "12"}});
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
        {{"Rate", "3*sin(t) - it"}, {"Initial", "0.7"}, {"Unit", "m"}, {"Scale", "1e6"}});
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
