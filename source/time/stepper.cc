#include <samara/base/errors.h>
#include <samara/solvers/linear.h>
#include <samara/time/stepper.h>

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
  {}



  Stepper::Stepper(const System                   &system,
                   Integrator                     &integrator,
                   const double                    step,
                   const StepController::Settings &settings)
    : Stepper(system, integrator, step, settings.smallest_step)
  {
    if (integrator.family() == nullptr)
      throw InputError(
        "steps are adapted by the energy that the integrator family dissipates; other integrators have none");
    controller.emplace(*integrator.family(), settings);
    integrator.wants_indicator = true;
  }



  double
  Stepper::corner(const double from, const double to) const
  {
    double first = to;
    for (const auto &c : system.model.contributions)
      first = std::min(first, c->next_corner(from, to));
    return first;
  }



  void
  Stepper::switch_values(const State &state, std::vector<double> &values) const
  {
    values.resize(system.layout.n_switches);
    for (const auto &c : system.model.contributions)
      c->switch_values(state.point(), values.data() + c->first_switch);
  }



  bool
  Stepper::agrees(const unsigned int i, const std::vector<double> &values, const State &state) const
  {
    return (values[i] > 0) == (state.switches[i] != 0);
  }



  bool
  Stepper::starts_wrong(const unsigned int i, const State &state) const
  {
    return std::abs(start_values[i]) < 1e-12 || !agrees(i, start_values, state);
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



  bool
  Stepper::attempt(const State &state, double &h, Advance &result)
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
    if (result.step.converged)
      return true;
    ++result.n_failed;
    if (h / 2 < smallest_step)
      {
        std::ostringstream text;
        text << "t = " << state.time << " s: Newton's method does not converge with the smallest step, " << h
             << " s; the largest force left is at " << system.layout.name_of(result.step.worst);
        throw NotConverged(text.str());
      }
    h = controller ? controller->after_failure(h) : h / 2;
    return false;
  }



  void
  Stepper::find_event(const State &state, double &h, Advance &result)
  {
    // the earliest of the switches that changed on the way, by regula falsi (Illinois) on the step size
    for (unsigned int pass = 0; pass <= system.layout.n_switches; ++pass)
      {
        unsigned int i = 0;
        while (i < end_values.size() && (agrees(i, end_values, state) || starts_wrong(i, state)))
          ++i;
        if (i == end_values.size())
          return;
        double low = 0, high = h, f_low = start_values[i], f_high = end_values[i];
        int    side = 0;
        for (unsigned int iteration = 0; iteration < 60 && high - low > 1e-13 * std::max(h, std::abs(state.time));
             ++iteration)
          {
            double middle = f_high != f_low ? high - f_high * (high - low) / (f_high - f_low) : 0.5 * (low + high);
            middle        = std::clamp(middle, low + 1e-3 * (high - low) * (iteration < 5), high);
            if (!(middle > low && middle < high))
              break;
            integrator.step_back();
            double size = middle;
            if (!attempt(state, size, result))
              break;
            switch_values(trial, end_values);
            const double f = end_values[i];
            h              = middle;
            if (std::abs(f) < 1e-13)
              break;
            if ((f > 0) == (f_high > 0))
              {
                high   = middle;
                f_high = f;
                if (side == 1)
                  f_low /= 2;
                side = 1;
              }
            else
              {
                low   = middle;
                f_low = f;
                if (side == -1)
                  f_high /= 2;
                side = -1;
              }
          }
        // the trial is now at the zero of this switch, but for round-off
        switch_values(trial, end_values);
        trial.switches[i] = !state.switches[i];
        end_values[i]     = trial.switches[i] ? 1. : -1.; // done with
        ++result.n_events;
        bool others = false;
        for (unsigned int j = 0; j < end_values.size(); ++j)
          others = others || (j != i && !agrees(j, end_values, state) && !starts_wrong(j, state));
        if (!others)
          return;
        // another one changed before: look for that one
        trial.switches[i] = state.switches[i];
        end_values[i]     = start_values[i];
        --result.n_events;
      }
  }



  Advance
  Stepper::advance(State &state, const double end)
  {
    Advance result;
    if (steady_twists.empty())
      {
        trial = state;
        system.update_twists(trial);
        steady_twists = trial.y;
        if (controller)
          controller->update(std::max(energy_of_change(state), 1e-10 * system.energy(state).kinetic));
      }
    double       h     = next_step;
    const double ahead = state.time + 3 * h; // what is beyond does not change this step
    double       limit = end;
    if (ahead >= end)
      limit = corner(state.time, end);
    else if (const double place = corner(state.time, ahead); place < ahead)
      limit = place;
    const bool cut = state.time + h * (1 + 1e-6) >= limit;
    if (cut)
      h = limit - state.time;
    else if (controller && state.time + 2 * h > limit)
      h = 0.5 * (limit - state.time); // two equal ones rather than a long and a short one

    if (system.layout.n_switches > 0)
      {
        switch_values(state, start_values);
        // what a step ended at is zero but for round-off: its switch has been set
        for (unsigned int i = 0; i < start_values.size(); ++i)
          if (!agrees(i, start_values, state) && std::abs(start_values[i]) > 1e-9)
            state.switches[i] = start_values[i] > 0;
      }
    for (;;)
      {
        const double tried = h;
        if (!attempt(state, h, result))
          {
            next_step = h;
            continue;
          }
        if (controller)
          {
            controller->update(energy_of_change(trial));
            const auto decision = controller->decide(result.step.indicator, h);
            estimate            = controller->E_ref > 0 ? result.step.indicator / controller->E_ref : 0.;
            if (!decision.accept)
              {
                ++result.n_rejected;
                integrator.step_back();
                h = next_step = decision.next_h;
                continue;
              }
            // a step that was cut short says little of the next one
            next_step = tried < 0.5 * next_step ? std::max(next_step, decision.next_h) : decision.next_h;
          }
        else if (result.n_failed == 0 && h > 0.99 * next_step)
          next_step = std::min(fixed_step, 2 * next_step);
        break;
      }

    if (system.layout.n_switches > 0)
      {
        switch_values(trial, end_values);
        find_event(state, h, result);
        // leaving the wrong way right at the start: the switch was set by round-off
        for (unsigned int i = 0;
             i < end_values.size() && result.n_events == 0 && h / 2 > smallest_step && n_changes_here < 40;
             ++i)
          if (!agrees(i, end_values, state) && std::abs(end_values[i]) > 1e-9 && starts_wrong(i, state))
            {
              // or neither way is right, for a contact that begins here is over at the end: then half the step
              state.switches[i] = !state.switches[i];
              if (n_changes_here > 0)
                next_step = n_changes_here % 2 == 1 ? h / 2 : h;
              ++n_changes_here;
              integrator.step_back();
              const Advance again = advance(state, end);
              n_changes_here      = 0;
              return again;
            }
      }
    result.h = h;
    if (cut && h == limit - state.time)
      trial.time = limit; // without round-off
    std::swap(state, trial);
    if (result.n_events > 0)
      integrator.forget_history();
    return result;
  }
} // namespace samara
