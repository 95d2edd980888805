#ifndef samara_rotation_nearest_rotation_h
#define samara_rotation_nearest_rotation_h

#include <samara/rotation/rotation.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace samara
{
  /**
   * R of D = R S with S symmetric: the rotation nearest to @p D, by X ← (X + X⁻ᵀ)/2 (Higham 1986). It converges
   * quadratically, and so does what a complex step finds with it.
   */
  template <typename Number>
  Mat3<Number>
  nearest_rotation(Mat3<Number> D)
  {
    constexpr double       small_change = 1e-9; // its square is round-off
    constexpr unsigned int enough       = 10;
    double                 change       = 1;
    for (unsigned int i = 0; i < enough && change > small_change; ++i)
      {
        const Mat3<Number> better = Number(0.5) * (D + reciprocal_axes(D));
        change                    = 0;
        for (int k = 0; k < 9; ++k)
          change = std::max(change, std::abs(std::real(better.data()[k] - D.data()[k])));
        D = better;
      }
    return D;
  }
} // namespace samara

#endif
