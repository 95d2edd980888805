#ifndef samara_tests_trim_turns_h
#define samara_tests_trim_turns_h

#include <samara/analysis/periodic_motion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace samara
{
  /**
   * The tangent of a turn from @p start, or of a section: what a random increment of the start changes at its end and
   * of the @p n_averages, against differences of fourth order of turns. Controls prescribe pitch, so that a change of
   * them violates constraints at the start.
   */
  inline void
  expect_tangent_of_differences(const System      &system,
                                PeriodicMotion    &motion,
                                const State       &start,
                                const unsigned int n_averages)
  {
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> number(-1., 1.);
    std::vector<double>                    x(motion.scales.size()), of_end(x.size(), 0.), of_averages(n_averages, 0.);
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = 0.02 * number(generator) * motion.scales[i];
    State middle = start;
    motion.turn(middle);
    motion.begin_again(start, middle);
    const double step = 2e-3;
    for (const auto &[side, weight] : {std::pair{1., 2. / 3}, {-1., -2. / 3}, {2., -1. / 12}, {-2., 1. / 12}})
      {
        State      end      = moved(system, start, x.data(), side * step);
        const auto averages = motion.turn(end);
        motion.begin_again(start, end);
        const auto change = increment(system, middle, end, true);
        for (unsigned int i = 0; i < x.size(); ++i)
          of_end[i] += weight / step * change[i];
        for (unsigned int k = 0; k < n_averages; ++k)
          of_averages[k] += weight / step * averages[k];
      }
    motion.linearize(start);
    const auto found = motion.apply(x.data());
    double     size = 0, error = 0;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        size  = std::max(size, std::abs(of_end[i]) / motion.scales[i]);
        error = std::max(error, std::abs(of_end[i] - x[i]) / motion.scales[i]);
      }
    EXPECT_LT(error, 1e-6 * size);
    ASSERT_EQ(found.size(), n_averages);
    for (unsigned int k = 0; k < n_averages; ++k)
      EXPECT_NEAR(found[k], of_averages[k], 1e-6 * std::abs(of_averages[k])) << k;
    EXPECT_EQ(motion.n_applied, 1u);
  }
} // namespace samara

#endif
