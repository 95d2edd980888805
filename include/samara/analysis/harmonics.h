#ifndef samara_analysis_harmonics_h
#define samara_analysis_harmonics_h

#include <samara/analysis/periodic_motion.h>

namespace samara
{
  /**
   * Harmonics of a periodic motion: of the probes of Output, and of the forces and moments of joints about which parts
   * of the model turn, as hub loads of a rotor, in axes that stand still and in those that turn (doc/theory/trim.md).
   *
   *     y(t) = mean + Σ_n (a_n cos nωt + b_n sin nωt),   a_n = (2/T) ∫ y cos nωt dt,   ω = 2π/T
   *
   * by sums over the ends of the steps. Loads of a joint are what A puts on B at the origin of B: in the axes of A, and
   * in these turned about joint axis 3 by its rotation. The motion goes on from that of dynamic, trim or floquet, or
   * begins as a dynamic analysis does; it must come back after a period. Writes harmonics.csv. Leaves the state as it
   * was.
   *
   * @throws InputError for joints without a rotation about axis 3 or with less than six loads; NotConverged for motions
   * that are not periodic.
   */
  class HarmonicsAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void run(Context &context) override;

    std::optional<Effort>
    effort() const override
    {
      return spent;
    }

    /** A probe over a period. */
    struct Series
    {
      std::string         name, axes, unit; ///< axes: "", "standing", "turning"
      std::vector<double> values;           ///< at the ends of the steps

      double mean() const;
      /** (a_n, b_n), the phase at the end of step i being (i + 1) 2π/N + @p start. */
      std::array<double, 2> harmonic(unsigned int n, double start) const;
    };
    std::vector<Series> series;    ///< of the last run
    double              phase = 0; ///< ωt at its start
    double              gap   = 0; ///< what the motion lacks to periodicity, in scales

    // entries
    std::vector<std::string> joints;
    double                   period = 0, spectral_radius = 0.5, newton_tolerance = 1e-12, largest_gap = 1e-4;
    unsigned int             n_steps = 60, n_stages = 3, max_iterations = 50, most_periods = 0, n_harmonics = 8;

  private:
    std::optional<Effort> spent;

    /** A joint's loads, their probes one after another in those of the motion, and its rotation. */
    struct Load
    {
      std::string  joint;
      unsigned int first = 0; ///< force 1 2 3, moment 1 2 3, rotation
    };
    std::vector<Load> find_loads(const Model &model, std::vector<PeriodAverage> &averages) const;
    void check_gap(const Context &context, const PeriodicMotion &motion, const State &start, const State &end);
    void add_loads(const Load &load, const std::vector<std::vector<double>> &values);
    void write(const Context &context) const;
  };
} // namespace samara

#endif
