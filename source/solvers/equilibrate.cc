#include <samara/solvers/equilibrate.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  equilibrate(SparseMatrix &A)
  {
    const Pattern &pattern  = *A.pattern;
    const int      n        = pattern.size();
    const auto     for_each = [&](const auto &f) {
      for (int j = 0; j < n; ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          f(pattern.rows[k], j, A.values[k]);
    };
    std::vector<double> factor(n, 1.), largest(n);
    // each pass takes the root of what is amiss: twelve leave of 1e24 one per cent
    for (unsigned int pass = 0; pass < 12; ++pass)
      {
        std::fill(largest.begin(), largest.end(), 0.);
        for_each([&](const int i, const int j, const double a) {
          const double size = std::abs(a) * factor[i] * factor[j];
          largest[i]        = std::max(largest[i], size);
          largest[j]        = std::max(largest[j], size);
        });
        for (int i = 0; i < n; ++i)
          if (largest[i] > 0 && std::isfinite(largest[i]))
            factor[i] /= std::sqrt(largest[i]);
      }
    for (double &f : factor)
      f = std::exp2(std::round(std::log2(f)));
    for_each([&](const int i, const int j, double &a) { a *= factor[i] * factor[j]; });
  }
} // namespace samara
