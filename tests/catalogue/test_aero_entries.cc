// The entries of airfoils, air, inflow and surfaces: see test_entries.cc.

#include "catalogued.h"

using namespace samara;

namespace
{
  /** A blade and a body that fly; @p airfoil, @p flow and @p surface are what is looked at, called it. */
  std::string
  flyer(const std::string &airfoil, const std::string &air, const std::string &flow, const std::string &surface)
  {
    const auto named = [](const std::string &name, const std::string &entries) {
      return "  subsection " + name + "\n" + entries + "  end\n";
    };
    return R"(
set Analyses = dynamic
subsection Sections
  subsection tube
    set Type         = tube
    set E            = 1e8
    set Density      = 1000
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection blade
    set Type     = beam
    set Points   = 0, 0, 0; 2, 0, 0.1
    set Section  = tube
    set Elements = 2
    set Degree   = 2
    set Velocity = 1, 10, 3
  end
  subsection body
    set Type     = rigid body
    set Mass     = 2
    set Inertia  = 1, 1, 1
    set Velocity = 1, 2, 3
    set Frames   = other at 0.3 0.1 0.2
    set Rotation = 0.2, 0.3, 0.1
    set Angular velocity = 0.3, 0.2, 0.5
  end
end
subsection Airfoils
)" + named("it", airfoil) +
           named("second", "    set Type = analytic\n    set Drag = 0.02\n") + "end\nsubsection Aerodynamics\n" +
           named("air", air) + named("still", "    set Type = air\n") + named("flow", flow) +
           named("nothing",
                 "    set Type = prescribed inflow\n    set Hub = body\n    set Radius = 3\n    set Air = air\n"
                 "    set Velocity = 1.5, 0, 0\n") +
           "end\nsubsection Surfaces\n" +
           named("it",
                 "    set Body = blade\n    set Air = air\n    set Chord = 0.3 - 0.01*s\n    set Airfoils = it\n" +
                   surface) +
           named(
             "other",
             "    set Body = blade\n    set Air = air\n    set Chord = 0.3\n    set Airfoils = second\n    set Inflow = flow\n") +
           R"(end
subsection Dynamic
  set End time = 0.02
  set Step     = 0.01
  set Stages   = 1
  set Pictures = 1
end
subsection Output
  set Probes = it.force y, it.force z, it.moment x, other.force z, flow.mean, blade.end.position z
end
)";
  }

  const std::string analytic = "    set Type = analytic\n    set Lift slope = 5.5\n    set Moment = 0.02, 0.1\n",
                    air      = "    set Type = air\n    set Wind = 1, -30, 4\n    set Ground = -3\n",
                    flow     = "    set Hub = body\n    set Radius = 2.5\n    set Air = air\n",
                    uniform  = "    set Type = uniform inflow\n" + flow;

  const std::string with_loss = "Aerodynamics/flow/Tip loss = Prandtl";
  const Changes     of_tips   = {{"Tip loss", "Prandtl"}, {"Root", "0.1", {with_loss}}, {"Blades", "3", {with_loss}}};

  const std::string factor = "Aerodynamics/flow/Interference factors = 0.5",
                    other  = "Aerodynamics/flow/Interference = nothing";
  const Changes of_others  = {{"Interference", "nothing", {}, false, {factor}},
                              {"Interference factors", "0.5", {}, false, {other}}};

  const Changes of_hub = {{"Hub", "body.other"},
                          {"Axis", "0.1, 0.3, 1"},
                          {"Direction", "0, 1, 0"},
                          {"Radius", "2.7"},
                          {"Air", "still"}};

  std::string
  changed(std::string text, const std::string &what, const std::string &by)
  {
    return text.replace(text.find(what), what.size(), by);
  }
} // namespace



TEST_F(Catalogued, Airfoils)
{
  check("analytic",
        flyer(analytic, air, uniform, ""),
        "Airfoils/it",
        {{"Form", "linear"},
         {"Lift slope", "6"},
         {"Zero-lift angle", "-3 deg"},
         {"Drag", "0.02, 0, 0.3"},
         {"Moment", "0.03"},
         {"Compressible", "true"},
         {"Stall angle", "10 deg"},
         {"Stall width", "1 deg", {"Airfoils/it/Stall angle = 5 deg"}}});
  const std::string folder = ScratchFolder().path; // that of the runs
  files["one.c81"] =
    "# FREE FORMAT\none; 1 3 1 3 1 3\n0\n-180 0\n0 1\n180 0\n0\n-180 0\n0 0.1\n180 0\n0\n-180 0\n0 0.1\n180 0\n";
  files["two.c81"]   = changed(changed(files["one.c81"], "-180 0", "-179 0"), "0 1\n", "0 0.9\n");
  files["one.dat"]   = "2 NumTabs\n3 NumAlf\n-180 0 0\n0 1 0.1\n180 0 0\n3 NumAlf\n-180 0 0\n0 2 0.1\n180 0 0\n";
  files["two.dat"]   = changed(files["one.dat"], "0 1 0.1", "0 1 0.2");
  files["short.dat"] = changed(files["one.dat"], "-180 0 0", "-170 0 0");
  check("C81",
        flyer("    set Type = C81\n    set File = one.c81\n", air, uniform, ""),
        "Airfoils/it",
        {{"File", folder + "/two.c81", {}, false, {"Airfoils/it/Beyond = constant"}},
         {"Beyond", "refuse", {"Airfoils/it/File = " + folder + "/two.c81", "Airfoils/it/Beyond = constant"}, true}});
  check("AeroDyn",
        flyer("    set Type = AeroDyn\n    set File = one.dat\n", air, uniform, ""),
        "Airfoils/it",
        {{"File", folder + "/two.dat"},
         {"Table", "2"},
         {"Beyond", "refuse", {"Airfoils/it/File = " + folder + "/short.dat", "Airfoils/it/Beyond = constant"}, true}});
}



TEST_F(Catalogued, AirAndInflow)
{
  check("air",
        flyer(analytic, air, uniform, ""),
        "Aerodynamics/air",
        {{"Density", "1"},
         {"Speed of sound", "300", {"Airfoils/it/Compressible = true"}},
         {"Wind", "1, -31, 4"},
         {"Gust", "0, 0, 2*sin(x - 20*t)"},
         {"Shear exponent", "0.2"},
         {"Shear height", "5", {"Aerodynamics/air/Shear exponent = 0.2"}},
         {"Ground", "-4", {"Aerodynamics/air/Shear exponent = 0.2"}}});
  Changes of_flow;
  for (const auto &change : of_hub)
    if (change.entry != "Air")
      of_flow.push_back(change);
  check("prescribed inflow",
        flyer(analytic, air, "    set Type = prescribed inflow\n    set Velocity = 2, 1, 0.5\n" + flow, ""),
        "Aerodynamics/flow",
        joined(of_flow, {of_tips, of_others, {{"Velocity", "2, 1, 0.4"}}}),
        {{"Air", "the flow is given"}});
  const Changes of_momentum = joined(of_tips, {of_others, {{"Initial", "2"}, {"Ground effect", "Cheeseman-Bennett"}}});
  Changes       without_direction;
  const std::string no_azimuth = "a uniform flow has no azimuth";
  for (const auto &change : of_hub)
    if (change.entry != "Direction")
      without_direction.push_back(change);
  check("uniform inflow",
        flyer(analytic, air, uniform, ""),
        "Aerodynamics/flow",
        joined(without_direction, {of_momentum, {{"Apparent mass", "0.5"}}}),
        {{"Direction", no_azimuth}});
  check("Pitt-Peters inflow",
        flyer(analytic, air, changed(uniform, "uniform", "Pitt-Peters"), ""),
        "Aerodynamics/flow",
        joined(of_hub, {of_momentum, {{"Apparent mass", "0.5"}}}));
  check("Peters-He inflow",
        flyer(analytic, air, changed(uniform, "uniform", "Peters-He"), ""),
        "Aerodynamics/flow",
        joined(of_hub, {of_momentum, {{"Harmonics", "3"}, {"Power", "7"}, {"Mass flow", "first state"}}}));
  Changes of_annuli; // neither azimuth nor another air
  for (const auto &change : of_flow)
    if (change.entry != "Direction")
      of_annuli.push_back(change);
  check(
    "helical wake",
    flyer(
      analytic,
      air,
      "    set Type = helical wake\n    set Speed = 20\n    set Transport = 5\n    set Nodes = 3\n    set Turns = 1\n    set Segments = 8\n" +
        flow,
      ""),
    "Aerodynamics/flow",
    joined(of_annuli,
           {{{"Speed", "25"},
             {"Transport", "4"},
             {"Root", "0.1"},
             {"Blades", "3"},
             {"Nodes", "2"},
             {"Core", "0.2"},
             {"Turns", "2"},
             {"Segments", "12"},
             {"Time constant", "0.2"}}}),
    {{"Direction", "a wake has no azimuth of its own"}, {"Air", "the wind is that of the surfaces"}});
  check("annular inflow",
        flyer(analytic, air, changed(uniform, "uniform", "annular"), ""),
        "Aerodynamics/flow",
        joined(of_annuli,
               {{{"Initial", "2"},
                 {"Blades", "3"},
                 {"Tip loss", "none"},
                 {"Root", "0.1"},
                 {"Swirl", "false"},
                 {"Skew", "none"},
                 {"Apparent mass", "1"},
                 {"Ground effect", "Cheeseman-Bennett", {}, true}}}),
        {{"Direction", "annuli have no azimuth"},
         {"Air", "the wind is that of the surfaces, the densities are the same"}});
}



TEST_F(Catalogued, Surfaces)
{
  const std::string on_body = "Surfaces/it/Body = body", line = "Surfaces/it/Line = 0.1, 0, 0; 2, 0, 0.3";
  check("lifting line",
        flyer(analytic, air, uniform, ""),
        "Surfaces/it",
        {{"Body", "body", {}, false, {line}},
         {"Line", "0.1, 0, 0; 2, 0, 0.4", {on_body, line}},
         {"Range", "0.2, 1.5"},
         {"Breaks", "0.7"},
         {"Stations", "9"},
         {"Chord", "0.31"},
         {"Quarter chord", "0.1"},
         {"Twist", "0.1"},
         {"Leading edge", "0, 1, 0.1"},
         {"Upper side", "0, 0, -1"},
         {"Airfoils", "second"},
         {"Unsteady", "quasi-steady"},
         {"Compressible lags", "true"},
         {"Separation lags", "2, 8", {"Surfaces/it/Unsteady = dynamic stall"}},
         {"Virtual mass", "true"},
         {"Lift factor", "0.9"},
         {"Inflow", "flow"},
         {"Air", "still"}});
}
