#ifndef samara_joints_body_contact_h
#define samara_joints_body_contact_h

#include <samara/joints/joint.h>

namespace samara
{
  /**
   * Contact, with friction or without, of a ball of radius R [m], or of an ellipsoid, fixed to body B with its centre
   * at the place of that frame, with a surface of body A. With Δ from "Position" on A to the centre, and the joint axes
   * E of A, the distance is measured by unknowns and rows that are quadratic, so that forces on them do work to
   * round-off:
   *
   *     plane        E₃·Δ − d = 0                                           the distance from the plane
   *     ball         (Δ·Δ − d²)/(2 d₀) = 0                                  from its centre
   *     cylinder     E₁·Δ − a = 0, E₂·Δ − b = 0, (a² + b² − d²)/(2 d₀) = 0  from its axis
   *     ellipsoid    E₃·B_j − m_j = 0, (Σ a_j² m_j² − h²)/(2 h₀) = 0, E₃·Δ − h − d = 0      from its lowest point
   *
   * with the semi-axes a_j along axes B_j of B. One of them may be zero, a disc; with a rounding R it is what a ball of
   * this radius covers whose centre is in the ellipsoid, and touches where d < R: a disc with a round rim, a lens, an
   * egg.
   *
   * and d has a stop, see Layout::Stop. Friction acts against the slip, the velocity of the material of B against that
   * of A at the contact in the tangent plane. It is the rate of unknowns p, by rows for velocities alone, t_i·w − ṗ_i =
   * 0, with directions t
   *
   *     plane        E₁, E₂                            of an ellipsoid, too
   *     ball         E_i − n (n·E_i), i = 1, 2, 3          n = Δ/|Δ|
   *     cylinder     E₃ × n, E₃                            n along the radius to the centre
   *
   * The two forces act at one place between the surfaces: no moment comes from nothing. Stages have triads that are not
   * orthonormal; the power of the forces is that of the slip whatever they are.
   *
   * What rolls and what turns about the normal is resisted in the same way: rates of further unknowns are the angular
   * velocity of B against A along the same directions t, and along the normal. The moments are at most a coefficient
   * times the force that presses times an arm, R or the largest semi-axis with the rounding.
   */
  class BodyContact : public Joint
  {
  public:
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    /**
     * "gap" between the surfaces, negative where they press into each other [m]; "gap rate"; "force", with which they
     * press [N]; with friction "slip" [m/s] and "friction" [N], sizes, and "friction 1, 2, 3", of A on B along the
     * joint axes of A; where rolling or turning is resisted "rolling rate" [rad/s] and "moment" [N m], sizes, and
     * "moment 1, 2, 3" in the same way.
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

  protected:
    enum class Surface
    {
      plane,
      ball,
      cylinder,
      ellipsoid ///< of body B, on a plane of body A
    };

    explicit BodyContact(Surface surface)
      : surface(surface)
    {}

    /** Bind the entries of the two bodies, and all others. */
    void add_entries(Parameters        &prm,
                     const std::string &body_a_is,
                     const std::string &position_is,
                     const std::string &axis_is);

    const Surface surface;

    double      radius = 0, radius_a = 0; ///< [m]; the first of an ellipsoid is its rounding
    std::string side      = "outside";
    Vector3     semi_axes = Vector3::Zero(), axis_b = Vector3::Zero(), axis_b_1 = Vector3::Zero();

    /** Bind the entries of the contact, but for those of its shape. */
    void add_common_entries(Parameters        &prm,
                            const std::string &body_a_is,
                            const std::string &body_b_is,
                            const std::string &position_is,
                            const std::string &axis_is);

  private:
    class Constraints;
    template <typename Number>
    struct Geometry;

    ContactEntries  contact;
    FrictionEntries friction;

    ContactLaw                law;
    FrictionLaw               friction_law;
    double                    touching  = 0;            ///< d where the surfaces touch [m]
    double                    direction = -1;           ///< of d towards penetration
    double                    arm       = 0;            ///< of what resists rolling and turning [m]
    double                    rolling = 0, turning = 0; ///< coefficients [1]
    unsigned int              coordinate = 0;           ///< the first of those that measure; behind them the slips
    unsigned int              n_slips = 0, n_rolls = 0, n_turns = 0;
    std::vector<unsigned int> bristles; ///< numbers of their states

    /**
     * A row that measures an unknown u: F − u − u_less = 0 with a function F of the two frames, or that of a root,
     * (F + Σ w u_j² − u²)/(2 u₀) = 0.
     */
    struct Measure
    {
      std::string name, unit;
      double      start; ///< u₀, in the reference configuration, where the unknown of the model is zero

      std::optional<PairFunction> function{};

      bool                                         is_root = false;
      std::vector<std::pair<unsigned int, double>> squares{}; ///< numbers j, and w
      int                                          less = -1;
    };
    std::vector<Measure> measures; ///< the distance is the last

    unsigned int
    n_measures() const
    {
      return measures.size();
    }
    /** Rates that are resisted. */
    unsigned int
    n_rates() const
    {
      return n_slips + n_rolls + n_turns;
    }

    std::unique_ptr<Constraint> term;
    Block                       own_block; ///< 12 twists, measures and slips, as many multipliers
    ContactTerms                forces;

    void make_term();
    /**
     * Set what follows from the place of the ball, and of the axes of an ellipsoid, in the axes of A, in the reference
     * configuration; complain of it.
     */
    void measure(Model &model, const Vector3 &gaps, const Matrix3 &cosines);
    bool check_entries(Model &model);
    bool check_shape(Model &model);
    void complain(Model &model, const std::string &entry, const std::string &text) const;
    void add_unknowns(Model &model);
    void add_frictions(Layout &layout, unsigned int stop);

    double distance(const State &state) const;
    /** The sum of forces of slips, or of moments, from A on B, in the axes of A. */
    Vector3 resistance_on_b(const State &state, bool is_moment) const;
    double  size_of_rates(const State &state, unsigned int first, unsigned int n) const;
  };



  /** With a plane of body A through "Position", normal to axis 3, which points to the side of the ball. */
  class BallOnPlane : public BodyContact
  {
  public:
    BallOnPlane()
      : BodyContact(Surface::plane)
    {}
    void add_parameters(Parameters &prm) override;
  };



  /** An ellipsoid, or what a ball covers that moves in one, on a plane of body A through "Position", normal to axis 3.
   */
  class EllipsoidOnPlane : public BodyContact
  {
  public:
    EllipsoidOnPlane()
      : BodyContact(Surface::ellipsoid)
    {}
    void add_parameters(Parameters &prm) override;
  };



  /** With another ball, outside of it, or inside of a hollow one. */
  class BallOnBall : public BodyContact
  {
  public:
    BallOnBall()
      : BodyContact(Surface::ball)
    {}
    void add_parameters(Parameters &prm) override;
  };



  /** With a cylinder about axis 3, outside of it, or inside of a hollow one; it has no ends. */
  class BallOnCylinder : public BodyContact
  {
  public:
    BallOnCylinder()
      : BodyContact(Surface::cylinder)
    {}
    void add_parameters(Parameters &prm) override;
  };
} // namespace samara

#endif
