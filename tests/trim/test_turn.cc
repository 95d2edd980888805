// The tangent of a turn of a motion that is trimmed: of its end and of what its averages are.
//
// Reference: central differences of turns.

#include <samara/analysis/trim.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "turns.h"

using namespace samara;

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
  expect_tangent_of_differences(scene.system, motion, scene.context.state, 3);
}
