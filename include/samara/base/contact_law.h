#ifndef samara_base_contact_law_h
#define samara_base_contact_law_h

#include <samara/base/spring_law.h>

#include <memory>

namespace samara
{
  /**
   * What presses against a penetration g > 0 [m or rad]: U'(g) + χ U'(g) ġ + c ġ, never pulling; nothing at g ≤ 0.
   *
   *     U'(g) = k gⁿ,  n ≥ 1       linear for n = 1, Hertz' law of balls for n = 3/2
   *     U'(g) = F(g)               an expression with F(0) = 0
   *
   * χ [s/m or s/rad] is the damping of Hunt and Crossley, c [N s/m or N m s/rad] a viscous damper.
   */
  struct ContactLaw
  {
    double stiffness = 0; ///< k [N/mⁿ, or N m/radⁿ]
    double damping   = 0; ///< c
    double exponent  = 1; ///< n
    double factor    = 0; ///< χ

    std::shared_ptr<const SpringLaw> expression; ///< F; null: the power

    /** Whether it is a spring and a damper with constant coefficients. */
    bool
    is_linear() const
    {
      return exponent == 1 && factor == 0 && !expression;
    }
    bool
    has_damping() const
    {
      return factor != 0 || damping != 0;
    }

    double force(double g) const;  ///< U'
    double slope(double g) const;  ///< U''
    double energy(double g) const; ///< U [J]

    /** The damper's part at a rate of the penetration, cut so that the whole force does not pull. */
    struct Damper
    {
      double force, by_gap, by_rate; ///< its value and derivatives
    };
    Damper damper(double g, double rate) const;

    /**
     * (U(b) − U(a))/(b − a), in a form without a difference of energies where that would cancel, and its derivative by
     * b.
     */
    struct Mean
    {
      double force, slope;
    };
    Mean mean(double a, double b) const;
  };



  /**
   * χ [s/m] with which a single body that flies against a contact with the speed v [m/s] leaves it with e v, 0 < e ≤ 1.
   * With m g̈ = −U'(g)(1 + χ ġ), v dv/(1 + χ v) = −U' dg/m, whatever U and m: on the way in and out the integrals of
   * the left side are the same, a − ln(1 + a) = −e a − ln(1 − e a) with a = χ v. Hunt & Crossley, J. Appl. Mech. 42
   * (1975) 440, have the first term of this for e near 1, χ ≈ 3 (1 − e)/(2 v).
   */
  double hunt_crossley_factor(double restitution, double speed);
} // namespace samara

#endif
