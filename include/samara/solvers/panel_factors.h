#ifndef samara_solvers_panel_factors_h
#define samara_solvers_panel_factors_h

#include <samara/solvers/panels.h>

#include <complex>

namespace samara
{
  /**
   * P A Q = L U with given pivots, for real or complex numbers: factorisation and solution by panels of rows.
   *
   * Kept are L, its rows divided by the pivots, and U, its rows divided by the pivots too, without their unit
   * diagonals.
   */
  template <typename Number>
  class PanelFactors
  {
  public:
    void set_pivots(const Pattern &pattern, Pivots pivots);

    /**
     * @param values of the pattern
     * @return the column of the matrix whose pivot is zero, or -1; without pivots there are no factors.
     */
    int factorize(const Number *values);

    /** Replace the right-hand side @p b by the solution. */
    void solve(Number *b) const;

    /** The smallest pivot over the largest one, rows of the matrix scaled by their largest entries; 0 if not finite. */
    double
    reciprocal_condition() const
    {
      return rcond;
    }

    std::vector<int> row_order, column_order; ///< P, Q: the old number of each new row and column
    int              n_negative_pivots = 0;   ///< of a real matrix

  private:
    template <int w>
    int factorize_panel(const Panel &panel, const Number *values);
    template <int w>
    void subtract_rows(const Panel &source);
    template <int w>
    void store_lower(const Panel &panel);
    template <int w>
    void store_upper(const Panel &panel, const Number *multipliers);
    template <int w>
    void judge_pivots(const Panel &panel, const Number *row_sizes);
    template <int w>
    void solve_lower(const Panel &panel, const Number *b) const;
    template <int w>
    void solve_upper(const Panel &panel, Number *b) const;

    PanelStructure      structure;
    std::vector<Number> lower, upper, inverse_pivots;
    double              smallest_pivot = 0, largest_pivot = 0, rcond = 0; // the first two squared

    std::vector<Number> rows; // those of a panel while they are eliminated: all columns, each as high as the panel
    mutable std::vector<Number> x;
  };
} // namespace samara

#endif
