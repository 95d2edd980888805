#ifndef samara_joints_point_on_curve_h
#define samara_joints_point_on_curve_h

#include <samara/joints/guide_curve.h>
#include <samara/joints/joint.h>
#include <samara/joints/vector_friction.h>

namespace samara
{
  /**
   * A point of B stays on a curve that is fixed to A: with the joint axes E, of which "Axis" is the third, Δ from where
   * the point is in the reference configuration, and the components of the curve from there,
   *
   *     E_iᴬ·Δ − c_i(σ) = 0,   i = 1, 2, 3
   *
   * and the arc length σ [m] as an unknown. Rotations are free. The curve is given by "Expressions" x, y, z of s from 0
   * to 1, in the reference configuration; the point must be on it there. Beyond the ends of a curve that is not closed
   * it goes on straight. Constraints are not quadratic: their forces get the correction along σ, and do no work.
   *
   * "displacement" is the arc length from where the point is in the reference configuration, "arc length" that from the
   * start of the curve; "force 1, 2, 3" is that of A on B along the joint axes of A, "force" its size. Along the curve
   * there is none but friction.
   *
   * Subsection "displacement" holds the friction along the curve, which is pressed by what of the force is across it;
   * "rotation" that against all rotations, as of a ball joint, which is pressed by all of the force.
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

    /** @name What presses along the curve is across its tangent where the point is. @{ */
    bool
    presses(const Layout::Friction &friction) const override
    {
      return friction.multipliers.front() == first_multiplier && friction.coordinates.front() == coordinate;
    }
    PressingParts<double> pressing_parts(const Layout::Friction &friction, const Point<double> &point) const override;
    PressingParts<std::complex<double>> pressing_parts(const Layout::Friction            &friction,
                                                       const Point<std::complex<double>> &point) const override;
    /** @} */

  private:
    class Constraints;

    std::array<Expression, 3>         expressions;
    std::unique_ptr<const GuideCurve> curve;
    std::unique_ptr<Constraint>       term;
    Matrix3                           E          = Matrix3::Identity(); ///< joint axes in the reference configuration
    double                            start      = 0;                   ///< σ in the reference configuration [m]
    Vector3                           origin     = Vector3::Zero();     ///< the point of the curve there [m]
    unsigned int                      coordinate = 0;
    Block                             own_block; ///< 12 twists, the coordinate, 3 multipliers

    FrictionEntries           friction; ///< along the curve
    FrictionLaw               friction_law;
    std::vector<unsigned int> bristles; ///< one state, or none
    ContactTerms              rubbing;
    VectorFriction            ball{VectorFriction::Of::ball};

    void add_friction_along(Layout &layout);
    template <typename Number>
    PressingParts<Number> parts_at(const Point<Number> &point) const;

    /** On the curve, from where the point is in the reference configuration, along the joint axes. */
    GuideCurve::At at(double sigma) const;

    /** That of A on B along the joint axes [N]. */
    Vector3 force(const State &state) const;
  };
} // namespace samara

#endif
