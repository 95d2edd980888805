#include <samara/solvers/backward_error.h>
#include <samara/solvers/factorization.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/panel_factors.h>

#include <klu.h>

namespace samara
{
  namespace
  {
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



    /**
     * Rows of a factor that KLU keeps by columns, each as its row numbers and then, aligned to numbers, its values.
     * @param columns where each column begins, in numbers from @p storage
     */
    template <typename Number>
    RowLists
    by_rows(const int n, const Number *storage, const int *columns, const int *lengths)
    {
      const auto rows_of = [&](const int column) { return reinterpret_cast<const int *>(storage + columns[column]); };
      RowLists   result;
      result.start.assign(n + 1, 0);
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < lengths[j]; ++k)
          ++result.start[rows_of(j)[k] + 1];
      for (int i = 0; i < n; ++i)
        result.start[i + 1] += result.start[i];
      result.columns.resize(result.start[n]);
      auto next = result.start;
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < lengths[j]; ++k)
          result.columns[next[rows_of(j)[k]]++] = j;
      return result;
    }



    /** Where a matrix is conditioned otherwise than the one of its pivots, they are kept if solutions are as exact as
     * this. A matrix below the other bound may be singular, which new pivots tell. */
    constexpr double error_of_old_pivots = 1e-13, rcond_of_old_pivots = 1e-14;



    /** KLU finds the order of columns and the pivots, and with them where L and U have entries. */
    template <typename Number>
    class Klu : public Factorization<Number>
    {
    public:
      Klu(const Pattern &pattern, const Ordering ordering)
        : pattern(pattern)
      {
        klu_defaults(&common);
        if (ordering == Ordering::columns)
          {
            common.ordering = 1; // COLAMD
            common.tol      = 1.;
          }
        // with pivots on the diagonal it knows how much memory it needs, and gets more where it does not
        common.initmem_amd = 1.02;
        // one block, so that A has no entries outside of those of L and U
        common.btf = 0;
        symbolic   = klu_analyze(pattern.size(),
                               const_cast<int *>(pattern.column_start.data()),
                               const_cast<int *>(pattern.rows.data()),
                               &common);
        if (symbolic == nullptr && pattern.size() > 0)
          throw SingularMatrix(-1);
      }

      ~Klu() override
      {
        klu_free_symbolic(&symbolic, &common);
      }

      Klu(const Klu &)            = delete;
      Klu &operator=(const Klu &) = delete;

      void
      factorize(const Number *values) override
      {
        // the old pivots serve while the matrix changes little; the condition tells when they may not
        if (has_pivots && factors.factorize(values) < 0 && serves(values))
          return;
        has_pivots = false;
        find_pivots(values);
        const int lost = factors.factorize(values);
        if (lost >= 0)
          throw SingularMatrix(lost);
        has_pivots      = true;
        reference_rcond = factors.reciprocal_condition();
      }

      void
      solve(Number *b) const override
      {
        factors.solve(b);
      }

      int
      determinant_sign() const override
      {
        const int sign = parity(factors.row_order) * parity(factors.column_order);
        return factors.n_negative_pivots % 2 == 0 ? sign : -sign;
      }

      double
      reciprocal_condition() const override
      {
        return factors.reciprocal_condition();
      }

    private:
      bool
      serves(const Number *values)
      {
        const double rcond = factors.reciprocal_condition();
        if (rcond >= 1e-3 * reference_rcond && rcond <= 1e3 * reference_rcond)
          return true;
        // worse by itself, or by pivots that do not suit it any more; those of a matrix that had gone astray never did
        if (!(rcond > rcond_of_old_pivots) || !(backward_error(pattern, values, factors) < error_of_old_pivots))
          return false;
        reference_rcond = rcond;
        return true;
      }

      void
      find_pivots(const Number *values)
      {
        klu_numeric *numeric = factor(pattern, values, symbolic, &common);
        if (numeric == nullptr || common.status == KLU_SINGULAR)
          {
            const int column = common.singular_col;
            free_numeric(&numeric, &common, Number());
            throw SingularMatrix(column < pattern.size() ? column : -1);
          }
        const int n = pattern.size();
        // entries of L and U follow from the pivots
        const bool has_new_pivots =
          !std::equal(factors.row_order.begin(), factors.row_order.end(), numeric->Pnum, numeric->Pnum + n);
        Pivots pivots;
        if (has_new_pivots)
          {
            pivots.row_order.assign(numeric->Pnum, numeric->Pnum + n);
            pivots.column_order.assign(symbolic->Q, symbolic->Q + n);
            pivots.lower.start = pivots.upper.start = {0, 0};
            // KLU does not fill in its tables for one row
            if (n > 1)
              {
                const Number *const storage = static_cast<const Number *>(numeric->LUbx[0]);
                pivots.lower                = by_rows(n, storage, numeric->Lip, numeric->Llen);
                pivots.upper                = by_rows(n, storage, numeric->Uip, numeric->Ulen);
              }
          }
        // KLU's factors go before there are others: of large models they are the largest thing in memory
        free_numeric(&numeric, &common, Number());
        if (has_new_pivots)
          factors.set_pivots(pattern, std::move(pivots));
      }

      /** +1 for an even permutation, -1 for an odd one. */
      static int
      parity(const std::vector<int> &permutation)
      {
        std::vector<bool> seen(permutation.size(), false);
        int               sign = 1;
        for (unsigned int i = 0; i < permutation.size(); ++i)
          for (int j = i, length = 0; !seen[j]; j = permutation[j], ++length)
            {
              seen[j] = true;
              if (length > 0)
                sign = -sign;
            }
        return sign;
      }

      const Pattern       &pattern;
      klu_common           common;
      klu_symbolic        *symbolic        = nullptr;
      bool                 has_pivots      = false;
      double               reference_rcond = 0;
      PanelFactors<Number> factors;
    };
  } // namespace



  template <typename Number>
  std::unique_ptr<Factorization<Number>>
  klu_factorization(const Pattern &pattern, const Ordering ordering)
  {
    return std::make_unique<Klu<Number>>(pattern, ordering);
  }

  template std::unique_ptr<Factorization<double>>               klu_factorization(const Pattern &, Ordering);
  template std::unique_ptr<Factorization<std::complex<double>>> klu_factorization(const Pattern &, Ordering);
} // namespace samara
