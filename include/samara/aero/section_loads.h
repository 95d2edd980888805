#ifndef samara_aero_section_loads_h
#define samara_aero_section_loads_h

#include <samara/aero/air.h>
#include <samara/aero/airfoil.h>
#include <samara/aero/disk_corrections.h>
#include <samara/aero/separation.h>

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
   *     f = ½ρcU² (η c_l l + c_d d) + ½ρcU c_d V₁ e₁      l = (w', −V₂)/√(V₂² + w'²), d = (V₂, w')/√(V₂² + w'²) in e₂,
   * e₃ m = ½ρc²U² c_m e₁                                 about the quarter chord, nose up
   *
   * with w' = w − (c/2) Ω₁, the upwash at the quarter chord of a section that turns nose up with Ω₁: the circulation
   * follows from what three quarters of the chord meet, its force is normal to the flow at the bound vortex
   * (Kutta & Joukowski). To first order in Ω₁ the component along the chord is then the suction of the leading edge,
   * 2πρ(c/2) w_m² with the upwash w_m at half chord (I. E. Garrick, NACA Report 567, 1936).
   *
   * with a factor η of the lift, the user's times the F of tips (DiskCorrections). Where flow separates in time, x the
   * place of separation and f that of steady flow at α,
   *
   *     c_l + (x − f) ∂c_l        c_d + (c_d − c_d(α₀)) ((√f − √x)/2 − (f − x)/4)
   *
   * stand for c_l and c_d (Separation; the moment is that of steady flow). Drag along the span: F. D. Harris, J. Am.
   * Helicopter Soc. 11 (1966).
   */
  struct SectionOfWing
  {
    double         chord = 0, lift_factor = 1; ///< c [m], η
    const Airfoil *airfoil = nullptr, *next = nullptr;
    double         share = 0; ///< of the next airfoil

    std::shared_ptr<const Separation> separation; ///< null: the flow is that of steady motion

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
    /** √x, smooth where x goes to zero, and its slope. */
    template <typename Number>
    Number
    smooth_root(const Number &x)
    {
      using std::sqrt;
      constexpr double e = 1e-4;
      return sqrt(0.5 * (x + sqrt(x * x + e * e)));
    }

    inline double
    slope_of_smooth_root(const double x)
    {
      constexpr double e = 1e-4;
      const double     r = std::sqrt(x * x + e * e);
      return 0.25 * (1 + x / r) / std::sqrt(0.5 * (x + r));
    }

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
  } // namespace internal



  /** @p turning is (c/2) Ω₁ [m/s]. */
  template <typename Number>
  SectionFlow<Number>
  section_flow(const SectionOfWing &section,
               const Air           &air,
               const Vec3<Number>  &V,
               const Number        &upwash,
               const Number        &separated = Number(1),
               const Number        &kept      = Number(1),
               const Number        &turning   = Number(0))
  {
    using std::sqrt;
    SectionFlow<Number> flow;
    const Number        square = V(1) * V(1) + V(2) * V(2), at_vortex = upwash - turning,
                 vortex_square = V(1) * V(1) + at_vortex * at_vortex;
    const bool has_angle = std::real(V(1)) != 0 || std::real(upwash) != 0;
    if (std::real(square) == 0 || std::real(vortex_square) == 0 || !has_angle) // no flow, no loads
      return flow;
    flow.speed            = sqrt(square);
    flow.mach             = flow.speed / air.speed_of_sound;
    flow.alpha            = internal::angle(upwash, Number(-V(1)));
    const Number       Ue = sqrt(vortex_square);
    const Coefficients c  = section.coefficients(std::real(flow.alpha), std::real(flow.mach));
    flow.lift             = internal::continued(c.lift, c.lift_alpha, c.lift_mach, flow.alpha, flow.mach);
    flow.drag             = internal::continued(c.drag, c.drag_alpha, c.drag_mach, flow.alpha, flow.mach);
    flow.moment           = internal::continued(c.moment, c.moment_alpha, c.moment_mach, flow.alpha, flow.mach);
    if (section.separation != nullptr)
      {
        const auto         v  = section.separation->at(std::real(flow.alpha));
        const Coefficients c0 = section.coefficients(section.separation->zero_lift, std::real(flow.mach));
        const Number       f  = internal::continued(v.place, v.place_alpha, 0., flow.alpha, flow.mach),
                     gain     = internal::continued(v.gain, v.gain_alpha, 0., flow.alpha, flow.mach),
                     least    = internal::continued(c0.drag, 0., c0.drag_mach, flow.alpha, flow.mach);
        flow.lift += (separated - f) * gain;
        flow.drag += (flow.drag - least) *
                     (0.5 * (internal::smooth_root(f) - internal::smooth_root(separated)) - 0.25 * (f - separated));
      }
    flow.lift *= section.lift_factor * kept;
    const Number q = 0.5 * air.density * section.chord * square, per_Ue = q / Ue;
    flow.loads << 0.5 * air.density * section.chord * flow.speed * flow.drag * V(0),
      per_Ue * (flow.lift * at_vortex + flow.drag * V(1)), per_Ue * (flow.drag * at_vortex - flow.lift * V(1)),
      q * section.chord * flow.moment;
    return flow;
  }



  /** ∂(loads)/∂(V₁, V₂, V₃, w, x, F, (c/2)Ω₁), @p flow being section_flow(), F what is @p kept of the lift. */
  inline Eigen::Matrix<double, 4, 7>
  section_tangent(const SectionOfWing       &section,
                  const Air                 &air,
                  const Vector3             &V,
                  const double               upwash,
                  const double               separated,
                  const double               kept,
                  const double               turning,
                  const SectionFlow<double> &flow)
  {
    using Row                     = Eigen::Matrix<double, 1, 7>;
    Eigen::Matrix<double, 4, 7> J = Eigen::Matrix<double, 4, 7>::Zero();
    if (flow.speed == 0)
      return J;
    const auto row = [](const double a, const double b, const double c, const double d, const double e) {
      return (Row() << a, b, c, d, e, 0, 0).finished();
    };
    const double U = flow.speed, Ue2 = V(1) * V(1) + upwash * upwash, at_vortex = upwash - turning,
                 vortex2 = V(1) * V(1) + at_vortex * at_vortex, Uv = std::sqrt(vortex2);
    const Coefficients c  = section.coefficients(flow.alpha, flow.mach);
    const Row          dU = row(0, V(1) / U, V(2) / U, 0, 0), dalpha = row(0, upwash / Ue2, 0, -V(1) / Ue2, 0),
              dmach = dU / air.speed_of_sound;
    Row       dl = c.lift_alpha * dalpha + c.lift_mach * dmach, dd = c.drag_alpha * dalpha + c.drag_mach * dmach;
    const Row dm = c.moment_alpha * dalpha + c.moment_mach * dmach;
    if (section.separation != nullptr)
      {
        const auto         v  = section.separation->at(flow.alpha);
        const Coefficients c0 = section.coefficients(section.separation->zero_lift, flow.mach);
        const Row          dx = row(0, 0, 0, 0, 1), df = v.place_alpha * dalpha;
        const double       lack =
          0.5 * (internal::smooth_root(v.place) - internal::smooth_root(separated)) - 0.25 * (v.place - separated);
        dl += v.gain * (dx - df) + (separated - v.place) * v.gain_alpha * dalpha;
        dd += lack * (dd - c0.drag_mach * dmach) +
              (c.drag - c0.drag) * ((0.5 * internal::slope_of_smooth_root(v.place) - 0.25) * df -
                                    (0.5 * internal::slope_of_smooth_root(separated) - 0.25) * dx);
      }
    dl *= section.lift_factor * kept;
    dl(5) = flow.lift / kept;
    // lift and drag directions turn by dφ
    Row dphi       = row(0, at_vortex / vortex2, 0, -V(1) / vortex2, 0);
    dphi(6)        = V(1) / vortex2;
    const double s = at_vortex / Uv, k = -V(1) / Uv, p = 0.5 * air.density * section.chord, q = p * U * U;
    J.row(0) = p * V(0) * (flow.drag * dU + U * dd) + row(p * U * flow.drag, 0, 0, 0, 0);
    J.row(1) =
      q * (dl * s - dd * k + (flow.lift * k + flow.drag * s) * dphi) + 2 * p * U * (flow.lift * s - flow.drag * k) * dU;
    J.row(2) = q * (dl * k + dd * s + (-flow.lift * s + flow.drag * k) * dphi) +
               2 * p * U * (flow.lift * k + flow.drag * s) * dU;
    J.row(3) = section.chord * (q * dm + 2 * p * U * flow.moment * dU);
    return J;
  }
} // namespace samara

#endif
