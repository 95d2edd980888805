#include <samara/rotation/matrix6.h>

namespace samara
{
  Matrix6
  inverse6(const Matrix6 &A)
  {
    return A.inverse();
  }



  Matrix6
  symmetric_inverse(const Matrix6 &A)
  {
    return A.ldlt().solve(Matrix6::Identity());
  }



  Vector6
  symmetric_solution(const Matrix6 &A, const Vector6 &b)
  {
    return A.ldlt().solve(b);
  }



  double
  symmetric_rcond(const Matrix6 &A)
  {
    return A.ldlt().rcond();
  }



  bool
  is_positive_definite(const Matrix6 &A)
  {
    return A.llt().info() == Eigen::Success;
  }



  Matrix6
  cholesky_upper(const Matrix6 &A)
  {
    return A.llt().matrixU();
  }



  Matrix6
  positive_inverse(const Matrix6 &A)
  {
    return A.llt().solve(Matrix6::Identity());
  }



  Vector6
  symmetric_eigenvalues6(const Matrix6 &A)
  {
    return Eigen::SelfAdjointEigenSolver<Matrix6>(A, Eigen::EigenvaluesOnly).eigenvalues();
  }



  Vector3
  symmetric_eigenvalues3(const Matrix3 &A)
  {
    return Eigen::SelfAdjointEigenSolver<Matrix3>(A, Eigen::EigenvaluesOnly).eigenvalues();
  }



  Eigen::Vector2d
  symmetric_eigenvalues2(const Eigen::Matrix2d &A)
  {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(A, Eigen::EigenvaluesOnly).eigenvalues();
  }



  Matrix3
  symmetric_eigenvectors3(const Matrix3 &A)
  {
    return Eigen::SelfAdjointEigenSolver<Matrix3>(A).eigenvectors();
  }



  Eigen::Matrix2d
  symmetric_eigenvectors2(const Eigen::Matrix2d &A)
  {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(A).eigenvectors();
  }
} // namespace samara
