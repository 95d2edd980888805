// Joints that slide along beams, against closed forms: beads on turning rods, a load that crosses a bridge, nuts,
// statics and modes with the abscissa as an unknown, across the ends of elements, and what is refused. Energy, momenta
// and orders of several sliders on one flying beam are among those of tests/time.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  beam_section(const std::string &EA, const std::string &EI, const std::string &inertia = "0.01")
  {
    return "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = " + EA +
           "\n set GA2 = " + EA + "\n set GA3 = " + EA + "\n set GJ = " + EI + "\n set EI2 = " + EI +
           "\n set EI3 = " + EI + "\n set Mass = 1\n set I2 = " + inertia + "\n set I3 = " + inertia + "\n end\nend\n";
  }

  std::string
  rod(const std::string &points, const std::string &entries)
  {
    return " subsection rod\n set Type = beam\n set Section = s\n set Points = " + points + "\n" + entries + " end\n";
  }

  std::string
  bead(const std::string &entries)
  {
    return " subsection bead\n set Type = rigid body\n set Mass = 0.5\n set Inertia = 0.1, 0.1, 0.1\n" + entries +
           " end\n";
  }

  std::string
  slide(const std::string &kind, const std::string &entries = "", const std::string &displacement = "")
  {
    return " subsection slide\n set Type = sliding " + kind + "\n set Body A = rod\n set Body B = bead\n" + entries +
           " subsection displacement\n" + displacement + " end\n end\n";
  }

  std::string
  hinge(const std::string &rotation)
  {
    return " subsection hinge\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n"
           " set Axis = 0, 0, 1\n subsection rotation\n" +
           rotation + " end\n end\n";
  }

  const std::string clamp =
    " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = rod.start\n end\n";

  std::string
  model(const std::string &sections, const std::string &bodies, const std::string &joints, const std::string &rest = "")
  {
    return sections + "subsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints + "end\n" + rest;
  }

  std::string
  dynamic(const double end, const double step, const unsigned int stages)
  {
    return "set Analyses = dynamic\nsubsection Dynamic\n set End time = " + number_to_text(end) +
           "\n set Step = " + number_to_text(step) + "\n set Stages = " + std::to_string(stages) +
           "\n set Spectral radius = 1\n set Newton tolerance = 1e-12\nend\n";
  }

  std::unique_ptr<Scene>
  moved(const std::string &text)
  {
    auto  scene    = std::make_unique<Scene>(text);
    auto &analysis = scene->analysis<DynamicAnalysis>();
    analysis.start(scene->context);
    analysis.run(scene->context);
    return scene;
  }

  const std::string weight_on_rails = "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n";
} // namespace



// r̈ = Ω² r on a rod that turns with Ω, r = r₀ cosh Ωt; the force across the rod is 2 m Ω ṙ.
TEST(Sliding, BeadOnATurningRod)
{
  const double Omega = 3, T = 0.5, r = 0.2 * std::cosh(Omega * T), v = 0.2 * Omega * std::sinh(Omega * T);
  for (const unsigned int s : {1, 2, 3})
    {
      std::vector<double> errors;
      for (const double h : {0.1, 0.05})
        {
          const auto scene = moved(model(beam_section("1e7", "1e7"),
                                         rod("0, 0, 0; 1, 0, 0", " set Rigid = true\n set Elements = 1\n") +
                                           bead(" set Position = 0.2, 0, 0\n set Velocity = 0, 0.6, 0\n"),
                                         hinge(" set Prescribed = 3*t\n") + slide("point"),
                                         dynamic(T, h, s)));
          errors.push_back(std::abs(scene->value("slide.arc length") - r));
          EXPECT_NEAR(scene->value("slide.displacement rate"), v, std::pow(0.4, s + 2.)); // not yet projected
        }
      EXPECT_LT(errors[1], s == 1 ? 2e-3 : 1e-7) << s << " stages";
      EXPECT_GT(std::log2(errors[0] / errors[1]), 2. * s - 0.2) << s << " stages: " << errors[0];
    }
}



// A spring along an inclined rod: k d = m g sin α.
TEST(Sliding, RestsOnASpring)
{
  Scene scene(model(beam_section("1e9", "1e9"),
                    rod("0, 0, 0; 4, 0, -3", "") + bead(" set Position = 0.4, 0, -0.3\n"),
                    clamp + slide("prismatic", "", " set Spring = 20\n set Rest = 0.1\n"),
                    weight_on_rails));
  scene.equilibrium();
  const double weight = 0.5 * 9.80665;
  EXPECT_NEAR(scene.value("slide.displacement"), 0.1 + weight * 0.6 / 20, 1e-7);
  EXPECT_NEAR(scene.value("slide.arc length"), 0.6 + weight * 0.6 / 20, 1e-7);
  EXPECT_NEAR(scene.value("slide.force"), weight, 1e-8);
  EXPECT_NEAR(scene.value("slide.force 1"), -weight * 0.6, 1e-6);
}



// ω² = k/m on a rod at rest; on one that turns with Ω, about the place where the spring balances the centrifugal force,
// ω² = k/m − Ω².
TEST(Sliding, Modes)
{
  for (const double Omega : {0., 2.})
    {
      const std::string turning = "subsection Loads\n subsection turn\n set Type = steady rotation\n"
                                  " set Axis = 0, 0, 1\n set Speed = 2\n end\nend\n";
      Scene             scene(model(beam_section("1e9", "1e9"),
                        rod("0, 0, 0; 4, 0, 0", "") + bead(" set Position = 0.3, 0, 0\n"),
                        hinge(" set Prescribed = 0\n") + slide("prismatic", "", " set Spring = 20\n set Rest = 0.4\n"),
                        Omega == 0 ? "" : turning));
      scene.equilibrium();
      // k (r − r₀ − rest) = m Ω² r
      const double r = 20 * 0.7 / (20 - 0.5 * Omega * Omega);
      EXPECT_NEAR(scene.value("slide.arc length"), r, 1e-6);
      EXPECT_NEAR(scene.modes()[0].frequency(), std::sqrt(20 / 0.5 - Omega * Omega), 1e-5) << Omega;
    }
}



// A nut that is pushed along a cantilever by its drive turns against the sections in proportion, bent as they are; the
// drive's work is that of its force.
TEST(Sliding, Screw)
{
  Scene scene(model(beam_section("1e4", "40"),
                    rod("0, 0, 0; 2, 0, 0", " set Elements = 2\n") + bead(" set Position = 0.3, 0, 0\n"),
                    clamp + slide("screw", " set Turn per length = 4\n", " set Prescribed = 0.9\n"),
                    weight_on_rails + "subsection Static\n set Load steps = 8\nend\n"));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("slide.displacement"), 0.9, 1e-12);
  // about the tangent: axis 1 of the nut has the slope of a cantilever under a load at 1.2 m and its own weight
  const double weight = 0.5 * 9.80665, q = 9.80665, x = 1.2, EI = 40,
               slope = weight * x * x / (2 * EI) + q * x * (3 * 4 - 3 * 2 * x + x * x) / (6 * EI);
  const Matrix3 D    = rotation_of_vector(
    M_PI / 180 *
    Vector3(scene.value("bead.rotation x"), scene.value("bead.rotation y"), scene.value("bead.rotation z")));
  EXPECT_NEAR(D(2, 0), -std::sin(std::atan(slope)), 0.04);
  const Matrix3 bent = triad(D.col(0), Vector3::UnitY());
  EXPECT_NEAR(std::atan2(bent.col(2).dot(D.col(1)), bent.col(1).dot(D.col(1))), 4 * 0.9 - 2 * M_PI, 1e-4);
  EXPECT_NEAR(scene.value("slide.force"), weight, 1e-6);
}



// The abscissa is free, and the turns that a kind does not hold: as many motions without frequency on a rod that is
// held. Leaving later and a buffer between two take none of them.
TEST(Sliding, MotionsAreCounted)
{
  const auto count = [](const std::string &bodies, const std::string &joints) {
    Scene        scene(model(beam_section("1e4", "40"),
                      rod("0, 0, 0; 2, 0, 0", " set Elements = 2\n") + bodies,
                      clamp + joints,
                      "set Analyses = modal\n"));
    unsigned int n = 0;
    for (const auto &mode : scene.modes())
      n += mode.is_free();
    EXPECT_EQ(check_model(scene.system).n_free_motions, n) << joints;
    return n;
  };
  const std::string at = bead(" set Position = 0.3, 0, 0\n"), leave = " set At the ends = leave\n";
  for (const std::string &entries : {std::string(), leave})
    {
      EXPECT_EQ(count(at, slide("point", entries)), 4u);
      EXPECT_EQ(count(at, slide("sleeve", entries)), 2u);
      EXPECT_EQ(count(at, slide("prismatic", entries)), 1u);
      EXPECT_EQ(count(at, slide("screw", entries + " set Turn per length = 4\n")), 1u);
      EXPECT_EQ(count(at, slide("screw", entries)), 1u);
    }
  const std::string second = " subsection other\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n"
                             " set Position = 1.2, 0, 0\n end\n",
                    buffer =
                      " subsection slide 2\n set Type = sliding sleeve\n set Body A = rod\n set Body B = other\n"
                      " end\n subsection buffer\n set Type = buffer\n set Joint A = slide\n set Joint B = slide 2\n"
                      " set Length = 0.1\n set Stiffness = 1e4\n end\n";
  EXPECT_EQ(count(at + second, slide("point") + buffer), 6u);
}



// A screw that does not turn is a prismatic slider, and so is one of which no turn is said.
TEST(Sliding, ScrewWithoutTurnIsPrismatic)
{
  std::vector<std::array<double, 3>> found;
  for (const auto &[kind, entries] :
       {std::pair<std::string, std::string>("prismatic", ""), {"screw", " set Turn per length = 0\n"}, {"screw", ""}})
    {
      const auto scene = moved(
        model(beam_section("1e4", "40"),
              rod("0, 0, 0; 2, 0, 0", " set Elements = 2\n set Twist = 0.4*s\n set Angular velocity = 0.5, 0, 2\n") +
                bead(" set Position = 0.3, 0, 0\n set Velocity = 2, 0.6, 0\n set Angular velocity = 0.5, 0, 2\n"),
              hinge("") + slide(kind, entries),
              dynamic(0.2, 0.01, 2) + weight_on_rails));
      found.push_back(
        {scene->value("slide.arc length"), scene->value("bead.rotation x"), scene->value("slide.moment 1")});
    }
  EXPECT_GT(found[0][0], 0.5);
  EXPECT_GT(std::abs(found[0][1]), 0.1);
  for (unsigned int k : {1, 2})
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(found[k][i], found[0][i], 1e-7 * (1 + std::abs(found[0][i]))) << k << " " << i;
}



// A soft rod that nobody drives, and a bead that crosses three ends of elements: steps end there.
TEST(Sliding, AcrossElements)
{
  const auto at = [](const double T, const double h, const unsigned int s) {
    return moved(
      model(beam_section("400", "8"),
            rod("0, 0, 0; 2, 0, 0", " set Elements = 4\n set Degree = 2\n set Angular velocity = 0, 0, 2\n") +
              bead(" set Position = 0.451, 0, 0\n set Velocity = 6, 0.9, 0\n"),
            hinge("") + slide("point"),
            dynamic(T, h, s)));
  };
  const auto angular_momentum = [](const Scene &scene) {
    const State &state = scene.context.state;
    double       sum   = 0;
    for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
      {
        const Vector6 p = scene.system.model.nodes[node].inertia * Eigen::Map<const Vector6>(&state.y[6 * node]);
        const Matrix3 D = state.triad(node);
        sum += (D * p.tail<3>() + state.position(node).cross(D * p.head<3>()))(2);
      }
    return sum;
  };
  const double        momentum = angular_momentum(*at(1e-4, 1e-4, 3));
  const auto          exact    = at(0.2, 0.000625, 3);
  std::vector<double> arc_lengths, heights;
  EXPECT_GT(exact->value("slide.arc length"), 1.55);
  EXPECT_NEAR(angular_momentum(*exact), momentum, 1e-9 * momentum);
  EXPECT_LT(exact->analysis<DynamicAnalysis>().report.largest_balance, 1e-11); // through three ends of elements, too
  for (const double h : {0.01, 0.005})
    {
      const auto scene = at(0.2, h, 2);
      arc_lengths.push_back(std::abs(scene->value("slide.arc length") - exact->value("slide.arc length")));
      heights.push_back(std::abs(scene->value("rod.end.position y") - exact->value("rod.end.position y")));
    }
  // steps that go across the kinks are wrong by 1e-4, whatever their size
  EXPECT_LT(arc_lengths[1], 1e-5);
  EXPECT_LT(heights[1], 1e-5);
}



// A load that crosses a bridge with a speed v: the series of the simply supported beam,
// w = 2F/(mL) Σ sin(nπ/2) (sin Ω_n t − Ω_n/ω_n sin ω_n t)/(ω_n² − Ω_n²) in the middle, Ω_n = nπv/L.
TEST(Sliding, LoadOnABridge)
{
  const double L = 2, EI = 40, F = 5e-3, v = 3, T = 0.4;
  double       exact = 0;
  for (unsigned int n = 1; n < 400; n += 2)
    {
      const double Omega = n * M_PI * v / L, omega = std::pow(n * M_PI / L, 2) * std::sqrt(EI);
      exact -= 2 * F / L * std::sin(0.5 * n * M_PI) / (omega * omega - Omega * Omega) *
               (std::sin(Omega * T) - Omega / omega * std::sin(omega * T));
    }
  const std::string bridge =
    " subsection left\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n set Axis = 0, 1, 0\n end\n"
    " subsection right\n set Type = in line\n set Body A = ground\n set Body B = rod.end\n set Axis = 1, 0, 0\n end\n";
  const auto scene =
    moved(model(beam_section("1e10", "40", "1e-9"),
                rod("0, 0, 0; 2, 0, 0", " set Elements = 6\n set Degree = 6\n") +
                  " subsection bead\n set Type = rigid body\n set Mass = 1e-9\n set Inertia = 1e-9, 1e-9, 1e-9\n"
                  " set Velocity = 3, 0, 0\n end\n",
                bridge + slide("point", "", " set Prescribed = 3*t\n"),
                "subsection Loads\n subsection push\n set Type = point load\n set At = bead\n set Force = 0, 0, -5e-3\n"
                " end\nend\n" +
                  dynamic(T, 0.001, 3)));
  EXPECT_NEAR(scene->value("rod.middle.position z") / exact, 1, 1e-6);
}



// A beam through a fixed guide at half its length: two cantilevers, ω = 3.516 √(EI/m)/l², each in two planes; drawn in
// to a quarter, l = 1.5 m.
TEST(Sliding, TelescopingBeam)
{
  for (const double drawn : {0., 0.5})
    {
      Scene scene(model(beam_section("1e9", "40", "1e-6"),
                        rod("-1, 0, 0; 1, 0, 0", " set Elements = 8\n"),
                        " subsection guide\n set Type = sliding prismatic\n set Body A = rod\n set Body B = ground\n"
                        " subsection displacement\n set Prescribed = -" +
                          number_to_text(drawn) + "\n end\n end\n"));
      scene.equilibrium();
      EXPECT_NEAR(scene.value("rod.start.position x"), drawn - 1, 1e-9);
      const double l = 1 + drawn, omega = 1.8751040687 * 1.8751040687 * std::sqrt(40.) / (l * l);
      const auto  &modes = scene.modes();
      ASSERT_GE(modes.size(), 2u);
      EXPECT_NEAR(modes[0].frequency(), omega, 1e-4 * omega);
      EXPECT_NEAR(modes[1].frequency(), omega, 1e-4 * omega);
    }
}



// The outboard blade of a rotor of variable diameter (17.1 kg, Ω = 20 rad/s) that the nut on a jackscrew draws in from
// 2.667 m to 1.372 m: the force of the screw is m Ω² r, 18.24 kN to 9.38 kN, and its moment is the force over the turn
// per length.
TEST(Sliding, NutOnAJackscrew)
{
  const auto at = [](const std::string &turns) {
    auto scene = std::make_unique<Scene>(model(
      beam_section("2e8", "1e5"),
      rod("0, 0, 0; 1.9, 0, 0", " set Elements = 2\n") +
        " subsection hub\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n end\n"
        " subsection bead\n set Type = rigid body\n set Mass = 17.1\n set Inertia = 1, 7, 7\n"
        " set Position = 2.667, 0, 0\n end\n",
      " subsection shaft\n set Type = revolute\n set Body A = ground\n set Body B = hub\n end\n"
      " subsection motor\n set Type = revolute\n set Body A = hub\n set Body B = rod.start\n set Axis = 1, 0, 0\n"
      " subsection rotation\n set Prescribed = " +
        turns +
        "*2*pi\n end\n end\n"
        " subsection tube\n set Type = prismatic\n set Body A = hub\n set Body B = bead\n set Axis = 1, 0, 0\n end\n" +
        slide("screw", " set Position = 1.9, 0, 0\n set Turn per length = 10\n"),
      "subsection Loads\n subsection turning\n set Type = steady rotation\n set Joint = shaft\n set Speed = 20\n end\nend\n"
      "subsection Static\n set Load steps = 8\nend\n"));
    scene->equilibrium();
    return scene;
  };
  const double drawn = 1.295, turns = 10 * drawn / (2 * M_PI);
  for (const bool is_in : {false, true})
    {
      const auto   scene = at(is_in ? number_to_text(turns) : "0");
      const double r = scene->value("bead.position x"), force = scene->value("slide.force 1");
      // the screw is stretched, and twisted by 0.035 rad at its end, which lets the nut go by 3.5 mm
      EXPECT_NEAR(r, 2.667 - (is_in ? drawn : 0), 5e-3);
      EXPECT_NEAR(force, -17.1 * 400 * r, 1e-6 * 18240);
      EXPECT_NEAR(force, is_in ? -9380 : -18240, 30);
      EXPECT_NEAR(scene->value("slide.moment 1"), -force / 10, 3e-3 * 1824);
    }
}



// A bead of mass m on a rod that leans by α, rubbed by μ N: s̈ = g (sin α − μ cos α). With the force f of the joint,
// friction included, f² = N² + μ² N². Friction takes the energy that is missing.
TEST(Sliding, Friction)
{
  const double g = 9.80665, mu = 0.3, T = 0.5, a = g * (0.6 - mu * 0.8);
  for (const unsigned int s : {1, 2, 3})
    {
      const auto scene = moved(model(
        beam_section("1e9", "1e9"),
        rod("0, 0, 0; 4, 0, -3", " set Rigid = true\n set Elements = 1\n") + bead(" set Position = 0.4, 0, -0.3\n"),
        clamp + slide("point", "", " set Force = -0.3/sqrt(1.09)*slide.force*tanh(slide.displacement rate/1e-4)\n"),
        weight_on_rails + dynamic(T, 0.01, s)));
      EXPECT_NEAR(scene->value("slide.displacement"), 0.5 * a * T * T, 2e-4) << s;
      EXPECT_NEAR(scene->value("slide.displacement rate"), a * T, 1e-3) << s;
      EXPECT_NEAR(scene->value("slide.force"), 0.5 * g * 0.8 * std::sqrt(1 + mu * mu), 1e-6) << s;
    }
}



// A massless body that slides by a prescribed length, here none, is a frame between nodes: a spring at a of a
// cantilever that is bent by P at its end holds it with F = k w(a), w(a) = P a² (3L − a)/(6EI) − F a³/(3EI).
TEST(Sliding, FrameBetweenNodes)
{
  const double a = 0.77, L = 2, EI = 100, k = 400, P = 1e-4;
  const double w = P * a * a * (3 * L - a) / (6 * EI) / (1 + k * a * a * a / (3 * EI));
  Scene        scene(
    "set Analyses = static\n" +
    model(beam_section("1e7", "100"),
          rod("0, 0, 0; 2, 0, 0", " set Elements = 9\n set Degree = 3\n") +
            " subsection bead\n set Type = rigid body\n set Mass = 0\n set Position = 0.77, 0, 0\n end\n",
          clamp + slide("prismatic", "", " set Prescribed = 0\n") +
            " subsection spring\n set Type = spring\n set Body A = ground\n set Body B = bead.centre\n"
                   " set Position = 0.77, 0, -3\n subsection length\n set Spring = 400\n set Rest = 3\n end\n end\n",
          "subsection Loads\n subsection pull\n set Type = point load\n set At = rod.end\n set Force = 0, 0, 1e-4\n"
                 " end\nend\n"));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("bead.centre.displacement z"), w, 1e-4 * w); // and by shear 2e-5
  EXPECT_NEAR(scene.value("spring.force"), k * w, 1e-4 * k * w);
}



// Beyond the end of the beam there is nothing: the run says so, and goes no further.
TEST(Sliding, OffTheEnd)
{
  try
    {
      moved(model(beam_section("400", "8"),
                  rod("0, 0, 0; 2, 0, 0", " set Elements = 2\n") +
                    bead(" set Position = 1.5, 0, 0\n set Velocity = 2, 0, 0\n"),
                  hinge("") + slide("point"),
                  dynamic(0.5, 0.01, 2)));
      FAIL();
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("slide.displacement"), std::string::npos) << problem.what();
    }
}



// Three equal beads on a straight rod, buffers between them of 0.1 m: the first one hits the second, that the third,
// which flies on to the stop at the end of the rod and comes back; speeds are exchanged, and the order stays. The
// buffers are said the wrong way round, and before the joints.
TEST(Sliding, BeadsKeepTheirOrder)
{
  const auto bead_at = [](const std::string &number, const std::string &x, const std::string &v) {
    return " subsection b" + number +
           "\n set Type = rigid body\n set Mass = 0.5\n set Inertia = 1, 1, 1\n set Position = " + x +
           ", 0, 0\n set Velocity = " + v + ", 0, 0\n end\n";
  };
  const auto slider = [](const std::string &number) {
    return " subsection s" + number + "\n set Type = sliding sleeve\n set Body A = rod\n set Body B = b" + number +
           "\n set At the ends = stop\n subsection displacement\n set Stop stiffness = 1e5\n end\n end\n";
  };
  const auto buffer = [](const std::string &a, const std::string &b) {
    return " subsection between " + a + " and " + b + "\n set Type = buffer\n set Joint A = s" + a +
           "\n set Joint B = s" + b + "\n set Length = 0.1\n set Stiffness = 1e5\n set Exponent = 1.5\n end\n";
  };
  Scene  scene(model(beam_section("1e6", "1e6"),
                    rod("0, 0, 0; 3, 0, 0", " set Rigid = true\n") + bead_at("1", "0.5", "2") + bead_at("2", "1", "0") +
                      bead_at("3", "1.5", "0"),
                    buffer("2", "1") + buffer("2", "3") + clamp + slider("1") + slider("2") + slider("3"),
                    dynamic(1.6, 1e-3, 3)));
  auto  &dynamics = scene.analysis<DynamicAnalysis>();
  double nearest = 1, farthest = 0;
  dynamics.observer = [&](const State &state) {
    const auto S = [&](const std::string &i) { return scene.input.model.probe("s" + i + ".arc length").value(state); };
    nearest      = std::min({nearest, S("2") - S("1"), S("3") - S("2")});
    farthest     = std::max(farthest, S("3"));
    const double gap = scene.input.model.probe("between 2 and 3.gap").value(state);
    EXPECT_NEAR(gap, S("3") - S("2") - 0.1, 1e-12);
    const double force = scene.input.model.probe("between 2 and 3.force").value(state);
    EXPECT_NEAR(force, gap < 0 ? 1e5 * std::pow(-gap, 1.5) : 0., 1e-6);
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  const auto speed = [&](const std::string &i) { return scene.value("s" + i + ".displacement rate"); };
  // on the way: 0.4 m, 0.4 m, 1.5 m with 2 m/s, and back by now to the third again: on the way back the third one is
  // moving
  EXPECT_GT(farthest, 3.);
  EXPECT_LT(farthest, 3.02);
  EXPECT_GT(nearest, 0.085); // (5 m v^2/(8 k))^(2/5) = 0.0109 m are pressed in
  EXPECT_LT(nearest, 0.1);
  EXPECT_NEAR(speed("3"), -2, 1e-4);
  EXPECT_NEAR(speed("1"), 0, 1e-4);
  EXPECT_NEAR(speed("2"), 0, 1e-4);
  EXPECT_LT(dynamics.report.largest_balance, 1e-10);
}
