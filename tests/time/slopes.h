#ifndef samara_tests_time_slopes_h
#define samara_tests_time_slopes_h

#include <samara/time/tableau.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  /**
   * Whether the slopes of the forces of a contact by its rates at the stages are those of central differences, but for
   * @p share of the largest.
   */
  template <typename Sample>
  bool
  has_slopes(const Sample &sample, const Tableau &t, const double share)
  {
    const auto f       = sample.forces(t);
    double     largest = 0, error = 0, rate = 0;
    for (const double r : sample.rates)
      rate = std::max(rate, std::abs(r));
    for (unsigned int l = 0; l < t.s; ++l)
      {
        Sample forth = sample, back = sample;
        forth.rates[l] += 1e-6 * rate;
        back.rates[l] -= 1e-6 * rate;
        const auto f_forth = forth.forces(t), f_back = back.forces(t);
        for (unsigned int k = 0; k < t.s; ++k)
          {
            const double slope = (f_forth.force[k] - f_back.force[k]) / (2e-6 * rate);
            largest            = std::max(largest, std::abs(slope));
            error              = std::max(error, std::abs(slope - f.slope[k][l]));
          }
      }
    return error <= share * largest;
  }
} // namespace samara

#endif
