#include <samara/solvers/factorization.h>
#include <samara/solvers/kept_inertia.h>
#include <samara/solvers/linear.h>

#include <deal.II/base/exceptions.h>

namespace samara
{
  namespace
  {
    Library chosen = Library::automatic;

    template <typename Number>
    std::unique_ptr<Factorization<Number>>
    make_factorization(const Pattern &pattern, const Library library, const Ordering ordering = Ordering::symmetric)
    {
      switch (library)
        {
          case Library::mumps:
            return mumps_factorization<Number>(pattern);
          case Library::klu:
            return klu_factorization<Number>(pattern, ordering);
          default:
            return automatic_factorization<Number>(pattern, ordering);
        }
    }



    class RealSolver : public LinearSolver
    {
    public:
      RealSolver(const std::shared_ptr<const Pattern> &pattern, const Library library, const Ordering ordering)
        : pattern(pattern)
        , factorization(make_factorization<double>(*pattern, library, ordering))
      {}

      void
      factorize(const SparseMatrix &A) override
      {
        Assert(A.pattern == pattern, dealii::ExcMessage("A solver is made for one pattern; the matrix has another."));
        ++n_factorizations;
        is_factorized = false;
        factorization->factorize(A.values.data());
        is_factorized = true;
      }

      void
      solve(double *b) const override
      {
        Assert(is_factorized, dealii::ExcMessage("solve() before factorize(), or after one that failed."));
        factorization->solve(b);
      }

      void
      solve_columns(double *b, const unsigned int n_columns, const std::size_t size) const override
      {
        Assert(is_factorized, dealii::ExcMessage("solve_columns() before factorize(), or after one that failed."));
        factorization->solve_columns(b, n_columns, size);
      }

      std::optional<int>
      n_negative() const override
      {
        return factorization->n_negative();
      }

      const SymmetricFactors *
      symmetric_factors() const
      {
        return is_factorized ? factorization->symmetric_factors() : nullptr;
      }

      int
      determinant_sign() const override
      {
        return factorization->determinant_sign();
      }

      double
      reciprocal_condition() const override
      {
        return factorization->reciprocal_condition();
      }

    private:
      std::shared_ptr<const Pattern>         pattern;
      std::unique_ptr<Factorization<double>> factorization;
      bool                                   is_factorized = false;
    };



    class SolverOfComplex : public ComplexSolver
    {
    public:
      SolverOfComplex(const std::shared_ptr<const Pattern> &pattern, const Library library)
        : pattern(pattern)
        , factorization(make_factorization<std::complex<double>>(*pattern, library))
      {}

      void
      factorize(const std::vector<std::complex<double>> &values) override
      {
        Assert(values.size() >= static_cast<std::size_t>(pattern->n_nonzeros()),
               dealii::ExcDimensionMismatch(values.size(), pattern->n_nonzeros()));
        factorization->factorize(values.data());
      }

      void
      solve(std::complex<double> *b) const override
      {
        factorization->solve(b);
      }

    private:
      std::shared_ptr<const Pattern>                       pattern;
      std::unique_ptr<Factorization<std::complex<double>>> factorization;
    };
  } // namespace



  Library
  library_by_name(const std::string &name)
  {
    if (name == "automatic")
      return Library::automatic;
    if (name == "KLU")
      return Library::klu;
    if (name == "MUMPS")
      return Library::mumps;
    throw std::invalid_argument("there is no linear solver " + name);
  }



  void
  use_library(const Library library)
  {
    chosen = library;
  }



  Library
  library_in_use()
  {
    return chosen;
  }



  const SymmetricFactors *
  symmetric_factors_of(const LinearSolver &solver)
  {
    const auto *const real = dynamic_cast<const RealSolver *>(&solver);
    return real ? real->symmetric_factors() : nullptr;
  }



  std::unique_ptr<LinearSolver>
  make_solver(const std::shared_ptr<const Pattern> &pattern, const Library library, const Ordering ordering)
  {
    return std::make_unique<RealSolver>(pattern, library, ordering);
  }



  std::unique_ptr<ComplexSolver>
  make_complex_solver(const std::shared_ptr<const Pattern> &pattern, const Library library)
  {
    return std::make_unique<SolverOfComplex>(pattern, library);
  }
} // namespace samara
