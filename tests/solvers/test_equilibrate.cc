#include <samara/solvers/equilibrate.h>
#include <samara/solvers/linear.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  /** Two springs in a row with a constraint and a multiplier, in units that make forces @p f times as large. */
  SparseMatrix
  matrix(const double f)
  {
    auto pattern          = std::make_shared<Pattern>();
    pattern->column_start = {0, 3, 5, 7};
    pattern->rows         = {0, 1, 2, 0, 1, 0, 2};
    SparseMatrix A(pattern);
    A.values = {2 * f, -f, 1, -f, f, 1, 0, 0};
    return A;
  }
} // namespace



// Units change neither the sign nor the condition that is seen, over twenty-four decades, and the largest entries are
// about 1.
TEST(Equilibrate, UnitsDoNotMatter)
{
  double condition = 0;
  for (const double f : {1., 1e-12, 1e12, 1e-24})
    {
      SparseMatrix A = matrix(f);
      equilibrate(A);
      const Eigen::MatrixXd dense = A.dense();
      for (unsigned int i = 0; i < 3; ++i)
        {
          EXPECT_GT(dense.row(i).cwiseAbs().maxCoeff(), 0.24);
          EXPECT_LT(dense.row(i).cwiseAbs().maxCoeff(), 4.1);
          EXPECT_EQ(dense.row(i).cwiseAbs().maxCoeff(), dense.col(i).cwiseAbs().maxCoeff());
        }
      EXPECT_LT(dense.determinant(), 0); // one negative eigenvalue, of the constraint
      const auto solver = make_solver(A.pattern);
      solver->factorize(A);
      EXPECT_EQ(solver->determinant_sign(), -1);
      condition = f == 1 ? solver->reciprocal_condition() : condition;
      EXPECT_GT(solver->reciprocal_condition(), 0.05 * condition);
    }
}



// A row of nothing stays one.
TEST(Equilibrate, EmptyRows)
{
  SparseMatrix A = matrix(1);
  A.values       = {4, 0, 0, 0, 0, 0, 0, 0};
  equilibrate(A);
  EXPECT_EQ(A.values[0], 1.);
  EXPECT_EQ(A.values[1], 0.);
  EXPECT_EQ(A.values[6], 0.);
}
