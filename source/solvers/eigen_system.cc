#include <samara/solvers/eigen_system.h>

#include <samara/base/dense.h>
#include <random>

namespace samara
{
  EigenSystem
  eigen_system_of(const Eigen::MatrixXd &A)
  {
    constexpr double round_off = 1e-10; // of maps, which come from converged steps
    EigenSystem      result    = general_eigen(A);
    for (int i = 0; i + 1 < A.cols(); ++i)
      if (const std::complex<double> value = result.values(i); value.imag() > 0 &&
                                                               value.imag() <= round_off * std::abs(value.real()) &&
                                                               result.values(i + 1) == std::conj(value))
        {
          // of pairs that are real to its own round-off Eigen gives the two vectors of the plane by themselves
          const Eigen::VectorXd u = result.vectors.col(i).real(), v = result.vectors.col(i).imag();
          const bool            are_apart = !(v.norm() > round_off * u.norm());
          const Eigen::VectorXd second    = are_apart ? result.vectors.col(i + 1).real().eval() : v;
          result.vectors.col(i)           = u.normalized().cast<std::complex<double>>();
          result.vectors.col(i + 1)       = second.normalized().cast<std::complex<double>>();
          result.values(i) = result.values(i + 1) = value.real();
        }
    return result;
  }



  Eigen::VectorXd
  changes_of_values(const Eigen::MatrixXd &A, const Eigen::VectorXcd &values, const double change)
  {
    std::mt19937                           generator(A.rows());
    std::uniform_real_distribution<double> number(-1., 1.);
    Eigen::MatrixXd                        changed = A;
    for (double &entry : changed.reshaped())
      entry += change * number(generator);
    const Eigen::VectorXcd after = eigen_system_of(changed).values;
    Eigen::VectorXd        result(values.size());
    for (int i = 0; i < values.size(); ++i)
      result(i) = (after.array() - values(i)).abs().minCoeff();
    return result;
  }
} // namespace samara
