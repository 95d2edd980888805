#include <samara/analysis/periodic_motion.h>
#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/text.h>
#include <samara/model/probe_needs.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>
#include <samara/time/stepper.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** Of differences of probes, in the scales of increments: errors of its square. */
    constexpr double step_of_probes = 1e-4;



    double
    whole_turns(const double angle)
    {
      return 2 * M_PI * std::round(angle / (2 * M_PI));
    }
  } // namespace



  double
  PeriodAverage::weighted(const double y, const double phase) const
  {
    return part == mean ? y : 2 * y * (part == cosine ? std::cos(harmonic * phase) : std::sin(harmonic * phase));
  }



  PeriodicMotion::PeriodicMotion(const Context                    &context,
                                 const double                      period,
                                 const unsigned int                n_steps,
                                 const IntegratorSettings         &settings,
                                 const std::vector<PeriodAverage> &averages)
    : period(period)
    , n_steps(n_steps)
    , scales(scales_of_increment(context.system, period / (2 * M_PI)))
    , system(context.system)
    , settings(settings)
    , averages(averages)
  {
    std::vector<Probe> probes;
    for (const auto &average : averages)
      probes.push_back(average.probe);
    const ProbeNeeds needs(probes);
    needs_velocities = needs.velocities;
    needs_forces     = needs.forces;
  }



  std::string
  PeriodicMotion::name_of(const unsigned int i) const
  {
    const unsigned int velocities = system.layout.of_multiplier(0);
    return i < velocities ? system.layout.name_of(i) : "velocity of " + system.layout.name_of(i - velocities);
  }



  std::vector<double>
  PeriodicMotion::values(const State &state, Projection &projection) const
  {
    State        reported;
    const State *seen = &state;
    if (needs_velocities || needs_forces)
      {
        reported = state;
        try
          {
            projection.report(reported, needs_forces);
          }
        catch (const SingularMatrix &problem)
          {
            throw NotConverged(
              "t = " + number_to_text("%.6g", state.time) + " s: forces are not determined" +
              (problem.unknown >= 0 ? " at " + system.layout.name_of(problem.unknown) : std::string()));
          }
        seen = &reported;
      }
    std::vector<double> result;
    for (const auto &average : averages)
      result.push_back(average.probe.value(*seen));
    return result;
  }



  void
  PeriodicMotion::repeat(const RepeatedParts &repeated)
  {
    AssertThrow(n_steps % repeated.n() == 0, dealii::ExcMessage("Sections have as many steps as each other."));
    parts.reset();
    if (repeated.n() > 1)
      parts.emplace(repeated);
  }



  State
  PeriodicMotion::in_next_section(const State &state) const
  {
    State result = parts ? parts->renumbered(state, false) : state;
    result.time += period / n_sections();
    return result;
  }



  std::vector<double>
  PeriodicMotion::all_values(State state, Projection &projection) const
  {
    std::vector<double> result = values(state, projection);
    for (unsigned int section = 1; section < n_sections(); ++section)
      {
        state        = in_next_section(state);
        const auto y = values(state, projection);
        result.insert(result.end(), y.begin(), y.end());
      }
    return result;
  }



  std::vector<double>
  PeriodicMotion::all_changes(State state, const double *x, Projection &projection) const
  {
    std::vector<double> result = change_of_values(state, x, projection), changed(x, x + scales.size());
    for (unsigned int section = 1; section < n_sections(); ++section)
      {
        state = in_next_section(state);
        parts->apply_inverse(changed.data());
        const auto y = change_of_values(state, changed.data(), projection);
        result.insert(result.end(), y.begin(), y.end());
      }
    return result;
  }



  double
  PeriodicMotion::weighted(const unsigned int k, const std::vector<double> &values, const double time) const
  {
    double sum = 0;
    for (unsigned int section = 0; section < n_sections(); ++section)
      sum += averages[k].weighted(values[section * averages.size() + k],
                                  2 * M_PI * (time / period + double(section) / n_sections()));
    return sum;
  }



  void
  PeriodicMotion::add(std::vector<double>       &sums,
                      const std::vector<double> &y,
                      const double               time,
                      const unsigned int         step) const
  {
    // trapezoidal rule: of periodic functions exact for all harmonics that the steps can tell apart
    const double weight = (step > 0 && step < steps_of_turn() ? 1. : 0.5) / n_steps;
    for (unsigned int k = 0; k < sums.size(); ++k)
      sums[k] += weight * weighted(k, y, time);
  }



  std::vector<double>
  PeriodicMotion::turn(State &state, const Observer &observer)
  {
    const double        h = period / n_steps, start = state.time;
    StageIntegrator     integrator(system, settings);
    Stepper             stepper(system, integrator, h, 1e-3 * h);
    Projection          projection(system);
    std::vector<double> sums(averages.size(), 0.);
    add(sums, all_values(state, projection), state.time, 0);
    for (unsigned int i = 0; i < steps_of_turn(); ++i)
      {
        throw_if_interrupted();
        const double goal = start + (i + 1) * h;
        while (state.time < goal - 1e-9 * h)
          {
            const Advance advance = stepper.advance(state, goal);
            n_iterations += advance.step.iterations;
            ++n_marched;
          }
        const auto y = all_values(state, projection);
        add(sums, y, state.time, i + 1);
        if (observer)
          {
            const auto before = state.states;
            observer(state, i, y);
            if (state.states != before)
              integrator.forget_history();
          }
      }
    require_finite_state(system, state);
    ++n_turns;
    n_factorizations += integrator.n_factorizations;
    return sums;
  }



  void
  PeriodicMotion::linearize(const State &start, const double tolerance)
  {
    map = std::make_unique<PeriodMap>(system,
                                      PeriodSettings{period / n_sections(),
                                                     steps_of_turn(),
                                                     settings.n_stages,
                                                     settings.spectral_radius,
                                                     settings.newton_tolerance,
                                                     settings.max_iterations,
                                                     tolerance});
    ++n_turns;
    map->linearize(start);
    n_marched += steps_of_turn();
    n_iterations += map->n_iterations;
    n_factorizations += map->n_factorizations();
  }



  std::vector<double>
  PeriodicMotion::change_of_values(const State &state, const double *x, Projection &projection) const
  {
    double size = 0;
    for (unsigned int i = 0; i < scales.size(); ++i)
      size = std::max(size, std::abs(x[i]) / scales[i]);
    std::vector<double> result(averages.size(), 0.);
    if (!(size > 0) || averages.empty())
      return result;
    const double step   = step_of_probes / size;
    const auto   behind = values(moved(system, state, x, -step), projection);
    result              = values(moved(system, state, x, step), projection);
    for (unsigned int k = 0; k < result.size(); ++k)
      result[k] = (result[k] - behind[k]) / (2 * step);
    return result;
  }



  std::vector<double>
  PeriodicMotion::apply(double *x)
  {
    AssertThrow(map, dealii::ExcMessage("No turn has been linearised."));
    Projection          projection(system);
    std::vector<double> sums(averages.size(), 0.);
    for (unsigned int i = 0; i <= steps_of_turn(); ++i)
      {
        throw_if_interrupted();
        if (i > 0)
          map->apply_step(x, i - 1);
        const State &state = map->states()[i];
        add(sums, all_changes(state, x, projection), state.time, i);
      }
    if (parts)
      parts->apply(x);
    ++n_applied;
    return sums;
  }



  void
  PeriodicMotion::begin_again(const State &start, State &end) const
  {
    if (parts)
      {
        end             = parts->renumbered(end);
        end.multipliers = start.multipliers;
      }
    end.time = start.time;
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      if (!system.layout.is_length(system.layout.of_coordinate(i)))
        end.coordinates[i] -= whole_turns(end.coordinates[i] - start.coordinates[i]);
  }



  std::vector<double>
  PeriodicMotion::gap(const State &start, const State &end) const
  {
    return increment(system, start, parts ? parts->renumbered(end) : end, true);
  }



  PeriodicMotion::Largest
  PeriodicMotion::largest(const std::vector<double> &gap) const
  {
    Largest result = {0, 0};
    for (unsigned int i = 0; i < gap.size() && !std::isnan(result.size); ++i)
      if (const double size = std::abs(gap[i]) / scales[i]; !(size <= result.size))
        result = {size, i};
    return result;
  }
} // namespace samara
