// Dry friction in the stages (doc/theory/contact.md): against the slip w_k of each stage,
//
//     f_k = −N_k c(|w_k|²) w_k,     so that the work in each stage is a loss, whatever N_k ≥ 0.
//
// The normal force of a stop is that of the stage. Multipliers of a single stage are good for three stages; for one and
// two their mean over the step is better.

#include <samara/time/stage_integrator.h>

#include <algorithm>
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
    for (unsigned int k = 0; k < s && n > 0; ++k)
      {
        // the reactions that count in this stage are Σ_l weight(l) λ_l
        const auto      weight   = [&](const unsigned int l) { return s < 3 ? tableau.b(l) : k == l ? 1. : 0.; };
        Eigen::VectorXd reaction = Eigen::VectorXd::Zero(n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int l = 0; l < s; ++l)
            reaction(i) += weight(l) * values[first + s * i + l];
        const double size = reaction.norm();
        normal[k] += size;
        for (unsigned int i = 0; i < n && slopes != nullptr && size > 0; ++i)
          for (unsigned int l = 0; l < s; ++l)
            (*slopes)(k, first + s * i + l) = reaction(i) / size * weight(l);
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



  void
  StageIntegrator::account_for_friction(const double h, StepResult &result) const
  {
    const auto &frictions = system.layout.frictions;
    result.creep.assign(frictions.size(), 0.);
    for (const Device &device : devices)
      if (device.is_friction)
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
