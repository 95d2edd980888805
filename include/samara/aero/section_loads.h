#ifndef samara_aero_section_loads_h
#define samara_aero_section_loads_h

#include <samara/aero/air.h>
#include <samara/aero/airfoil.h>

#include <cmath>
#include <complex>

namespace samara
{
  /**
   * The loads of a section in its own axes e₁ along the span, e₂ to the leading edge, e₃ to the upper side.
   *
   * V [m/s] is the velocity of the air relative to the point at three quarters of the chord: V₂ < 0 comes from the
   * leading edge, V₃ is upwash. U = √(V₂² + V₃²), M = U/a; V₁, the sweep, makes no lift. With the effective upwash w,
   * V₃ of steady flow, the angle of attack is α = atan2(w, −V₂) and per length of span
   *
   *     f = ½ρcU² (η c_l l + c_d d) + ½ρcU c_d V₁ e₁      l = (w, −V₂)/√(V₂² + w²), d = (V₂, w)/√(V₂² + w²) in e₂, e₃
   *     m = ½ρc²U² c_m e₁                                 about the quarter chord, nose up
   *
   * with a factor η of the lift. Drag along the span: F. D. Harris, J. Am. Helicopter Soc. 11 (1966).
   */
  struct SectionOfWing
  {
    double         chord = 0, lift_factor = 1; ///< c [m], η
    const Airfoil *airfoil = nullptr, *next = nullptr;
    double         share = 0; ///< of the next airfoil

    Coefficients
    coefficients(const double alpha, const double mach) const
    {
      const Coefficients c = airfoil->at(alpha, mach);
      return share == 0 ? c : c.blended(next->at(alpha, mach), share);
    }
  };



  /** f₁ f₂ f₃ [N/m] and m [N] */
  template <typename Number>
  using SectionLoads = Eigen::Matrix<Number, 4, 1>;

  /** The loads, and what they depend on. */
  template <typename Number>
  struct SectionFlow
  {
    Number               speed = Number(0), alpha = Number(0), mach = Number(0); ///< U [m/s], α [rad]
    Number               lift = Number(0), drag = Number(0), moment = Number(0); ///< coefficients, η in that of lift
    SectionLoads<Number> loads = SectionLoads<Number>::Zero();
  };



  namespace internal
  {
    /** atan2(y, x) */
    inline double
    angle(const double y, const double x)
    {
      return std::atan2(y, x);
    }

    /** Continued along imaginary parts so small that their squares are lost. */
    inline std::complex<double>
    angle(const std::complex<double> &y, const std::complex<double> &x)
    {
      const double r2 = std::norm(std::complex<double>(x.real(), y.real()));
      return {std::atan2(y.real(), x.real()), (x.real() * y.imag() - y.real() * x.imag()) / r2};
    }

    inline double
    continued(const double value, const double, const double, const double, const double)
    {
      return value;
    }

    inline std::complex<double>
    continued(const double                value,
              const double                by_alpha,
              const double                by_mach,
              const std::complex<double> &alpha,
              const std::complex<double> &mach)
    {
      return {value, by_alpha * alpha.imag() + by_mach * mach.imag()};
    }
  } // namespace internal



  template <typename Number>
  SectionFlow<Number>
  section_flow(const SectionOfWing &section, const Air &air, const Vec3<Number> &V, const Number &upwash)
  {
    using std::sqrt;
    SectionFlow<Number> flow;
    const Number        square = V(1) * V(1) + V(2) * V(2), effective_square = V(1) * V(1) + upwash * upwash;
    if (std::real(square) == 0 || std::real(effective_square) == 0) // no flow, no loads
      return flow;
    flow.speed             = sqrt(square);
    flow.mach              = flow.speed / air.speed_of_sound;
    flow.alpha             = internal::angle(upwash, Number(-V(1)));
    const Number       Ue  = sqrt(effective_square);
    const Coefficients c   = section.coefficients(std::real(flow.alpha), std::real(flow.mach));
    const double       eta = section.lift_factor;
    flow.lift              = eta * internal::continued(c.lift, c.lift_alpha, c.lift_mach, flow.alpha, flow.mach);
    flow.drag              = internal::continued(c.drag, c.drag_alpha, c.drag_mach, flow.alpha, flow.mach);
    flow.moment            = internal::continued(c.moment, c.moment_alpha, c.moment_mach, flow.alpha, flow.mach);
    const Number q = 0.5 * air.density * section.chord * square, per_Ue = q / Ue;
    flow.loads << 0.5 * air.density * section.chord * flow.speed * flow.drag * V(0),
      per_Ue * (flow.lift * upwash + flow.drag * V(1)), per_Ue * (flow.drag * upwash - flow.lift * V(1)),
      q * section.chord * flow.moment;
    return flow;
  }



  /** ∂(loads)/∂(V₁, V₂, V₃, w), @p flow being section_flow(). */
  inline Eigen::Matrix4d
  section_tangent(const SectionOfWing       &section,
                  const Air                 &air,
                  const Vector3             &V,
                  const double               upwash,
                  const SectionFlow<double> &flow)
  {
    Eigen::Matrix4d J = Eigen::Matrix4d::Zero();
    if (flow.speed == 0)
      return J;
    using Row            = Eigen::RowVector4d;
    const double       U = flow.speed, Ue2 = V(1) * V(1) + upwash * upwash, Ue = std::sqrt(Ue2);
    const Coefficients c = section.coefficients(flow.alpha, flow.mach);
    const Row dU = Row(0, V(1), V(2), 0) / U, dalpha = Row(0, upwash, 0, -V(1)) / Ue2, dmach = dU / air.speed_of_sound;
    const Row dl = section.lift_factor * (c.lift_alpha * dalpha + c.lift_mach * dmach),
              dd = c.drag_alpha * dalpha + c.drag_mach * dmach, dm = c.moment_alpha * dalpha + c.moment_mach * dmach;
    // lift and drag directions turn by dα
    const double s = upwash / Ue, k = -V(1) / Ue, p = 0.5 * air.density * section.chord, q = p * U * U;
    J.row(0) = p * V(0) * (flow.drag * dU + U * dd) + Row(p * U * flow.drag, 0, 0, 0);
    J.row(1) = q * (dl * s - dd * k + (flow.lift * k + flow.drag * s) * dalpha) +
               2 * p * U * (flow.lift * s - flow.drag * k) * dU;
    J.row(2) = q * (dl * k + dd * s + (-flow.lift * s + flow.drag * k) * dalpha) +
               2 * p * U * (flow.lift * k + flow.drag * s) * dU;
    J.row(3) = section.chord * (q * dm + 2 * p * U * flow.moment * dU);
    return J;
  }
} // namespace samara

#endif
