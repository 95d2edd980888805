// Shells in motion: what a free flight keeps.

#include <samara/analysis/dynamic.h>

#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  /** Momentum, and angular momentum about the origin. */
  Vector6
  momentum(const System &system, const State &state)
  {
    Vector6 sum = Vector6::Zero();
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3 D = state.triad(node);
        const Vector6 p = system.model.nodes[node].inertia * Eigen::Map<const Vector6>(&state.y[6 * node]);
        sum.head<3>() += D * p.head<3>();
        sum.tail<3>() += D * p.tail<3>() + cross(state.position(node), D * p.head<3>());
      }
    return sum;
  }
} // namespace



TEST(ShellInFlight, KeepsEnergyAndMomentum)
{
  Scene   scene("prm/examples/shells/thrown_plate.prm", {"Dynamic/End time = 0.6", "Dynamic/Newton tolerance = 1e-12"});
  auto   &dynamics = scene.analysis<DynamicAnalysis>();
  Vector6 first = Vector6::Zero(), last = Vector6::Zero();
  dynamics.observer = [&](const State &state) {
    last = momentum(scene.system, state);
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
