#ifndef samara_solvers_kept_inertia_h
#define samara_solvers_kept_inertia_h

#include <samara/solvers/linear.h>
#include <samara/solvers/symmetric_factors.h>

namespace samara
{
  /** What n_positive_is_kept() has found. */
  struct KeptInertia
  {
    bool         is_shown   = false;
    unsigned int iterations = 0;
    double       residual   = 1; ///< relative; less than what was asked for if it is shown
  };

  /**
   * Whether the symmetric part S of @p A has as many positive eigenvalues, or more, as the factors P S₀ Pᵀ = L D Lᵀ of
   * another matrix have positive pivots, shown without factors of A (doc/theory/statics.md). With C = |D|^-1/2 L⁻¹ P
   * and the projection N on the unknowns of negative pivots,
   *
   *     C S Cᵀ + 2 N
   *
   * is 1 for S = S₀. If it is positive definite S has no more eigenvalues <= 0 than there are negative pivots.
   * Conjugate gradients solve it for a random right-hand side. The residual is p(.) times that, and |p| >= 1 for any
   * eigenvalue <= 0. So it cannot fall below the part of the right-hand side along its vector, which is hardly ever that
   * small.
   *
   * @param probability of "shown" where it is not so, over right-hand sides
   * @return not shown: an eigenvalue <= 0 has been found, or it takes more than @p most_iterations, each a solution and
   * a product; seen soon after the first ones.
   */
  KeptInertia n_positive_is_kept(const SymmetricFactors &factors,
                                 const SparseMatrix     &A,
                                 double                  probability     = 1e-6,
                                 unsigned int            most_iterations = 10,
                                 unsigned int            seed            = 1);

  /** The factors L D Lᵀ that a solver uses, if it does; else nullptr. */
  const SymmetricFactors *symmetric_factors_of(const LinearSolver &solver);
} // namespace samara

#endif
