#include <samara/solvers/factorization.h>
#include <samara/solvers/linear.h>

#include <umfpack.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** UMFPACK's functions for each kind of numbers. */
    template <typename Number>
    struct Functions;

    template <>
    struct Functions<double>
    {
      static void
      defaults(double *control)
      {
        umfpack_di_defaults(control);
      }
      static int
      symbolic(const Pattern &p, void **symbolic, const double *control, double *info)
      {
        const int n = p.size();
        return umfpack_di_symbolic(n, n, p.column_start.data(), p.rows.data(), nullptr, symbolic, control, info);
      }
      static int
      numeric(const Pattern &p,
              const double  *values,
              void          *symbolic,
              void         **numeric,
              const double  *control,
              double        *info)
      {
        return umfpack_di_numeric(p.column_start.data(), p.rows.data(), values, symbolic, numeric, control, info);
      }
      static void
      solve(void *numeric, const double *b, double *x, int *integers, double *work, const double *control)
      {
        umfpack_di_wsolve(UMFPACK_A, nullptr, nullptr, nullptr, x, b, numeric, control, nullptr, integers, work);
      }
      static void
      pivots(void *numeric, int *columns, std::vector<double> &diagonal)
      {
        int divided;
        umfpack_di_get_numeric(nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               columns,
                               diagonal.data(),
                               &divided,
                               nullptr,
                               numeric);
      }
      static double
      determinant(void *numeric)
      {
        double mantissa = 0, exponent = 0;
        umfpack_di_get_determinant(&mantissa, &exponent, numeric, nullptr);
        return mantissa;
      }
      static void
      free(void **symbolic, void **numeric)
      {
        umfpack_di_free_symbolic(symbolic);
        umfpack_di_free_numeric(numeric);
      }
      static void
      free(void **numeric)
      {
        umfpack_di_free_numeric(numeric);
      }
    };

    template <>
    struct Functions<std::complex<double>>
    {
      using Complex = std::complex<double>;
      // with no second array real and imaginary parts stand side by side, as those of std::complex
      static const double *
      parts(const Complex *values)
      {
        return reinterpret_cast<const double *>(values);
      }

      static void
      defaults(double *control)
      {
        umfpack_zi_defaults(control);
      }
      static int
      symbolic(const Pattern &p, void **symbolic, const double *control, double *info)
      {
        const int n = p.size();
        return umfpack_zi_symbolic(
          n, n, p.column_start.data(), p.rows.data(), nullptr, nullptr, symbolic, control, info);
      }
      static int
      numeric(const Pattern &p,
              const Complex *values,
              void          *symbolic,
              void         **numeric,
              const double  *control,
              double        *info)
      {
        return umfpack_zi_numeric(
          p.column_start.data(), p.rows.data(), parts(values), nullptr, symbolic, numeric, control, info);
      }
      static void
      solve(void *numeric, const Complex *b, Complex *x, int *integers, double *work, const double *control)
      {
        umfpack_zi_wsolve(UMFPACK_A,
                          nullptr,
                          nullptr,
                          nullptr,
                          nullptr,
                          reinterpret_cast<double *>(x),
                          nullptr,
                          parts(b),
                          nullptr,
                          numeric,
                          control,
                          nullptr,
                          integers,
                          work);
      }
      static void
      pivots(void *numeric, int *columns, std::vector<Complex> &diagonal)
      {
        int divided;
        umfpack_zi_get_numeric(nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               nullptr,
                               columns,
                               reinterpret_cast<double *>(diagonal.data()),
                               nullptr,
                               &divided,
                               nullptr,
                               numeric);
      }
      static double
      determinant(void *)
      {
        return 1; // has no sign
      }
      static void
      free(void **symbolic, void **numeric)
      {
        umfpack_zi_free_symbolic(symbolic);
        umfpack_zi_free_numeric(numeric);
      }
      static void
      free(void **numeric)
      {
        umfpack_zi_free_numeric(numeric);
      }
    };



    template <typename Number>
    class Umfpack : public Factorization<Number>
    {
      using Of = Functions<Number>;

    public:
      explicit Umfpack(const Pattern &pattern)
        : pattern(pattern)
        , x(pattern.size())
        , integers(pattern.size())
        , work(4 * pattern.size())
      {
        Of::defaults(control);
        control[UMFPACK_IRSTEP] = 0; // iterative refinement would need the matrix again
        if (pattern.size() > 0 && Of::symbolic(pattern, &symbolic, control, info) != UMFPACK_OK)
          throw SingularMatrix(-1);
      }

      ~Umfpack() override
      {
        Of::free(&symbolic, &numeric);
      }

      Umfpack(const Umfpack &)            = delete;
      Umfpack &operator=(const Umfpack &) = delete;

      void
      factorize(const Number *values) override
      {
        if (pattern.size() == 0)
          return;
        Of::free(&numeric);
        const int status = Of::numeric(pattern, values, symbolic, &numeric, control, info);
        if (status == UMFPACK_ERROR_out_of_memory)
          throw std::bad_alloc();
        if (status == UMFPACK_OK)
          return;
        const int unknown = numeric != nullptr ? without_pivot() : -1;
        Of::free(&numeric);
        throw SingularMatrix(unknown);
      }

      void
      solve(Number *b) const override
      {
        if (pattern.size() == 0)
          return;
        Of::solve(numeric, b, x.data(), integers.data(), work.data(), control);
        std::copy(x.begin(), x.end(), b);
      }

      int
      determinant_sign() const override
      {
        return Of::determinant(numeric) < 0 ? -1 : 1;
      }

      double
      reciprocal_condition() const override
      {
        return info[UMFPACK_RCOND];
      }

    private:
      int
      without_pivot() const
      {
        std::vector<int>    columns(pattern.size());
        std::vector<Number> diagonal(pattern.size());
        Of::pivots(numeric, columns.data(), diagonal);
        for (int i = 0; i < pattern.size(); ++i)
          if (!(std::abs(diagonal[i]) > 0))
            return columns[i];
        return -1;
      }

      const Pattern              &pattern;
      double                      control[UMFPACK_CONTROL], info[UMFPACK_INFO] = {};
      void                       *symbolic = nullptr, *numeric = nullptr;
      mutable std::vector<Number> x;
      mutable std::vector<int>    integers;
      mutable std::vector<double> work;
    };
  } // namespace



  template <typename Number>
  std::unique_ptr<Factorization<Number>>
  umfpack_factorization(const Pattern &pattern)
  {
    return std::make_unique<Umfpack<Number>>(pattern);
  }

  template std::unique_ptr<Factorization<double>>               umfpack_factorization(const Pattern &);
  template std::unique_ptr<Factorization<std::complex<double>>> umfpack_factorization(const Pattern &);
} // namespace samara
