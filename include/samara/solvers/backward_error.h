#ifndef samara_solvers_backward_error_h
#define samara_solvers_backward_error_h

#include <samara/model/matrix.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  /**
   * The largest part of an equation that a solution leaves of it, by rows (Oettli & Prager 1964), for a right-hand
   * side with a known solution: what pivots that are too small for their rows have lost.
   */
  template <typename Number, typename Factors>
  double
  backward_error(const Pattern &pattern, const Number *values, const Factors &factors)
  {
    const int           n = pattern.size();
    std::vector<Number> x(n), b(n);
    std::vector<double> sizes(n, 0.);
    const auto          add_product = [&](const double sign) {
      for (int j = 0; j < n; ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          {
            b[pattern.rows[k]] += sign * values[k] * x[j];
            sizes[pattern.rows[k]] += std::abs(values[k] * x[j]);
          }
    };
    for (int i = 0; i < n; ++i)
      x[i] = 1. + 0.5 * std::sin(double(i));
    add_product(1);
    x = b;
    factors.solve(x.data());
    add_product(-1);
    double error = 0;
    for (int i = 0; i < n; ++i)
      if (sizes[i] > 0)
        error = std::max(error, std::abs(b[i]) / sizes[i]);
    return std::isfinite(error) ? error : 1.;
  }
} // namespace samara

#endif
