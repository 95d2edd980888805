#include <samara/time/tableau.h>

#include <samara/base/dense.h>

#include <deal.II/base/quadrature_lib.h>

#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Coefficients of the Lagrange polynomial of node @p k, lowest power first. */
    Eigen::VectorXd
    lagrange_coefficients(const Eigen::VectorXd &c, const unsigned int k)
    {
      Eigen::VectorXd polynomial = Eigen::VectorXd::Zero(c.size());
      polynomial(0)              = 1;
      unsigned int degree        = 0;
      for (unsigned int j = 0; j < c.size(); ++j)
        if (j != k)
          {
            ++degree;
            for (unsigned int i = degree; i > 0; --i)
              polynomial(i) = (polynomial(i - 1) - c(j) * polynomial(i)) / (c(k) - c(j));
            polynomial(0) *= -c(j) / (c(k) - c(j));
          }
      return polynomial;
    }

    double
    legendre(const unsigned int degree, const double x)
    {
      return degree == 0 ? 1. : degree == 1 ? x : 1.5 * x * x - 0.5;
    }
  } // namespace



  Tableau::Tableau(const unsigned int n_stages, const double spectral_radius)
    : s(n_stages)
    , alpha((1 - spectral_radius) / (1 + spectral_radius))
    , c(s)
    , b(s)
    , p(s)
    , a(s, s)
  {
    if (s < 1 || s > 3)
      throw std::invalid_argument("the integrator has 1, 2 or 3 stages");
    if (!(spectral_radius >= 0 && spectral_radius <= 1))
      throw std::invalid_argument("the spectral radius lies between 0 and 1");
    const dealii::QGauss<1> gauss(s);
    for (unsigned int k = 0; k < s; ++k)
      {
        c(k) = gauss.point(k)[0];
        b(k) = gauss.weight(k);
        p(k) = std::sqrt(2. * s - 1.) * legendre(s - 1, 2 * c(k) - 1);
      }
    for (unsigned int l = 0; l < s; ++l)
      {
        const Eigen::VectorXd polynomial = lagrange_coefficients(c, l);
        for (unsigned int k = 0; k < s; ++k)
          {
            a(k, l) = 0;
            for (unsigned int j = 0; j < s; ++j)
              a(k, l) += polynomial(j) * std::pow(c(k), j + 1) / (j + 1);
          }
      }
    a_alpha = a + alpha / (2 * (2. * s - 1)) * p * (p.cwiseProduct(b)).transpose();
    w       = inverse(a_alpha);

    const auto [values, right]  = general_eigen(a_alpha);
    const Eigen::MatrixXcd left = inverse(right);
    for (unsigned int k = 0; k < s; ++k)
      if (values(k).imag() >= 0)
        eigenvalues.push_back({values(k), left.row(k).transpose(), right.col(k)});
  }
} // namespace samara
