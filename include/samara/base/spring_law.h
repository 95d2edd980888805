#ifndef samara_base_spring_law_h
#define samara_base_spring_law_h

#include <samara/base/function_of_time.h>

namespace samara
{
  /**
   * The force F(d) of a nonlinear spring, its stiffness F', and its energy U with U' = F. d is a length [m] or an angle
   * [rad], F positive pulls d back [N] or [N m].
   *
   * Energies are integrals of F by Gauss' rule, on intervals that end at the corners of F and are halved until that
   * changes nothing.
   */
  class SpringLaw
  {
  public:
    /** The energy is zero at @p origin. */
    SpringLaw(const ScalarFunction &force, double origin);

    double
    force(const double d) const
    {
      return function(d);
    }
    double
    stiffness(const double d) const
    {
      return function.derivative(d);
    }
    double energy(double d) const;

    /**
     * The mean of F between two places, (U(b) − U(a))/(b − a) without the cancellation of that, and its derivative by
     * the second.
     */
    struct Mean
    {
      double force, slope;
    };
    Mean mean(double from, double to) const;

    /** What is linear in a small way, to round-off of that however short it is: for exact tangents. */
    struct MeanChange
    {
      double rise;           ///< mean(from, from + way).force − F(from)
      double by_from, by_to; ///< derivatives of that mean by both ends
    };
    MeanChange mean_change(double from, double way) const;

    /** F(from + way) − F(from), in the same way. */
    double rise(double from, double way) const;

    /** Where its stiffness jumps, see ScalarFunction::next_corner(). */
    std::vector<double> corners(double from, double to) const;

  private:
    ScalarFunction function;
    double         origin;

    /** ∫ w(x) F'(from + x (to − from)) dx, x from 0 to 1. */
    template <typename Weight>
    double weighted_stiffness(double from, double to, const Weight &w) const;
  };
} // namespace samara

#endif
