#ifndef samara_solvers_row_scale_h
#define samara_solvers_row_scale_h

#include <samara/model/layout.h>

#include <cmath>

namespace samara
{
  /**
   * 1/|row of G| of a @p multiplier, taken from its column of the tangent @p K, with rotations counted as displacements
   * at the distance @p length [m]: times this a gap of the constraint is a length. 0 if nothing that moves is in the
   * row.
   */
  inline double
  row_scale(const Layout &layout, const SparseMatrix &K, const unsigned int multiplier, const double length)
  {
    const Pattern &pattern = *K.pattern;
    const int      column  = layout.of_multiplier(multiplier);
    double         square  = 0;
    for (int k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
      if (const int i = pattern.rows[k]; i < layout.n_kinematic())
        square += std::pow(K.values[k] / (layout.is_length(i) ? 1. : length), 2);
    return square > 0 ? 1 / std::sqrt(square) : 0.;
  }
} // namespace samara

#endif
