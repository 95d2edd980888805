#ifndef samara_solvers_equilibrate_h
#define samara_solvers_equilibrate_h

#include <samara/model/matrix.h>

namespace samara
{
  /** The power of two that is not larger than @p x > 0: scaling by it rounds nothing. */
  double power_of_two(double x);

  /**
   * Powers of two, one for row i and column i of a square matrix, with which the largest entry of both is about 1 for all
   * i that have one (Ruiz: A scaling algorithm to equilibrate both rows and columns norms in matrices, RAL-TR-2001-034).
   * Each pass takes the root of what is amiss: six leave of 1e24 a factor of three, twelve one per cent, but for the
   * powers of two.
   */
  std::vector<double> equilibrating_factors(const SparseMatrix &A, unsigned int n_passes);

  /** Scale a matrix so. Signs of eigenvalues and of the determinant stay; its condition does not depend on units. */
  void equilibrate(SparseMatrix &A);
} // namespace samara

#endif
