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



  Stepper::Memory
  Stepper::memory() const
  {
    return {next_step, controller ? controller->memory() : std::array<double, 3>{}, steady_twists};
  }



  void
  Stepper::set_memory(const Memory &memory, const bool with_steps)
  {
    steady_twists = memory.steady_twists;
    if (with_steps)
      next_step = memory.next_step;
    if (controller && with_steps)
      controller->set_memory(memory.of_controller);
    else if (controller)
      controller->E_ref = memory.of_controller[0];
  }



  double
  Stepper::corner(const double from, const double to) const
  {
    double first = to;
    for (const auto &c : system.model.contributions)
      first = std::min(first, c->next_corner(from, to));
    return first;
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
            const auto decision = controller->decide(result.step.indicator, result.step.work_defect, h);
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

    result.h = h;
    if (cut && h == limit - state.time)
      trial.time = limit; // without round-off
    std::swap(state, trial);
    return result;
  }
} // namespace samara
