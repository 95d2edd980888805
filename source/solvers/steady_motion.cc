#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    void
    add_rotation_of_all(State &state, const Model::Rotation &rotation, const double speed)
    {
      const Vector3 spin = speed * rotation.axis.normalized();
      for (unsigned int node = 0; node < state.motion.size(); ++node)
        {
          auto &motion    = state.motion[node];
          motion.at       = state.position(node);
          motion.velocity += spin.cross(motion.at - rotation.through);
          motion.spin += spin;
        }
    }



    /** Velocities of all unknowns with the given rates of held joints, straining as little as possible. */
    std::vector<double>
    velocities_of_joints(const System &system, const State &state, const std::vector<double> &speeds)
    {
      // the tangent of the unstressed state: material stiffness and constraints only
      State unstressed = state;
      unstressed.held  = true;
      std::fill(unstressed.stress.begin(), unstressed.stress.end(), 0.);
      std::fill(unstressed.multipliers.begin(), unstressed.multipliers.end(), 0.);
      std::fill(unstressed.y.begin(), unstressed.y.end(), 0.);
      unstressed.factor = 0; // loads do not resist the motion
      SparseMatrix K(system.layout.pattern);
      system.tangent(unstressed, K);

      // what nothing drives is at rest: a small stiffness against the ground, taken away again by proximal iterations
      const unsigned int  n_kinematic = system.layout.of_multiplier(0);
      std::vector<double> small(n_kinematic);
      double              largest = 0;
      for (unsigned int i = 0; i < n_kinematic; ++i)
        largest = std::max(largest, std::abs(K.values[K.pattern->position(i, i)]));
      for (unsigned int i = 0; i < n_kinematic; ++i)
        {
          double &diagonal = K.values[K.pattern->position(i, i)];
          small[i]         = 1e-7 * (diagonal > 0 ? diagonal : std::max(1e-6 * largest, 1.));
          diagonal += small[i];
        }
      const auto solver = make_solver(system.layout.pattern);
      solver->factorize(K);

      std::vector<double> held(system.size(), 0.), y(system.size(), 0.);
      unsigned int        hold = 0;
      for (unsigned int i = 0; i < speeds.size(); ++i)
        if (system.model.rotations[i].coordinate >= 0)
          held[system.layout.of_multiplier(system.model.holds[hold++])] = speeds[i];
      for (unsigned int iteration = 0; iteration < 100; ++iteration)
        {
          std::vector<double> b = held;
          for (unsigned int i = 0; i < n_kinematic; ++i)
            b[i] = small[i] * y[i];
          solver->solve(b.data());
          double change = 0, size = 0;
          for (unsigned int i = 0; i < n_kinematic; ++i)
            {
              change = std::max(change, std::abs(b[i] - y[i]));
              size   = std::max(size, std::abs(b[i]));
            }
          y = b;
          if (change <= 1e-12 * size)
            break;
        }
      return y;
    }
  } // namespace



  void
  set_steady_motion(const System &system, State &state, const std::vector<double> &speeds)
  {
    const auto &rotations = system.model.rotations;
    std::fill(state.motion.begin(), state.motion.end(), State::Motion());
    std::fill(state.rates.begin(), state.rates.end(), 0.);
    bool joints_turn = false;
    for (unsigned int i = 0; i < rotations.size(); ++i)
      if (rotations[i].coordinate < 0)
        add_rotation_of_all(state, rotations[i], speeds[i]);
      else if (speeds[i] != 0.)
        joints_turn = true;
    if (joints_turn)
      {
        const std::vector<double> y = velocities_of_joints(system, state, speeds);
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          {
            const Eigen::Map<const Vector6> twist(&y[system.layout.of_node(node)]);
            const Matrix3                   D = state.triad(node);
            auto                           &m = state.motion[node];
            m.at                              = state.position(node);
            m.velocity += D * twist.head<3>();
            m.spin += D * twist.tail<3>();
          }
        for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
          state.rates[i] = y[system.layout.of_coordinate(i)];
      }
    system.update_twists(state);
  }



  Eigen::VectorXd
  steady_motion_vector(const System &system, const State &state)
  {
    Eigen::VectorXd result(6 * state.motion.size());
    for (unsigned int node = 0; node < state.motion.size(); ++node)
      {
        const auto &m = state.motion[node];
        result.segment<6>(6 * node) << m.velocity + m.spin.cross(system.model.nodes[node].x - m.at), m.spin;
      }
    return result;
  }



  void
  set_steady_motion_vector(const System &system, State &state, const Eigen::VectorXd &motion)
  {
    for (unsigned int node = 0; node < state.motion.size(); ++node)
      state.motion[node] = {motion.segment<3>(6 * node + 3), motion.segment<3>(6 * node), system.model.nodes[node].x};
    system.update_twists(state);
  }



  bool
  turns_as_a_whole(const System &system, const State &state)
  {
    const auto &first = state.motion[std::min<unsigned int>(1, state.motion.size() - 1)];
    const double spin = first.spin.norm();
    for (unsigned int node = 2; node < system.layout.n_nodes; ++node)
      {
        const auto   &m        = state.motion[node];
        const Vector3 expected = first.velocity + first.spin.cross(m.at - first.at);
        if ((m.spin - first.spin).norm() > 1e-6 * spin ||
            (m.velocity - expected).norm() > 1e-6 * (expected.norm() + spin * (m.at - first.at).norm()))
          return false;
      }
    return true;
  }
} // namespace samara
