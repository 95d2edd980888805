#include <samara/solvers/joint_motion.h>
#include <samara/solvers/newton.h>
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
          auto &motion = state.motion[node];
          motion.at    = state.position(node);
          motion.velocity += spin.cross(motion.at - rotation.through);
          motion.spin += spin;
        }
    }



    /**
     * Set components that are round-off, inertial ones, to zero: a motion that is plane stays plane then. Plane motions
     * of flexible parts may be unstable, and round-off is enough to leave them.
     */
    void
    remove_round_off(State &state)
    {
      constexpr double round_off        = 1e-13;
      double           fastest_velocity = 0, fastest_spin = 0;
      for (const auto &m : state.motion)
        {
          fastest_velocity = std::max(fastest_velocity, m.velocity.norm());
          fastest_spin     = std::max(fastest_spin, m.spin.norm());
        }
      for (auto &m : state.motion)
        for (unsigned int i = 0; i < 3; ++i)
          {
            if (std::abs(m.velocity(i)) < round_off * fastest_velocity)
              m.velocity(i) = 0;
            if (std::abs(m.spin(i)) < round_off * fastest_spin)
              m.spin(i) = 0;
          }
    }



    void
    add_motion_of_joints(const System &system, State &state, const std::vector<double> &y)
    {
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
  } // namespace



  SteadyMotion
  set_steady_motion(const System &system, State &state, const std::vector<double> &speeds)
  {
    const auto &rotations = system.model.rotations;
    std::fill(state.motion.begin(), state.motion.end(), State::Motion());
    std::fill(state.rates.begin(), state.rates.end(), 0.);
    SteadyMotion result;
    bool         joints_turn = false;
    for (unsigned int i = 0; i < rotations.size(); ++i)
      if (rotations[i].coordinate < 0)
        add_rotation_of_all(state, rotations[i], speeds[i]);
      else if (speeds[i] != 0.)
        joints_turn = true;
    if (joints_turn)
      {
        const JointMotion motion(system, state, speeds);
        add_motion_of_joints(system, state, motion.velocities);
        remove_round_off(state);
        result = motion.findings;
      }
    system.update_twists(state);
    return result;
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
    const auto  &first = state.motion[std::min<unsigned int>(1, state.motion.size() - 1)];
    const double spin = first.spin.norm(), length = model_length(system.model);
    for (unsigned int node = 2; node < system.layout.n_nodes; ++node)
      {
        const auto   &m        = state.motion[node];
        const Vector3 expected = first.velocity + first.spin.cross(m.at - first.at);
        if ((m.spin - first.spin).norm() > 1e-6 * spin || (m.velocity - expected).norm() > 1e-6 * spin * length)
          return false;
      }
    return true;
  }
} // namespace samara
