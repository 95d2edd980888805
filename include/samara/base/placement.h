#ifndef samara_base_placement_h
#define samara_base_placement_h

#include <Eigen/Dense>

namespace samara
{
  /** Where a group of objects stands: its axes are turned by R and its origin is moved to x₀, seen from the model. */
  struct Placement
  {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< R, from the axes of the group to those of the model
    Eigen::Vector3d origin   = Eigen::Vector3d::Zero();     ///< x₀ [m]

    /** x₀ + R x */
    Eigen::Vector3d point(const Eigen::Vector3d &x) const;

    /** The placement of what stands by @p inner in a group that stands here. */
    Placement of(const Placement &inner) const;

    bool is_identity() const;

    /** R about an axis by an angle [rad]; entries that are 0 or ±1 but for round-off are 0 or ±1. */
    static Eigen::Matrix3d turn(const Eigen::Vector3d &axis, double angle);

    /** @p R with entries of 0 or ±1 in place of those that are so but for round-off. */
    static Eigen::Matrix3d without_round_off(const Eigen::Matrix3d &R);
  };



  /** What becomes of the three components of an entry when the axes turn in which it is given. */
  enum class Turning : unsigned char
  {
    unknown,       ///< nobody has said it
    own_axes,      ///< they are in the axes of the object, which turn with it
    direction,     ///< R v
    position,      ///< x₀ + R x
    given_position ///< the same if the entry is given; otherwise the place follows from other objects
  };
} // namespace samara

#endif
