#include <samara/base/errors.h>
#include <samara/solvers/newton.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    constexpr unsigned int max_factorizations_per_step = 4;

    /** Where corrections shrink by less than the first it is looked at what they leave; by more than the second may be
     * an accident. */
    constexpr double sure_rate = 0.3, least_rate = 0.01;
    /** Of the tolerance; a step turns out to miss up to four times what its residuals tell (tests/trials). */
    constexpr double share_of_energy = 0.2;

    /** What a factorisation with its matrices costs, in iterations. */
    constexpr double iterations_of_a_factorization = 4;

    /**
     * @name Newton's policy
     * Corrections are of velocities, relative to the largest; rates are from one correction to the next.
     * @{
     */
    /** Rates above which an attempt is given up: with factors of earlier steps, which new ones soon pay for; with new
     * ones, of which a better configuration may be found; and with the last, where whatever converges is welcome. */
    constexpr double slow_with_old_factors = 0.3, slow_with_new_factors = 0.5, slow_with_last_factors = 0.95;

    /** Corrections after which the stages are near enough for the next factors to begin with them; so near that other
     * factors would be the same; and so large that the start was wrong. */
    constexpr double near = 0.1, as_near_as_can_be = 0.01, far = 10, lost = 1e3;

    /** Of a rate that is not known yet, and at most: the sum of all corrections to come is last · rate/(1 − rate). */
    constexpr double first_rate = 0.5, largest_rate = 0.9;

    /** A correction that is no smaller than this part of the smallest does not count as progress. */
    constexpr double progress = 0.8;

    /** Corrections below which three without progress are round-off, and below which it does not matter that they
     * shrink slowly. */
    constexpr double size_of_round_off = 1e-9, size_of_slowness = 1e-8;

    /** Iterations that a slow attempt may still need: about what another factorisation costs. */
    constexpr double most_iterations_to_come = iterations_of_a_factorization;

    /** Part of the largest force by which it may change in the last correction, and how fast such changes must shrink
     * for the factors to be kept: where nothing moves, forces alone show that factors are old. */
    constexpr double change_of_force_that_counts = 1e-3, slow_change_of_force = slow_with_old_factors;
    /** @} */
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
    , C(system.layout.pattern)
    , K(system.layout.pattern)
    , gap_scale(system.layout.n_multipliers, 1.)
    , is_nonholonomic(system.layout.n_multipliers, false)
    , is_active(system.layout.n_multipliers, true)
    , real_matrix(system.layout.pattern)
    , final_weights(tableau.w.transpose() * tableau.b)
    , mode_weights(tableau.w.transpose() * tableau.b.cwiseProduct(tableau.p))
    , no_multipliers(system.layout.n_multipliers, 0.)
    , contacts(system, this->tableau)
  {
    const Layout      &layout = system.layout;
    const unsigned int n      = system.size();
    make_factors();
    const int n_kinematic = layout.of_multiplier(0);
    for (int j = 0; j < layout.pattern->size(); ++j)
      for (int k = layout.pattern->column_start[j]; k < layout.pattern->column_start[j + 1]; ++k)
        is_constraint_entry.push_back(j >= n_kinematic || layout.pattern->rows[k] >= n_kinematic);
    for (const auto i : layout.nonholonomic)
      is_nonholonomic[i] = true;
    for (const auto i : system.released_multipliers())
      is_active[i] = false;
    frozen_strains = system.linear_strains();

    x.resize(n);
    x_real.resize(n);
    x_rates.resize(layout.n_coordinates);
    x_states.resize(layout.n_states);
    e.resize(layout.n_strains);
    mean_rates.resize(layout.n_multipliers);
    twists.assign(6 * layout.n_nodes, 0.);
    for (auto *const increments : {&dz, &dz_rate})
      increments->assign(tableau.s, std::vector<double>(layout.of_multiplier(0)));
    d_lambda.assign(tableau.s, std::vector<double>(layout.n_multipliers));
    extrapolated.resize(6 * layout.n_nodes);
    for (auto *const strains : {&strain_increment, &rate_increment, &stress_increment})
      strains->assign(layout.n_strains, 0.);
    previous.assign(tableau.s + 1, std::vector<double>(6 * layout.n_nodes + layout.n_coordinates + layout.n_states));
  }



  void
  StageIntegrator::forget_history()
  {
    previous_step = 0;
    factored_step = 0;
    offset        = 1;
    first_strain  = -1;
    moved_energy  = 0;
    if (redundant)
      redundant->forget();
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
    choose_rows(state);
    // where the last step ended, strains are known
    if (!e_end.empty() && state.q == final_q && state.coordinates == final_coordinates)
      std::swap(e_start, e_end);
    else
      system.strains(state, e_start);
    e_end.clear();
    const auto energy = system.energy(state, e_start);
    energy_scale      = energy.kinetic + energy.strain;
    if (first_strain < 0)
      first_strain = energy.strain;
    moved_energy = std::max({moved_energy, energy.kinetic, std::abs(energy.strain - first_strain)});
    start_stops(state);
    start_springs(state);
    if (!contacts.is_empty())
      contacts.start(state, h);
    predict(state, h);
    bool converged = false;
    if (has_many_contacts() || n_exact_for_contacts > 0)
      {
        n_exact_for_contacts -= n_exact_for_contacts > 0;
        converged = iterate_exactly(state, h, false, result);
        if (!converged)
          predict(state, h);
      }
    if (!converged && is_step(factored_step, h))
      {
        converged = iterate(state, h, slow_with_old_factors, result);
        if (!converged && !(result.last_correction < near))
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
        const bool is_last =
          i + 1 == max_factorizations_per_step || (i > 0 && result.last_correction < as_near_as_can_be);
        converged = iterate(state, h, is_last ? slow_with_last_factors : slow_with_new_factors, result);
        if (!converged && (is_last || !(result.last_correction < far)))
          {
            if (previous_step == 0)
              break;
            previous_step = 0; // perhaps the extrapolated start was not good
            predict(state, h);
            i = 0;
          }
      }
    if (!converged)
      {
        // where contacts in groups stick and slip, steps to come will need that, too
        constexpr unsigned int as_many_more = 20;
        const bool             touches      = !contacts.touched().empty();
        if (touches)
          predict(state, h);
        converged = iterate_exactly(state, h, !touches, result);
        if (converged && touches)
          n_exact_for_contacts = as_many_more;
      }
    n_iterations += result.iterations;
    judge_factors(result.iterations);
    // nothing moves where a body is held in its place: velocities do not tell whether the force there converges
    if (change_of_force > change_of_force_that_counts &&
        change_of_force > slow_change_of_force * previous_change_of_force)
      factored_step = 0;
    if (converged && !contacts.is_empty())
      converged = accept_contacts(result);
    if (converged)
      {
        account(state, h, result);
        converged = has_sources(result, h);
      }
    if (converged)
      for (const Stage &stage : stages)
        if (const int i = system.model.negative_length(stage.coordinates); i >= 0)
          {
            converged    = false;
            result.worst = system.layout.of_coordinate(i);
          }
    if (converged)
      check_rows_left_out(state);
    if (!converged)
      {
        forget_history();
        return result;
      }
    result.converged = true;
    if (wants_estimates)
      estimate_error(state, h, result.difference);
    remember(state, h);
    finish(state, h);
    result.energy = system.energy(state, e_end);
    ++n_steps;
    return result;
  }



  void
  StageIntegrator::choose_rows(State &state)
  {
    if (!state.left_out.empty())
      {
        if (!redundant)
          redundant = std::make_unique<RedundantRows>(system);
        redundant->choose(state);
      }
    if (state.left_out == left_out)
      return;
    for (const auto i : left_out)
      is_active[i] = true;
    for (const auto i : state.left_out)
      is_active[i] = false;
    left_out = state.left_out;
    make_factors();
  }



  void
  StageIntegrator::check_rows_left_out(const State &state)
  {
    if (left_out.empty())
      return;
    const auto gaps = redundant->gaps(state, constraints_at_end);
    if (gaps.left_out > largest_gap_left_out)
      {
        largest_gap_left_out = gaps.left_out;
        worst_left_out       = gaps.worst;
      }
    if (redundant->are_explained(gaps))
      return;
    if (const std::string objection = redundant->objection(at_end(state, state.time), gaps); !objection.empty())
      {
        std::ostringstream text;
        text << "t = " << state.time << " s: " << objection;
        throw NotConverged(text.str());
      }
  }



  State
  StageIntegrator::at_end(const State &state, const double time) const
  {
    State end       = state;
    end.q           = final_q;
    end.coordinates = final_coordinates;
    end.time        = time;
    return end;
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
    const bool   is_fresh = is_exact || n_steps_with_factors == 0;
    const bool   may_skip = can_predict();
    double       last = 0, last_rate = 0, worse_rate = 0, work_left = 0, rate_of_work = 1, smallest = 1e300;
    unsigned int n_stagnant = 0;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        move_stages(state, h);
        // what is left shrinks as it did, and as corrections do: an evaluation would only say so
        if (const double rate = std::max({worse_rate, rate_of_work, least_rate});
            may_skip && rate < sure_rate && last * rate / (1 - rate) < tolerance &&
            work_left * rate < share_of_energy * tolerance * energy_that_counts() && confirm_without_forces(state, h))
          return true;
        evaluate(state, h);
        ++n_evaluations;
        // linear convergence: what is still missing is about last · rate/(1 − rate); at round-off it no longer shrinks
        if (iteration > 0)
          {
            const double rate         = std::min(iteration > 1 ? last_rate : first_rate, largest_rate);
            const auto [error, bound] = energy_error(h);
            const double scale        = std::max(energy_scale, kinetic_energy);
            if (last * rate / (1 - rate) < tolerance && error < share_of_energy * tolerance * energy_that_counts() &&
                largest_gap(h) < allowed_gap())
              return true;
            rate_of_work = work_left > 0 ? bound / work_left : 1.;
            work_left    = bound;
            // What is left may be more than what was before, if factors are old: then it grows, slowly, from round-off.
            // Small corrections alone say little: near singular positions, reactions go astray while nothing moves.
            if (n_stagnant > 2 && last < size_of_round_off)
              {
                const double work = is_fresh ? 1e-10 : 1e-12, gap = is_fresh ? 1e-9 : 1e-12;
                return error < work * scale + energy_of_moving(1e-8 * length / h) && largest_gap(h) < gap * length;
              }
          }
        const double size = is_exact ? solve_exactly(h) : solve(h);
        ++result.iterations;
        result.last_correction = size;
        if (!std::isfinite(size))
          find_infinite(result);
        if (!std::isfinite(size) || size > lost)
          return false;
        correct_stresses();
        // the worse of two rates, as they may alternate
        const double this_rate = last > 0 ? size / last : 0;
        const double rate      = std::max(this_rate, last_rate);
        worse_rate             = rate;
        last_rate              = iteration > 0 ? this_rate : 0;
        if (size > size_of_round_off)
          smallest = std::max(smallest, size); // a first correction may be none by accident
        n_stagnant = size < progress * smallest ? 0 : n_stagnant + 1;
        smallest   = std::min(smallest, size);
        last       = size;
        if (iteration > 1 && rate > slow && size > size_of_slowness)
          {
            // too slow with this factorisation, unless little is missing
            if (std::log(tolerance / size) / std::log(std::min(rate, 0.99)) > most_iterations_to_come)
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



  void
  StageIntegrator::extrapolate(const double         at,
                               std::vector<double> &y,
                               std::vector<double> &rates,
                               std::vector<double> &states) const
  {
    // the polynomial through the start and the stages of the last step
    std::fill(y.begin(), y.end(), 0.);
    std::fill(rates.begin(), rates.end(), 0.);
    std::fill(states.begin(), states.end(), 0.);
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
        for (unsigned int i = 0; i < states.size(); ++i)
          states[i] += L * previous[j][n_y + rates.size() + i];
      }
  }



  void
  StageIntegrator::predict(const State &state, const double h)
  {
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage      = stages[k];
        stage.time        = state.time + tableau.c(k) * h;
        stage.multipliers = state.multipliers;
        stage.stress      = state.stress;
        stage.y           = state.y;
        stage.rates       = state.rates;
        stage.states      = state.states;
        if (previous_step > 0 && extrapolates)
          extrapolate(offset + tableau.c(k) * h / previous_step, stage.y, stage.rates, stage.states);
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
        extrapolate(offset + tableau.c(tableau.s - 1) * h / previous_step, extrapolated, x_rates, x_states);
        for (unsigned int i = 0; i < n_y; ++i)
          {
            error += std::pow(extrapolated[i] - last.y[i], 2);
            change += std::pow(state.y[i] - last.y[i], 2);
          }
        extrapolates = error < change;
      }
    else
      extrapolates = true;
    for (unsigned int j = 0; j <= tableau.s; ++j)
      {
        const auto &y     = j == 0 ? state.y : stages[j - 1].y;
        const auto &rates = j == 0 ? state.rates : stages[j - 1].rates;
        const auto &z     = j == 0 ? state.states : stages[j - 1].states;
        auto        to    = std::copy(y.begin(), y.end(), previous[j].begin());
        to                = std::copy(rates.begin(), rates.end(), to);
        std::copy(z.begin(), z.end(), to);
      }
    previous_step = h;
    offset        = 1;
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
    advance(state.states, &Stage::states);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Eigen::Map<Matrix3> D(&final_q[12 * node + 3]);
        D = renormalised(D); // against round-off only
      }
    state.q           = final_q;
    state.coordinates = final_coordinates;
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      {
        state.multipliers[i] = 0;
        for (unsigned int k = 0; k < s; ++k)
          state.multipliers[i] += tableau.b(k) * stages[k].multipliers[i];
      }
    state.time += h;
    system.strains(state, e_end);
    system.stresses(state, e_end, state.stress);
  }
} // namespace samara
