#ifndef samara_tests_aero_goland_exact_h
#define samara_tests_aero_goland_exact_h

#include <samara/base/dense.h>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <functional>

namespace samara::aero_models
{
  /**
   * A uniform wing that is clamped at its root, in the air of T. Theodorsen (NACA Report 496, 1935) section by section:
   * bending w up and twist θ nose up of the elastic axis, harmonic with ω,
   *
   *     EI w'''' = ω²(m w − m d θ) + ρU²b (−L_h w/b + L_θ θ)
   *     GJ θ''   = −ω²(I θ − m d w) − ρU²b² (−M_h w/b + M_θ θ)
   *
   * d being how far the mass centre is behind the elastic axis, I the inertia about that, b half the chord and a b how
   * far the axis is behind half chord. It is a linear equation y' = A y of six numbers with constant coefficients:
   * exp(A L) takes what is unknown at the root to the moment, the force and the torque of the tip, which are zero. No
   * shapes are assumed, and nothing is divided into elements.
   */
  struct GolandWing
  {
    using Complex = std::complex<double>;

    double L = 6.096, b = 0.9144, a = -0.34, rho = 1.225, m = 35.71, d = 0.18288, EI = 9.77e6, GJ = 0.987e6,
           I = 7.445665 + 35.71 * 0.18288 * 0.18288;

    std::function<Complex(double)> deficiency; ///< C(k)

    /** C(k) = H₁/(H₁ + i H₀), Hankel's functions of the second kind. */
    static Complex
    theodorsen(const double k)
    {
      const Complex i(0, 1), H0 = std::cyl_bessel_j(0, k) - i * std::cyl_neumann(0, k),
                             H1 = std::cyl_bessel_j(1, k) - i * std::cyl_neumann(1, k);
      return H1 / (H1 + i * H0);
    }

    /** Zero where the wing can oscillate with @p omega in the wind U. */
    Complex
    determinant(const double U, const double omega) const
    {
      const double  k = omega * b / U, p2 = -omega * omega, q = rho * U * U * b;
      const Complex s(0, k), C = deficiency(k);
      const Complex L_h = M_PI * s * s + 2 * M_PI * C * s,
                    L_a = M_PI * (s - a * s * s) + 2 * M_PI * C * (1. + (0.5 - a) * s),
                    M_h = M_PI * a * s * s + 2 * M_PI * (a + 0.5) * C * s,
                    M_a = M_PI * (-(0.5 - a) * s - (1. / 8 + a * a) * s * s) +
                          2 * M_PI * (a + 0.5) * C * (1. + (0.5 - a) * s);
      // w, w', w'', w''', θ, θ'
      Eigen::Matrix<Complex, 6, 6> A = Eigen::Matrix<Complex, 6, 6>::Zero(), term, power;
      A(0, 1) = A(1, 2) = A(2, 3) = A(4, 5) = 1;
      A(3, 0)                               = (-p2 * m - q * L_h / b) / EI;
      A(3, 4)                               = (p2 * m * d + q * L_a) / EI;
      A(5, 0)                               = (-p2 * m * d + q * M_h) / GJ;
      A(5, 4)                               = (p2 * I - q * b * M_a) / GJ;
      // Taylor's series of a 1024th, squared ten times
      A *= L / 1024;
      power.setIdentity();
      term = power;
      for (unsigned int n = 1; n < 12; ++n)
        {
          term = (term * A / double(n)).eval();
          power += term;
        }
      for (unsigned int n = 0; n < 10; ++n)
        power = (power * power).eval();
      const int        at_tip[] = {2, 3, 5};
      Eigen::Matrix3cd D;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          D(i, j) = power(at_tip[i], at_tip[j]); // what is unknown at the root are the same three
      return D.determinant();
    }

    struct Flutter
    {
      double U, omega; ///< [m/s], [rad/s]
      double left;     ///< of the determinant
    };

    /** By Newton's method from the given place. */
    Flutter
    flutter(double U, double omega) const
    {
      double left = 1;
      for (unsigned int n = 0; n < 20 && left > 1e-13; ++n)
        {
          const double  h        = 1e-4;
          const Complex f        = determinant(U, omega),
                        by_U     = (determinant(U + h, omega) - determinant(U - h, omega)) / (2 * h),
                        by_omega = (determinant(U, omega + h) - determinant(U, omega - h)) / (2 * h);
          Eigen::Matrix2d J;
          J << by_U.real(), by_omega.real(), by_U.imag(), by_omega.imag();
          const Eigen::Vector2d step = J.inverse() * Eigen::Vector2d(f.real(), f.imag());
          U -= step(0);
          omega -= step(1);
          left = std::abs(determinant(U, omega));
        }
      return {U, omega, left};
    }
  };
} // namespace samara::aero_models

#endif
