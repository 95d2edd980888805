#ifndef samara_rotation_nearest_rotation_h
#define samara_rotation_nearest_rotation_h

#include <samara/base/lanes.h>
#include <samara/rotation/rotation.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace samara
{
  namespace internal
  {
    /** The largest size of what a complex step starts from, or of four numbers. @{ */
    template <typename Number>
    double
    largest_size(const Number &a)
    {
      return std::abs(std::real(a));
    }

    inline double
    largest_size(const FourDoubles &a)
    {
      return std::max({std::abs(a.values[0]), std::abs(a.values[1]), std::abs(a.values[2]), std::abs(a.values[3])});
    }
    /** @} */
  } // namespace internal

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
          change = std::max(change, internal::largest_size(Number(better.data()[k] - D.data()[k])));
        D = better;
      }
    return D;
  }
} // namespace samara

#endif
