#include <samara/time/rival_parts.h>
#include <samara/time/skeleton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  ExplicitMidpoint::ExplicitMidpoint(const System &system, const IntegratorSettings &)
    : system(system)
    , projection(system)
  {}



  State
  ExplicitMidpoint::moved(const State &start, const State &path, const std::vector<double> &a, const double h) const
  {
    State end = start;
    end.time += h;
    // the ground is the first node, and is no unknown
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        rivals::move(end, node, h * Eigen::Map<const Vector6>(&path.y[6 * node]));
        Eigen::Map<Vector6>(&end.y[6 * node]) += h * Eigen::Map<const Vector6>(&a[6 * (node - 1)]);
      }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      {
        end.coordinates[i] += h * path.rates[i];
        end.rates[i] += h * a[system.layout.of_coordinate(i)];
      }
    system.stresses(end, end.stress);
    return end;
  }



  StepResult
  ExplicitMidpoint::step(State &state, const double h)
  {
    StepResult result;
    State      start = state; // is left alone if there is no end
    start.held       = false; // in time, steady rotations do not hold their joints
    system.stresses(start, start.stress);
    result.iterations = 1;
    ++n_iterations;
    n_factorizations += 4; // two accelerations and two projections
    try
      {
        State middle = moved(start, start, projection.accelerations(start), h / 2);
        projection.velocities(middle);
        State end = moved(start, middle, projection.accelerations(middle), h);
        projection.velocities(end);
        system.stresses(end, end.stress);
        end.multipliers = middle.multipliers;
        rivals::account(system, start, end, result);
        result.is_finite = std::all_of(end.y.begin(), end.y.end(), [](const double v) { return std::isfinite(v); });
        result.converged = result.is_finite;
        if (result.converged)
          {
            state = end;
            ++n_steps;
          }
      }
    catch (const SingularMatrix &problem)
      {
        result.worst = std::max(problem.unknown, 0);
      }
    return result;
  }
} // namespace samara
