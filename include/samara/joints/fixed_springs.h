#ifndef samara_joints_fixed_springs_h
#define samara_joints_fixed_springs_h

#include <samara/joints/pair.h>
#include <samara/model/relative_motion.h>
#include <samara/model/system.h>

namespace samara
{
  /**
   * Three springs and dampers between a point of A and a point of B along axes E that are fixed in space, however the
   * bodies turn:
   *
   *     e_i = E_i·(Δ − Δ₀)      Δ from A to B, Δ₀ that of the reference configuration
   *
   * The force on B is −Σ k_i e_i E_i, on A the opposite; each acts at its point, so that the two have a moment where Δ
   * is not along them: something that does not turn holds the axes. Rotations have no spring.
   */
  class FixedSprings : public Item, public EvaluatedDeformation<FixedSprings>, public RelativeMotions
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_placed(const Placement &placement) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    unsigned int
    n_strains() const override
    {
      return 3;
    }
    void   strain_rates(const Point<double> &point, double *rates) const override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    void   strain_rows(const Point<double> &point, StrainRows &rows) const override;
    double strain_energy(const double *e) const override;
    bool
    is_viscous() const override
    {
      return !viscosity.isZero(0.);
    }

    template <typename Number>
    void strains_at(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void stresses_of(const Number *e, const Number *rates, Number *stress) const;
    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** "strain 1" ... "strain 3"; "force 1" ... "force 3", which do work on them: of B on A, tension positive. */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

  private:
    std::string body_a, body_b;
    Vector3 axis = Vector3::UnitX(), axis_2 = Vector3::Zero(), stiffness = Vector3::Zero(), viscosity = Vector3::Zero();
    Matrix3 E         = Matrix3::Identity(); ///< axes as columns
    Vector3 reference = Vector3::Zero();     ///< Δ₀ [m]
    Frame   frame_a, frame_b;
    Model  *model = nullptr;
    Block   block;

    /** The three rows of B. */
    Eigen::Matrix<double, 3, 12> gradients(const double *q) const;
  };

  // instantiated where the templates of the class are defined
  extern template class Evaluated<FixedSprings, Deformation>;
  extern template class EvaluatedDeformation<FixedSprings>;
} // namespace samara

#endif
