// The entries of analyses, of the model itself and of studies; see test_entries.cc.

#include "catalogued.h"

using namespace samara;



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
         {"Load factor", "0.5*s"},
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
        {{"Unsteady motion", "only where parts do not turn steadily: tests/modes/test_rotors.cc"},
         {"Symmetry", "only of repeated parts: tests/modes/test_tracking.cc"}});
}



TEST_F(Catalogued, LinearSystem)
{
  const std::string highest = "Linear system/Highest frequency = 100", lowest = "Linear system/Lowest frequency = 1";
  check("linear system",
        models::pushed_rotor,
        "Linear system",
        {{"Inputs", "pull"},
         {"Lowest frequency", "2", {highest, lowest}},
         {"Highest frequency", "50", {highest, lowest}},
         {"Frequencies", "7", {highest, lowest}},
         {"Most states", "2"},
         {"Hold rotations", "true"}});
}



TEST_F(Catalogued, PeriodicLinearSystem)
{
  const std::string settle  = "Periodic linear system/Settle = 1",
                    highest = "Periodic linear system/Highest frequency = 100",
                    lowest  = "Periodic linear system/Lowest frequency = 1";
  check("periodic linear system",
        models::periodic_arms,
        "Periodic linear system",
        {{"Period", "0.8*pi"},
         {"Samples", "16"},
         {"Steps", "3"},
         {"Stages", "1"},
         {"Spectral radius", "0"},
         {"Newton tolerance", "1e-2"},
         {"Inputs", "pull"},
         {"Settle", "1", {"Periodic linear system/Corrections = 0"}},
         {"Corrections", "0", {settle}},
         {"Largest gap", "1e-16", {settle, "Periodic linear system/Corrections = 0"}},
         {"Lowest frequency", "2", {highest, lowest}},
         {"Highest frequency", "50", {highest, lowest}},
         {"Frequencies", "7", {highest, lowest}},
         {"Most states", "2"}},
        {{"Symmetry", "only the coordinates of matrices depend on it: tests/floquet/test_periodic_linear_system.cc"},
         {"Turning", "only what moves besides the parts has other axes: tests/floquet/test_periodic_linear_system.cc"},
         {"Iterations", "only where Newton's method finds no solution: tests/dynamics"}});
}



TEST_F(Catalogued, Floquet)
{
  const std::string no_joint = "Floquet/Turns of =", implicit = "Floquet/Method = implicit";
  check("floquet",
        models::turning_arms,
        "Floquet",
        {{"Period", "0.8*pi", {}, false, {no_joint}},
         {"Turns of", "spin"},
         {"Turns", "2"},
         {"Steps", "12"},
         {"Stages", "2"},
         {"Spectral radius", "0.5"},
         {"Newton tolerance", "1e-2"},
         {"Settle", "1"},
         {"Corrections", "0", {"Floquet/Settle = 1"}},
         {"Largest gap", "1e-16"},
         {"Method", "classical"},
         {"Wanted", "1", {implicit}},
         {"Highest frequency", "20", {implicit}},
         {"Symmetry", "", {}, false, {"Floquet/Turning ="}},
         {"Turning", "", {"Floquet/Settle = 2"}},
         {"Animations", "1"}},
        {{"Tolerance", "only how often Arnoldi's method restarts depends on it"},
         {"Iterations", "only where Newton's method finds no solution: tests/dynamics"}});
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



TEST_F(Catalogued, Trim)
{
  const std::string pilot = "Trim/Method = auto-pilot", loose = "Trim/Tolerance = 1e-3";
  check("trim",
        models::shaken,
        "Trim",
        {{"Controls", "swing from -5 N to 5 N, push"},
         {"Targets", "slide.displacement = 2 mm, cos 1 of slide.displacement = 1 mm"},
         {"Scales", "1 m, 1 m"},
         {"Period", "0.8 s"},
         {"Steps", "8"},
         {"Method", "discrete"},
         {"Start time", "0.1 s", {"Analyses = trim"}},
         {"Settle", "2"},
         {"Most turns", "4"},
         {"Tolerance", "1e-2"},
         {"Time constant", "1", {pilot, loose}},
         {"Most products", "1"},
         {"Stages", "1"},
         {"Spectral radius", "0"},
         {"Newton tolerance", "1e-3"}},
        {{"Iterations", "numbers of steps do not depend on it, as in Dynamic"},
         {"Continue", "only where a search fails: tests/trim/test_trim.cc"},
         {"Symmetry", "only of repeated parts: tests/trim/test_sections.cc"},
         {"Turning", "only with a <Symmetry>: tests/trim/test_sections.cc"}});
}



TEST_F(Catalogued, Harmonics)
{
  check("harmonics",
        models::turning_loads,
        "Harmonics",
        {{"Period", "0.8*pi"},
         {"Harmonics", "1"},
         {"Loads of", "spin"},
         {"Steps", "12"},
         {"Stages", "1"},
         {"Spectral radius", "0"},
         {"Newton tolerance", "1e-2"},
         {"Settle", "1"},
         {"Largest gap", "1e-16"}},
        {{"Iterations", "numbers of steps do not depend on it, as in Dynamic"}});
}



TEST_F(Catalogued, Lyapunov)
{
  check("lyapunov",
        std::regex_replace(models::oscillator, std::regex("dynamic"), "lyapunov") +
          "\nsubsection Lyapunov\n set Step = 0.01\n set Duration = 2\nend\n",
        "Lyapunov",
        {{"Exponents", "1"},
         {"Step", "0.02"},
         {"Steps between", "5"},
         {"Settle", "0.3"},
         {"Duration", "2.5"},
         {"Stages", "1"},
         {"Spectral radius", "0"},
         {"Newton tolerance", "1e-1"}},
        {{"Iterations", "numbers of steps do not depend on it, as in Dynamic"}});
}



TEST_F(Catalogued, Verification)
{
  // nothing is as exact as that
  check("verification",
        models::beam(models::rectangle),
        "Verification",
        {{"Tolerance", "1e-40", {"Analyses = verification"}}},
        {{"Studies", "run behind it: tests/contrib/test_program"}});
}



TEST_F(Catalogued, Model)
{
  // drawn 0.1 m off, it is moved where that is asked for
  const std::string apart = "Bodies/b/Frames = held at 0.1 0 0", held = "Joints/h/Body B = b.held",
                    closed = "Joints/h/Gap = closed";
  check("model",
        models::oscillator,
        "",
        {{"Assembly / Fixed bodies", "b", {apart, held, closed}, true},
         {"Assembly / Weights", "b: -1", {apart, held, closed}, true},
         {"Title", "Another"},
         {"Analyses", "static"},
         {"Output / Probes", "h.rotation, b.position x"},
         {"Output / Pictures", "false", {"Dynamic/Pictures = 1"}},
         {"Output / Report", "true"},
         {"Output / Report pictures", "1", {"Output/Report = true"}},
         {"Output / Report fields", "sizes", {"Output/Report = true"}},
         {"Rotor speeds", "1, 2", {}, true}},
        {{"Assembly / Gaps", "for joints between two points: tests/assembly"},
         {"Linear solver", "numbers do not depend on it: tests/solvers/test_libraries.cc"},
         {"Output / Watch", "written in between: tests/contrib/test_report"},
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



TEST_F(Catalogued, Subsystems)
{
  const std::string arm =
    "subsection Constants\n set length = 1 m\n end\nsubsection Bodies\n subsection arm\n set Type = rigid body\n"
    " set Mass = 1\n set Inertia = 1, 1, 1\n set Position = length, 0, 0\n end\nend\n"
    "subsection Output\n set Probes = arm.position x, arm.position y, arm.position z\nend\n";
  check("subsystem",
        "set Analyses = dynamic\nsubsection Subsystems\n subsection it\n set Rotation = 0.1, 0.2, 0.3\n" + arm +
          " end\nend\n" + models::two_steps,
        "Subsystems/it",
        {{"Position", "1, 2, 3"},
         {"Rotation", "0.3, 0.2, 0.1"},
         {"Rotation sequence", "123"},
         {"Copies", "3 about z"},
         {"Arguments", "length = 2 m"},
         {"Active", "false", {}, true},
         {"Part", "rotor/hub", {}, true}});
}



TEST_F(Catalogued, Quantities)
{
  check("expression",
        "set Analyses = dynamic\nsubsection Bodies\n subsection arm\n set Type = rigid body\n set Mass = 1\n"
        " set Inertia = 1, 1, 1\n set Position = 1, 2, 0\n end\nend\nsubsection Quantities\n subsection it\n"
        " set Value = 2*arm.position x\n set Unit = m\n end\nend\nsubsection Output\n set Probes = it\nend\n" +
          std::string(models::two_steps),
        "Quantities/it",
        {{"Value", "2*arm.position y"}, {"Unit", "mm"}});
}
