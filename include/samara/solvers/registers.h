#ifndef samara_solvers_registers_h
#define samara_solvers_registers_h

#include <complex>
#include <cstring>

namespace samara
{
  /** Doubles in one register, at any address. */
  template <int n>
  struct VectorOf;

  template <>
  struct VectorOf<4>
  {
    typedef double Type __attribute__((vector_size(32), aligned(8), may_alias));
  };
  template <>
  struct VectorOf<2>
  {
    typedef double Type __attribute__((vector_size(16), aligned(8), may_alias));
  };
  template <>
  struct VectorOf<1>
  {
    typedef double Type __attribute__((may_alias));
  };



  template <int n>
  struct Registers;

  template <>
  struct Registers<0>
  {
    static Registers
    zero()
    {
      return {};
    }
    static Registers
    load(const double *)
    {
      return {};
    }
    void
    store(double *) const
    {}
    void
    add(const Registers &)
    {}
    void
    subtract(const Registers &)
    {}
    void
    add_product(const double *, double)
    {}
    void
    subtract_product(const double *, double)
    {}
    void
    multiply(const double *)
    {}
    void
    raise_to_magnitude(const double *)
    {}
    Registers
    turned() const
    {
      return {};
    }
  };

  /**
   * A short array of doubles in registers of four, then of two and of one, so that nothing beyond it is read or
   * written. Compilers do not find such code for loops of five or six steps themselves.
   */
  template <int n>
  struct Registers : Registers<n - (n >= 4 ? 4 :
                                    n >= 2 ? 2 :
                                             1)>
  {
    static constexpr int size = n >= 4 ? 4 : n >= 2 ? 2 : 1;
    using Vector              = typename VectorOf<size>::Type;
    using Tail                = Registers<n - size>;

    Vector head;

    static Registers
    zero()
    {
      return {Tail::zero(), Vector{}};
    }
    static Registers
    load(const double *from)
    {
      return {Tail::load(from + size), vector_at(from)};
    }
    void
    store(double *to) const
    {
#ifdef __clang__
      std::memcpy(to, &head, sizeof(Vector)); // it forgets in templates that any address will do
#else
      *reinterpret_cast<Vector *>(to) = head;
#endif
      Tail::store(to + size);
    }
    void
    add(const Registers &other)
    {
      head += other.head;
      Tail::add(other);
    }
    void
    subtract(const Registers &other)
    {
      head -= other.head;
      Tail::subtract(other);
    }
    void
    add_product(const double *a, const double factor)
    {
      head += vector_at(a) * factor;
      Tail::add_product(a + size, factor);
    }
    void
    subtract_product(const double *a, const double factor)
    {
      head -= vector_at(a) * factor;
      Tail::subtract_product(a + size, factor);
    }
    /** Each double by its own factor. */
    void
    multiply(const double *factors)
    {
      head *= vector_at(factors);
      Tail::multiply(factors + size);
    }
    /** The larger one of what is here and the magnitude of @p a, for each double. */
    void
    raise_to_magnitude(const double *a)
    {
      const Vector value = vector_at(a), opposite = -value;
      head = head < value ? value : head;
      head = head < opposite ? opposite : head;
      Tail::raise_to_magnitude(a + size);
    }
    /** i times each of the complex numbers whose real and imaginary parts are here in turn. */
    Registers
    turned() const
    {
      if constexpr (size == 4)
        return {Tail::turned(), __builtin_shufflevector(head, head, 1, 0, 3, 2) * Vector{-1, 1, -1, 1}};
      else
        return {Tail::turned(), __builtin_shufflevector(head, head, 1, 0) * Vector{-1, 1}};
    }
    template <int k>
    double
    get() const
    {
      if constexpr (k >= size)
        return Tail::template get<k - size>();
      else if constexpr (size == 1)
        return head;
      else
        return head[k];
    }

  private:
    static Vector
    vector_at(const double *a)
    {
#ifdef __clang__
      Vector result;
      std::memcpy(&result, a, sizeof(Vector));
      return result;
#else
      return *reinterpret_cast<const Vector *>(a);
#endif
    }
  };



  inline double
  product(const double a, const double b)
  {
    return a * b;
  }
  /** Without the search for infinities that the standard asks for. */
  inline std::complex<double>
  product(const std::complex<double> &a, const std::complex<double> &b)
  {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }



  template <typename Number>
  constexpr int parts = sizeof(Number) / sizeof(double);

  template <typename Number>
  const double *
  doubles(const Number *numbers)
  {
    return reinterpret_cast<const double *>(numbers);
  }
  template <typename Number>
  double *
  doubles(Number *numbers)
  {
    return reinterpret_cast<double *>(numbers);
  }



  /** A sum of columns of @p w numbers times factors; as no chain of additions, several of them are to be used in turn.
   */
  template <typename Number, int w>
  struct ColumnSum
  {
    static constexpr int n_registers = (w + 3) / 4;
    Registers<w>         sum         = Registers<w>::zero();

    void
    add(const double *column, const double factor)
    {
      sum.add_product(column, factor);
    }
    void
    add(const ColumnSum &other)
    {
      sum.add(other.sum);
    }
    Registers<w>
    result() const
    {
      return sum;
    }
  };

  /** With real and imaginary parts of the factors kept apart to the end: no shuffling for each column. */
  template <int w>
  struct ColumnSum<std::complex<double>, w>
  {
    static constexpr int n_registers = 2 * ((2 * w + 3) / 4);
    Registers<2 *w>      by_real = Registers<2 * w>::zero(), by_imaginary = Registers<2 * w>::zero();

    void
    add(const std::complex<double> *column, const std::complex<double> &factor)
    {
      by_real.add_product(doubles(column), factor.real());
      by_imaginary.add_product(doubles(column), factor.imag());
    }
    void
    add(const ColumnSum &other)
    {
      by_real.add(other.by_real);
      by_imaginary.add(other.by_imaginary);
    }
    Registers<2 * w>
    result() const
    {
      Registers<2 *w> sum = by_real;
      sum.add(by_imaginary.turned());
      return sum;
    }
  };
} // namespace samara

#endif
