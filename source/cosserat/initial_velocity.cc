#include <samara/cosserat/initial_velocity.h>

#include <algorithm>

namespace samara
{
  void
  InitialVelocity::add_parameters(Parameters &prm, const std::string &point)
  {
    prm.add("Velocity",
            velocity,
            "At the start of a simulation, of the " + point + ", inertial components. Bodies without this entry and the "
            "next start with the velocities of the state before [m/s].");
    prm.add("Angular velocity", angular_velocity, "At the start of a simulation, inertial components [rad/s].");
    prm.turns("Velocity", Turning::direction);
    prm.turns("Angular velocity", Turning::direction);
  }



  void
  InitialVelocity::check(const std::vector<Frame> &frames, const Item &body, Complaints &complaints) const
  {
    const auto on_ground = [](const Frame &frame) { return frame.node == 0; };
    if (!velocity.isZero(0.) && on_ground(frames[0]))
      complaints.add(body.parameters.where("Velocity"),
                     body.kind + " <" + body.name + "> is welded to the ground there and cannot have a velocity");
    if (!angular_velocity.isZero(0.) && std::all_of(frames.begin(), frames.end(), on_ground))
      complaints.add(body.parameters.where("Angular velocity"),
                     body.kind + " <" + body.name + "> is welded to the ground and cannot have an angular velocity");
  }



  void
  InitialVelocity::assign(const std::vector<Frame> &frames, const Item &body, State &state) const
  {
    if (!body.parameters.is_set("Velocity") && !body.parameters.is_set("Angular velocity"))
      return;
    const Vector3 x = frames[0].position(state.q.data());
    for (const auto &frame : frames)
      if (frame.node != 0)
        {
          const Matrix3 D = state.triad(frame.node);
          Eigen::Map<Vector6>(&state.y[6 * frame.node])
            << D.transpose() * (velocity + cross(angular_velocity, state.position(frame.node) - x)),
            D.transpose() * angular_velocity;
        }
  }
} // namespace samara
