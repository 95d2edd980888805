#ifndef samara_solvers_factorization_h
#define samara_solvers_factorization_h

#include <samara/solvers/linear.h>

#include <complex>

namespace samara
{
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

    /** Sign of the determinant of a real matrix. */
    virtual int determinant_sign() const = 0;

    /** Rough reciprocal condition number with rows (MUMPS: and columns) scaled; each library has its own measure. */
    virtual double reciprocal_condition() const = 0;
  };

  template <typename Number>
  std::unique_ptr<Factorization<Number>> automatic_factorization(const Pattern &pattern,
                                                                 Ordering ordering = Ordering::symmetric);
  template <typename Number>
  std::unique_ptr<Factorization<Number>> klu_factorization(const Pattern &pattern,
                                                           Ordering ordering = Ordering::symmetric);
  template <typename Number>
  std::unique_ptr<Factorization<Number>> umfpack_factorization(const Pattern &pattern);
  template <typename Number>
  std::unique_ptr<Factorization<Number>> mumps_factorization(const Pattern &pattern);
} // namespace samara

#endif
