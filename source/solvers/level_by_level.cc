#include <samara/solvers/level_by_level.h>

#include <samara/base/dense.h>

#include <Eigen/QR>

#include <algorithm>

namespace samara
{
  LevelByLevel::LevelByLevel(const unsigned int n)
    : x(Eigen::VectorXd::Zero(n))
    , N(Eigen::MatrixXd::Identity(n, n))
  {}



  void
  LevelByLevel::add(const Eigen::MatrixXd &A)
  {
    add(A, Eigen::VectorXd::Zero(A.rows()));
  }



  void
  LevelByLevel::add(const Eigen::MatrixXd &A, const Eigen::VectorXd &b)
  {
    if (A.rows() == 0 || N.cols() == 0)
      return;
    const Eigen::MatrixXd AN      = A * N;
    const double          largest = AN.colwise().norm().maxCoeff(); // the first pivot
    if (largest <= rank_tolerance)
      return; // said already
    const MinimumNorm decomposition(AN, rank_tolerance * std::max(1., 1. / largest));
    x += N * decomposition.solve(b - A * x);
    N = (N * decomposition.null_space()).eval();
  }
} // namespace samara
