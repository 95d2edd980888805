#ifndef samara_joints_point_on_curve_h
#define samara_joints_point_on_curve_h

#include <samara/joints/guide_curve.h>
#include <samara/joints/joint.h>

namespace samara
{
  /**
   * A point of B stays on a curve that is fixed to A: with the joint axes E, of which "Axis" is the third, Δ from the
   * place of the model's origin in the reference configuration, and the components of the curve there,
   *
   *     E_iᴬ·Δ − c_i(σ) = 0,   i = 1, 2, 3
   *
   * and the arc length σ [m] as an unknown. Rotations are free. The curve is given by "Expressions" x, y, z of s from 0
   * to 1, in the reference configuration; the point must be on it there. Beyond the ends of a curve that is not closed
   * it goes on straight. Constraints are not quadratic: their forces get the correction along σ, and do no work.
   *
   * "displacement" is the arc length from where the point is in the reference configuration, "arc length" that from the
   * start of the curve; "force 1, 2, 3" is that of A on B along the joint axes of A, "force" its size. Along the curve
   * there is none.
   */
  class PointOnCurve : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    std::optional<unsigned int> use_coordinate(Model &model, const std::string &motion) override;
    std::shared_ptr<Signal>     signal(Model &model, const std::string &path) override;
    void                        add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;

    /** "displacement", "displacement rate", "arc length"; "force", "force 1" ... "force 3" */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

  private:
    class Constraints;

    std::array<Expression, 3>         expressions;
    std::unique_ptr<const GuideCurve> curve;
    std::unique_ptr<Constraint>       term;
    Matrix3                           E          = Matrix3::Identity(); ///< joint axes in the reference configuration
    double                            start      = 0;                   ///< σ in the reference configuration [m]
    unsigned int                      coordinate = 0;
    Block                             own_block; ///< 12 twists, the coordinate, 3 multipliers

    /** On the curve, along the joint axes. */
    GuideCurve::At at(double sigma) const;

    /** That of A on B along the joint axes [N]. */
    Vector3 force(const State &state) const;
  };
} // namespace samara

#endif
