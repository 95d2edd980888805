#include <samara/section/symmetric_matrix.h>

#include <stdexcept>
#include <string>

namespace samara
{
  Matrix6
  symmetric_matrix(const std::vector<double> &numbers)
  {
    Matrix6 A = Matrix6::Zero();
    if (numbers.size() == 6)
      A.diagonal() = Eigen::Map<const Vector6>(numbers.data());
    else if (numbers.size() == 21)
      for (unsigned int i = 0, k = 0; i < 6; ++i)
        for (unsigned int j = i; j < 6; ++j, ++k)
          A(i, j) = A(j, i) = numbers[k];
    else if (numbers.size() == 36)
      A = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(numbers.data());
    else
      throw std::invalid_argument("a symmetric 6x6 matrix is given by 36, 21 or 6 numbers, not by " +
                                  std::to_string(numbers.size()));
    if ((A - A.transpose()).norm() > 1e-6 * A.norm())
      throw std::invalid_argument("the matrix is not symmetric");
    return 0.5 * (A + A.transpose());
  }
} // namespace samara
