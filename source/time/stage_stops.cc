#include <samara/time/stage_stops.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  StepGaps::StepGaps(const Tableau &t, const double start, const double *const rates, const double h)
    : start(start)
    , end(start)
    , most(start)
    , by_rates(true)
  {
    for (unsigned int k = 0; k < t.s; ++k)
      {
        stage[k] = start;
        for (unsigned int l = 0; l < t.s; ++l)
          stage[k] += h * t.a(k, l) * rates[l];
        change += h * t.b(k) * rates[k];
        most = std::max(most, stage[k]);
      }
    end  = start + change;
    most = std::max(most, end);
  }



  StepGaps::StepGaps(const Tableau      &t,
                     const double        start,
                     const double *const stages,
                     const double        end,
                     const double *const rates,
                     const double        h)
    : start(start)
    , end(end)
    , most(std::max(start, end))
  {
    for (unsigned int k = 0; k < t.s; ++k)
      {
        stage[k] = stages[k];
        change += h * t.b(k) * rates[k];
        most = std::max(most, stage[k]);
      }
  }



  bool
  StepGaps::is_touched_all_the_time(const Tableau &t) const
  {
    double least = std::min(start, end);
    for (unsigned int k = 0; k < t.s; ++k)
      least = std::min(least, stage[k]);
    return least >= 0;
  }



  namespace
  {
    void
    add_elastic_forces(const ContactLaw   &law,
                       const Tableau      &t,
                       const StepGaps     &gaps,
                       const double *const r,
                       const double        h,
                       StopForces         &result)
    {
      std::array<double, 3> spring{}, slope{};
      for (unsigned int k = 0; k < t.s; ++k)
        {
          slope[k]  = law.slope(gaps.stage[k]);
          spring[k] = law.force(gaps.stage[k]);
        }
      for (unsigned int k = 0; k < t.s; ++k)
        {
          result.force[k] = spring[k];
          for (unsigned int l = 0; l < t.s; ++l)
            result.slope[k][l] = h * t.a(k, l) * slope[k];
          result.elastic += h * t.b(k) * spring[k] * r[k];
        }
      // the energy of a linear spring that never leaves is exact without correction: b_k a_kl + b_l a_lk = b_k b_l
      if (gaps.by_rates && law.exponent == 1 && !law.expression && gaps.is_touched_all_the_time(t))
        return;

      // τ = Σ b (U'_m − U'_k) ġ_k / Σ b ġ_k² along the rates makes the work that of the potential, whatever the step
      // (doc/theory/joints.md, stops); below, its derivatives by the rates, on which gaps depend, too
      const ContactLaw::Mean mean    = law.mean(gaps.start, gaps.end);
      double                 squares = 0, power = 0, rate = 0;
      for (unsigned int k = 0; k < t.s; ++k)
        {
          squares += t.b(k) * r[k] * r[k];
          rate += t.b(k) * r[k];
          power += t.b(k) * (mean.force - spring[k]) * r[k];
        }
      result.work_defect = h * power;
      result.elastic += h * power;
      if (!(squares > 0))
        return;
      const double tau = power / squares;
      for (unsigned int l = 0; l < t.s; ++l)
        {
          double change = t.b(l) * (mean.force - spring[l]) + h * t.b(l) * rate * mean.slope;
          for (unsigned int k = 0; k < t.s; ++k)
            change -= t.b(k) * r[k] * h * t.a(k, l) * slope[k];
          const double change_of_tau = (change - 2 * tau * t.b(l) * r[l]) / squares;
          for (unsigned int k = 0; k < t.s; ++k)
            result.slope[k][l] += change_of_tau * r[k];
          result.slope[l][l] += tau;
          result.force[l] += tau * r[l];
        }
    }



    void
    add_damper(const ContactLaw   &law,
               const Tableau      &t,
               const StepGaps     &gaps,
               const double *const r,
               const double        h,
               StopForces         &result)
    {
      // c_s ġ_k min(1, g_k/|g_f − g_i|), and the part that grows with the force of the spring
      const double way = std::abs(gaps.change), direction = gaps.change > 0 ? 1. : -1.;
      for (unsigned int k = 0; k < t.s; ++k)
        {
          const double gap = gaps.stage[k];
          if (!(gap > 0))
            continue;
          const bool   begins   = gap < way;
          const double fraction = begins ? gap / way : 1., c = law.damping * fraction + law.factor * law.force(gap),
                       force = c * r[k];
          if (result.force[k] + std::min(force, 0.) < 0 && force < 0)
            {
              // it would pull: what is left of the spring is lost
              const double cut = -std::max(result.force[k], 0.);
              result.loss += h * t.b(k) * cut * r[k];
              if (cut < 0)
                {
                  result.force[k] = 0;
                  result.slope[k] = {};
                }
              continue;
            }
          result.force[k] += force;
          result.loss += h * t.b(k) * force * r[k];
          result.slope[k][k] += c;
          const double of_gap = law.factor * law.slope(gap) * r[k];
          for (unsigned int l = 0; l < t.s; ++l)
            result.slope[k][l] += of_gap * h * t.a(k, l);
          if (begins)
            for (unsigned int l = 0; l < t.s; ++l)
              result.slope[k][l] += law.damping * r[k] * h * (t.a(k, l) - fraction * direction * t.b(l)) / way;
        }
    }
  } // namespace



  StopForces
  stop_forces(const Layout::Stop &stop, const Tableau &tableau, const double gap, const double *rates, const double h)
  {
    return contact_forces(stop.law, tableau, StepGaps(tableau, gap, rates, h), rates, h);
  }



  StopForces
  contact_forces(const ContactLaw   &law,
                 const Tableau      &tableau,
                 const StepGaps     &gaps,
                 const double *const rates,
                 const double        h)
  {
    StopForces result;
    result.is_touched = gaps.is_touched();
    if (!result.is_touched)
      return result;
    result.depth = gaps.most;
    add_elastic_forces(law, tableau, gaps, rates, h, result);
    if (law.has_damping())
      add_damper(law, tableau, gaps, rates, h, result);
    return result;
  }



  namespace
  {
    /** The gap at the fraction @p x of a step: the integral of the polynomial through the rates of the stages. */
    double
    gap_at(const Tableau &t, const double gap, const double *const rates, const double h, const double x)
    {
      // two Gauss points are exact for rates up to the third degree
      double sum = gap;
      for (const double point : {0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)})
        for (unsigned int l = 0; l < t.s; ++l)
          {
            double L = 1;
            for (unsigned int j = 0; j < t.s; ++j)
              if (j != l)
                L *= (point * x - t.c(j)) / (t.c(l) - t.c(j));
            sum += 0.5 * h * x * L * rates[l];
          }
      return sum;
    }
  } // namespace



  void
  add_touches(const unsigned int  stop,
              const Tableau      &t,
              const double        gap,
              const double       *rates,
              const double        time,
              const double        h,
              std::vector<Touch> &touches)
  {
    double left = 0, gap_left = gap;
    for (unsigned int k = 0; k <= t.s; ++k)
      {
        const double right = k < t.s ? t.c(k) : 1., gap_right = gap_at(t, gap, rates, h, right);
        if ((gap_left > 0) != (gap_right > 0))
          {
            double low = left, high = right;
            for (unsigned int i = 0; i < 50; ++i)
              {
                const double middle                                                     = 0.5 * (low + high);
                ((gap_at(t, gap, rates, h, middle) > 0) == (gap_left > 0) ? low : high) = middle;
              }
            touches.push_back({stop, time + h * high, gap_right > 0});
          }
        left     = right;
        gap_left = gap_right;
      }
  }
} // namespace samara
