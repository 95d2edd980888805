#ifndef samara_analysis_multiblade_h
#define samara_analysis_multiblade_h

#include <samara/analysis/repeated_parts.h>

#include <Eigen/Dense>

namespace samara
{
  /**
   * Multiblade coordinates (Coleman's) of increments of a model with Q repeated parts that come round: of numbers x_k
   * of part k, at the angle ψ_k = 2π (t/T + k/Q),
   *
   *     Σ x_k/√Q,   √(2/Q) Σ x_k cos nψ_k,   √(2/Q) Σ x_k sin nψ_k (n < Q/2),   Σ (−1)^k x_k/√Q (Q even)
   *
   * in the axes of the parts, and in inertial axes what turns and is not repeated. The transformation is orthogonal. In
   * steady rotation about the axis of the parts it makes coefficients constant.
   */
  class Multiblade
  {
  public:
    /** @p parts: aligned. */
    Multiblade(const System &system, const RepeatedParts &parts);

    /** The matrix M of x ↦ M x at a state, @p phase being 2π t/T. Increments are those of StepTangent. */
    Eigen::MatrixXd at(const State &state, double phase) const;

  private:
    const System                &system;
    const RepeatedParts         &parts;
    std::vector<Eigen::MatrixXd> shifts; ///< P⁻ᵏ, increments of part k in the place of the first
    /** Entries of an increment that are one part's, and those of its chain, part after part. */
    std::vector<std::vector<unsigned int>> chains;

    void
    add_chains(const std::vector<unsigned int> &next, const std::vector<unsigned int> &first_entry, unsigned int n);
  };
} // namespace samara

#endif
