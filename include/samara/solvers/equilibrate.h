#ifndef samara_solvers_equilibrate_h
#define samara_solvers_equilibrate_h

#include <samara/model/matrix.h>

namespace samara
{
  /**
   * Multiply row i and column i of a square matrix with the same positive power of two, so that the largest entry of
   * both is about 1 for all i that have one (Ruiz: A scaling algorithm to equilibrate both rows and columns norms in
   * matrices, RAL-TR-2001-034). Signs of eigenvalues and of the determinant stay; condition numbers no longer depend on
   * units.
   */
  void equilibrate(SparseMatrix &A);
} // namespace samara

#endif
