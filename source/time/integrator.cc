#include <samara/solvers/newton.h>
#include <samara/time/integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  Integrator::Integrator(const System      &system,
                         const Tableau     &tableau,
                         const double       tolerance,
                         const unsigned int max_iterations)
    : tableau(tableau)
    , system(system)
    , tolerance(tolerance)
    , max_iterations(max_iterations)
    , length(model_length(system.model))
    , stages(tableau.s)
    , M(system.layout.pattern)
    , C(system.layout.pattern)
    , K(system.layout.pattern)
    , is_active(system.layout.n_multipliers, true)
  {
    for (const auto &eigenvalue : tableau.eigenvalues)
      {
        factors.emplace_back();
        if (eigenvalue.mu.imag() == 0.)
          factors.back().real = make_klu(system.layout.pattern);
        else
          factors.back().complex = make_complex_klu(system.layout.pattern);
      }
    const int n = system.layout.of_multiplier(0);
    for (int j = 0; j < system.layout.pattern->size(); ++j)
      for (int k = system.layout.pattern->column_start[j]; k < system.layout.pattern->column_start[j + 1]; ++k)
        is_constraint_entry.push_back(j >= n || system.layout.pattern->rows[k] >= n);
    for (const auto i : system.model.holds)
      is_active[i] = false;
    for (const auto i : system.dropped_multipliers())
      is_active[i] = false;
    system.mass(M);
  }



  void
  Integrator::forget_history()
  {
    previous_step = 0;
    factored_step = 0;
  }



  StepResult
  Integrator::step(State &state, const double h)
  {
    StepResult result;
    state.held = false;
    system.strains(state, e_start);
    const bool refactor = std::abs(factored_step / h - 1) > 1e-9;
    if (refactor)
      factorize(state, h);
    bool converged = iterate(state, h, result, refactor);
    if (!converged && !refactor)
      {
        // the old factorisation is no longer good enough
        factorize(state, h);
        converged = iterate(state, h, result, true);
      }
    if (!converged && previous_step > 0)
      {
        previous_step = 0; // the extrapolated start was not good
        converged     = iterate(state, h, result, true);
      }
    n_iterations += result.iterations;
    if (!converged)
      {
        forget_history();
        return result;
      }
    result.converged = true;
    account(state, h, result);
    finish(state, h, result);
    ++n_steps;
    return result;
  }



  bool
  Integrator::iterate(const State &state, const double h, StepResult &result, const bool fresh)
  {
    predict(state, h);
    double       last = 0, last_rate = 0, smallest = 1e300;
    unsigned int n_stagnant = 0;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        move_stages(state, h);
        evaluate(state, h);
        const double size = correct(state, h);
        ++result.iterations;
        result.last_correction = size;
        if (!std::isfinite(size) || size > 1e3)
          return false;
        // the worse of two rates, as they may alternate
        const double this_rate = iteration > 0 && last > 0 ? size / last : 0.5, rate = std::max(this_rate, last_rate);
        last_rate              = this_rate;
        n_stagnant             = size < 0.8 * smallest ? 0 : n_stagnant + 1;
        smallest               = std::min(smallest, size);
        // linear convergence: what is still missing is about size · rate/(1 − rate); at round-off it no longer shrinks
        if (iteration > 1 &&
            ((rate < 0.9 && size * rate / (1 - rate) < tolerance) || (n_stagnant > 2 && smallest < 1e-10)))
          {
            move_stages(state, h);
            evaluate(state, h);
            return true;
          }
        last = size;
        if (iteration > 2 && rate > (fresh ? 1.5 : 0.5) && size > 1e-8)
          return false;
      }
    // name the place of the largest force that is left
    double largest = 0;
    for (unsigned int i = 0; i < static_cast<unsigned int>(system.layout.of_multiplier(0)); ++i)
      if (std::abs(stages[0].residual[i]) > largest)
        {
          largest      = std::abs(stages[0].residual[i]);
          result.worst = i;
        }
    return false;
  }



  void
  Integrator::predict(const State &state, const double h)
  {
    const unsigned int s = tableau.s;
    for (unsigned int k = 0; k < s; ++k)
      {
        stages[k].time        = state.time + tableau.c(k) * h;
        stages[k].multipliers = state.multipliers;
        stages[k].y           = state.y;
        stages[k].rates       = state.rates;
      }
    if (previous_step == 0)
      return;
    // the polynomial through the start and the stages of the last step
    std::vector<double> t(1, 0.);
    for (unsigned int k = 0; k < s; ++k)
      t.push_back(tableau.c(k));
    for (unsigned int k = 0; k < s; ++k)
      {
        const double x = 1 + tableau.c(k) * h / previous_step;
        std::fill(stages[k].y.begin(), stages[k].y.end(), 0.);
        std::fill(stages[k].rates.begin(), stages[k].rates.end(), 0.);
        for (unsigned int j = 0; j <= s; ++j)
          {
            double L = 1;
            for (unsigned int i = 0; i <= s; ++i)
              if (i != j)
                L *= (x - t[i]) / (t[j] - t[i]);
            for (unsigned int i = 0; i < state.y.size(); ++i)
              stages[k].y[i] += L * previous_y[j][i];
            for (unsigned int i = 0; i < state.rates.size(); ++i)
              stages[k].rates[i] += L * previous_y[j][state.y.size() + i];
          }
      }
  }



  void
  Integrator::factorize(const State &state, const double h)
  {
    system.damping(state, C);
    system.tangent(state, K);
    const unsigned int                n = K.values.size() - 1;
    std::vector<std::complex<double>> values(n);
    SparseMatrix                      F(system.layout.pattern);
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const std::complex<double> hm = h * tableau.eigenvalues[j].mu;
        ++n_factorizations;
        if (factors[j].real)
          {
            for (unsigned int i = 0; i < n; ++i)
              F.values[i] = is_constraint_entry[i] ?
                              K.values[i] :
                              M.values[i] + hm.real() * C.values[i] + hm.real() * hm.real() * K.values[i];
            factors[j].real->factorize(F);
          }
        else
          {
            for (unsigned int i = 0; i < n; ++i)
              values[i] = is_constraint_entry[i] ? K.values[i] : M.values[i] + hm * (C.values[i] + hm * K.values[i]);
            factors[j].complex->factorize(values);
          }
      }
    factored_step = h;
    factored_y    = state.y;
  }



  namespace
  {
    /** Stage triads: [D_1 … D_s] (I − h W) = [D_i … D_i], W with the blocks a_kl Ω~_l. */
    template <int n>
    void
    solve_triads(const Eigen::Matrix<double, n, n> &system_transposed, const Matrix3 &D_start, Matrix3 *D)
    {
      Eigen::Matrix<double, n, 3> right;
      for (int k = 0; k < n / 3; ++k)
        right.template middleRows<3>(3 * k) = D_start.transpose();
      const Eigen::Matrix<double, n, 3> solution = system_transposed.partialPivLu().solve(right);
      for (int k = 0; k < n / 3; ++k)
        D[k] = solution.template middleRows<3>(3 * k).transpose();
    }

    template <int s>
    void
    stage_triads(const Tableau &t, const double h, const Vector3 *spin, const Matrix3 &D_start, Matrix3 *D)
    {
      Eigen::Matrix<double, 3 * s, 3 * s> A = Eigen::Matrix<double, 3 * s, 3 * s>::Identity();
      for (int k = 0; k < s; ++k)
        for (int l = 0; l < s; ++l)
          A.template block<3, 3>(3 * k, 3 * l) += h * t.a(k, l) * skew(spin[l]); // (−Ω~)ᵀ = Ω~
      solve_triads<3 * s>(A, D_start, D);
    }
  } // namespace



  void
  Integrator::move_stages(const State &state, const double h)
  {
    const unsigned int s = tableau.s;
    for (auto &stage : stages)
      {
        stage.q           = state.q;
        stage.coordinates = state.coordinates;
      }
    final_q           = state.q;
    final_coordinates = state.coordinates;
    Vector3 spin[3], velocity[3];
    Matrix3 D[3];
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3 D_start = state.triad(node);
        for (unsigned int k = 0; k < s; ++k)
          spin[k] = Eigen::Map<const Vector3>(&stages[k].y[6 * node + 3]);
        switch (s)
          {
            case 1:
              stage_triads<1>(tableau, h, spin, D_start, D);
              break;
            case 2:
              stage_triads<2>(tableau, h, spin, D_start, D);
              break;
            default:
              stage_triads<3>(tableau, h, spin, D_start, D);
          }
        for (unsigned int k = 0; k < s; ++k)
          velocity[k] = D[k] * Eigen::Map<const Vector3>(&stages[k].y[6 * node]);
        Eigen::Map<Vector3> x_final(&final_q[12 * node]);
        Eigen::Map<Matrix3> D_final(&final_q[12 * node + 3]);
        for (unsigned int k = 0; k < s; ++k)
          {
            Eigen::Map<Vector3> x(&stages[k].q[12 * node]);
            for (unsigned int l = 0; l < s; ++l)
              x += h * tableau.a(k, l) * velocity[l];
            Eigen::Map<Matrix3>(&stages[k].q[12 * node + 3]) = D[k];
            x_final += h * tableau.b(k) * velocity[k];
            D_final += h * tableau.b(k) * D[k] * skew(spin[k]);
          }
      }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      for (unsigned int k = 0; k < s; ++k)
        {
          for (unsigned int l = 0; l < s; ++l)
            stages[k].coordinates[i] += h * tableau.a(k, l) * stages[l].rates[i];
          final_coordinates[i] += h * tableau.b(k) * stages[k].rates[i];
        }
  }



  void
  Integrator::evaluate(const State &state, const double h)
  {
    const unsigned int s = tableau.s, n_strains = system.layout.n_strains, n_multipliers = system.layout.n_multipliers;
    for (auto &stage : stages)
      {
        stage.strain_rates.assign(n_strains, 0.);
        stage.constraint_rates.assign(n_multipliers, 0.);
        for (const auto &c : system.model.contributions)
          c->strain_rates(stage.point(), stage.strain_rates.data() + c->first_strain);
        for (const auto *c : system.layout.constraining)
          c->constraint_rates(stage.point(), stage.constraint_rates.data());
      }

    std::vector<double> e(n_strains);
    for (unsigned int k = 0; k < s; ++k)
      {
        Stage &stage = stages[k];
        e            = e_start;
        for (unsigned int l = 0; l < s; ++l)
          for (unsigned int i = 0; i < n_strains; ++i)
            e[i] += h * tableau.a_alpha(k, l) * stages[l].strain_rates[i];
        stage.stress.resize(n_strains);
        for (const auto &c : system.model.contributions)
          c->stresses(e.data() + c->first_strain,
                      stage.strain_rates.data() + c->first_strain,
                      stage.stress.data() + c->first_strain);

        stage.residual.assign(system.size() + 6, 0.);
        for (const auto &c : system.model.contributions)
          c->residual(stage.point(), stage.residual.data());
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          {
            const Matrix6                  &inertia = system.model.nodes[node].inertia;
            const Eigen::Map<const Vector6> y(&stage.y[6 * node]), y_start(&state.y[6 * node]);
            Vector6                         acceleration = Vector6::Zero();
            for (unsigned int l = 0; l < s; ++l)
              acceleration += tableau.w(k, l) / h * (Eigen::Map<const Vector6>(&stages[l].y[6 * node]) - y_start);
            Eigen::Map<Vector6>(&stage.residual[system.layout.of_node(node)]) +=
              inertia * acceleration - ad_star<double>(y, inertia * y);
          }
      }

    // constraints: at the end of the step, and the mean of the stages' rates
    Stage &first            = stages[0];
    Point<double> end       = first.point();
    end.q                   = final_q.data();
    end.coordinates         = final_coordinates.data();
    end.time                = state.time + h;
    constraints_at_end.assign(system.size() + 6, 0.);
    for (const auto *c : system.layout.constraining)
      c->residual(end, constraints_at_end.data());
    std::vector<double> mean(n_multipliers, 0.);
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < n_multipliers; ++i)
        mean[i] += tableau.b(k) * stages[k].constraint_rates[i];
    for (auto &stage : stages)
      for (unsigned int i = 0; i < n_multipliers; ++i)
        {
          const int row       = system.layout.of_multiplier(i);
          stage.residual[row] = is_active[i] ? stage.constraint_rates[i] - mean[i] + constraints_at_end[row] / h : 0.;
        }
    for (const auto &correction : system.layout.corrections)
      {
        double lambda = 0, squares = 0;
        for (unsigned int k = 0; k < s; ++k)
          {
            lambda += tableau.b(k) * stages[k].multipliers[correction.multiplier];
            squares += tableau.b(k) * std::pow(stages[k].rates[correction.coordinate], 2);
          }
        if (squares > 0)
          for (auto &stage : stages)
            stage.residual[system.layout.of_coordinate(correction.coordinate)] -=
              lambda * mean[correction.multiplier] / squares * stage.rates[correction.coordinate];
      }
  }



  double
  Integrator::correct(const State &, const double h)
  {
    const unsigned int n = system.size(), n_kinematic = system.layout.of_multiplier(0), s = tableau.s;
    std::vector<std::complex<double>> x(n);
    std::vector<double>               x_real(n);
    // corrections are measured against the largest velocity, or one that would matter over the step
    double                            size = 0, scale = 1e-3 / h;
    std::vector<std::vector<double>>  dy(s, std::vector<double>(n, 0.)); // twists and rates, then multipliers
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> hm         = h * eigenvalue.mu;
        for (unsigned int i = 0; i < n; ++i)
          {
            std::complex<double> r = 0;
            for (unsigned int k = 0; k < s; ++k)
              r += eigenvalue.left(k) * stages[k].residual[i];
            x[i] = i < n_kinematic ? -hm * hm * r : -hm * r;
          }
        if (factors[j].real)
          {
            for (unsigned int i = 0; i < n; ++i)
              x_real[i] = x[i].real();
            factors[j].real->solve(x_real.data());
            std::copy(x_real.begin(), x_real.end(), x.begin());
          }
        else
          factors[j].complex->solve(x.data());

        // from displacements in the nodes' frames to twists: δy = ζ/(hμ) + ad_y ζ
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          {
            Eigen::Map<Eigen::Matrix<std::complex<double>, 6, 1>> z(&x[system.layout.of_node(node)]);
            const Eigen::Map<const Vector6>                       y(&factored_y[6 * node]);
            z = (z / hm + ad(y) * z).eval();
          }
        for (unsigned int i = system.layout.of_coordinate(0); i < n_kinematic; ++i)
          x[i] /= hm;
        for (unsigned int i = n_kinematic; i < n; ++i)
          x[i] /= hm * hm;
        const double twice = factors[j].real ? 1. : 2.;
        for (unsigned int k = 0; k < s; ++k)
          for (unsigned int i = 0; i < n; ++i)
            dy[k][i] += twice * (eigenvalue.right(k) * x[i]).real();
      }
    for (unsigned int k = 0; k < s; ++k)
      {
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          {
            const Eigen::Map<const Vector6> d(&dy[k][system.layout.of_node(node)]);
            Eigen::Map<Vector6>(&stages[k].y[6 * node]) += d;
            size = std::max({size, d.head<3>().norm() / length, d.tail<3>().norm()});
            scale =
              std::max({scale, Eigen::Map<const Vector3>(&stages[k].y[6 * node]).norm() / length,
                        Eigen::Map<const Vector3>(&stages[k].y[6 * node + 3]).norm()});
            if (!std::isfinite(d.squaredNorm()))
              return d.squaredNorm();
          }
        for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
          {
            stages[k].rates[i] += dy[k][system.layout.of_coordinate(i)];
            size = std::max(size,
                            std::abs(dy[k][system.layout.of_coordinate(i)]) /
                              (system.model.coordinate_units[i] == "m" ? length : 1.));
          }
        for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
          stages[k].multipliers[i] += dy[k][system.layout.of_multiplier(i)];
      }
    return size / scale;
  }



  void
  Integrator::account(const State &state, const double h, StepResult &result)
  {
    const unsigned int s = tableau.s, n_strains = system.layout.n_strains;
    const auto power = [&](const std::vector<double> &r, const Stage &stage) {
      double sum = 0;
      for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
        sum += r[i] * stage.y[6 + i];
      for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
        sum += r[system.layout.of_coordinate(i)] * stage.rates[i];
      return sum;
    };
    const std::vector<double> no_stress(n_strains, 0.), no_multipliers(system.layout.n_multipliers, 0.);
    std::vector<double>       r, viscous(n_strains, 0.), time_rates;
    for (unsigned int k = 0; k < s; ++k)
      {
        const Stage  &stage = stages[k];
        Point<double> point = stage.point();
        point.multipliers   = no_multipliers.data();
        for (const auto &c : system.model.contributions)
          {
            if (!c->has_loads() && !c->has_damping())
              continue;
            point.stress = no_stress.data();
            r.assign(system.size() + 6, 0.);
            c->residual(point, r.data());
            const double load = power(r, stage);
            result.work_of_loads -= h * tableau.b(k) * load;
            if (!c->has_damping())
              continue;
            c->stresses(no_stress.data() + c->first_strain,
                        stage.strain_rates.data() + c->first_strain,
                        viscous.data() + c->first_strain);
            point.stress = viscous.data();
            r.assign(system.size() + 6, 0.);
            c->residual(point, r.data());
            result.viscous_loss += h * tableau.b(k) * (power(r, stage) - load);
          }
        // constraints do the work −λ·(ġ − ∂g/∂t); for those that do not depend on time it vanishes over the step
        time_rates.assign(system.layout.n_multipliers, 0.);
        for (const auto *c : system.layout.constraining)
          c->constraint_time_rates(stage.point(), time_rates.data());
        for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
          if (is_active[i])
            result.work_of_drives -=
              h * tableau.b(k) * stage.multipliers[i] * (stage.constraint_rates[i] - time_rates[i]);
      }
    for (const auto &correction : system.layout.corrections)
      for (unsigned int k = 0; k < s; ++k)
        for (unsigned int l = 0; l < s; ++l)
          result.work_of_drives += h * tableau.b(k) * tableau.b(l) * stages[k].multipliers[correction.multiplier] *
                                   stages[l].constraint_rates[correction.multiplier];

    // D = h² α/(2(2s−1)) |Σ b p (ẏ, ė)|² in the norm of the energy
    double              square = 0;
    std::vector<double> e(n_strains, 0.);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> y_start(&state.y[6 * node]);
        Vector6                         v = Vector6::Zero();
        for (unsigned int k = 0; k < s; ++k)
          for (unsigned int l = 0; l < s; ++l)
            v += tableau.b(k) * tableau.p(k) * tableau.w(k, l) / h *
                 (Eigen::Map<const Vector6>(&stages[l].y[6 * node]) - y_start);
        square += v.dot(system.model.nodes[node].inertia * v);
      }
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < n_strains; ++i)
        e[i] += tableau.b(k) * tableau.p(k) * stages[k].strain_rates[i];
    for (const auto &c : system.model.contributions)
      square += 2 * c->strain_energy(e.data() + c->first_strain);
    result.dissipated = h * h * tableau.alpha / (2 * (2. * s - 1)) * square;
  }



  void
  Integrator::finish(State &state, const double h, StepResult &)
  {
    const unsigned int s = tableau.s, n_y = state.y.size(), n_rates = state.rates.size();
    const auto         keep = [&](const std::vector<double> &y, const std::vector<double> &rates) {
      std::vector<double> all(y);
      all.insert(all.end(), rates.begin(), rates.end());
      return all;
    };
    previous_y.assign(1, keep(state.y, state.rates));
    for (const auto &stage : stages)
      previous_y.push_back(keep(stage.y, stage.rates));
    previous_step = h;

    for (unsigned int j = 0; j < n_y + n_rates; ++j)
      {
        const double start = previous_y[0][j];
        double       value = start;
        for (unsigned int k = 0; k < s; ++k)
          for (unsigned int l = 0; l < s; ++l)
            value += tableau.b(k) * tableau.w(k, l) * (previous_y[l + 1][j] - start);
        (j < n_y ? state.y[j] : state.rates[j - n_y]) = value;
      }
    state.q           = final_q;
    state.coordinates = final_coordinates;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Eigen::Map<Matrix3> D(&state.q[12 * node + 3]);
        D = renormalised(D); // against round-off only
      }
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      {
        state.multipliers[i] = 0;
        for (unsigned int k = 0; k < s; ++k)
          state.multipliers[i] += tableau.b(k) * stages[k].multipliers[i];
      }
    state.time += h;
    system.stresses(state, state.stress);
  }
} // namespace samara
