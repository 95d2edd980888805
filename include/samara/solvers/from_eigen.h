#ifndef samara_solvers_from_eigen_h
#define samara_solvers_from_eigen_h

#include <samara/model/matrix.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <memory>

namespace samara
{
  /** A square compressed matrix of Eigen, with a pattern of its own. */
  inline std::unique_ptr<SparseMatrix>
  from_eigen(const Eigen::SparseMatrix<double> &A)
  {
    auto pattern = std::make_shared<Pattern>();
    pattern->column_start.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.outerSize() + 1);
    pattern->rows.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    auto result = std::make_unique<SparseMatrix>(pattern);
    std::copy_n(A.valuePtr(), A.nonZeros(), result->values.begin());
    return result;
  }
} // namespace samara

#endif
