#ifndef samara_model_frame_probe_h
#define samara_model_frame_probe_h

#include <samara/model/frame.h>
#include <samara/model/item.h>

namespace samara
{
  /** What is known of the motion of a point of a body. */
  struct FrameMotion
  {
    Vector3 x, x_reference; ///< [m]
    Matrix3 D, D_reference;
    Vector3 velocity, angular_velocity;         ///< inertial axes [m/s, rad/s]
    Vector3 acceleration, angular_acceleration; ///< inertial axes [m/s², rad/s²]

    /** Of a frame that was at @p x_reference with axes @p D_reference; not accelerated if the state does not know. */
    static FrameMotion
    of(const Frame &frame, const Vector3 &x_reference, const Matrix3 &D_reference, const State &state);

    /**
     * The same as an observer sees it who moves with @p other, in axes that were the inertial ones in the reference
     * configuration: what moves with the observer stays where it was drawn. With Q the turn of the observer, r = x − x₀
     * and ω₀ its angular velocity, x' = x₀ᵣ + Qᵀ r, v' = Qᵀ(v − v₀ − ω₀ × r), a' = Qᵀ(a − a₀ − α₀ × r − ω₀ × (ω₀ × r))
     * − 2 Qᵀω₀ × v'.
     */
    FrameMotion seen_from(const FrameMotion &other) const;
  };

  /** Of a frame, in inertial axes: D (v̇ + Ω × v) [m/s²], then D Ω̇ [rad/s²]; zero if the state does not know them. */
  Vector6 frame_acceleration(const Frame &frame, const State &state);

  /**
   * The probe of a quantity such as "displacement y" or "rotation z" of a moving point: position, displacement,
   * velocity, acceleration, angular velocity and acceleration (x, y, z, inertial axes), rotation (x, y, z: rotation
   * vector from the reference, inertial axes, in degrees), angle (1, 2, 3: the sequence 321 of the rotation from the
   * reference seen in its own reference axes, in degrees). Nothing if the quantity is none of these.
   */
  std::optional<Probe> frame_probe(const std::string                                  &quantity,
                                   const std::function<FrameMotion(const State &)> &motion);

  /** All quantities frame_probe() knows, each with its direction. */
  std::vector<std::string> frame_quantities();

} // namespace samara

#endif
