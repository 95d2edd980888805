#ifndef samara_aero_surface_h
#define samara_aero_surface_h

#include <samara/aero/annular_inflow.h>
#include <samara/aero/external_inflow.h>
#include <samara/aero/station.h>
#include <samara/base/composite_rule.h>
#include <samara/model/counted_states.h>
#include <samara/model/doubts.h>
#include <samara/model/load_of_air.h>
#include <samara/model/moved.h>
#include <samara/model/virtual_mass.h>

#include <array>

namespace samara
{
  /**
   * A wing, a blade, a fin: a lifting line on a beam or a rigid body.
   *
   * Its span is divided into panels, which end where chord, twist, offset or airfoils have corners and where the user
   * says; panels are divided where elements end, with Gauss's points in each piece, no fewer on an element than its
   * shape functions are of degree: a finer mesh is finer air. At each of them the air is met at three
   * quarters of the chord and acts at a quarter of it (section_loads.h). Forces on nodes are the exact dual of the
   * velocities of these points, so that their power is that of the air: with f, m per length, and the arm r of the
   * quarter chord
   *
   *     on frame a: N_a D_aᵀ f,  N_a (r × D_aᵀ f + D_aᵀ m)
   *
   * Section axes: e₁ along the reference line, e₂ to the leading edge, e₃ = e₁ × e₂ to the upper side; where the upper
   * side is the other one, e₁ looks to the start of the line. A positive twist turns the leading edge up.
   *
   * Virtual mass (T. Theodorsen, NACA Report 496, 1935), m = πρc²/4 per length: the force −m d(v₃)/dt e₃ at half chord
   * and the couple −(m c²/32) dΩ₁/dt e₁, with the component v₃ of the velocity of that point relative to the air,
   * become part of the mass of the nodes, lumped by the shape functions, or by piecewise linear ones in an element
   * where these would make the mass of a node negative; what is left are the force m (ω × e₃)·u e₃ of the air's
   * velocity u. The air's own acceleration is left out.
   *
   * Pitching: the couple −(m c/4) |V₂| Ω₁ e₁ of the camber that a section which turns has for the flow is part of every
   * section that lifts. Where the virtual mass does not count, its force at half chord is missing, and the moment which
   * that has about the quarter chord, as much again, is put in its place, −(m c/4) |V₂| (Ω₁ − ψ̇ e₁·e₃ᴴ) e₁: together
   * the −πρVb³ϑ̇ of T. Theodorsen. ψ̇ is the speed with which the section goes round the thrust axis e₃ᴴ of its inflow:
   * a coned blade turns about itself, but its angle of attack does not change by that.
   *
   * Source: the paper, section 2.3; the lifting line and its derivatives are derived in doc/theory/aerodynamics.md.
   */
  class Surface : public Item,
                  public LoadedSurface,
                  public LoadOfAir,
                  public HasCountedStates,
                  public VirtualMass,
                  public MovesWithBodies,
                  public Doubtful
  {
  public:
    void                     add_parameters(Parameters &prm) override;
    void                     be_moved(const MotionOf &motion_of) override;
    void                     initialize(Model &model) override;
    void                     connect(Layout &layout) override;
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    void     see_flow(const State &state, FlowSeen &seen) const override;
    double   beyond_stations() const override;
    double   area() const override;
    AirLoads air_loads(const State &state, const Vector3 &centre, const Vector3 &carried) const override;
    AirPower air_power(const Point<double> &point) const override;
    double   reach(const State &state, const Vector3 &centre, const Vector3 &axis) const override;
    void     add_virtual_mass(std::vector<Matrix6> &of_nodes) const override;

    /** Where the air is faster than the airfoils know, surfaces are below the ground; and what is doubtful from the
     * start, see find_doubts(). */
    std::vector<Doubt> doubts(const State &state) const override;

    /**
     * Lags by ½πρ(c/2)²ΔS x², the energy of the air that a section moves along; angles and places of separation by
     * area; flows of an annular inflow by the area of the annulus.
     */
    std::vector<CountedStates> counted_states() const override;

    Frame
    carrier() const override
    {
      return elements.empty() ? Frame() : elements.front().frames.front();
    }

  private:
    // entries
    std::string              body_name, air_name, inflow_name, unsteady_name = "two lags";
    std::vector<Vector3>     line;
    std::vector<double>      range, more_breaks;
    unsigned int             points_a_panel = 4;
    Expression               chord, offset, twist, lift_factor{1.};
    std::vector<double>      entered_lags = {1.7, 3.};
    SeparationLags           separation_lags;
    bool                     has_virtual_mass = false, compressible_lags = false;
    Vector3                  leading_edge = Vector3::Zero(), upper_side = Vector3::Zero();
    std::vector<std::string> airfoil_names;

    Model                *model    = nullptr;
    const Air            *air      = nullptr;
    Inflow               *inflow   = nullptr;
    const AnnularInflow  *annular  = nullptr; ///< the same, if it is one
    const ExternalInflow *external = nullptr; ///< likewise
    Unsteady              unsteady = Unsteady::two_lags;

    struct PlacedAirfoil
    {
      const Airfoil *airfoil;
      double         s;
    };
    std::vector<PlacedAirfoil> airfoils;
    std::vector<double>        panels; ///< where they end, abscissae

    /** The state of a station, and what the air does there. */
    template <typename Number>
    struct AtStation
    {
      AtStation(const Station &station, const AlongElement<Number> &along)
        : axes(along.F * station.along, along.F * station.chordwise)
      {}

      SectionAxes<Number> axes;
      Vec3<Number>        place;                ///< of the quarter chord [m]
      Vec3<Number>        air, spin;            ///< velocity of the air, spin of the section; inertial axes
      Vec3<Number>        relative, V;          ///< of the air to three quarters of the chord: inertial, section axes
      Vec3<Number>        on_disk, thrust_axis; ///< place in the hub's frame
      Vec3<Number>        free, added;          ///< of an annular inflow, hub's axes: air without it, and what it adds
      const Number       *shapes  = nullptr;    ///< of the inflow
      Number              induced = Number(0), upwash = Number(0), separated = Number(1), kept = Number(1);
      Number              turning = Number(0); ///< (c/2) Ω₁ [m/s]
      SectionFlow<Number> flow;
      Vec3<Number>        force, moment;        ///< at the quarter chord, inertial axes, per length
      Vec3<Number>        middle_force;         ///< at half chord, of the virtual mass
      Number              pitching = Number(0); ///< Ω₁, and once more against the flow if there is no virtual mass
    };

    /** The frames of an element, the hub's behind them, and the amplitudes of the inflow. */
    template <typename Number>
    struct Gathered
    {
      using AtFrame = typename AlongElement<Number>::AtFrame;
      FramesInState<Number>         frames;
      std::vector<AtFrame>          rates;
      std::vector<Number>           lags, amplitudes;
      Vec3<Number>                  wind   = Vec3<Number>::Zero();                  ///< if it is the same everywhere
      DiskCorrections::Flow<Number> disk   = DiskCorrections::Flow<Number>::Zero(); ///< if the inflow has corrections
      Number                        near   = Number(1); ///< factor of the inflow: the ground
      Number                        others = Number(0); ///< flow of other rotors
      double                        radius = 1;         ///< of the disk
    };

    /**
     * What was evaluated of an element, for what it was: forces, rates of states, both matrices and probes ask for the
     * same point one after the other.
     */
    template <typename Number>
    struct AtElement
    {
      Gathered<Number>               g;
      std::vector<AtStation<Number>> stations;
      std::vector<Number>            shapes;
      double                         time = 0, factor = 0;
      Eigen::MatrixXd                K, C; ///< without what follows from twists, and by twists; or empty
    };

    /** Stations between the same frames. */
    struct Element
    {
      std::vector<Frame>        frames;
      std::vector<double>       abscissae;
      std::vector<Station>      stations;
      std::vector<unsigned int> lags;              ///< numbers of their states
      std::vector<Matrix6>      virtual_mass = {}; ///< of the air, lumped at the frames; or none
      Block                     block        = {}; ///< frames, the hub's, lags, states of the inflow

      mutable AtElement<double> last = {}; ///< evaluation
    };
    std::vector<Element> elements;

    /** A station in the reference configuration: its quarter chord, inertial, and what it is. */
    struct Place
    {
      Vector3 x;
      double  chord, weight;
    };
    std::vector<Place> places; ///< of all stations, as frames tell them before they are connected

    /** The loads of a surface in the state of a point; see air_loads(). */
    AirLoads air_loads_at(const Point<double> &point, const Vector3 &centre, const Vector3 &carried) const;
    void     add_states(Station &station, Element &element);
    void     join_inflow();
    void     add_flow(Station &station, Element &element, AnnularInflow &flow);
    void     check_disk() const;
    Vector3  on_disk(const Station &station, const Element &element) const;
    void     find_virtual_mass(Element &element);
    bool     lump_virtual_mass(Element &element, bool piecewise) const;
    void     find_doubts(); ///< before frames are connected
    bool     is_told_of_another(const std::string &about) const;
    void     add_doubt_of_power();
    void     add_doubt_of_lags();
    void     find_places();
    void     add_doubt_of_copies();
    void     add_doubt_of_twins();
    void     add_doubt_of_ground(const State &state, std::vector<Doubt> &doubts) const;

    /** Angles of attack between which a section is not stalled, at Mach numbers 0, 0.1, ...; found when asked for. */
    struct StallAngles
    {
      bool   is_known = false;
      double low, high;
    };
    mutable std::vector<std::array<StallAngles, 11>> stall_angles; ///< of all stations
    bool is_stalled(unsigned int station, const SectionOfWing &section, double alpha, double mach) const;

    std::vector<Doubt>  known_doubts; ///< those that are the same in all states
    std::vector<double> without_lift; ///< abscissae of stations that have no dynamic stall as they do not lift
    std::string         airfoil_without_lift;

    /** The loads, and all derivatives: those of the states' rates, too. */
    class Loads : public Evaluated<Loads, Force>
    {
    public:
      const Surface *surface = nullptr;
      template <typename Number>
      void   residual_at(const Point<Number> &point, Number *r) const;
      void   tangent(const Point<double> &point, SparseMatrix &K) const override;
      void   damping(const Point<double> &point, SparseMatrix &C) const override;
      double next_corner(double from, double to) const override;
      void   pieces(const Point<double> &point, std::vector<double> &pieces) const override;
    };
    /** Rates of lags, and what the loads do to the inflow. */
    class Rates : public Evaluated<Rates, StateEquation>
    {
    public:
      const Surface *surface = nullptr;
      template <typename Number>
      void residual_at(const Point<Number> &point, Number *r) const;
    };
    Loads loads;
    Rates rates;

    // reading
    void                   add_parameters_of_flow(Parameters &prm);
    bool                   find_body();
    void                   choose_unsteady();
    bool                   find_airfoils();
    std::vector<double>    breaks() const;
    std::vector<RulePoint> rule() const;
    unsigned int           element_at(double s) const;
    void                   add_stations();
    Station                station_at(double s, double weight, const Element &element) const;

    template <typename Number>
    void gather(const Element &element, const Point<Number> &point, Gathered<Number> &g) const;
    /** Where an annular inflow is asked. */
    template <typename Number>
    static AnnularMomentum::Place<Number>
    in_annulus(const Station &station, const Gathered<Number> &g, const AtStation<Number> &at)
    {
      return {at.on_disk, at.free, g.lags[station.first_flow], g.lags[station.first_flow + 1]};
    }
    /** Added to r² where r is a distance from the thrust axis that is divided by [m²]. */
    static double
    square_near_axis(const double radius)
    {
      constexpr double near_axis = 1e-3; // of the radius, where no blade is
      return near_axis * radius * near_axis * radius;
    }

    /** ψ̇ e₁·e₃ᴴ, what of the turning Ω₁ is that of a section carried round the thrust axis [rad/s]. */
    template <typename Number>
    Number carried_round(const Gathered<Number> &g, const AtStation<Number> &at, const Vec3<Number> &place) const;
    template <typename Number>
    void add_pitching(const Station              &station,
                      const Gathered<Number>     &g,
                      const AlongElement<Number> &along,
                      AtStation<Number>          &at) const;
    template <typename Number>
    AtStation<Number> evaluate(const Station &station, const Gathered<Number> &g, double time, Number *shapes) const;
    /** All stations of an element, until it is asked for another point. */
    template <typename Number>
    AtElement<Number> &at_element(const Element &element, const Point<Number> &point) const;
    /** Both matrices of an element. */
    const AtElement<double> &matrices(const Element &element, const Point<double> &point) const;

    template <typename Number>
    using Rows = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    template <typename Number>
    void add_rates(const Station           &station,
                   const Gathered<Number>  &g,
                   const AtStation<Number> &at,
                   Rows<Number>            &local) const;

    /** Of a station on the disk about the hub at @p centre, from the direction that is its azimuth zero in the
     * reference configuration; 0 to 360 degrees. */
    double azimuth(const AtStation<double> &at, const Vector3 &centre) const;

    struct Derivatives;
    Eigen::Matrix<double, 5, AnnularMomentum::n_inputs>
         slopes_of_annulus(const Station &station, const Gathered<double> &g, const AtStation<double> &at) const;
    void differentiate(const Station           &station,
                       const Gathered<double>  &g,
                       const AtStation<double> &at,
                       const Point<double>     &point,
                       Eigen::MatrixXd         &K,
                       Eigen::MatrixXd         &C) const;
    void add_still_air(const Station           &station,
                       const Gathered<double>  &g,
                       const AtStation<double> &at,
                       Eigen::MatrixXd         &K) const;
    void add_matrix(const Point<double> &point, bool by_velocity, SparseMatrix &A) const;
  };
} // namespace samara

#endif
