#include <samara/solvers/backward_error.h>
#include <samara/solvers/diagonal_order.h>
#include <samara/solvers/factorization.h>
#include <samara/solvers/panel_factors.h>
#include <samara/solvers/symmetric_factors.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace samara
{
  namespace
  {
    /** Smaller matrices are factorised before an order is found; sparser ones are those of chains and trees of bodies.
     */
    constexpr int    least_size        = 2000;
    constexpr double least_work_a_row  = 4000; ///< multiplications; a chain of beams takes 1000
    constexpr double largest_error     = 1e-11;
    constexpr double smallest_of_pivot = 1e-14; ///< of pivots, relative: less may be a singular matrix

    /** Factorisations that pivots on the diagonal, or symmetric factors, may fail at before they are given up. */
    constexpr unsigned int most_refused = 3;

    /** Passes that may make good what is not symmetric: factors of the whole matrix cost as much as many solutions. */
    constexpr unsigned int most_passes = 4;



    /**
     * Factors of matrices that are symmetric, or nearly so, such as tangents near an equilibrium. Complex ones, those
     * of the stages of a step, are taken as they come.
     */
    template <typename Number>
    class SymmetricTrial
    {
    public:
      void
      set_order(const DiagonalOrder &)
      {}
      bool
      factorize(const Pattern &, const Number *)
      {
        return false;
      }
      const PanelFactors<Number> &
      get() const
      {
        return none;
      }

    private:
      PanelFactors<Number> none;
    };

    template <>
    class SymmetricTrial<double>
    {
    public:
      void
      set_order(const DiagonalOrder &order)
      {
        structure = order.supernodes();
      }

      /** Whether there are factors, and accurate ones. */
      bool
      factorize(const Pattern &pattern, const double *values)
      {
        if (n_refused == most_refused || !factors.split(pattern, values))
          return false;
        if (!structure.order.empty())
          factors.set_order(std::move(structure));
        structure = {};
        const bool has_pivots =
          factors.factorize(pattern, values) < 0 && factors.reciprocal_condition() >= smallest_of_pivot;
        for (factors.n_passes = 0; has_pivots && factors.n_passes <= most_passes; ++factors.n_passes)
          {
            if (backward_error(pattern, values, factors) <= largest_error)
              return true;
            if (factors.is_symmetric())
              break;
          }
        if (++n_refused == most_refused)
          factors = SymmetricFactors();
        return false;
      }

      const SymmetricFactors &
      get() const
      {
        return factors;
      }

    private:
      Supernodes       structure; ///< until it is needed
      SymmetricFactors factors;
      unsigned int     n_refused = 0;
    };



    /**
     * What suits the pattern: KLU's pivots where the factors fill little; otherwise pivots on the diagonal,
     * whose accuracy is measured at each factorisation, L D Lᵀ where the matrix is symmetric or nearly so, else L U;
     * and MUMPS where it does not suffice.
     */
    template <typename Number>
    class Automatic : public Factorization<Number>
    {
    public:
      Automatic(const Pattern &pattern, const Ordering ordering)
        : pattern(pattern)
        , ordering(ordering)
      {}

      void
      factorize(const Number *values) override
      {
        if (!is_chosen)
          choose(values);
        is_symmetric = has_order && symmetric.factorize(pattern, values);
        if (is_symmetric)
          return;
        is_diagonal = has_order && n_refused < most_refused && factorize_on_diagonal(values);
        if (is_diagonal)
          return;
        if (has_order && ++n_refused == most_refused)
          factors = PanelFactors<Number>(); // it is not tried any more
        if (!other)
          other = has_order ? mumps_factorization<Number>(pattern) : klu_factorization<Number>(pattern, ordering);
        other->factorize(values);
      }

      void
      solve(Number *b) const override
      {
        is_symmetric ? symmetric.get().solve(b) : is_diagonal ? factors.solve(b) : other->solve(b);
      }

      void
      solve_columns(Number *b, const unsigned int n_columns, const std::size_t size) const override
      {
        if constexpr (std::is_same_v<Number, double>)
          if (is_symmetric)
            return symmetric.get().solve_columns(b, n_columns, size);
        Factorization<Number>::solve_columns(b, n_columns, size);
      }

      std::optional<int>
      n_negative() const override
      {
        return is_symmetric ? std::optional<int>(n_negative_pivots()) : std::nullopt;
      }

      const SymmetricFactors *
      symmetric_factors() const override
      {
        if constexpr (std::is_same_v<Number, double>)
          return is_symmetric ? &symmetric.get() : nullptr;
        return nullptr;
      }

      int
      determinant_sign() const override
      {
        if (is_symmetric || is_diagonal)
          return n_negative_pivots() % 2 == 0 ? 1 : -1;
        return other->determinant_sign();
      }

      double
      reciprocal_condition() const override
      {
        return is_symmetric ? symmetric.get().reciprocal_condition() :
               is_diagonal  ? factors.reciprocal_condition() :
                              other->reciprocal_condition();
      }

    private:
      void
      choose(const Number *values)
      {
        is_chosen   = true;
        const int n = pattern.size();
        if (n < least_size || !is_structure_symmetric(pattern))
          return;
        std::vector<bool> is_late(n);
        for (int j = 0; j < n; ++j)
          {
            const int k = pattern.position(j, j);
            is_late[j]  = k < 0 || values[k] == Number();
          }
        order = std::make_unique<DiagonalOrder>(pattern, is_late);
        if (has_order = order->n_operations >= least_work_a_row * n; has_order)
          symmetric.set_order(*order);
        else
          order.reset();
      }



      int
      n_negative_pivots() const
      {
        return is_symmetric ? symmetric.get().n_negative_pivots : factors.n_negative_pivots;
      }



      bool
      factorize_on_diagonal(const Number *values)
      {
        if (order)
          factors.set_pivots(pattern, order->pivots());
        order.reset();
        return factors.factorize(values) < 0 && factors.reciprocal_condition() >= smallest_of_pivot &&
               backward_error(pattern, values, factors) <= largest_error;
      }

      const Pattern                         &pattern;
      const Ordering                         ordering;
      bool                                   is_chosen = false, has_order = false;
      bool                                   is_symmetric = false, is_diagonal = false;
      unsigned int                           n_refused = 0;
      std::unique_ptr<DiagonalOrder>         order; ///< until the panels are made
      SymmetricTrial<Number>                 symmetric;
      PanelFactors<Number>                   factors;
      std::unique_ptr<Factorization<Number>> other;
    };
  } // namespace



  template <typename Number>
  std::unique_ptr<Factorization<Number>>
  automatic_factorization(const Pattern &pattern, const Ordering ordering)
  {
    return std::make_unique<Automatic<Number>>(pattern, ordering);
  }

  template std::unique_ptr<Factorization<double>>               automatic_factorization(const Pattern &, Ordering);
  template std::unique_ptr<Factorization<std::complex<double>>> automatic_factorization(const Pattern &, Ordering);
} // namespace samara
