#ifndef samara_solvers_linear_h
#define samara_solvers_linear_h

#include <samara/model/matrix.h>

#include <complex>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace samara
{
  /** The matrix has no inverse; @p unknown is where elimination found no pivot, or -1. */
  class SingularMatrix : public std::runtime_error
  {
  public:
    explicit SingularMatrix(const int unknown)
      : std::runtime_error("the matrix is singular")
      , unknown(unknown)
    {}
    int unknown;
  };



  /** Solves A x = b for matrices of one pattern; what depends on the pattern alone is done once. */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /** @throws SingularMatrix */
    virtual void factorize(const SparseMatrix &A) = 0;

    /** Replace the right-hand side @p b by the solution. */
    virtual void solve(double *b) const = 0;

    /** The same for @p n_columns right-hand sides of @p size numbers, one behind the other. */
    virtual void
    solve_columns(double *b, const unsigned int n_columns, const std::size_t size) const
    {
      for (unsigned int c = 0; c < n_columns; ++c)
        solve(b + c * size);
    }

    /** The number of negative eigenvalues, where the pivots of symmetric factors show it. */
    virtual std::optional<int>
    n_negative() const
    {
      return std::nullopt;
    }

    /** Sign of the determinant, +1 or -1: it changes where an equilibrium loses its stability statically. */
    virtual int determinant_sign() const = 0;

    /** Rough reciprocal condition number of the last factorisation. */
    virtual double reciprocal_condition() const = 0;

    unsigned int n_factorizations = 0; ///< for reports
  };

  /** The same for complex values on a real pattern. */
  class ComplexSolver
  {
  public:
    virtual ~ComplexSolver() = default;

    /** @throws SingularMatrix */
    virtual void factorize(const std::vector<std::complex<double>> &values) = 0;
    virtual void solve(std::complex<double> *b) const                       = 0;
  };



  /**
   * The libraries to choose from. KLU of SuiteSparse: left-looking LU for matrices as sparse as those of chains of
   * bodies. MUMPS: a tree of fronts of dense matrices, for larger fill-in.
   * Automatic: KLU for patterns that fill little; for others LU with pivots on the diagonal, as long as these are found
   * to be accurate, and MUMPS where they are not.
   */
  enum class Library
  {
    klu,
    mumps,
    automatic
  };

  /** The names users choose by: "automatic", "KLU", "MUMPS". */
  Library library_by_name(const std::string &name);

  /** The library of all solvers that are made from now on; one for the whole process, which computes one model. */
  void    use_library(Library library);
  Library library_in_use();

  /**
   * How KLU finds the order of elimination: by the graph of A + Aᵀ, for diagonals that can be pivots; by columns alone
   * (COLAMD), for saddle matrices whose pivots stand anywhere. The other libraries see for themselves.
   */
  enum class Ordering
  {
    symmetric,
    columns
  };

  std::unique_ptr<LinearSolver>  make_solver(const std::shared_ptr<const Pattern> &pattern,
                                             Library                               library  = library_in_use(),
                                             Ordering                              ordering = Ordering::symmetric);
  std::unique_ptr<ComplexSolver> make_complex_solver(const std::shared_ptr<const Pattern> &pattern,
                                                     Library                               library = library_in_use());
} // namespace samara

#endif
