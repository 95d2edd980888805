#ifndef samara_analysis_floquet_h
#define samara_analysis_floquet_h

#include <samara/analysis/analysis.h>
#include <samara/analysis/floquet_modes.h>
#include <samara/analysis/mode_tracking.h>
#include <samara/output/table.h>

#include <memory>

namespace samara
{
  /**
   * Stability of a periodic motion by Floquet's theory (the paper, section 4.3; doc/theory/floquet.md): the multipliers
   * of the exact derivative of the motion over a period, by Arnoldi's method (implicit), by that of a Q-th of the
   * period where Q parts are repeated (fast), or from all columns (classical).
   *
   * The motion begins as a dynamic analysis does, or goes on from where one has ended, and settles; what lacks to
   * periodicity is told, and too much of it refused. That coefficients are periodic, and the symmetry of repeated
   * parts, are tested by a random change that is carried on beyond what was used. Writes floquet.csv,
   * floquet_<speed>.csv and floquet_speeds.csv of a sweep, and floquet_<k>.pvd with mode k moving. Leaves the state as
   * it was.
   */
  class FloquetAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void start(Context &context) override;
    void run(Context &context) override;
    void finish(Context &context) override;

    std::vector<FloquetMode> modes;         ///< of the last run
    double                   gap = 0;       ///< what its orbit lacks to periodicity, see SectionMap::Gap
    State                    orbit;         ///< where it begins
    unsigned int             n_columns = 0; ///< vectors taken through a section of the period

    // entries
    double period = 0, turns = 1, spectral_radius = 1, newton_tolerance = 1e-12, largest_gap = 1e-4, tolerance = 0,
           highest_frequency = 0;
    std::string              turns_of, method = "automatic", symmetry;
    std::vector<std::string> turning;
    unsigned int n_steps = 36, n_stages = 3, max_iterations = 50, wanted = 10, most_periods = 20, most_corrections = 10,
                 n_animations = 4;

  private:
    ModeTracking           tracking;
    std::unique_ptr<Table> of_speeds;

    std::vector<std::vector<std::string>> groups() const;
    bool                                  is_by_sections() const;
    State                                 first_state(const Context &context) const;
    double                                period_at(const Context &context, const State &state) const;
    RepeatedParts                         repeated_parts(const System &system) const;
    void                                  check_gap(Context &context, const SectionMap &map) const;
    void                                  keep_motion(Context &context, const SectionMap &map) const;
    void                                  check_behind(const SectionMap &map, double difference) const;
    void                                  check_corners(const Context &context, const SectionMap &map) const;
    void                                  check_switches(const Context &context, const SectionMap &map) const;
    FloquetModes                          find(SectionMap &map) const;
    void                                  tell_stability(const Context &context, const FloquetModes &found) const;
    void                                  tell_lost_modes(const Context &context, const FloquetModes &found) const;
    void                                  report(const Context &context, const FloquetModes &found, double T) const;
    void                                  add_to_speeds(const Context &context, double T);
    void                                  animate(const Context &context, SectionMap &map) const;
    void                                  animate(const Context &context, SectionMap &map, unsigned int k) const;
    /** The images of a shape over the period, on the page of the report. */
    void show(const Context &context, SectionMap &map, const std::vector<Eigen::VectorXcd> &images, unsigned int k) const;
  };
} // namespace samara

#endif
