#include <samara/solvers/newton.h>
#include <samara/time/increment.h>

#include <cmath>

namespace samara
{
  State
  moved(const System &system, const State &state, const double *x, const double factor)
  {
    const Layout &layout     = system.layout;
    const double *velocities = x + layout.of_multiplier(0);
    State         result     = state;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Vector6       zeta = factor * Eigen::Map<const Vector6>(x + layout.of_node(node));
        const Matrix3       D = state.triad(node), R = rotation_of_vector(zeta.tail<3>());
        Eigen::Map<Vector3> place(&result.q[12 * node]);
        place += D * zeta.head<3>();
        Eigen::Map<Matrix3>(&result.q[12 * node + 3]) = D * R;
        Eigen::Map<Vector6>(&result.y[6 * node]) +=
          factor * Eigen::Map<const Vector6>(velocities + layout.of_node(node));
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        result.coordinates[i] += factor * x[layout.of_coordinate(i)];
        result.rates[i] += factor * velocities[layout.of_coordinate(i)];
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      result.states[i] += factor * x[layout.of_state(i)];
    system.stresses(result, result.stress);
    return result;
  }



  std::vector<double>
  increment(const System &system, const State &from, const State &to, const bool whole_turns)
  {
    const Layout       &layout = system.layout;
    std::vector<double> x(size_of_increment(layout));
    double *const       velocities = x.data() + layout.of_multiplier(0);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Matrix3 D = from.triad(node);
        Eigen::Map<Vector6>(&x[layout.of_node(node)]) << D.transpose() * (to.position(node) - from.position(node)),
          vector_of_rotation(D.transpose() * to.triad(node));
        Eigen::Map<Vector6>(velocities + layout.of_node(node)) =
          Eigen::Map<const Vector6>(&to.y[6 * node]) - Eigen::Map<const Vector6>(&from.y[6 * node]);
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        double difference = to.coordinates[i] - from.coordinates[i];
        if (whole_turns && system.model.coordinate_units[i] == "rad")
          difference = std::remainder(difference, 2 * M_PI);
        x[layout.of_coordinate(i)]          = difference;
        velocities[layout.of_coordinate(i)] = to.rates[i] - from.rates[i];
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      x[layout.of_state(i)] = to.states[i] - from.states[i];
    return x;
  }



  std::vector<double>
  scales_of_increment(const System &system, const double time)
  {
    const Layout       &layout = system.layout;
    const double        length = model_length(system.model);
    std::vector<double> result(size_of_increment(layout), 1.);
    for (int i = 0; i < layout.of_multiplier(0); ++i)
      result[i] = layout.scale_of(i, length);
    for (int i = 0; i < layout.n_kinematic(); ++i)
      result[layout.of_multiplier(0) + i] = result[i] / time;
    return result;
  }
} // namespace samara
