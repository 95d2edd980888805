#ifndef samara_joints_moment_of_h
#define samara_joints_moment_of_h

#include <samara/rotation/rotation.h>

namespace samara
{
  /**
   * The moment on a frame, in its axes, from forces on the ends of its axes seen there: Σ e_k × h_k = 2 axial(H), h_k
   * the columns of @p H.
   */
  template <typename Number>
  Vec3<Number>
  moment_of(const Mat3<Number> &H)
  {
    return 2. * axial(H);
  }
} // namespace samara

#endif
