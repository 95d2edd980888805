#include <samara/base/errors.h>
#include <samara/time/step_control.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace samara
{
  DissipationRelation::DissipationRelation(const Tableau &tableau)
    : s(tableau.s)
    , alpha(tableau.alpha)
  {
    const double square = alpha * alpha, last = (1 + alpha) * (1 + alpha);
    switch (s)
      {
        case 1:
          kappa = 1;
          d     = {{last / 4}};
          break;
        case 2:
          kappa = 1. / 36;
          d     = {{(3 + square) / 36, last / 144}};
          break;
        default:
          kappa = 1. / 3600;
          d     = {{(5 + square) / 100, (2 + square) / 1200, last / 14400}};
      }
  }



  double
  DissipationRelation::value(const double Y) const
  {
    // in X = 1/Y: ζ = κ/(Xˢ + d₁ Xˢ⁻¹ + … + d_s)
    double denominator = 1;
    for (unsigned int j = 0; j < s; ++j)
      denominator = denominator / Y + d[j];
    return kappa / denominator;
  }



  double
  DissipationRelation::inverse(const double zeta) const
  {
    if (zeta < std::numeric_limits<double>::min())
      return 0;
    // Xˢ + … + d_{s−1} X = κ/ζ − d_s has one positive root if the right side is positive
    const double r = kappa / zeta - d[s - 1];
    if (!(r > 0))
      return std::numeric_limits<double>::infinity();
    if (s == 1)
      return 1 / r;
    if (s == 2)
      return (d[0] + std::sqrt(d[0] * d[0] + 4 * r)) / (2 * r);
    // the left side is increasing and convex: from above, Newton's method comes down to the root without overshooting
    double X = std::min({std::cbrt(r), std::sqrt(r / d[0]), r / d[1]});
    for (double change = X; change > 1e-15 * X; X -= change)
      change = (((X + d[0]) * X + d[1]) * X - r) / ((3 * X + 2 * d[0]) * X + d[1]);
    return 1 / X;
  }



  double
  DissipationRelation::period_error(const double Y) const
  {
    const double phi = 0.5 * (1. / (2 * s + 1) + alpha * alpha / (2. * s - 1));
    return M_PI * kappa * std::pow(Y, s - 0.5) * std::sqrt(alpha * alpha + phi * phi * Y);
  }



  double
  DissipationRelation::inverse_period_error(const double error) const
  {
    // ε lies between two powers of Y, s − 1/2 and s: each round halves the error of log Y or does better
    double Y = 1;
    for (unsigned int i = 0; i < 60; ++i)
      Y *= std::pow(error / period_error(Y), 1. / s);
    return Y;
  }



  StepController::StepController(const Tableau &tableau, const Settings &settings)
    : relation(tableau)
    , Y_target(relation.inverse_period_error(settings.tolerance))
    , zeta_target(relation.value(Y_target))
    , settings(settings)
  {
    if (!(settings.tolerance > 0 && settings.tolerance < 1))
      throw std::invalid_argument("the tolerance of the steps lies between 0 and 1");
    if (!(settings.smallest_step > 0 && settings.smallest_step <= settings.largest_step))
      throw std::invalid_argument("the smallest step is positive, and not larger than the largest");
    if (!(settings.safety > 0 && settings.safety <= 1 && settings.least_ratio > 0 && settings.least_ratio < 1 &&
          settings.largest_ratio > 1 && settings.reject_factor >= 1))
      throw std::invalid_argument("a step control has a safety up to 1, a least ratio below 1, a largest ratio above 1 "
                                  "and a reject factor from 1");
  }



  std::array<double, 3>
  StepController::memory() const
  {
    return {{E_ref, double(hold), last_ratio}};
  }



  void
  StepController::set_memory(const std::array<double, 3> &memory)
  {
    E_ref      = memory[0];
    hold       = static_cast<unsigned int>(memory[1]);
    last_ratio = memory[2];
  }



  void
  StepController::update(const double energy)
  {
    E_ref = std::max(E_ref, energy);
  }



  StepController::Decision
  StepController::decide(const double indicator, const double work_defect, const double h)
  {
    // nothing dissipated: nothing to resolve, whatever the reference
    const double zeta   = indicator == 0 ? 0. : indicator / E_ref;
    const double wanted = settings.safety * std::sqrt(Y_target / relation.inverse(zeta));
    const double by_energy =
      std::clamp(wanted,
                 settings.least_ratio,
                 hold > 0 ? 1. : std::min(settings.largest_ratio, 1.2 * std::max(1., last_ratio)));
    last_ratio = wanted;

    // contact: N/E ~ h^2.5 where a stop is touched or left within the step
    const double defect    = work_defect == 0 ? 0. : work_defect / E_ref / settings.tolerance;
    const bool   resolves  = defect <= 3;
    const double of_defect = std::max(0.2, (resolves ? 0.9 : 0.8) * std::pow(defect, -0.4));
    const double ratio     = std::min(by_energy, of_defect);
    const bool   good      = resolves && zeta <= settings.reject_factor * zeta_target;

    Decision decision;
    decision.accept = good || h <= settings.smallest_step;
    decision.next_h = std::clamp(ratio * h, settings.smallest_step, settings.largest_step);
    if (decision.accept && std::max(ratio, 1 / ratio) < settings.worth_a_change)
      decision.next_h = h; // the factorisation can be kept
    if (!decision.accept)
      {
        ++n_rejections;
        hold = std::max(hold, 1u);
        return decision;
      }
    if (!good)
      ++n_forced;
    if (hold > 0)
      --hold;
    return decision;
  }



  double
  StepController::after_failure(const double h)
  {
    ++n_failures;
    hold = settings.patience;
    if (h <= settings.smallest_step)
      {
        std::ostringstream message;
        message << "the equations of a step cannot be solved with the smallest step, " << h
                << " s: allow smaller steps, or look for what jumps at this moment";
        throw NotConverged(message.str());
      }
    return std::max(h / 2, settings.smallest_step);
  }
} // namespace samara
