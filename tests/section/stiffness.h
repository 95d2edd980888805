#ifndef samara_tests_section_stiffness_h
#define samara_tests_section_stiffness_h

#include <samara/rotation/rotation.h>

#include "../reference.h"

#include <array>
#include <string>

namespace samara
{
  /** Largest difference of two stiffnesses relative to the diagonal. */
  inline double
  difference(const Matrix6 &a, const Matrix6 &b)
  {
    const Vector6 size = b.diagonal().cwiseAbs().cwiseSqrt();
    return ((a - b).array() / (size * size.transpose()).array()).abs().maxCoeff();
  }



  /** The files have the axes x, y across and z along the beam, and forces Tx Ty Tz Mx My Mz. */
  inline Matrix6
  reference_stiffness(const std::string &name)
  {
    const auto                        table = reference_rows("sections/" + name + ".csv");
    const int                         of[6] = {2, 0, 1, 5, 3, 4};
    const std::array<const char *, 6> names = {{"Tx", "Ty", "Tz", "Mx", "My", "Mz"}};
    Matrix6                           K;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        K(i, j) = std::stod(table.at(of[i]).at(names[of[j]]));
    return K;
  }
} // namespace samara

#endif
