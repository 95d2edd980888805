#include <samara/analysis/prescribed_motion.h>
#include <samara/base/text.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace samara
{
  namespace
  {
    /** Of rates, relative to them. */
    constexpr double equal_rates = 1e-9;
    /** How far a shaft is looked at that may turn on and on. */
    constexpr double turns_to_look[] = {0.4, 1., 2.4};
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



  std::string
  about_stopped_rotor(const System &system, const State &state, const std::string &what)
  {
    if (!system.model.rotations.empty() || system.model.prescribed.empty())
      return "";
    State later         = state;
    later.held          = false;
    const auto rates_at = [&](const double time) {
      std::vector<double> rates(system.layout.n_multipliers);
      later.time = time;
      system.constraint_time_rates(later.point(), rates.data());
      return rates;
    };
    const auto now = rates_at(state.time);
    for (const auto &[coordinate, multiplier] : system.model.prescribed)
      {
        const unsigned int row   = multiplier;
        const double       speed = -now[row]; // of 0 = angle - law(t)
        if (system.model.coordinate_units[coordinate] != "rad" || speed == 0)
          continue;
        // the same after one turn and after more than two
        const double turn   = 2 * M_PI / std::abs(speed);
        const bool   is_law = std::all_of(std::begin(turns_to_look), std::end(turns_to_look), [&](const double n) {
          return std::abs(-rates_at(state.time + n * turn)[row] - speed) <= equal_rates * std::abs(speed);
        });
        if (!is_law)
          continue;
        const std::string name = system.model.coordinates[coordinate], number = number_to_text("%.6g", speed);
        return "<" + name + "> is prescribed to turn with " + number +
               " rad/s, and nothing is a steady rotation: " + what +
               " of a rotor that stands still. Add a load with Type = steady rotation, Joint = " +
               name.substr(0, name.rfind('.')) + ", Speed = " + number + " rad/s";
      }
    return "";
  }
} // namespace samara
