#include <samara/base/astray.h>
#include <samara/base/interrupt.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  double
  model_length(const Model &model)
  {
    const double diagonal = box_diagonal(model);
    return diagonal > 0 ? diagonal : 1.;
  }



  Newton::Newton(const System &system, LinearSolver &solver, const double tolerance, const unsigned int max_iterations)
    : system(system)
    , solver(solver)
    , tolerance(tolerance)
    , max_iterations(max_iterations)
    , length(model_length(system.model))
    , K(system.layout.pattern)
  {}



  double
  size_of_step(const System              &system,
               const std::vector<double> &step,
               const double               length,
               const std::vector<double> *states)
  {
    // a maximum would not see what is no number
    if (const auto bad =
          std::find_if(step.begin(), step.begin() + system.size(), [](double x) { return !std::isfinite(x); });
        bad != step.begin() + system.size())
      return *bad;
    double size = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> z(&step[system.layout.of_node(node)]);
        size = std::max({size, z.head<3>().norm() / length, z.tail<3>().norm()});
      }
    for (int i = system.layout.of_coordinate(0); i < system.layout.of_multiplier(0); ++i)
      {
        double    scale = system.layout.scale_of(i, length);
        const int state = i - system.layout.of_state(0);
        if (states != nullptr && state >= 0)
          scale = std::max({scale, std::abs((*states)[state]), std::abs((*states)[state] + step[i])});
        size = std::max(size, std::abs(step[i]) / scale);
      }
    return size;
  }



  void
  refuse_negative_length(const System &system, const State &state, NewtonResult &result)
  {
    const int i = system.model.negative_length(state.coordinates);
    if (i < 0)
      return;
    result.fail(Failure::other, "the length <" + system.model.coordinates[i] + "> would be negative");
    result.worst = system.layout.of_coordinate(i);
  }



  namespace
  {
    /**
     * Shorten a step that turns a node by more than a right angle, 2 atan(|θ|/2). Joints know their axes by products of
     * triads, which do not tell an axis from its reverse: it must not get there in one go.
     */
    void
    limit_rotations(const System &system, std::vector<double> &step)
    {
      if (system.layout.n_multipliers == 0)
        return;
      constexpr double limit   = 2;
      double           largest = 0;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        largest = std::max(largest, Eigen::Map<const Vector3>(&step[system.layout.of_node(node) + 3]).norm());
      if (largest > limit)
        for (auto &s : step)
          s *= limit / largest;
    }
  } // namespace



  void
  Newton::find_worst(NewtonResult &result) const
  {
    for (unsigned int i = 0; i < system.size(); ++i)
      if (!(std::abs(residual[i]) <= result.residual))
        {
          result.residual = std::abs(residual[i]);
          result.worst    = i;
        }
  }



  void
  Newton::check_rows_left_out(const State &state, NewtonResult &result)
  {
    if (state.left_out.empty())
      return;
    const auto        gaps      = redundant->gaps(state);
    const std::string objection = redundant->objection(state, gaps);
    if (objection.empty())
      return;
    result.fail(Failure::rows_left_out, objection);
    result.worst = system.layout.of_multiplier(gaps.worst);
  }



  namespace
  {
    /** Unknowns from which on a factorisation costs so much more than the rest of an iteration that it is kept: */
    constexpr unsigned int worth_keeping = 20000;
    /** after a correction so small that the matrix hardly changes, as long as the next ones shrink so fast. */
    constexpr double small_correction = 1e-2, fast = 0.1;



    /** Whether all rows are numbers; the first that is none is told. */
    bool
    is_finite(const std::vector<double> &residual, const unsigned int n, NewtonResult &result)
    {
      const auto end = residual.begin() + n;
      const auto bad = std::find_if(residual.begin(), end, [](const double r) { return !std::isfinite(r); });
      if (bad == end)
        return true;
      result.fail(Failure::not_finite, "what acts there is not a finite number");
      result.worst = bad - residual.begin();
      return false;
    }



    /** Whether the equations have a value at @p state. */
    bool
    evaluate(const System        &system,
             const State         &state,
             std::vector<double> &stress,
             std::vector<double> &residual,
             NewtonResult        &result)
    {
      try
        {
          system.stresses(state, stress);
          system.residual(state, stress, residual);
        }
      catch (const Astray &why)
        {
          result.fail(Failure::no_convergence, why.what());
          return false;
        }
      return true;
    }



    /** Whether the tangent at @p state has factors. */
    bool
    factorize(const System &system, const State &state, SparseMatrix &K, LinearSolver &solver, NewtonResult &result)
    {
      try
        {
          system.tangent(state, K);
          solver.factorize(K);
        }
      catch (const Astray &why)
        {
          result.fail(Failure::no_convergence, why.what());
          return false;
        }
      catch (const SingularMatrix &singular)
        {
          result.fail(Failure::singular, "the tangent matrix is singular");
          result.worst = std::max(0, singular.unknown);
          return false;
        }
      return true;
    }
  } // namespace



  NewtonResult
  Newton::solve(State &state)
  {
    NewtonResult result;
    double       smallest = 1e300, last = 0;
    bool         keeps_factors = false;
    if (!state.left_out.empty())
      {
        if (!redundant)
          redundant = std::make_unique<RedundantRows>(system);
        redundant->choose(state);
      }
    while (result.iterations < max_iterations)
      {
        throw_if_interrupted();
        if (!evaluate(system, state, stress, residual, result))
          return result;
        if (result.iterations == 0 && !is_finite(residual, system.size(), result))
          return result;
        if (!keeps_factors && !factorize(system, state, K, solver, result))
          return result;
        step.assign(residual.begin(), residual.begin() + system.size());
        for (auto &s : step)
          s = -s;
        solver.solve(step.data());
        ++result.iterations;
        ++n_iterations;

        result.last_step = size_of_step(system, step, length, &state.states);
        // a hundred radians or sizes of the model (later, a thousand times the smallest correction): it leads nowhere
        if (!std::isfinite(result.last_step) || result.last_step > 100.)
          {
            result.fail(Failure::no_convergence, "the iterations diverge");
            find_worst(result);
            return result;
          }
        keeps_factors = system.size() >= worth_keeping &&
                        (keeps_factors ? result.last_step < fast * last : result.last_step < small_correction);
        last = result.last_step;
        limit_rotations(system, step);
        system.update(state, step);
        smallest = std::min(smallest, result.last_step);
        if (result.last_step < tolerance)
          {
            system.stresses(state, state.stress);
            result.converged = true;
            check_rows_left_out(state, result);
            if (result.converged)
              refuse_negative_length(system, state, result);
            return result;
          }
        if (result.iterations > 8 && result.last_step > 1e3 * smallest)
          {
            result.fail(Failure::no_convergence, "the iterations diverge");
            find_worst(result);
            return result;
          }
      }
    result.fail(Failure::no_convergence, "no convergence in " + std::to_string(max_iterations) + " iterations");
    find_worst(result);
    return result;
  }
} // namespace samara
