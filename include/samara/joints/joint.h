#ifndef samara_joints_joint_h
#define samara_joints_joint_h

#include <samara/joints/angle.h>
#include <samara/joints/contact_entries.h>
#include <samara/joints/contact_terms.h>
#include <samara/joints/pair.h>
#include <samara/model/moved.h>
#include <samara/model/pressing.h>
#include <samara/model/relative_motion.h>
#include <samara/model/response.h>

#include <array>
#include <cmath>
#include <limits>
#include <list>

namespace samara
{
  /**
   * A relative motion that a joint leaves free: a displacement d along, or a rotation θ about, an axis of frame A. It
   * becomes an unknown of the system only if something uses it: a spring, a damper, a stop, a force, a prescribed
   * motion, a gear.
   */
  struct FreeMotion
  {
    std::string name, unit; ///< "rotation" in rad, "displacement" in m

    /** The functions that tell it: d is the first; θ = atan2(second, first); l is the root of the first. */
    PairFunction first, second;
    double       reference = 0; ///< of a length: its value in the reference configuration, where the coordinate is zero
    unsigned int axis      = 2; ///< joint axis along or about which the force or moment of this motion acts
    bool         is_on_b   = false;  ///< whether that is an axis of B, not of A
    bool         is_on_both = false; ///< of an angle: whether it is an axis of both, as of a hinge

    // entries
    double          spring = 0, rest = 0, damper = 0;
    double          lower_stop = 0, upper_stop = 0;
    bool            has_lower_stop = false, has_upper_stop = false;
    ContactEntries  stop;
    FrictionEntries friction;
    Law             force, prescribed, spring_law, damping;
    bool            is_prescribed = false;
    bool            may_rub       = true; ///< whether it knows dry friction

    ContactLaw  stop_law;     ///< what the entries of the stops say
    FrictionLaw friction_law; ///< what those of friction say

    /** Of the force and of what is prescribed, where they depend on the model's state. */
    std::unique_ptr<Response> response, drive;

    std::unique_ptr<SpringLaw> nonlinear_spring;

    /** What is prescribed there, and its rate. */
    template <typename Number>
    Number
    prescribed_at(const Point<Number> &point) const
    {
      return point.factor * (drive ? (*drive)(point) : Number(prescribed.of_time()(point.time)));
    }
    double
    prescribed_rate(const Point<double> &point) const
    {
      return point.factor * (drive ? drive->rate(point) : prescribed.of_time().derivative(point.time));
    }

    /** Of a function of time alone; NaN of a law of states. */
    double
    prescribed_second_rate(const Point<double> &point) const
    {
      return drive ? std::numeric_limits<double>::quiet_NaN() :
                     point.factor * prescribed.of_time().second_derivative(point.time);
    }

    int coordinate = -1; ///< its number in the model, negative while nothing uses it
    int bristles   = -1; ///< number of the state that is the deflection of those of its friction; negative: none

    /** Further unknowns of the slip that its friction acts against, and the states of their bristles. @{ */
    std::vector<unsigned int> beside, bristles_beside;
    /** @} */

    /** Give bristles a state if the friction has them; @p joint: its name. */
    void add_bristles(Model &model, const std::string &joint);

    bool
    is_angle() const
    {
      return first.kind == PairFunction::cosine;
    }
    bool
    is_length() const
    {
      return first.kind == PairFunction::squared_distance;
    }
    /** How the coordinate's force enters the constraint that measures it, ∂g/∂d = −lever; l/L for lengths. */
    template <typename Number>
    Number
    lever(const Number &coordinate) const
    {
      return is_length() ? Number((reference + coordinate) / reference) : Number(1);
    }

    /** The constraint that measures the coordinate, g(first, second, coordinate) = 0. */
    template <typename Number>
    Number measure(const PairValues<Number> &pair, const Number &coordinate) const;

    /** Its derivatives; those not among them are zero. */
    template <typename Number>
    struct Derivatives
    {
      Number slope, curvature;                         ///< ∂g/∂coordinate, ∂²g/∂coordinate²
      Number first, second;                            ///< ∂g/∂first, ∂g/∂second
      Number first_first, first_second, second_second; ///< ∂²g/∂first², …
    };
    template <typename Number>
    Derivatives<Number> derivatives(const PairValues<Number> &pair, const Number &coordinate) const;

    /**
     * Add the forces of the multiplier @p lambda of this constraint to those of the pair; returns its force along the
     * coordinate. In reciprocal axes an angle is no function of places: its moment acts about its axis, and θ̇ is the
     * angular velocity of B against A about it.
     */
    template <typename Number>
    Number add_forces(const PairValues<Number> &pair,
                      const Number             &coordinate,
                      const Number             &lambda,
                      PairForces<Number>       &forces) const;

    /**
     * The rate of the constraint while the pair moves with @p change and the coordinate with @p coordinate_rate; @p
     * turns: in a stage whose forces are seen in reciprocal axes.
     */
    double rate(const PairValues<double> &pair,
                const PairRates          &change,
                double                    coordinate,
                double                    coordinate_rate,
                bool                      turns) const;

    /** The angle between −π and π at which the two frames are. */
    template <typename Number>
    Number
    angle(const PairValues<Number> &pair) const
    {
      return angle_of(first.value(pair), second.value(pair));
    }

    void add_parameters(Parameters &prm);

    /**
     * See which of the entries were given, and complain about stops that make no sense, and of what would do nothing.
     * @p stops_at_ends: whether the ends of a beam are stops.
     */
    void check_parameters(const Parameters &prm, Complaints &complaints, bool stops_at_ends = false);
    bool is_used() const;
  };



  template <typename Number>
  Number
  FreeMotion::measure(const PairValues<Number> &pair, const Number &coordinate) const
  {
    if (is_angle())
      return less_turns(coordinate - angle(pair));
    const Number f = first.value(pair);
    if (!is_length())
      return f - coordinate;
    const Number l = coordinate + reference;
    return 0.5 / reference * (f - l * l);
  }



  template <typename Number>
  FreeMotion::Derivatives<Number>
  FreeMotion::derivatives(const PairValues<Number> &pair, const Number &coordinate) const
  {
    if (is_length())
      return {-lever(coordinate), -1 / reference, 0.5 / reference, 0, 0, 0, 0};
    if (!is_angle())
      return {-1, 0, 1, 0, 0, 0, 0};
    // of −atan2(s, c); triads of stages are not orthonormal: c² + s² is not one
    const Number c = first.value(pair), s = second.value(pair), square = c * c + s * s, fourth = square * square;
    return {1, 0, s / square, -c / square, -2. * s * c / fourth, (c * c - s * s) / fourth, 2. * s * c / fourth};
  }



  template <typename Number>
  Number
  FreeMotion::add_forces(const PairValues<Number> &pair,
                         const Number             &coordinate,
                         const Number             &lambda,
                         PairForces<Number>       &forces) const
  {
    if (is_angle() && pair.is_reciprocal())
      {
        if (!is_on_both)
          return add_forces(pair.for_angles(), coordinate, lambda, forces);
        forces.moment_a(axis) += lambda;
        forces.moment_b(axis) -= lambda;
        return lambda;
      }
    const auto of = derivatives(pair, coordinate);
    forces.add(first, pair, lambda * of.first);
    if (is_angle())
      forces.add(second, pair, lambda * of.second);
    return lambda * of.slope;
  }



  /**
   * The frames of the entries "Body A" and "Body B" of a joint; nothing, after a complaint, if they are missing,
   * unknown or on the same body.
   */
  std::optional<std::array<Frame, 2>>
  ends_of_joint(Model &model, const Item &joint, const std::string &body_a, const std::string &body_b);

  /**
   * Complain if both entries name a point, the two points are apart in the reference configuration, and neither a
   * "Position" says where the joint is nor @p gap is "allowed". A body without a point, the centre of a rigid body, and
   * the ground do not say where.
   */
  void check_gap(Model                      &model,
                 const Item                 &joint,
                 const std::array<Frame, 2> &ends,
                 const std::string          &body_a,
                 const std::string          &body_b,
                 const std::string          &gap);

  /** What the entry "Gap" says, for its declaration. */
  extern const char *const documentation_of_gap;

  /** Whether the two frames are still on different nodes after welding; complains otherwise. */
  bool check_ends(Model &model, const Item &joint, const Frame &a, const Frame &b, const std::string &between);



  /**
   * What all joints between two frames A and B have in common (the paper, section 2.2; doc/theory/joints.md).
   *
   * In the reference configuration both frames are at the same place with the same axes E₁ E₂ E₃; a kind of joint says
   * which functions of them stay zero and which relative motions are free, and nothing more. Relative motions are those
   * of B seen from A. Multipliers are, but for their signs, the forces [N] and moments [N m] that hold A and B
   * together.
   *
   * Rows of the residual, one a multiplier, in this order:
   *
   *     locked            function − its reference value = 0
   *     free d, used      E_iᴬ·Δ − d = 0
   *     free l, used      (Δ·Δ − l²)/(2 L) = 0, L the length in the reference configuration, l − L the coordinate
   *     free θ, used      θ − atan2(s, c) less whole turns = 0 with c = cosθ, s = sinθ from the axes of A and B
   *     prescribed        d − f(t) = 0, θ − f(t) = 0
   *     screw             d − p θ = 0
   *     no slip           0; b·y = 0 is a constraint on velocities alone, its tangent row is b
   *
   * Terms: these constraints; the forces along the motions in use; those of nonlinear springs, which have a
   * potential; springs, dampers and stops, with the strains d − rest of the motions in use, then d − stop of their
   * stops, 0 while the stop is not touched; contacts that are not linear, and friction. In time steps of the integrator
   * family Layout::stops and Layout::frictions stand for them.
   */
  class Joint : public Item, public RelativeMotions, public Connection, public HasPressing
  {
  public:
    std::string
    noun() const override
    {
      return "joint";
    }

    void               add_parameters(Parameters &prm) override;
    void               be_placed(const Placement &placement) override;
    void               be_moved(const MotionOf &motion_of) override;
    void               initialize(Model &model) override;
    void               find_signals(Model &model) override;
    void               connect(Layout &layout) override;
    std::vector<Frame> connected_frames() const override;

    /** Whether bodies are to be moved until the two points of the joint meet: it says so, or the model of all joints.
     */
    bool closes_gap() const;

    std::optional<unsigned int> use_coordinate(Model &model, const std::string &motion) override;
    std::vector<std::string>    rotation_names() const override;

    /** The free motions by name, and their rates: "rotation", "rotation rate"; forces and moments as of probes. */
    std::shared_ptr<Signal> signal(Model &model, const std::string &path) override;

    /** Those of all free motions. */
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;

    /**
     * The free motions by name; "force 1" ... "moment 3", with which A acts on B along and about the axes of A that are
     * locked or in use. (Where a single rotation is locked its moment is about its own axis, normal to both of its
     * directions; moments of used rotations are about theirs.)
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    /**
     * @name Edge pressure. A guide of the length L on B, about its origin and along axis 3, takes the force F and the
     * moment M as two forces at its ends,
     *
     *     F/2 ± M × E₃/L
     *
     * each of which presses for its friction. @{
     */
    bool                  presses(const Layout::Friction &friction) const override;
    PressingParts<double> pressing_parts(const Layout::Friction &friction, const Point<double> &point) const override;
    PressingParts<std::complex<double>> pressing_parts(const Layout::Friction            &friction,
                                                       const Point<std::complex<double>> &point) const override;
    /** @} */

  protected:
    /** @name What a kind of joint says in add_parameters() @{ */
    struct Locked
    {
      PairFunction function;
      std::string  name;
      double       value = 0;  ///< that it keeps
      unsigned int axis  = 0;  ///< joint axis of its force or moment
      double       sign  = -1; ///< of the force or moment of A on B when the multiplier is positive

      /** A second function that is taken from the first one; their moment is about no single axis. */
      std::optional<PairFunction> less = {};

      template <typename Number>
      Number
      measure(const PairValues<Number> &pair) const
      {
        return less ? Number(function.value(pair) - less->value(pair)) : function.value(pair);
      }
      template <typename Number>
      void
      add_forces(const PairValues<Number> &pair, const Number &multiplier, PairForces<Number> &forces) const
      {
        forces.add(function, pair, multiplier);
        if (less)
          forces.add(*less, pair, Number(-multiplier));
      }
    };
    struct NoSlip
    {
      PairVelocity velocity; ///< that stays zero
      std::string  name;
      unsigned int axis = 0; ///< joint axis of its force
    };
    std::vector<Locked>   locked;
    std::list<FreeMotion> free; // parameters keep references to what is in it
    std::vector<NoSlip>   no_slip;

    void lock_displacement(unsigned int axis);
    /** Keep E_iᴬ normal to E_jᴮ. */
    void lock_rotation(unsigned int i, unsigned int j);
    /** Keep E₁ᴬ·E₂ᴮ and E₂ᴬ·E₁ᴮ the same: no twist about E₃, however that bends. */
    void        lock_twist();
    FreeMotion &free_displacement(unsigned int axis, const std::string &name = "displacement");
    FreeMotion &free_rotation_about_3(const std::string &name = "rotation");
    /** @} */

    /** Bind the entries of the two bodies and the position, those of the free motions; add_parameters() does both. */
    void add_ends(Parameters &prm);
    void add_motions(Parameters &prm);
    /** Of kinds whose axis 3 of B may only go along that of A. */
    void add_bearing_length(Parameters &prm);
    /** Complain of one that nothing uses. */
    void check_bearing_length(Model &model) const;

    /** The same for what goes from a point of A to a point of B: "Position" is that of its end on A. */
    void add_two_points(Parameters &prm);

    /** The joint's axes in the reference configuration; by default E₃ along "Axis". */
    virtual Matrix3 axes() const;

    /** Where the two frames are in the reference configuration; by default both at "Position" with axes(). */
    virtual void place(Model &model, const Frame &body_a, const Frame &body_b);

    /** Both frames as they are drawn: each at its own point, along its own axis. */
    void place_apart(Model &model, const Frame &body_a, const Frame &body_b);

    /** Whether "Position" is that of the end on B of a gap to be closed: it alone is not named. */
    bool position_is_on_b() const;

    /** Complain of an <Axis on B> that is not parallel to <Axis> where no assembly has made it so. */
    void check_axis_on_b(Model &model) const;

    /** Where the end on A is of what add_two_points() declares. */
    Frame end_on_a(const Model &model, const Frame &body_a) const;

    /** @name For add_relative_rates() @{ */
    /** The tilts of the line between the two frames, against A and against B: what a rod with balls at its ends has. */
    void add_tilts(const double *q, std::vector<RelativeRate> &rates) const;
    /** The three rotations of a ball joint, about axes of A through the origin of B. */
    void add_turns(const double *q, std::vector<RelativeRate> &rates) const;
    /** Those about the first @p n axes of a frame @p a. */
    void add_turns(const Frame &a, unsigned int n, const double *q, std::vector<RelativeRate> &rates) const;
    /** @} */

    std::string body_a, body_b, gap = "refused";
    Vector3     position = Vector3::Zero(), axis = Vector3::UnitZ(), axis_1 = Vector3::Zero();
    Vector3     axis_on_b = Vector3::Zero(); ///< where the drawing of B is turned

    /** d = pitch θ for the first free displacement and rotation, if not zero [m/rad]. */
    double pitch          = 0;
    bool   is_screw       = false;
    double draw_size      = 0.05;
    double bearing_length = 0; ///< [m]; 0: what presses are forces alone

    Frame        frame_a, frame_b;
    unsigned int first_multiplier = 0;

    /**
     * Whether the rows of the place are in the axes of B, E_iᴮ·Δ: where A is the ground they turn with B then, and what
     * they transmit in steady rotation is constant. What is told of it stays in the axes of A.
     */
    bool rows_on_b = false;
    bool
    is_row_on_b(const Locked &l) const
    {
      return rows_on_b && l.function.kind == PairFunction::gap;
    }
    /** The pair seen from B, for these rows: E_iᴮ·Δ is less the gap i of it. */
    template <typename Number>
    PairValues<Number>
    seen_from_b(const Point<Number> &point) const
    {
      return {frame_b, frame_a, point.q, point.q_of_forces(), false};
    }

    Model *model = nullptr;

    /** @name Parts of draw(), for kinds with shapes of their own @{ */
    /** Thin bars from the origins of what is joined to the joint, where these are far from it; bodies are held there.
     */
    void draw_arms(const State &state, Drawing &drawing) const;
    /**
     * What A gets from B, as far as probes know it, at all samples from @p first on: "joint force" [N], "joint moment"
     * [N m], inertial axes. @p a: frame A.
     */
    void draw_reaction(const State &state, const Sample &a, unsigned int first, Drawing &drawing) const;
    /** @} */

    /** @name For kinds with rows of their own, in whose connect() @{ */
    Block                     block; ///< local unknowns: 12 twists of the nodes, used coordinates, multipliers
    std::vector<FreeMotion *> used;
    std::vector<std::string>  rows; ///< names of the multipliers

    void add_stops(Layout &layout);
    /** Springs, dampers and forces along the motions in use, whose rows stand in the block behind the twists. */
    void add_springs(Layout &layout);
    /** By the forces of rows that hold a displacement, and the preload. */
    void add_friction(Layout &layout);
    /** The multipliers that press; of a guide with a length those of its tilts, too, behind the forces. */
    virtual void add_pressing(std::vector<unsigned int> &multipliers) const;
    void         complain(Model &model, const std::string &entry, const std::string &text) const;
    /** @} */

  private:
    /** A spring and damper with constant coefficients that act on a motion beyond the place of the stop. */
    struct Stop
    {
      unsigned int motion;      ///< number among those used
      double       place, side; ///< [m] or [rad]; side 1 for an upper stop, -1 for a lower one
    };

    // the terms
    class Constraints;
    class Springs;
    class Actuators;
    class NonlinearSprings;
    class Reaction;
    std::unique_ptr<Constraint>  constraints;
    std::unique_ptr<Deformation> springs;
    std::unique_ptr<Force>       actuators, nonlinear_springs;

    unsigned int      first_row      = 0;     ///< of the multipliers in the residual
    bool              with_axes_of_b = false; ///< whether any function needs them
    std::vector<Stop> stops;                  ///< linear ones
    ContactTerms      contacts;

    /** What acts along (force) or about (moment) joint axis @p axis; nothing if nothing does. */
    std::function<double(const State &)> action(bool is_moment, unsigned int axis) const;

    /** The same as a signal. Made before multipliers have numbers. */
    std::shared_ptr<Signal> reaction(bool is_moment, unsigned int axis);
    /** The tension between two points, of a spring or a rod. */
    std::shared_ptr<Signal> tension();

    void find_nonlinear_spring(Model &model, FreeMotion &motion);
    void check_friction(Model &model, const FreeMotion &motion);
    void number_rows(Layout &layout);
    void add_constraints(Layout &layout);
    void add_nonlinear_springs(Layout &layout);

    double angle_or_gap(const FreeMotion &motion, const State &state) const;
  };
} // namespace samara

#endif
