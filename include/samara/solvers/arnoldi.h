#ifndef samara_solvers_arnoldi_h
#define samara_solvers_arnoldi_h

#include <Eigen/Dense>

#include <complex>
#include <functional>
#include <random>
#include <vector>

namespace samara
{
  /**
   * Eigenvalues of largest size of a real operator by a block Arnoldi iteration, A V = V H + Q E with (V, Q)
   * orthonormal (Golub & Van Loan, section 10.5). It is never restarted: the basis grows until all that is wanted has
   * converged.
   *
   * Blocks of two vectors find eigenvalues that are there twice. A last look from a random start orthogonal to the
   * basis tells whether something as large has been missed.
   */
  class Arnoldi
  {
  public:
    /** y = A x, both of size n. */
    using Operator = std::function<void(const double *x, double *y)>;

    Arnoldi(const Operator &A, unsigned int n, unsigned int block_size);

    /** Let the basis have at least @p size vectors, and find the eigenvalues of H. */
    void expand(unsigned int size);

    /** Eigenvalues of H, largest first, and the sizes of their residuals, vectors of unit norm. */
    std::vector<std::complex<double>> values;
    std::vector<double>               residuals;
    Eigen::VectorXcd                  vector(unsigned int i) const;

    /** About the size of the largest eigenvalue of what the basis has missed, seen from @p steps vectors beside it. */
    double largest_missed(unsigned int steps);

    /** Add a random direction to the next block, for eigenvalues that are there more often than a block has vectors. */
    void widen();

    unsigned int
    size() const
    {
      return m;
    }

  private:
    const Operator     A;
    const unsigned int n;
    unsigned int       block;
    Eigen::MatrixXd    V, H, E; ///< V: the basis and, behind it, the next block
    unsigned int       m = 0;   ///< size of the basis
    Eigen::MatrixXcd   small_vectors;
    std::mt19937       generator;

    void add_block();
    void fill_random(unsigned int first);
    bool orthogonalize(unsigned int column, Eigen::Ref<Eigen::VectorXd> x, Eigen::VectorXd &coefficients) const;
    void solve_small();
  };
} // namespace samara

#endif
