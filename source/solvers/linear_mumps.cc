#include <samara/solvers/factorization.h>
#include <samara/solvers/linear.h>

#include <dmumps_c.h>
#include <mpi.h>
#include <zmumps_c.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>

namespace samara
{
  namespace
  {
    /** The MUMPS of distributions needs MPI even for one process: started with the first solver, ended with the
     * program. */
    void
    start_mpi()
    {
      int is_started = 0;
      MPI_Initialized(&is_started);
      if (is_started)
        return;
      // alone in the world: no daemon is wanted
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
      int level = 0; // one thread at a time, but not always the same
      MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
      std::atexit([] {
        int is_over = 0;
        MPI_Finalized(&is_over);
        if (!is_over)
          MPI_Finalize();
      });
    }



    /**
     * MUMPS, real and complex, and MPI keep what belongs to one call in variables of their own: calls follow each
     * other, also those for the real and the complex factors of a step, which two threads make.
     */
    std::mutex one_at_a_time;



    template <typename Number>
    struct Mumps_of;

    template <>
    struct Mumps_of<double>
    {
      using Data = DMUMPS_STRUC_C;
      using Raw  = double;
      static void
      run(Data &data)
      {
        dmumps_c(&data);
      }
    };

    template <>
    struct Mumps_of<std::complex<double>>
    {
      using Data = ZMUMPS_STRUC_C;
      using Raw  = mumps_double_complex;
      static void
      run(Data &data)
      {
        zmumps_c(&data);
      }
    };



    template <typename Number>
    class Mumps : public Factorization<Number>
    {
      using Raw = typename Mumps_of<Number>::Raw;

      /** Entries of MUMPS' arrays by the numbers of its manual, which count from one. */
      MUMPS_INT &
      control(const int i)
      {
        return data.icntl[i - 1];
      }
      int
      info(const int i) const
      {
        return data.infog[i - 1];
      }

    public:
      explicit Mumps(const Pattern &pattern)
        : pattern(pattern)
        , values(pattern.n_nonzeros())
      {
        start_mpi();
        data.par          = 1;
        data.sym          = 0;
        data.comm_fortran = MPI_Comm_c2f(MPI_COMM_SELF);
        run(-1);
        for (const int stream : {1, 2, 3, 4})
          control(stream) = 0;  // no output
        control(14)  = 50;      // per cent of memory more than foreseen
        control(24)  = 1;       // go on where there is no pivot, and tell where
        data.cntl[2] = -1e-300; // none is one that is zero, nearly singular matrices are told by their condition
        control(33)  = std::is_same_v<Number, double>; // determinant
        for (int j = 0; j < pattern.size(); ++j)
          for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
            {
              rows.push_back(pattern.rows[k] + 1);
              columns.push_back(j + 1);
            }
        data.n   = pattern.size();
        data.nnz = pattern.n_nonzeros();
        data.irn = rows.data();
        data.jcn = columns.data();
      }

      ~Mumps() override
      {
        run(-2);
      }

      Mumps(const Mumps &)            = delete;
      Mumps &operator=(const Mumps &) = delete;

      void
      factorize(const Number *new_values) override
      {
        if (pattern.size() == 0)
          return;
        std::copy_n(new_values, values.size(), values.begin());
        data.a    = reinterpret_cast<Raw *>(values.data());
        condition = -1;
        if (!is_analysed)
          {
            // with values: they tell which zeros on the diagonal to avoid
            run(1);
            if (info(1) < 0)
              throw SingularMatrix(-1);
            is_analysed = true;
          }
        for (run(2); (info(1) == -8 || info(1) == -9) && control(14) < 10000; run(2))
          control(14) *= 2; // more memory
        if (info(1) == -13)
          throw std::bad_alloc();
        if (info(1) < 0 || info(28) > 0)
          throw SingularMatrix(info(28) > 0 ? data.pivnul_list[0] - 1 : -1);
      }

      void
      solve(Number *b) const override
      {
        solve(b, false);
      }

      int
      determinant_sign() const override
      {
        return data.rinfog[11] < 0 ? -1 : 1;
      }

      double
      reciprocal_condition() const override
      {
        if (condition < 0)
          condition = estimated_condition();
        return condition;
      }

    private:
      void
      run(const int job) const
      {
        const std::lock_guard<std::mutex> lock(one_at_a_time);
        data.job = job;
        Mumps_of<Number>::run(data);
      }

      void
      solve(Number *b, const bool transposed) const
      {
        if (pattern.size() == 0)
          return;
        data.nrhs     = 1;
        data.lrhs     = pattern.size();
        data.rhs      = reinterpret_cast<Raw *>(b);
        data.icntl[8] = transposed ? 0 : 1;
        run(3);
      }

      /**
       * 1/(|A| |A⁻¹|) in the 1-norm, rows and then columns divided by their largest entries; |A⁻¹| by W. W. Hager,
       * Condition estimates, SIAM J. Sci. Stat. Comput. 5 (1984) 311–316.
       */
      double
      estimated_condition() const
      {
        const int           n = pattern.size();
        std::vector<double> r(n, 0.), c(n, 0.);
        const auto          each = [&](const auto &function) {
          for (int j = 0; j < n; ++j)
            for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
              function(pattern.rows[k], j, std::abs(values[k]));
        };
        each([&](const int i, int, const double a) { r[i] = std::max(r[i], a); });
        each([&](const int i, const int j, const double a) { c[j] = std::max(c[j], a / r[i]); });
        std::vector<double> sums(n, 0.);
        each([&](const int i, const int j, const double a) { sums[j] += a / (r[i] * c[j]); });
        const double size = n > 0 ? *std::max_element(sums.begin(), sums.end()) : 1.;

        // the scaled matrix is R⁻¹ A C⁻¹, its inverse C A⁻¹ R
        std::vector<Number> x(n, Number(1. / n)), signs(n);
        double              inverse = 0;
        for (unsigned int iteration = 0; iteration < 5; ++iteration)
          {
            for (int i = 0; i < n; ++i)
              x[i] *= r[i];
            solve(x.data(), false);
            double sum = 0;
            for (int i = 0; i < n; ++i)
              {
                const Number y = c[i] * x[i];
                sum += std::abs(y);
                signs[i] = c[i] * (std::abs(y) > 0 ? y / std::abs(y) : Number(1));
              }
            if (!(sum > inverse))
              break;
            inverse = sum;
            solve(signs.data(), true);
            int largest = 0;
            for (int i = 0; i < n; ++i)
              {
                signs[i] *= r[i];
                if (std::abs(signs[i]) > std::abs(signs[largest]))
                  largest = i;
              }
            std::fill(x.begin(), x.end(), Number(0));
            x[largest] = 1;
          }
        return 1 / (size * inverse);
      }

      const Pattern                          &pattern;
      std::vector<Number>                     values; ///< MUMPS reads them with every factorisation
      std::vector<MUMPS_INT>                  rows, columns;
      mutable typename Mumps_of<Number>::Data data        = {}; ///< MUMPS takes right-hand sides from here
      bool                                    is_analysed = false;
      mutable double                          condition   = -1;
    };
  } // namespace



  template <typename Number>
  std::unique_ptr<Factorization<Number>>
  mumps_factorization(const Pattern &pattern)
  {
    return std::make_unique<Mumps<Number>>(pattern);
  }

  std::optional<int>
  mumps_n_negative(const Pattern &pattern, const double *values)
  {
    start_mpi();
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    DMUMPS_STRUC_C                    data = {};
    const auto                        run  = [&](const int job) {
      data.job = job;
      dmumps_c(&data);
      return data.infog[0] >= 0;
    };
    data.par          = 1;
    data.sym          = 2; // symmetric, indefinite
    data.comm_fortran = MPI_Comm_c2f(MPI_COMM_SELF);
    run(-1);
    for (const int stream : {0, 1, 2, 3})
      data.icntl[stream] = 0; // no output
    data.icntl[13] = 100;     // per cent of memory more than foreseen
    std::vector<MUMPS_INT> rows, columns;
    std::vector<double>    lower;
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        if (pattern.rows[k] >= j && values[k] != 0.)
          {
            rows.push_back(pattern.rows[k] + 1);
            columns.push_back(j + 1);
            lower.push_back(values[k]);
          }
    data.n             = pattern.size();
    data.nnz           = lower.size();
    data.irn           = rows.data();
    data.jcn           = columns.data();
    data.a             = lower.data();
    const bool has_any = run(1) && run(2);
    const int  result  = data.infog[11];
    run(-2);
    return has_any ? std::optional<int>(result) : std::nullopt;
  }



  template std::unique_ptr<Factorization<double>>               mumps_factorization(const Pattern &);
  template std::unique_ptr<Factorization<std::complex<double>>> mumps_factorization(const Pattern &);
} // namespace samara
