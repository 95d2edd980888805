#include <samara/base/dense.h>

#include <deal.II/base/exceptions.h>

#include <unsupported/Eigen/MatrixFunctions>

namespace samara
{
  using Eigen::MatrixXcd;
  using Eigen::MatrixXd;
  using Eigen::VectorXcd;
  using Eigen::VectorXd;
  using Complex = std::complex<double>;

  // Eigen reads the first number even of a matrix that has none, as of a model that nothing can move. The decomposition of
  // such a one is empty here.

  namespace
  {
    template <typename Matrix>
    void
    assert_square([[maybe_unused]] const Matrix &A)
    {
      Assert(A.rows() == A.cols(), dealii::ExcDimensionMismatch(A.rows(), A.cols()));
    }



    template <typename Number, typename Solver>
    HermitianEigen<Number>
    taken_from(const Solver &eigen)
    {
      if (eigen.info() != Eigen::Success)
        return {{}, {}, false};
      return {eigen.eigenvalues(), eigen.eigenvectors(), true};
    }
  } // namespace



  HermitianEigen<double>
  symmetric_eigen(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return taken_from<double>(Eigen::SelfAdjointEigenSolver<MatrixXd>(A));
  }



  VectorXd
  symmetric_eigenvalues(const RealMatrix &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
  }



  VectorXd
  symmetric_eigenvalues(const ComplexMatrix &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return Eigen::SelfAdjointEigenSolver<MatrixXcd>(A, Eigen::EigenvaluesOnly).eigenvalues();
  }



  HermitianEigen<double>
  symmetric_eigen(const RealMatrix &A, const RealMatrix &M)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return taken_from<double>(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, M));
  }



  HermitianEigen<Complex>
  symmetric_eigen(const ComplexMatrix &A, const ComplexMatrix &M)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return taken_from<Complex>(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXcd>(A, M));
  }



  EigenSystem
  general_eigen(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    const Eigen::EigenSolver<MatrixXd> eigen(A);
    return {eigen.eigenvalues(), eigen.eigenvectors()};
  }



  VectorXcd
  general_eigenvalues(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues();
  }



  VectorXcd
  general_eigenvalues(const MatrixXd &A, const MatrixXd &B)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return Eigen::GeneralizedEigenSolver<MatrixXd>(A, B, false).eigenvalues();
  }



  Schur<MatrixXd>
  real_schur(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    const Eigen::RealSchur<MatrixXd> schur(A);
    if (schur.info() != Eigen::Success)
      return {{}, {}, false};
    return {schur.matrixT(), schur.matrixU(), true};
  }



  Schur<MatrixXcd>
  complex_schur(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    const Eigen::ComplexSchur<MatrixXd> schur(A);
    if (schur.info() != Eigen::Success)
      return {{}, {}, false};
    return {schur.matrixT(), schur.matrixU(), true};
  }



  SingularValues
  singular_values(const MatrixXd &A)
  {
    if (A.size() == 0)
      return {MatrixXd::Identity(A.rows(), A.rows()), {}, MatrixXd::Identity(A.cols(), A.cols())};
    const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
  }



  MatrixXd
  exponential(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return A.exp();
  }



  MatrixXd
  logarithm(const MatrixXd &A)
  {
    assert_square(A);
    if (A.rows() == 0)
      return {};
    return A.log();
  }



  template <typename Number>
  LuFactors<Number>::LuFactors(const Matrix &A)
    : factors(A)
  {
    assert_square(A);
  }



  template <typename Number>
  void
  LuFactors<Number>::compute(const Matrix &A)
  {
    assert_square(A);
    factors.compute(A);
  }



  template <typename Number>
  typename LuFactors<Number>::Matrix
  LuFactors<Number>::solve(const Eigen::Ref<const Matrix> &B) const
  {
    return factors.solve(B);
  }



  template <typename Number>
  typename LuFactors<Number>::Matrix
  LuFactors<Number>::inverse() const
  {
    return factors.inverse();
  }



  template class LuFactors<double>;
  template class LuFactors<Complex>;



  MatrixXd
  inverse(const RealMatrix &A)
  {
    return Lu(A).inverse();
  }



  MatrixXcd
  inverse(const ComplexMatrix &A)
  {
    return ComplexLu(A).inverse();
  }



  MatrixXd
  solution(const RealMatrix &A, const RealMatrix &B)
  {
    return Lu(A).solve(B);
  }



  MatrixXcd
  solution(const ComplexMatrix &A, const ComplexMatrix &B)
  {
    return ComplexLu(A).solve(B);
  }



  FullLu::FullLu(const MatrixXd &A, const double threshold)
    : factors(A)
  {
    if (threshold > 0)
      factors.setThreshold(threshold);
  }



  int
  FullLu::rank() const
  {
    return factors.rank();
  }



  bool
  FullLu::is_invertible() const
  {
    return factors.isInvertible();
  }



  MatrixXd
  FullLu::kernel() const
  {
    // Eigen gives a column of zeros where there is no kernel
    return MatrixXd(factors.kernel()).leftCols(factors.dimensionOfKernel());
  }



  MatrixXd
  FullLu::solve(const RealMatrix &B) const
  {
    return factors.solve(B);
  }



  PivotedQr::PivotedQr(const MatrixXd &A, const double threshold)
  {
    if (threshold > 0)
      factors.setThreshold(threshold);
    // a column of zeros has the rank and the Q of none
    factors.compute(A.cols() > 0 ? A : MatrixXd(MatrixXd::Zero(A.rows(), 1)));
  }



  int
  PivotedQr::rank() const
  {
    return factors.rank();
  }



  double
  PivotedQr::pivot(const int k) const
  {
    AssertIndexRange(k, std::min(factors.rows(), factors.cols()));
    return std::abs(factors.matrixQR()(k, k));
  }



  int
  PivotedQr::column(const int k) const
  {
    AssertIndexRange(k, factors.cols());
    return factors.colsPermutation().indices()(k);
  }



  MatrixXd
  PivotedQr::Q() const
  {
    return factors.householderQ();
  }



  MatrixXd
  PivotedQr::leading(const int n) const
  {
    Assert(n <= factors.rows(), dealii::ExcIndexRange(n, 0, factors.rows() + 1));
    return factors.householderQ() * MatrixXd::Identity(factors.rows(), n);
  }



  MatrixXd
  PivotedQr::solve(const RealMatrix &B) const
  {
    return factors.solve(B);
  }



  MatrixXcd
  pivoted_q(const MatrixXcd &A)
  {
    if (A.cols() == 0)
      return MatrixXcd::Identity(A.rows(), A.rows());
    return Eigen::ColPivHouseholderQR<MatrixXcd>(A).householderQ();
  }



  MatrixXd
  orthonormal_columns(const MatrixXd &A)
  {
    Assert(A.cols() <= A.rows(), dealii::ExcMessage("More columns than rows cannot be orthonormal."));
    return Eigen::HouseholderQR<MatrixXd>(A).householderQ() * MatrixXd::Identity(A.rows(), A.cols());
  }



  MinimumNorm::MinimumNorm(const MatrixXd &A, const double threshold)
  {
    Assert(A.cols() > 0, dealii::ExcMessage("There is no solution without unknowns."));
    factors.setThreshold(threshold);
    factors.compute(A);
  }



  MatrixXd
  MinimumNorm::solve(const RealMatrix &B) const
  {
    return factors.solve(B);
  }



  MatrixXd
  MinimumNorm::null_space() const
  {
    // A P Zᵀ = Q [T 0]: the last columns of P Zᵀ are the null space
    if (factors.rank() == factors.cols())
      return MatrixXd(factors.cols(), 0);
    const MatrixXd Z = factors.matrixZ();
    return factors.colsPermutation() * Z.transpose().rightCols(factors.cols() - factors.rank());
  }



  template <typename Number>
  CholeskyFactors<Number>::CholeskyFactors(const Matrix &A)
    : factors(A)
  {
    assert_square(A);
  }



  template <typename Number>
  bool
  CholeskyFactors<Number>::is_positive() const
  {
    return factors.info() == Eigen::Success;
  }



  template <typename Number>
  VectorXd
  CholeskyFactors<Number>::pivots() const
  {
    return factors.matrixLLT().diagonal().real();
  }



  template <typename Number>
  typename CholeskyFactors<Number>::Matrix
  CholeskyFactors<Number>::upper() const
  {
    return factors.matrixU();
  }



  template <typename Number>
  typename CholeskyFactors<Number>::Matrix
  CholeskyFactors<Number>::solve(const Eigen::Ref<const Matrix> &B) const
  {
    return factors.solve(B);
  }



  template <typename Number>
  typename CholeskyFactors<Number>::Matrix
  CholeskyFactors<Number>::solve_lower(const Eigen::Ref<const Matrix> &B) const
  {
    return factors.matrixL().solve(B);
  }



  template <typename Number>
  typename CholeskyFactors<Number>::Matrix
  CholeskyFactors<Number>::solve_upper(const Eigen::Ref<const Matrix> &B) const
  {
    return factors.matrixU().solve(B);
  }



  template class CholeskyFactors<double>;
  template class CholeskyFactors<Complex>;



  SymmetricSolve::SymmetricSolve(const MatrixXd &A)
    : factors(A)
  {
    assert_square(A);
  }



  MatrixXd
  SymmetricSolve::solve(const RealMatrix &B) const
  {
    return factors.solve(B);
  }
} // namespace samara
