// What an iteration of Newton's method has left: gaps, work, energy without a source; and what need not be looked at.

#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** The kinetic energy is at most as many times all that may have become it. */
    constexpr double sources_of_energy = 10;

    /** Part of the model by which something at rest may seem to move in a step. */
    constexpr double motion_at_rest = 1e-3;
  } // namespace



  bool
  StageIntegrator::has_sources(const StepResult &result, const double h) const
  {
    const double sources =
      sources_of_energy * (energy_scale + std::abs(result.work_of_loads) + std::abs(result.work_of_drives));
    if (kinetic_energy <= sources) // where all bodies are held both are zero
      return true;
    // what moves by a thousandth of the model a step is round-off of something at rest
    return kinetic_energy < sources + energy_of_moving(motion_at_rest * length / h);
  }



  double
  StageIntegrator::energy_of_moving(const double speed) const
  {
    double mass = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      mass += system.model.nodes[node].inertia(0, 0);
    return 0.5 * mass * speed * speed;
  }



  void
  StageIntegrator::find_infinite(StepResult &result) const
  {
    for (const Stage &stage : stages)
      for (unsigned int i = 0; i < system.size(); ++i)
        if (!std::isfinite(stage.residual[i]))
          {
            result.is_finite = false;
            result.worst     = i;
            return;
          }
  }



  double
  StageIntegrator::largest_gap(const double h) const
  {
    double gap = 0;
    for (const Stage &stage : stages)
      for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
        gap = std::max(gap, h * gap_scale[i] * std::abs(stage.residual[system.layout.of_multiplier(i)]));
    return gap;
  }



  double
  StageIntegrator::energy_that_counts() const
  {
    // a prestressed model has energy that takes no part in the motion: a thousandth of it counts, or what has moved
    return std::max(kinetic_energy, std::clamp(moved_energy, 1e-3 * energy_scale, energy_scale));
  }



  bool
  StageIntegrator::can_predict() const
  {
    return !is_exact && !wants_estimates && system.layout.stops.empty() && system.layout.frictions.empty() &&
           system.layout.nonlinear_springs.empty() && contacts.is_empty();
  }



  bool
  StageIntegrator::confirm_without_forces(const State &state, const double h)
  {
    find_state_rates(state, h);
    evaluate_constraints(state, h);
    if (!(largest_gap(h) < allowed_gap()))
      return false;
    if (system.is_viscous() || tableau.alpha != 0.)
      evaluate_strain_rates(h);
    return true;
  }



  StageIntegrator::EnergyError
  StageIntegrator::energy_error(const double h) const
  {
    double force_work = 0, stress_work = 0, bound = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        const Stage &stage = stages[k];
        double       power = 0, powers = 0;
        const auto   add = [&](const double part) {
          power += part;
          powers += std::abs(part);
        };
        for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
          add(stage.residual[i] * stage.y[6 + i]);
        for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
          add(stage.residual[system.layout.of_coordinate(i)] * stage.rates[i]);
        bound += h * tableau.b(k) * powers;
        force_work += h * tableau.b(k) * power;
        stress_work += h * tableau.b(k) * system.sum_of_powers(stage.excess.data(), stage.strain_rates.data());
      }
    return {std::abs(force_work) + stress_work, bound + stress_work};
  }
} // namespace samara
