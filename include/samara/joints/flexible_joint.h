#ifndef samara_joints_flexible_joint_h
#define samara_joints_flexible_joint_h

#include <samara/joints/pair.h>
#include <samara/model/moved.h>
#include <samara/model/relative_motion.h>
#include <samara/model/system.h>

namespace samara
{
  /**
   * Six springs and six dampers between frames A and B, with an optional full matrix: a flexible coupling or bushing.
   * Three of each resist displacements [N/m, N s/m], three rotations [N m/rad, N m s/rad].
   * Strains: the gap in the axes of A, E_iᴬ·Δ [m], and ½ (E_kᴬ·E_jᴮ − E_jᴬ·E_kᴮ), the sine of a rotation about axis i
   * alone [1]. Axis 1 is along "Axis": 1 axial, 2 3 transverse, then torsion about 1, bending about 2 and 3.
   */
  class FlexibleJoint : public Item, public EvaluatedDeformation<FlexibleJoint>, public RelativeMotions, public Connection
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_placed(const Placement &placement) override;
    void be_moved(const MotionOf &motion_of) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    std::vector<Frame> connected_frames() const override;

    unsigned int
    n_strains() const override
    {
      return 6;
    }
    void   strain_rates(const Point<double> &point, double *rates) const override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    void   strain_rows(const Point<double> &point, StrainRows &rows) const override;
    double strain_energy(const double *e) const override;

    /** Those without any stiffness. */
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;
    bool
    is_viscous() const override
    {
      return !C_d.isZero(0.);
    }

    template <typename Number>
    void strains_at(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void stresses_of(const Number *e, const Number *rates, Number *stress) const;
    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** "strain 1" ... "strain 6"; "force 1" ... "force 6", which do work on them: tension positive, of B on A. */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

  private:
    std::string         body_a, body_b, gap = "refused";
    Vector3             position = Vector3::Zero(), axis = Vector3::UnitX(), axis_2 = Vector3::Zero();
    Vector3             stiffness = Vector3::Zero(), rotational_stiffness = Vector3::Zero();
    Vector3             viscosity = Vector3::Zero(), rotational_viscosity = Vector3::Zero();
    std::vector<double> coupling;
    Matrix6             C, C_d;
    Model              *model = nullptr;
    Frame               frame_a, frame_b;
    Block               block;

    void add(const Point<double> &point, const Matrix6 &C, bool geometric, SparseMatrix &matrix) const;
  };

  // instantiated where the templates of the classes are defined
  extern template class Evaluated<FlexibleJoint, Deformation>;
  extern template class EvaluatedDeformation<FlexibleJoint>;
} // namespace samara

#endif
