// Newton's method for the stages of a step: which matrices are tried, and when an attempt has come to its end.

#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

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

    /** Corrections of an attempt before those that are remembered for its acceleration; what converges fast needs none.
     * Where it is accelerated, attempts may shrink more slowly before they are given up. */
    constexpr unsigned int plain_corrections = 2;
    constexpr double       patience          = 1.6;

    /** Iterations that a slow attempt may still need: about what another factorisation costs. */
    constexpr double most_iterations_to_come = iterations_of_a_factorization;

    /** Steps that begin with new factors after one to which old ones were no help, doubled each time, at most. */
    constexpr unsigned int most_steps_anew = 15;

    /** Steps to come that begin with the exact matrix, where contacts in groups stick and slip. */
    constexpr unsigned int steps_with_exact_matrix = 20;
    /** @} */

    /** Whether a body would move so far in the step @p h that the iteration has gone astray. */
    template <typename Stage>
    bool
    moves_too_far(const std::vector<Stage> &stages, const double h, const double length)
    {
      for (const Stage &stage : stages)
        for (unsigned int i = 6; i < stage.y.size(); ++i)
          if (!(h * std::abs(stage.y[i]) < lost * (i % 6 < 3 ? length : 1.)))
            return true;
      return false;
    }
  } // namespace



  bool
  StageIntegrator::find_stages(const State &state, const double h, StepResult &result)
  {
    if (has_many_contacts() || n_exact_for_contacts > 0)
      {
        n_exact_for_contacts -= n_exact_for_contacts > 0;
        if (iterate_exactly(state, h, false, result))
          return true;
        predict(state, h);
      }
    if (n_steps_to_go_anew > 0)
      --n_steps_to_go_anew;
    else if (is_step(factored_step, h))
      {
        if (iterate(state, h, slow_with_old_factors, result))
          {
            n_steps_anew = 0;
            return true;
          }
        n_steps_to_go_anew = n_steps_anew = std::min(2 * n_steps_anew + 1, most_steps_anew);
        if (!(result.last_correction < near))
          predict(state, h);
      }
    if (find_with_new_factors(state, h, result))
      return true;
    const bool touches = !contacts.touched().empty();
    if (touches)
      predict(state, h);
    if (!iterate_exactly(state, h, !touches, result))
      return false;
    if (touches)
      n_exact_for_contacts = steps_with_exact_matrix;
    return true;
  }



  bool
  StageIntegrator::find_with_new_factors(const State &state, const double h, StepResult &result)
  {
    for (unsigned int i = 0; i < max_factorizations_per_step; ++i)
      {
        // about the middle of the step, as far as it is known; the last time, where another one would not help
        freeze(state, h);
        try
          {
            factorize(h);
          }
        catch (const SingularMatrix &)
          {
            return false; // gone astray
          }
        const bool is_last =
          i + 1 == max_factorizations_per_step || (i > 0 && result.last_correction < as_near_as_can_be);
        if (iterate(state, h, is_last ? slow_with_last_factors : slow_with_new_factors, result))
          return true;
        if (is_last || !(result.last_correction < far))
          {
            if (previous_step == 0)
              return false;
            previous_step = 0; // perhaps the extrapolated start was not good
            predict(state, h);
            i = 0;
          }
      }
    return false;
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



  /** Corrections of one attempt and how they shrink from one to the next, and the work that is left in residuals. */
  struct StageIntegrator::Progress
  {
    unsigned int n = 0, n_stagnant = 0; ///< corrections, and the last of them without progress
    double       last = 0, last_rate = 0, worse_rate = 0, rate_of_two = 0, smallest = 1e300;
    double       plain_rate = 0; ///< the last one before it was accelerated: what is left may shrink no faster
    double       work_left = 0, rate_of_work = 1;

    /** All corrections to come, at this rate. */
    double
    to_come(const double rate) const
    {
      return last * rate / (1 - rate);
    }

    void
    add(const double size)
    {
      const double rate = last > 0 ? size / last : 0;
      worse_rate        = std::max(rate, last_rate); // rates may alternate
      rate_of_two       = std::min(rate, last_rate) < least_rate ? std::sqrt(rate * last_rate) : worse_rate;
      last_rate         = rate;
      if (size > size_of_round_off)
        smallest = std::max(smallest, size); // a first correction may be none by accident
      n_stagnant = size < progress * smallest ? 0 : n_stagnant + 1;
      smallest   = std::min(smallest, size);
      last       = size;
      ++n;
    }

    void
    add_work(const double bound)
    {
      rate_of_work = work_left > 0 ? bound / work_left : 1.;
      work_left    = bound;
    }

    /**
     * Whether corrections shrink by less than the factor @p slow, and more than a few are missing: log(tolerance/last)
     * / log(rate) of them, at a rate below one so that this is a number. Where one correction is larger than its
     * neighbours for what vibrates in large models, with rates as 0.8 and 0.002, the mean of two tells how many.
     */
    bool
    is_too_slow(const double slow, const double tolerance) const
    {
      return n > 2 && rate_of_two > slow && last > size_of_slowness &&
             std::log(tolerance / last) / std::log(std::min(rate_of_two, 0.99)) > most_iterations_to_come;
    }
  };



  bool
  StageIntegrator::converges_unseen(const Progress &progress, const State &state, const double h)
  {
    const double rate = std::max({progress.worse_rate, progress.rate_of_work, progress.plain_rate, least_rate});
    return can_predict() && rate < sure_rate && progress.to_come(rate) < tolerance &&
           progress.work_left * rate < share_of_energy * tolerance * energy_that_counts() &&
           confirm_without_forces(state, h);
  }



  StageIntegrator::Verdict
  StageIntegrator::judge_residuals(Progress &progress, const double h) const
  {
    // linear convergence: what is still missing is about last · rate/(1 − rate); at round-off it no longer shrinks
    const double rate =
      std::min(progress.n > 1 ? std::max(progress.last_rate, progress.plain_rate) : first_rate, largest_rate);
    const auto [error, bound] = energy_error(h);
    // where all bodies are held there is no energy, and no error of it
    if (progress.to_come(rate) < tolerance && error <= share_of_energy * tolerance * energy_that_counts() &&
        largest_gap(h) < allowed_gap())
      return Verdict::converged;
    progress.add_work(bound);
    if (progress.n_stagnant <= 2 || progress.last >= size_of_round_off)
      return Verdict::open;
    // What is left may be more than what was before, if factors are old: then it grows, slowly, from round-off.
    // Small corrections alone say little: near singular positions, reactions go astray while nothing moves.
    const bool   is_fresh = is_exact || n_steps_with_factors == 0;
    const double scale = std::max(energy_scale, kinetic_energy), work = is_fresh ? 1e-10 : 1e-12,
                 gap = is_fresh ? 1e-9 : 1e-12;
    return error <= work * scale + energy_of_moving(1e-8 * length / h) && largest_gap(h) < gap * length ?
             Verdict::converged :
             Verdict::failed;
  }



  bool
  StageIntegrator::can_accelerate() const
  {
    return !is_exact && devices.empty() && contacts.is_empty() && !switches;
  }



  std::vector<Anderson::Part>
  StageIntegrator::iterated_parts()
  {
    std::vector<Anderson::Part> parts;
    const auto                  add = [&](std::vector<double> &values, const unsigned int first, const bool counts) {
      parts.push_back({values.data() + first, static_cast<unsigned int>(values.size() - first), counts});
    };
    for (Stage &stage : stages)
      {
        add(stage.y, 6, true);
        add(stage.rates, 0, true);
        add(stage.states, 0, false);
        add(stage.multipliers, 0, false);
        add(stage.stress, 0, false);
      }
    if (acceleration_weights.empty())
      for (unsigned int k = 0; k < tableau.s; ++k)
        {
          for (unsigned int i = 6; i < stages[k].y.size(); ++i)
            acceleration_weights.push_back(i % 6 < 3 ? 1 / length : 1.);
          for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
            acceleration_weights.push_back(1 / system.layout.scale_of(system.layout.of_coordinate(i), length));
        }
    return parts;
  }



  bool
  StageIntegrator::iterate(const State &state, const double h, const double slow, StepResult &result)
  {
    Progress   progress;
    const bool may_accelerate = can_accelerate();
    acceleration.begin();
    bool       is_astray          = moves_too_far(stages, h, length); // an attempt may begin with what another one left
    const auto name_largest_force = [&]() {
      double largest = 0;
      for (unsigned int i = 0; i < static_cast<unsigned int>(system.layout.of_multiplier(0)); ++i)
        if (std::abs(stages[0].residual[i]) > largest)
          {
            largest      = std::abs(stages[0].residual[i]);
            result.worst = i;
          }
    };
    while (progress.n < max_iterations)
      {
        move_stages(state, h);
        // what is left shrinks as it did, and as corrections do: an evaluation would only say so
        if (converges_unseen(progress, state, h))
          return true;
        evaluate(state, h);
        ++n_evaluations;
        if (progress.n > 0)
          if (const Verdict verdict = judge_residuals(progress, h); verdict != Verdict::open)
            return verdict == Verdict::converged;
        std::vector<Anderson::Part> parts;
        if (may_accelerate && progress.n >= plain_corrections)
          {
            parts = iterated_parts();
            acceleration.keep(parts);
          }
        const double size = is_exact ? solve_exactly(h) : solve(h);
        ++result.iterations;
        result.last_correction = size;
        // of stages that have gone astray anything may be infinite: that is no fault of what acts
        if (!std::isfinite(size) && !is_astray)
          find_infinite(result);
        if (!std::isfinite(size) || size > lost)
          {
            if (result.is_finite)
              name_largest_force();
            return false;
          }
        is_astray = is_astray || (size > near && moves_too_far(stages, h, length));
        correct_stresses();
        progress.add(size);
        if (progress.n == plain_corrections + 1)
          progress.plain_rate = may_accelerate ? progress.last_rate : 0.;
        if (progress.is_too_slow(may_accelerate ? std::min(patience * slow, slow_with_last_factors) : slow, tolerance))
          return false;
        if (!parts.empty())
          acceleration.accelerate(parts, acceleration_weights);
      }
    name_largest_force();
    return false;
  }
} // namespace samara
