// Shells in motion: what a free flight keeps.

#include <samara/analysis/dynamic.h>

#include "../debug.h"
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



// For 10 000 steps of 2 ms after the throw; of two elements, and stiffer, so that they are short.
TEST(ShellInFlight, KeepsThemForTenThousandSteps)
{
  if (is_debug)
    GTEST_SKIP() << "the same steps as above, more of them";
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
