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
   *
   * With σ₀ > 0 it is that of bristles in place of it, which bend by z [m] and stick (LuGre: Canudas de Wit et al.,
   * IEEE Trans. Autom. Control 40 (1995) 419), with G = N μ(|w|²) and σ₀ without N, so that the energy ½ σ₀ z² does not
   * jump with the normal force:
   *
   *     ż = w − σ₀ |w| z/G         force −(σ₀ z + σ₁(w) ż),  σ₁(w) = σ₁/(1 + σ₁ |w|/(4 G))
   *
   * Of its power, f·w − σ₀ z·ż is lost. That is never negative: σ₁(w)² |w| ≤ 4 G σ₁(w), which σ₁ alone does not obey.
   */
  struct FrictionLaw
  {
    double kinetic        = 0; ///< μ_d [1]
    double breakaway      = 0; ///< μ_s [1], not below μ_d
    double stribeck_speed = 1; ///< v_s [m/s]
    double sticking_speed = 0; ///< ε [m/s]

    double bristle_stiffness = 0; ///< σ₀ [N/m]; 0: no bristles
    double bristle_damping   = 0; ///< σ₁ [N s/m]

    bool
    has_bristles() const
    {
      return bristle_stiffness > 0;
    }

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
      using std::sqrt;
      const auto   mu     = coefficient(square);
      const Number root_2 = square + sticking_speed * sticking_speed, c = mu.c / sqrt(root_2);
      return {c, mu.slope / sqrt(root_2) - 0.5 * c / root_2};
    }

    /** μ [1], as c, and dμ/d|w|². */
    template <typename Number>
    Value<Number>
    coefficient(const Number &square) const
    {
      using std::exp;
      const double v_2    = stribeck_speed * stribeck_speed;
      const Number excess = (breakaway - kinetic) * exp(-square / v_2);
      return {kinetic + excess, -excess / v_2};
    }

    /** Slips up to this many times ε count as creep: of the force at which slip begins, 95 % hold them. */
    static constexpr double creeping = 3;
  };
} // namespace samara

#endif
