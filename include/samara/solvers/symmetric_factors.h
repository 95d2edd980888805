#ifndef samara_solvers_symmetric_factors_h
#define samara_solvers_symmetric_factors_h

#include <samara/model/matrix.h>
#include <samara/solvers/supernodes.h>

namespace samara
{
  /**
   * P S Pᵀ = L D Lᵀ, S = (A + Aᵀ)/2, with pivots on the diagonal in a given order, by supernodes: each one takes what
   * the earlier ones give it, by products of dense matrices (left-looking; Davis, Direct methods for sparse linear
   * systems, 2006, chapter 4). Half the work and half the memory of L U.
   *
   * What is not symmetric, N = (A − Aᵀ)/2, such as the moments of an iterate that are not in balance, must be little:
   * few entries, which are kept, and small, as solutions take it into account by iteration, S x ← b − N x. Where this
   * converges det A has the sign of det S.
   */
  class SymmetricFactors
  {
  public:
    void set_order(Supernodes structure);

    /** Whether N has so few entries that it is worth a trial; its entries are kept for factorize(). */
    bool split(const Pattern &pattern, const double *values);

    /** @return the column of the matrix whose pivot is zero, or -1; without pivots there are no factors. */
    int factorize(const Pattern &pattern, const double *values);

    /** Replace the right-hand side @p b by the solution, after n_passes with N. */
    void solve(double *b) const;

    /** The same for right-hand sides of @p size numbers, one behind the other: factors are read once for all of them.
     */
    void solve_columns(double *b, unsigned int n_columns, std::size_t size) const;

    /** C b, C = |D|^-1/2 L⁻¹ P: half of a solution, in the numbers of the matrix. Cᵀ diag(sign D) C is S⁻¹. */
    void forward_half(double *b) const;
    /** Cᵀ b */
    void backward_half(double *b) const;

    /** The sign of the pivot of each unknown. */
    bool
    is_negative(const int unknown) const
    {
      return pivots[place[unknown]] < 0;
    }

    /** The smallest pivot over the largest one, rows of the matrix scaled by their largest entries; 0 if not finite. */
    double
    reciprocal_condition() const
    {
      return rcond;
    }

    bool
    is_symmetric() const
    {
      return skew.empty();
    }

    int          n_negative_pivots = 0;
    unsigned int n_passes          = 0;

  private:
    /** An entry of N. */
    struct Skew
    {
      int    row, column;
      double value;
    };

    Supernodes          structure;
    std::vector<int>    place;  ///< new number of each unknown
    std::vector<double> values; ///< L, unit diagonals not stored
    std::vector<double> pivots;
    std::vector<Skew>   skew; ///< column by column
    double              rcond     = 0;
    int                 most_rows = 0; ///< of a supernode

    // of the supernode that is made
    std::vector<int>            local; ///< place of a row in it
    std::vector<double>         product, scaled;
    std::vector<int>            waiting, next_waiting, begin_waiting;
    mutable std::vector<double> x, work, right_side;

    void assemble(int supernode, const Pattern &pattern, const double *values, std::vector<double> &row_sizes);
    void subtract(int supernode, int source, int begin, int end);
    /** @return the column, in the supernode, whose pivot is zero, or -1 */
    int  eliminate(int supernode);
    void wait(int source, int begin);
    void judge_pivots(const std::vector<double> &row_sizes);
    void solve_symmetric(double *b) const;
    void forward() const;
    void backward() const;
    void forward_columns(unsigned int n_columns) const;
    void backward_columns(unsigned int n_columns) const;
  };
} // namespace samara

#endif
