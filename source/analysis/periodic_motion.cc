#include <samara/analysis/periodic_motion.h>
#include <samara/base/interrupt.h>
#include <samara/model/probe_needs.h>
#include <samara/solvers/newton.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>
#include <samara/time/stepper.h>

#include <cmath>

namespace samara
{
  namespace increment
  {
    unsigned int
    size(const System &system)
    {
      return system.layout.of_multiplier(0) + system.layout.n_kinematic();
    }



    State
    moved(const System &system, const State &state, const std::vector<double> &x)
    {
      const Layout &layout     = system.layout;
      const int     velocities = layout.of_multiplier(0);
      State         result     = state;
      for (unsigned int node = 1; node < layout.n_nodes; ++node)
        {
          const Eigen::Map<const Vector6> zeta(&x[layout.of_node(node)]);
          Eigen::Map<Vector3>             place(&result.q[12 * node]);
          Eigen::Map<Matrix3>             D(&result.q[12 * node + 3]);
          place += D * zeta.head<3>();
          D = (D * rotation_of_vector(Vector3(zeta.tail<3>()))).eval();
          Eigen::Map<Vector6>(&result.y[6 * node]) +=
            Eigen::Map<const Vector6>(&x[velocities + layout.of_node(node)]);
        }
      for (unsigned int i = 0; i < layout.n_coordinates; ++i)
        {
          result.coordinates[i] += x[layout.of_coordinate(i)];
          result.rates[i] += x[velocities + layout.of_coordinate(i)];
        }
      for (unsigned int i = 0; i < layout.n_states; ++i)
        result.states[i] += x[layout.of_state(i)];
      system.stresses(result, result.stress);
      return result;
    }



    std::vector<double>
    between(const System &system, const State &from, const State &to)
    {
      const Layout       &layout     = system.layout;
      const int           velocities = layout.of_multiplier(0);
      std::vector<double> x(size(system));
      for (unsigned int node = 1; node < layout.n_nodes; ++node)
        {
          const Matrix3 D = from.triad(node);
          Eigen::Map<Vector6>(&x[layout.of_node(node)]) << D.transpose() * (to.position(node) - from.position(node)),
            vector_of_rotation(D.transpose() * to.triad(node));
          Eigen::Map<Vector6> velocity(&x[velocities + layout.of_node(node)]);
          velocity =
            Eigen::Map<const Vector6>(&to.y[6 * node]) - Eigen::Map<const Vector6>(&from.y[6 * node]);
        }
      for (unsigned int i = 0; i < layout.n_coordinates; ++i)
        {
          x[layout.of_coordinate(i)]              = to.coordinates[i] - from.coordinates[i];
          x[velocities + layout.of_coordinate(i)] = to.rates[i] - from.rates[i];
        }
      for (unsigned int i = 0; i < layout.n_states; ++i)
        x[layout.of_state(i)] = to.states[i] - from.states[i];
      return x;
    }
  } // namespace increment



  namespace
  {
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
    , context(context)
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

    const Layout &layout = system.layout;
    const double  length = model_length(system.model), rate = 2 * M_PI / period;
    scales.assign(increment::size(system), 1.);
    for (int i = 0; i < layout.n_kinematic(); ++i)
      {
        scales[i]                            = layout.is_length(i) ? length : 1.;
        scales[layout.of_multiplier(0) + i] = scales[i] * rate;
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      scales[layout.of_state(i)] = system.model.states[i].scale;
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
        projection.report(reported, needs_forces);
        seen = &reported;
      }
    std::vector<double> result;
    for (const auto &average : averages)
      result.push_back(average.probe.value(*seen));
    return result;
  }



  std::vector<double>
  PeriodicMotion::turn(State &state, const Observer &observer, const unsigned int n_done)
  {
    const double        h = period / n_steps, start = state.time - n_done * h;
    StageIntegrator     integrator(system, settings);
    Stepper             stepper(system, integrator, h, 1e-3 * h);
    Projection          projection(system);
    std::vector<double> sums(averages.size(), 0.);
    const auto          add = [&](const std::vector<double> &y, const double weight) {
      for (unsigned int k = 0; k < sums.size(); ++k)
        sums[k] += weight * weighted(k, y[k], state.time);
    };
    const unsigned int n = n_steps - n_done;
    if (n == n_steps)
      add(values(state, projection), 0.5 / n);
    for (unsigned int i = n_done; i < n_steps; ++i)
      {
        throw_if_interrupted();
        const double goal = start + (i + 1) * h;
        while (state.time < goal - 1e-9 * h)
          {
            const Advance advance = stepper.advance(state, goal);
            n_iterations += advance.step.iterations;
            ++n_marched;
          }
        const auto y = values(state, projection);
        add(y, (i + 1 < n_steps || n < n_steps ? 1. : 0.5) / n);
        if (observer)
          {
            const auto before = state.states;
            observer(state, i, y);
            if (state.states != before)
              integrator.forget_history();
          }
      }
    require_finite_state(system, state);
    n_turns += double(n) / n_steps;
    n_factorizations += integrator.n_factorizations;
    return sums;
  }



  void
  PeriodicMotion::begin_again(const State &start, State &end) const
  {
    end.time = start.time;
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      if (!system.layout.is_length(system.layout.of_coordinate(i)))
        end.coordinates[i] -= whole_turns(end.coordinates[i] - start.coordinates[i]);
  }



  std::vector<double>
  PeriodicMotion::gap(const State &start, const State &end) const
  {
    auto x = increment::between(system, start, end);
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      if (const int at = system.layout.of_coordinate(i); !system.layout.is_length(at))
        x[at] -= whole_turns(x[at]);
    return x;
  }
} // namespace samara
