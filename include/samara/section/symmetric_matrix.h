#ifndef samara_section_symmetric_matrix_h
#define samara_section_symmetric_matrix_h

#include <samara/rotation/rotation.h>

#include <vector>

namespace samara
{
  /**
   * A symmetric 6×6 matrix from the numbers of an entry: 36 by rows, 21 of the upper triangle by rows, or 6 of the
   * diagonal.
   *
   * @throws std::invalid_argument if there are others, or the matrix is not symmetric.
   */
  Matrix6 symmetric_matrix(const std::vector<double> &numbers);
} // namespace samara

#endif
