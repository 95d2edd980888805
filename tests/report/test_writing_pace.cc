/*
 * Problem:   how often a page is written while a run goes on, whose writing costs more and more, or the same, or jumps
 * Reference: counted seconds of the processor: a hundredth of the run's at most, at any time; two seconds between pages
 */

#include <samara/report/writing_pace.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace samara;

namespace
{
  struct Pages
  {
    unsigned int n           = 0;
    double       largest     = 0; ///< share behind the first page
    double       least_pause = HUGE_VAL;
  };

  /** A run of so many seconds in steps of a millisecond, on a processor that it has a part of only. */
  template <typename Cost>
  Pages
  run_of(const double seconds, const double part_of_processor, const Cost &cost_at)
  {
    WritingPace       pace;
    WritingPace::Time now{1000, 0.05};
    Pages             run;
    double            last = 0;
    while (now.processor < seconds)
      {
        now.processor += 1e-3;
        now.wall += 1e-3 / part_of_processor;
        if (!pace.may_be_due(now.wall) || !pace.is_due(now))
          continue;
        if (run.n > 0)
          run.least_pause = std::min(run.least_pause, now.wall - last);
        const WritingPace::Time begin = now;
        const double            cost  = cost_at(now.processor);
        now.processor += cost;
        now.wall += cost / part_of_processor;
        pace.wrote(begin, now);
        last = now.wall;
        ++run.n;
        EXPECT_EQ(run.n, pace.n);
        if (run.n > 1)
          run.largest = std::max(run.largest, (pace.spent - pace.first) / now.processor);
        EXPECT_GE(pace.period(), WritingPace::least_period);
      }
    return run;
  }
} // namespace



TEST(WritingPace, AHundredthOfTheRunAtMost)
{
  const auto constant = run_of(600, 1, [](double) { return 0.05; });
  const auto growing  = run_of(200, 1, [](const double t) { return 0.004 + 1e-3 * t; });
  const auto bounded  = run_of(200, 0.4, [](const double t) { return std::min(0.08, 0.003 * t); });
  const auto square   = run_of(200, 1, [](const double t) { return 0.02 + 0.02 * std::sqrt(t); });
  for (const Pages &run : {constant, growing, bounded, square})
    {
      EXPECT_LE(run.largest, WritingPace::share * (1 + 1e-9));
      EXPECT_GE(run.least_pause, WritingPace::least_period);
    }
  // the second after 100 s, since it might cost twenty times as much, then as often as that allows: those that were
  // saved until then, one after the other, and one in 5 s
  EXPECT_GE(constant.n, 600 / 5 - 2);
  EXPECT_LE(constant.n, 600 / 5 + 2);
  EXPECT_GE(growing.n, 10u);
  EXPECT_GE(bounded.n, 20u);
  EXPECT_GE(square.n, 3u);
}



TEST(WritingPace, PagesThatCostNothingComeEveryTwoSeconds)
{
  const auto free = run_of(100, 1, [](double) { return 1e-4; });
  EXPECT_NEAR(free.n, 50, 2);
  // what costs two hundredths of all that it shows is written seldom
  const auto dear = run_of(300, 1, [](const double t) { return 0.02 * t; });
  EXPECT_LE(dear.n, 6u);
  EXPECT_LE(dear.largest, 0.03);
}
