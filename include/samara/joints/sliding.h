#ifndef samara_joints_sliding_h
#define samara_joints_sliding_h

#include <samara/joints/joint.h>
#include <samara/joints/rail.h>
#include <samara/joints/thread_friction.h>
#include <samara/joints/vector_friction.h>
#include <samara/model/bends.h>
#include <samara/model/doubts.h>

namespace samara
{
  /**
   * A frame of B slides along a flexible beam A, or along a line of a shell's mesh, through its nodes (the paper,
   * section 2.2; doc/theory/sliding.md). The abscissa S on the beam is an unknown without inertia. Rows, with position
   * x(S) and directors d_k(S) of the beam, see Rail, and the frame x_B, E_i of B:
   *
   *     position               x_B − x(S) = 0, along the axes E has in the reference configuration
   *     sleeve                 E₂·d₁(S) = E₃·d₁(S) = 0
   *     prismatic              and E₃·d₂(S) = 0
   *     screw                  instead of the last one sin θ E₂·d₂(S) + cos θ E₃·d₂(S) = 0,   θ = p (S − S₀)
   *     prescribed             S − S₀ − f(t) = 0
   *
   * In the reference configuration B is at S₀, and E are the directors there, made orthonormal from d₁ and d₂. Rows
   * that are not quadratic get the correction along S in time steps, one for each (Layout::corrections), prescribed or
   * not, so that all of them together do no work.
   *
   * "displacement" is S − S₀ [m]: its spring, damper, force, ... act along the beam, on B and with their reaction on
   * the beam. What presses for its friction is the force of the position across x'(S); with a <Bearing length> forces
   * at both ends of the guide, which hold the moments of the sleeve, too. Multipliers of the position are the force of
   * B on A [N].
   *
   * Beyond both ends of the beam the line goes on straight for a hundredth of its length, as stops need it; farther out
   * nothing is defined, and no solution is found there. "At the ends = stop" puts stops there.
   *
   * "At the ends = leave": a step in time ends where S gets to an end, and from there on nothing holds B. That it has
   * left is said by the state alone: S is parked a hundred lengths away, S = parked is one row, λ = 0 are the others.
   */
  class SlidingJoint : public Joint, public HasBends, public CanLeave, public Doubtful
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    /** "displacement", "displacement rate", "force", its size. */
    std::shared_ptr<Signal> signal(Model &model, const std::string &path) override;
    void                    add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;

    /** Where pieces of the beam meet. */
    std::vector<Bend> bends() const override;

    /**
     * @name What presses is across the tangent t of the beam where B is, along the axes of the rows of the position: F
     * less what it has along t, or F/2 ± M × E₁/L of a guide of length L. Of a thread it is normal to the flanks. @{
     */
    bool
    presses(const Layout::Friction &friction) const override
    {
      return (friction.multipliers.front() == first_multiplier && friction.coordinates.front() == coordinate()) ||
             is_of_thread(friction);
    }
    PressingParts<double> pressing_parts(const Layout::Friction &friction, const Point<double> &point) const override;
    PressingParts<std::complex<double>> pressing_parts(const Layout::Friction            &friction,
                                                       const Point<std::complex<double>> &point) const override;
    /** @} */

    /** @name Leaving the beam at its ends @{ */
    Exits       exits() const override;
    bool        has_left(const State &state) const override;
    void        leave(State &state) const override;
    std::string text_of_leaving() const override;
    bool
    may_leave() const
    {
      return ends == "leave";
    }
    /** @} */

    /** The beam, and the abscissa on it in the reference configuration [m]; known after initialize(). @{ */
    const Body *
    beam() const
    {
      return body_of_rail;
    }
    double
    start_abscissa() const
    {
      return start;
    }
    /** @} */

    /**
     * "displacement", "displacement rate", "arc length" S; "force", with which A acts on B, its size and "force 1" ...
     * "force 3", and "moment 1" ... "moment 3" about the origin of B, along the directors of the beam at S; "attached",
     * 1 until it leaves the beam.
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    /** @name How much too stiff the beam is, because its moments cannot jump within an element, see HasKinks @{ */
    std::vector<Doubt>
    doubts(const State &) const override
    {
      return {};
    }
    Energies    energies(const State &state) const override;
    std::string doubt_of_run(const Energies &largest) const override;
    /** @} */

  protected:
    /** Products of axes E_i of B and directors d_k of the beam that stay zero; one that turns is the screw's. */
    struct Cosine
    {
      unsigned int i, k;
      bool         turns;
      std::string  name;
    };
    std::vector<Cosine> cosines;

    void add_pressing(std::vector<unsigned int> &multipliers) const override;

    double         turn = 0; ///< p of the screw [rad/m]
    ThreadFriction thread;   ///< of the screw
    bool           has_thread = false;
    VectorFriction ball{VectorFriction::Of::ball}; ///< of a point, against its turning
    bool           has_bore = false;               ///< of a sleeve, whose <Friction radius> may be given

  private:
    class Rows;
    class Turns;
    class Reaction;
    class Displacement;

    std::string                 ends         = "end the run";
    const Body                 *body_of_rail = nullptr;
    std::unique_ptr<Rail>       rail;
    std::unique_ptr<Constraint> term, turning;
    std::vector<Block>          blocks;     ///< of each piece: twists of its frames and of B, S, multipliers
    double                      start  = 0; ///< S₀ [m]
    unsigned int                n_rows = 0;
    Matrix3                     axes_of_rows =
      Matrix3::Identity(); ///< of the position, constant: those of B in the reference configuration

    unsigned int
    coordinate() const
    {
      return free.front().coordinate;
    }

    /** Factors of the products E_i·d_k in one of the rows, and their derivatives by S, at S − S₀ = @p sigma. */
    template <typename Number>
    Vec3<Number> tangent_in_rows(const Point<Number> &point) const;
    template <typename Number>
    PressingParts<Number> parts_at(const Point<Number> &point) const;

    template <typename Number>
    std::array<Mat3<Number>, 3> coefficients(const Cosine &cosine, const Number &sigma) const;

    static constexpr double most_beyond = 0.01;        ///< the ends, of the length
    static constexpr double far = 10, parked_at = 100; ///< of what has left, in lengths: farther than, and where

    /** Whether a displacement @p sigma is that of what has left. */
    bool
    is_far(const double sigma) const
    {
      return may_leave() && std::abs(sigma) > far * rail->length();
    }
    /** Where S − S₀ is after leaving at the end, or at the start, of the beam; on the side without a stop. */
    double
    parked(const bool left_at_end) const
    {
      return ((free.front().has_upper_stop ? -parked_at : parked_at) + (left_at_end ? 0 : 1)) * rail->length();
    }
    bool
    has_left_at_end(const double sigma) const
    {
      return std::abs(sigma - parked(true)) < std::abs(sigma - parked(false));
    }
    /** The displacement that is told: of what has left, that at the end where it left. */
    double                  displacement(double sigma) const;
    std::shared_ptr<Signal> displacement_signal() const;
    void                    check_leaving(Model &model);

    /** Rows of @p n unknowns from @p first on, that turn as B does against the section, times @p radius. */
    std::unique_ptr<Constraint> make_turns(Layout &layout, unsigned int n, unsigned int first, double radius) const;

    bool
    is_of_thread(const Layout::Friction &friction) const
    {
      return has_thread && friction.multipliers.front() == first_multiplier + 5;
    }
    template <typename Number>
    PressingParts<Number> parts_of(const Layout::Friction &friction, const Point<Number> &point) const;

    /** What of friction is not along the beam alone: turning, and the thread. */
    void initialize_turning(Model &model);
    void connect_turning(Layout &layout);

    bool find_rail(Model &model);
    /** Pieces of a shell's edge, of a line of its mesh, or of another curve on it. */
    std::vector<LinePiece> line_of_shell(const std::string &line) const;
    bool                   find_start(Model &model, const Frame &b);
    bool                   check_corners(Model &model);
    bool                   check_bodies();
    /** Stops at the ends of the beam, where those are wanted and the user has set none. */
    void add_stops_at_ends(Model &model);

    /** Force and moment of A on B, along the directors of the beam made orthonormal [N, N m]. */
    Vector6 action_on_b(const State &state) const;
  };



  template <typename Number>
  std::array<Mat3<Number>, 3>
  SlidingJoint::coefficients(const Cosine &cosine, const Number &sigma) const
  {
    std::array<Mat3<Number>, 3> c = {{Mat3<Number>::Zero(), Mat3<Number>::Zero(), Mat3<Number>::Zero()}};
    if (!cosine.turns)
      {
        c[0](cosine.i, cosine.k) = 1;
        return c;
      }
    using std::cos;
    using std::sin;
    const Number s = sin(turn * sigma), k = cos(turn * sigma);
    c[0](1, 1) = s;
    c[0](2, 1) = k;
    c[1](1, 1) = turn * k;
    c[1](2, 1) = -turn * s;
    c[2]       = -turn * turn * c[0];
    return c;
  }



  /** A point of B on the beam, free to turn; "rotation" holds the friction against that, as of a ball joint. */
  class SlidingPoint : public SlidingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /**
   * A ring around the beam, free to turn about it. With a "Friction radius" r of its bore friction acts against the
   * slip of both, w = (Ṡ, r ω), ω the turning about the beam.
   */
  class SlidingSleeve : public SlidingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /** B turns with the sections of the beam. */
  class SlidingPrismatic : public SlidingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /**
   * B turns against the sections of the beam in proportion to how far it slides: a nut. "thread" holds the friction of
   * its flanks.
   */
  class SlidingScrew : public SlidingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };
} // namespace samara

#endif
