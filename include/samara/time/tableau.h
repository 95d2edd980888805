#ifndef samara_time_tableau_h
#define samara_time_tableau_h

#include <Eigen/Dense>

#include <complex>
#include <vector>

namespace samara
{
  /**
   * Coefficients of the integrator family, s = 1, 2, 3 stages and spectral radius ρ∞ at infinite frequency.
   *
   * Gauss nodes c, weights b and matrix a carry the kinematics; with α = (1 − ρ∞)/(1 + ρ∞) and the normalised Legendre
   * polynomial p_k = √(2s−1) P_{s−1}(2c_k − 1),
   *
   *     a_α = a + α/(2(2s−1)) · p pᵀ diag(b)
   *
   * carries momentum and stress. b_k a_α,kl + b_l a_α,lk − b_k b_l = α/(2s−1) b_k p_k p_l b_l is positive semidefinite
   * of rank one: that is the energy statement. (Design notes on the integrator family; Burrage & Butcher 1979.)
   */
  struct Tableau
  {
    /** @throws std::invalid_argument unless 1 ≤ s ≤ 3 and 0 ≤ ρ∞ ≤ 1. */
    Tableau(unsigned int n_stages, double spectral_radius);

    unsigned int    s;
    double          alpha;
    Eigen::VectorXd c, b, p;
    Eigen::MatrixXd a, a_alpha, w; ///< w = a_α⁻¹

    /** a_α = T diag(μ) T⁻¹. Of a complex pair only the first eigenvalue is listed. */
    struct Eigenvalue
    {
      std::complex<double> mu;
      Eigen::VectorXcd     left, right; ///< row of T⁻¹ and column of T; left · right = 1
    };
    std::vector<Eigenvalue> eigenvalues;
  };
} // namespace samara

#endif
