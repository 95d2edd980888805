// The tangent of a turn of a motion that is trimmed: of its end and of what its averages are.
//
// Reference: central differences of turns.

#include <samara/analysis/periodic_motion.h>
#include <samara/analysis/trim.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace samara;

namespace
{
  /** What an increment of the start changes at the end of a turn, and of the averages, by differences of order 4. */
  std::pair<std::vector<double>, std::vector<double>>
  differences(const System &system, PeriodicMotion &motion, const State &start, const std::vector<double> &x)
  {
    State middle = start;
    motion.turn(middle);
    std::vector<double> of_end(x.size(), 0.), of_averages;
    const double        step = 2e-3;
    for (const auto &[side, weight] : {std::pair{1., 2. / 3}, {-1., -2. / 3}, {2., -1. / 12}, {-2., 1. / 12}})
      {
        State      end      = moved(system, start, x.data(), side * step);
        const auto averages = motion.turn(end);
        const auto change   = increment(system, middle, end);
        of_averages.resize(averages.size(), 0.);
        for (unsigned int i = 0; i < x.size(); ++i)
          of_end[i] += weight / step * change[i];
        for (unsigned int k = 0; k < averages.size(); ++k)
          of_averages[k] += weight / step * averages[k];
      }
    return {of_end, of_averages};
  }
} // namespace



// Controls prescribe pitch, so that a change of them violates constraints at the start; inflow has states.
TEST(Turn, TangentOfAFlappingRotorInForwardFlight)
{
  Scene                            scene("prm/rotorcraft/flapping_rotor.prm",
              {"Aerodynamics/flow/Type = Pitt-Peters inflow", "Trim/Steps = 24", "Trim/Tolerance = 0.1"});
  const Model                     &model = scene.system.model;
  const double                     T     = 2 * M_PI / 30;
  const std::vector<PeriodAverage> averages{{PeriodAverage::mean, 0, model.probe("flow.thrust")},
                                            {PeriodAverage::cosine, 1, model.probe("blade 1:flap.rotation")},
                                            {PeriodAverage::sine, 2, model.probe("blade 2:flap.rotation")}};
  PeriodicMotion                   motion(scene.context, T, 24, {0.5, 1e-13, 50, 1e-4, 3}, averages);
  scene.analysis<TrimAnalysis>().run(scene.context);
  const State start = scene.context.state;

  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  std::vector<double>                    x(motion.scales.size());
  for (unsigned int i = 0; i < x.size(); ++i)
    x[i] = 0.02 * number(generator) * motion.scales[i];
  const auto [of_end, of_averages] = differences(scene.system, motion, start, x);
  motion.linearize(start);
  const auto found = motion.apply(x.data());
  double     size = 0, error = 0;
  for (unsigned int i = 0; i < x.size(); ++i)
    {
      size  = std::max(size, std::abs(of_end[i]) / motion.scales[i]);
      error = std::max(error, std::abs(of_end[i] - x[i]) / motion.scales[i]);
    }
  EXPECT_LT(error, 1e-6 * size);
  for (unsigned int k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], of_averages[k], 1e-6 * std::abs(of_averages[k])) << k;
  EXPECT_EQ(motion.n_applied, 1u);
}
