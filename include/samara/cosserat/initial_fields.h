#ifndef samara_cosserat_initial_fields_h
#define samara_cosserat_initial_fields_h

#include <samara/base/function_of_time.h>
#include <samara/model/initial_motion.h>
#include <samara/model/model.h>

#include <array>

namespace samara
{
  /**
   * How a beam starts to move, and how it is deformed at the start of a motion: fields of its arc length s [m] in the
   * reference configuration, with inertial components.
   *
   *     Velocity field v(s), Angular velocity field ω(s)    in addition to the rigid motion of InitialVelocity
   *     Displacement field u(s), Rotation field θ(s)        rotation vectors
   *
   * Where rotations are not given, sections stay normal to the line: with the tangent t of the present line, ω = t ×
   * dv/ds, and θ is the smallest rotation from t to t + du/ds. At a node that is welded to the ground the fields must
   * vanish.
   */
  struct InitialFields
  {
    std::array<Expression, 3> velocity, angular_velocity, displacement, rotation;

    void add_parameters(Parameters &prm);

    /** Complain about fields that move what is welded to the ground; @p frames are resolved, at the @p abscissae [m].
     */
    void check(const std::vector<Frame>  &frames,
               const std::vector<double> &abscissae,
               const Item                &body,
               Complaints                &complaints) const;

    /** See InitialMotion; @p tangents are those of the line at the frames, in the state. */
    void add_places(const std::vector<Frame>                     &frames,
                    const std::vector<double>                    &abscissae,
                    const std::vector<Vector3>                   &tangents,
                    const Item                                   &body,
                    const State                                  &state,
                    std::map<unsigned int, InitialMotion::Place> &places) const;
    void add_twists(const std::vector<Frame>        &frames,
                    const std::vector<double>       &abscissae,
                    const std::vector<Vector3>      &tangents,
                    const Item                      &body,
                    const State                     &state,
                    std::map<unsigned int, Vector6> &twists) const;
  };
} // namespace samara

#endif
