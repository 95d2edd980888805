#include <samara/solvers/newton.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    constexpr unsigned int max_factorizations_per_step = 4;

    /** What a factorisation with its matrices costs, in iterations. */
    constexpr double iterations_of_a_factorization = 4;
  } // namespace



  StageIntegrator::StageIntegrator(const System      &system,
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
    , is_nonholonomic(system.layout.n_multipliers, false)
    , is_active(system.layout.n_multipliers, true)
    , real_matrix(system.layout.pattern)
    , final_weights(tableau.w.transpose() * tableau.b)
    , no_multipliers(system.layout.n_multipliers, 0.)
  {
    const Layout      &layout = system.layout;
    const unsigned int n      = system.size();
    for (const auto &eigenvalue : tableau.eigenvalues)
      {
        factors.emplace_back();
        if (eigenvalue.mu.imag() == 0.)
          factors.back().real = make_solver(layout.pattern);
        else
          factors.back().complex = make_complex_solver(layout.pattern);
      }
    const int n_kinematic = layout.of_multiplier(0);
    for (int j = 0; j < layout.pattern->size(); ++j)
      for (int k = layout.pattern->column_start[j]; k < layout.pattern->column_start[j + 1]; ++k)
        is_constraint_entry.push_back(j >= n_kinematic || layout.pattern->rows[k] >= n_kinematic);
    for (const auto i : layout.nonholonomic)
      is_nonholonomic[i] = true;
    for (const auto i : system.released_multipliers())
      is_active[i] = false;
    for (const auto i : system.dropped_multipliers())
      is_active[i] = false;
    for (const auto &c : system.model.contributions)
      {
        has_damping = has_damping || c->has_damping();
        frozen_strains.push_back(c->n_strains() > 0 ? c->linear_strains() : nullptr);
      }
    system.mass(M);

    x.resize(n);
    x_real.resize(n);
    x_rates.resize(layout.n_coordinates);
    e.resize(layout.n_strains);
    mean_rates.resize(layout.n_multipliers);
    twists.assign(6 * layout.n_nodes, 0.);
    for (auto *const increments : {&dy, &dz, &dz_rate})
      increments->assign(tableau.s, std::vector<double>(n));
    for (auto *const strains : {&strain_increment, &rate_increment, &stress_increment})
      strains->assign(layout.n_strains, 0.);
    previous.assign(tableau.s + 1, std::vector<double>(6 * layout.n_nodes + layout.n_coordinates));
  }



  void
  StageIntegrator::forget_history()
  {
    previous_step = 0;
    factored_step = 0;
    offset        = 1;
  }



  void
  StageIntegrator::step_back()
  {
    offset       = 0;
    extrapolates = true;
  }



  StepResult
  StageIntegrator::step(State &state, const double h)
  {
    StepResult result;
    state.held = false;
    system.strains(state, e_start);
    energy_scale = system.energy(state).kinetic + system.energy(state).strain;
    predict(state, h);
    bool converged = false;
    if (frozen.switches != state.switches)
      factored_step = 0;
    if (std::abs(factored_step / h - 1) < 1e-9)
      {
        converged = iterate(state, h, 0.3, result);
        if (!converged && !(result.last_correction < 0.1))
          predict(state, h); // not even near
      }
    for (unsigned int i = 0; !converged && i < max_factorizations_per_step; ++i)
      {
        // about the middle of the step, as far as it is known; the last time, where another one would not help
        freeze(state, h);
        try
          {
            factorize(h);
          }
        catch (const SingularMatrix &)
          {
            break; // gone astray
          }
        const bool is_last = i + 1 == max_factorizations_per_step || (i > 0 && result.last_correction < 0.01);
        converged          = iterate(state, h, is_last ? 0.95 : 0.5, result);
        if (!converged && (is_last || !(result.last_correction < 10)))
          {
            if (previous_step == 0)
              break;
            previous_step = 0; // perhaps the extrapolated start was not good
            predict(state, h);
            i = 0;
          }
      }
    n_iterations += result.iterations;
    judge_factors(result.iterations);
    // nothing moves where a body is held in its place: velocities do not tell whether the force there converges
    if (change_of_force > 1e-3 && change_of_force > 0.3 * previous_change_of_force)
      factored_step = 0;
    if (converged)
      {
        account(state, h, result);
        converged = has_sources(result, h);
      }
    if (!converged)
      {
        forget_history();
        return result;
      }
    result.converged = true;
    remember(state, h);
    finish(state, h);
    ++n_steps;
    return result;
  }



  bool
  StageIntegrator::has_sources(const StepResult &result, const double h) const
  {
    // what moves by a thousandth of the model a step is round-off of something at rest
    double mass = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      mass += system.model.nodes[node].inertia(0, 0);
    const double nothing = 0.5 * mass * std::pow(1e-3 * length / h, 2);
    return kinetic_energy <
           10 * (energy_scale + std::abs(result.work_of_loads) + std::abs(result.work_of_drives)) + nothing;
  }



  void
  StageIntegrator::judge_factors(const unsigned int iterations)
  {
    // renew them when a step costs more iterations extra than the average of those so far, the factorisation included
    ++n_steps_with_factors;
    if (n_steps_with_factors == 1)
      fresh_iterations = iterations;
    const double extra = iterations > fresh_iterations ? iterations - fresh_iterations : 0.;
    if (n_steps_with_factors > 1 &&
        extra > (iterations_of_a_factorization + extra_iterations) / (n_steps_with_factors - 1))
      factored_step = 0;
    extra_iterations += extra;
  }



  bool
  StageIntegrator::iterate(const State &state, const double h, const double slow, StepResult &result)
  {
    const bool   is_fresh = n_steps_with_factors == 0;
    double       last = 0, last_rate = 0, smallest = 1e300;
    unsigned int n_stagnant = 0;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        move_stages(state, h);
        evaluate(state, h);
        // linear convergence: what is still missing is about last · rate/(1 − rate); at round-off it no longer shrinks
        if (iteration > 0)
          {
            const double rate  = std::min(iteration > 1 ? last_rate : 0.5, 0.9);
            const double error = energy_error(h), scale = std::max(energy_scale, kinetic_energy);
            if (last * rate / (1 - rate) < tolerance && error < tolerance * scale &&
                largest_gap(h) < std::max(1e-9, 10 * tolerance) * length)
              return true;
            // what is left may be more than what was before, if factors are old: then it grows, slowly, from round-off
            if (n_stagnant > 2 && last < 1e-9)
              return is_fresh || (error < 1e-12 * scale && largest_gap(h) < 1e-12 * length);
          }
        const double size = solve(h);
        ++result.iterations;
        result.last_correction = size;
        if (!std::isfinite(size) || size > 1e3)
          return false;
        correct_stresses();
        // the worse of two rates, as they may alternate
        const double this_rate = last > 0 ? size / last : 0;
        const double rate      = std::max(this_rate, last_rate);
        last_rate              = iteration > 0 ? this_rate : 0;
        if (size > 1e-9)
          smallest = std::max(smallest, size); // a first correction may be none by accident
        n_stagnant = size < 0.8 * smallest ? 0 : n_stagnant + 1;
        smallest   = std::min(smallest, size);
        last       = size;
        if (iteration > 1 && rate > slow && size > 1e-8)
          {
            // too slow with this factorisation, unless little is missing
            if (std::log(tolerance / size) / std::log(std::min(rate, 0.99)) > 4)
              return false;
          }
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



  double
  StageIntegrator::largest_gap(const double h) const
  {
    double gap = 0;
    for (const Stage &stage : stages)
      for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
        gap = std::max(gap, h * std::abs(stage.residual[system.layout.of_multiplier(i)]));
    return gap;
  }



  double
  StageIntegrator::energy_error(const double h) const
  {
    double force_work = 0, stress_work = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        const Stage &stage = stages[k];
        double       power = 0;
        for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
          power += stage.residual[i] * stage.y[6 + i];
        for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
          power += stage.residual[system.layout.of_coordinate(i)] * stage.rates[i];
        force_work += h * tableau.b(k) * power;
        for (const auto &c : system.model.contributions)
          stress_work +=
            h * tableau.b(k) *
            std::abs(c->power(stage.excess.data() + c->first_strain, stage.strain_rates.data() + c->first_strain));
      }
    return std::abs(force_work) + stress_work;
  }



  void
  StageIntegrator::extrapolate(const double at, std::vector<double> &y, std::vector<double> &rates) const
  {
    // the polynomial through the start and the stages of the last step
    std::fill(y.begin(), y.end(), 0.);
    std::fill(rates.begin(), rates.end(), 0.);
    const unsigned int n_y  = y.size();
    const auto         node = [&](const unsigned int j) { return j == 0 ? 0. : tableau.c(j - 1); };
    for (unsigned int j = 0; j <= tableau.s; ++j)
      {
        double L = 1;
        for (unsigned int i = 0; i <= tableau.s; ++i)
          if (i != j)
            L *= (at - node(i)) / (node(j) - node(i));
        for (unsigned int i = 0; i < n_y; ++i)
          y[i] += L * previous[j][i];
        for (unsigned int i = 0; i < rates.size(); ++i)
          rates[i] += L * previous[j][n_y + i];
      }
  }



  void
  StageIntegrator::predict(const State &state, const double h)
  {
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage      = stages[k];
        stage.time        = state.time + tableau.c(k) * h;
        stage.switches    = state.switches.data();
        stage.multipliers = state.multipliers;
        stage.stress      = state.stress;
        stage.y           = state.y;
        stage.rates       = state.rates;
        if (previous_step > 0 && extrapolates)
          extrapolate(offset + tableau.c(k) * h / previous_step, stage.y, stage.rates);
      }
  }



  void
  StageIntegrator::remember(const State &state, const double h)
  {
    const unsigned int n_y = state.y.size();
    if (previous_step > 0)
      {
        // would extrapolation have been nearer than the velocities at the start?
        const Stage &last  = stages.back();
        double       error = 0, change = 0;
        dy[0].resize(n_y);
        extrapolate(offset + tableau.c(tableau.s - 1) * h / previous_step, dy[0], x_rates);
        for (unsigned int i = 0; i < n_y; ++i)
          {
            error += std::pow(dy[0][i] - last.y[i], 2);
            change += std::pow(state.y[i] - last.y[i], 2);
          }
        dy[0].resize(system.size());
        extrapolates = error < change;
      }
    else
      extrapolates = true;
    for (unsigned int j = 0; j <= tableau.s; ++j)
      {
        const auto &y     = j == 0 ? state.y : stages[j - 1].y;
        const auto &rates = j == 0 ? state.rates : stages[j - 1].rates;
        std::copy(y.begin(), y.end(), previous[j].begin());
        std::copy(rates.begin(), rates.end(), previous[j].begin() + n_y);
      }
    previous_step = h;
    offset        = 1;
  }



  void
  StageIntegrator::freeze(const State &state, const double h)
  {
    // the mean of the stages; places and triads half a step after the start
    frozen      = state;
    frozen.time = state.time + 0.5 * h;
    for (auto *const values : {&frozen.y, &frozen.rates, &frozen.multipliers, &frozen.stress})
      std::fill(values->begin(), values->end(), 0.);
    const auto add = [](const double b, const std::vector<double> &from, std::vector<double> &to) {
      for (unsigned int i = 0; i < to.size(); ++i)
        to[i] += b * from[i];
    };
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        add(tableau.b(k), stages[k].y, frozen.y);
        add(tableau.b(k), stages[k].rates, frozen.rates);
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
  StageIntegrator::factorize(const double h)
  {
    system.damping(frozen, C);
    system.tangent(frozen, K);
    Point<double> point = frozen.point();
    point.multipliers   = no_multipliers.data();
    for (const auto &strains : frozen_strains)
      if (strains)
        strains->renew(point);
    const unsigned int n = K.values.size() - 1;
    matrix.resize(n);
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const std::complex<double> hm = h * tableau.eigenvalues[j].mu;
        ++n_factorizations;
        if (factors[j].real)
          {
            const double hr = hm.real();
            for (unsigned int i = 0; i < n; ++i)
              real_matrix.values[i] =
                is_constraint_entry[i] ? K.values[i] : M.values[i] + hr * (C.values[i] + hr * K.values[i]);
            factors[j].real->factorize(real_matrix);
          }
        else
          {
            for (unsigned int i = 0; i < n; ++i)
              matrix[i] = is_constraint_entry[i] ? K.values[i] : M.values[i] + hm * (C.values[i] + hm * K.values[i]);
            factors[j].complex->factorize(matrix);
          }
      }
    factored_step        = h;
    n_steps_with_factors = 0;
    extra_iterations     = 0;
  }



  double
  StageIntegrator::solve(const double h)
  {
    const Layout      &layout = system.layout;
    const unsigned int n = system.size(), n_kinematic = layout.of_multiplier(0), s = tableau.s;
    for (unsigned int k = 0; k < s; ++k)
      for (auto *const increments : {&dy[k], &dz[k], &dz_rate[k]})
        std::fill(increments->begin(), increments->end(), 0.);

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

        // displacements ζ, their rates ζ/(hμ), multipliers; of a complex pair twice the real part
        const double twice = factors[j].real ? 1. : 2.;
        for (unsigned int k = 0; k < s; ++k)
          {
            const std::complex<double> right = twice * eigenvalue.right(k), rate = right / hm, force = rate / hm;
            for (unsigned int i = 0; i < n_kinematic; ++i)
              {
                dz[k][i] += (right * x[i]).real();
                dz_rate[k][i] += (rate * x[i]).real();
              }
            for (unsigned int i = n_kinematic; i < n; ++i)
              dy[k][i] += (force * x[i]).real();
          }
      }

    // corrections are measured against the largest velocity, or one that would matter over the step
    double size = 0, scale = 1e-3 / h, largest_force = 1e-8 * std::max(energy_scale, kinetic_energy) / length;
    previous_change_of_force = change_of_force;
    change_of_force          = 0;
    for (unsigned int k = 0; k < s; ++k)
      {
        Stage &stage = stages[k];
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            // to twists: δy = ζ̇ + ad_y ζ
            const int                       i = layout.of_node(node);
            const Eigen::Map<const Vector6> zeta(&dz[k][i]), rate(&dz_rate[k][i]);
            const Eigen::Map<const Vector3> v(&frozen.y[6 * node]), w(&frozen.y[6 * node + 3]);
            const Vector3                   d_v = rate.head<3>() + w.cross(zeta.head<3>()) + v.cross(zeta.tail<3>()),
                          d_w                   = rate.tail<3>() + w.cross(zeta.tail<3>());
            Eigen::Map<Vector3> y_v(&stage.y[6 * node]), y_w(&stage.y[6 * node + 3]);
            y_v += d_v;
            y_w += d_w;
            const double change = d_v.norm() / length + d_w.norm();
            if (!std::isfinite(change))
              return change;
            size  = std::max(size, change);
            scale = std::max({scale, y_v.norm() / length, y_w.norm()});
          }
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          {
            const double d = dz_rate[k][layout.of_coordinate(i)],
                         l = system.model.coordinate_units[i] == "m" ? length : 1.;
            stage.rates[i] += d;
            size  = std::max(size, std::abs(d) / l);
            scale = std::max(scale, std::abs(stage.rates[i]) / l);
          }
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          {
            const double d = dy[k][layout.of_multiplier(i)];
            stage.multipliers[i] += d;
            change_of_force = std::max(change_of_force, std::abs(d));
            largest_force   = std::max(largest_force, std::abs(stage.multipliers[i]));
          }
      }
    if (largest_force > 0)
      change_of_force /= largest_force;
    return size / scale;
  }



  void
  StageIntegrator::correct_stresses()
  {
    // δσ = (what the configuration has more) + C B ζ + C_d B ζ̇, B as in the matrices
    const Layout &layout  = system.layout;
    const auto    strains = [&](const std::vector<double> &z, std::vector<double> &e) {
      std::copy_n(z.begin(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
      for (unsigned int i = 0; i < frozen_strains.size(); ++i)
        if (frozen_strains[i])
          frozen_strains[i]->strains(twists.data(),
                                     z.data() + layout.of_coordinate(0),
                                     e.data() + system.model.contributions[i]->first_strain);
    };
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        strains(dz[k], strain_increment);
        if (has_damping)
          strains(dz_rate[k], rate_increment);
        for (const auto &c : system.model.contributions)
          c->stresses(strain_increment.data() + c->first_strain,
                      rate_increment.data() + c->first_strain,
                      stress_increment.data() + c->first_strain);
        for (unsigned int i = 0; i < layout.n_strains; ++i)
          stage.stress[i] += stage.excess[i] + stress_increment[i];
      }
  }



  void
  StageIntegrator::finish(State &state, const double h)
  {
    const unsigned int s       = tableau.s;
    const auto         advance = [&](std::vector<double> &y, std::vector<double> Stage::*of_stage) {
      for (unsigned int j = 0; j < y.size(); ++j)
        {
          const double start = y[j];
          for (unsigned int k = 0; k < s; ++k)
            y[j] += final_weights(k) * ((stages[k].*of_stage)[j] - start);
        }
    };
    advance(state.y, &Stage::y);
    advance(state.rates, &Stage::rates);
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
