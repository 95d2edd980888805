#include <samara/base/composite_rule.h>
#include <samara/cosserat/section_average.h>
#include <samara/rotation/matrix6.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    constexpr unsigned int points_a_piece = 8;

    /** Whether A − B has no negative eigenvalue, with numbers of different units made comparable. */
    bool
    is_not_less(const Matrix6 &A, const Matrix6 &B)
    {
      const Vector6 size  = B.diagonal().cwiseMax(A.diagonal().cwiseAbs());
      const Vector6 scale = size.unaryExpr([](const double x) { return x > 0 ? 1 / std::sqrt(x) : 0.; });
      const Matrix6 S     = scale.asDiagonal() * (A - B) * scale.asDiagonal();
      return symmetric_eigenvalues6(S)(0) >= -1e-10;
    }



    /** Means over the shares of the points, as long as their weights and one after another. */
    std::vector<Matrix6>
    plain_averages(const std::vector<double>            &weights,
                   const std::vector<double>            &breaks,
                   const std::function<Matrix6(double)> &f)
    {
      std::vector<Matrix6> means;
      double               start = 0;
      for (const double weight : weights)
        {
          const double        end = start + weight;
          std::vector<double> pieces(1, start);
          for (const double x : breaks)
            if (x > start && x < end)
              pieces.push_back(x);
          pieces.push_back(end);
          means.push_back(Matrix6::Zero());
          for (const auto &[x, dx] : composite_rule(pieces, points_a_piece))
            means.back() += dx / weight * f(x);
          start = end;
        }
      return means;
    }
    /** Breaks with further ones, between which no number of the diagonal changes much: by the factor below. */
    std::vector<double>
    refined(const std::vector<double> &breaks, const std::function<Matrix6(double)> &f)
    {
      // of 1/x over a factor of two, eight points of Gauss have 1e-12
      constexpr double                                        factor = 2, inside = 1e-6;
      constexpr unsigned int                                  most = 10; // halvings
      std::vector<double>                                     result;
      const std::function<void(double, double, unsigned int)> add =
        [&](const double a, const double b, const unsigned int halvings) {
          const Vector6 at_a = f(a + inside * (b - a)).diagonal().cwiseAbs(),
                        at_b = f(b - inside * (b - a)).diagonal().cwiseAbs();
          const bool is_so   = ((factor * at_a - at_b).minCoeff() >= 0 && (factor * at_b - at_a).minCoeff() >= 0);
          if (is_so || halvings == most)
            return result.push_back(b);
          add(a, 0.5 * (a + b), halvings + 1);
          add(0.5 * (a + b), b, halvings + 1);
        };
      result.push_back(breaks.front());
      for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
        add(breaks[i], breaks[i + 1], 0);
      return result;
    }



    /** The largest part of @p means, the rest being @p plain, that leaves each point the least share of the plain one.
     */
    double
    part_of_means(const std::vector<Matrix6> &means, const std::vector<Matrix6> &plain)
    {
      constexpr double       least      = 0.02; // more: quadrature is worse; less: points are stiffer than all others
      constexpr unsigned int bisections = 20;
      double                 part       = 1;
      for (unsigned int g = 0; g < means.size(); ++g)
        {
          const auto is_enough = [&](const double x) {
            return is_not_less(x * means[g] + (1 - x) * plain[g], least * plain[g]);
          };
          if (is_enough(part))
            continue;
          double low = 0;
          for (unsigned int k = 0; k < bisections; ++k)
            (is_enough(0.5 * (low + part)) ? low : part) = 0.5 * (low + part);
          part = low;
        }
      return part;
    }
  } // namespace



  std::vector<RulePoint>
  section_rule(const std::vector<double> &breaks, const std::function<Matrix6(double)> &f)
  {
    return composite_rule(refined(breaks, f), points_a_piece);
  }



  std::vector<Matrix6>
  section_averages(const std::vector<double>            &points,
                   const std::vector<double>            &weights,
                   const std::vector<double>            &given_breaks,
                   const std::function<Matrix6(double)> &f)
  {
    const std::vector<double> breaks = refined(given_breaks, f);
    std::vector<Matrix6>      means(points.size(), Matrix6::Zero());
    for (const auto &[x, dx] : composite_rule(breaks, points_a_piece))
      {
        const Matrix6 f_x = f(x);
        for (unsigned int g = 0; g < points.size(); ++g)
          means[g] += dx / weights[g] * lagrange(points, g, x) * f_x;
      }
    const std::vector<Matrix6> plain = plain_averages(weights, breaks, f);
    if (const double part = part_of_means(means, plain); part < 1)
      for (unsigned int g = 0; g < points.size(); ++g)
        means[g] = part * means[g] + (1 - part) * plain[g];
    return means;
  }
} // namespace samara
