#ifndef samara_solvers_eigen_h
#define samara_solvers_eigen_h

#include <samara/model/matrix.h>

#include <complex>
#include <vector>

namespace samara
{
  /** A solution ζ(t) = Re[shape exp(λ t)] of the linearised motion. */
  struct Mode
  {
    std::complex<double> lambda;
    Eigen::VectorXcd     shape; ///< increments of nodal twists and joint coordinates

    /** |λ| [rad/s] for oscillating modes; for the others, |λ| too: the rate of growth or decay. */
    double
    frequency() const
    {
      return std::abs(lambda);
    }
    double
    damping_ratio() const
    {
      return std::abs(lambda) > 0 ? -lambda.real() / std::abs(lambda) : 0.;
    }
  };



  /**
   * Eigenvalues of M ζ̈ + C ζ̇ + K ζ + Gᵀ μ = 0, G ζ = 0 nearest to the real @p shift [1/s].
   *
   * All three matrices have the pattern of the system; G and Gᵀ are in K, and the first @p n_kinematic unknowns are ζ. By
   * shift-invert Arnoldi (Anasazi, block Krylov–Schur) on the first-order form with one factorisation of the saddle
   * matrix K + σ C + σ² M; the infinite eigenvalues of the constraints fall to zero there and are never seen. Small
   * systems are solved with the dense matrix of the same operator.
   *
   * Of a complex pair only the one with positive imaginary part is returned; sorted by |λ|. Shapes have unit 2-norm.
   * @throws SingularMatrix if the shift is an eigenvalue, NotConverged if the Arnoldi iteration does not find them.
   */
  std::vector<Mode> find_modes(const SparseMatrix &M,
                               const SparseMatrix &C,
                               const SparseMatrix &K,
                               unsigned int        n_kinematic,
                               unsigned int        n_modes,
                               double              shift);
} // namespace samara

#endif
