// Anderson's acceleration: what it owes to linear iterations, and where differences depend on one another.

#include <gtest/gtest.h>
#include <samara/base/dense.h>
#include <samara/solvers/anderson.h>

using namespace samara;

namespace
{
  /** x → A x + b with eigenvalues of which one is beyond 1, and the fixed point. */
  struct Linear
  {
    Eigen::MatrixXd A;
    Eigen::VectorXd b, solution;

    explicit Linear(const Eigen::VectorXd &eigenvalues)
    {
      const int       n = eigenvalues.size();
      Eigen::MatrixXd Q(n, n);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          Q(i, j) = std::sin(1. + 3 * i + 7 * j) + (i == j ? 2 : 0);
      A        = Q * eigenvalues.asDiagonal() * inverse(Q);
      solution = Eigen::VectorXd::LinSpaced(n, 1, 2);
      b        = solution - A * solution;
    }

    /** The error after as many passes. */
    double
    error_after(const unsigned int passes) const
    {
      Anderson        anderson;
      Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
      for (unsigned int i = 0; i < passes; ++i)
        x = anderson.next(x, A * x + b);
      return (x - solution).norm();
    }
  };
} // namespace



// of a linear iteration in n dimensions the combination of n + 1 corrections is the solution (as of GMRES)
TEST(Anderson, LinearIterationsEndWhenTheDimensionIsExhausted)
{
  const Linear four(Eigen::Vector4d(0.9, -0.8, 3, 0.5));
  EXPECT_GT(four.error_after(4), 1e-3);
  EXPECT_LT(four.error_after(6), 1e-9);
}



// few eigenvalues: the differences depend on one another from the third on, and round-off is no direction
TEST(Anderson, DependentDifferences)
{
  Eigen::VectorXd eigenvalues(20);
  eigenvalues.setConstant(0.3);
  eigenvalues(4) = 2.5;
  const Linear linear(eigenvalues);
  EXPECT_GT(linear.error_after(2), 1e-2);
  EXPECT_LT(linear.error_after(5), 1e-9);
  EXPECT_LT(linear.error_after(30), 1e-9);
}
