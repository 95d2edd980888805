// What has no multipliers, or other ones than those of its file, is told, never computed.

#include <samara/analysis/floquet.h>

#include "../said_by.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include "floquet_models.h"

using namespace samara;
using namespace floquet_models;

namespace
{

  /** What is said when the model is analysed with other entries; "" if it is done. */
  std::string
  said_of(const std::string &model, const std::vector<std::string> &overrides)
  {
    return said_by<std::runtime_error>([&]() {
      Scene scene(model, overrides);
      scene.analysis<FloquetAnalysis>().run(scene.context);
    });
  }

  bool
  has(const std::string &text, const std::string &piece)
  {
    return text.find(piece) != std::string::npos;
  }
} // namespace



TEST(FloquetRefuses, AWrongPeriod)
{
  const std::string text = said_of(pendulum, {"Floquet/Period = 3", "Floquet/Settle = 2", "Floquet/Corrections = 0"});
  EXPECT_TRUE(has(text, "to periodicity")) << text;
  EXPECT_TRUE(has(text, "block")) << text;
}



// The hinge does not move, and its orbit is at rest with any period; but its spring has one.
TEST(FloquetRefuses, CoefficientsOfAnotherPeriod)
{
  const std::vector<std::string> spring      = {"Joints/lift/displacement/Prescribed = 0",
                                                "Joints/hinge/rotation/Moment = -0.2*cos(2*t)*hinge.rotation"};
  auto                           with_period = spring;
  with_period.push_back("Floquet/Period = 3");
  const std::string text = said_of(pendulum, with_period);
  EXPECT_TRUE(has(text, "in the next period")) << text;
  EXPECT_EQ(said_of(pendulum, spring), "");
}



TEST(FloquetRefuses, WhatIsNotRepeated)
{
  const std::string settle = "Floquet/Settle = 1";
  // another order, a hub that turns and is not named, names without a counterpart
  EXPECT_TRUE(
    has(said_of(hammond, {settle, "Floquet/Corrections = 0", "Floquet/Symmetry = blade 1, blade 3, blade 2, blade 4"}),
        "periodicity"));
  EXPECT_TRUE(has(said_of(hammond, {settle, "Floquet/Corrections = 0", "Floquet/Turning ="}), "periodicity"));
  EXPECT_TRUE(has(said_of(hammond, {settle, "Floquet/Symmetry = blade 1, blade 2, blade 5, blade 4"}), "blade 5"));
  EXPECT_TRUE(has(said_of(hammond, {settle, "Floquet/Turning = hubb, shaft"}), "did you mean"));
  EXPECT_TRUE(has(said_of(hammond, {"Floquet/Steps = 30"}), "multiple of the 4"));
}



// One damper that is larger by a part in ten thousand is no symmetry any more; by one in 1e8 it changes nothing that is
// told.
TEST(FloquetRefuses, WhatIsAlmostRepeated)
{
  const auto entries = [](const std::string &by) {
    return std::vector<std::string>{"Subsystems/blade/Joints/lag/rotation/Damper = damper*((copy == 3) ? 1 + " + by +
                                      " : 1)",
                                    "Floquet/Steps = 24"};
  };
  EXPECT_TRUE(has(said_of(hammond, entries("1e-4")), "the <Symmetry> is none"));
  Scene scene(hammond, entries("1e-8"));
  auto &floquet = scene.analysis<FloquetAnalysis>();
  floquet.run(scene.context);
  EXPECT_NEAR(std::abs(floquet.modes[0].multiplier), 0.863262002, 3e-8);
}



TEST(FloquetRefuses, SettingsThatDoNotFit)
{
  EXPECT_TRUE(has(said_of(pendulum, {"Floquet/Period = 0"}), "give either the <Period>"));
  EXPECT_TRUE(has(said_of(pendulum, {"Floquet/Turns of = hinge"}), "give either the <Period>"));
  EXPECT_TRUE(has(said_of(hammond, {"Floquet/Turns of = shift"}), "known: along x"));
  EXPECT_TRUE(has(said_of(hammond, {"Floquet/Turns of = along x.displacement"}), "is no rotation"));
  EXPECT_TRUE(has(said_of(hammond, {"Floquet/Turns of = blade 1:lag"}), "does not turn"));
  EXPECT_TRUE(has(said_of(pendulum, {"Floquet/Method = fast"}), "needs the <Symmetry>"));
  EXPECT_TRUE(has(said_of(pendulum, {"Floquet/Turning = block"}), "belongs to a <Symmetry>"));
}



// The angle is prescribed with one speed; rows of a sweep with others would all be that of this one.
TEST(FloquetRefuses, SpeedsThatThePrescribedAngleDoesNotHave)
{
  Scene scene(hammond);
  scene.context.sweep  = {20, 25};
  scene.context.speeds = {20};
  auto &analysis       = scene.analysis<FloquetAnalysis>();
  EXPECT_THROW(analysis.run(scene.context), InputError);
}



// A step on which a stop acts has no derivative.
TEST(FloquetRefuses, StopsThatAreTouched)
{
  const std::string text = said_of(pendulum,
                                   {"Joints/hinge/rotation/Lower stop = 0.1",
                                    "Joints/hinge/rotation/Stop stiffness = 100",
                                    "Floquet/Largest gap = 1",
                                    "Floquet/Settle = 1",
                                    "Floquet/Corrections = 0"});
  EXPECT_TRUE(has(text, "floquet analysis")) << text;
  EXPECT_TRUE(has(text, "a stop is touched")) << text;
}



TEST(FloquetWarns, OfDampingByTheSteps)
{
  const auto log = [](const std::vector<std::string> &overrides) {
    Scene scene(pendulum, overrides);
    scene.analysis<FloquetAnalysis>().run(scene.context);
    return scene.stream.str();
  };
  const std::vector<std::string> undamped = {"Constants/a = 0.5", "Constants/q = 0.3", "Constants/c = 0"};
  auto                           with     = undamped;
  with.insert(with.end(), {"Floquet/Spectral radius = 0.5", "Floquet/Stages = 2", "Floquet/Steps = 12"});
  EXPECT_TRUE(has(log(with), "add a damping"));
  EXPECT_FALSE(has(log(undamped), "warning"));
  EXPECT_TRUE(has(log(undamped), "neither stable nor unstable"));
  EXPECT_TRUE(has(log({"Constants/a = 900", "Constants/q = 0.3", "Floquet/Steps = 12"}), "is not resolved"));
}
