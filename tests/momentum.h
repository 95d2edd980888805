#ifndef samara_tests_momentum_h
#define samara_tests_momentum_h

#include <samara/model/system.h>

namespace samara
{
  /** Momentum, and moment of momentum about the origin. */
  inline Vector6
  momentum_of(const System &system, const State &state)
  {
    Vector6 sum = Vector6::Zero();
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Vector6 p = system.model.nodes[node].inertia * Eigen::Map<const Vector6>(&state.y[6 * node]);
        const Matrix3 D = state.triad(node);
        sum.head<3>() += D * p.head<3>();
        sum.tail<3>() += D * p.tail<3>() + state.position(node).cross(D * p.head<3>());
      }
    return sum;
  }
} // namespace samara

#endif
