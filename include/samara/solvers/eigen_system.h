#ifndef samara_solvers_eigen_system_h
#define samara_solvers_eigen_system_h

#include <samara/base/dense.h>

namespace samara
{
  /**
   * Eigenvalues of the real matrix @p A. A real one that is there several times comes out of round-off as pairs whose
   * imaginary part is nothing; each of the two is a real one of its own here, with a real vector of their plane.
   */
  EigenSystem eigen_system_of(const Eigen::MatrixXd &A);

  /**
   * How far each of these eigenvalues @p values of the real matrix @p A moves when entries of the matrix change without
   * order by up to @p change: those that are there twice, with one vector, by the root of it.
   */
  Eigen::VectorXd changes_of_values(const Eigen::MatrixXd &A, const Eigen::VectorXcd &values, double change);
} // namespace samara

#endif
