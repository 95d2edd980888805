#include <samara/solvers/factorization.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/triangular.h>

#include <klu.h>

namespace samara
{
  namespace
  {
    /** From this many entries on, about the size of a second level cache, the factors are copied to be read in order.
     */
    constexpr int largest_in_cache = 60000;

    /** KLU's functions by the kind of numbers; its interface takes pointers to data it does not change. */
    klu_numeric *
    factor(const Pattern &p, const double *values, klu_symbolic *symbolic, klu_common *common)
    {
      return klu_factor(const_cast<int *>(p.column_start.data()),
                        const_cast<int *>(p.rows.data()),
                        const_cast<double *>(values),
                        symbolic,
                        common);
    }
    klu_numeric *
    factor(const Pattern &p, const std::complex<double> *values, klu_symbolic *symbolic, klu_common *common)
    {
      return klu_z_factor(const_cast<int *>(p.column_start.data()),
                          const_cast<int *>(p.rows.data()),
                          reinterpret_cast<double *>(const_cast<std::complex<double> *>(values)),
                          symbolic,
                          common);
    }

    bool
    refactor(const Pattern &p, const double *values, klu_symbolic *symbolic, klu_numeric *numeric, klu_common *common)
    {
      return klu_refactor(const_cast<int *>(p.column_start.data()),
                          const_cast<int *>(p.rows.data()),
                          const_cast<double *>(values),
                          symbolic,
                          numeric,
                          common) == 1 &&
             klu_rcond(symbolic, numeric, common) == 1;
    }
    bool
    refactor(const Pattern              &p,
             const std::complex<double> *values,
             klu_symbolic               *symbolic,
             klu_numeric                *numeric,
             klu_common                 *common)
    {
      return klu_z_refactor(const_cast<int *>(p.column_start.data()),
                            const_cast<int *>(p.rows.data()),
                            reinterpret_cast<double *>(const_cast<std::complex<double> *>(values)),
                            symbolic,
                            numeric,
                            common) == 1 &&
             klu_z_rcond(symbolic, numeric, common) == 1;
    }

    void
    find_rcond(klu_symbolic *symbolic, klu_numeric *numeric, klu_common *common, double)
    {
      klu_rcond(symbolic, numeric, common);
    }
    void
    find_rcond(klu_symbolic *symbolic, klu_numeric *numeric, klu_common *common, std::complex<double>)
    {
      klu_z_rcond(symbolic, numeric, common);
    }

    void
    solve_with(klu_symbolic *symbolic, klu_numeric *numeric, const int n, double *b, klu_common *common)
    {
      klu_solve(symbolic, numeric, n, 1, b, common);
    }
    void
    solve_with(klu_symbolic *symbolic, klu_numeric *numeric, const int n, std::complex<double> *b, klu_common *common)
    {
      klu_z_solve(symbolic, numeric, n, 1, reinterpret_cast<double *>(b), common);
    }

    void
    free_numeric(klu_numeric **numeric, klu_common *common, double)
    {
      klu_free_numeric(numeric, common);
    }
    void
    free_numeric(klu_numeric **numeric, klu_common *common, std::complex<double>)
    {
      klu_z_free_numeric(numeric, common);
    }



    /** L and U of KLU with their diagonals. */
    template <typename Number>
    struct Extract;

    template <>
    struct Extract<double>
    {
      std::vector<double> L, U;

      void
      operator()(klu_symbolic *symbolic, klu_numeric *numeric, TriangularFactors<double> &factors, klu_common *common)
      {
        L.resize(numeric->lnz);
        U.resize(numeric->unz);
        klu_extract(numeric,
                    symbolic,
                    factors.lower.start.data(),
                    factors.lower.rows.data(),
                    L.data(),
                    factors.upper.start.data(),
                    factors.upper.rows.data(),
                    U.data(),
                    nullptr,
                    nullptr,
                    nullptr,
                    factors.row_order.data(),
                    factors.column_order.data(),
                    factors.scale.data(),
                    nullptr,
                    common);
      }
      double
      lower(const int k) const
      {
        return L[k];
      }
      double
      upper(const int k) const
      {
        return U[k];
      }
    };

    template <>
    struct Extract<std::complex<double>>
    {
      std::vector<double> L_real, L_imag, U_real, U_imag;

      void
      operator()(klu_symbolic                            *symbolic,
                 klu_numeric                             *numeric,
                 TriangularFactors<std::complex<double>> &factors,
                 klu_common                              *common)
      {
        L_real.resize(numeric->lnz);
        L_imag.resize(numeric->lnz);
        U_real.resize(numeric->unz);
        U_imag.resize(numeric->unz);
        klu_z_extract(numeric,
                      symbolic,
                      factors.lower.start.data(),
                      factors.lower.rows.data(),
                      L_real.data(),
                      L_imag.data(),
                      factors.upper.start.data(),
                      factors.upper.rows.data(),
                      U_real.data(),
                      U_imag.data(),
                      nullptr,
                      nullptr,
                      nullptr,
                      nullptr,
                      factors.row_order.data(),
                      factors.column_order.data(),
                      factors.scale.data(),
                      nullptr,
                      common);
      }
      std::complex<double>
      lower(const int k) const
      {
        return {L_real[k], L_imag[k]};
      }
      std::complex<double>
      upper(const int k) const
      {
        return {U_real[k], U_imag[k]};
      }
    };



    /** Leave out one entry of each column, the first or the last, which is the diagonal. */
    template <typename Number, typename ValueAt>
    void
    leave_out_diagonal(Triangle<Number>    &triangle,
                       const bool           is_first,
                       const ValueAt       &value_at,
                       std::vector<Number> *inverse_diagonal)
    {
      const int n = triangle.start.size() - 1;
      triangle.values.resize(triangle.rows.size() - n);
      int to = 0;
      for (int j = 0; j < n; ++j)
        {
          const int begin = triangle.start[j], end = triangle.start[j + 1];
          triangle.start[j] = to;
          if (inverse_diagonal != nullptr)
            (*inverse_diagonal)[j] = 1. / value_at(is_first ? begin : end - 1);
          for (int k = begin + (is_first ? 1 : 0); k < end - (is_first ? 0 : 1); ++k, ++to)
            {
              triangle.rows[to]   = triangle.rows[k];
              triangle.values[to] = value_at(k);
            }
        }
      triangle.start[n] = to;
      triangle.rows.resize(to);
    }



    template <typename Number>
    class Klu : public Factorization<Number>
    {
    public:
      explicit Klu(const Pattern &pattern)
        : pattern(pattern)
      {
        klu_defaults(&common);
        symbolic = klu_analyze(pattern.size(),
                               const_cast<int *>(pattern.column_start.data()),
                               const_cast<int *>(pattern.rows.data()),
                               &common);
        if (symbolic == nullptr && pattern.size() > 0)
          throw SingularMatrix(-1);
      }

      ~Klu() override
      {
        free_numeric(&numeric, &common, Number());
        klu_free_symbolic(&symbolic, &common);
      }

      Klu(const Klu &)            = delete;
      Klu &operator=(const Klu &) = delete;

      void
      factorize(const Number *values) override
      {
        // the old pivots serve while the matrix changes little; the condition tells when they do not
        if (numeric == nullptr || !refactor(pattern, values, symbolic, numeric, &common) ||
            common.rcond < 1e-3 * reference_rcond)
          {
            free_numeric(&numeric, &common, Number());
            numeric = factor(pattern, values, symbolic, &common);
            if (numeric == nullptr || common.status == KLU_SINGULAR)
              {
                const int column = common.singular_col;
                free_numeric(&numeric, &common, Number());
                throw SingularMatrix(column < pattern.size() ? column : -1);
              }
            find_rcond(symbolic, numeric, &common, Number());
            reference_rcond = common.rcond;
          }
        rcond = common.rcond;
        // blocks that are not coupled both ways have entries outside of L and U
        is_copied = numeric->nzoff == 0 && numeric->lnz + numeric->unz > largest_in_cache;
        if (is_copied)
          copy_factors();
      }

      void
      solve(Number *b) const override
      {
        if (is_copied)
          copy.solve(b);
        else
          solve_with(symbolic, numeric, pattern.size(), b, &common);
      }

      int
      determinant_sign() const override
      {
        // P A Q = L U with unit diagonal in L, and positive row scaling
        int sign = parity(numeric->Pnum) * parity(symbolic->Q);
        if constexpr (std::is_same_v<Number, double>)
          {
            const double *const diagonal = static_cast<const double *>(numeric->Udiag);
            for (int i = 0; i < pattern.size(); ++i)
              if (diagonal[i] < 0)
                sign = -sign;
          }
        return sign;
      }

      double
      reciprocal_condition() const override
      {
        return rcond;
      }

    private:
      void
      copy_factors()
      {
        const int n = pattern.size();
        copy.lower.start.resize(n + 1);
        copy.upper.start.resize(n + 1);
        copy.lower.rows.resize(numeric->lnz);
        copy.upper.rows.resize(numeric->unz);
        for (auto *const order : {&copy.row_order, &copy.column_order})
          order->resize(n);
        copy.scale.resize(n);
        copy.inverse_diagonal.resize(n);
        Extract<Number> extract;
        extract(symbolic, numeric, copy, &common);
        leave_out_diagonal<Number>(
          copy.lower, true, [&](const int k) { return extract.lower(k); }, nullptr);
        leave_out_diagonal<Number>(
          copy.upper, false, [&](const int k) { return extract.upper(k); }, &copy.inverse_diagonal);
      }

      /** +1 for an even permutation, -1 for an odd one. */
      int
      parity(const int *permutation) const
      {
        std::vector<bool> seen(pattern.size(), false);
        int               sign = 1;
        for (int i = 0; i < pattern.size(); ++i)
          for (int j = i, length = 0; !seen[j]; j = permutation[j], ++length)
            {
              seen[j] = true;
              if (length > 0)
                sign = -sign;
            }
        return sign;
      }

      const Pattern            &pattern;
      mutable klu_common        common;
      klu_symbolic             *symbolic        = nullptr;
      klu_numeric              *numeric         = nullptr;
      double                    reference_rcond = 0, rcond = 0;
      bool                      is_copied = false;
      TriangularFactors<Number> copy;
    };
  } // namespace



  template <typename Number>
  std::unique_ptr<Factorization<Number>>
  klu_factorization(const Pattern &pattern)
  {
    return std::make_unique<Klu<Number>>(pattern);
  }

  template std::unique_ptr<Factorization<double>>               klu_factorization(const Pattern &);
  template std::unique_ptr<Factorization<std::complex<double>>> klu_factorization(const Pattern &);
} // namespace samara
