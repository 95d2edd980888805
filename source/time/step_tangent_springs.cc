// How what keeps the energy of nonlinear springs in a step changes: τ ḋ_k of stage_integrator_springs.cc, with
//
//     τ = P/S,     P = Σ b_k (F_m − F(d_k)) ḋ_k,     S = Σ b_k ḋ_k²
//
// F_m − F(d_k) is as small as the way of the spring, and so is the difference of its derivatives in the end. Both are
// found from integrals of F', so that they are exact to round-off where a spring hardly moves, as about a steady
// motion.

#include <samara/time/step_tangent.h>

namespace samara
{
  void
  StepTangent::add_springs(const double *x, const double *X, Vector &result) const
  {
    const Layout      &layout = system.layout;
    const unsigned int s = tableau.s, n = system.size();
    for (const auto &spring : layout.nonlinear_springs)
      {
        const int    row   = layout.of_coordinate(spring.coordinate);
        const double begin = start.coordinates[spring.coordinate] + spring.offset, d_begin = x != nullptr ? x[row] : 0.;
        double       way = 0, d_end = d_begin, squares = 0;
        const auto   rate   = [&](const unsigned int k) { return stages[k].rates[spring.coordinate]; };
        const auto   d_rate = [&](const unsigned int k) { return X[k * n + row]; };
        for (unsigned int k = 0; k < s; ++k)
          {
            way += h * tableau.b(k) * rate(k);
            d_end += h * tableau.b(k) * d_rate(k);
            squares += tableau.b(k) * rate(k) * rate(k);
          }
        if (!(squares > 0))
          continue; // τ ḋ is of second order
        const SpringLaw::MeanChange mean  = spring.law->mean_change(begin, way);
        double                      power = 0, d_power = 0, d_squares = 0;
        for (unsigned int k = 0; k < s; ++k)
          {
            // by the rates: of places that hardly differ too few digits would be left
            double way_to_stage = 0;
            for (unsigned int l = 0; l < s; ++l)
              way_to_stage += h * tableau.a(k, l) * rate(l);
            const double lack = mean.rise - spring.law->rise(begin, way_to_stage),
                         d_lack =
                           mean.by_from * d_begin + mean.by_to * d_end -
                           spring.law->stiffness(begin + way_to_stage) * change.coordinates[k][spring.coordinate];
            power += tableau.b(k) * lack * rate(k);
            d_power += tableau.b(k) * (d_lack * rate(k) + lack * d_rate(k));
            d_squares += 2 * tableau.b(k) * rate(k) * d_rate(k);
          }
        const double tau = power / squares, d_tau = (d_power - tau * d_squares) / squares;
        for (unsigned int k = 0; k < s; ++k)
          result[k * n + row] += d_tau * rate(k) + tau * d_rate(k);
      }
  }
} // namespace samara
