#ifndef samara_analysis_linear_system_h
#define samara_analysis_linear_system_h

#include <samara/analysis/modal.h>

namespace samara
{
  /**
   * ẋ = A x + B u, y = C x + D u: small motions about an equilibrium at rest or in steady rotation, from controls u to
   * probes y, both as changes from what they are there. x = (p, ṗ, z): positions p that the constraints leave, as an
   * orthonormal basis of increments, their rates, and states of first order without the controls.
   */
  struct LinearSystem
  {
    Eigen::MatrixXd          A, B, C, D;
    std::vector<std::string> inputs, outputs; ///< names
    std::vector<std::string> input_units, output_units;
    std::vector<double>      input_values, output_values; ///< at the equilibrium
    unsigned int             n_positions = 0;

    /** C (iω − A)⁻¹ B + D at these angular frequencies [rad/s]. */
    std::vector<Eigen::MatrixXcd> responses(const std::vector<double> &frequencies) const;

    /** A row of @p file an input, output and frequency. */
    void write_responses(const std::vector<double> &frequencies, const std::string &file) const;
  };



  /**
   * The linear state space about the context's state, for the design of controllers (doc/theory/linear_system.md). It
   * is refused where modes are, as it has the same matrices. Writes linear_system.h5, frequency_response.csv. The state
   * stays as it is.
   *
   * @throws InputError for inputs that are no controls, or that prescribe motions: of these accelerations would have to
   * be inputs, too. @throws NotConverged where something without mass moves, or there are too many states.
   */
  class LinearSystemAnalysis : public ModalAnalysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void run(Context &context) override;
    void finish(Context &context) override;

    LinearSystem space; ///< of the last run

    /** Angular frequencies of the table, as far apart as on a logarithmic scale [rad/s]. */
    std::vector<double> frequencies() const;

  private:
    std::vector<std::string> inputs;
    double                   lowest_frequency = 0, highest_frequency = 0;
    unsigned int             n_frequencies = 100, most_states = 1500;

    std::vector<unsigned int> states_of_inputs(const System &system) const;
    void                      check_inputs(const System                    &system,
                                           const Linearization             &linearization,
                                           const std::vector<unsigned int> &inputs) const;
    void                      write(const Context &context) const;
  };

  /** @p n angular frequencies, as far apart as on a logarithmic scale [rad/s]; none up to 0. */
  std::vector<double> logarithmic_frequencies(double lowest, double highest, unsigned int n);

  /** Complains about limits of frequencies that have none between them. */
  void check_frequencies(const Parameters &parameters, double lowest, double highest, Complaints &complaints);
} // namespace samara

#endif
