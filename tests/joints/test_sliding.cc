// Joints that slide along beams, against closed forms: beads on turning rods, a load that crosses a bridge, nuts, statics
// and modes with the abscissa as an unknown, across the ends of elements, and what is refused. Energy, momenta and orders
// of several sliders on one flying beam are among those of tests/time.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  beam_section(const std::string &EA, const std::string &EI, const std::string &inertia = "0.01")
  {
    return "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = " + EA + "\n set GA2 = " +
           EA + "\n set GA3 = " + EA + "\n set GJ = " + EI + "\n set EI2 = " + EI + "\n set EI3 = " + EI +
           "\n set Mass = 1\n set I2 = " + inertia + "\n set I3 = " + inertia + "\n end\nend\n";
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

  const std::string clamp = " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = rod.start\n end\n";

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

  const std::string gravity = "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n";
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
          const auto scene =
            moved(model(beam_section("1e7", "1e7"),
                        rod("0, 0, 0; 1, 0, 0", " set Rigid = true\n set Elements = 1\n") +
                          bead(" set Position = 0.2, 0, 0\n set Velocity = 0, 0.6, 0\n"),
                        hinge(" set Prescribed = 3*t\n") + slide("point"),
                        dynamic(T, h, s)));
          errors.push_back(std::abs(scene->value("slide.arc length") - r));
          EXPECT_NEAR(scene->value("slide.displacement rate"), v, std::pow(0.4, s + 2.)); // not yet projected
        }
      EXPECT_LT(errors[1], s == 1 ? 2e-3 : 1e-8) << s << " stages";
      EXPECT_GT(std::log2(errors[0] / errors[1]), 2. * s - 0.2) << s << " stages: " << errors[0];
    }
}



// A spring along an inclined rod: k d = m g sin α.
TEST(Sliding, RestsOnASpring)
{
  Scene scene(model(beam_section("1e9", "1e9"),
                    rod("0, 0, 0; 4, 0, -3", "") + bead(" set Position = 0.4, 0, -0.3\n"),
                    clamp + slide("prismatic", "", " set Spring = 20\n set Rest = 0.1\n"),
                    gravity));
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
      Scene scene(model(beam_section("1e9", "1e9"),
                        rod("0, 0, 0; 4, 0, 0", "") + bead(" set Position = 0.3, 0, 0\n"),
                        hinge(" set Prescribed = 0\n") +
                          slide("prismatic", "", " set Spring = 20\n set Rest = 0.4\n"),
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
                    gravity + "subsection Static\n set Load steps = 8\nend\n"));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("slide.displacement"), 0.9, 1e-12);
  // about the tangent: axis 1 of the nut has the slope of a cantilever under a load at 1.2 m and its own weight
  const double weight = 0.5 * 9.80665, q = 9.80665, x = 1.2, EI = 40,
               slope = weight * x * x / (2 * EI) + q * x * (3 * 4 - 3 * 2 * x + x * x) / (6 * EI);
  const Matrix3 D = rotation_of_vector(M_PI / 180 *
                                       Vector3(scene.value("bead.rotation x"),
                                               scene.value("bead.rotation y"),
                                               scene.value("bead.rotation z")));
  EXPECT_NEAR(D(2, 0), -std::sin(std::atan(slope)), 0.04);
  const Matrix3 bent = triad(D.col(0), Vector3::UnitY());
  EXPECT_NEAR(std::atan2(bent.col(2).dot(D.col(1)), bent.col(1).dot(D.col(1))), 4 * 0.9 - 2 * M_PI, 1e-4);
  EXPECT_NEAR(scene.value("slide.force"), weight, 1e-6);
}
