#ifndef samara_rotation_matrix6_h
#define samara_rotation_matrix6_h

#include <samara/rotation/rotation.h>

namespace samara
{
  /**
   * Decompositions of the 6 x 6 matrices of sections, nodes and laminates, and of small symmetric ones. They are not
   * inline: Eigen's templates would be compiled in every source that asks.
   */

  /** The inverse of a regular matrix, by elimination with pivots. */
  Matrix6 inverse6(const Matrix6 &A);

  /** The inverse of a symmetric matrix that is not singular, by L D Lᵀ with pivots; the lower triangle is read. */
  Matrix6 symmetric_inverse(const Matrix6 &A);

  /** x of A x = b, by the same decomposition. */
  Vector6 symmetric_solution(const Matrix6 &A, const Vector6 &b);

  /** About the smallest over the largest eigenvalue of a symmetric matrix, as L D Lᵀ estimates it. */
  double symmetric_rcond(const Matrix6 &A);

  /** Whether A = L Lᵀ has a solution; the lower triangle is read. */
  bool is_positive_definite(const Matrix6 &A);

  /** Lᵀ of A = L Lᵀ, upper triangular; of a matrix that is not positive definite it means nothing. */
  Matrix6 cholesky_upper(const Matrix6 &A);

  /** The inverse of a positive definite matrix by L Lᵀ. */
  Matrix6 positive_inverse(const Matrix6 &A);

  /** Eigenvalues of a symmetric matrix, ascending. */
  Vector6         symmetric_eigenvalues6(const Matrix6 &A);
  Vector3         symmetric_eigenvalues3(const Matrix3 &A);
  Eigen::Vector2d symmetric_eigenvalues2(const Eigen::Matrix2d &A);

  /** Orthonormal eigenvectors of a symmetric matrix as columns, that of the smallest eigenvalue first. */
  Matrix3         symmetric_eigenvectors3(const Matrix3 &A);
  Eigen::Matrix2d symmetric_eigenvectors2(const Eigen::Matrix2d &A);
} // namespace samara

#endif
