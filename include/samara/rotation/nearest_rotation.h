#ifndef samara_rotation_nearest_rotation_h
#define samara_rotation_nearest_rotation_h

#include <samara/rotation/rotation.h>

namespace samara
{
  /** R of D = R S with S symmetric: the rotation nearest to @p D, by X ← (X + X⁻ᵀ)/2 (Higham 1986); in complex, too. */
  template <typename Number>
  Mat3<Number>
  nearest_rotation(Mat3<Number> D)
  {
    constexpr unsigned int enough = 7; // for axes that are three times too short, as in steps of six radians
    for (unsigned int i = 0; i < enough; ++i)
      D = (Number(0.5) * (D + reciprocal_axes(D))).eval();
    return D;
  }
} // namespace samara

#endif
