#ifndef samara_aero_helical_wake_h
#define samara_aero_helical_wake_h

#include <samara/aero/external_inflow.h>
#include <samara/aero/vortex.h>
#include <samara/model/doubts.h>

namespace samara
{
  /**
   * A prescribed wake: behind each of Q straight blades vortex lines that were left where the blade was, and since then
   * have moved with the free air and with a given speed against the thrust axis; an example of an ExternalInflow.
   *
   * The circulation Γ(r) of the blades, the same of all and at all azimuths, has the values Γ_k at nodes r_k that
   * divide the span from the root to the edge into equal parts, in their middles; between them, and at root and tip,
   * lines leave the blade with its difference. A line that leaves at the radius a is, at the age ζ = |Ω|t, at
   *
   *     a (cos(ψ − ζ), sin(ψ − ζ), 0) + (μ₁, μ₂, −λ_f − V) ζ/|Ω|      (ψ + ζ if Ω < 0)
   *
   * seen from the hub, ψ the azimuth of the place that is looked at for its own blade, and 2π/Q on for each other one:
   * a station takes itself as the azimuth of its blade, which is right for blades that are straight and radial.
   * Vortices of the blades themselves are left out; where blades are alike they add nothing at each other. Loads ask
   * for
   *
   *     Γ_k = Σ F N_k(r)/(ρ |Ω| r) / Σ l N_k(r)
   *
   * with hat functions N_k, constant beyond the outer nodes, and the lengths l of the stations: the mean over blades
   * and, as τ is long, over azimuths. A node that no station reaches is refused.
   */
  class HelicalWake : public ExternalInflow
  {
  public:
    void add_parameters(Parameters &prm) override;
    void connect(Layout &layout) override;

    /** Where blades turn with another speed than is said, or the wake leaves with another than it induces. */
    std::vector<Doubt> doubts(const State &state) const override;

    /** The air carries the wake; neither its own mean flow nor the ground do. */
    bool
    sees(const unsigned int number) const override
    {
      return number < 3;
    }

    void
    add_station(const Vector3 &x, const double length) override
    {
      stations.emplace_back(x, length);
    }
    void
    velocities(const Vec3<double> &x, const Flow<double> &flow, double *A) const override
    {
      add_lines(x, flow, A);
    }
    void
    velocities(const Vec3<Complex> &x, const Flow<Complex> &flow, Complex *A) const override
    {
      add_lines(x, flow, A);
    }
    void
    drives(const Vec3<double> &x, const Flow<double> &, double *b) const override
    {
      circulation(x, b);
    }
    void
    drives(const Vec3<Complex> &x, const Flow<Complex> &, Complex *b) const override
    {
      circulation(x, b);
    }

  protected:
    std::vector<std::pair<std::string, std::string>> names_of_states(Model &model) override;

    /** w over the disk where a blade is, by area. */
    double mean(const State &state) const override;

  private:
    double       speed = 0, transport = 0, root = 0, core = 0; ///< Ω, V, r₀, r_c
    unsigned int n_nodes = 10, turns = 8, segments = 24;

    std::vector<std::pair<Vector3, double>> stations;
    std::vector<double>                     reach; ///< Σ l N_k [m]

    double
    width() const
    {
      return (radius - root) / n_nodes;
    }

    template <typename Number>
    void add_lines(const Vec3<Number> &x, const Flow<Number> &flow, Number *A) const;
    /** The node within x, and what is the next one's part of it. */
    template <typename Number>
    std::pair<unsigned int, Number> node_of(const Number &r) const;
    template <typename Number>
    void circulation(const Vec3<Number> &x, Number *b) const;
  };
} // namespace samara

#endif
