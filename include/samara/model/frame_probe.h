#ifndef samara_model_frame_probe_h
#define samara_model_frame_probe_h

#include <samara/model/contribution.h>

namespace samara
{
  /** What is known of the motion of a point of a body. */
  struct FrameMotion
  {
    Vector3 x, x_reference; ///< [m]
    Matrix3 D, D_reference;
    Vector3 velocity, angular_velocity; ///< inertial axes [m/s, rad/s]
  };

  /**
   * The probe of a quantity such as "displacement y" or "rotation z" of a moving point: position, displacement,
   * velocity, angular velocity (x, y, z, inertial axes), rotation (x, y, z: rotation vector from the reference, inertial
   * axes, in degrees), angle (1, 2, 3: the sequence 321 of the rotation from the reference seen in its own reference
   * axes, in degrees). Nothing if the quantity is none of these.
   */
  std::optional<Probe> frame_probe(const std::string                                  &quantity,
                                   const std::function<FrameMotion(const State &)> &motion);

  /** All quantities frame_probe() knows, each with its direction. */
  std::vector<std::string> frame_quantities();

} // namespace samara

#endif
