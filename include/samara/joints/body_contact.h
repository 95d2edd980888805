#ifndef samara_joints_body_contact_h
#define samara_joints_body_contact_h

#include <samara/joints/joint.h>

namespace samara
{
  /**
   * Contact, with friction or without, of a ball of radius R [m], fixed to body B with its centre at the place of that
   * frame, with a surface of body A. With Δ from "Position" on A to the centre, and the joint axes E of A, the distance
   * is measured by unknowns and rows that are quadratic, so that forces on them do work to round-off:
   *
   *     plane        E₃·Δ − d = 0                                           the distance from the plane
   *     ball         (Δ·Δ − d²)/(2 d₀) = 0                                  from its centre
   *     cylinder     E₁·Δ − a = 0, E₂·Δ − b = 0, (a² + b² − d²)/(2 d₀) = 0  from its axis
   *
   * and d has a stop, see Layout::Stop. Friction acts against the slip, the velocity of the material of B against that
   * of A at the contact in the tangent plane. It is the rate of unknowns p, by rows for velocities alone, t_i·w − ṗ_i =
   * 0, with directions t
   *
   *     plane        E₁, E₂
   *     ball         E_i − n (n·E_i), i = 1, 2, 3          n = Δ/|Δ|
   *     cylinder     E₃ × n, E₃                            n along the radius to the centre
   *
   * The two forces act at one place between the surfaces: no moment comes from nothing. Stages have triads that are not
   * orthonormal; the power of the forces is that of the slip whatever they are.
   */
  class BodyContact : public Joint
  {
  public:
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    /**
     * "gap" between the surfaces, negative where they press into each other [m]; "gap rate"; "force", with which they
     * press [N]; with friction "slip" [m/s] and "friction" [N], sizes, and "friction 1, 2, 3", of A on B along the
     * joint axes of A.
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

  protected:
    enum class Surface
    {
      plane,
      ball,
      cylinder
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

    double      radius = 0, radius_a = 0;
    std::string side = "outside";

  private:
    class Constraints;
    template <typename Number>
    struct Geometry;

    ContactEntries  contact;
    FrictionEntries friction;

    ContactLaw   law;
    FrictionLaw  friction_law;
    Vector3      start      = Vector3::Zero(); ///< a, b, d in the reference configuration; of a plane or ball the last
    double       touching   = 0;               ///< d where the surfaces touch [m]
    double       direction  = -1;              ///< of d towards penetration
    unsigned int coordinate = 0;               ///< the first of those that measure; behind them the slips
    unsigned int n_measures = 1, n_slips = 0;

    std::unique_ptr<Constraint> term;
    Block                       own_block; ///< 12 twists, measures and slips, as many multipliers
    ContactTerms                forces;

    void make_term();
    /** Set what follows from the place of the ball, in the axes of A, in the reference configuration; complain of it.
     */
    void measure(Model &model, const Vector3 &gaps);
    bool check_entries(Model &model);

    double  distance(const State &state) const;
    Vector3 friction_on_b(const State &state) const;
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
