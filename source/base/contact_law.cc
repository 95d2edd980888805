#include <samara/base/contact_law.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  double
  ContactLaw::force(const double g) const
  {
    if (!(g > 0))
      return 0;
    return expression ? expression->force(g) : exponent == 1 ? stiffness * g : stiffness * std::pow(g, exponent);
  }



  double
  ContactLaw::slope(const double g) const
  {
    if (!(g > 0))
      return 0;
    return expression    ? expression->stiffness(g) :
           exponent == 1 ? stiffness :
                           stiffness * exponent * std::pow(g, exponent - 1);
  }



  double
  ContactLaw::energy(const double g) const
  {
    if (!(g > 0))
      return 0;
    return expression    ? expression->energy(g) :
           exponent == 1 ? 0.5 * stiffness * g * g :
                           stiffness / (exponent + 1) * std::pow(g, exponent + 1);
  }



  ContactLaw::Damper
  ContactLaw::damper(const double g, const double rate) const
  {
    if (!(g > 0) || !has_damping())
      return {0, 0, 0};
    const double spring = force(g), c = damping + factor * spring;
    if (spring + c * rate < 0)
      return {-spring, -slope(g), 0};
    return {c * rate, factor * slope(g) * rate, c};
  }



  ContactLaw::Mean
  ContactLaw::mean(const double a, const double b) const
  {
    if (a <= 0 && b <= 0)
      return {0, 0};
    const double way = b - a;
    if (a <= 0 || b <= 0)
      {
        // one of them is touched: the energies have no difference, and the signs make that of the gaps a sum
        const double mean = energy(std::max(a, b)) / std::abs(way);
        return {mean, b > 0 ? (force(b) - mean) / way : mean / -way};
      }
    if (expression)
      {
        const auto mean = expression->mean(a, b);
        return {mean.force, mean.slope};
      }
    if (exponent == 1)
      return {0.5 * stiffness * (a + b), 0.5 * stiffness};
    // of a power five points are exact to round-off where it hardly changes
    constexpr double close = 0.05;
    if (std::abs(way) < close * std::min(a, b))
      {
        static const dealii::QGauss<1> rule(5);
        Mean                           mean{0, 0};
        for (unsigned int i = 0; i < rule.size(); ++i)
          {
            const double x = rule.point(i)(0);
            mean.force += rule.weight(i) * force(a + x * way);
            mean.slope += rule.weight(i) * x * slope(a + x * way);
          }
        return mean;
      }
    const double mean = (energy(b) - energy(a)) / way;
    return {mean, (force(b) - mean) / way};
  }



  namespace
  {
    /** x − ln(1 + x), without cancellation. */
    double
    x_less_log(const double x)
    {
      constexpr double small = 0.05;
      if (std::abs(x) > small)
        return x - std::log1p(x);
      double sum = 0, power = x * x;
      for (unsigned int n = 2; n < 20; ++n, power *= -x)
        sum += power / n;
      return sum;
    }
  } // namespace



  double
  hunt_crossley_factor(const double e, const double speed)
  {
    if (e == 1)
      return 0;
    // the way in loses more of the integral than the way out for small a, and less for a towards 1/e
    double low = 0, high = 1 / e;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double a                                    = 0.5 * (low + high);
        (x_less_log(a) > x_less_log(-e * a) ? low : high) = a;
      }
    return 0.5 * (low + high) / speed;
  }
} // namespace samara
