#ifndef samara_tests_aero_growth_h
#define samara_tests_aero_growth_h

#include <samara/base/dense.h>

#include <Eigen/Dense>

#include <complex>
#include <vector>

namespace samara::aero_models
{
  /** λ, ω > 0, of what is one oscillation exp(λt): from values at equal times @p h, y₊ = a y − b y₋ by least squares.
   */
  inline std::complex<double>
  growth_of(const std::vector<double> &y, const double h)
  {
    Eigen::MatrixXd A(y.size() - 2, 2);
    Eigen::VectorXd next(y.size() - 2);
    for (unsigned int n = 0; n + 2 < y.size(); ++n)
      {
        A.row(n) << y[n + 1], -y[n];
        next(n) = y[n + 2];
      }
    const Eigen::Vector2d      ab     = PivotedQr(A).solve(next);
    const std::complex<double> z      = 0.5 * (ab(0) + std::sqrt(std::complex<double>(ab(0) * ab(0) - 4 * ab(1))));
    const std::complex<double> lambda = std::log(z) / h;
    return {lambda.real(), std::abs(lambda.imag())};
  }
} // namespace samara::aero_models

#endif
