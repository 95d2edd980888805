#ifndef samara_solvers_supernodes_h
#define samara_solvers_supernodes_h

#include <cstddef>
#include <vector>

namespace samara
{
  /**
   * The division of L in P A Pᵀ = L D Lᵀ into supernodes: consecutive columns that have entries in the same rows, some
   * of them being zeros, and are stored as one dense matrix.
   */
  struct Supernodes
  {
    std::vector<int>         order;       ///< P: the old number of each new unknown
    std::vector<int>         first;       ///< column of each supernode; one more behind the last
    std::vector<std::size_t> row_start;   ///< of each supernode in the list of rows
    std::vector<int>         rows;        ///< new numbers, ascending, its own columns first
    std::vector<std::size_t> value_start; ///< of its matrix, stored by columns

    int
    size() const
    {
      return static_cast<int>(first.size()) - 1;
    }
    int
    n_columns(const int s) const
    {
      return first[s + 1] - first[s];
    }
    int
    n_rows(const int s) const
    {
      return static_cast<int>(row_start[s + 1] - row_start[s]);
    }
    const int *
    rows_of(const int s) const
    {
      return rows.data() + row_start[s];
    }
  };
} // namespace samara

#endif
