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
  } // namespace



  std::vector<Matrix6>
  section_averages(const std::vector<double>            &points,
                   const std::vector<double>            &weights,
                   const std::vector<double>            &breaks,
                   const std::function<Matrix6(double)> &f)
  {
    std::vector<Matrix6> means(points.size(), Matrix6::Zero());
    for (const auto &[x, dx] : composite_rule(breaks, points_a_piece))
      {
        const Matrix6 f_x = f(x);
        for (unsigned int g = 0; g < points.size(); ++g)
          means[g] += dx / weights[g] * lagrange(points, g, x) * f_x;
      }
    const std::vector<Matrix6> plain = plain_averages(weights, breaks, f);
    for (unsigned int g = 0; g < points.size(); ++g)
      if (!is_not_less(means[g], 0.1 * plain[g]))
        return plain;
    return means;
  }
} // namespace samara
