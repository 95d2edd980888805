#include <samara/base/astray.h>
#include <samara/base/text.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/time/stepper.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  Stepper::Stepper(const System &system, Integrator &integrator, const double step, const double smallest_step)
    : next_step(step)
    , system(system)
    , integrator(integrator)
    , fixed_step(step)
    , smallest_step(smallest_step)
  {
    for (const auto &item : system.model.items)
      if (const auto *const bent = dynamic_cast<const HasBends *>(item.get()))
        {
          const auto of_item = bent->bends();
          bends.insert(bends.end(), of_item.begin(), of_item.end());
        }
    find_exits();
  }



  Stepper::Stepper(const System                   &system,
                   Integrator                     &integrator,
                   const double                    step,
                   const StepController::Settings &settings)
    : Stepper(system, integrator, step, settings.smallest_step)
  {
    if (integrator.family() == nullptr)
      throw InputError(
        "steps are adapted by what neighbours in the integrator family would have done; other integrators have none");
    controller.emplace(*integrator.family(), settings);
    error.emplace(system, *integrator.family());
    integrator.wants_estimates = true;
  }



  Stepper::Memory
  Stepper::memory() const
  {
    const std::vector<double> window = {steps.start,
                                        double(steps.n),
                                        across,
                                        switches.start,
                                        double(switches.n),
                                        too_long.length,
                                        double(too_long.pause),
                                        double(too_long.left)};
    if (!controller)
      return {next_step, {}, {}, steady_twists, window};
    return {next_step, controller->memory(), error->memory(), steady_twists, window};
  }



  void
  Stepper::set_memory(const Memory &memory, const bool with_steps)
  {
    steady_twists = memory.steady_twists;
    if (with_steps)
      {
        next_step = memory.next_step;
        steps     = {memory.window.at(0), static_cast<unsigned int>(memory.window.at(1))};
        across    = memory.window.at(2);
        switches  = {memory.window.at(3), static_cast<unsigned int>(memory.window.at(4))};
        too_long  = {memory.window.at(5),
                     static_cast<unsigned int>(memory.window.at(6)),
                     static_cast<unsigned int>(memory.window.at(7))};
      }
    if (!controller || memory.of_controller.empty())
      return;
    if (with_steps)
      {
        controller->set_memory(memory.of_controller);
        error->set_memory(memory.of_error);
      }
    else
      controller->update(memory.of_controller[0], memory.of_controller[1]);
  }



  double
  Stepper::corner(const double from, const double to) const
  {
    return std::min(to, system.next_corner(from, to));
  }



  double
  Stepper::energy_of_change(const State &state) const
  {
    State relative = state;
    for (unsigned int i = 0; i < relative.y.size(); ++i)
      relative.y[i] -= steady_twists[i];
    const auto energy = system.energy(relative);
    return energy.kinetic + energy.strain;
  }



  std::string
  Stepper::about_reactions(const State &state) const
  {
    // of each joint the largest; joints with less than a thousandth of the largest of all are not worth a word
    std::vector<std::pair<double, unsigned int>> reactions;
    for (unsigned int i = 0; i < state.multipliers.size(); ++i)
      {
        const double size  = std::abs(state.multipliers[i]);
        const Item  &owner = system.layout.owner_of_multiplier(i);
        const auto   same  = std::find_if(reactions.begin(), reactions.end(), [&](const auto &r) {
          return &system.layout.owner_of_multiplier(r.second) == &owner;
        });
        if (same == reactions.end())
          reactions.emplace_back(size, i);
        else if (size > same->first)
          *same = {size, i};
      }
    std::sort(reactions.rbegin(), reactions.rend());
    std::ostringstream text;
    for (unsigned int k = 0; k < std::min<std::size_t>(reactions.size(), 4) && reactions[k].first > 0; ++k)
      {
        const auto &[owner, row] = system.layout.rows_of_multipliers[reactions[k].second];
        if (reactions[k].first < 1e-3 * reactions[0].first)
          break;
        if (k == 0)
          text << "; the largest reaction, " << reactions[k].first << " N or N m, is at " << owner->title()
               << (row.empty() ? "" : " (" + row + ")");
        else
          text << (k == 1 ? ", then at " : ", ") << owner->title();
      }
    if (!system.model.prescribed.empty())
      text
        << ".\n  Does a prescribed motion pull beyond a dead centre, or beyond what a loop or a stop allows? There no "
           "motion goes on";
    return text.str();
  }



  unsigned int
  Stepper::Count::add(const double time, const double window)
  {
    if (n == 0 || time - start >= window || time < start)
      {
        start = time;
        n     = 0;
      }
    return ++n;
  }



  void
  Stepper::require_progress(const State &before)
  {
    // some halvings are no reason to give up; 2000 steps that together are less than a tenth of the given one are
    constexpr unsigned int most_in_window = 2000;
    constexpr double       window         = 0.1;
    if (steps.add(before.time, window * fixed_step) <= most_in_window)
      return;
    std::ostringstream text;
    text << "t = " << before.time << " s: " << most_in_window << " steps together have not come as far as " << window
         << " times a step of " << fixed_step << " s" << about_reactions(before);
    throw NotConverged(text.str());
  }



  bool
  Stepper::has_solution(const State &state, const double h, Advance &result)
  {
    trial       = state;
    result.step = {};
    try
      {
        result.step = integrator.step(trial, h);
      }
    catch (const SingularMatrix &)
      {
        // gone astray: no solution
      }
    catch (const Astray &why)
      {
        result.step.refusal = why.what();
      }
    // a root that no motion has; see Model::lengths
    if (const int i = system.model.negative_length(trial.coordinates); i >= 0 && result.step.converged)
      {
        integrator.step_back();
        result.step.converged = false;
        result.step.worst     = system.layout.of_coordinate(i);
      }
    return result.step.converged;
  }



  bool
  Stepper::attempt(const State &state, double &h, Advance &result)
  {
    if (has_solution(state, h, result))
      return true;
    ++result.n_failed;
    const auto is_short = [&](const unsigned int unknown) {
      const auto found = system.model.lengths.find(unknown - system.layout.of_coordinate(0));
      return found != system.model.lengths.end() &&
             state.coordinates[found->first] + found->second < 1e-3 * found->second;
    };
    if (h / 2 < smallest_step)
      {
        std::ostringstream text;
        if (!result.step.refusal.empty())
          {
            text << "t = " << state.time << " s: the smallest step, " << h
                 << " s, is not accepted: " << result.step.refusal;
            throw NotConverged(text.str());
          }
        text << "t = " << state.time << " s: Newton's method does not converge with the smallest step, " << h << " s; "
             << (!result.step.is_finite ?
                   "what acts is not a finite number, as of a law beyond where it is defined, at " :
                 is_short(result.step.worst) ?
                   "where two points meet a force along their line has no direction: look at the length of " :
                   "the largest force left is at ")
             << system.layout.name_of(result.step.worst) << about_reactions(state);
        throw NotConverged(text.str());
      }
    if (!controller)
      too_long.failed(h);
    h = controller ? controller->after_failure(h) : h / 2;
    return false;
  }



  void
  Stepper::TooLong::failed(const double h)
  {
    constexpr unsigned int longest_pause = 256;
    const bool             is_again      = h > 0.99 * length && length > 0;
    pause                                = is_again ? std::min(2 * pause, longest_pause) : 1;
    length                               = h;
    left                                 = pause;
  }



  bool
  Stepper::TooLong::may_try(const double h)
  {
    if (length == 0 || h < 0.99 * length || left == 0)
      return true;
    --left;
    return false;
  }



  void
  Stepper::TooLong::succeeded(const double h)
  {
    if (length > 0 && h > 0.99 * length)
      *this = {};
  }



  void
  Stepper::count_switch(const double time)
  {
    constexpr unsigned int most = 200;
    if (switches.add(time, fixed_step) > most)
      throw NotConverged("t = " + number_to_text(time) + " s: laws of the state have switched " + std::to_string(most) +
                         " times within " + number_to_text(fixed_step) +
                         " s: the motion slides along a switch. Give it a smooth law there, tanh(x/width) for sign(x)");
  }



  void
  Stepper::stop_before_switch(const State &state, double &h, Advance &result)
  {
    constexpr double resolution = 1e-6; // of a step
    system.pieces(state.point(), pieces);
    if (pieces.empty())
      return;
    const auto has_switched = [&]() {
      system.pieces(trial.point(), pieces_after);
      return pieces_after != pieces;
    };
    if (!has_switched())
      return;
    count_switch(state.time);
    // bisection; from the first time on that is not beyond the switch, steps have a solution
    const auto step_of = [&](const double size) {
      integrator.step_back();
      return has_solution(state, size, result);
    };
    double before = 0, after = h;
    while (after - before > resolution * h)
      {
        const double middle                                   = 0.5 * (before + after);
        (step_of(middle) && !has_switched() ? before : after) = middle;
      }
    across = 2 * resolution * h;
    h      = before > 0 ? before : after;
    if (before == 0)
      across = 0; // it is across now
    if (!step_of(h))
      throw NotConverged("t = " + number_to_text(state.time) + " s: no solution before a law switches");
  }



  double
  Stepper::part_until(const Bend &bend, const double from, const double to)
  {
    if (to < from) // the same, seen from the other side
      return part_until({bend.coordinate, -bend.to, -bend.from}, -from, -to);
    // a step may end anywhere in front of the bend, inside of it, or within a margin behind it
    const double margin = 0.01 * (bend.to - bend.from);
    double       place = bend.from - 0.5 * margin, limit = bend.from;
    if (from >= bend.to || to <= limit)
      return 1;
    if (from >= bend.from - margin)
      {
        place = bend.to + 0.5 * margin;
        limit = bend.to + margin;
      }
    return to <= limit ? 1. : (place - from) / (to - from);
  }



  double
  Stepper::part_until_bends(const std::vector<double> &from, const std::vector<double> &to) const
  {
    double part = 1;
    for (const Bend &bend : bends)
      part = std::min(part, part_until(bend, from[bend.coordinate], to[bend.coordinate]));
    return part;
  }



  void
  Stepper::stop_at_bends(const State &state, double &h, Advance &result)
  {
    constexpr unsigned int most = 12;
    const double           full = h;
    for (unsigned int i = 0; i < most; ++i)
      {
        const double part = part_until_bends(state.coordinates, trial.coordinates);
        if (part == 1)
          return;
        h *= part;
        if (h < smallest_step)
          break;
        integrator.step_back();
        if (!has_solution(state, h, result))
          break;
      }
    if (part_until_bends(state.coordinates, trial.coordinates) == 1 && result.step.converged)
      return;
    h = full;
    integrator.step_back();
    if (!has_solution(state, h, result))
      throw NotConverged("t = " + number_to_text(state.time) +
                         " s: no solution where something slides across an end of an element");
  }



  void
  Stepper::start_control(const State &state)
  {
    if (!steady_twists.empty())
      return;
    trial = state;
    system.update_twists(trial);
    steady_twists = trial.y;
    // the least energy that matters: else round-off of a steady rotation would be resolved
    if (controller)
      controller->update(std::max(energy_of_change(state), 1e-10 * system.energy(state).kinetic), 0);
  }



  double
  Stepper::limit_of_step(const double time, const double end) const
  {
    const double ahead = time + 3 * next_step; // what is beyond does not change this step
    if (ahead >= end)
      return corner(time, end);
    const double place = corner(time, ahead);
    return place < ahead ? place : end;
  }



  double
  Stepper::part_before_bends(const State &state, const double h)
  {
    if (bends.empty())
      return h;
    trial.coordinates = state.coordinates;
    for (unsigned int i = 0; i < trial.coordinates.size(); ++i)
      trial.coordinates[i] += h * state.rates[i];
    const double part = part_until_bends(state.coordinates, trial.coordinates);
    return h * part > smallest_step ? h * part : h;
  }



  bool
  Stepper::is_accepted(const double tried, double &h, Advance &result)
  {
    if (!controller)
      {
        too_long.succeeded(h);
        // back to the given step, by doubling, unless this one was cut short
        if (result.n_failed == 0 && h > 0.99 * next_step)
          if (const double longer = std::min(fixed_step, 2 * next_step); too_long.may_try(longer))
            next_step = longer;
        return true;
      }
    controller->update(energy_of_change(trial), error->largest_displacement(trial));
    estimate = error->of_step(trial, result.step.difference, h, controller->duration()) +
               error->shift(trial,
                            result.step.difference,
                            integrator.family()->alpha * result.step.indicator,
                            controller->E_ref,
                            controller->remaining(trial.time));
    estimate = std::max(estimate, controller->size * error->of_states.of_step(trial, result.step.difference.states, h));
    const auto decision =
      controller->decide({estimate, result.step.indicator, result.step.work_defect, result.step.iterations}, h);
    if (!decision.accept)
      {
        ++result.n_rejected;
        integrator.step_back();
        h = next_step = decision.next_h;
        return false;
      }
    error->accept();
    // a step that was cut short says little of the next one
    next_step = h < tried || tried < 0.5 * next_step ? std::max(next_step, decision.next_h) : decision.next_h;
    return true;
  }



  Advance
  Stepper::advance(State &state, const double end)
  {
    Assert(end > state.time, dealii::ExcMessage("A step goes forward in time."));
    Advance result;
    start_control(state);
    double       h     = next_step;
    const double limit = limit_of_step(state.time, end);
    const bool   cut   = state.time + h * (1 + 1e-6) >= limit;
    if (cut)
      h = limit - state.time;
    else if (controller && state.time + 2 * h > limit)
      h = 0.5 * (limit - state.time); // two equal ones rather than a long and a short one
    const bool is_across = across > 0 && across < h;
    if (is_across)
      h = across;
    across = 0;
    h      = part_before_bends(state, h);

    for (bool is_done = false; !is_done;)
      {
        const double tried = h;
        if (!attempt(state, h, result))
          {
            next_step = h;
            continue;
          }
        if (is_across)
          break; // so short that it says nothing
        across = 0;
        if (!bends.empty())
          stop_at_bends(state, h, result);
        if (!exits.empty() && !stop_at_exits(state, h, result))
          continue;
        stop_before_switch(state, h, result);
        is_done = is_accepted(tried, h, result);
      }

    if (!controller)
      require_progress(state);
    result.h = h;
    if (cut && h == limit - state.time)
      trial.time = limit; // without round-off
    if (!exits.empty())
      let_go(going, trial, result);
    std::swap(state, trial);
    return result;
  }
} // namespace samara
