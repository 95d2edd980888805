#ifndef samara_solvers_krylov_schur_h
#define samara_solvers_krylov_schur_h

#include <Eigen/Dense>

#include <complex>
#include <functional>
#include <vector>

namespace samara
{
  /** Eigenpairs A x = λ x of a real operator, |λ| descending; of a complex pair both are there. */
  struct EigenPairs
  {
    std::vector<std::complex<double>> values;
    Eigen::MatrixXcd                  vectors;   ///< columns of unit 2-norm
    std::vector<double>               residuals; ///< |A x − λ x|
    Eigen::MatrixXd                   projected; ///< A in the space of the vectors
    unsigned int                      n_products = 0;
  };



  struct ArnoldiSettings
  {
    double       tolerance     = 1e-10; ///< of residuals, relative to |λ|
    unsigned int largest_basis = 60;    ///< vectors that are kept; at least 2 · wanted + 10 are
    unsigned int most_products = 10000;
  };



  /**
   * The @p wanted eigenvalues of largest size of an operator y = A x of size @p n, such as Floquet's multipliers of the
   * map over a period. Arnoldi's method with restarts by Krylov and Schur (Stewart 2001): of a basis that is full the
   * part of the largest Ritz values is kept, A V = V S + v bᵀ. When all that is wanted has converged, the iteration
   * goes on once more from a random start beside it, until nothing there is as large: so eigenvalues that are there
   * more than once are found so often.
   *
   * @throws NotConverged with what was reached if the products do not suffice, std::invalid_argument for wanted > n.
   */
  EigenPairs arnoldi(unsigned int                                           n,
                     const std::function<void(const double *x, double *y)> &apply,
                     unsigned int                                           wanted,
                     const ArnoldiSettings                                 &settings = {});
} // namespace samara

#endif
