#include <samara/base/chain_rule.h>

#include <cmath>

namespace samara
{
  namespace
  {
    using Arguments = const Jet *;

    Jet
    add(const Jet &x, const Jet &y)
    {
      return {x.value + y.value, x.first + y.first, x.second + y.second};
    }

    Jet
    negative(const Jet &x)
    {
      return {-x.value, -x.first, -x.second};
    }

    Jet
    multiply(const Jet &x, const Jet &y)
    {
      return {x.value * y.value,
              x.first * y.value + x.value * y.first,
              x.second * y.value + 2 * x.first * y.first + x.value * y.second};
    }

    Jet
    reciprocal(const Jet &x)
    {
      const double r = 1 / x.value;
      return chain(x, r, -r * r, 2 * r * r * r);
    }

    /** Its value is that of the division, not of the product with a rounded reciprocal. */
    Jet
    divide(const Jet &x, const Jet &y)
    {
      Jet result   = multiply(x, reciprocal(y));
      result.value = x.value / y.value;
      return result;
    }

    Jet
    power(const Jet &x, const Jet &y)
    {
      if (y.first != 0 || y.second != 0)
        {
          const Jet    ln_x = chain(x, std::log(x.value), 1 / x.value, -1 / (x.value * x.value));
          const Jet    z    = multiply(y, ln_x);
          const double f    = std::pow(x.value, y.value);
          return chain(z, f, f, f);
        }
      // A factor of zero comes first, so that t^1 has the second derivative 0 at t = 0 and not 0 * infinity.
      const double p      = y.value;
      const double first  = p == 0 ? 0 : p * std::pow(x.value, p - 1);
      const double second = (p == 0 || p == 1) ? 0 : p * (p - 1) * std::pow(x.value, p - 2);
      return chain(x, std::pow(x.value, p), first, second);
    }

    /** f and its derivatives from a logarithm to the base e^(1/scale). */
    Jet
    logarithm(const Jet &x, const double f, const double scale)
    {
      return chain(x, f, scale / x.value, -scale / (x.value * x.value));
    }

    Jet
    arc_tangent_2(const Jet &y, const Jet &x)
    {
      const double r2     = x.value * x.value + y.value * y.value;
      const double cross  = x.value * y.first - y.value * x.first;
      const double growth = 2 * (x.value * x.first + y.value * y.first);
      return {std::atan2(y.value, x.value),
              cross / r2,
              (x.value * y.second - y.value * x.second) / r2 - cross * growth / (r2 * r2)};
    }

    double
    sign(const double x)
    {
      return (x > 0) - (x < 0);
    }

    Jet
    logical(const bool b)
    {
      return {b ? 1. : 0., 0, 0};
    }

    using N = unsigned int;

    /** On which side of each other two numbers are. */
    double
    side(const Arguments a, N)
    {
      return sign(a[0].value - a[1].value);
    }

    double
    side_of_zero(const Arguments a, N)
    {
      return sign(a->value);
    }

    /** atan2 jumps between the second quadrant and the third: two pieces; the right half is another. */
    double
    left_quadrant(const Arguments a, N)
    {
      return a[1].value >= 0 ? 0 : a[0].value < 0 ? -1 : 1;
    }

    using Rule = DimensionRule;

    JetOperation
    of_one(const std::string           &name,
           const JetOperation::Function apply,
           const JetOperation::Piece    piece = nullptr,
           const Rule                   rule  = Rule::numbers)
    {
      return {name, 1, 1, apply, 0, piece, rule};
    }

    double
    round_half_up(const double x)
    {
      return std::floor(x + 0.5);
    }

    /** A function that is constant on each of its pieces, which its values tell from each other. */
    template <double (*f)(double)>
    JetOperation
    step_function(const std::string &name, const Rule rule = Rule::numbers)
    {
      return of_one(
        name,
        [](Arguments a, N) -> Jet {
          return {f(a->value), 0, 0};
        },
        [](Arguments a, N) { return std::isnan(a->value) ? 0 : f(a->value); },
        rule);
    }

    /** Which of many is before all others in an order; what is no number is before all. */
    template <typename Before>
    unsigned int
    foremost(const Arguments x, const unsigned int n)
    {
      unsigned int best = 0;
      for (unsigned int i = 1; i < n && !std::isnan(x[best].value); ++i)
        if (std::isnan(x[i].value) || Before()(x[i].value, x[best].value))
          best = i;
      return best;
    }

    template <typename Before>
    JetOperation
    selection(const std::string &name)
    {
      return {name,
              1,
              1000,
              [](Arguments a, N n) { return a[foremost<Before>(a, n)]; },
              0,
              [](Arguments a, N n) -> double { return foremost<Before>(a, n); },
              Rule::alike};
    }

    /** x between lo and hi; hi where lo is above it. */
    Jet
    saturated(const Arguments a, N)
    {
      for (unsigned int i = 0; i < 3; ++i)
        if (std::isnan(a[i].value))
          return a[i];
      return a[0].value > a[2].value || a[1].value > a[2].value ? a[2] : a[0].value < a[1].value ? a[1] : a[0];
    }

    double
    side_of_limits(const Arguments a, N)
    {
      return 3 * sign(a[0].value - a[1].value) + sign(a[0].value - a[2].value);
    }

    /** 0 for |x| up to the width, beyond as if x began there. */
    Jet
    beyond_deadband(const Arguments a, N)
    {
      const double side = sign(a[0].value);
      if (!(side * a[0].value > a[1].value))
        return {std::isnan(a[0].value + a[1].value) ? a[0].value + a[1].value : 0., 0, 0};
      return add(a[0], {-side * a[1].value, -side * a[1].first, -side * a[1].second});
    }

    double
    side_of_deadband(const Arguments a, N)
    {
      return sign(a[0].value - a[1].value) + 3 * sign(a[0].value + a[1].value);
    }

    std::vector<JetOperation>
    trigonometric_functions()
    {
      using std::sqrt;
      return {of_one("sin",
                     [](Arguments a, N) {
                       const double x = a->value;
                       return chain(*a, std::sin(x), std::cos(x), -std::sin(x));
                     }),
              of_one("cos",
                     [](Arguments a, N) {
                       const double x = a->value;
                       return chain(*a, std::cos(x), -std::sin(x), -std::cos(x));
                     }),
              of_one("tan",
                     [](Arguments a, N) {
                       const double f = std::tan(a->value), df = 1 + f * f;
                       return chain(*a, f, df, 2 * f * df);
                     }),
              of_one("asin",
                     [](Arguments a, N) {
                       const double x = a->value, r = 1 / sqrt(1 - x * x);
                       return chain(*a, std::asin(x), r, x * r * r * r);
                     }),
              of_one("acos",
                     [](Arguments a, N) {
                       const double x = a->value, r = 1 / sqrt(1 - x * x);
                       return chain(*a, std::acos(x), -r, -x * r * r * r);
                     }),
              of_one("atan",
                     [](Arguments a, N) {
                       const double x = a->value, r = 1 / (1 + x * x);
                       return chain(*a, std::atan(x), r, -2 * x * r * r);
                     }),
              {"atan2", 2, 2, [](Arguments a, N) { return arc_tangent_2(a[0], a[1]); }, 0, left_quadrant, Rule::ratio}};
    }

    std::vector<JetOperation>
    exponential_functions()
    {
      using std::sqrt;
      return {of_one("sinh",
                     [](Arguments a, N) {
                       const double x = a->value;
                       return chain(*a, std::sinh(x), std::cosh(x), std::sinh(x));
                     }),
              of_one("cosh",
                     [](Arguments a, N) {
                       const double x = a->value;
                       return chain(*a, std::cosh(x), std::sinh(x), std::cosh(x));
                     }),
              of_one("tanh",
                     [](Arguments a, N) {
                       const double f = std::tanh(a->value), df = 1 - f * f;
                       return chain(*a, f, df, -2 * f * df);
                     }),
              of_one("asinh",
                     [](Arguments a, N) {
                       const double x = a->value, r = 1 / sqrt(x * x + 1);
                       return chain(*a, std::asinh(x), r, -x * r * r * r);
                     }),
              of_one("acosh",
                     [](Arguments a, N) {
                       const double x = a->value, r = 1 / sqrt(x * x - 1);
                       return chain(*a, std::acosh(x), r, -x * r * r * r);
                     }),
              of_one("atanh",
                     [](Arguments a, N) {
                       const double x = a->value, r = 1 / (1 - x * x);
                       return chain(*a, std::atanh(x), r, 2 * x * r * r);
                     }),
              of_one("exp",
                     [](Arguments a, N) {
                       const double f = std::exp(a->value);
                       return chain(*a, f, f, f);
                     }),
              of_one("ln", [](Arguments a, N) { return logarithm(*a, std::log(a->value), 1); }),
              of_one("log", [](Arguments a, N) { return logarithm(*a, std::log(a->value), 1); }),
              of_one("log2", [](Arguments a, N) { return logarithm(*a, std::log2(a->value), 1 / std::log(2.)); }),
              of_one("log10", [](Arguments a, N) { return logarithm(*a, std::log10(a->value), 1 / std::log(10.)); }),
              of_one(
                "sqrt",
                [](Arguments a, N) {
                  const double f = sqrt(a->value);
                  return chain(*a, f, 0.5 / f, -0.25 / (f * f * f));
                },
                nullptr,
                Rule::square_root)};
    }

    std::vector<JetOperation>
    piecewise_functions()
    {
      return {of_one(
                "abs",
                [](Arguments a, N) { return chain(*a, std::abs(a->value), sign(a->value), 0); },
                side_of_zero,
                Rule::alike),
              step_function<sign>("sign", Rule::any),
              step_function<round_half_up>("rint"),
              step_function<std::floor>("floor"),
              step_function<std::ceil>("ceil"),
              {"saturate", 3, 3, saturated, 0, side_of_limits, Rule::alike},
              {"deadband", 2, 2, beyond_deadband, 0, side_of_deadband, Rule::alike},
              selection<std::less<>>("min"),
              selection<std::greater<>>("max")};
    }
  } // namespace



  const JetOperation &
  jet_negative()
  {
    static const JetOperation operation = {
      "negative", 1, 1, [](Arguments a, N) { return negative(*a); }, 0, nullptr, DimensionRule::alike};
    return operation;
  }



  const std::vector<JetOperation> &
  jet_functions()
  {
    static const auto all = []() {
      auto list = trigonometric_functions();
      for (const auto &more : {exponential_functions(), piecewise_functions()})
        list.insert(list.end(), more.begin(), more.end());
      return list;
    }();
    return all;
  }



  const std::vector<JetOperation> &
  jet_operators()
  {
    static const std::vector<JetOperation> all = {
      {"||", 2, 2, [](Arguments a, N) { return logical(a[0].value != 0 || a[1].value != 0); }, 1},
      {"&&", 2, 2, [](Arguments a, N) { return logical(a[0].value != 0 && a[1].value != 0); }, 2},
      {"<", 2, 2, [](Arguments a, N) { return logical(a[0].value < a[1].value); }, 3, side, Rule::comparison},
      {"<=", 2, 2, [](Arguments a, N) { return logical(a[0].value <= a[1].value); }, 3, side, Rule::comparison},
      {">", 2, 2, [](Arguments a, N) { return logical(a[0].value > a[1].value); }, 3, side, Rule::comparison},
      {">=", 2, 2, [](Arguments a, N) { return logical(a[0].value >= a[1].value); }, 3, side, Rule::comparison},
      {"==", 2, 2, [](Arguments a, N) { return logical(a[0].value == a[1].value); }, 3, side, Rule::comparison},
      {"!=", 2, 2, [](Arguments a, N) { return logical(a[0].value != a[1].value); }, 3, side, Rule::comparison},
      {"+", 2, 2, [](Arguments a, N) { return add(a[0], a[1]); }, 4, nullptr, Rule::alike},
      {"-", 2, 2, [](Arguments a, N) { return add(a[0], negative(a[1])); }, 4, nullptr, Rule::alike},
      {"*", 2, 2, [](Arguments a, N) { return multiply(a[0], a[1]); }, 5, nullptr, Rule::product},
      {"/", 2, 2, [](Arguments a, N) { return divide(a[0], a[1]); }, 5, nullptr, Rule::quotient},
      {"^", 2, 2, [](Arguments a, N) { return power(a[0], a[1]); }, 6, nullptr, Rule::power}};
    return all;
  }
} // namespace samara
