#ifndef samara_joints_other_joints_h
#define samara_joints_other_joints_h

#include <samara/joints/joint.h>

namespace samara
{
  /**
   * Two revolutes with axes that meet at a right angle: axis 1 of A along "Axis", axis 2 of B along "Second axis".
   * "rotation 1" is about the first, "rotation 2" about the second.
   */
  class Universal : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;

  protected:
    Matrix3 axes() const override;

  private:
    Vector3 second_axis = Vector3::UnitY();
  };



  /**
   * No relative motion. The two frames keep the position and orientation they have in the reference configuration, however
   * far apart they are. A weld: the frames' nodes are merged and there are no unknowns, unless the reaction is wanted.
   */
  class Rigid : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    void draw(const State &, Drawing &) const override;

    std::optional<Probe> probe(const std::string &path) const override;

    // a weld is gone after the nodes are merged
    void residual(const Point<double> &point, double *r) const override;
    void residual(const Point<std::complex<double>> &point, std::complex<double> *r) const override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;
    void constraint_rates(const Point<double> &point, double *rates) const override;

  private:
    bool reaction_wanted = false;
  };



  /**
   * A spring, a damper, an actuator between two points: their distance l is an unknown, with what all free motions of
   * joints can have (spring, rest length, damper, force, prescribed length, stops). If body A is the ground, Position says
   * where the spring hangs.
   */
  class Spring : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;

    /** "length", "length rate"; "force": tension positive */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  protected:
    void place(Model &model, const Frame &body_a, const Frame &body_b) override;
    void draw(const State &, Drawing &) const override;
  };



  /**
   * A massless rod with a ball joint at each end: |Δ|² = L² for the gap Δ between the frames. With the multiplier λ the
   * tension in it is 2 L λ [N].
   */
  class Distance : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;

    /** "force": axial, tension positive */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  protected:
    void place(Model &model, const Frame &body_a, const Frame &body_b) override;
    void draw(const State &, Drawing &) const override;

  private:
    double length = 0;
  };



  /**
   * A gear between the rotations of two joints that share a housing: θ_B = n θ_A. The axes may point anywhere; the moments
   * on both shafts and on the housing follow from the joints' own reactions.
   */
  class Gear : public Evaluated<Gear>
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void constraint_rates(const Point<double> &point, double *rates) const override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    std::string  joint_a, joint_b;
    double       ratio = 1;
    unsigned int coordinates[2] = {0, 0}, multiplier = 0;
    Block        block;
  };



  /**
   * Six springs and six dampers between frames A and B, with an optional full matrix: a flexible coupling or bushing.
   * Three of each resist displacements [N/m, N s/m], three rotations [N m/rad, N m s/rad].
   * Strains: the gap in the axes of A, E_iᴬ·Δ [m], and ½ (E_kᴬ·E_jᴮ − E_jᴬ·E_kᴮ), the sine of a rotation about axis i
   * alone [1]. Axis 1 is along "Axis": 1 axial, 2 3 transverse, then torsion about 1, bending about 2 and 3.
   */
  class FlexibleJoint : public Evaluated<FlexibleJoint>
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    unsigned int
    n_strains() const override
    {
      return 6;
    }
    void   strain_rates(const Point<double> &point, double *rates) const override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    double strain_energy(const double *e) const override;
    bool
    has_damping() const override
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
    std::string         body_a, body_b;
    Vector3             position = Vector3::Zero(), axis = Vector3::UnitX(), axis_2 = Vector3::Zero();
    Vector3             stiffness = Vector3::Zero(), rotational_stiffness = Vector3::Zero();
    Vector3             viscosity = Vector3::Zero(), rotational_viscosity = Vector3::Zero();
    std::vector<double> coupling;
    Matrix6             C, C_d;
    Model              *model = nullptr;
    Frame               frame_a, frame_b;
    Block               block;

    /** The functions of strain i with their factors; rotations are the difference of two. */
    static std::vector<std::pair<double, PairFunction>> functions(unsigned int i);

    template <typename Number>
    Eigen::Matrix<Number, 6, 12> gradients(const PairValues<Number> &pair) const;
    void                         add(const Point<double> &point, const Matrix6 &C, bool geometric, SparseMatrix &K) const;
  };

  // instantiated where the templates of the classes are defined
  extern template class Evaluated<Gear>;
  extern template class Evaluated<FlexibleJoint>;
} // namespace samara

#endif
