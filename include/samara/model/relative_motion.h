#ifndef samara_model_relative_motion_h
#define samara_model_relative_motion_h

#include <samara/rotation/rotation.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * A relative motion of two nodes at one configuration: its rate [m/s or rad/s] is linear in the twists of the nodes,
   * and the line it goes along or about is fixed to one of them.
   */
  struct RelativeRate
  {
    std::string  name; ///< "flap.rotation"
    unsigned int a = 0, b = 0;
    Vector6 on_a = Vector6::Zero(), on_b = Vector6::Zero(); ///< rate = on_a·y_a + on_b·y_b, twists in the nodes' axes

    bool in_metres = false; ///< the rate is a speed [m/s]; else [rad/s]

    enum Line
    {
      none,      ///< a tilt of a rod: no line that could stand still
      direction, ///< of a displacement
      axis       ///< of a rotation, through a point
    };
    Line         line  = none;
    unsigned int node  = 0;                                          ///< that the line is fixed to
    Vector3      along = Vector3::Zero(), through = Vector3::Zero(); ///< of unit length; a point [m]; inertial axes
  };



  /**
   * What an item says of relative motions of its nodes, for those who look for a motion of the model in which
   * nothing moves against anything else unless it must (doc/theory/steady_rotation.md).
   */
  class RelativeMotions
  {
  public:
    virtual ~RelativeMotions() = default;

    /** Add the relative motions that the item's constraints leave free, at the nodal coordinates @p q. */
    virtual void
    add_relative_rates(const double * /*q*/, std::vector<RelativeRate> &) const
    {}

    /** The nodes that move as one rigid body if nothing is to be strained; empty if there are none. */
    virtual std::vector<unsigned int>
    rigid_nodes() const
    {
      return {};
    }
  };
} // namespace samara

#endif
