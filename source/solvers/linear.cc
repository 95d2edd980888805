#include <samara/solvers/linear.h>

#include <klu.h>

namespace samara
{
  namespace
  {
    class Klu : public LinearSolver
    {
    public:
      explicit Klu(const std::shared_ptr<const Pattern> &pattern)
        : pattern(pattern)
      {
        klu_defaults(&common);
        // KLU's interface takes pointers to data it does not change
        symbolic = klu_analyze(pattern->size(),
                               const_cast<int *>(pattern->column_start.data()),
                               const_cast<int *>(pattern->rows.data()),
                               &common);
        if (symbolic == nullptr && pattern->size() > 0)
          throw SingularMatrix(-1);
      }

      ~Klu() override
      {
        klu_free_numeric(&numeric, &common);
        klu_free_symbolic(&symbolic, &common);
      }

      Klu(const Klu &)            = delete;
      Klu &operator=(const Klu &) = delete;

      void
      factorize(const SparseMatrix &A) override
      {
        ++n_factorizations;
        double *const values = const_cast<double *>(A.values.data());
        int *const    start  = const_cast<int *>(pattern->column_start.data());
        int *const    rows   = const_cast<int *>(pattern->rows.data());
        // the old pivots serve while the matrix changes little; klu_rcond tells when they do not
        if (numeric != nullptr && klu_refactor(start, rows, values, symbolic, numeric, &common) == 1 &&
            klu_rcond(symbolic, numeric, &common) == 1 && common.rcond > 1e-3 * reference_rcond)
          return;
        klu_free_numeric(&numeric, &common);
        numeric = klu_factor(start, rows, values, symbolic, &common);
        if (numeric == nullptr || common.status == KLU_SINGULAR)
          {
            const int column = common.singular_col;
            klu_free_numeric(&numeric, &common);
            throw SingularMatrix(column < pattern->size() ? column : -1);
          }
        klu_rcond(symbolic, numeric, &common);
        reference_rcond = common.rcond;
      }

      void
      solve(double *b) const override
      {
        klu_solve(symbolic, numeric, pattern->size(), 1, b, &common);
      }

      int
      determinant_sign() const override
      {
        // P A Q = L U with unit diagonal in L, and positive row scaling
        const double *const diagonal = static_cast<const double *>(numeric->Udiag);
        int                 sign     = parity(numeric->Pnum) * parity(symbolic->Q);
        for (int i = 0; i < pattern->size(); ++i)
          if (diagonal[i] < 0)
            sign = -sign;
        return sign;
      }

      double
      reciprocal_condition() const override
      {
        return common.rcond;
      }

    private:
      /** +1 for an even permutation, -1 for an odd one. */
      int
      parity(const int *permutation) const
      {
        std::vector<bool> seen(pattern->size(), false);
        int               sign = 1;
        for (int i = 0; i < pattern->size(); ++i)
          for (int j = i, length = 0; !seen[j]; j = permutation[j], ++length)
            {
              seen[j] = true;
              if (length > 0)
                sign = -sign;
            }
        return sign;
      }

      std::shared_ptr<const Pattern> pattern;
      mutable klu_common             common;
      klu_symbolic                  *symbolic        = nullptr;
      klu_numeric                   *numeric         = nullptr;
      double                         reference_rcond = 0;
    };



    class ComplexKlu : public ComplexSolver
    {
    public:
      explicit ComplexKlu(const std::shared_ptr<const Pattern> &pattern)
        : pattern(pattern)
      {
        klu_defaults(&common);
        symbolic = klu_analyze(pattern->size(),
                               const_cast<int *>(pattern->column_start.data()),
                               const_cast<int *>(pattern->rows.data()),
                               &common);
        if (symbolic == nullptr && pattern->size() > 0)
          throw SingularMatrix(-1);
      }

      ~ComplexKlu() override
      {
        klu_z_free_numeric(&numeric, &common);
        klu_free_symbolic(&symbolic, &common);
      }

      ComplexKlu(const ComplexKlu &)            = delete;
      ComplexKlu &operator=(const ComplexKlu &) = delete;

      void
      factorize(const std::vector<std::complex<double>> &values) override
      {
        klu_z_free_numeric(&numeric, &common);
        numeric = klu_z_factor(const_cast<int *>(pattern->column_start.data()),
                               const_cast<int *>(pattern->rows.data()),
                               reinterpret_cast<double *>(const_cast<std::complex<double> *>(values.data())),
                               symbolic,
                               &common);
        if (numeric == nullptr || common.status == KLU_SINGULAR)
          {
            const int column = common.singular_col;
            klu_z_free_numeric(&numeric, &common);
            throw SingularMatrix(column < pattern->size() ? column : -1);
          }
      }

      void
      solve(std::complex<double> *b) const override
      {
        klu_z_solve(symbolic, numeric, pattern->size(), 1, reinterpret_cast<double *>(b), &common);
      }

    private:
      std::shared_ptr<const Pattern> pattern;
      mutable klu_common             common;
      klu_symbolic                  *symbolic = nullptr;
      klu_numeric                   *numeric  = nullptr;
    };
  } // namespace



  std::unique_ptr<ComplexSolver>
  make_complex_klu(const std::shared_ptr<const Pattern> &pattern)
  {
    return std::make_unique<ComplexKlu>(pattern);
  }



  std::unique_ptr<LinearSolver>
  make_klu(const std::shared_ptr<const Pattern> &pattern)
  {
    return std::make_unique<Klu>(pattern);
  }
} // namespace samara
