#ifndef samara_solvers_swept_solver_h
#define samara_solvers_swept_solver_h

#include <samara/base/dense.h>
#include <samara/solvers/linear.h>

#include <Eigen/Dense>

#include <cmath>

namespace samara
{
  namespace internal
  {
    /** A solver and its matrix, of either kind of numbers. */
    template <typename Number>
    struct SparseFactors
    {
      std::shared_ptr<const Pattern> pattern;
      SparseMatrix                   A;
      std::unique_ptr<LinearSolver>  solver;

      explicit SparseFactors(const std::shared_ptr<const Pattern> &pattern)
        : pattern(pattern)
        , A(pattern)
        , solver(make_solver(pattern))
      {}
      std::vector<double> &
      values()
      {
        return A.values;
      }
      void
      factorize()
      {
        solver->factorize(A);
      }
    };

    template <>
    struct SparseFactors<std::complex<double>>
    {
      std::shared_ptr<const Pattern>    pattern;
      std::vector<std::complex<double>> A;
      std::unique_ptr<ComplexSolver>    solver;

      explicit SparseFactors(const std::shared_ptr<const Pattern> &pattern)
        : pattern(pattern)
        , A(pattern->n_nonzeros())
        , solver(make_complex_solver(pattern))
      {}
      std::vector<std::complex<double>> &
      values()
      {
        return A;
      }
      void
      factorize()
      {
        solver->factorize(A);
      }
    };
  } // namespace internal



  /**
   * Approximate factors of matrices with a few dense unknowns z, states that nearly everything depends on and that
   * hardly act back within a step, as those of a rotor's inflow: a sweep over the blocks
   *
   *     A_zz z₀ = b_z        A_qq q = b_q − A_qz z₀        A_zz z = b_z − A_zq q
   *
   * in place of factors that the dense rows and columns fill. What is left of an error is A_zz⁻¹ A_zq A_qq⁻¹ A_qz of
   * it: for Newton's method with factors that are old anyway. How much that is is estimated with the factors by a power
   * iteration; where it is more than a tenth all is factorised as it stands.
   */
  template <typename Number>
  class SweptFactors
  {
  public:
    /** @p dense: the unknowns z. */
    SweptFactors(const std::shared_ptr<const Pattern> &all, const std::vector<int> &dense)
      : all(all)
      , place(all->size(), -1)
      , dense(dense)
    {
      for (unsigned int i = 0; i < dense.size(); ++i)
        place[dense[i]] = -2 - static_cast<int>(i);
      for (int i = 0; i < all->size(); ++i)
        if (place[i] == -1)
          {
            place[i] = sparse.size();
            sparse.push_back(i);
          }
      auto part = std::make_shared<Pattern>();
      part->column_start.push_back(0);
      for (int j = 0; j < all->size(); ++j)
        {
          for (int k = all->column_start[j]; k < all->column_start[j + 1]; ++k)
            {
              const int row = place[all->rows[k]], column = place[j];
              if (row >= 0 && column >= 0)
                {
                  part->rows.push_back(row);
                  kept.push_back(k);
                }
              else if (row >= 0)
                down.push_back({row, -2 - column, k});
              else
                up.push_back({-2 - row, column, k});
            }
          if (place[j] >= 0)
            part->column_start.push_back(part->rows.size());
        }
      qq = std::make_unique<internal::SparseFactors<Number>>(part);
      A_zz.resize(dense.size(), dense.size());
      q.resize(sparse.size());
      of_down.resize(down.size());
      of_up.resize(up.size());
    }

    /** @throws SingularMatrix */
    void
    factorize(const Number *values)
    {
      is_swept = n_refused < most_refused && factorize_blocks(values);
      if (is_swept)
        return;
      ++n_refused;
      if (!whole)
        whole = std::make_unique<internal::SparseFactors<Number>>(all);
      std::copy_n(values, all->n_nonzeros(), whole->values().begin());
      whole->factorize();
    }

    void
    solve(Number *b) const
    {
      if (!is_swept)
        return whole->solver->solve(b);
      Vector b_z(dense.size());
      for (unsigned int i = 0; i < dense.size(); ++i)
        b_z(i) = b[dense[i]];
      for (unsigned int i = 0; i < sparse.size(); ++i)
        q[i] = b[sparse[i]];
      subtract_down(zz.solve(b_z));
      qq->solver->solve(q.data());
      subtract_up(b_z);
      const Vector z = zz.solve(b_z);
      for (unsigned int i = 0; i < dense.size(); ++i)
        b[dense[i]] = z(i);
      for (unsigned int i = 0; i < sparse.size(); ++i)
        b[sparse[i]] = q[i];
    }

    /** What a sweep leaves of an error, as last estimated, and whether it is taken. */
    double left     = 0;
    bool   is_swept = false;

    const LinearSolver &
    real_solver() const
    {
      return is_swept ? *qq->solver : *whole->solver;
    }

  private:
    using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

    static constexpr double       most_left    = 0.1;
    static constexpr unsigned int most_refused = 3; ///< then it is not tried any more

    /** An entry that couples one with the other; where it is among all. */
    struct Entry
    {
      int row, column, at;
    };

    std::shared_ptr<const Pattern>                   all;
    std::vector<int>                                 place; ///< among sparse ones, or −2 less that among dense ones
    std::vector<int>                                 dense, sparse, kept;
    std::vector<Entry>                               down, up; ///< A_qz, A_zq and A_zz
    std::vector<Number>                              of_down, of_up;
    std::unique_ptr<internal::SparseFactors<Number>> qq, whole;
    Matrix                                           A_zz;
    LuFactors<Number>                                zz;
    mutable std::vector<Number>                      q;
    unsigned int                                     n_refused = 0;

    /** q −= A_qz z */
    void
    subtract_down(const Vector &z) const
    {
      for (unsigned int i = 0; i < down.size(); ++i)
        q[down[i].row] -= of_down[i] * z(down[i].column);
    }

    /** b −= A_zq q */
    void
    subtract_up(Vector &b) const
    {
      for (unsigned int i = 0; i < up.size(); ++i)
        if (up[i].column >= 0)
          b(up[i].row) -= of_up[i] * q[up[i].column];
    }

    bool
    factorize_blocks(const Number *values)
    {
      A_zz.setZero();
      for (unsigned int i = 0; i < down.size(); ++i)
        of_down[i] = values[down[i].at];
      for (unsigned int i = 0; i < up.size(); ++i)
        if (up[i].column >= 0)
          of_up[i] = values[up[i].at];
        else
          A_zz(up[i].row, -2 - up[i].column) = values[up[i].at];
      zz.compute(A_zz);
      for (unsigned int k = 0; k < kept.size(); ++k)
        qq->values()[k] = values[kept[k]];
      qq->factorize();
      // largest eigenvalue, about: from one direction that has parts of all
      Vector z(dense.size());
      for (unsigned int i = 0; i < dense.size(); ++i)
        z(i) = 1. + 0.5 * std::sin(7. * i);
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double size = z.norm();
          std::fill(q.begin(), q.end(), Number(0));
          subtract_down(z);
          qq->solver->solve(q.data());
          z.setZero();
          subtract_up(z);
          z    = zz.solve(z).eval();
          left = z.norm() / size;
          if (!(left > 0))
            break;
          z /= z.norm();
        }
      return left < most_left;
    }
  };



  /** As a solver of real matrices. */
  class SweptRealSolver : public LinearSolver
  {
  public:
    SweptRealSolver(const std::shared_ptr<const Pattern> &pattern, const std::vector<int> &dense)
      : factors(pattern, dense)
    {}
    void
    factorize(const SparseMatrix &A) override
    {
      ++n_factorizations;
      factors.factorize(A.values.data());
    }
    void
    solve(double *b) const override
    {
      factors.solve(b);
    }
    int
    determinant_sign() const override
    {
      return factors.real_solver().determinant_sign();
    }
    double
    reciprocal_condition() const override
    {
      return factors.real_solver().reciprocal_condition();
    }

  private:
    SweptFactors<double> factors;
  };



  /** As one of complex matrices. */
  class SweptComplexSolver : public ComplexSolver
  {
  public:
    SweptComplexSolver(const std::shared_ptr<const Pattern> &pattern, const std::vector<int> &dense)
      : factors(pattern, dense)
    {}
    void
    factorize(const std::vector<std::complex<double>> &values) override
    {
      factors.factorize(values.data());
    }
    void
    solve(std::complex<double> *b) const override
    {
      factors.solve(b);
    }

  private:
    SweptFactors<std::complex<double>> factors;
  };
} // namespace samara

#endif
