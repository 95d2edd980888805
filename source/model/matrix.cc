#include <samara/model/matrix.h>

#include <algorithm>

namespace samara
{
  int
  Pattern::position(const int row, const int column) const
  {
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
    for (const auto &[i, T] : transfers)
      {
        local.middleRows<6>(6 * i) = (T.transpose() * local.middleRows<6>(6 * i)).eval();
        local.middleCols<6>(6 * i) = (local.middleCols<6>(6 * i) * T).eval();
      }
    const double *const entries = local.data();
    double *const       values  = global.values.data();
    for (unsigned int k = 0; k < positions.size(); ++k)
      values[positions[k]] += entries[k];
  }
} // namespace samara
