// Dry friction in the stages (doc/theory/contact.md): against the slip w_k of each stage,
//
//     f_k = −N_k c(|w_k|²) w_k,     so that the work in each stage is a loss, whatever N_k ≥ 0.
//
// The normal force of a stop is that of the stage. Multipliers of a single stage are good for three stages; for one and
// two their mean over the step is better. Of what slides along a beam they are those across it, as it is in the stages;
// a guide with a length is pressed at both of its ends (HasPressing).
//
// Bristles (stage_bristles.h) have states of first order, which follow from the slips: they are set, not solved for.

#include <samara/model/pressing.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace samara
{
  /** N_k, and if wanted ∂N_k by the values of all ports in all stages. */
  void
  StageIntegrator::normal_forces(const Device    &device,
                                 const double    *values,
                                 const double     h,
                                 double          *normal,
                                 Eigen::MatrixXd *slopes) const
  {
    const Layout::Friction &friction = system.layout.frictions[device.number];
    const unsigned int      s = tableau.s, first = s * friction.coordinates.size();
    std::fill_n(normal, s, friction.preload);
    if (friction.stop >= 0)
      {
        const StopForces f =
          stop_forces(system.layout.stops[friction.stop], tableau, gaps[friction.stop], values + first, h);
        for (unsigned int k = 0; k < s; ++k)
          if (f.force[k] > 0)
            {
              normal[k] += f.force[k];
              for (unsigned int l = 0; l < s && slopes != nullptr; ++l)
                (*slopes)(k, first + l) = f.slope[k][l];
            }
      }
    const unsigned int n = friction.multipliers.size();
    if (n == 0)
      return;
    std::array<PressingParts<double>, 3> parts; // of each stage: what of its reactions presses, and where
    for (unsigned int k = 0; k < s; ++k)
      parts[k] = device.pressing != nullptr ? device.pressing->pressing_parts(friction, stages[k].point()) :
                                              PressingParts<double>(n);
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int p = 0; p < parts[k].n; ++p)
        {
          // the reactions that count in this stage are Σ_l weight(l) λ_l
          const auto weight   = [&](const unsigned int l) { return s < 3 ? tableau.b(l) : k == l ? 1. : 0.; };
          Vector3    reaction = Vector3::Zero();
          for (unsigned int l = 0; l < s; ++l)
            for (unsigned int i = 0; i < n; ++i)
              reaction += weight(l) * values[first + s * i + l] * parts[l].of[p].col(i);
          const double size = reaction.norm();
          normal[k] += size;
          for (unsigned int l = 0; l < s && slopes != nullptr && size > 0; ++l)
            for (unsigned int i = 0; i < n; ++i)
              (*slopes)(k, first + s * i + l) += weight(l) / size * parts[l].of[p].col(i).dot(reaction);
        }
  }



  void
  StageIntegrator::friction_forces(const Device               &device,
                                   const double               *values,
                                   const double                h,
                                   Eigen::Ref<Eigen::VectorXd> force,
                                   Eigen::MatrixXd            *slopes) const
  {
    const Layout::Friction &friction = system.layout.frictions[device.number];
    const unsigned int      s = tableau.s, n_slips = friction.coordinates.size(), n = s * device.n_ports;
    const double            arm = friction.arm;
    double                  normal[3];
    Eigen::MatrixXd         of_normal;
    if (slopes != nullptr)
      of_normal.setZero(s, n);
    normal_forces(device, values, h, normal, slopes != nullptr ? &of_normal : nullptr);
    force.setZero();
    if (!friction.states.empty())
      {
        const BristleForces f   = bristles_of(device, values, normal, h, slopes != nullptr);
        force.head(s * n_slips) = arm * f.force;
        if (slopes != nullptr)
          {
            slopes->topRows(s * n_slips) = arm * f.by_normal * of_normal;
            slopes->topLeftCorner(s * n_slips, s * n_slips) += arm * arm * f.by_slip;
          }
        return;
      }
    for (unsigned int k = 0; k < s; ++k)
      {
        double square = 0;
        for (unsigned int i = 0; i < n_slips; ++i)
          square += std::pow(arm * values[s * i + k], 2);
        const auto law = friction.law(square);
        for (unsigned int i = 0; i < n_slips; ++i)
          {
            const double slip = arm * values[s * i + k];
            force(s * i + k)  = arm * normal[k] * law.c * slip;
            if (slopes == nullptr)
              continue;
            slopes->row(s * i + k) += arm * law.c * slip * of_normal.row(k);
            for (unsigned int j = 0; j < n_slips; ++j)
              (*slopes)(s * i + k, s * j + k) +=
                arm * arm * normal[k] * (2 * law.slope * slip * arm * values[s * j + k] + (i == j ? law.c : 0.));
          }
      }
  }



  BristleForces
  StageIntegrator::bristles_of(const Device &device,
                               const double *values,
                               const double *normal,
                               const double  h,
                               const bool    with_slopes) const
  {
    const Layout::Friction &friction = system.layout.frictions[device.number];
    Eigen::VectorXd         start(friction.states.size()), slips(tableau.s * friction.states.size());
    for (unsigned int i = 0; i < start.size(); ++i)
      start(i) = states_at_start[friction.states[i]];
    for (unsigned int i = 0; i < slips.size(); ++i)
      slips(i) = friction.arm * values[i];
    return bristle_forces(friction.law, tableau, start, slips, normal, h, with_slopes);
  }



  BristleForces
  StageIntegrator::bristles_now(const Device &device, const double h) const
  {
    const double *const values = port_values(device);
    double              normal[3];
    normal_forces(device, values, h, normal, nullptr);
    return bristles_of(device, values, normal, h, false);
  }



  void
  StageIntegrator::move_bristles(const double h)
  {
    for (const Device &device : devices)
      {
        if (!device.is_friction || system.layout.frictions[device.number].states.empty())
          continue;
        const auto         &numbers = system.layout.frictions[device.number].states;
        const BristleForces f       = bristles_now(device, h);
        for (unsigned int i = 0; i < numbers.size(); ++i)
          for (unsigned int k = 0; k < tableau.s; ++k)
            {
              Stage &stage                                       = stages[k];
              stage.states[numbers[i]]                           = f.deflection(tableau.s * i + k);
              stage.state_rates[numbers[i]]                      = f.rate(tableau.s * i + k);
              stage.residual[system.layout.of_state(numbers[i])] = 0;
            }
      }
  }



  void
  StageIntegrator::account_for_friction(const double h, StepResult &result) const
  {
    const auto &frictions = system.layout.frictions;
    result.creep.assign(frictions.size(), 0.);
    for (const Device &device : devices)
      if (device.is_friction && !frictions[device.number].states.empty())
        {
          const BristleForces f = bristles_now(device, h);
          result.friction_loss += f.loss;
          result.work_of_loads -= f.elastic; // a potential
          result.dissipated += f.dissipated;
        }
      else if (device.is_friction)
        for (unsigned int k = 0; k < tableau.s; ++k)
          {
            const Layout::Friction &friction = frictions[device.number];
            double                  square = 0, power = 0;
            for (unsigned int i = 0; i < friction.coordinates.size(); ++i)
              {
                const double rate = port_value(ports[device.first_port + i], k);
                square += std::pow(friction.arm * rate, 2);
                power += rate * device_forces_now(tableau.s * (device.first_port + i) + k);
              }
            result.friction_loss += h * tableau.b(k) * power;
            if (power > 0 && std::sqrt(square) < FrictionLaw::creeping * friction.law.sticking_speed)
              result.creep[device.number] += h * tableau.b(k) * std::sqrt(square);
          }
  }
} // namespace samara
