// Shells in motion: what a free flight keeps.

#include <samara/analysis/dynamic.h>

#include "../momentum.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

TEST(ShellInFlight, KeepsEnergyAndMomentum)
{
  Scene   scene("prm/examples/shells/thrown_plate.prm", {"Dynamic/End time = 0.6", "Dynamic/Newton tolerance = 1e-12"});
  auto   &dynamics = scene.analysis<DynamicAnalysis>();
  Vector6 first = Vector6::Zero(), last = Vector6::Zero();
  dynamics.observer = [&](const State &state) {
    last = momentum_of(scene.system, state);
    if (first.isZero(0.) && state.time > 0.2 - 1e-9)
      first = last;
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_LT((last - first).norm(), 1e-6 * first.norm()); // to the order of the scheme; the energy to round-off
  // a force of 2 and 6 N/m with the factor 1 + s on 0.6 m, for 0.2 s
  EXPECT_NEAR(first(0), 0.2 * 2 * (0.6 + 0.18), 1e-6);
  EXPECT_NEAR(first(2), 0.2 * 6 * (0.6 + 0.18), 1e-6);
  EXPECT_LT(std::abs(dynamics.budget.balance()), 1e-10);
  EXPECT_GT(scene.system.energy(scene.context.state).strain, 1e-3);
}



// A plate and a body that follows the mean of its edge, thrown with different spins: velocities are made to fit, then
// nothing is lost but to the order of the scheme, and no energy at all.
TEST(ShellInFlight, WithABodyAtItsEdge)
{
  ShellModel plate;
  plate.patches   = "u, 0.5*v, 0";
  plate.elements  = "2, 2";
  plate.degree    = 2;
  plate.E         = 1e5;
  plate.thickness = 0.02;
  plate.density   = 1000;
  plate.entries   = "  set Velocity = 1, 0, 2\n  set Angular velocity = 1, -2, 3\n end\n subsection b\n"
                    "  set Type = rigid body\n  set Mass = 3\n  set Inertia = 0.1, 0.2, 0.15\n"
                    "  set Position = 1.2, 0.3, 0.1\n  set Velocity = 0, 1, 1\n";
  plate.joints    = " subsection j\n  set Type = distributing\n  set Along = s.edge u1\n  set Body = b\n end\n";
  Scene   scene(plate.text() + "subsection Dynamic\n set Step = 5e-3\n set End time = 0.3\n set Spectral radius = 1\n"
                               " set Newton tolerance = 1e-12\nend\nsubsection Output\n set Pictures = false\nend\n");
  auto   &dynamics = scene.analysis<DynamicAnalysis>();
  Vector6 first = Vector6::Zero(), largest = Vector6::Zero();
  dynamics.observer = [&](const State &state) {
    const Vector6 now = momentum_of(scene.system, state);
    if (first.isZero(0.))
      first = now;
    largest = largest.cwiseMax((now - first).cwiseAbs());
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_LT(largest.norm(), 1e-4 * first.norm());
  EXPECT_LT(std::abs(dynamics.budget.balance()), 1e-9 * dynamics.budget.start);
  EXPECT_GT(scene.system.energy(scene.context.state).strain, 1e-3);
}



// A stiff plate that hangs on a support of an edge as on a hinge falls from the horizontal: it is upright after a
// quarter of the period of a rod's pendulum, K(1/2) √(2 L/(3 g)).
TEST(ShellInMotion, SwingsOnItsSupport)
{
  ShellModel plate;
  plate.patches   = "u, 0.5*v, 0";
  plate.elements  = "2, 1";
  plate.degree    = 2;
  plate.E         = 2e11;
  plate.thickness = 0.02;
  plate.density   = 7800;
  plate.entries   = "  set Frames = tip at 1 0.5\n";
  plate.joints    = support("hinge", "s.edge u0", "displacement 1, displacement 2, displacement 3");
  plate.loads     = " subsection weight\n  set Type = gravity\n end\n";
  Scene       scene(plate.text() + "subsection Dynamic\n set Step = 5e-3\n set End time = 0.6\nend\n"
                                   "subsection Output\n set Pictures = false\nend\n");
  auto       &dynamics = scene.analysis<DynamicAnalysis>();
  const Probe tip      = scene.input.model.probe("s.tip.position x");
  double      upright = 0, before = 1, t_before = 0;
  dynamics.observer = [&](const State &state) {
    const double x = tip.value(state);
    if (before > 0 && x <= 0)
      upright = t_before + (state.time - t_before) * before / (before - x);
    before   = x;
    t_before = state.time;
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_NEAR(upright / (1.8540746773 * std::sqrt(2 / (3 * 9.80665))), 1, 2e-3);
  EXPECT_LT(std::abs(dynamics.budget.balance()), 1e-8 * 38); // J that have fallen
}



// For 10 000 steps of 2 ms after the throw; of two elements, and stiffer, so that they are short.
TEST(ShellInFlight, KeepsThemForTenThousandSteps)
{
  Scene scene(
    "prm/examples/shells/thrown_plate.prm",
    {"Bodies/plate/Elements = 2, 1", "Bodies/plate/E = 20 MPa", "Dynamic/Step = 2 ms", "Dynamic/End time = 20.2"});
  auto   &dynamics = scene.analysis<DynamicAnalysis>();
  Vector6 first    = Vector6::Zero();
  double  linear = 0, angular = 0, strain = 0;
  dynamics.observer = [&](const State &state) {
    if (state.time < 0.2 - 1e-9)
      return;
    const Vector6 now = momentum_of(scene.system, state);
    if (first.isZero(0.))
      first = now;
    linear  = std::max(linear, (now - first).head<3>().norm());
    angular = std::max(angular, (now - first).tail<3>().norm());
    strain  = std::max(strain, scene.system.energy(state).strain);
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_GE(dynamics.report.n_steps, 10100u);
  EXPECT_LT(linear, 1e-9 * first.head<3>().norm());
  EXPECT_LT(angular, 1e-6 * first.tail<3>().norm());
  EXPECT_LT(dynamics.report.largest_balance, 1e-10);
  EXPECT_GT(strain, 1e-4); // it is flexible
}
