#include <samara/solvers/level_by_level.h>

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
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(rank_tolerance * std::max(1., 1. / largest));
    decomposition.compute(AN);
    const int rank = decomposition.rank(), left = AN.cols() - rank;
    x += N * decomposition.solve(b - A * x);
    // A N P Zᵀ = Q [T 0]: the last columns of P Zᵀ are the null space
    const Eigen::MatrixXd Z = decomposition.matrixZ();
    N                       = (N * (decomposition.colsPermutation() * Z.transpose().rightCols(left))).eval();
  }
} // namespace samara
