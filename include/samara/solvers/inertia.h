#ifndef samara_solvers_inertia_h
#define samara_solvers_inertia_h

#include <samara/model/matrix.h>

#include <optional>

namespace samara
{
  /**
   * The number of negative eigenvalues of a symmetric matrix, whose diagonal may be zero, by Sylvester's law of
   * inertia: the negative pivots of L D Lᵀ. Small matrices by Bunch and Kaufman's pivots of one and two rows (LAPACK),
   * others with pivots on the diagonal (SymmetricFactors) and, where these lose too much, by MUMPS.
   *
   * @param values scaled to entries of about 1; (A + Aᵀ)/2 counts.
   * @return nothing if the factors are not accurate or not finite.
   */
  std::optional<int> n_negative_eigenvalues(const Pattern &pattern, const std::vector<double> &values);
} // namespace samara

#endif
