// Gravity that changes with time: it falls and works as it should, and has no potential.
//
// References: a body in free fall, in closed form. Its centre of mass is not at its node, and it spins.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  const double g = 9.81, pi = M_PI;

  std::string
  model(const std::string &acceleration, const std::string &joint = "")
  {
    return "set Analyses = static, dynamic\nsubsection Bodies\n subsection a\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 2, 3\n"
           " set Centre of mass = 0.1, -0.2, 0.3\n set Angular velocity = 1, 0.5, -2\n end\nend\n"
           "subsection Joints\n" +
           joint +
           "end\nsubsection Loads\n subsection weight\n set Type = gravity\n"
           " set Acceleration = " +
           acceleration +
           "\n end\nend\n"
           "subsection Dynamic\n set End time = 2\n set Step = 0.01\n set Spectral radius = 1\n"
           " set Newton tolerance = 1e-13\nend\n";
  }

  /** Applied smoothly within the first second. */
  const std::string growing = "0.3*cos(2*t), 0, t < 1 ? -9.81*(1 - cos(pi*t))/2 : -9.81";
} // namespace



TEST(VaryingGravity, OfAFallingBody)
{
  for (const std::string control : {"fixed", "adaptive"})
    {
      SCOPED_TRACE(control);
      Scene scene(model(growing), {"Dynamic/Step control = " + control, "Dynamic/Tolerance = 1e-7"});
      auto &dynamics = scene.analysis<DynamicAnalysis>();
      auto  centre   = [&](const State &state) -> Vector3 {
        return state.position(1) + state.triad(1) * Vector3(0.1, -0.2, 0.3);
      };
      const Vector3 start = centre(scene.context.state), v = Vector3(1, 0.5, -2).cross(start);
      double        error = 0;
      dynamics.observer   = [&](const State &state) {
        const double t = state.time, late = std::max(0., t - 1), early = std::min(1., t),
                     fall = g / 2 * (early * early / 2 + (std::cos(pi * early) - 1) / (pi * pi)) + g / 2 * late +
                            g / 2 * late * late,
                     aside = 0.3 / 4 * (1 - std::cos(2 * t));
        error              = std::max(error, (centre(state) - start - v * t - Vector3(aside, 0, -fall)).norm());
      };
      const auto before = scene.system.energy(scene.context.state);
      dynamics.run(scene.context);
      EXPECT_LT(error, control == "fixed" ? 1e-10 : 1e-5); // there it falls in few steps
      EXPECT_LT(dynamics.report.largest_balance, 1e-12);
      EXPECT_EQ(dynamics.budget.potential, 0);
      EXPECT_EQ(before.kinetic, 0);
      EXPECT_GT(dynamics.budget.loads, 100);
    }
}



// The same motion and the same work, with a potential or without.
TEST(VaryingGravity, WorksAsConstantGravity)
{
  Scene constant(model("1, 0, -9.81")), varying(model("1 + 0*t, 0, -9.81"));
  for (auto *scene : {&constant, &varying})
    scene->analysis<DynamicAnalysis>().run(scene->context);
  const auto &a = constant.analysis<DynamicAnalysis>().budget, &b = varying.analysis<DynamicAnalysis>().budget;
  EXPECT_LT(a.potential, -300);
  EXPECT_EQ(b.potential, 0);
  EXPECT_NEAR(b.loads, -(a.potential - a.start + b.start), 1e-9);
  EXPECT_NEAR(a.kinetic, b.kinetic, 1e-9);
  EXPECT_NEAR(a.loads, 0, 1e-9);
}



// Statics take it at their time, by the load factor.
TEST(VaryingGravity, InStatics)
{
  const std::string slide = "subsection slide\n set Type = prismatic\n set Body A = ground\n set Body B = a.centre\n"
                            " subsection displacement\n set Spring = 50\n end\n end\n";
  for (const double t : {0., 0.5, 2.})
    {
      Scene scene(model(growing, slide), {"Static/Time = " + std::to_string(t)});
      scene.equilibrium();
      EXPECT_NEAR(scene.context.state.coordinates[0], -2 * g * (1 - std::cos(pi * std::min(t, 1.))) / 2 / 50, 1e-9);
    }
}
