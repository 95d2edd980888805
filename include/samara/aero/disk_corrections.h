#ifndef samara_aero_disk_corrections_h
#define samara_aero_disk_corrections_h

#include <samara/base/value.h>

#include <Eigen/Dense>

#include <cmath>
#include <complex>

namespace samara
{
  namespace internal
  {
    inline double
    continued(const double value, const double, const double, const double, const double)
    {
      return value;
    }

    /** @p value at the real parts of α and M, continued by its slopes to imaginary parts so small that squares are
     * lost. */
    inline std::complex<double>
    continued(const double                value,
              const double                by_alpha,
              const double                by_mach,
              const std::complex<double> &alpha,
              const std::complex<double> &mach)
    {
      return {value, by_alpha * alpha.imag() + by_mach * mach.imag()};
    }

    /** max(x, least) by real parts. */
    template <typename Number>
    Number
    at_least(const Number &x, const double least)
    {
      return std::real(x) > least ? x : Number(least);
    }

    /** L. Prandtl's factor (2/π) acos e^{−f}, f ≥ 0. */
    template <typename Number>
    Number
    prandtl_factor(const Number &f)
    {
      const double e = std::exp(-std::real(f));
      return continued(
        2 / M_PI * std::acos(e), 2 / M_PI * e / std::sqrt(-std::expm1(-2 * std::real(f))), 0., f, Number(0));
    }
  } // namespace internal



  /**
   * What an inflow that is a sum of shapes leaves out, as factors: the flow round tips and roots of a finite number of
   * blades, and the ground. Both depend on the flow through the disk as a whole, seen from the hub, axis 3 the thrust
   * axis: μ across it and λ_f against it without the rotor, and w̄, the mean of the inflow over the disk.
   *
   * Tips: the lift of a blade is multiplied by L. Prandtl's factor,
   *
   *     F = Π (2/π) acos e^{−f},  f = (Q/2)(R − r)/(r s) and (Q/2)(r − r₀)/(r₀ s),   s⁴ = λ⁴/(λ² + Ω²r²)² + 0.02⁴
   *
   * with Q blades, λ = λ_f + w̄ and the spin Ω of the blade about the thrust axis: s is the sine of the mean angle of
   * the flow to the disk, not that of the blade's own, and smooth all around the azimuth.
   *
   * Ground: the inflow is multiplied by
   *
   *     κ = (1 − q w̄²/(w̄² + μ²))^{3/2},  q = (R/4Z)²
   *
   * at the height Z of the hub above it, so that at constant power the thrust is 1/(1 − q w̄²/(w̄² + μ²)) of that without
   * ground: I. C. Cheeseman & W. E. Bennett, A.R.C. R.&M. 3021 (1955). Below Z = R/2 q goes on in a straight line
   * down to the ground, with one slope; there it is no more than a guess.
   */
  struct DiskCorrections
  {
    bool                has_tip_loss = false, has_ground = false;
    bool                needs_flow  = false; ///< for something else
    unsigned int        blades      = 1;     ///< Q
    double              root        = 0;     ///< r₀ (0: no loss at the root) [m]
    double              ground      = 0;     ///< inertial coordinate z of the ground [m]
    double              least_speed = 0;     ///< what is added to speeds that are divided by [m/s]
    std::vector<double> averages;            ///< of the inflow's shapes over the disk

    bool
    any() const
    {
      return has_tip_loss || has_ground || needs_flow;
    }

    /** μ₁, μ₂, λ_f, w̄ [m/s], Z [m] */
    template <typename Number>
    using Flow = Eigen::Matrix<Number, 5, 1>;

    /** κ of a disk of this @p radius [m] */
    template <typename Number>
    Number
    ground_factor(const Flow<Number> &flow, const double radius) const
    {
      using std::sqrt;
      const Number mean_2 = flow(3) * flow(3), mu_2 = flow(0) * flow(0) + flow(1) * flow(1);
      const Number share = mean_2 / (mean_2 + mu_2 + least_speed * least_speed);
      const Number left  = 1. - near_ground(flow(4), radius) * share;
      return left * sqrt(left);
    }

    /** F at the place (x, y) on a disk of this @p radius [m], with λ [m/s] and Ω [rad/s]. */
    template <typename Number>
    Number
    tip_factor(const Number &x, const Number &y, const Number &lambda, const Number &spin, const double radius) const
    {
      using std::sqrt;
      constexpr double least = 0.02 * 0.02 * 0.02 * 0.02;
      const Number     r = sqrt(x * x + y * y), l_2 = lambda * lambda + least_speed * least_speed,
                   sine_2 = l_2 / (l_2 + spin * spin * r * r), sine = sqrt(sqrt(sine_2 * sine_2 + least));
      Number F = internal::prandtl_factor(
        Number(0.5 * blades * internal::at_least(Number(radius - r), 1e-3 * radius) / (r * sine)));
      if (root > 0)
        F *= internal::prandtl_factor(
          Number(0.5 * blades * internal::at_least(Number(r - root), 1e-3 * root) / (root * sine)));
      return F;
    }

    /** ∂κ/∂flow */
    Eigen::Matrix<double, 1, 5>
    ground_slopes(const Flow<double> &flow, const double radius) const
    {
      Eigen::Matrix<double, 1, 5> slopes;
      for (unsigned int i = 0; i < 5; ++i)
        {
          Flow<std::complex<double>> at = flow.cast<std::complex<double>>();
          at(i) += std::complex<double>(0, step);
          slopes(i) = ground_factor<std::complex<double>>(at, radius).imag() / step;
        }
      return slopes;
    }

    /** ∂F/∂(x, y, λ, Ω) */
    Eigen::Matrix<double, 1, 4>
    tip_slopes(const double x, const double y, const double lambda, const double spin, const double radius) const
    {
      Eigen::Matrix<double, 1, 4> slopes;
      for (unsigned int i = 0; i < 4; ++i)
        {
          std::complex<double> at[] = {x, y, lambda, spin};
          at[i] += std::complex<double>(0, step);
          slopes(i) = tip_factor(at[0], at[1], at[2], at[3], radius).imag() / step;
        }
      return slopes;
    }

  private:
    static constexpr double step = 1e-30;

    /** q */
    template <typename Number>
    Number
    near_ground(const Number &height, const double radius) const
    {
      if (std::real(height) >= 0.5 * radius)
        return radius * radius / (16. * height * height);
      return 0.75 - internal::at_least(height, 0.) / radius;
    }
  };
} // namespace samara

#endif
