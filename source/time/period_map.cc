#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/algebraic_states.h>
#include <samara/time/period_map.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Unknowns times integrators whose factors are kept: with their own, steps take least products. */
    constexpr double most_unknowns_with_factors = 2e5;

    /** Rotations [rad] and displacements over the model's length in the differences of a projection. */
    constexpr double step_of_projection = 1e-3;
  } // namespace



  PeriodMap::PeriodMap(const System &system, const PeriodSettings &settings)
    : settings(settings)
    , system(system)
    , projection(system)
  {
    if (!(settings.period > 0) || !std::isfinite(settings.period))
      throw std::invalid_argument("a period must be positive");
    if (settings.n_steps == 0)
      throw std::invalid_argument("a period has one step or more");
  }



  std::unique_ptr<StageIntegrator>
  PeriodMap::make_integrator() const
  {
    return std::make_unique<StageIntegrator>(system,
                                             Tableau(settings.n_stages, settings.spectral_radius),
                                             settings.newton_tolerance,
                                             settings.max_iterations);
  }



  void
  PeriodMap::step(StageIntegrator &integrator, State &state)
  {
    const double     time   = state.time;
    const StepResult result = integrator.step(state, step_size());
    n_iterations += result.iterations;
    if (!result.converged)
      throw NotConverged("there is no solution for the step from t = " + number_to_text("%.6g", time) + " s to " +
                         number_to_text("%.6g", time + step_size()) + " s; take more steps a period");
  }



  State
  PeriodMap::march(const State &start)
  {
    const auto integrator = make_integrator();
    State      state      = start;
    for (unsigned int i = 0; i < settings.n_steps; ++i)
      step(*integrator, state);
    projection.velocities(state);
    return state;
  }



  State
  PeriodMap::linearize(const State &start)
  {
    tangents.clear();
    integrators.clear();
    along                     = {start};
    const double share        = std::max(1., system.size() * double(settings.n_steps) / most_unknowns_with_factors);
    const auto   steps_of_one = static_cast<unsigned int>(std::ceil(share));
    State        state        = start;
    for (unsigned int i = 0; i < settings.n_steps; ++i)
      {
        if (i % steps_of_one == 0)
          {
            if (!integrators.empty())
              integrators.back()->forget_matrices();
            integrators.push_back(make_integrator());
          }
        const State before = state;
        step(*integrators.back(), state);
        tangents.push_back(integrators.back()->linearize(before));
        tangents.back()->tolerance = settings.tangent_tolerance;
        along.push_back(state);
      }
    integrators.back()->forget_matrices();
    raw_end = state;
    projection.velocities(along.back());
    return along.back();
  }



  void
  PeriodMap::set_tolerance(const double tolerance)
  {
    for (auto &tangent : tangents)
      tangent->tolerance = tolerance;
  }



  void
  PeriodMap::apply(double *x)
  {
    for (unsigned int i = 0; i < settings.n_steps; ++i)
      apply_step(x, i);
    project_increment(raw_end, x);
  }



  State
  PeriodMap::carry(const State &start, double *x)
  {
    const auto integrator = make_integrator();
    State      state      = start;
    for (unsigned int i = 0; i < settings.n_steps; ++i)
      {
        const State before = state;
        step(*integrator, state);
        integrator->linearize(before)->apply(x);
        ++n_applied;
      }
    project_increment(state, x);
    projection.velocities(state);
    return state;
  }



  void
  PeriodMap::apply_step(double *x, const unsigned int i)
  {
    AssertThrow(i < tangents.size(), dealii::ExcMessage("No period has been linearised."));
    tangents[i]->apply(x);
    ++n_applied;
  }



  std::vector<double>
  PeriodMap::correction_of_velocities(const State &state, const double *x, const double factor)
  {
    const Layout       &layout = system.layout;
    State               there  = moved(system, state, x, factor);
    const State         before = there;
    std::vector<double> result(layout.n_kinematic() + layout.n_states);
    projection.velocities(there);
    for (int i = 0; i < layout.of_coordinate(0); ++i)
      result[i] = there.y[6 + i] - before.y[6 + i];
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      result[layout.of_coordinate(i)] = there.rates[i] - before.rates[i];
    for (unsigned int i = 0; i < layout.n_states; ++i)
      result[layout.n_kinematic() + i] = there.states[i] - before.states[i];
    return result;
  }



  void
  PeriodMap::project_increment(const State &state, double *x)
  {
    const Layout &layout = system.layout;
    if (layout.n_multipliers == 0 && algebraic_states(system.model).empty())
      return;
    // positions move by as much as does not matter, velocities by as much in a part of the period
    const std::vector<double> scales = scales_of_increment(system, settings.period);
    double                    motion = 0;
    for (unsigned int i = 0; i < size(); ++i)
      motion = std::max(motion, std::abs(x[i]) / scales[i]);
    if (!(motion > 0))
      return;
    // central differences of sixth order, (3/4, −3/20, 1/60)
    const double        weights[] = {0.75, -0.15, 1. / 60}, step = step_of_projection / motion;
    std::vector<double> change(layout.n_kinematic() + layout.n_states, 0.);
    for (int j = 1; j <= 3; ++j)
      for (const int side : {1, -1})
        {
          const auto correction = correction_of_velocities(state, x, side * j * step);
          for (unsigned int i = 0; i < change.size(); ++i)
            change[i] += side * weights[j - 1] / step * correction[i];
        }
    for (int i = 0; i < layout.n_kinematic(); ++i)
      x[first_velocity() + i] += change[i];
    for (unsigned int i = 0; i < layout.n_states; ++i)
      x[layout.of_state(i)] += change[layout.n_kinematic() + i];
  }



  unsigned int
  PeriodMap::n_products() const
  {
    unsigned int n = 0;
    for (const auto &tangent : tangents)
      n += tangent->n_products;
    return n;
  }



  unsigned int
  PeriodMap::n_factorizations() const
  {
    unsigned int n = 0;
    for (const auto &integrator : integrators)
      n += integrator->n_factorizations;
    return n;
  }
} // namespace samara
