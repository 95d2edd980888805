#ifndef samara_solvers_diagonal_order_h
#define samara_solvers_diagonal_order_h

#include <samara/solvers/panels.h>
#include <samara/solvers/supernodes.h>

namespace samara
{
  /**
   * An order of elimination with all pivots on the diagonal, and the entries and the work of the factors that follow
   * from it: from the pattern alone, before anything is factorised. By minimum degree (AMD) or, where that has much
   * work and this has less, nested dissection (METIS) of the graph of the groups of unknowns that have the same
   * neighbours, such as the six of a node (CHOLMOD; Davis, Direct methods for sparse linear systems, 2006, chapter 4).
   */
  class DiagonalOrder
  {
  public:
    /**
     * @param pattern symmetric in structure
     * @param is_late unknowns whose diagonal is zero, such as multipliers: they are eliminated when all unknowns that
     * stand in their equations have been
     */
    DiagonalOrder(const Pattern &pattern, const std::vector<bool> &is_late);

    /** Multiplications of a factorisation, L and U, and entries of both. @{ */
    double n_operations = 0, n_entries = 0;
    /** @} */

    /** Orders and places of entries for PanelFactors. */
    Pivots pivots() const;

    /** Columns of L with the same rows together, for SymmetricFactors. */
    Supernodes supernodes() const;

  private:
    std::vector<int> members, member_start; ///< unknowns, group by group in the order of elimination
    std::vector<int> rows, row_start;       ///< of L: groups before each one, ascending
    std::vector<int> parent;                ///< the first group behind each one that it acts on; -1: none
    std::vector<int> below;                 ///< unknowns behind each group in its column of L

    int
    weight(const int group) const
    {
      return member_start[group + 1] - member_start[group];
    }
    /** The first group of each supernode, and one more behind the last. */
    std::vector<int> first_groups() const;
  };

  /** Whether entries (i, j) and (j, i) are in a pattern together. */
  bool is_structure_symmetric(const Pattern &pattern);
} // namespace samara

#endif
