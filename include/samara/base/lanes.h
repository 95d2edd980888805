#ifndef samara_base_lanes_h
#define samara_base_lanes_h

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstring>

namespace samara
{
  /**
   * Four numbers that are computed with at once, by the vector instructions there are. (deal.II's VectorizedArray has
   * as many as the library was compiled for: one, in Debian's package.)
   */
  struct FourDoubles
  {
#ifdef __clang__
    // Eigen asks for 16 bytes (EIGEN_MAX_ALIGN_BYTES), and Clang takes no request below what a type has by itself.
    typedef double Vector __attribute__((vector_size(32), aligned(16)));
    // and makes one instruction of a product and a sum only where it is told so; GCC does it anyway
#  define SAMARA_FUSED _Pragma("clang fp contract(fast)")
#else
    typedef double Vector __attribute__((vector_size(32)));
#  define SAMARA_FUSED
#endif
    Vector values;

    FourDoubles() = default;
    FourDoubles(const double a)
      : values{a, a, a, a}
    {}
    explicit FourDoubles(const Vector &values)
      : values(values)
    {}

    FourDoubles &
    operator+=(const FourDoubles &b)
    {
      SAMARA_FUSED
      values += b.values;
      return *this;
    }
    FourDoubles &
    operator-=(const FourDoubles &b)
    {
      SAMARA_FUSED
      values -= b.values;
      return *this;
    }
    FourDoubles &
    operator*=(const FourDoubles &b)
    {
      values *= b.values;
      return *this;
    }
    FourDoubles
    operator-() const
    {
      return FourDoubles(-values);
    }
    friend FourDoubles
    operator+(const FourDoubles &a, const FourDoubles &b)
    {
      SAMARA_FUSED
      return FourDoubles(a.values + b.values);
    }
    friend FourDoubles
    operator-(const FourDoubles &a, const FourDoubles &b)
    {
      SAMARA_FUSED
      return FourDoubles(a.values - b.values);
    }
    friend FourDoubles
    operator*(const FourDoubles &a, const FourDoubles &b)
    {
      SAMARA_FUSED
      return FourDoubles(a.values * b.values);
    }
    friend FourDoubles
    operator/(const FourDoubles &a, const FourDoubles &b)
    {
      return FourDoubles(a.values / b.values);
    }

    double
    smallest() const
    {
      return std::min({values[0], values[1], values[2], values[3]});
    }
#undef SAMARA_FUSED
  };



  /** Roots of each, by a vector instruction: std::sqrt of one number at a time has to look after errno. */
  inline FourDoubles
  sqrt(const FourDoubles &a)
  {
    FourDoubles                result;
    Eigen::Array<double, 4, 1> roots;
    std::memcpy(roots.data(), &a.values, sizeof(a.values));
    roots = roots.sqrt();
    std::memcpy(&result.values, roots.data(), sizeof(a.values));
    return result;
  }



  /** Formulas written for a number are valid for lanes of it: four doubles, one of any other kind. */
  template <typename Number>
  struct Lanes
  {
    using type                         = Number;
    static constexpr unsigned int size = 1;

    /** Lane l of out[i] becomes in[l][i], for i < n. */
    static void
    load(const unsigned int n, const std::array<const Number *, size> &in, type *out)
    {
      std::copy_n(in[0], n, out);
    }

    /** out[l][i] becomes lane l of in[i], for i < n. */
    static void
    store(const unsigned int n, const type *in, const std::array<Number *, size> &out)
    {
      std::copy_n(in, n, out[0]);
    }
  };



  template <>
  struct Lanes<double>
  {
    using type                         = FourDoubles;
    static constexpr unsigned int size = 4;

    static void
    load(const unsigned int n, const std::array<const double *, size> &in, type *out)
    {
      unsigned int i = 0;
      for (; i + 4 <= n; i += 4)
        {
          const type rows[4] = {from(in[0] + i), from(in[1] + i), from(in[2] + i), from(in[3] + i)};
          transpose(rows, out + i);
        }
      for (; i < n; ++i)
        out[i] = type(type::Vector{in[0][i], in[1][i], in[2][i], in[3][i]});
    }

    static void
    store(const unsigned int n, const type *in, const std::array<double *, size> &out)
    {
      unsigned int i = 0;
      for (; i + 4 <= n; i += 4)
        {
          type rows[4];
          transpose(in + i, rows);
          to(rows[0], out[0] + i);
          to(rows[1], out[1] + i);
          to(rows[2], out[2] + i);
          to(rows[3], out[3] + i);
        }
      for (; i < n; ++i)
        {
          out[0][i] = in[i].values[0];
          out[1][i] = in[i].values[1];
          out[2][i] = in[i].values[2];
          out[3][i] = in[i].values[3];
        }
    }

  private:
    // written out: compilers make loops of four that go through memory

    /** Four numbers that stand anywhere. */
    static type
    from(const double *numbers)
    {
      type result;
      std::memcpy(&result.values, numbers, sizeof(result.values));
      return result;
    }

    static void
    to(const type &row, double *numbers)
    {
      std::memcpy(numbers, &row.values, sizeof(row.values));
    }

    static void
    transpose(const type *in, type *out)
    {
      const auto low01  = __builtin_shufflevector(in[0].values, in[1].values, 0, 4, 2, 6);
      const auto high01 = __builtin_shufflevector(in[0].values, in[1].values, 1, 5, 3, 7);
      const auto low23  = __builtin_shufflevector(in[2].values, in[3].values, 0, 4, 2, 6);
      const auto high23 = __builtin_shufflevector(in[2].values, in[3].values, 1, 5, 3, 7);
      out[0].values     = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
      out[1].values     = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
      out[2].values     = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
      out[3].values     = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
    }
  };
} // namespace samara



namespace Eigen
{
  /** Matrices of lanes. */
  template <>
  struct NumTraits<samara::FourDoubles> : GenericNumTraits<double>
  {
    using Real       = samara::FourDoubles;
    using NonInteger = Real;
    using Nested     = Real;
    using Literal    = double;
  };
} // namespace Eigen

#endif
