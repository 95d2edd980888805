#include <samara/solvers/equilibrate.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  double
  power_of_two(const double x)
  {
    return std::ldexp(1., std::ilogb(x));
  }



  std::vector<double>
  equilibrating_factors(const SparseMatrix &A, const unsigned int n_passes)
  {
    const Pattern      &pattern = *A.pattern;
    const int           n       = pattern.size();
    std::vector<double> factor(n, 1.), largest(n);
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        std::fill(largest.begin(), largest.end(), 0.);
        for (int j = 0; j < n; ++j)
          for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
            {
              const int    i    = pattern.rows[k];
              const double size = std::abs(A.values[k]) * factor[i] * factor[j];
              largest[i]        = std::max(largest[i], size);
              largest[j]        = std::max(largest[j], size);
            }
        bool has_changed = false;
        for (int i = 0; i < n; ++i)
          if (largest[i] > 0 && std::isfinite(largest[i]))
            if (const double change = power_of_two(std::sqrt(largest[i])); change != 1.)
              {
                factor[i] /= change;
                has_changed = true;
              }
        if (!has_changed)
          break; // as all passes after it
      }
    return factor;
  }



  void
  equilibrate(SparseMatrix &A)
  {
    const Pattern            &pattern = *A.pattern;
    const std::vector<double> factor  = equilibrating_factors(A, 12);
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        A.values[k] *= factor[pattern.rows[k]] * factor[j];
  }
} // namespace samara
