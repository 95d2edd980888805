// The matrices of Newton's method, and its corrections.

#include <samara/base/threads.h>
#include <samara/solvers/part_without.h>
#include <samara/solvers/row_scale.h>
#include <samara/solvers/swept_solver.h>
#include <samara/time/four_nodes.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Without the search for infinities that the standard asks for. */
    std::complex<double>
    product(const std::complex<double> &a, const std::complex<double> &b)
    {
      return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

    double
    product(const double a, const double b)
    {
      return a * b;
    }

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
    combine_matrices(h);
    const bool is_large = are_large(K);
    const auto make     = [&](const unsigned int j) {
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
    // of a large model the search for pivots needs the most memory of all: for one of them at a time
    if (is_large && n_factorizations == 0)
      for (unsigned int j = 0; j < factors.size(); ++j)
        make(j);
    else
      for_factors(make);
    n_factorizations += factors.size();
    factored_step = step_of_factors = h;
    n_steps_with_factors            = 0;
    extra_iterations                = 0;
    forget_columns();
  }



  void
  StageIntegrator::combine_matrices(const double h)
  {
    // where a matrix is singular there are no factors, whatever the next step is
    factored_step = step_of_factors = 0;
    if (!contacts.is_empty())
      add_contacts_to_matrices();
    for (auto *const parts : {&C, &K})
      parts->values.resize(parts->pattern->n_nonzeros() + 1);
    system.damping(frozen, C);
    system.tangent(frozen, K);
    for (const auto i : left_out)
      K.values[K.pattern->position(system.layout.of_multiplier(i), system.layout.of_multiplier(i))] = 1;
    // what has no row in the matrix is measured as it is
    for (unsigned int i = 0; i < gap_scale.size(); ++i)
      {
        const double scale = row_scale(system.layout, K, i, length);
        gap_scale[i]       = scale > 0 ? scale : 1.;
      }
    Point<double> point = frozen.point();
    point.multipliers   = no_multipliers.data();
    frozen_strains->renew(point);
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
    const Number       square = product(hm, hm);
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



  namespace
  {
    using Lane = FourNodes::Lane;

    Lane
    larger(const Lane &a, const Lane &b)
    {
      return Lane(a.values > b.values ? a.values : b.values);
    }

    double
    largest_of_lanes(const Lane &a)
    {
      return std::max({a.values[0], a.values[1], a.values[2], a.values[3]});
    }

    Lane
    square_of(const Lane *v)
    {
      return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    }

    /** The same operation on each. */
    Lane
    root_of(const Lane &a)
    {
      return Lane(
        Lane::Vector{std::sqrt(a.values[0]), std::sqrt(a.values[1]), std::sqrt(a.values[2]), std::sqrt(a.values[3])});
    }



    /** Add twist(nodes, ·) to the twists @p all of nodes, lengths in parts of @p length; what is no number is returned.
     */
    template <typename Twist>
    double
    correct_twists(const Twist &twist, const double length, std::vector<double> &all, double &size, double &scale)
    {
      const unsigned int n_nodes = all.size() / 6;
      const Lane         factor  = 1 / (length * length);
      Lane               changes = 0., squares = 0., sum = 0.;
      for (unsigned int first = 1; first < n_nodes; first += 4)
        {
          const FourNodes nodes(first, n_nodes);
          Lane            d[6], y[6];
          twist(nodes, d);
          nodes.load(6, all, y);
          for (int i = 0; i < 6; ++i)
            y[i] += d[i];
          nodes.store(6, y, all);
          // (|v| + |ω|)²
          const Lane of_v = factor * square_of(d), of_spin = square_of(d + 3),
                     change = of_v + of_spin + Lane(2.) * root_of(of_v * of_spin);
          sum += change;
          changes = larger(changes, change);
          squares = larger(squares, larger(factor * square_of(y), square_of(y + 3)));
        }
      size  = std::max(size, std::sqrt(largest_of_lanes(changes)));
      scale = std::max(scale, std::sqrt(largest_of_lanes(squares)));
      return sum.values[0] + sum.values[1] + sum.values[2] + sum.values[3];
    }
  } // namespace



  template <typename Twist>
  double
  StageIntegrator::correct_velocities(const double h, const Twist &twist)
  {
    // corrections are measured against the largest velocity, or one that would matter over the step, a thousandth of a
    // radian or of the length; those of multipliers against the largest, or a force whose work over the length is 1e-8
    // of the energy
    const Layout &layout = system.layout;
    double        size = 0, size_of_states = 0, scale = 1e-3 / h,
           largest_force     = 1e-8 * std::max(energy_scale, kinetic_energy) / length;
    previous_change_of_force = change_of_force;
    change_of_force          = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        if (const double all = correct_twists(
              [&](const FourNodes &nodes, Lane *d) { twist(k, nodes, d); }, length, stage.y, size, scale);
            !std::isfinite(all))
          return all;
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          {
            const double d = dz_rate[k][layout.of_coordinate(i)],
                         l = system.model.coordinate_units[i] == "m" ? length : 1.;
            stage.rates[i] += d;
            size  = std::max(size, std::abs(d) / l);
            scale = std::max(scale, std::abs(stage.rates[i]) / l);
          }
        for (unsigned int i = 0; i < layout.n_states; ++i)
          {
            const double d = dz[k][layout.of_state(i)];
            if (!std::isfinite(d))
              return d;
            stage.states[i] += d;
            size_of_states =
              std::max(size_of_states, std::abs(d) / std::max(std::abs(stage.states[i]), system.model.states[i].scale));
          }
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          {
            const double d = d_lambda[k][i];
            stage.multipliers[i] += d;
            change_of_force = std::max(change_of_force, std::abs(d));
            largest_force   = std::max(largest_force, std::abs(stage.multipliers[i]));
          }
      }
    if (largest_force > 0)
      change_of_force /= largest_force;
    return std::max(size / scale, size_of_states);
  }



  bool
  StageIntegrator::solve_for_increments(const double h)
  {
    apply_factors(h);
    if (!correct_for_stops(h))
      return false;
    collect_increments(h);
    return true;
  }



  void
  StageIntegrator::apply_factors(const double h)
  {
    const unsigned int n = system.size(), n_kinematic = system.layout.of_multiplier(0), s = tableau.s;
    for_factors([&](const unsigned int j) {
      const auto                &eigenvalue = tableau.eigenvalues[j];
      const std::complex<double> hm         = h * eigenvalue.mu;
      if (factors[j].real)
        {
          const double of_motion = -hm.real() * hm.real(), of_constraints = -hm.real();
          std::fill(x_real.begin(), x_real.end(), 0.);
          for (unsigned int k = 0; k < s; ++k)
            {
              const double  left = eigenvalue.left(k).real();
              const double *r    = stages[k].residual.data();
              for (unsigned int i = 0; i < n_kinematic; ++i)
                x_real[i] += of_motion * left * r[i];
              for (unsigned int i = n_kinematic; i < n; ++i)
                x_real[i] += of_constraints * left * r[i];
            }
          factors[j].real->solve(x_real.data());
        }
      else
        {
          for (unsigned int i = 0; i < n; ++i)
            {
              double real = 0, imag = 0;
              for (unsigned int k = 0; k < s; ++k)
                {
                  real += eigenvalue.left(k).real() * stages[k].residual[i];
                  imag += eigenvalue.left(k).imag() * stages[k].residual[i];
                }
              x[i] = product(i < n_kinematic ? -hm * hm : -hm, std::complex<double>(real, imag));
            }
          factors[j].complex->solve(x.data());
        }
    });
  }



  void
  StageIntegrator::collect_increments(const double h)
  {
    const unsigned int n = system.size(), n_kinematic = system.layout.of_multiplier(0), s = tableau.s;
    for (unsigned int k = 0; k < s; ++k)
      for (auto *const increments : {&dz[k], &dz_rate[k], &d_lambda[k]})
        std::fill(increments->begin(), increments->end(), 0.);

    // displacements ζ, their rates ζ/(hμ), multipliers; of a complex pair twice the real part
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> hm         = h * eigenvalue.mu;
        for (unsigned int k = 0; k < s; ++k)
          if (factors[j].real)
            {
              const double right = eigenvalue.right(k).real(), rate = right / hm.real(), force = rate / hm.real();
              for (unsigned int i = 0; i < n_kinematic; ++i)
                {
                  dz[k][i] += right * x_real[i];
                  dz_rate[k][i] += rate * x_real[i];
                }
              for (unsigned int i = n_kinematic; i < n; ++i)
                d_lambda[k][i - n_kinematic] += force * x_real[i];
            }
          else
            {
              const std::complex<double> right = 2. * eigenvalue.right(k), rate = right / hm, force = rate / hm;
              for (unsigned int i = 0; i < n_kinematic; ++i)
                {
                  dz[k][i] += product(right, x[i]).real();
                  dz_rate[k][i] += product(rate, x[i]).real();
                }
              for (unsigned int i = n_kinematic; i < n; ++i)
                d_lambda[k][i - n_kinematic] += product(force, x[i]).real();
            }
      }
  }



  Vector6
  StageIntegrator::change_of_twist(const unsigned int k, const unsigned int node) const
  {
    const int                       i = system.layout.of_node(node);
    const Eigen::Map<const Vector6> zeta(&dz[k][i]), rate(&dz_rate[k][i]);
    const Eigen::Map<const Vector3> v(&frozen.y[6 * node]), w(&frozen.y[6 * node + 3]);
    Vector6                         change;
    change << rate.head<3>() + w.cross(zeta.head<3>()) + v.cross(zeta.tail<3>()),
      rate.tail<3>() + w.cross(zeta.tail<3>());
    return change;
  }



  double
  StageIntegrator::solve(const double h)
  {
    if (!solve_for_increments(h))
      return std::nan("");
    return correct_velocities(h, [&](const unsigned int k, const FourNodes &nodes, Lane *const change) {
      // change_of_twist()
      Lane zeta[6], rate[6], y[6];
      nodes.load_unknowns(dz[k], zeta);
      nodes.load_unknowns(dz_rate[k], rate);
      nodes.load(6, frozen.y, y);
      for (int i = 0; i < 3; ++i)
        {
          const int m = (i + 1) % 3, n = (i + 2) % 3;
          change[i]     = rate[i] + y[3 + m] * zeta[n] - y[3 + n] * zeta[m] + y[m] * zeta[3 + n] - y[n] * zeta[3 + m];
          change[3 + i] = rate[3 + i] + y[3 + m] * zeta[3 + n] - y[3 + n] * zeta[3 + m];
        }
    });
  }



  void
  StageIntegrator::solve_exactly_for_increments(const double h)
  {
    std::vector<Point<double>> points;
    d_exact.resize(tableau.s);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        points.push_back(stages[k].point());
        d_exact[k] = stages[k].residual;
      }
    exact->assemble(points, h, is_active);
    add_slopes_of_stops(h);
    add_slopes_of_springs(h);
    if (!contacts.is_empty())
      add_contacts_to_exact_matrix(h);
    exact->solve(d_exact);
    ++n_factorizations;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        exact->displacements(k, d_exact, dz[k], dz_rate[k]);
        std::copy_n(d_exact[k].begin() + system.layout.of_multiplier(0),
                    system.layout.n_multipliers,
                    d_lambda[k].begin());
      }
  }



  double
  StageIntegrator::solve_exactly(const double h)
  {
    solve_exactly_for_increments(h);
    return correct_velocities(h, [&](const unsigned int k, const FourNodes &nodes, Lane *const change) {
      nodes.load_unknowns(d_exact[k], change);
    });
  }



  void
  StageIntegrator::correct_stresses()
  {
    // δσ = (what the configuration has more) + C B ζ + C_d B ζ̇, B as in the matrices
    const Layout &layout  = system.layout;
    const auto    strains = [&](const unsigned int k, const std::vector<double> &z, std::vector<double> &e) {
      std::copy_n(z.begin(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
      strains_in_matrix(k).strains(twists.data(), z.data() + layout.of_coordinate(0), e.data());
    };
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        strains(k, dz[k], strain_increment);
        if (system.is_viscous())
          strains(k, dz_rate[k], rate_increment);
        change_of_stresses(k, strain_increment.data(), rate_increment.data(), stress_increment);
        for (unsigned int i = 0; i < layout.n_strains; ++i)
          stage.stress[i] += stage.excess[i] + stress_increment[i];
      }
  }
} // namespace samara
