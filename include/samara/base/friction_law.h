#ifndef samara_base_friction_law_h
#define samara_base_friction_law_h

#include <cmath>

namespace samara
{
  /**
   * Dry friction of Stribeck and Coulomb, made smooth: a normal force N ≥ 0 and the slip w, a vector [m/s], give the
   * force
   *
   *     −N c(|w|²) w,     c = μ/√(|w|² + ε²),     μ = μ_d + (μ_s − μ_d) exp(−|w|²/v_s²)
   *
   * Its power −N c |w|² is never positive. What should stick creeps: under a force F < N μ_s with w ≈ ε F/√((N μ_s)² −
   * F²). The peak of N c |w| is that of μ_s, less about √(2 μ_s (μ_s − μ_d)) ε/v_s: take ε well below v_s.
   */
  struct FrictionLaw
  {
    double kinetic        = 0; ///< μ_d [1]
    double breakaway      = 0; ///< μ_s [1], not below μ_d
    double stribeck_speed = 1; ///< v_s [m/s]
    double sticking_speed = 0; ///< ε [m/s]

    template <typename Number>
    struct Value
    {
      Number c;     ///< [s/m]
      Number slope; ///< dc/d|w|²
    };

    template <typename Number>
    Value<Number>
    operator()(const Number &square) const
    {
      using std::exp;
      using std::sqrt;
      const double more = breakaway - kinetic, v_2 = stribeck_speed * stribeck_speed;
      const Number excess = more * exp(-square / v_2), mu = kinetic + excess,
                   root_2 = square + sticking_speed * sticking_speed, c = mu / sqrt(root_2);
      return {c, -excess / v_2 / sqrt(root_2) - 0.5 * c / root_2};
    }

    /** Slips up to this many times ε count as creep: of the force at which slip begins, 95 % hold them. */
    static constexpr double creeping = 3;
  };
} // namespace samara

#endif
