#ifndef samara_aero_vortex_h
#define samara_aero_vortex_h

#include <samara/base/lanes.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <complex>
#include <cstring>
#include <type_traits>
#include <vector>

namespace samara
{
  /** A vortex line of straight segments by the coordinates of its points [m], apart so that sums run over them fast. */
  template <typename Number>
  struct VortexLine
  {
    std::vector<Number> x, y, z;

    void
    resize(const unsigned int n)
    {
      x.resize(n);
      y.resize(n);
      z.resize(n);
    }
  };



  /** Four complex numbers that are computed with at once. */
  struct FourComplexes
  {
    FourDoubles re, im;

    FourComplexes() = default;
    FourComplexes(const double a)
      : re(a)
      , im(0.)
    {}
    FourComplexes(const FourDoubles &re, const FourDoubles &im)
      : re(re)
      , im(im)
    {}

    FourComplexes &
    operator+=(const FourComplexes &b)
    {
      re += b.re;
      im += b.im;
      return *this;
    }
    friend FourComplexes
    operator+(const FourComplexes &a, const FourComplexes &b)
    {
      return {a.re + b.re, a.im + b.im};
    }
    friend FourComplexes
    operator-(const FourComplexes &a, const FourComplexes &b)
    {
      return {a.re - b.re, a.im - b.im};
    }
    friend FourComplexes
    operator*(const FourComplexes &a, const FourComplexes &b)
    {
      return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend FourComplexes
    operator/(const FourComplexes &a, const FourComplexes &b)
    {
      const FourDoubles scale = 1. / (b.re * b.re + b.im * b.im);
      return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
    }

    /** The root of positive real part, of @p a with a positive one, as squares of lengths have it. */
    friend FourComplexes
    sqrt(const FourComplexes &a)
    {
      const FourDoubles ratio = a.im / a.re, root = sqrt(0.5 * a.re * (1. + sqrt(1. + ratio * ratio)));
      return {root, 0.5 * a.im / root};
    }
  };



  namespace internal
  {
    /** What bounds the velocity near a vortex line: its core, to the fourth, and the square of a length below it. */
    struct VortexCore
    {
      double fourth, least;

      explicit VortexCore(const double core)
        : fourth(core * core * core * core)
        , least(1e-24 * core * core + 1e-300)
      {}
    };

    /** From a point of a vortex line to the place that is looked at, and one over its length. */
    template <typename Number>
    struct VortexArm
    {
      Number x, y, z, inverse;

      VortexArm(const Number &x, const Number &y, const Number &z, const VortexCore &core)
        : x(x)
        , y(y)
        , z(z)
      {
        using std::sqrt;
        inverse = 1. / sqrt(x * x + y * y + z * z + core.least);
      }
    };

    /** Add 4π times the velocity that the segment between two points induces. */
    template <typename Number>
    void
    add_segment(const VortexArm<Number> &a,
                const VortexArm<Number> &b,
                const VortexCore        &core,
                std::array<Number, 3>   &v)
    {
      using std::sqrt;
      const Number l_x = a.x - b.x, l_y = a.y - b.y, l_z = a.z - b.z;
      const Number c_x = a.y * b.z - a.z * b.y, c_y = a.z * b.x - a.x * b.z, c_z = a.x * b.y - a.y * b.x;
      const Number c_2 = c_x * c_x + c_y * c_y + c_z * c_z, l_2 = l_x * l_x + l_y * l_y + l_z * l_z;
      const Number along = l_x * (a.x * a.inverse - b.x * b.inverse) + l_y * (a.y * a.inverse - b.y * b.inverse) +
                           l_z * (a.z * a.inverse - b.z * b.inverse);
      const Number k = along / sqrt(c_2 * c_2 + core.fourth * l_2 * l_2 + 1e-300);
      v[0] += k * c_x;
      v[1] += k * c_y;
      v[2] += k * c_z;
    }

    /** The same of all segments from the point @p first on, one after the other. */
    template <typename Number>
    void
    add_segments(const Eigen::Matrix<Number, 3, 1> &at,
                 const VortexLine<Number>          &line,
                 const std::size_t                  first,
                 const VortexCore                  &core,
                 std::array<Number, 3>             &v)
    {
      const auto arm = [&](const std::size_t i) {
        return VortexArm<Number>(at(0) - line.x[i], at(1) - line.y[i], at(2) - line.z[i], core);
      };
      if (first >= line.x.size())
        return;
      VortexArm<Number> last = arm(first);
      for (std::size_t i = first + 1; i < line.x.size(); ++i)
        {
          const VortexArm<Number> next = arm(i);
          add_segment(last, next, core, v);
          last = next;
        }
    }

    /** Lanes of a number, and four of them from @p x on. @{ */
    inline FourDoubles
    four_of(const double *const x)
    {
      FourDoubles result;
      std::memcpy(&result.values, x, sizeof(result.values));
      return result;
    }

    inline FourComplexes
    four_of(const std::complex<double> *const x)
    {
      FourDoubles::Vector first, second;
      std::memcpy(&first, x, sizeof(first));
      std::memcpy(&second, x + 2, sizeof(second));
      return {FourDoubles(FourDoubles::Vector(__builtin_shufflevector(first, second, 0, 2, 4, 6))),
              FourDoubles(FourDoubles::Vector(__builtin_shufflevector(first, second, 1, 3, 5, 7)))};
    }

    inline FourDoubles
    four_times(const double x)
    {
      return x;
    }

    inline FourComplexes
    four_times(const std::complex<double> &x)
    {
      return {x.real(), x.imag()};
    }

    inline double
    sum_of(const FourDoubles &x)
    {
      return (x.values[0] + x.values[1]) + (x.values[2] + x.values[3]);
    }

    inline std::complex<double>
    sum_of(const FourComplexes &x)
    {
      return {sum_of(x.re), sum_of(x.im)};
    }
    /** @} */

    /** The same of four segments at once, as many as there are; @returns the point at which the next one begins. */
    template <typename Number>
    std::size_t
    add_segments_by_four(const Eigen::Matrix<Number, 3, 1> &at,
                         const VortexLine<Number>          &line,
                         const VortexCore                  &core,
                         std::array<Number, 3>             &v)
    {
      using Four      = decltype(four_times(at(0)));
      const Four at_x = four_times(at(0)), at_y = four_times(at(1)), at_z = four_times(at(2));
      const auto arm = [&](const std::size_t i) {
        return VortexArm<Four>(at_x - four_of(&line.x[i]),
                               at_y - four_of(&line.y[i]),
                               at_z - four_of(&line.z[i]),
                               core);
      };
      std::array<Four, 3> sums = {Four(0.), Four(0.), Four(0.)};
      std::size_t         i    = 0;
      for (; i + 4 < line.x.size(); i += 4)
        add_segment(arm(i), arm(i + 1), core, sums);
      for (unsigned int k = 0; k < 3; ++k)
        v[k] += sum_of(sums[k]);
      return i;
    }
  } // namespace internal



  /**
   * The velocity at a place that a vortex line of unit circulation along it induces [1/m], by the law of Biot and
   * Savart with the core of G. H. Vatistas, V. Kozel & W. C. Mih (Exp. Fluids 11, 1991), n = 2: a straight line at the
   * distance h turns the air with h/(2π √(h⁴ + r_c⁴)). Of a segment L from p₁ to p₂, r_i = x − p_i,
   *
   *     v = r₁ × r₂ L·(r₁/|r₁| − r₂/|r₂|) / (4π √(|r₁ × r₂|⁴ + r_c⁴ |L|⁴))
   *
   * Zero at the points of the line themselves. Of doubles and complex numbers, four segments are computed at once: sums
   * differ from those of one after the other by round-off. Nothing is allocated.
   */
  template <typename Number>
  Eigen::Matrix<Number, 3, 1>
  induced_velocity(const Eigen::Matrix<Number, 3, 1> &at, const VortexLine<Number> &line, const double core)
  {
    const internal::VortexCore of(core);
    std::array<Number, 3>      v     = {Number(0), Number(0), Number(0)};
    std::size_t                first = 0;
    if constexpr (std::is_same_v<Number, double> || std::is_same_v<Number, std::complex<double>>)
      first = internal::add_segments_by_four(at, line, of, v);
    internal::add_segments(at, line, first, of, v);
    constexpr double per_turn = 1 / (4 * M_PI);
    return {v[0] * per_turn, v[1] * per_turn, v[2] * per_turn};
  }
} // namespace samara

#endif
