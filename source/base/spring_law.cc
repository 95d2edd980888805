#include <samara/base/spring_law.h>
#include <samara/base/tokens.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace samara
{
  namespace
  {
    constexpr unsigned int n_points     = 8;
    constexpr unsigned int most_halving = 50;  ///< towards a jump of the curvature, say, of which nobody tells
    constexpr unsigned int most_parts   = 500; ///< where the force itself is less exact than what is asked for

    const dealii::QGauss<1> &
    rule()
    {
      static const dealii::QGauss<1> gauss(n_points);
      return gauss;
    }

    /** ∫ f from a to b, by Gauss' rule. */
    template <typename F>
    double
    by_rule(const F &f, const double a, const double b)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n_points; ++i)
        sum += rule().weight(i) * f(a + rule().point(i)(0) * (b - a));
      return sum * (b - a);
    }

    /** Halved until that, and halving once more, changes no more than @p round_off, or @p left_over halvings are used
     * up. */
    template <typename F>
    double
    by_halves(const F           &f,
              const double       a,
              const double       b,
              const double       whole,
              const double       round_off,
              const unsigned int depth,
              unsigned int      &left_over)
    {
      const double middle = 0.5 * (a + b), left = by_rule(f, a, middle), right = by_rule(f, middle, b);
      if (depth == 0 || left_over == 0)
        return left + right;
      --left_over;
      if (!(std::abs(left + right - whole) > round_off))
        {
          // once may be chance: a jump of the curvature can lie where the rule and its halves err by the same
          const double p = 0.5 * (a + middle), q = 0.5 * (middle + b),
                       quarters = by_rule(f, a, p) + by_rule(f, p, middle) + by_rule(f, middle, q) + by_rule(f, q, b);
          if (!(std::abs(quarters - left - right) > round_off))
            return quarters;
        }
      return by_halves(f, a, middle, left, round_off, depth - 1, left_over) +
             by_halves(f, middle, b, right, round_off, depth - 1, left_over);
    }
    /**
     * The same with linear tables in place of cubic ones: it has a corner at each of their rows, where the curvature of
     * the cubic jumps, which no rule between its points sees.
     */
    const ScalarFunction &
    with_linear_tables(const ScalarFunction &function)
    {
      if (function.text().find("cubic") == std::string::npos)
        return function;
      static std::mutex                            mutex;
      static std::map<std::string, ScalarFunction> all;
      const std::lock_guard<std::mutex>            guard(mutex);
      const std::string                           &text = function.text();
      if (const auto known = all.find(text); known != all.end())
        return known->second;
      std::string result, variable = "d";
      for (const Token &token : tokens_of(text))
        {
          result += token.kind == Token::word && token.text == "cubic" ? "linear" : token.text;
          if (token.kind == Token::word && token.text != "cubic" && token.text != "linear")
            variable = token.text;
        }
      return all.emplace(text, ScalarFunction(result, variable)).first->second;
    }
  } // namespace



  SpringLaw::SpringLaw(const ScalarFunction &force, const double origin)
    : function(force)
    , origin(origin)
  {}



  std::vector<double>
  SpringLaw::corners(const double from, const double to) const
  {
    std::vector<double>    places;
    const double           begin = std::min(from, to), end = std::max(from, to);
    const ScalarFunction  &pieces = with_linear_tables(function);
    constexpr unsigned int most   = 10'000; // of a formula that switches without end
    for (double at = begin; places.size() < most;)
      {
        at = pieces.next_corner(at, end);
        if (!(at < end))
          break;
        places.push_back(at);
      }
    if (to < from)
      std::reverse(places.begin(), places.end());
    return places;
  }



  SpringLaw::Mean
  SpringLaw::mean(const double from, const double to) const
  {
    const double way = to - from;
    if (way == 0)
      return {force(from), 0.5 * stiffness(from)};
    // ∫ F(from + x way) dx and ∫ x F'(from + x way) dx, x from 0 to 1
    std::vector<double> ends = corners(from, to);
    for (double &end : ends)
      end = (end - from) / way;
    ends.push_back(1);
    const auto   force_at = [&](const double x) { return force(from + x * way); };
    const auto   slope_at = [&](const double x) { return x * stiffness(from + x * way); };
    const auto   size_at  = [&](const double x) { return std::abs(force_at(x)); };
    Mean         result{0, 0};
    double       begin     = 0;
    const double round_off = 2e-15 * by_rule(size_at, 0, 1);
    for (const double end : ends)
      {
        unsigned int left_over = most_parts;
        result.force +=
          by_halves(force_at, begin, end, by_rule(force_at, begin, end), round_off, most_halving, left_over);
        result.slope += by_rule(slope_at, begin, end); // for matrices only
        begin = end;
      }
    return result;
  }



  template <typename Weight>
  double
  SpringLaw::weighted_stiffness(const double from, const double to, const Weight &w) const
  {
    const double        way  = to - from;
    std::vector<double> ends = way != 0 ? corners(from, to) : std::vector<double>();
    for (double &end : ends)
      end = (end - from) / way;
    ends.push_back(1);
    const auto   value     = [&](const double x) { return w(x) * stiffness(from + x * way); };
    const auto   size      = [&](const double x) { return std::abs(value(x)); };
    const double round_off = 2e-15 * by_rule(size, 0, 1);
    double       result = 0, begin = 0;
    for (const double end : ends)
      {
        unsigned int left_over = most_parts;
        result += by_halves(value, begin, end, by_rule(value, begin, end), round_off, most_halving, left_over);
        begin = end;
      }
    return result;
  }



  SpringLaw::MeanChange
  SpringLaw::mean_change(const double from, const double way) const
  {
    const double rest = weighted_stiffness(from, from + way, [](const double x) { return 1 - x; });
    return {way * rest, rest, weighted_stiffness(from, from + way, [](const double x) { return x; })};
  }



  double
  SpringLaw::rise(const double from, const double way) const
  {
    return way * weighted_stiffness(from, from + way, [](const double) { return 1.; });
  }



  double
  SpringLaw::energy(const double d) const
  {
    return d == origin ? 0. : (d - origin) * mean(origin, d).force;
  }
} // namespace samara
