#ifndef samara_aero_inflow_h
#define samara_aero_inflow_h

#include <samara/aero/air.h>
#include <samara/aero/disk_corrections.h>
#include <samara/aero/disk_shapes.h>
#include <samara/model/doubts.h>
#include <samara/model/layout.h>

#include <array>

namespace samara
{
  /** What the air does to a surface. */
  struct AirLoads
  {
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero(); ///< inertial axes, moment about a given point [N, N m]
    double  power   = 0;                                       ///< work on the surface in unit time [W]
    double  induced = 0, profile = 0;                          ///< what inflow and drag take of it [W]
  };



  /** A surface whose loads can be asked for. */
  class LoadedSurface
  {
  public:
    virtual ~LoadedSurface() = default;

    /** A frame that moves with it; known when it is connected. */
    virtual Frame carrier() const = 0;

    /** The largest distance of a station from the @p axis through @p centre [m]. */
    virtual double reach(const State &state, const Vector3 &centre, const Vector3 &axis) const = 0;

    /** How far its ends are from the outermost stations, at most [m]. */
    virtual double beyond_stations() const = 0;

    /** ∫ c ds in the reference configuration [m²] */
    virtual double area() const = 0;

    /** The moment about @p centre [m]; power in axes that move with the velocity @p carried [m/s]. */
    virtual AirLoads air_loads(const State &state, const Vector3 &centre, const Vector3 &carried) const = 0;
  };



  /**
   * The flow w that a rotor induces on its disk, against its thrust axis e₃ [m/s]: the air at a station has the
   * velocity wind − w e₃. It is a sum w = Σ z_k φ_k of shapes on the disk, seen in the hub's frame: origin at the
   * centre, axis 3 the thrust axis, azimuth ψ from axis 1, positive about axis 3. The frame may tilt and turn: states
   * of harmonics in axes that turn are others, and obey equations with their spin; what they say of the air is the
   * same.
   *
   * The z_k are states of first order or prescribed. The radius may change in time: the shapes grow with it.
   */
  class Inflow : public Item, public Doubtful
  {
  public:
    void                     add_parameters(Parameters &prm) override;
    void                     be_placed(const Placement &placement) override;
    void                     initialize(Model &model) override;
    void                     connect(Layout &layout) override;
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

    /** Whether disk and blades have different radii, or part of the disk is below the ground of a wind with shear. */
    std::vector<Doubt> doubts(const State &state) const override;

    /** Mean speed of the surfaces about the thrust axis, positive about axis 3 [rad/s]. */
    double speed(const State &state) const;

    /** The part of the disk that is on or below the ground of a wind with shear; 0 where there is no shear. */
    double part_below_ground(const State &state) const;

    /** The flow on the disk, where it is a sum of shapes. */
    void draw(const State &state, Drawing &drawing) const override;

    Frame                     hub;        ///< resolved when connected
    double                    radius = 1; ///< of the reference configuration, at t = 0
    DiskShapes                disk;       ///< in coordinates divided by the radius
    std::vector<unsigned int> states;     ///< of all shapes, or none

    /** What a force F [N] of blades along the thrust axis does: ż_k += load_weights[k] F φ_k, at t = 0. */
    std::vector<double> load_weights;

    /** The radius at a time. @throws InputError where it is not positive */
    double radius_at(double time) const;

    /** Ṙ/R [1/s] */
    double growth_at(double time) const;

    /** Of load_weights in a disk whose radius is another than at t = 0. */
    double
    factor_of_loads(const double other) const
    {
      const double ratio = radius / other;
      return varies ? ratio * ratio * ratio : 1.;
    }

    /** Whether the radius changes in time. */
    bool varies = false;

    /** How many z there are: of the shapes, or of a theory of its own. */
    unsigned int
    n_amplitudes() const
    {
      return disk.shapes.empty() ? states.size() : disk.shapes.size();
    }

    /** z_k */
    template <typename Number>
    void
    amplitudes(const Point<Number> &point, Number *z) const
    {
      for (unsigned int k = 0; k < n_amplitudes(); ++k)
        z[k] = states.empty() ? Number(prescribed(k, point.time)) : point.states[states[k]];
    }

    /** The first corner in time of what is prescribed. */
    virtual double
    next_corner(const double from, const double to) const
    {
      return given_radius.next_corner(from, to);
    }

    /** Surfaces that live in it. */
    std::vector<const LoadedSurface *> surfaces;

    /** Whether w is Σ z_k φ_k, as told before disk is made. */
    virtual bool
    is_sum_of_shapes() const
    {
      return true;
    }

    const Air *air = nullptr;

    /** Direction of azimuth zero and the thrust axis in the reference configuration. */
    Vector3 azimuth_zero = Vector3::UnitX(), axis_zero = Vector3::UnitZ();
    Vector3 centre_zero  = Vector3::Zero(); ///< of the hub, in the reference configuration

    DiskCorrections corrections;

    /** Another inflow that is felt on this disk: κ times the mean of its flow over its own disk, κ w̄. */
    struct Neighbour
    {
      const Inflow *inflow;
      double        factor; ///< κ
    };
    std::vector<Neighbour> neighbours;

    /** Σ κ w̄ [m/s], uniform on this disk and against its thrust axis, whatever the axes of the others. */
    template <typename Number>
    Number
    from_neighbours(const Point<Number> &point) const
    {
      Number                           sum(0);
      thread_local std::vector<Number> z;
      for (const auto &[other, factor] : neighbours)
        {
          z.resize(other->n_amplitudes());
          other->amplitudes(point, z.data());
          for (unsigned int k = 0; k < z.size(); ++k)
            sum += factor * other->corrections.averages[k] * z[k];
        }
      return sum;
    }

    /** Calls f(c) for each of neighbour_states(), from_neighbours() being Σ c z of them. */
    template <typename Function>
    void
    for_states_of_neighbours(const Function &f) const
    {
      for (const auto &[other, factor] : neighbours)
        for (unsigned int k = 0; k < other->states.size(); ++k)
          f(factor * other->corrections.averages[k]);
    }

    /** Numbers of the states that from_neighbours() depends on. */
    std::vector<unsigned int> neighbour_states() const;

    /** What the corrections depend on; @p H the hub's triad, @p others the flow from_neighbours(), which is part of the
     * flow through the disk without the rotor's own. */
    template <typename Number>
    DiskCorrections::Flow<Number>
    flow_through_disk(const Vec3<Number> &x,
                      const Mat3<Number> &H,
                      const Vec6<Number> &twist,
                      const Number       *z,
                      const Number       &others,
                      const double        time) const
    {
      const Vec3<Number> v = H.transpose() * (air->wind(x, time) - H * twist.template head<3>());
      Number             mean(0);
      for (unsigned int k = 0; k < corrections.averages.size(); ++k)
        mean += corrections.averages[k] * z[k];
      DiskCorrections::Flow<Number> flow;
      flow << v(0), v(1), others - v(2), mean, x(2) - corrections.ground;
      return flow;
    }

  protected:
    /** Entries for the flow round tips. */
    void add_tip_loss(Parameters &prm);

    /** Entries for the flow of other rotors. */
    void add_interference(Parameters &prm);

    unsigned int given_blades = 0; ///< 0: as many as there are surfaces

    /** Loads of all surfaces; moment about the centre, power seen from the hub. */
    AirLoads loads(const State &state) const;

    virtual double
    prescribed(unsigned int /*k*/, double /*time*/) const
    {
      return 0;
    }

    /** The mean flow that belongs to the thrust [m/s]. */
    virtual double mean(const State &state) const = 0;

  private:
    std::vector<std::string> neighbour_names;
    std::vector<double>      neighbour_factors;

    /** Rotor coefficients, "thrust coefficient"; nothing of another path. */
    std::optional<Probe> coefficient_probe(const std::string &path) const;

    void find_neighbours(Model &model);
    void add_doubt_of_radius(const State &state, std::vector<Doubt> &doubts) const;
    void add_doubt_of_ground(const State &state, std::vector<Doubt> &doubts) const;

    std::string    hub_name, air_name, tip_loss = "none";
    FunctionOfTime given_radius{1.};
    bool           has_factor_of_tips = false; ///< whether there are the entries of add_tip_loss()
    Vector3        axis = Vector3::Zero(), direction = Vector3::Zero();
  };



  /** w = w₀(t) + r/R (w_c(t) cos ψ + w_s(t) sin ψ), given. */
  class PrescribedInflow : public Inflow
  {
  public:
    void   add_parameters(Parameters &prm) override;
    void   initialize(Model &model) override;
    double next_corner(double from, double to) const override;

  protected:
    double prescribed(unsigned int k, double time) const override;
    double mean(const State &state) const override;

  private:
    std::array<FunctionOfTime, 3> components;
  };
} // namespace samara

#endif
