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
    return M_PI * kappa * std::pow(Y, s - 0.5) * std::sqrt(alpha * alpha + std::pow(phase(), 2) * Y);
  }



  double
  DissipationRelation::phase() const
  {
    return 0.5 * (1. / (2 * s + 1) + alpha * alpha / (2. * s - 1));
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
    , Y_guard(relation.inverse_period_error(settings.guard))
    , zeta_guard(relation.value(Y_guard))
    , settings(settings)
    , order(tableau.alpha < 0.1 ? 2 * tableau.s : 2 * tableau.s - 1)
  {
    if (!(settings.tolerance > 0 && settings.tolerance < 1))
      throw std::invalid_argument("the tolerance of the steps lies between 0 and 1");
    if (!(settings.smallest_step > 0 && settings.smallest_step <= settings.largest_step))
      throw std::invalid_argument("the smallest step is positive, and not larger than the largest");
    if (!(settings.duration > 0 && settings.length > 0 && settings.guard > 0 && settings.worth_a_change >= 1))
      throw std::invalid_argument("a step control has a positive duration, length and guard");
    size = settings.length;
  }



  std::vector<double>
  StepController::memory() const
  {
    return {E_ref, size, last_c, last_ratio, cap};
  }



  void
  StepController::set_memory(const std::vector<double> &memory)
  {
    E_ref      = memory[0];
    size       = memory[1];
    last_c     = memory[2];
    last_ratio = memory[3];
    cap        = memory[4];
  }



  void
  StepController::update(const double energy, const double displacement)
  {
    E_ref = std::max(E_ref, energy);
    size  = std::max(size, displacement);
  }



  double
  StepController::by_error(const double error, const double h, double &c) const
  {
    // half of the share of this step is aimed at: c = 1, and c = 2 is what it may have
    c            = std::max(2 * error * settings.duration / (settings.tolerance * size * h), 1e-12);
    double ratio = std::pow(c, -1. / order);
    if (c <= 2 && ratio > 0.97 && ratio < settings.worth_a_change)
      return 1; // the factorisation can be kept
    if (c <= 2 && last_c > 0)
      ratio = std::pow(c * last_c, -0.25 / order) * std::pow(last_ratio, -0.25); // H211b, b = 4
    return std::max(1 + std::atan(ratio - 1), 0.2); // a smooth limit above; one estimate alone never asks for less
  }



  StepController::Decision
  StepController::decide(const Judged &step, const double h)
  {
    double       c         = 0;
    const double of_errors = by_error(step.error, h, c);
    last_share             = c / 2;

    // nothing dissipated: nothing to resolve, whatever the reference. h ~ √Y, and 0.9 of it so that the next step is
    // not refused for a little more; where Y is large the relation says little, so that the change is limited
    const double zeta     = step.indicator == 0 ? 0. : step.indicator / E_ref;
    const double of_guard = std::clamp(0.9 * std::sqrt(Y_guard / relation.inverse(zeta)), 0.3, 2.);

    // contact: N/E ~ h^2.5 where a stop is touched or left within the step, so h ~ defect^−0.4; rejected from three
    // times what is aimed at
    const double defect    = step.work_defect == 0 ? 0. : step.work_defect / E_ref / settings.tolerance;
    const bool   resolves  = defect <= 3;
    const double of_defect = std::max(0.2, (resolves ? 0.9 : 0.8) * std::pow(defect, -0.4));

    const double ratio = std::min({of_errors, of_guard, of_defect});
    const bool   good  = c <= 2 && resolves && zeta <= 2 * zeta_guard;
    Decision     decision;
    decision.accept = good || h <= settings.smallest_step;
    cap *= 1.05; // a length that failed is approached again in about five steps
    // corrections that hardly shrink: half of the length would take half of the iterations or less
    constexpr unsigned int many_iterations = 30;
    if (step.iterations > many_iterations)
      cap = std::min(cap, 0.9 * h);
    decision.next_h = std::clamp(std::min(ratio * h, cap), settings.smallest_step, settings.largest_step);
    last_c          = good ? c : 0;
    last_ratio      = good ? decision.next_h / h : 1;
    if (!decision.accept)
      ++n_rejections;
    else if (!good)
      ++n_forced;
    return decision;
  }



  double
  StepController::after_failure(const double h)
  {
    ++n_failures;
    // for some steps: what has failed would fail again; and where the limit itself failed, what has a solution shrinks
    cap    = (h >= 0.99 * cap ? 0.6 : 0.8) * h;
    last_c = 0;
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
