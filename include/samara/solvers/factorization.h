#ifndef samara_solvers_factorization_h
#define samara_solvers_factorization_h

#include <samara/solvers/linear.h>

#include <complex>

namespace samara
{
  class SymmetricFactors;

  /**
   * What a library for direct solution does with matrices of one pattern, for real and for complex numbers; behind
   * LinearSolver and ComplexSolver. The pattern must outlive it.
   */
  template <typename Number>
  class Factorization
  {
  public:
    virtual ~Factorization() = default;

    /** @throws SingularMatrix */
    virtual void factorize(const Number *values) = 0;

    /** Replace the right-hand side @p b by the solution. */
    virtual void solve(Number *b) const = 0;

    /** The same for @p n_columns right-hand sides of @p size numbers, one behind the other. */
    virtual void
    solve_columns(Number *b, const unsigned int n_columns, const std::size_t size) const
    {
      for (unsigned int c = 0; c < n_columns; ++c)
        solve(b + c * size);
    }

    /** The number of negative eigenvalues of a real matrix, where the pivots of symmetric factors show it. */
    virtual std::optional<int>
    n_negative() const
    {
      return std::nullopt;
    }

    /** Factors L D Lᵀ, where these are what solutions use; else nullptr. */
    virtual const SymmetricFactors *
    symmetric_factors() const
    {
      return nullptr;
    }

    /** Sign of the determinant of a real matrix. */
    virtual int determinant_sign() const = 0;

    /** Rough reciprocal condition number with rows (MUMPS: and columns) scaled; each library has its own measure. */
    virtual double reciprocal_condition() const = 0;
  };

  template <typename Number>
  std::unique_ptr<Factorization<Number>> automatic_factorization(const Pattern &pattern,
                                                                 Ordering       ordering = Ordering::symmetric);
  template <typename Number>
  std::unique_ptr<Factorization<Number>> klu_factorization(const Pattern &pattern,
                                                           Ordering       ordering = Ordering::symmetric);
  template <typename Number>
  std::unique_ptr<Factorization<Number>> mumps_factorization(const Pattern &pattern);

  /** The number of negative eigenvalues of a symmetric matrix, by pivots of one and two rows; nothing if there are no
   * factors. */
  std::optional<int> mumps_n_negative(const Pattern &pattern, const double *values);
} // namespace samara

#endif
