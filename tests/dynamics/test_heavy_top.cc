// Fast heavy top: a body that turns about a fixed point below its centre of mass, Brüls, Cardona & Arnold 2012.
//
// Reference: Euler's equations by an extrapolated midpoint rule in quadruple precision, agreeing with
// tests/reference/multibody/heavy_top_fast.csv to its 1e-12 m. Expected: order 2s, 2s − 1 with dissipation, at
// 0.15 to 0.6 rad a step.

#include "motion.h"

using namespace samara;

namespace
{
  const std::vector<std::string> place = {"top.position x", "top.position y", "top.position z"};

  // centre of mass
  const std::vector<double> after_half = {-0.70246829705658559, -0.021165184701923327, -0.71140025765173441},
                            after_two  = {-0.15041682274564176, -0.72416559163689565, -0.6730222695604441};
} // namespace



TEST(HeavyTop, ConvergesWithTheOrderOfTheScheme)
{
  for (const Member &member : {Member{1, 1, 5e-4},
                               Member{2, 1, 2e-3},
                               Member{2, 0, 5e-4},
                               Member{3, 1, 4e-3},
                               Member{3, 0.5, 2e-3},
                               Member{3, 0, 2e-3}})
    member.expect_order([](std::vector<std::string> overrides) {
      overrides.push_back("Dynamic/End time = 0.5");
      return Motion("heavy_top", overrides, place).error(0.5, after_half);
    });
}



TEST(HeavyTop, TenDigitsAfterTwoSeconds)
{
  const Motion motion("heavy_top", integrator(3, 1, 5e-4), place);
  EXPECT_LT(motion.error(2, after_two), 2e-10);
  EXPECT_EQ(motion.log.find("obey"), std::string::npos) << "the velocities at the start fit";
}



TEST(HeavyTop, SpinAboutItsAxisStays)
{
  // the third of Euler's equations: J₂ dΩ₂/dt = 0 for two equal moments of inertia; inertial axes to the top's axis
  const Motion motion("heavy_top",
                      integrator(3, 1, 4e-3),
                      {"top.position x",
                       "top.position y",
                       "top.position z",
                       "top.angular velocity x",
                       "top.angular velocity y",
                       "top.angular velocity z"});
  for (const auto &v : motion.values)
    EXPECT_NEAR(v[0] * v[3] + v[1] * v[4] + v[2] * v[5], 150, 1e-6);
}
