#include <samara/base/errors.h>
#include <samara/solvers/newton.h>
#include <samara/time/algebraic_states.h>
#include <samara/time/stage_integrator.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    /** Part of the largest force by which it may change in the last correction, and how fast such changes must shrink
     * for the factors to be kept: where nothing moves, forces alone show that factors are old. */
    constexpr double change_of_force_that_counts = 1e-3, slow_change_of_force = 0.3;

    /** Where forces begin and end at once nothing goes on smoothly; extrapolation would only amplify round-off. */
    bool
    has_impacts(const Layout &layout)
    {
      return !layout.stops.empty() || !layout.frictions.empty() || !layout.contact_groups.empty();
    }



    /** Whether a law of the state switches by comparisons or the like. */
    bool
    has_switches(const System &system)
    {
      const State         state = system.reference();
      std::vector<double> pieces;
      system.pieces(state.point(), pieces);
      return !pieces.empty();
    }



    /** renormalised() of the triads of all nodes, four at once. */
    void
    renormalise(std::vector<double> &q)
    {
      using Lane                 = FourNodes::Lane;
      const unsigned int n_nodes = q.size() / 12;
      for (unsigned int first = 1; first < n_nodes; first += 4)
        {
          const FourNodes nodes(first, n_nodes);
          Lane            values[12], result[9];
          nodes.load(12, q, values);
          const Lane *const D = values + 3;
          // D (3/2 I − 1/2 DᵀD)
          Lane S[3][3];
          for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j)
              S[i][j] = S[j][i] =
                Lane(i == j ? 1.5 : 0.) -
                Lane(0.5) * (D[3 * i] * D[3 * j] + D[3 * i + 1] * D[3 * j + 1] + D[3 * i + 2] * D[3 * j + 2]);
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i)
              result[3 * j + i] = D[i] * S[0][j] + D[3 + i] * S[1][j] + D[6 + i] * S[2][j];
          std::copy_n(result, 9, values + 3);
          nodes.store(12, values, q);
        }
    }



    /**
     * The stop of a distance that nothing touches in the step, but that would be touched if the points flew straight,
     * with the distance and its rate at the start and the distance at the end; null if there is none. Of balls d² =
     * d_i² + 2 d_i ḋ_i t + v² t².
     */
    const Layout::Stop *
    passed_unseen(const System                   &system,
                  const State                    &start,
                  const std::vector<double>      &end,
                  const std::vector<TouchedStop> &touched,
                  const double                    h)
    {
      constexpr double part    = 0.9; // less is the chord of a path that is bent
      const auto      &lengths = system.model.lengths;
      for (const Layout::Stop &stop : system.layout.stops)
        {
          const auto found = lengths.find(stop.coordinate);
          if (found == lengths.end() || stop.side > 0)
            continue;
          const double least = found->second + stop.place, from = found->second + start.coordinates[stop.coordinate],
                       to  = found->second + end[stop.coordinate];
          const auto is_it = [&](const TouchedStop &t) { return &system.layout.stops[t.stop] == &stop; };
          if (from <= least || to <= least || std::any_of(touched.begin(), touched.end(), is_it))
            continue;
          const double slope  = 2 * from * start.rates[stop.coordinate],
                       square = (to * to - from * from - slope * h) / (h * h);
          if (slope < 0 && square > 0 && -slope < 2 * square * h &&
              from * from - 0.25 * slope * slope / square < part * part * least * least)
            return &stop;
        }
      return nullptr;
    }
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
    , velocity_history(tableau.s)
    , rate_history(tableau.s)
    , stress_history(tableau.s)
    , multiplier_history(tableau.s)
    , real_matrix(system.layout.pattern)
    , final_weights(tableau.w.transpose() * tableau.b)
    , mode_weights(tableau.w.transpose() * tableau.b.cwiseProduct(tableau.p))
    , no_multipliers(system.layout.n_multipliers, 0.)
    , contacts(system, this->tableau)
    , air(system)
    , counted(counted_states(system.model))
    , switches(has_switches(system))
  {
    const Layout      &layout = system.layout;
    const unsigned int n      = system.size();
    make_factors();
    make_inertias();
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
    n_steps_anew = n_steps_to_go_anew = 0;
    forget_stages();
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
    Assert(std::isfinite(h), dealii::ExcMessage("The length of a step is a number."));
    StepResult result;
    start_step(state, h);
    const bool converged = find_stages(state, h, result);
    n_iterations += result.iterations;
    judge_factors(result.iterations);
    // nothing moves where a body is held in its place: velocities do not tell whether the force there converges
    if (change_of_force > change_of_force_that_counts &&
        change_of_force > slow_change_of_force * previous_change_of_force)
      factored_step = 0;
    if (!converged || !accept_stages(state, h, result))
      {
        forget_history();
        return result;
      }
    result.converged = true;
    if (wants_estimates)
      estimate_error(state, h, result.difference);
    remember(state, h);
    finish(state, h);
    result.energy = energy_at_end = system.energy(state, e_end);
    y_at_end                      = state.y;
    ++n_steps;
    return result;
  }



  void
  StageIntegrator::start_step(State &state, const double h)
  {
    state.held = false;
    choose_rows(state);
    // where the last step ended, strains are known
    const bool goes_on = !e_end.empty() && state.q == final_q && state.coordinates == final_coordinates;
    if (goes_on)
      std::swap(e_start, e_end);
    else
      system.strains(state, e_start);
    e_end.clear();
    const auto energy = goes_on && state.y == y_at_end ? energy_at_end : system.energy(state, e_start);
    energy_scale      = energy.kinetic + energy.strain;
    if (first_strain < 0)
      first_strain = energy.strain;
    moved_energy = std::max({moved_energy, energy.kinetic, std::abs(energy.strain - first_strain)});
    start_rotation(state, h);
    start_stops(state);
    start_springs(state);
    if (!contacts.is_empty())
      contacts.start(state, h);
    predict(state, h);
  }



  void
  StageIntegrator::start_rotation(const State &state, const double h)
  {
    // what is less than the iteration leaves open is not worth its cost; what does not turn at all stays as it is
    constexpr double part_of_tolerance = 1e-3;
    turns                              = StageRotation::counts(tableau.s, h, state.y, part_of_tolerance * tolerance);
    if (turns && !rotation)
      rotation = std::make_unique<StageRotation>(system, state);
    for (Stage &stage : stages)
      {
        stage.reciprocal.resize(turns ? state.q.size() : 0);
        stage.nearest.resize(turns && !air.is_empty() ? state.q.size() : 0);
        stage.momenta.resize(turns ? state.y.size() : 0);
      }
  }



  bool
  StageIntegrator::accept_stages(const State &state, const double h, StepResult &result)
  {
    if (!contacts.is_empty() && !accept_contacts(result))
      return false;
    account(state, h, result);
    if (!has_sources(result, h))
      return false;
    for (const Stage &stage : stages)
      if (const int i = system.model.negative_length(stage.coordinates); i >= 0)
        {
          result.worst = system.layout.of_coordinate(i);
          return false;
        }
    if (const auto *const stop = passed_unseen(system, state, final_coordinates, result.touched_stops, h))
      {
        result.refusal = stop->name + ": the two pass each other between two stages of the step";
        return false;
      }
    check_rows_left_out(state);
    return true;
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
    multiplier_history.forget();
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
        if (offset == 1 && is_step(previous_step, h) && !has_impacts(system.layout))
          {
            velocity_history.extrapolate(k, stage.y);
            rate_history.extrapolate(k, stage.rates);
            stress_history.extrapolate(k, stage.stress);
            multiplier_history.extrapolate(k, stage.multipliers);
          }
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
    remember_stages(state, h);
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
  StageIntegrator::remember_stages(const State &state, const double h)
  {
    if (has_impacts(system.layout))
      return;
    if (offset != 1 || !is_step(previous_step, h))
      forget_stages();
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        extrapolated = state.y;
        x_rates      = state.rates;
        if (previous_step > 0 && extrapolates && !velocity_history.pauses())
          extrapolate(offset + tableau.c(k) * h / previous_step, extrapolated, x_rates, x_states);
        const Stage &stage = stages[k];
        velocity_history.remember(k, stage.y, extrapolated);
        rate_history.remember(k, stage.rates, x_rates);
        stress_history.remember(k, stage.stress, state.stress);
        multiplier_history.remember(k, stage.multipliers, state.multipliers);
      }
  }



  void
  StageIntegrator::forget_stages()
  {
    for (auto *const history : {&velocity_history, &rate_history, &stress_history, &multiplier_history})
      history->forget();
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
    for (const unsigned int i : algebraic_states(system.model))
      {
        const Eigen::VectorXd weights = values_at_end(tableau);
        state.states[i]               = 0;
        for (unsigned int k = 0; k < s; ++k)
          state.states[i] += weights(k) * stages[k].states[i];
      }
    renormalise(final_q); // against round-off only
    state.q           = final_q;
    state.coordinates = final_coordinates;
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      {
        state.multipliers[i] = 0;
        for (unsigned int k = 0; k < s; ++k)
          state.multipliers[i] += tableau.b(k) * stages[k].multipliers[i];
      }
    state.time += h;
    if (!contacts.is_empty())
      contacts.finish(state);
    system.strains(state, e_end);
    system.stresses(state, e_end, state.stress);
  }
} // namespace samara
