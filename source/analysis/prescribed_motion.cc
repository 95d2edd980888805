#include <samara/analysis/prescribed_motion.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Of rates, relative to them. */
    constexpr double equal_rates = 1e-9;
  } // namespace



  PrescribedMotion
  prescribed_beside(const System &system, const State &state, const std::vector<double> &times)
  {
    PrescribedMotion    result;
    const double        length = model_length(system.model);
    std::vector<double> rates(system.layout.n_multipliers), of_time(rates), first(rates);
    for (unsigned int i = 0; i < times.size(); ++i)
      {
        State later = moved_on(system, state, times[i]);
        later.time  = state.time + times[i];
        system.constraint_rates(later.point(), rates.data());
        system.constraint_time_rates(later.point(), of_time.data());
        if (i == 0)
          first = rates;
        for (const auto &[coordinate, row] : system.model.prescribed)
          {
            const double steady = std::abs(rates[row] - of_time[row]), smallest = equal_rates * std::abs(of_time[row]);
            const double beside = std::abs(rates[row] - (steady > smallest ? first[row] : 0.));
            const double rate   = beside / system.layout.scale_of(system.layout.of_coordinate(coordinate), length);
            if (beside > std::max(smallest, equal_rates * steady) && rate > result.rate)
              result = {system.model.coordinates[coordinate], rate};
          }
      }
    return result;
  }
} // namespace samara
