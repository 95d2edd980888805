#ifndef samara_model_initial_motion_h
#define samara_model_initial_motion_h

#include <samara/model/state.h>

#include <map>

namespace samara
{
  /**
   * What an item says of its nodes at the start of a motion that is no rigid motion of its own. Items that share a node
   * are asked one after the other, all about the same state: what the last one says counts.
   */
  class InitialMotion
  {
  public:
    /** A place and a triad, inertial components. */
    struct Place
    {
      Vector3 x;
      Matrix3 D;
    };

    virtual ~InitialMotion() = default;

    /** Velocities of nodes in addition to those of the state, as twists in the nodes' frames. */
    virtual void
    add_velocity_fields(const State &, std::map<unsigned int, Vector6> &) const
    {}

    /** Where nodes are in place of where the state has them. */
    virtual void
    add_displacement_fields(const State &, std::map<unsigned int, Place> &) const
    {}
  };


  class System;

  /** Deform the model as its items say it is at the start of a motion; returns whether any of them says it. */
  bool add_initial_displacements(const System &system, State &state);
} // namespace samara

#endif
