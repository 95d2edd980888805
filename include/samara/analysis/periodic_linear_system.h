#ifndef samara_analysis_periodic_linear_system_h
#define samara_analysis_periodic_linear_system_h

#include <samara/analysis/linear_system.h>
#include <samara/analysis/multiblade.h>
#include <samara/analysis/section_map.h>

namespace samara
{
  /**
   * Small motions about a periodic one, sampled N times a period, from controls u that keep still between samples to
   * probes y (doc/theory/linear_system.md):
   *
   *     x_{k+1} = A_k x_k + B_k u_k,   y_k = C_k x_k + D_k u_k,   A_{k+N} = A_k, ...
   *
   * x: the positions, velocities and states of first order that constraints leave, along bases that come back after a
   * period; with repeated parts in multiblade coordinates.
   */
  struct PeriodicLinearSystem
  {
    std::vector<Eigen::MatrixXd> A, B, C, D;
    double                       period = 0, start = 0; ///< [s]

    /** The mean over the period in continuous time, ẋ = A x + B u; empty if a sample holds half a cycle of something.
     */
    LinearSystem averaged;

    std::vector<std::string> inputs, outputs, input_units, output_units; ///< names and units
    std::vector<double>      input_values;
    Eigen::MatrixXd          output_values; ///< a row a sample

    /** Eigenvalues of A_{N−1} ... A_0, largest first. */
    std::vector<std::complex<double>> multipliers() const;
    /** Largest change of A_k over the period, relative to A_k − 1. */
    double variation() const;
  };



  /**
   * The state space about a periodic motion. The motion goes on from that of dynamic, trim or floquet, or begins as a
   * dynamic analysis does, and settles; what it lacks is corrected as in floquet. Writes periodic_linear_system.h5, and
   * frequency_response.csv of the mean.
   * Leaves the state as it was.
   *
   * @throws InputError for inputs that are no controls or prescribe motions; NotConverged for motions that are not
   * periodic
   */
  class PeriodicLinearSystemAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void run(Context &context) override;

    PeriodicLinearSystem space;   ///< of the last run
    double               gap = 0; ///< what its motion lacks to periodicity, see SectionMap::Gap
    State                orbit;   ///< where it begins

    // entries
    double                   period = 0, spectral_radius = 1, newton_tolerance = 1e-12, largest_gap = 1e-4;
    std::string              symmetry;
    std::vector<std::string> inputs, turning;
    double                   lowest_frequency = 0, highest_frequency = 0; ///< of responses of the mean [rad/s]
    unsigned int             n_frequencies = 100;
    unsigned int             n_samples = 36, n_steps = 1, n_stages = 3, max_iterations = 50, most_periods = 20,
                 most_corrections = 10, most_states = 400;

  private:
    RepeatedParts repeated_parts(const System &system) const;
    /** The motion at the samples, n_samples + 1 states. */
    std::vector<State> find_motion(const Context &context, SectionMap &whole, PeriodMap &sample);
    void               find_bases(SectionMap                   &whole,
                                  const std::vector<State>     &states,
                                  const Multiblade             &multiblade,
                                  std::vector<Eigen::MatrixXd> &bases,
                                  std::vector<Eigen::MatrixXd> &transformations) const;
    void               find_dynamics(const System                       &system,
                                     const std::vector<double>          &scale,
                                     PeriodMap                          &sample,
                                     const std::vector<State>           &states,
                                     const std::vector<Eigen::MatrixXd> &bases,
                                     const std::vector<unsigned int>    &numbers);
    void               find_outputs(const Context                      &context,
                                    const std::vector<double>          &scale,
                                    const std::vector<State>           &states,
                                    const std::vector<Eigen::MatrixXd> &bases,
                                    const std::vector<unsigned int>    &numbers);
    void               find_averages();
    void               tell(Context &context) const;
    void               write(const Context &context) const;
  };
} // namespace samara

#endif
