/*
 * Equilibria that are unstable are said to be: the number of directions of negative stiffness (NegativeDirections).
 *   1. a cantilever under an end force: π²EI/4L² of its soft and of its stiff plane, then 9π²EI/4L² of the soft one
 *   2. a blade whose chord stands across the plane of rotation: GJ (π/2L)² = Ω² (I₃ − I₂), and the rate of its growth
 *   3. pendulums of one and two rods, hanging and upright
 *   4. a shaft beyond its critical speed, which gyroscopic forces hold; bodies that are free; loads that follow
 */

#include <samara/analysis/negative_directions.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A clamped beam along x, EI2 = 1 and EI3 = 2, nearly rigid otherwise; L = mass = 1. */
  std::string
  clamped_beam(const std::string &loads, const std::string &stiffness = "set GJ = 100\n set EI2 = 1\n set EI3 = 2\n")
  {
    return R"(
set Analyses = static, modal
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = 1e7
    set GA2 = 1e7
    set GA3 = 1e7
    set Mass = 1
    set I2 = 1e-3
    set I3 = 1e-2
    )" + stiffness +
           R"(
  end
end
subsection Bodies
  subsection rod
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Axis 2 = 0, 0, 1
    set Section = s
    set Elements = 4
    set Degree = 4
  end
end
subsection Joints
  subsection clamp
    set Type = rigid
    set Body A = ground
    set Body B = rod.start
  end
end
subsection Loads
)" + loads +
           R"(
end
subsection Modal
  set Modes = 4
end
subsection Static
  set Stability limits = pass
end
)";
  }

  std::string
  force_at_end(const double force, const std::string &axes = "")
  {
    return "  subsection force" + axes +
           "\n    set Type = point load\n    set At = rod.end\n    set Force = " + std::to_string(-force) + ", 0, 0\n" +
           (axes.empty() ? "" : "    set Axes = " + axes + "\n") + "  end\n";
  }

  /** Rods of length and mass 1 hinged about y, one after the other from the ground up (@p up = 1) or down (−1). */
  std::string
  pendulum_of_rods(const int n_rods, const int up)
  {
    std::string bodies, joints;
    for (int i = 0; i < n_rods; ++i)
      {
        const std::string n = std::to_string(i + 1);
        bodies += "  subsection rod " + n +
                  "\n    set Type = rigid body\n    set Mass = 1\n    set Inertia = 0.1, 0.1, 0.01\n" +
                  "    set Position = 0, 0, " + std::to_string(up * (i + 0.5)) + "\n  end\n";
        joints += "  subsection hinge " + n +
                  "\n    set Type = revolute\n    set Body A = " + (i == 0 ? "ground" : "rod " + std::to_string(i)) +
                  "\n    set Body B = rod " + n + "\n    set Position = 0, 0, " + std::to_string(up * i) +
                  "\n    set Axis = 0, 1, 0\n  end\n";
      }
    return "set Analyses = static, modal\nsubsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints +
           "end\nsubsection Loads\n  subsection g\n    set Type = gravity\n  end\nend\nsubsection Modal\n  set Modes = 2\nend\n";
  }

  NegativeDirections
  directions_at_equilibrium(Scene &scene)
  {
    scene.equilibrium();
    return negative_directions(scene.system, scene.context.state);
  }

  bool
  has_said(const Scene &scene, const std::string &text)
  {
    return scene.stream.str().find(text) != std::string::npos;
  }
} // namespace



TEST(Unstable, ColumnsBeyondEachOfTheirLoads)
{
  const double       of_soft = M_PI * M_PI / 4, of_stiff = 2 * of_soft, second_of_soft = 9 * of_soft;
  const double       loads[]    = {0.99 * of_soft, 1.01 * of_soft, 1.01 * of_stiff, 1.01 * second_of_soft};
  const unsigned int expected[] = {0, 1, 2, 3};
  for (unsigned int i = 0; i < 4; ++i)
    {
      Scene      scene(clamped_beam(force_at_end(loads[i])));
      const auto found = directions_at_equilibrium(scene);
      EXPECT_EQ(found.number, expected[i]) << loads[i];
      EXPECT_FALSE(found.is_least || found.is_odd_only);
      EXPECT_EQ(found.are_unstable(), i > 0);
      EXPECT_EQ(scene.log.n_warnings(), i > 0 ? 1u : 0u) << scene.stream.str();
      scene.modes();
      EXPECT_EQ(scene.log.n_warnings(), i > 0 ? 2u : 0u) << scene.stream.str();
      if (i == 0)
        continue;
      EXPECT_TRUE(
        has_said(scene, i == 1 ? "negative in 1 direction," : "negative in " + std::to_string(i) + " directions"));
      EXPECT_TRUE(has_said(scene, "<rod> moves, most of all rod at (")) << scene.stream.str();
      EXPECT_TRUE(has_said(scene, "modal: warning: the equilibrium is unstable"));
    }
}



// Of 30 N, beyond three limits, a half is beyond two, which no sign tells: the run ends at the third and says so.
TEST(Unstable, StepsThatPassTwoLimits)
{
  for (const double force : {3.5, 30.})
    {
      Scene scene(clamped_beam(force_at_end(force)), {"Static/Stability limits = stop"});
      try
        {
          scene.equilibrium();
          FAIL();
        }
      catch (const NotConverged &error)
        {
          const std::string text      = error.what();
          const bool        is_stable = force < 10;
          EXPECT_EQ(text.find("The equilibrium is stable up to there") != std::string::npos, is_stable) << text;
          EXPECT_EQ(text.find("negative in 2 directions") != std::string::npos, !is_stable) << text;
        }
    }
}



TEST(Unstable, BladeWhoseChordStandsAcrossThePlaneOfRotation)
{
  const double GJ = 1, I2 = 1e-3, I3 = 1e-2, critical = M_PI / 2 * std::sqrt(GJ / (I3 - I2));
  for (const double ratio : {0.98, 1.1})
    {
      const double speed = ratio * critical;
      Scene        scene(clamped_beam("  subsection rotor\n    set Type = steady rotation\n    set Speed = " +
                                 std::to_string(speed) + "\n  end\n",
                               "set GJ = 1\n set EI2 = 1e4\n set EI3 = 1e4\n"));
      const auto   found = directions_at_equilibrium(scene);
      EXPECT_EQ(found.number, ratio > 1 ? 1u : 0u);
      EXPECT_EQ(found.turning, NegativeDirections::Turning::as_one);
      EXPECT_EQ(found.are_unstable(), ratio > 1);
      EXPECT_EQ(scene.log.n_warnings(), ratio > 1 ? 1u : 0u) << scene.stream.str();
      if (ratio < 1)
        continue;
      double growth = 0;
      for (const auto &mode : scene.modes())
        growth = std::max(growth, mode.lambda.real());
      const double square = (speed * speed * (I3 - I2) - GJ * M_PI * M_PI / 4) / (I2 + I3);
      EXPECT_NEAR(growth / std::sqrt(square), 1, 0.02);
      EXPECT_TRUE(has_said(scene, "grows e-fold in")) << scene.stream.str();
    }
}



TEST(Unstable, PendulumsUpright)
{
  for (const int n_rods : {1, 2})
    for (const int up : {-1, 1})
      {
        Scene      scene(pendulum_of_rods(n_rods, up));
        const auto found = directions_at_equilibrium(scene);
        EXPECT_EQ(found.number, up > 0 ? unsigned(n_rods) : 0u);
        scene.modes();
        EXPECT_EQ(scene.log.n_warnings(), up > 0 ? 2u : 0u) << scene.stream.str();
      }
}



// Between the first and the second critical speed the stiffness is negative in the two planes of the first mode, in
// axes that turn with the shaft; all modes oscillate.
TEST(Unstable, ShaftThatGyroscopicForcesHold)
{
  for (const std::string Omega : {"5", "20"})
    {
      Scene scene("prm/benchmarks/spinning_shaft.prm", {"Constants/Omega = " + Omega, "Bodies/shaft/Elements = 3"});
      const auto found = directions_at_equilibrium(scene);
      EXPECT_EQ(found.number, Omega == "5" ? 0u : 2u);
      EXPECT_FALSE(found.are_unstable());
      EXPECT_EQ(has_said(scene, "the equilibrium is unstable but for gyroscopic forces"), Omega != "5");
      const unsigned int n_warnings = scene.log.n_warnings();
      scene.modes();
      EXPECT_EQ(scene.log.n_warnings(), n_warnings) << scene.stream.str();
      EXPECT_EQ(has_said(scene, "gyroscopic forces hold those in which it is negative"), Omega != "5");
    }
}



// A body without support has six directions of no stiffness, none of negative stiffness.
TEST(Unstable, FreeMotionsAreNotCounted)
{
  std::string text = clamped_beam("");
  text.replace(text.find("    set Type = rigid\n"), 21, "    set Type = spherical\n");
  Scene scene(text, {"Analyses = modal"});
  scene.modes();
  EXPECT_EQ(scene.log.n_warnings(), 0u) << scene.stream.str();
}



// Loads that follow: no divergence of Beck's column, whatever the load; together with a dead one it diverges, and of
// the tangent, which is not symmetric, the determinant tells.
TEST(Unstable, LoadsThatFollow)
{
  Scene beck(clamped_beam(force_at_end(15, "body")));
  EXPECT_EQ(directions_at_equilibrium(beck).number, 0u);
  Scene      both(clamped_beam(force_at_end(3) + force_at_end(0.1, "body")));
  const auto found = directions_at_equilibrium(both);
  EXPECT_TRUE(found.is_odd_only && found.are_unstable());
  EXPECT_TRUE(has_said(both, "the determinant of its stiffness, which is not symmetric, is negative"));
}
