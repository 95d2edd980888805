// Decompositions of dense matrices that Eigen leaves to its callers: of matrices without rows.

#include <samara/base/dense.h>

#include <gtest/gtest.h>

using namespace samara;



TEST(Dense, MatricesWithoutRowsHaveEmptyDecompositions)
{
  const Eigen::MatrixXd  none(0, 0);
  const Eigen::MatrixXcd complex_none(0, 0);
  EXPECT_EQ(symmetric_eigen(none).values.size(), 0);
  EXPECT_TRUE(symmetric_eigen(none).was_found);
  EXPECT_EQ(symmetric_eigen(none, none).values.size(), 0);
  EXPECT_EQ(symmetric_eigen(complex_none, complex_none).values.size(), 0);
  EXPECT_EQ(symmetric_eigenvalues(none).size(), 0);
  EXPECT_EQ(symmetric_eigenvalues(complex_none).size(), 0);
  EXPECT_EQ(general_eigen(none).values.size(), 0);
  EXPECT_EQ(general_eigenvalues(none).size(), 0);
  EXPECT_EQ(general_eigenvalues(none, none).size(), 0);
  EXPECT_TRUE(real_schur(none).was_found);
  EXPECT_EQ(real_schur(none).T.rows(), 0);
  EXPECT_EQ(complex_schur(none).U.rows(), 0);
  EXPECT_EQ(singular_values(none).sizes.size(), 0);
  EXPECT_EQ(exponential(none).rows(), 0);
  EXPECT_EQ(logarithm(none).rows(), 0);
  EXPECT_EQ(inverse(none).rows(), 0);
  EXPECT_EQ(solution(none, Eigen::MatrixXd(0, 2)).cols(), 2);
  EXPECT_EQ(orthonormal_columns(none).cols(), 0);
  EXPECT_TRUE(Cholesky(none).is_positive());
}



TEST(Dense, MatricesWithoutColumnsHaveFullSpaces)
{
  const Eigen::MatrixXd no_columns(3, 0), no_rows(0, 3), identity = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_EQ(PivotedQr(no_columns).rank(), 0);
  EXPECT_EQ(PivotedQr(no_columns).Q(), identity);
  EXPECT_EQ(PivotedQr(no_rows).rank(), 0);
  EXPECT_EQ(pivoted_q(Eigen::MatrixXcd(3, 0)), Eigen::MatrixXcd::Identity(3, 3));
  EXPECT_EQ(singular_values(no_columns).U, identity);
  EXPECT_EQ(singular_values(no_rows).V, identity);
  EXPECT_EQ(singular_values(no_rows).sizes.size(), 0);
}
