#ifndef samara_aero_annular_momentum_h
#define samara_aero_annular_momentum_h

#include <samara/aero/section_loads.h>

#include <array>
#include <cmath>

namespace samara
{
  /**
   * Momentum of the air that passes an annulus of a rotor's disk, and what the blade that is there does to it: the
   * theory of blade elements, each annulus by itself, each blade as if all were like it.
   *
   * Everything is seen from the hub, axis 3 the thrust axis. The free air u (wind less the velocity of the hub) goes
   * along it with s = u₃ (wind turbines s > 0, climb s < 0) and across it with μ = |(u₁, u₂)|. The blades brake it by
   * w against the thrust axis, and by v against the azimuth e_ψ. With Q blades that carry the forces f [N/m] along the
   * thrust axis and along e_ψ, for the pressure on the annulus
   *
   *     ρ k R ẇ = Q f₃/(2πr r') − 2ρF w V      ρ k R v̇ = Q f_ψ/(2πr r') − 2ρF v V       V = √(μ² + b² + ε²)
   *
   * (H. Glauert), r' = dr/ds of the line, ε a millionth of the air that meets the blade, so that slow rotors are like
   * fast ones. w and v are those at the blade, F w the mean of the annulus; F is Prandtl's
   * factor of tip and root,
   *
   *     F = Π (2/π) acos e^{−f},  f = (Q/2)(R − r)/(r |sin φ|) and (Q/2)(r − r₀)/(r₀ |sin φ|)
   *
   * φ being the angle of the relative air to the disk, |sin φ| ≥ 0.01. As long as w < 0.4 s, and where rotors climb, b
   * = s − w. Beyond that the wake is turbulent and momentum theory does not hold: M. L. Buhl, NREL/TP-500-36834
   * (2005),
   *
   *     2 F w b = ½ (8/9 s² + (4F − 40/9) s w + (50/9 − 4F) w²)
   *
   * until b = w − s, the flow of a rotor that hovers or descends slowly, is more: the range of vortex rings is bridged,
   * not described. Both pieces meet with one slope at w = 0.4 s. With s < 0 and w < 0 the same holds mirrored.
   *
   * Skewed wakes: the blade meets w (1 + (15π/32) X·ξ), ξ the place on the disk divided by R and X = (u₁, u₂)/(V₀ +
   * |s − w|), V₀ = √(μ² + (s − w)²) (D. M. Pitt & D. A. Peters, Vertica 5 (1981)). k = 8/(3π) is the apparent mass
   * of a rigid disk, which decides on the time constant alone.
   */
  struct AnnularMomentum
  {
    double       density = 0, radius = 0, root = 0; ///< ρ, R, r₀ (0: no loss at the root)
    double       apparent_mass = 8 / (3 * M_PI);    ///< k
    double       least_speed   = 0;                 ///< far below all speeds, for air and blades at rest [m/s]
    unsigned int blades        = 1;                 ///< Q
    bool         has_tip_loss = true, has_swirl = true, has_skew = true;

    /** States of a station: w, v [m/s]. */
    static constexpr unsigned int n_states = 2;

    /** What is known where a blade is, all in axes of the hub. */
    template <typename Number>
    struct Place
    {
      Vec3<Number> x;    ///< from the centre [m]
      Vec3<Number> free; ///< u [m/s]
      Number       w = Number(0), v = Number(0);
    };

    /** The velocity that the rotor adds to the air. */
    template <typename Number>
    Vec3<Number>
    induced(const Place<Number> &at) const
    {
      using std::sqrt;
      const Number r      = sqrt(at.x(0) * at.x(0) + at.x(1) * at.x(1));
      Number       factor = Number(1);
      if (has_skew)
        {
          const Number along = at.free(2) - at.w, square = along * along + least_speed * least_speed,
                       mu_2 = at.free(0) * at.free(0) + at.free(1) * at.free(1);
          factor += 15 * M_PI / 32 * (at.free(0) * at.x(0) + at.free(1) * at.x(1)) /
                    (radius * (sqrt(mu_2 + square) + sqrt(square)));
        }
      return {at.v * at.x(1) / r, -at.v * at.x(0) / r, -at.w * factor};
    }

    /** F at the radius @p r, with |sin φ| of the relative air. */
    template <typename Number>
    Number
    loss(const Number &r, const Number &sine) const
    {
      Number F = Number(1);
      if (has_tip_loss)
        F *= internal::prandtl_factor(
          Number(0.5 * blades * internal::at_least(Number(radius - r), 1e-3 * radius) / (r * sine)));
      if (root > 0)
        F *= internal::prandtl_factor(
          Number(0.5 * blades * internal::at_least(Number(r - root), 1e-3 * root) / (root * sine)));
      return F;
    }

    /** b, the axial flow to which momentum belongs; @p s and @p w [m/s]. */
    template <typename Number>
    static Number
    axial_flow(const Number &s, const Number &w, const Number &F)
    {
      if (std::real(s) * std::real(w) <= 0 || std::abs(std::real(w)) <= 0.4 * std::abs(std::real(s)))
        return s - w;
      const double sign = std::real(s) > 0 ? 1 : -1;
      const Number S = sign * s, W = sign * w,
                   b = (8. / 9 * S * S + (4. * F - 40. / 9) * S * W + (50. / 9 - 4. * F) * W * W) / (4. * F * W);
      return std::real(b) > std::real(W - S) ? b : Number(W - S);
    }

    /** ε², of the air @p relative to the blade */
    template <typename Number>
    Number
    least_square(const Vec3<Number> &relative) const
    {
      constexpr double part = 1e-6;
      return part * part * (relative(0) * relative(0) + relative(1) * relative(1) + relative(2) * relative(2)) +
             least_speed * least_speed;
    }

    /** V */
    template <typename Number>
    Number
    mass_flow(const Place<Number> &at, const Number &F, const Vec3<Number> &relative) const
    {
      using std::sqrt;
      const Number b = axial_flow(at.free(2), at.w, F);
      return sqrt(at.free(0) * at.free(0) + at.free(1) * at.free(1) + b * b + least_square(relative));
    }

    /** |sin φ| of the air @p relative to the blade. */
    template <typename Number>
    static Number
    sine_of(const Place<Number> &at, const Vec3<Number> &relative)
    {
      using std::sqrt;
      const Number r      = sqrt(at.x(0) * at.x(0) + at.x(1) * at.x(1)),
                   psi    = (at.x(0) * relative(1) - at.x(1) * relative(0)) / r,
                   square = psi * psi + relative(2) * relative(2);
      if (std::real(square) == 0)
        return Number(1);
      const Number sine = relative(2) / sqrt(square);
      return internal::at_least(Number(std::real(sine) < 0 ? -sine : sine), 0.01);
    }

    /** ẇ and v̇ under the force @p f per length of a blade of which @p width (r') is in the disk. */
    template <typename Number>
    std::array<Number, 2>
    rates(const Place<Number> &at, const Vec3<Number> &relative, const Vec3<Number> &f, const double width) const
    {
      using std::sqrt;
      const Number r = sqrt(at.x(0) * at.x(0) + at.x(1) * at.x(1)), F = loss(r, sine_of(at, relative)),
                   flow = 2. * F * mass_flow(at, F, relative), pressure = blades / (2 * M_PI * density * width) / r,
                   f_psi   = (at.x(0) * f(1) - at.x(1) * f(0)) / r;
      const double inertia = apparent_mass * radius;
      return {Number((pressure * f(2) - flow * at.w) / inertia),
              Number(((has_swirl ? pressure * f_psi : Number(0)) - flow * at.v) / inertia)};
    }

    /** What is differentiated by: place on the disk (2), free air (3), states (2), relative air (3), force (3). */
    static constexpr unsigned int n_inputs = 13;

    /** Derivatives, of induced() in rows 0 to 2 (by place, free air and states alone), and of rates(): complex steps.
     */
    Eigen::Matrix<double, 5, n_inputs>
    derivatives(const Place<double> &at, const Vector3 &relative, const Vector3 &f, double width) const;
  };
} // namespace samara

#endif
