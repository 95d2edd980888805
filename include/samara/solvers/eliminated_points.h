#ifndef samara_solvers_eliminated_points_h
#define samara_solvers_eliminated_points_h

#include <samara/model/matrix.h>
#include <samara/model/strain_rows.h>

#include <vector>

namespace samara
{
  /**
   * Points whose stresses s are eliminated from the equations
   *
   *     A ζ + Bᵀ s = f,     B ζ − F s = e,
   *
   * s = F⁻¹ (B ζ − e). Points that follow each other with the same unknowns, those of an element, stand in one dense B.
   * Vectors may be several, @p n_columns, one behind the other: (ζ, others) and behind them the stresses of all points.
   */
  class EliminatedPoints
  {
  public:
    EliminatedPoints() = default;

    /** @param first_stress of a vector; @param size of a vector */
    EliminatedPoints(unsigned int first_stress, unsigned int size);

    /**
     * Add a point of the rows Tᵀ B, B from @p first_row on, and the flexibility F.
     * @param first among the stresses
     */
    void add(const SparseRows      &B,
             unsigned int           first_row,
             const Eigen::MatrixXd &T,
             const Eigen::MatrixXd &F,
             unsigned int           first);

    bool
    empty() const
    {
      return groups.empty();
    }

    /** Add BᵀF⁻¹B to a matrix whose pattern holds all couplings of an element. */
    void add_stiffness(SparseMatrix &A) const;

    /** f += BᵀF⁻¹ e; whether there is any e. */
    void condense(double *b, unsigned int n_columns) const;

    /** s = F⁻¹ (B ζ − e), in the place of e. */
    void expand(double *b, unsigned int n_columns) const;

    /**
     * For solutions @p x with ζ only, of right-hand sides @p b: give x its stresses, and b what is left of the
     * equations, but for A ζ, condensed already: e − B ζ + F s behind, and f − Bᵀs + BᵀF⁻¹(e − B ζ + F s).
     */
    void refine(double *x, double *b, unsigned int n_columns) const;

    /** y += (Bᵀ s, B ζ − F s). */
    void add_product(const double *x, double *y, unsigned int n_columns) const;

    /** Give f every entry (row, column, value) of B, Bᵀ and −F. */
    template <typename Function>
    void
    for_entries(const Function &f) const
    {
      for (const Group &g : groups)
        {
          const auto B = g.B();
          for (int j = 0; j < B.cols(); ++j)
            for (int i = 0; i < B.rows(); ++i)
              if (B(i, j) != 0.)
                {
                  f(first_stress + g.first + i, g.unknowns[j], B(i, j));
                  f(g.unknowns[j], first_stress + g.first + i, B(i, j));
                }
          for (unsigned int p = 0, row = 0; p < g.F.size(); row += g.F[p++].rows())
            for (int i = 0; i < g.F[p].rows(); ++i)
              for (int j = 0; j < g.F[p].cols(); ++j)
                f(first_stress + g.first + row + i, first_stress + g.first + row + j, -g.F[p](i, j));
        }
    }

  private:
    using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

    /** An element. */
    struct Group
    {
      unsigned int                 first, n_stresses; ///< among the stresses
      std::vector<int>             unknowns;
      std::vector<double>          values;       ///< of B, row by row
      std::vector<Eigen::MatrixXd> F, stiffness; ///< of each point, F and F⁻¹

      Rows
      B() const
      {
        return {values.data(), static_cast<int>(n_stresses), static_cast<int>(unknowns.size())};
      }
    };

    using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

    unsigned int       first_stress = 0, size = 0;
    std::vector<Group> groups;

    static void            times(const std::vector<Eigen::MatrixXd> &blocks, Eigen::MatrixXd &x);
    static Eigen::MatrixXd local(const Group &g, const double *x, unsigned int n_columns, std::size_t size);
    static void            add_local(const Group &g, const Eigen::MatrixXd &local, double *y, std::size_t size);

    Block
    stresses(const Group &g, double *x, const unsigned int n_columns) const
    {
      return {x + first_stress + g.first, g.n_stresses, n_columns, Eigen::OuterStride<>(size)};
    }
  };
} // namespace samara

#endif
