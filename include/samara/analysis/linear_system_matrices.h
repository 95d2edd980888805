#ifndef samara_analysis_linear_system_matrices_h
#define samara_analysis_linear_system_matrices_h

#include <samara/analysis/linear_system.h>

namespace samara
{
  /** What a state space is made of. */
  struct LinearSystemSource
  {
    const System                    &system;
    const State                     &state;
    const std::vector<Vector3>      &spins; ///< of the axes in which coefficients are constant, see Linearization
    const Linearization             &linearization;
    const std::vector<unsigned int> &inputs;   ///< numbers of the states of first order that are inputs
    const std::vector<unsigned int> &controls; ///< of all that keep their values, inputs among them
    unsigned int                     most_states;
  };

  /** A and B. Increments of positions p are @p basis times p. @throws NotConverged */
  void find_dynamics(const LinearSystemSource &source, LinearSystem &space, Eigen::MatrixXd &basis);

  /** C and D by central differences of the probes, which see forces and accelerations as they are reported. */
  void find_outputs(const LinearSystemSource &source,
                    const Eigen::MatrixXd    &basis,
                    const std::vector<Probe> &probes,
                    LinearSystem             &space);
} // namespace samara

#endif
