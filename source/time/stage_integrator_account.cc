// The energy account of a step.

#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace samara
{
  void
  StageIntegrator::account(const State &state, const double h, StepResult &result)
  {
    account_for_loads(h, result);
    find_worst(result);

    // dampers: the power of the viscous stresses is the product with their own strain rates
    for (unsigned int k = 0; k < tableau.s && system.is_viscous(); ++k)
      result.viscous_loss += h * tableau.b(k) * system.viscous_power(stages[k].strain_rates.data());

    account_for_stops(state, h, result);
    account_for_springs(h, result);
    if (!contacts.is_empty())
      contacts.account(result);
    result.unresolved_state = unresolved_state(state, h);
    account_for_drives(h, result);
    account_for_dissipation(state, h, result);
  }



  void
  StageIntegrator::account_for_loads(const double h, StepResult &result)
  {
    const auto power = [&](const Stage &stage) {
      double sum = 0;
      for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
        sum += force[i] * stage.y[6 + i];
      for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
        sum += force[system.layout.of_coordinate(i)] * stage.rates[i];
      return sum;
    };
    for (unsigned int k = 0; k < tableau.s && system.n_loads() > 0; ++k)
      {
        force.assign(system.size() + 6, 0.);
        system.add_loads(stages[k].point(), force.data());
        result.work_of_loads -= h * tableau.b(k) * power(stages[k]);
      }
    for (unsigned int k = 0; k < tableau.s && !air.is_empty(); ++k)
      result.air.add(h * tableau.b(k), air.powers(stages[k].point()));
  }



  void
  StageIntegrator::account_for_drives(const double h, StepResult &result)
  {
    // constraints do the work −λ·(ġ − ∂g/∂t); for those that do not depend on time it vanishes over the step
    for (unsigned int k = 0; k < tableau.s && system.layout.n_multipliers > 0; ++k)
      {
        const Stage &stage = stages[k];
        time_rates.resize(system.layout.n_multipliers);
        system.constraint_time_rates(stage.point(), time_rates.data());
        for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
          if (is_active[i])
            result.work_of_drives -=
              h * tableau.b(k) * stage.multipliers[i] * (stage.constraint_rates[i] - time_rates[i]);
      }
    for (const auto &correction : system.layout.corrections)
      {
        const double force = force_of(correction, h);
        for (unsigned int k = 0; k < tableau.s; ++k)
          result.work_of_drives += h * tableau.b(k) * force * std::pow(stages[k].rates[correction.coordinate], 2);
      }
  }



  void
  StageIntegrator::account_for_dissipation(const State &state, const double h, StepResult &result)
  {
    // D = h² α/(2(2s−1)) |Σ b p (ẏ, ė)|² in the norm of the energy
    const unsigned int s       = tableau.s;
    const auto         kinetic = [&](const std::vector<double> &start) {
      double square = 0;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Vector6 u = highest_mode(start, node, h);
          square += u.dot(system.model.nodes[node].inertia * u);
        }
      return square;
    };
    std::fill(strain_increment.begin(), strain_increment.end(), 0.);
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < system.layout.n_strains; ++i)
        strain_increment[i] += tableau.b(k) * tableau.p(k) * stages[k].strain_rates[i];
    const double square = 2 * system.strain_energy(strain_increment.data());
    const double factor = h * h / (2 * (2. * s - 1)), raw = square + kinetic(state.y);
    result.dissipated += tableau.alpha * factor * raw;
    result.indicator = factor * (wants_estimates ? square + kinetic(admissible_velocities(state)) : raw);
  }



  int
  StageIntegrator::unresolved_state(const State &state, const double h)
  {
    // The highest mode of the rates of a state, h |Σ b p ż|/(2(2s−1)), in parts of the largest value it had. For ż = λz
    // it is that large where a step is wrong by about a third: |hλ| about 1, 2.5, 4 for 1, 2, 3 stages.
    constexpr std::array<double, 3> limit  = {{0.3, 0.12, 0.05}};
    const double                    factor = h / (2 * (2. * tableau.s - 1));
    int                             worst  = -1;
    double                          most   = limit[tableau.s - 1];
    largest_states.resize(system.layout.n_states, 0.);
    for (unsigned int i = 0; i < system.layout.n_states; ++i)
      {
        double mode = 0;
        for (unsigned int k = 0; k < tableau.s; ++k)
          mode += tableau.b(k) * tableau.p(k) * stages[k].state_rates[i];
        largest_states[i] = std::max({largest_states[i],
                                      std::abs(state.states[i]),
                                      std::abs(stages.back().states[i]),
                                      system.model.states[i].scale});
        if (const double part = factor * std::abs(mode) / largest_states[i]; part > most)
          {
            worst = i;
            most  = part;
          }
      }
    return worst;
  }



  Vector6
  StageIntegrator::highest_mode(const std::vector<double> &start, const unsigned int node, const double h) const
  {
    const Eigen::Map<const Vector6> y_start(&start[6 * node]);
    Vector6                         u = Vector6::Zero();
    for (unsigned int k = 0; k < tableau.s; ++k)
      u += mode_weights(k) / h * (Eigen::Map<const Vector6>(&stages[k].y[6 * node]) - y_start);
    return u;
  }



  void
  StageIntegrator::find_worst(StepResult &result) const
  {
    const Layout      &layout  = system.layout;
    const unsigned int n_nodal = 6 * (layout.n_nodes - 1);
    double             most    = -1;
    const auto         see = [&](const double *r, const double *rates, const unsigned int n, const unsigned int first) {
      if (n == 0)
        return;
      // the largest one by vector instructions; where it is, only if it is larger than what there was
      const auto work = Eigen::Map<const Eigen::ArrayXd>(r, n) * Eigen::Map<const Eigen::ArrayXd>(rates, n);
      if (!(work.abs().maxCoeff() > most))
        return;
      unsigned int at = 0;
      most            = work.abs().maxCoeff(&at);
      result.worst    = first + at;
    };
    for (const Stage &stage : stages)
      {
        see(stage.residual.data(), stage.y.data() + 6, n_nodal, 0);
        see(stage.residual.data() + n_nodal, stage.rates.data(), stage.rates.size(), n_nodal);
      }
    // of the constraints that act on the node, or on the coordinate, the one that has to transmit most
    const unsigned int first = result.worst < n_nodal ? result.worst / 6 * 6 : result.worst,
                       end   = result.worst < n_nodal ? first + 6 : first + 1;
    double largest           = 0;
    result.worst_constraint  = -1;
    for (unsigned int j = first; j < end; ++j)
      for (int k = layout.pattern->column_start[j]; k < layout.pattern->column_start[j + 1]; ++k)
        if (const int i = layout.pattern->rows[k] - layout.of_multiplier(0); i >= 0 && is_active[i])
          for (const Stage &stage : stages)
            if (const double force = std::abs(stage.multipliers[i]); force > largest)
              {
                largest                 = force;
                result.worst_constraint = i;
              }
  }



  const std::vector<double> &
  StageIntegrator::admissible_velocities(const State &state)
  {
    // The velocities at the end of a step violate constraints by O(h^s), those of stages do not: from one to the other
    // is a jump, however small the step. It says nothing of its accuracy.
    admissible = state;
    if (system.layout.n_multipliers > 0)
      {
        if (!projection)
          projection = std::make_unique<Projection>(system);
        try
          {
            projection->velocities(admissible);
          }
        catch (const SingularMatrix &)
          {
            // something without mass moves freely: left as it is
          }
      }
    return admissible.y;
  }
} // namespace samara
