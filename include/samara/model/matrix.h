#ifndef samara_model_matrix_h
#define samara_model_matrix_h

#include <samara/model/frame.h>

#include <memory>
#include <vector>

namespace samara
{
  /** Compressed columns of a square matrix with a symmetric pattern; rows are sorted in each column. */
  struct Pattern
  {
    std::vector<int> column_start, rows;

    int
    size() const
    {
      return column_start.size() - 1;
    }
    int
    n_nonzeros() const
    {
      return rows.size();
    }

    /** Position of an entry in the array of values; -1 if it is not in the pattern. */
    int position(int row, int column) const;
  };



  /** Some entries of a pattern, as a pattern of their own, and where each of them is among all. */
  struct PartOfPattern
  {
    std::shared_ptr<const Pattern> pattern;
    std::vector<int>               kept;

    /** Those with @p keep(row, column). */
    template <typename Keep>
    PartOfPattern(const Pattern &all, const Keep &keep)
    {
      auto part = std::make_shared<Pattern>();
      part->column_start.push_back(0);
      for (int j = 0; j < all.size(); ++j)
        {
          for (int k = all.column_start[j]; k < all.column_start[j + 1]; ++k)
            if (keep(all.rows[k], j))
              {
                part->rows.push_back(all.rows[k]);
                kept.push_back(k);
              }
          part->column_start.push_back(part->rows.size());
        }
      pattern = part;
    }
  };



  /** Values on a shared pattern; one more value behind the last takes what belongs to fixed nodes. */
  struct SparseMatrix
  {
    std::shared_ptr<const Pattern> pattern;
    std::vector<double>            values;

    explicit SparseMatrix(const std::shared_ptr<const Pattern> &pattern)
      : pattern(pattern)
      , values(pattern->n_nonzeros() + 1, 0.)
    {}

    void clear();
    void add(double factor, const SparseMatrix &other);
    /** y = A x */
    void            multiply(const double *x, double *y) const;
    Eigen::MatrixXd dense() const;
  };



  /**
   * The unknowns a local matrix couples, with the places of its entries in the global one, found once. Local unknowns
   * are, in this order: 6 twists for each frame in the frame's own axes, joint coordinates, states, multipliers.
   */
  class Block
  {
  public:
    unsigned int
    size() const
    {
      return rows.size();
    }

    template <typename Number>
    void
    add(Eigen::Matrix<Number, Eigen::Dynamic, 1> &local, Number *global) const
    {
      for (const auto &[i, T] : transfers)
        local.template segment<6>(6 * i) = (T.transpose() * local.template segment<6>(6 * i)).eval();
      for (unsigned int i = 0; i < rows.size(); ++i)
        global[rows[i]] += local(i);
    }

    void add(Eigen::MatrixXd &local, SparseMatrix &global) const;

    /**
     * @name Without a local vector or matrix
     * For what is known in the unknowns of the nodes themselves, and where most of the local matrix would be zero.
     * @{
     */
    /** The global unknown; the six of a frame's node follow each other. */
    int
    row(const unsigned int i) const
    {
      return rows[i];
    }

    /** Coefficients of the frames' twists, 6 columns a frame, become those of the nodes' twists. */
    template <typename Matrix>
    void
    to_nodes(Matrix &coefficients) const
    {
      for (const auto &[i, T] : transfers)
        coefficients.template middleCols<6>(6 * i) = (coefficients.template middleCols<6>(6 * i) * T).eval();
    }

    /** Add to one entry. */
    void
    add_entry(const unsigned int i, const unsigned int j, const double value, SparseMatrix &global) const
    {
      global.values[positions[i + rows.size() * j]] += value;
    }

    /** Add to the entries of all frames' twists; @p K has 6 rows and columns a frame. */
    void add_twists(const Eigen::Ref<const Eigen::MatrixXd> &K, SparseMatrix &global) const;

    /** Add @p g, 6 numbers a frame, to row and column @p i, an unknown behind the twists. */
    void add_border(unsigned int i, const Eigen::Ref<const Eigen::VectorXd> &g, SparseMatrix &global) const;
    /** @} */

  private:
    friend class Layout;

    unsigned int                                  n_frames = 0;
    std::vector<int>                              rows;      // global unknowns, those of the ground behind the last
    std::vector<int>                              positions; // of the entries, column by column
    std::vector<std::pair<unsigned int, Matrix6>> transfers; // of the frames that are not nodes themselves

    void add_column_of_twists(unsigned int j, const double *column, SparseMatrix &global) const;
  };
} // namespace samara

#endif
