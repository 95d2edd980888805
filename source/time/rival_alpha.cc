#include <samara/time/rival_alpha.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  GeneralisedAlpha::Coefficients
  GeneralisedAlpha::of_spectral_radius(const double rho)
  {
    // Chung & Hulbert 1993: second order, and the least dissipation at low frequencies for this radius
    Coefficients c;
    c.alpha_m = (2 * rho - 1) / (rho + 1);
    c.alpha_f = rho / (rho + 1);
    c.gamma   = 0.5 + c.alpha_f - c.alpha_m;
    c.beta    = 0.25 * (c.gamma + 0.5) * (c.gamma + 0.5);
    return c;
  }



  GeneralisedAlpha::Coefficients
  GeneralisedAlpha::trapezoidal()
  {
    return {0., 0., 0.5, 0.25};
  }



  GeneralisedAlpha::GeneralisedAlpha(const System             &system,
                                     const Coefficients       &coefficients,
                                     const bool                corrected_start,
                                     const IntegratorSettings &settings)
    : system(system)
    , c(coefficients)
    , corrected_start(corrected_start)
    , settings(settings)
    , measure(system)
    , projection(system)
    , solver(make_solver(system.layout.pattern))
    , M(system.layout.pattern)
    , C(system.layout.pattern)
    , K(system.layout.pattern)
    , is_active(rivals::active_multipliers(system))
    , is_nonholonomic(rivals::nonholonomic_multipliers(system))
  {
    system.mass(M);
  }



  GeneralisedAlpha::GeneralisedAlpha(const System &system, const IntegratorSettings &settings)
    : GeneralisedAlpha(system, of_spectral_radius(settings.spectral_radius), true, settings)
  {}



  TrapezoidalRule::TrapezoidalRule(const System &system, const IntegratorSettings &settings)
    : GeneralisedAlpha(system, trapezoidal(), false, settings)
  {}



  void
  GeneralisedAlpha::forget_history()
  {
    is_pending    = false;
    now.h         = 0;
    factored_step = 0;
  }



  void
  GeneralisedAlpha::step_back()
  {
    is_pending = false;
  }



  std::vector<double>
  GeneralisedAlpha::velocities(const State &state) const
  {
    std::vector<double> v(state.y.begin() + 6, state.y.end());
    v.insert(v.end(), state.rates.begin(), state.rates.end());
    return v;
  }



  void
  GeneralisedAlpha::set_velocities(State &state, const std::vector<double> &v) const
  {
    std::copy_n(v.begin(), state.y.size() - 6, state.y.begin() + 6);
    std::copy(v.end() - state.rates.size(), v.end(), state.rates.begin());
  }



  std::vector<double>
  GeneralisedAlpha::accelerations_after(const State &state, const double dt)
  {
    const std::vector<double> v     = velocities(state);
    const unsigned int        n     = v.size();
    State                     later = state;
    std::vector<double>       w(n), path(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        w[i]    = v[i] + dt * now.y_dot[i];
        path[i] = dt * v[i] + 0.5 * dt * dt * now.y_dot[i];
      }
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      rivals::move(later, node, Eigen::Map<const Vector6>(&path[6 * (node - 1)]));
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      later.coordinates[i] += path[system.layout.of_coordinate(i)];
    set_velocities(later, w);
    later.time += dt;
    system.stresses(later, later.stress);
    return projection.accelerations(later);
  }



  std::vector<double>
  GeneralisedAlpha::with_change_of_rates(const State &state, const std::vector<double> &change)
  {
    // the smallest change of velocities that violates the rates of the constraints by as much; not those of rolling
    const std::vector<double> v         = velocities(state);
    const unsigned int        n         = v.size();
    State                     disturbed = state;
    std::vector<double>       x         = change;
    for (unsigned int i = 0; i < n; ++i)
      x[i] += v[i];
    set_velocities(disturbed, x);
    const std::vector<double> wanted = rivals::constraint_rates(system, disturbed),
                              given  = rivals::constraint_rates(system, state);
    x.assign(system.size(), 0.);
    for (unsigned int i = 0; i < wanted.size(); ++i)
      if (is_active[i] && !is_nonholonomic[i])
        x[system.layout.of_multiplier(i)] = wanted[i] - given[i];
    system.tangent(state, K);
    for (unsigned int j = 0; j < n; ++j)
      for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1]; ++k)
        if (K.pattern->rows[k] < static_cast<int>(n))
          K.values[k] = M.values[k];
    solver->factorize(K);
    factored_step = 0;
    solver->solve(x.data());
    for (unsigned int i = 0; i < n; ++i)
      x[i] += v[i];
    x.resize(n);
    return x;
  }



  void
  GeneralisedAlpha::start(State &state, const double h)
  {
    projection.velocities(state);
    system.stresses(state, state.stress);
    now.h     = h;
    now.y_dot = projection.accelerations(state);
    now.a     = now.y_dot;
    if (!corrected_start)
      return;

    const std::vector<double> v   = velocities(state);
    const unsigned int        n   = v.size();
    const double              dt  = 0.1 * h;
    const std::vector<double> one = accelerations_after(state, dt), two = accelerations_after(state, 2 * dt);
    std::vector<double>       jerk(n), error(n);
    // one-sided difference of second order: there is no motion before the start
    for (unsigned int i = 0; i < n; ++i)
      jerk[i] = (4 * one[i] - 3 * now.y_dot[i] - two[i]) / (2 * dt);

    const auto size = [&](const std::vector<double> &u) {
      State s = state;
      set_velocities(s, u);
      return measure.largest(s.y, s.rates);
    };
    // a step that does not resolve the change of accelerations (doc/theory/rivals.md): the start stays as it is
    if (!(h * h * size(jerk) <= 0.5 * size(v) + h * size(now.y_dot)))
      return;

    // Arnold, Brüls & Cardona 2015: a = ẏ + (α_m − α_f) h ÿ, and δy = h² (C_q ÿ + ad_y ẏ/12) across the constraints
    const double shift = c.alpha_m - c.alpha_f, C_q = 1. / 6 - c.beta - 0.5 * shift;
    for (unsigned int i = 0; i < n; ++i)
      {
        now.a[i] += shift * h * jerk[i];
        error[i] = h * h * C_q * jerk[i];
      }
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const unsigned int i = 6 * (node - 1);
        Eigen::Map<Vector6>(&error[i]) +=
          h * h / 12 * ad(Eigen::Map<const Vector6>(&v[i])) * Eigen::Map<const Vector6>(&now.y_dot[i]);
      }
    set_velocities(state, with_change_of_rates(state, error));
  }



  void
  GeneralisedAlpha::predict(const State &state, const double h, Iterate &iterate) const
  {
    const std::vector<double> v = velocities(state);
    const unsigned int        n = v.size();
    iterate.state               = state;
    iterate.state.time          = state.time + h;
    iterate.y_dot               = now.y_dot;
    iterate.a.resize(n);
    iterate.increment.resize(n);
    std::vector<double> w(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        iterate.a[i] =
          ((1 - c.alpha_f) * iterate.y_dot[i] + c.alpha_f * now.y_dot[i] - c.alpha_m * now.a[i]) / (1 - c.alpha_m);
        iterate.increment[i] = h * v[i] + h * h * ((0.5 - c.beta) * now.a[i] + c.beta * iterate.a[i]);
        w[i]                 = v[i] + h * ((1 - c.gamma) * now.a[i] + c.gamma * iterate.a[i]);
      }
    set_velocities(iterate.state, w);
    configure(state, iterate);
    system.stresses(iterate.state, iterate.state.stress);
  }



  void
  GeneralisedAlpha::configure(const State &state, Iterate &iterate) const
  {
    iterate.state.q           = state.q;
    iterate.state.coordinates = state.coordinates;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      rivals::move(iterate.state, node, Eigen::Map<const Vector6>(&iterate.increment[6 * (node - 1)]));
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      iterate.state.coordinates[i] += iterate.increment[system.layout.of_coordinate(i)];
  }



  void
  GeneralisedAlpha::evaluate(const double h, const double evaluation_time, Iterate &iterate) const
  {
    // before a corner, what is prescribed has its value of before
    const double time  = iterate.state.time;
    iterate.state.time = evaluation_time;
    std::vector<double> stress;
    system.stresses(iterate.state, stress);
    system.residual(iterate.state, stress, iterate.residual);
    const std::vector<double> rates = rivals::constraint_rates(system, iterate.state);
    iterate.state.time              = time;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const unsigned int i = 6 * (node - 1);
        Eigen::Map<Vector6>(&iterate.residual[i]) +=
          system.model.nodes[node].inertia * Eigen::Map<const Vector6>(&iterate.y_dot[i]);
      }
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      {
        double &row = iterate.residual[system.layout.of_multiplier(i)];
        if (!is_active[i])
          row = 0;
        else if (is_nonholonomic[i])
          row = rates[i] * h * c.beta / c.gamma;
      }
  }



  void
  GeneralisedAlpha::factorize(const double h, const Iterate &iterate)
  {
    // in increments Δ: ẏ' changes by b Δ and y' by g Δ, so that M b + C g + K is the matrix; divided by b
    system.damping(iterate.state, C);
    system.tangent(iterate.state, K);
    const double b = (1 - c.alpha_m) / (h * h * c.beta * (1 - c.alpha_f)), g = c.gamma / (h * c.beta);
    const int    n = system.layout.of_multiplier(0);
    for (int j = 0; j < n; ++j)
      for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1]; ++k)
        if (K.pattern->rows[k] < n)
          K.values[k] = M.values[k] + (g * C.values[k] + K.values[k]) / b;
    solver->factorize(K);
    factored_step = h;
  }



  double
  GeneralisedAlpha::correct(const double h, Iterate &iterate) const
  {
    const Layout &layout = system.layout;
    const double  b = (1 - c.alpha_m) / (h * h * c.beta * (1 - c.alpha_f)), g = c.gamma / (h * c.beta);
    const int     n = layout.of_multiplier(0);

    std::vector<double> x(system.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = static_cast<int>(i) < n ? -iterate.residual[i] / b : -iterate.residual[i];
    solver->solve(x.data());

    // the next tangent uses the stress of the linearised motion (mixed Newton)
    State linear = iterate.state;
    system.update(linear, x);
    iterate.state.stress = linear.stress;

    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        Eigen::Map<Vector6> zeta(&x[6 * (node - 1)]);
        zeta = rivals::change_of_exponent(Eigen::Map<const Vector6>(&iterate.increment[6 * (node - 1)]), zeta);
      }
    std::vector<double> change(n), v = velocities(iterate.state);
    for (int i = 0; i < n; ++i)
      {
        iterate.increment[i] += x[i];
        iterate.a[i] += x[i] / (h * h * c.beta);
        iterate.y_dot[i] += b * x[i];
        change[i] = g * x[i];
        v[i] += change[i];
      }
    double largest_change = 0, largest = 0;
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      {
        const double change_of_multiplier = b * x[layout.of_multiplier(i)];
        iterate.state.multipliers[i] += change_of_multiplier;
        largest_change = std::max(largest_change, std::abs(change_of_multiplier));
        largest        = std::max(largest, std::abs(iterate.state.multipliers[i]));
      }
    State changes = iterate.state;
    set_velocities(changes, change);
    const double size = measure.largest(changes.y, changes.rates);
    if (std::isfinite(size))
      set_velocities(iterate.state, v);
    // forces across the constraints leave the velocities as they are: multipliers have to converge, too
    const double of_multipliers = largest > 0 ? std::sqrt(settings.newton_tolerance) * largest_change / largest : 0.;
    // velocities that turn or move by less than a thousandth in a step are too small to be a measure
    return std::max(size / std::max(1e-3 / h, measure.largest(iterate.state.y, iterate.state.rates)), of_multipliers);
  }



  StepResult
  GeneralisedAlpha::step(State &state, const double h)
  {
    if (is_pending)
      std::swap(now, next);
    is_pending        = false;
    const double tiny = 1e-6 * h, end = state.time + h;
    State        begin = state;
    begin.held         = false;
    // accelerations of another step or of before a corner: the recursion of a begins anew
    if (!(std::abs(now.h / h - 1) < 1e-6) || rivals::is_corner(system, state.time, tiny))
      start(begin, h);
    const double evaluation_time = rivals::is_corner(system, end, tiny) ? end - tiny : end;

    Iterate    iterate;
    StepResult result = find_end(begin, h, evaluation_time, iterate);
    if (!result.converged)
      {
        evaluate(h, evaluation_time, iterate);
        result.worst  = rivals::largest_of(iterate.residual, system.layout.of_multiplier(0));
        factored_step = 0;
        return result;
      }

    State after = iterate.state;
    system.stresses(after, after.stress);
    State left = after; // of the times that were used
    left.time  = evaluation_time;
    // the account is about the state given, with the multipliers at its time
    State given       = state;
    given.multipliers = begin.multipliers;
    rivals::account(system, given, left, result);
    after.accelerations.assign(6, 0.);
    after.accelerations.insert(after.accelerations.end(), iterate.y_dot.begin(), iterate.y_dot.end());
    next.h     = now.h;
    next.a     = iterate.a;
    next.y_dot = iterate.y_dot;
    is_pending = true;
    state      = after;
    ++n_steps;
    return result;
  }



  StepResult
  GeneralisedAlpha::find_end(const State &begin, const double h, const double evaluation_time, Iterate &iterate)
  {
    // corrections that shrink by less than this want new factors; those of another step, but for round-off, are not
    // used
    constexpr double    slow = 0.2;
    StepResult          result;
    rivals::Corrections corrections(factored_step > 0 && std::abs(factored_step / h - 1) < 1e-6,
                                    slow,
                                    settings.newton_tolerance);
    predict(begin, h, iterate);
    while (result.iterations < settings.max_iterations && !result.converged)
      {
        evaluate(h, evaluation_time, iterate);
        if (corrections.need_factors())
          {
            factorize(h, iterate);
            ++n_factorizations;
          }
        result.last_correction = correct(h, iterate);
        ++result.iterations;
        ++n_iterations;
        const auto verdict = corrections.judge(result.last_correction);
        if (verdict == rivals::Corrections::Verdict::diverged)
          break;
        if (verdict == rivals::Corrections::Verdict::again)
          predict(begin, h, iterate);
        else
          configure(begin, iterate);
        result.converged = verdict == rivals::Corrections::Verdict::converged;
      }
    return result;
  }
} // namespace samara
