#ifndef samara_tests_joints_skew_axes_h
#define samara_tests_joints_skew_axes_h

#include <samara/rotation/rotation.h>

namespace samara::skew_axes
{
  /** Of a joint "Axis = 1, 2, -2" and, where it has a second one, "2, 1, 2": right-handed unit vectors, inertial. */
  const Vector3 a = Vector3(1, 2, -2) / 3., b = Vector3(2, 1, 2) / 3., c = a.cross(b);

  /** Where the joint is [m]. */
  const Vector3 J(0.4, -0.3, 0.2);
} // namespace samara::skew_axes

#endif
