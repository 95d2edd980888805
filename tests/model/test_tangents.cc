// The tangent of every kind of the catalogue against a complex step through its residual.
//
// Strains are quadratic and the constitutive law is linear, so the complex step is exact to round-off: the tangent with
// δσ = C B ζ must be the derivative of the residual with σ = C e(q) in every direction, the damping matrix the one
// with respect to velocities, and the strain rates B y the derivative of the strains.

#include "../complex_step.h"
#include "../scene.h"
#include <samara/model/strain_products.h>
#include <samara/model/strain_rows.h>

#include <gtest/gtest.h>

#include <regex>

using namespace samara;

namespace
{
  const std::string bodies_of_all = R"(
subsection Sections
  subsection full
    set Type = matrices
    set Stiffness = 9, 1, .5, .2, .3, .1, 7, .4, .3, .2, .6, 6, .1, .5, .2, 3, .2, .1, 2, .3, 4
    set Inertia = 2, 2, 2, 0.3, 0.2, 0.4
  end
  #sections
end
subsection Bodies
  subsection block
    set Type = rigid body
    set Mass = 2
    set Position = 0.3, -0.2, 0.1
    set Rotation = 0.4, 0.2, -0.7
    set Centre of mass = 0.1, -0.2, 0.05
    set Inertia = 0.3, 0.4, 0.5, 0.02, -0.03, 0.01
    set Frames = far at 1 0.4 0.2
  end
  subsection rod
    set Type = beam
    set Points = 1, 0.4, 0.2; 1.5, 1, 0.4; 2, 1, 1
    set Elements = 2
    set Degree = 2
    set Twist = 0.3*s
    set Section = full
    set Damping = 0.1, 0.2, 0.3, 0.4, 0.5, 0.6
  end
  #bodies
end
)";

  const std::string rail_of_all = R"(
  subsection rail
    set Type = beam
    set Shape = arc
    set Points = -1, 0.3, 0; 0.3, 0, 0.2; 2, 0.1, 0.7
    set Twist = 0.4*s
    set Elements = 2
    set Degree = 3
    set Section = full
  end
)";

  /** What a scene adds to the sections, to the bodies, and behind them. */
  struct Text
  {
    std::string sections, bodies, rest;

    std::string
    model() const
    {
      std::string all = bodies_of_all;
      all.replace(all.find("#bodies"), 7, bodies);
      all.replace(all.find("#sections"), 9, sections);
      return all + rest;
    }
  };

  /** One scene for each kind: the bodies, and joints and loads between block and rod. */
  std::map<std::string, Text>
  scenes()
  {
    std::map<std::string, Text> s;
    s["beam"] = s["rigid body"] = s["matrices"] = {};
    s["table"] = {R"(
  subsection tapered
    set Type = table
    set Stations = full at 0, full at 1
  end
)",
                  R"(
  subsection second
    set Type = beam
    set Shape = arc
    set Points = 3, 0, 0; 4, 0.5, 0; 5, 0, 0
    set Section = tapered
    set Elements = 1
  end
)",
                  ""};
    for (const std::string kind : {"rectangle", "tube", "engineering constants"})
      s[kind] = {"subsection s\n  set Type = " + kind +
                   (kind == "engineering constants" ?
                      "\n set EA=5\n set GA2=4\n set GA3=3\n set GJ=2\n set EI2=2\n set EI3=1\n set EI23 = 0.2\n"
                      " set Shear centre = 0.1, 0.2\n set Tension centre = -0.1, 0.3\n set Mass = 2\n"
                      " set Trapeze coupling = 2\n set Trapeze stiffness = 3\n" :
                      "\n set E = 3\n set Density = 1\n") +
                   (kind == "rectangle" ? " set Width 2 = 1\n set Width 3 = 2\n" : "") +
                   (kind == "tube" ? " set Outer radius = 1\n set Inner radius = 0.5\n" : "") + "end\n",
                 R"(
  subsection second
    set Type = beam
    set Points = 3, 0, 0; 4, 0.5, 0
    set Section = s
    set Elements = 1
  end
)",
                 ""};
    const std::string used = "set Spring = 2\n set Damper = 0.3\n set Rest = 0.2\n set Prescribed = 0.1 + 0.2*t\n"
                             " set Lower stop = 0.4\n set Upper stop = 0.5\n set Stop stiffness = 1.5\n"
                             " set Stop damping = 0.4\n";
    const std::map<std::string, std::vector<std::string>> motions = {{"revolute", {"rotation"}},
                                                                     {"prismatic", {"displacement"}},
                                                                     {"screw", {"displacement", "rotation"}},
                                                                     {"cylindrical", {"displacement", "rotation"}},
                                                                     {"planar", {"displacement 1", "displacement 2", "rotation"}},
                                                                     {"universal", {"rotation 1", "rotation 2"}},
                                                                     {"spherical", {}},
                                                                     {"rigid", {}},
                                                                     {"distance", {}},
                                                                     {"spring", {"length"}},
                                                                     {"flexible joint", {}},
                                                                     {"in line", {"displacement"}},
                                                                     {"in plane", {"displacement 1", "displacement 2"}},
                                                                     {"constant velocity", {}},
                                                                     {"skew universal", {"rotation 1", "rotation 2"}},
                                                                     {"point on curve", {}},
                                                                     {"springs in fixed axes", {}},
                                                                     {"rolling disc", {}},
                                                                     {"rolling ball", {}},
                                                                     {"knife edge", {}},
                                                                     {"ball on plane", {}},
                                                                     {"ball on ball", {}},
                                                                     {"ball on cylinder", {}},
                                                                     {"ellipsoid on plane", {}}};
    const std::string law = " set Overlap = allowed\n set Restitution = 0.5\n set Impact speed = 3\n set Friction = 0.3\n"
                            " set Static friction = 0.5\n set Stribeck speed = 0.9\n set Sticking speed = 0.09\n"
                            " set Planes = block at 1 0.5 0.3 normal -0.3 0.2 1, ground at 0 0 0 normal 0.1 0 1\n"
                            " set Cylinders = block at 0.3 -0.2 0.1 axis 0.2 1 0.3 radius 0.5\n"
                            " set Tubes = block at 0.2 -0.3 0.2 axis 0.5 1 0.3 radius 1.3\n"
                            " set Hollow balls = block at 0.3 -0.2 0.3 radius 1.2\n end\n";
    s["contacts"].rest =
      "subsection Joints\n subsection j\n set Type = contacts\n set Balls = block.centre radius 0.6, rod.start radius 0.6\n"
      " set Stiffness = 2\n set Exponent = 1.5\n" +
      law +
      " subsection k\n set Type = contacts\n set Beams = rod radius 0.5\n set Stations = 2\n"
      " set Line stiffness = 3\n" +
      law + "end\n";
    s["contacts with laws"].rest =
      "subsection Joints\n subsection j\n set Type = contacts\n set Balls = block.centre radius 0.6, rod.start radius 0.6\n"
      " set Stiffness = 2\n set Rolling friction = 0.1\n set Turning friction = 0.2\n"
      " set Laws = block with ground stiffness 3 exponent 2 restitution 0.7 speed 2 friction 0.4 static 0.4 rolling 0,"
      " ro* with block friction 0.1 static 0.2 turning 0.3, rod with ground exponent 1.5 restitution 1 friction 0\n" +
      law + "end\n";
    // a ball on a beam, and a rod across it, at places within them
    s["contacts at nearest places"] = {
      "",
      rail_of_all,
      "subsection Joints\n subsection j\n set Type = contacts\n set Balls = block.centre radius 0.2\n"
      " set Beams = rail radius 0.15\n set Overlap = allowed\n set Stiffness = 2\n set Exponent = 1.5\n"
      " set Rods = block from 1.2876 0.3357 0.9448 to 1.3056 -0.5839 0.5042 radius 0.2\n"
      " set Restitution = 0.5\n set Impact speed = 3\n set Friction = 0.3\n set Sticking speed = 0.09\n"
      " set Rolling friction = 0.1\n set Turning friction = 0.2\n end\nend\n"};
    const std::string bounces = "set Stop exponent = 1.5\n set Stop restitution = 0.5\n set Stop speed = 3\n",
                      rubs    = "set Friction = 0.3\n set Static friction = 0.5\n set Stribeck speed = 0.9\n"
                                " set Sticking speed = 0.09\n",
                      sticks  = "set Friction = 0.3\n set Static friction = 0.5\n set Stribeck speed = 0.9\n"
                                " set Bristle stiffness = 2\n set Bristle damping = 0.7\n";
    for (const auto &[kind, free] : motions)
      {
        const bool  is_contact = kind.find("ball on ") == 0 || kind == "ellipsoid on plane";
        std::string text       = "subsection Joints\n subsection j\n set Type = " + kind +
                           "\n set Body A = block.centre\n set Body B = rod.start\n";
        if (kind == "point on curve")
          text += "set Expressions = 1 + sin(s) - s^2, 0.4 + 0.3*s, 0.2 + exp(s)/2 - 0.5\n";
        else if (kind != "distance" && kind != "spring" && kind != "rigid")
          text += kind == "universal"      ? "set Axis = 1, 0, 0\n set Second axis = 0, 1, 0\n" :
                  kind == "skew universal" ? "set Axis = 1, 0, 0\n set Second axis = 1, 1, 0.3\n" :
                                             "set Axis = 1, 2, -1\n";
        if (kind == "rolling disc")
          text += "set Radius = 0.4\n set Axle = 1, 0.3, 0.9\n";
        if (kind == "springs in fixed axes")
          text += "set Stiffness = 3, 4, 5\n set Damping = 0.2, 0.1, 0.4\n";
        if (kind == "constant velocity")
          text += "set Second axis = 1, 1, 1\n";
        if (kind == "screw")
          text += "set Pitch = 0.3\n subsection thread\n " + rubs +
                  "set Friction preload = 0.4\n set Radius = 0.5\n set Flank angle = 0.3\n end\n";
        if (kind == "revolute" || kind == "cylindrical")
          text += "set Bearing length = 0.4\n";
        if (kind == "rigid")
          text += "set Reaction = true\n";
        if (kind == "rolling ball")
          text += "set Radius = 0.4\n set Axis 1 = 1, 0, 0\n";
        if (kind == "flexible joint")
          text += "set Stiffness = 1, 2, 3\n set Rotational stiffness = 4, 5, 6\n set Damping = 6, 5, 4\n"
                  "set Rotational damping = 3, 2, 1\n set Coupling = .1, .2, .1, .2, .1, "
                  ".3, .1, .2, .1, .1, .2, .1, .2, .1, .1\n";
        if (is_contact)
          text += (kind == "ellipsoid on plane" ? "set Semi-axes = 4, 5, 6\n set Rounding = 1\n" : std::string("set Radius = 5\n")) +
                  "set Rolling friction = 0.1\n set Turning friction = 0.2\n"
                  " set Stiffness = 2\n set Exponent = 1.5\n set Restitution = 0.5\n set Impact speed = 3\n"
                  " set Damping = 0.2\n" + rubs + (kind.find(" on plane") != std::string::npos ? "" : "set Radius A = 0.1\n");
        for (const auto &motion : free)
          {
            // one with linear stops, all others with those that are not, and with friction
            const bool is_plain = kind == "prismatic";
            text += "subsection " + motion + "\n " + used + (is_plain ? "" : bounces);
            if (!is_plain && kind != "screw" && motion.find("displacement ") != 0)
              text += rubs + "set Friction preload = 0.4\n" + (motion.find("rotation") == 0 ? "set Friction radius = 0.7\n" : "");
            text += "end\n";
          }
        // friction against several motions at once
        const std::string presses = rubs + " set Friction preload = 0.4\n";
        if (kind == "planar" || kind == "in plane")
          text += "subsection displacement\n " + presses + " end\n";
        const bool turns = kind == "spherical" || kind == "in line" || kind == "in plane" || kind == "constant velocity" ||
                           kind == "point on curve";
        if (turns)
          text += "subsection rotation\n " + presses + " set Friction radius = 0.7\n end\n";
        s[kind].rest = text + "end\nend\n";
        if (const auto at = text.find(rubs); at != std::string::npos && (kind == "revolute" || kind == "screw" || kind == "spherical" || is_contact))
          s[kind + " with bristles"].rest = text.substr(0, at) + sticks + text.substr(at + rubs.size()) + "end\nend\n";
      }
    for (const std::string kind : {"point", "sleeve", "prismatic", "screw"})
      s["sliding " + kind] = {"",
                              rail_of_all,
                              "subsection Joints\n subsection j\n set Type = sliding " + kind +
                                "\n set Body A = rail\n set Body B = block.far\n set Position = 0.3, 0, 0.2\n" +
                                (kind == "screw" ? "set Turn per length = 2.3\n" : "") +
                                "subsection displacement\n " + used + "end\n" +
                                (kind == "point" ? "subsection rotation\n " + rubs +
                                                     " set Friction preload = 0.4\n set Friction radius = 0.7\n end\n" :
                                 kind == "screw" ? "subsection thread\n " + rubs +
                                                     " set Friction preload = 0.4\n set Radius = 0.5\n set Flank angle = 0.3\n end\n" :
                                                   "") +
                                "end\nend\n"};
    for (const std::string line : {"curve", "edge v0"})
      s["sliding point along " + line + " of a shell"] = {
        "",
        "subsection plate\n set Type = shell\n set Patches = u, v, 0.2*u*v\n set Elements = 2, 1\n set Degree = 2\n"
        " set E = 3\n set Poisson ratio = 0.3\n set Thickness = 0.1\n set Density = 0.4\n"
        " set Curves = curve at 0.1 + 0.8*s, 0.3 + 0.4*s^2\n end\n",
        "subsection Joints\n subsection j\n set Type = sliding point\n set Body A = plate." + line +
          "\n set Body B = block.far\n set Gap = allowed\n set At the ends = leave\n set Position = " +
          (line == "curve" ? "0.5, 0.4, 0.04" : "0.3, 0, 0") +
          "\n subsection displacement\n set Damper = 0.3\n set Force = -0.2*j.force*j.displacement rate\n end\n end\nend\n"};
    s["buffer"] = {"",
                   rail_of_all,
                   "subsection Joints\n subsection j\n set Type = sliding point\n set Body A = rail\n set Body B = block.far\n"
                   " set Gap = allowed\n set Position = 0.3, 0, 0.2\n end\n subsection k\n set Type = sliding point\n set Body A = rail\n"
                   " set Body B = ground\n set Gap = allowed\n set Position = 1, 0, 0.4\n end\n subsection l\n set Type = buffer\n"
                   " set Joint A = k\n set Joint B = j\n set Length = 0.1\n set Stiffness = 3\n set Restitution = 0.5\n"
                   " set Impact speed = 2\n end\nend\n"};
    const std::string hinge = R"(
subsection Joints
  subsection a
    set Type = revolute
    set Body A = block.centre
    set Body B = rod.start
  end
  subsection b
    set Type = revolute
    set Body A = ground
    set Body B = block.centre
    set Axis = 1, 1, 0
  end
)";
    s["gear"].rest            = hinge + "subsection g\n set Type = gear\n set Joint A = a\n set Joint B = b\n set Ratio = -2.5\n"
                                        " set Efficiency = 0.8\n set Pitch radius = 0.3\n set Sticking speed = 0.09\n end\nend\n";
    s["gear with backlash"].rest =
      hinge + "subsection g\n set Type = gear\n set Joint A = a\n set Joint B = b\n set Ratio = -2.5\n"
              " set Backlash = 0.01\n set Mesh stiffness = 3\n set Mesh restitution = 0.5\n set Mesh speed = 2\n end\nend\n";
    s["first order"].rest =
      "subsection States\n subsection z\n set Rate = 3*z - z^2*block.far.velocity y + rod.end.position x*t\n"
      " end\nend\n";
    s["gravity"].rest         = "subsection Loads\n subsection w\n set Type = gravity\n set Acceleration = 1, 2, -9\n end\nend\n";
    s["gravity of the state"].rest =
      "subsection Loads\n subsection w\n set Type = gravity\n"
      " set Acceleration = 1 + rod.end.displacement y, 2*block.far.velocity x, -9 + 3*sin(rod.end.position z)\n end\nend\n";
    s["damper of the state"].rest =
      "subsection Joints\n subsection a\n set Type = revolute\n set Body A = block.far\n set Body B = rod.start\n"
      " subsection rotation\n set Damper = 0.4 + a.rotation^2 + rod.end.velocity z^2\n set Moment = 0.3*t\n end\n end\nend\n";
    s["point load"].rest      = "subsection Loads\n subsection f\n set Type = point load\n set At = block.far\n set Force = 1, t, 3\n"
                           " set Moment = 2, 1, t^2\n end\n subsection g\n set Type = point load\n set At = rod.end\n"
                           " set Force = 1, 2, 3\n set Axes = body\n end\nend\n";
    s["line load"].rest       = "subsection Loads\n subsection f\n set Type = line load\n set Body = rod\n set Force = 1, t, 3\n"
                           " set Variation = 1 + s^2\n end\n subsection g\n set Type = line load\n set Body = rod\n"
                           " set Force = 1, t, 3\n set Moment = 2, -1, t^2\n set Axes = body\n"
                           " set Variation = s < 0.7 ? 1 : -s\n end\nend\n";
    // two walls with a corner between them, above their reference surface
    const std::string walls = R"(
  subsection wall
    set Type = shell
    set Patches = 3 + u, v, 0.2*u*v; 4, v, 0.2*v + u
    set Elements = 1, 1
    set Degree = 2
    set E = 3
    set Poisson ratio = 0.3
    set Thickness = 0.5
    set Offset = 0.1
    set Density = 0.4
    set Damping = 0.2
  end
)";
    s["shell"]       = {"", walls, ""};
    s["MITC4 shell"] = {"",
                        std::regex_replace(std::regex_replace(walls, std::regex("Type = shell"), "Type = MITC4 shell"),
                                           std::regex(" *set Degree = 2\n"),
                                           ""),
                        ""};
    s["geodesic beam"] = {"",
                          R"(
  subsection second
    set Type = geodesic beam
    set Points = 3, 0, 0; 4, 0.5, 0
    set Twist = 0.3*s
    set Section = full
    set Elements = 2
    set Damping = 0.1, 0.2, 0.3, 0.4, 0.5, 0.6
  end
)",
                          ""};
    s["support"] = {"",
                    walls,
                    "subsection Joints\n subsection a\n set Type = support\n set Along = wall.edge u0, rod.end\n"
                    " set Fixed = displacement 1, rotation 2\n end\n subsection b\n set Type = support\n"
                    " set Along = wall.edge v1\n set Fixed = rotation 1, rotation 2\n set Axis = 1, 2, -1\n end\n"
                    " subsection c\n set Type = support\n set Along = block\n"
                    " set Fixed = displacement 3, rotation 1, rotation 2, rotation 3\n end\nend\n"};
    s["distributing"] = {"",
                         walls,
                         "subsection Joints\n subsection a\n set Type = distributing\n"
                         " set Along = wall.edge u0, wall.patch 2 edge v1\n set Body = rod.end\n end\nend\n"};
    s["area load"] = {"",
                      walls,
                      "subsection Loads\n subsection f\n set Type = area load\n set Body = wall\n set Force = 1, t, 3\n"
                      " set Moment = 2, -1, t\n end\n subsection g\n set Type = area load\n set Body = wall\n"
                      " set Force = 1, t, 3\n set Moment = 2, -1, t\n set Axes = body\n end\n subsection h\n"
                      " set Type = line load\n set Body = wall\n set Edge = edge v0\n set Force = 1, t, 3\n"
                      " set Variation = 1 + s\n end\nend\n"};
    s["pressure"] = {"",
                     walls,
                     "subsection Loads\n subsection p\n set Type = pressure\n set Body = wall\n"
                     " set Pressure = 2 + t\n end\nend\n"};
    s["pressure of the state"] = {"",
                                  walls,
                                  "subsection Loads\n subsection p\n set Type = pressure\n set Body = wall\n"
                                  " set Pressure = 2 + t - rod.end.displacement x + block.far.velocity y^2\n end\nend\n"};
    s["steady rotation"].rest = hinge + "end\nsubsection Loads\n subsection r\n set Type = steady rotation\n set Joint = a\n"
                                   " set Speed = 3\n end\nend\n";
    return s;
  }
} // namespace



TEST(Tangents, EveryKindOfTheCatalogueIsTested)
{
  const auto tested = scenes();
  // sections give the beam its matrices; the others have tests of their own, in tests/section, tests/states, tests/trim and tests/aero
  const std::set<std::string> elsewhere = {
    "isotropic", "orthotropic", "anisotropic", "layup", "ellipse", "box", "I", "C", "mesh", "airfoil", "file", "BeamDyn",
    "PID", "transfer function", "state space", "delay", "control",
    "analytic", "C81", "AeroDyn", "air", "prescribed inflow", "uniform inflow", "Pitt-Peters inflow", "Peters-He inflow", "annular inflow", "helical wake",
    "lifting line", "expression"};
  for (const auto &group : Catalogue().groups)
    for (const auto &kind : group.kinds.kinds())
      EXPECT_EQ(tested.count(kind) + elsewhere.count(kind), 1u) << "there is no scene for the kind <" << kind << ">";
}



TEST(Tangents, AgreeWithComplexStep)
{
  for (const auto &[kind, text] : scenes())
    {
      const Scene scene(text.model());
      for (const bool orthonormal : {true, false})
        for (const bool with_stops : {false, true})
          {
            const ComplexStep check(scene.system, orthonormal, with_stops);
            const std::string where = kind + (orthonormal ? "" : ", triads deformed") + (with_stops ? ", on stops" : "");
            // the curve of a shell is a sum over many nodes
            EXPECT_LT(check.error_of_tangent(), kind.find("curve of a shell") != std::string::npos ? 5e-14 : 2e-14)
              << where;
            EXPECT_LT(check.error_of_damping(), 2e-14) << where << ", damping";
          }
    }
}



// Where bodies touch, bounce and rub, forces depend on velocities, normal forces on multipliers.
TEST(Tangents, ContactsAgreeWithComplexStepWhereTheyMove)
{
  for (const auto &[kind, text] : scenes())
    if (text.rest.find("restitution") != std::string::npos || text.rest.find("Restitution") != std::string::npos ||
        text.rest.find("Friction") != std::string::npos)
      for (const bool orthonormal : {true, false})
        {
          // ComplexStep leaves the rates of strains aside where places move
          std::string       model = text.model();
          const std::string line  = "    set Damping = 0.1, 0.2, 0.3, 0.4, 0.5, 0.6\n";
          model.erase(model.find(line), line.size());
          const Scene       scene(model);
          const ComplexStep check(scene.system, orthonormal, true, true);
          EXPECT_LT(check.error_of_tangent(), 2e-14) << kind << orthonormal;
          EXPECT_LT(check.error_of_damping(), 1e-13) << kind << orthonormal;
        }
}



TEST(Tangents, StrainRatesAreDerivativesOfStrains)
{
  for (const auto &[kind, text] : scenes())
    for (const bool with_stops : {false, true})
      EXPECT_LT(ComplexStep(Scene(text.model()).system, false, with_stops).error_of_strain_rates(), 1e-13) << kind;
}



// What rates of constraints change by while no velocity changes is told exactly: against differences of fourth order along
// the motion, of all kinds, with triads deformed. What a law of states prescribes is left out by both.
TEST(Tangents, SecondRatesAreChangesOfRates)
{
  constexpr double dt     = 1e-3;
  unsigned int     n_rows = 0, n_changing = 0;
  for (const auto &[kind, text] : scenes())
    {
      const Scene   scene(text.model());
      const System &system = scene.system;
      const Layout &layout = system.layout;
      if (layout.n_multipliers == 0)
        continue;
      State      state  = system.reference();
      auto       number = [n = 0]() mutable { return std::sin(1. + ++n); };
      for (auto *const values : {&state.q, &state.coordinates, &state.y, &state.rates})
        for (unsigned int i = values == &state.q ? 12 : values == &state.y ? 6 : 0; i < values->size(); ++i)
          (*values)[i] += (values == &state.q || values == &state.coordinates ? 0.05 : 0.5) * number();
      state.time = 0.4;
      state.held = false;
      const auto rates_after = [&](const double by) {
        State moved = state;
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            const Matrix3                   D = state.triad(node);
            const Eigen::Map<const Vector3> v(&state.y[6 * node]), w(&state.y[6 * node + 3]);
            Eigen::Map<Vector3>(&moved.q[12 * node]) += by * D * v;
            Eigen::Map<Matrix3>(&moved.q[12 * node + 3]) += by * D * skew(Vector3(w));
          }
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          moved.coordinates[i] += by * state.rates[i];
        moved.time += by;
        Eigen::VectorXd rates(layout.n_multipliers);
        system.constraint_rates(moved.point(), rates.data());
        return rates;
      };
      const Eigen::VectorXd differences =
        (8 * (rates_after(dt) - rates_after(-dt)) - (rates_after(2 * dt) - rates_after(-2 * dt))) / (12 * dt);
      std::vector<double> second(layout.n_multipliers, 7.);
      system.constraint_second_rates(state.point(), second.data());
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        {
          // what a law of states prescribes
          if (std::isnan(second[i]))
            EXPECT_NE(layout.name_of_multiplier(i).find("prescribed"), std::string::npos) << kind;
          else
            EXPECT_NEAR(second[i], differences(i), 1e-9 * (1 + std::abs(differences(i)))) << kind << ", row " << i;
          ++n_rows;
          n_changing += std::abs(second[i]) > 1e-3;
        }
    }
  EXPECT_GT(n_rows, 100u);
  EXPECT_GT(n_changing, n_rows / 2);
}



// Whoever offers strains as rows leaves BᵀCB out where the material is not wanted: together they are the tangent.
TEST(Tangents, StrainRowsHoldTheMaterial)
{
  for (const auto &[kind, text] : scenes())
    {
      if (kind == "MITC4 shell" || kind == "geodesic beam")
        continue; // prototypes offer no rows: their matrices hold everything
      const Scene         scene(text.model());
      const System       &system = scene.system;
      State               state  = system.reference();
      std::vector<double> z(system.size());
      for (unsigned int i = 0; i < z.size(); ++i)
        z[i] = 0.1 * std::sin(1. + i);
      system.update(state, z);
      SparseMatrix K(system.layout.pattern), C(system.layout.pattern), rest(system.layout.pattern);
      system.tangent(state, K);
      system.damping(state, C);
      const StrainRows rows = system.strain_rows(state);
      Eigen::MatrixXd  B    = Eigen::MatrixXd::Zero(rows.B.n_rows(), system.size());
      for (unsigned int i = 0; i < rows.B.n_rows(); ++i)
        for (unsigned int k = rows.B.start[i]; k < rows.B.start[i + 1]; ++k)
          B(i, rows.B.columns[k]) += rows.B.values[k];
      // strains that are products of others have no rows of their own
      EXPECT_EQ(rows.B.n_rows() + strain_products(system.model).size(), system.layout.n_strains) << kind;
      Eigen::MatrixXd material = Eigen::MatrixXd::Zero(system.size(), system.size()), viscous = material;
      for (const auto &p : rows.points)
        {
          const Eigen::MatrixXd B_p = B.middleRows(p.first_row, p.size);
          material += p.weight * B_p.transpose() * rows.C(p) * B_p;
          viscous += p.weight * B_p.transpose() * rows.C_d(p) * B_p;
        }
      system.tangent(state, rest, false);
      EXPECT_LT((K.dense() - rest.dense() - material).norm(), 1e-13 * K.dense().norm()) << kind;
      system.damping(state, rest, false);
      EXPECT_LT((C.dense() - rest.dense() - viscous).norm(), 1e-13 * C.dense().norm()) << kind;
    }
}



namespace
{
  /** Kinds as users may also write them: defaults, other shapes, places that are given. */
  std::map<std::string, Text>
  more_scenes()
  {
    std::map<std::string, Text> s;
    s["vertical curve"].bodies = "subsection second\n set Type = beam\n set Shape = expressions\n set Section = full\n"
                                 " set Expressions = 0.1*s^2, table: 0 0; 0.5 0.2; 1 0.3, 3 + s\n set Elements = 2\nend\n";
    s["vertical line"].bodies  = "subsection second\n set Type = beam\n set Points = 0, 0, 3; 0, 0, 4\n"
                                 " set Section = full\n set Elements = 1\nend\n";
    s["sequence 131"].bodies   = "subsection second\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1.1, 1.2\n"
                                 " set Rotation = 0.3, 0.5, -0.4\n set Rotation sequence = 131\nend\n";
    for (const std::string kind : {"revolute", "planar", "spherical", "universal", "flexible joint", "spring", "distance"})
      s[kind + " of which little is said"].rest =
        "subsection Joints\n subsection j\n set Type = " + kind + "\n set Body A = block\n set Body B = rod.end\n" +
        (kind == "flexible joint" ? "set Stiffness = 1, 2, 3\n set Rotational stiffness = 4, 5, 6\n" : "") +
        (kind == "planar" ? "subsection displacement 1\n set Spring = 2\n end\n" : "") +
        (kind == "spring" ? "subsection length\n set Spring = 2\n end\n" : "") + " end\nend\n";
    for (const std::string kind : {"revolute", "flexible joint", "spring", "distance", "knife edge"})
      s[kind + " at a place"].rest = "subsection Joints\n subsection j\n set Type = " + kind +
                                     "\n set Body A = block\n set Body B = rod.end\n set Position = 0.3, 0.4, -0.7\n"
                                     " end\nend\n";
    s["law with a table"].rest = "subsection Loads\n subsection f\n set Type = point load\n set At = block.far\n"
                                 " set Force = table: 0 1; 2 5, block.angular velocity y*2 N*s, rod.end.position z*1 N/m + t*1 N/s\n"
                                 " end\nend\n";
    return s;
  }

  /** The model @p text in a subsystem that is turned and moved, in one that is turned and moved. */
  std::string
  placed(const std::string &text)
  {
    return "subsection Subsystems\n subsection outer\n set Position = 1, 2, -3\n set Rotation = 0.7, -0.4, 1.1\n"
           " subsection Subsystems\n subsection it\n set Position = 0.2, 0.1, 0.5\n set Rotation = -0.3, 0.2, 2\n"
           " set Rotation sequence = 123\n" +
           text + " end\n end\n end\nend\n";
  }
} // namespace



// A model in a subsystem that is turned and moved is the same model seen from elsewhere: what it does in the frames of its
// nodes is the same for every kind, in a state with strains, velocities, multipliers and motions of joints.
TEST(Placements, EveryKindIsTurnedWithItsSubsystem)
{
  const Matrix3 R_outer = rotation_of_angles({0.7, -0.4, 1.1}, "321"), R_inner = rotation_of_angles({-0.3, 0.2, 2}, "123");
  const Matrix3 R       = R_outer * R_inner;
  const Vector3 x_0     = Vector3(1, 2, -3) + R_outer * Vector3(0.2, 0.1, 0.5);
  auto          all     = scenes();
  for (const auto &scene : more_scenes())
    all.insert(scene);
  unsigned int n_refused = 0;
  for (const auto &[kind, text] : all)
    {
      if (const std::string said = complaint_of(placed(text.model())); !said.empty())
        {
          // patches of shells are functions, whose places nobody turns yet
          if (said.find("write its patches where they are") == std::string::npos)
            {
              ++n_refused;
              EXPECT_NE(said.find("acts on the whole model"), std::string::npos) << kind << ": " << said;
            }
          continue;
        }
      const Scene as_it_is(text.model()), turned(placed(text.model()));
      ASSERT_EQ(as_it_is.system.size(), turned.system.size()) << kind;
      const auto residual = [](const System &system, State &state) {
        state = system.reference();
        std::vector<double> z(system.size()), r(system.size(), 0.);
        for (unsigned int i = 0; i < z.size(); ++i)
          z[i] = 0.1 * std::sin(1. + i);
        system.update(state, z);
        for (unsigned int i = 6; i < state.y.size(); ++i)
          state.y[i] = 0.3 * std::cos(2. + i);
        state.time = 0.7;
        system.stresses(state, state.stress);
        system.residual(state, state.stress, r);
        // without what acts on the ground, which does not turn
        return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(r.data(), system.size()));
      };
      State                 a, b;
      const Eigen::VectorXd r_a = residual(as_it_is.system, a), r_b = residual(turned.system, b);
      EXPECT_GT(r_a.norm(), 0.) << kind;
      EXPECT_LT((r_a - r_b).norm(), 1e-12 * (1 + r_a.norm())) << kind;
      for (unsigned int n = 1; n < as_it_is.system.layout.n_nodes; ++n)
        {
          EXPECT_LT((x_0 + R * a.position(n) - b.position(n)).norm(), 1e-13) << kind;
          EXPECT_LT((R * a.triad(n) - b.triad(n)).norm(), 1e-12) << kind;
        }
    }
  EXPECT_EQ(n_refused, 5u); // gravity, twice, three groups of contacts
}
