#include <samara/report/writing_pace.h>

#include <algorithm>
#include <limits>

namespace samara
{
  bool
  WritingPace::is_due(const Time &now) const
  {
    if (n == 0)
      return true;
    return now.wall >= last.wall + least_period && spent - first + next_cost(now.processor) <= share * now.processor;
  }



  double
  WritingPace::next_cost(const double processor) const
  {
    constexpr double first_page_is_empty = 20, most_growth = 2;
    if (n == 1)
      return first_page_is_empty * cost;
    return std::min(cost + growth * (processor - last_asks), most_growth * cost);
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
    constexpr double longest = 86400;
    if (n == 0)
      return least_period;
    // share t = spent - first + cost of the next, which is no more than that long after the last
    const double at               = (spent - first + next_cost(std::numeric_limits<double>::max())) / share,
                 walls_per_second = last.processor > 0 ? std::max(1., (last.wall - begun) / last.processor) : 1.;
    return std::clamp((at - last.processor) * walls_per_second, least_period, longest);
  }
} // namespace samara
