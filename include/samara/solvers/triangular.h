#ifndef samara_solvers_triangular_h
#define samara_solvers_triangular_h

#include <complex>
#include <vector>

namespace samara
{
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



  /** A triangular matrix by columns, without its diagonal. */
  template <typename Number>
  struct Triangle
  {
    std::vector<int>    start, rows;
    std::vector<Number> values;

    /** Subtract x_j times column j from x. */
    void
    eliminate(const int j, Number *x) const
    {
      const Number factor = x[j];
      for (int k = start[j]; k < start[j + 1]; ++k)
        x[rows[k]] -= product(values[k], factor);
    }
  };



  /**
   * P S A Q = L U with a diagonal scaling S, for solving: L and U each in one piece, in the order of elimination.
   *
   * Factors larger than the caches are read from memory at every solution, and only such streams are read at full speed
   * (doc/benchmarks/sizes.md).
   */
  template <typename Number>
  struct TriangularFactors
  {
    Triangle<Number>    lower, upper;
    std::vector<Number> inverse_diagonal;        ///< of U; that of L is one
    std::vector<double> scale;                   ///< what each row of P A was divided by
    std::vector<int>    row_order, column_order; ///< P, Q: the old number of each new row and column

    void
    solve(Number *b) const
    {
      const int n = inverse_diagonal.size();
      x.resize(n);
      for (int i = 0; i < n; ++i)
        x[i] = b[row_order[i]] / scale[i];
      for (int j = 0; j < n; ++j)
        lower.eliminate(j, x.data());
      for (int j = n - 1; j >= 0; --j)
        {
          x[j] = product(x[j], inverse_diagonal[j]);
          upper.eliminate(j, x.data());
        }
      for (int i = 0; i < n; ++i)
        b[column_order[i]] = x[i];
    }

  private:
    mutable std::vector<Number> x; // work space
  };
} // namespace samara

#endif
