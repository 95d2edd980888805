#include <samara/analysis/period_of_rotors.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  double
  period_of_rotors(const Context &context)
  {
    constexpr double rounding = 1e-12;
    const auto      &speeds   = context.speeds;
    if (speeds.empty() || speeds[0] == 0 || !std::all_of(speeds.begin(), speeds.end(), [&](const double speed) {
          return std::abs(std::abs(speed) - std::abs(speeds[0])) <= rounding * std::abs(speeds[0]);
        }))
      return 0;
    return 2 * M_PI / std::abs(speeds[0]);
  }



  void
  find_period(double &period, const Parameters &parameters, const Context &context)
  {
    // an analysis without a file may have a period, too
    if (parameters.has("Period") ? !parameters.is_set("Period") : !(period > 0))
      period = period_of_rotors(context);
    if (!(period > 0))
      throw InputError(parameters.where("Period") +
                       ": the <Period> must be given: the model has no steady rotation that tells it, or several");
  }
} // namespace samara
