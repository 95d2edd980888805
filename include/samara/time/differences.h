#ifndef samara_time_differences_h
#define samara_time_differences_h

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace samara
{
  /** Derivatives by time of what is known at any time, by central differences. */
  namespace differences
  {
    using Values = std::vector<double>;

    inline double
    largest_of(const Values &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }



    /** The derivative of @p f at zero by central differences of fourth order. */
    template <typename Function>
    Values
    difference(const double dt, const Function &f)
    {
      Values result;
      for (const auto &[steps, weight] : std::array<std::pair<double, double>, 4>{{{-2, 1}, {-1, -8}, {1, 8}, {2, -1}}})
        {
          const Values values = f(steps * dt);
          result.resize(values.size());
          for (std::size_t i = 0; i < values.size(); ++i)
            result[i] += weight * values[i] / (12 * dt);
        }
      return result;
    }



    /**
     * The same where the scale of @p f is not known, nor whether it has a corner nearby: from very short times to
     * @p longest, and of each value the difference that changes least from one to the next. Before that there is
     * round-off, of values and of @p time; behind it truncation, where differences of a fast oscillation look alike
     * once more, so that nothing is believed any longer once they have changed. @p terms is the size of what @p f is a
     * sum of.
     */
    template <typename Function>
    Values
    limit_of_differences(const double longest, const double time, const double terms, const Function &f)
    {
      constexpr unsigned int n_differences = 12;
      constexpr double       longer = 10, round_off = 1e-15, has_changed = 30;
      double                 dt   = longest * std::pow(longer, 1. - n_differences);
      Values                 last = difference(dt, f), best = last;
      Values                 least(best.size(), std::numeric_limits<double>::infinity());
      std::vector<bool>      is_found(best.size(), false);
      for (unsigned int i = 1; i < n_differences; ++i)
        {
          const double size = std::max(terms, largest_of(f(dt)));
          const double part = round_off * std::abs(time) / dt;
          dt *= longer;
          Values next = difference(dt, f);
          for (std::size_t j = 0; j < next.size(); ++j)
            {
              const double change =
                std::max(std::abs(next[j] - last[j]), round_off * size * longer / dt + part * std::abs(next[j]));
              is_found[j] = is_found[j] || change > has_changed * least[j];
              if (is_found[j] || !(change < least[j]))
                continue;
              least[j] = change;
              best[j]  = next[j];
            }
          last = std::move(next);
        }
      return best;
    }
  } // namespace differences
} // namespace samara

#endif
