// The matrices of Newton's method and their factors.

#include <samara/base/threads.h>
#include <samara/solvers/part_without.h>
#include <samara/solvers/row_scale.h>
#include <samara/solvers/swept_solver.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Fewer dense states fill too little for it. */
    constexpr unsigned int worth_sweeping = 8;

    /** Unknowns that are states of first order and depend on more than a third of all, in systems that are not small.
     */
    std::vector<int>
    dense_states(const Layout &layout, const Pattern &pattern)
    {
      constexpr int    least_size = 300;
      std::vector<int> dense;
      for (int j = layout.of_state(0); j < layout.of_multiplier(0) && pattern.size() > least_size; ++j)
        if (3 * (pattern.column_start[j + 1] - pattern.column_start[j]) > pattern.size())
          dense.push_back(j);
      return dense;
    }



    /** Whether to make matrices anew costs little beside the factors, and their memory counts: 2.4 MB each and more. */
    bool
    are_large(const SparseMatrix &K)
    {
      return K.pattern->n_nonzeros() > 300000;
    }



    std::vector<double>
    entries_of(const SparseMatrix &K, const std::vector<unsigned int> &numbers)
    {
      std::vector<double> result;
      result.reserve(numbers.size());
      for (const unsigned int i : numbers)
        result.push_back(K.values[i]);
      return result;
    }



    /** What matrices of stages have besides hμ C + (hμ)² K: rows and columns of constraints as they are, @p kept,
     * masses, and contacts in groups. */
    template <typename Number, typename Masses, typename Pairs>
    void
    complete(const Number                    &hm,
             const std::vector<unsigned int> &of_constraints,
             const std::vector<double>       &kept,
             const Masses                    &masses,
             const Pairs                     &pairs,
             std::vector<Number>             &values)
    {
      for (unsigned int i = 0; i < of_constraints.size(); ++i)
        values[of_constraints[i]] = kept[i];
      for (const auto &m : masses)
        values[m.at] += m.value;
      for (const auto &p : pairs)
        values[p.at] += hm * p.C + hm * hm * p.K;
    }



    /**
     * The matrices of a large model, hμ C + (hμ)² K for one real μ and one complex, each where it is not zero, without
     * C, K and both at once: of 90 000 unknowns each of them has 22 MB, the complex matrix twice as much.
     */
    struct MatricesInTurn
    {
      const System                      &system;
      const State                       &state;
      SparseMatrix                      &K, &C; ///< K is known; both are gone afterwards
      std::vector<double>               &real;
      std::vector<std::complex<double>> &complex;

      void
      combine(const double of_real, const std::complex<double> &of_complex)
      {
        const unsigned int n = K.pattern->n_nonzeros();
        C.values             = std::vector<double>();
        if (of_complex == 0.)
          {
            real.swap(K.values);
            C.values.resize(n + 1);
            system.damping(state, C);
            for (unsigned int i = 0; i < n; ++i)
              real[i] = of_real * C.values[i] + of_real * of_real * real[i];
          }
        else
          {
            complex.resize(n);
            for (unsigned int i = 0; i < n; ++i)
              complex[i] = of_complex * of_complex * K.values[i];
            C.values.swap(K.values);
            system.damping(state, C);
            for (unsigned int i = 0; i < n; ++i)
              complex[i] += of_complex * C.values[i];
            if (of_real != 0.)
              make_real(of_real, of_complex);
          }
        C.values = std::vector<double>();
        K.values = std::vector<double>();
      }

      /** In the place of C: K is the real part of z/(hμ)² − C/(hμ) for the complex matrix z. */
      void
      make_real(const double h, const std::complex<double> &a)
      {
        const std::complex<double> of_z = 1. / (a * a), of_C = 1. / a;
        real.swap(C.values);
        for (unsigned int i = 0; i < complex.size(); ++i)
          {
            const std::complex<double> &z = complex[i];
            const double                K = of_z.real() * z.real() - of_z.imag() * z.imag() - of_C.real() * real[i];
            real[i]                       = h * real[i] + h * h * K;
          }
      }
    };
  } // namespace



  void
  StageIntegrator::freeze(const State &state, const double h)
  {
    // the mean of the stages; places and triads half a step after the start
    frozen       = state;
    frozen.time  = state.time + 0.5 * h;
    frozen.stops = false;
    frozen.left_out.clear(); // their entries are not used
    for (auto *const values : {&frozen.y, &frozen.rates, &frozen.states, &frozen.multipliers, &frozen.stress})
      std::fill(values->begin(), values->end(), 0.);
    const auto add = [](const double b, const std::vector<double> &from, std::vector<double> &to) {
      for (unsigned int i = 0; i < to.size(); ++i)
        to[i] += b * from[i];
    };
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        add(tableau.b(k), stages[k].y, frozen.y);
        add(tableau.b(k), stages[k].rates, frozen.rates);
        add(tableau.b(k), stages[k].states, frozen.states);
        add(tableau.b(k), stages[k].multipliers, frozen.multipliers);
        add(tableau.b(k), stages[k].stress, frozen.stress);
      }
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector3> v(&frozen.y[6 * node]), spin(&frozen.y[6 * node + 3]);
        Eigen::Map<Matrix3>             D(&frozen.q[12 * node + 3]);
        const Vector3                   half_turn = 0.5 * h * spin;
        Eigen::Map<Vector3>(&frozen.q[12 * node]) += 0.5 * h * (D * cayley<double>(0.5 * half_turn) * v);
        D = (D * cayley<double>(half_turn)).eval();
      }
    add(0.5 * h, frozen.rates, frozen.coordinates);
  }



  void
  StageIntegrator::for_factors(const std::function<void(unsigned int)> &f) const
  {
    // at most one real and one complex
    constexpr unsigned int worth_threads = 2000;
    parallel_for(factors.size(),
                 system.size() < worth_threads ? factors.size() + 1 : 2,
                 [&f](const unsigned int begin, const unsigned int end) {
                   for (unsigned int j = begin; j < end; ++j)
                     f(j);
                 });
  }



  void
  StageIntegrator::make_factors()
  {
    std::shared_ptr<const Pattern> pattern = system.layout.pattern;
    entries_in_use.clear();
    if (!left_out.empty())
      {
        PartOfPattern part = part_without(system.layout, *pattern, left_out, [](int, int) { return true; });
        pattern            = part.pattern;
        entries_in_use     = std::move(part.kept);
      }
    if (!couplings.empty())
      pattern = with_couplings(pattern);
    SparseMatrix M(system.layout.pattern);
    system.mass(M);
    mass.clear();
    for (int k = 0; k < pattern->n_nonzeros(); ++k)
      if (const int i = entries_in_use.empty() ? k : entries_in_use[k]; i >= 0 && M.values[i] != 0.)
        mass.push_back({static_cast<unsigned int>(k), M.values[i]});
    constraint_entries.clear();
    const int n_kinematic = system.layout.of_multiplier(0);
    for (int j = 0; j < pattern->size(); ++j)
      for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
        if (j >= n_kinematic || pattern->rows[k] >= n_kinematic)
          constraint_entries.push_back(k);

    factored_step       = 0;
    real_matrix.pattern = pattern;
    real_matrix.values  = std::vector<double>();
    factors             = new_factors();
    factors_at_end.clear();
  }



  std::vector<StageIntegrator::Factor>
  StageIntegrator::new_factors() const
  {
    std::vector<Factor>    result(tableau.eigenvalues.size());
    const std::vector<int> dense = dense_states(system.layout, *real_matrix.pattern);
    for (unsigned int i = 0; i < result.size(); ++i)
      if (dense.size() >= worth_sweeping && tableau.eigenvalues[i].mu.imag() == 0.)
        result[i].real = std::make_unique<SweptRealSolver>(real_matrix.pattern, dense);
      else if (dense.size() >= worth_sweeping)
        result[i].complex = std::make_unique<SweptComplexSolver>(real_matrix.pattern, dense);
      else if (tableau.eigenvalues[i].mu.imag() == 0.)
        result[i].real = make_solver(real_matrix.pattern);
      else
        result[i].complex = make_complex_solver(real_matrix.pattern);
    return result;
  }



  void
  StageIntegrator::factorize(const double h)
  {
    const bool is_large = are_large(K);
    const auto renew    = [&] {
      if (!frozen_strains)
        frozen_strains = system.linear_strains();
      Point<double> point = frozen.point();
      point.multipliers   = no_multipliers.data();
      frozen_strains->renew(point);
    };
    const auto make = [&](const unsigned int j) {
      if (factors[j].real)
        {
          factors[j].real->factorize(real_matrix);
          if (is_large)
            real_matrix.values = std::vector<double>();
        }
      else
        {
          factors[j].complex->factorize(matrix);
          if (is_large)
            matrix = std::vector<std::complex<double>>();
        }
    };
    // Of a large model nothing needs as much memory as this: its matrices become factors, and are gone, one after the
    // other, the real one first; B, which has 21 MB of 90 000 unknowns, is made anew behind them, and what stages had
    // in earlier steps, as much, is collected anew.
    if (is_large)
      {
        frozen_strains.reset();
        forget_matrices();
      }
    try
      {
        combine_matrices(h);
        if (!is_large)
          for_factors(make);
        else
          for (const bool is_real : {true, false})
            for (unsigned int j = 0; j < factors.size(); ++j)
              if ((factors[j].real != nullptr) == is_real)
                make(j);
      }
    catch (const SingularMatrix &)
      {
        renew();
        throw;
      }
    renew();
    n_factorizations += factors.size();
    factored_step = step_of_factors = h;
    n_steps_with_factors            = 0;
    extra_iterations                = 0;
    forget_columns();
  }



  void
  StageIntegrator::forget_matrices()
  {
    for (auto *const values : {&K.values, &C.values, &real_matrix.values})
      *values = std::vector<double>();
    matrix = std::vector<std::complex<double>>();
    for (auto *const history : {&velocity_history, &rate_history, &stress_history, &multiplier_history})
      *history = StageHistory(tableau.s);
  }



  void
  StageIntegrator::combine_matrices(const double h)
  {
    // where a matrix is singular there are no factors, whatever the next step is
    factored_step = step_of_factors = 0;
    if (!contacts.is_empty())
      add_contacts_to_matrices();
    K.values.resize(K.pattern->n_nonzeros() + 1);
    system.tangent(frozen, K);
    for (const auto i : left_out)
      K.values[K.pattern->position(system.layout.of_multiplier(i), system.layout.of_multiplier(i))] = 1;
    // what has no row in the matrix is measured as it is
    for (unsigned int i = 0; i < gap_scale.size(); ++i)
      {
        const double scale = row_scale(system.layout, K, i, length);
        gap_scale[i]       = scale > 0 ? scale : 1.;
      }
    if (are_large(K) && entries_in_use.empty())
      {
        double               of_real = 0; // at most one of each
        std::complex<double> of_complex(0);
        for (unsigned int j = 0; j < factors.size(); ++j)
          if (factors[j].real)
            of_real = h * tableau.eigenvalues[j].mu.real();
          else
            of_complex = h * tableau.eigenvalues[j].mu;
        const std::vector<double> of_constraints = entries_of(K, constraint_entries);
        MatricesInTurn{system, frozen, K, C, real_matrix.values, matrix}.combine(of_real, of_complex);
        if (of_real != 0.)
          complete(of_real, constraint_entries, of_constraints, mass, entries_of_pairs, real_matrix.values);
        if (of_complex != 0.)
          complete(of_complex, constraint_entries, of_constraints, mass, entries_of_pairs, matrix);
        return;
      }
    C.values.resize(C.pattern->n_nonzeros() + 1);
    system.damping(frozen, C);
    for_factors([&](const unsigned int j) {
      const std::complex<double> hm = h * tableau.eigenvalues[j].mu;
      if (factors[j].real)
        {
          real_matrix.values.resize(real_matrix.pattern->n_nonzeros() + 1);
          combine(hm.real(), real_matrix.values);
        }
      else
        {
          matrix.resize(real_matrix.pattern->n_nonzeros());
          combine(hm, matrix);
        }
    });
    if (are_large(K))
      for (auto *const parts : {&C, &K})
        parts->values = std::vector<double>();
  }



  template <typename Number>
  void
  StageIntegrator::combine(const Number &hm, std::vector<Number> &values) const
  {
    // rows and columns of constraints are as they are
    const unsigned int n      = real_matrix.pattern->n_nonzeros();
    const Number       square = hm * hm;
    if (entries_in_use.empty())
      for (unsigned int i = 0; i < n; ++i)
        values[i] = hm * C.values[i] + square * K.values[i];
    else
      for (unsigned int i = 0; i < n; ++i)
        {
          const int from = entries_in_use[i];
          values[i]      = from < 0 ? Number(0) : hm * C.values[from] + square * K.values[from];
        }
    for (const unsigned int i : constraint_entries)
      if (const int from = entries_in_use.empty() ? int(i) : entries_in_use[i]; from >= 0)
        values[i] = K.values[from];
    for (const auto &m : mass)
      values[m.at] += m.value;
    for (const auto &p : entries_of_pairs)
      values[p.at] += hm * p.C + square * p.K;
  }
} // namespace samara
