#ifndef samara_solvers_panels_h
#define samara_solvers_panels_h

#include <samara/model/matrix.h>

namespace samara
{
  /** Columns with an entry, ascending, row by row. */
  struct RowLists
  {
    std::vector<int> start, columns;
  };

  /** The order of elimination P A Q = L U, and where the factors have entries beside their diagonals. */
  struct Pivots
  {
    std::vector<int> row_order, column_order; ///< P, Q: the old number of each new row and column
    RowLists         lower, upper;
  };



  /**
   * Consecutive rows of L and U that are stored with the same columns, some of the values being zeros. A panel's values
   * are those of the columns outside of its own ones, column by column, then those of its own columns beside the
   * diagonal, row by row.
   */
  struct Panel
  {
    int first, width; ///< rows, and its own columns
    // ranges in the lists of the structure
    int lower_begin, lower_end, upper_begin, upper_end;
    int sources_begin, sources_end;
    int runs_begin, runs_end;
    // places of the first value
    std::size_t lower_values, upper_values;

    int
    n_inside() const
    {
      return width * (width - 1) / 2;
    }
  };

  /**
   * The division of the factors into panels. Unknowns come in nodes and nodes in elements, so that neighbouring rows
   * mostly have the same columns anyway.
   */
  struct PanelStructure
  {
    static constexpr int max_width = 8;

    std::vector<Panel> panels;
    std::vector<int>   lower_columns, upper_columns; ///< outside columns of each panel
    std::vector<int>   sources;                      ///< panels whose rows are subtracted from those of each panel
    /** Entries of the matrix in the rows of each panel that follow each other, as those of a node do: where they are,
     * and where in a table of columns as high as the panel. */
    struct Run
    {
      int entry, place, length;
    };
    std::vector<Run> runs;
    std::size_t      n_lower_values = 0, n_upper_values = 0;

    PanelStructure() = default;
    /** @param parts 1 for real values, 2 for complex ones: widths are chosen for speed. */
    PanelStructure(const Pattern &pattern, const Pivots &pivots, int parts);

  private:
    /** With rows and outside columns known. */
    void add(Panel panel);
    void place_values();
    void find_runs(const Pattern &pattern, const Pivots &pivots);

    std::vector<int> panel_of; // row
  };
} // namespace samara

#endif
