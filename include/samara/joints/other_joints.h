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
    void be_moved(const MotionOf &motion_of) override;

  protected:
    Matrix3 axes() const override;

    /** What the documentation says of the angle between the axes. */
    virtual std::string
    angle_of_axes() const
    {
      return "at a right angle to the first";
    }

    Vector3 second_axis = Vector3::UnitY();
  };



  /**
   * No relative motion. The two frames keep the position and orientation they have in the reference configuration,
   * however far apart they are. A weld: the frames' nodes are merged and there are no unknowns, unless the reaction is
   * wanted.
   */
  class Rigid : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    /** Of a weld nothing is seen but arms to what is far from its body. */
    void draw(const State &, Drawing &) const override;

    /** None of a weld: its nodes are one. */
    std::vector<Frame> connected_frames() const override;

    std::optional<Probe>    probe(const std::string &path) const override;
    std::shared_ptr<Signal> signal(Model &model, const std::string &path) override;

  private:
    bool reaction_wanted = false;
    bool is_weld         = true;

    /** Throws std::invalid_argument if a force or moment is asked for that is not there. */
    void check_reaction(const std::string &path) const;
  };



  /**
   * A spring, a damper, an actuator between two points: their distance l is an unknown, with what all free motions of
   * joints can have (spring, rest length, damper, force, prescribed length, stops). Its end on A is at Position, where
   * that is given.
   */
  class Spring : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;

    /** The length, and the tilts of a rod. */
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;

    /** "length", "length rate"; "force": tension positive */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  protected:
    void place(Model &model, const Frame &body_a, const Frame &body_b) override;
    void draw(const State &, Drawing &) const override;
  };



  /**
   * A massless rod with a ball joint at each end: |Δ|² = L² for the gap Δ between the frames; that of A is at Position,
   * where that is given. With the multiplier λ the tension in it is 2 L λ [N].
   */
  class Distance : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;

    /** The tilts of the rod. */
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;

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
   * A gear between the rotations of two joints that share a housing: θ_B = n θ_A. The axes may point anywhere; the
   * moments on both shafts and on the housing follow from the joints' own reactions.
   *
   * With a backlash b [rad], which B can turn by while A is held, the teeth touch by a law: δ = θ_B − n θ_A is an
   * unknown, and two stops of it press back where |δ| > b/2. In the reference configuration it is in the middle.
   *
   * With an efficiency η the teeth rub, as a moment (1/η − 1) |n M| against θ̇_A, M the moment on B. So η of the power
   * arrives at B where A drives, 2 − 1/η of it at A where B drives: below one half B cannot drive. Teeth slide to and
   * fro about the pitch point; this is their mean over the teeth that mesh.
   */
  class Gear : public Item, public Evaluated<Gear, Constraint>
  {
  public:
    std::string
    noun() const override
    {
      return "gear";
    }

    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void rates(const Point<double> &point, double *rates) const override;

    /** None: it is linear in the coordinates. */
    void
    second_rates(const Point<double> &, double *) const override
    {}

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    std::string    joint_a, joint_b;
    double         ratio = 1, backlash = 0;
    double         efficiency = 1, pitch_radius = 0, sticking_speed = 1e-4; ///< [1], [m], [m/s]
    ContactEntries mesh;
    ContactLaw     law;
    bool           has_backlash   = false;
    unsigned int   coordinates[3] = {0, 0, 0}, multiplier = 0; ///< of A, of B, δ
    unsigned int   row = 2;                                    ///< of the multiplier in the block
    Block          block;
    ContactTerms   teeth;

    void check_efficiency(Model &model) const;
    void add_friction(Layout &layout);
  };

  // instantiated where the templates of the classes are defined
  extern template class Evaluated<Gear, Constraint>;
} // namespace samara

#endif
