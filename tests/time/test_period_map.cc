/*
 * Problem:   the derivative of a motion over some steps, with velocities made admissible in between
 * Reference: central differences of sixth order of the motion
 */

#include <samara/time/period_map.h>

#include "../states/scenes.h"

#include <cmath>
#include <random>

#include "systems.h"

using namespace samara;

namespace
{
  PeriodSettings
  some_steps(const double h, const unsigned int n_steps)
  {
    PeriodSettings settings;
    settings.period           = n_steps * h;
    settings.n_steps          = n_steps;
    settings.n_stages         = 2;
    settings.newton_tolerance = 1e-14;
    return settings;
  }



  /** Largest difference of images over the largest number of the kind. */
  double
  distance_of_images(const System &system, const std::vector<double> &a, const std::vector<double> &b)
  {
    const std::vector<double> scales = scales_of_increment(system, 1);
    double                    worst  = 0;
    const unsigned int        middle = system.layout.of_multiplier(0);
    for (const bool velocities : {false, true})
      {
        double difference = 0, size = 0;
        for (unsigned int i = velocities ? middle : 0; i < (velocities ? a.size() : middle); ++i)
          {
            difference = std::max(difference, std::abs(a[i] - b[i]) / scales[i]);
            size       = std::max(size, std::abs(b[i]) / scales[i]);
          }
        worst = std::max(worst, difference / size);
      }
    return worst;
  }



  /** By motions that begin up to 3 @p epsilon x away from @p start. */
  std::vector<double>
  by_differences(const System              &system,
                 PeriodMap                 &map,
                 const State               &start,
                 const std::vector<double> &x,
                 const double               epsilon)
  {
    const double        weights[] = {0.75, -0.15, 1. / 60};
    const State         end       = map.march(start);
    std::vector<double> result(x.size(), 0.);
    for (int j = 1; j <= 3; ++j)
      for (const int side : {1, -1})
        {
          const auto there = increment(system, end, map.march(moved(system, start, x.data(), side * j * epsilon)));
          for (unsigned int i = 0; i < x.size(); ++i)
            result[i] += side * weights[j - 1] / epsilon * there[i];
        }
    return result;
  }



  void
  compare_map(const System &system, const State &begin, const double h, const double bound)
  {
    // an increment that constraints allow
    PeriodMap                              first(system, some_steps(h, 1));
    const State                            start = first.linearize(begin);
    std::mt19937                           generator(11);
    std::uniform_real_distribution<double> number(-1., 1.);
    std::vector<double>                    x(first.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = number(generator) * (i < first.first_velocity() ? h : 1.);
    first.apply(x.data());

    PeriodMap map(system, some_steps(h, 4));
    map.linearize(start);
    std::vector<double> image = x;
    map.apply(image.data());
    std::vector<double> carried = x;
    map.carry(start, carried.data());
    EXPECT_LT(distance_of_images(system, carried, image), 1e-8);
    EXPECT_EQ(map.n_applied, 8u);
    EXPECT_EQ(map.states().size(), 5u);
    double best = 1;
    for (const double epsilon : {3e-3, 3e-4, 3e-5})
      try
        {
          best = std::min(best, distance_of_images(system, image, by_differences(system, map, start, x, epsilon)));
        }
      catch (const NotConverged &)
        {} // too far away
    EXPECT_LT(best, bound);
  }
} // namespace



TEST(PeriodMap, IsTheDerivativeOfTheMotion)
{
  for_all_systems([](const MovingSystem &what, const System &system, const State &start) {
    SCOPED_TRACE(what.name);
    compare_map(system, start, what.h, 1e-8);
  });
  for (const auto &text : {oscillator_with_lag(), top_with_controls()})
    {
      const Scene scene(text);
      State       start = scene.system.reference();
      scene.system.add_initial_velocities(start);
      Projection(scene.system).velocities(start);
      compare_map(scene.system, start, 0.02, 1e-9);
    }
}



TEST(PeriodMap, RefusesSettingsWithoutSense)
{
  const Scene scene(oscillator_with_lag());
  EXPECT_THROW(PeriodMap(scene.system, some_steps(0, 4)), std::invalid_argument);
  EXPECT_THROW(PeriodMap(scene.system, some_steps(0.1, 0)), std::invalid_argument);
}
