#include <samara/report/writing_pace.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  bool
  WritingPace::is_due(const Time &now) const
  {
    if (n == 0)
      return true;
    const double next = next_cost() + growth * (now.processor - last_asks);
    return now.wall >= last.wall + least_period && spent - first + next <= share * now.processor;
  }



  void
  WritingPace::wrote(const Time &begin, const Time &end)
  {
    const double before = cost, passed = begin.processor - last_asks;
    cost   = end.processor - begin.processor;
    growth = n > 0 && passed > 0 ? std::max(0., cost - before) / passed : 0.;
    spent += cost;
    if (n == 0)
      {
        first = cost;
        begun = begin.wall;
      }
    last_asks = begin.processor;
    last      = end;
    ++n;
  }



  double
  WritingPace::period() const
  {
    constexpr double longest = 86400; // of costs that grow too fast nothing can be said
    if (n == 0)
      return least_period;
    // share t = spent - first + cost + growth (t - last_asks)
    const double at = growth < share ? (spent - first + next_cost() - growth * last_asks) / (share - growth) : HUGE_VAL,
                 walls_per_second = last.processor > 0 ? std::max(1., (last.wall - begun) / last.processor) : 1.;
    return std::clamp((at - last.processor) * walls_per_second, least_period, longest);
  }
} // namespace samara
