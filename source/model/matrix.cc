#include <samara/model/matrix.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  int
  Pattern::position(const int row, const int column) const
  {
    AssertIndexRange(row, size());
    AssertIndexRange(column, size());
    const auto begin = rows.begin() + column_start[column], end = rows.begin() + column_start[column + 1],
               found = std::lower_bound(begin, end, row);
    return found != end && *found == row ? found - rows.begin() : -1;
  }



  void
  SparseMatrix::clear()
  {
    std::fill(values.begin(), values.end(), 0.);
  }



  void
  SparseMatrix::add(const double factor, const SparseMatrix &other)
  {
    Assert(pattern == other.pattern, dealii::ExcMessage("Matrices are added entry by entry: they share a pattern."));
    for (unsigned int k = 0; k < values.size(); ++k)
      values[k] += factor * other.values[k];
  }



  void
  SparseMatrix::multiply(const double *x, double *y) const
  {
    std::fill(y, y + pattern->size(), 0.);
    for (int j = 0; j < pattern->size(); ++j)
      for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
        y[pattern->rows[k]] += values[k] * x[j];
  }



  Eigen::MatrixXd
  SparseMatrix::dense() const
  {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(pattern->size(), pattern->size());
    for (int j = 0; j < pattern->size(); ++j)
      for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
        A(pattern->rows[k], j) = values[k];
    return A;
  }



  void
  Block::add(Eigen::MatrixXd &local, SparseMatrix &global) const
  {
    AssertDimension(positions.size(), rows.size() * rows.size()); // empty until the layout is complete
    AssertDimension(local.rows(), rows.size());
    AssertDimension(local.cols(), rows.size());
    for (const auto &[i, T] : transfers)
      for (unsigned int k = 0; k < rows.size(); ++k)
        local.col(k).segment<6>(6 * i) = (T.transpose() * local.col(k).segment<6>(6 * i)).eval();
    for (const auto &[i, T] : transfers)
      for (unsigned int k = 0; k < rows.size(); ++k)
        local.row(k).segment<6>(6 * i) = (local.row(k).segment<6>(6 * i) * T).eval();
    for (unsigned int j = 0; j < rows.size(); ++j)
      {
        const double *const column = local.data() + rows.size() * j;
        const int *const    places = positions.data() + rows.size() * j;
        add_column_of_twists(j, column, global);
        for (unsigned int i = 6 * n_frames; i < rows.size(); ++i)
          global.values[places[i]] += column[i];
      }
  }



  void
  Block::add_twists(const Eigen::Ref<const Eigen::MatrixXd> &K, SparseMatrix &global) const
  {
    AssertDimension(positions.size(), rows.size() * rows.size());
    AssertDimension(K.rows(), 6 * n_frames);
    AssertDimension(K.cols(), 6 * n_frames);
    for (unsigned int j = 0; j < 6 * n_frames; ++j)
      add_column_of_twists(j, K.data() + K.outerStride() * j, global);
  }



  void
  Block::add_border(const unsigned int i, const Eigen::Ref<const Eigen::VectorXd> &g, SparseMatrix &global) const
  {
    Assert(i >= 6 * n_frames, dealii::ExcMessage("A border belongs to an unknown behind the twists."));
    AssertIndexRange(i, rows.size());
    AssertDimension(g.size(), 6 * n_frames);
    add_column_of_twists(i, g.data(), global);
    for (unsigned int j = 0; j < 6 * n_frames; ++j)
      global.values[positions[i + rows.size() * j]] += g(j);
  }



  void
  Block::add_column_of_twists(const unsigned int j, const double *const column, SparseMatrix &global) const
  {
    // the six rows of a node stand side by side in each column; those of the ground are kept nowhere
    const int *const places  = positions.data() + rows.size() * j;
    const int        nowhere = global.values.size() - 1;
    for (unsigned int frame = 0; frame < n_frames; ++frame)
      if (places[6 * frame] != nowhere)
        {
          double *const       to   = global.values.data() + places[6 * frame];
          const double *const from = column + 6 * frame;
          for (int k = 0; k < 6; ++k)
            to[k] += from[k];
        }
  }
} // namespace samara
