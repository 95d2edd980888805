#include <samara/solvers/backward_error.h>
#include <samara/solvers/diagonal_order.h>
#include <samara/solvers/factorization.h>
#include <samara/solvers/inertia.h>
#include <samara/solvers/symmetric_factors.h>

#include <deal.II/lac/lapack_support.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

extern "C" {
void dsytrf_(const char                    *uplo,
             const dealii::types::blas_int *n,
             double                        *a,
             const dealii::types::blas_int *lda,
             dealii::types::blas_int       *ipiv,
             double                        *work,
             const dealii::types::blas_int *lwork,
             dealii::types::blas_int       *info);
}

namespace samara
{
  namespace
  {
    /** Dense factors take so little time for matrices of this size, or, where others fail, of that. */
    constexpr int small_matrix = 250, medium_matrix = 1200;
    /** Of diagonal pivots: what they lose more may be signs. */
    constexpr double largest_loss = 1e-9;



    SparseMatrix
    symmetric_part(const Pattern &pattern, const std::vector<double> &values)
    {
      // the pattern belongs to the caller and outlives this
      SparseMatrix result(std::shared_ptr<const Pattern>(std::shared_ptr<const Pattern>(), &pattern));
      for (int j = 0; j < pattern.size(); ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          result.values[k] = 0.5 * (values[k] + values[pattern.position(j, pattern.rows[k])]);
      return result;
    }



    /** Each pivot of two rows has one negative eigenvalue. */
    std::optional<int>
    n_negative_of_dense(const SparseMatrix &A)
    {
      using Integer   = dealii::types::blas_int;
      const Integer n = A.pattern->size(), n_work = 64 * n;
      if (n == 0)
        return 0;
      Eigen::MatrixXd      dense = A.dense();
      std::vector<Integer> pivots(n);
      std::vector<double>  work(n_work);
      Integer              info = 0;
      dsytrf_("L", &n, dense.data(), &n, pivots.data(), work.data(), &n_work, &info);
      if (info < 0 || !dense.diagonal().allFinite())
        return std::nullopt;
      int n_negative = 0;
      for (Integer i = 0; i < n; ++i)
        if (pivots[i] > 0)
          n_negative += dense(i, i) < 0;
        else
          {
            ++n_negative;
            ++i;
          }
      return n_negative;
    }



    std::optional<int>
    n_negative_on_diagonal(const SparseMatrix &A)
    {
      const Pattern    &pattern = *A.pattern;
      std::vector<bool> is_late(pattern.size());
      for (int j = 0; j < pattern.size(); ++j)
        {
          const int k = pattern.position(j, j);
          is_late[j]  = k < 0 || A.values[k] == 0.;
        }
      SymmetricFactors factors;
      if (!factors.split(pattern, A.values.data()))
        return std::nullopt;
      factors.set_order(DiagonalOrder(pattern, is_late).supernodes());
      if (factors.factorize(pattern, A.values.data()) >= 0 || !(factors.reciprocal_condition() > 0) ||
          backward_error(pattern, A.values.data(), factors) > largest_loss)
        return std::nullopt;
      return factors.n_negative_pivots;
    }
  } // namespace



  std::optional<int>
  n_negative_eigenvalues(const Pattern &pattern, const std::vector<double> &values)
  {
    const SparseMatrix A = symmetric_part(pattern, values);
    if (pattern.size() <= small_matrix)
      return n_negative_of_dense(A);
    if (const auto n = n_negative_on_diagonal(A))
      return n;
    return pattern.size() <= medium_matrix ? n_negative_of_dense(A) : mumps_n_negative(pattern, A.values.data());
  }
} // namespace samara
