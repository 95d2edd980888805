#ifndef samara_cosserat_initial_velocity_h
#define samara_cosserat_initial_velocity_h

#include <samara/model/model.h>

namespace samara
{
  /**
   * The rigid motion in which a user says a body starts, by the entries `Velocity` [m/s] of a point of the body and
   * `Angular velocity` [rad/s], both in inertial components.
   *
   * If at least one of the entries is given, the other is zero if it is not, and the motion replaces whatever the state
   * has at the nodes of the body (a steady rotation, say). If neither is given, nodes are left as they are. Of bodies
   * that share a node, being welded together, it is enough that one says how it moves; if several do, the last one in
   * the file counts. The ground does not move.
   */
  struct InitialVelocity
  {
    Vector3 velocity = Vector3::Zero(), angular_velocity = Vector3::Zero();

    /** @p point is what has the velocity: "node", "start of the beam". */
    void add_parameters(Parameters &prm, const std::string &point);

    /** Complain if what is to move is welded to the ground; @p frames are resolved, the first is the point. */
    void check(const std::vector<Frame> &frames, const Item &body, Complaints &complaints) const;

    /** Give the nodes of @p frames their twists, each at its place in the state. */
    void assign(const std::vector<Frame> &frames, const Item &body, State &state) const;
  };
} // namespace samara

#endif
