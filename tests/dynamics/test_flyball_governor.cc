// IFToMM benchmark A05, the stiff flyball governor: heights of the slider and speeds of the shaft.
//
// Reference: equations with three unknowns by another program, derivable,
// tests/reference/multibody/flyball_governor.csv. Expected: the spring-dampers, whose rate of 1e4/s no step resolves,
// settle in the first step and leave 2e-7 m of it; orders 2 without and 3 with dissipation above that.

#include "../reference.h"

#include "motion.h"

using namespace samara;

namespace
{
  /** Largest difference of the height [m] and of the speed [rad/s]. */
  std::pair<double, double>
  errors_of_governor(const std::vector<std::string> &member)
  {
    const Motion motion("flyball_governor", member, {"slider.position z", "shaft.angular velocity z"});
    double       height = 0, speed = 0;
    for (const auto &row : reference_rows("multibody/flyball_governor.csv"))
      {
        const auto &found = motion.at(std::stod(row.at("t")));
        height            = std::max(height, std::abs(found[0] - std::stod(row.at("z"))));
        speed             = std::max(speed, std::abs(found[1] - std::stod(row.at("speed"))));
      }
    return {height, speed};
  }
} // namespace



TEST(FlyballGovernor, FollowsTheReference)
{
  const auto [height, speed] = errors_of_governor(integrator(3, 0.5, 0.01, "1e-12"));
  EXPECT_LT(height, 5e-7);
  EXPECT_LT(speed, 5e-6);
}



TEST(FlyballGovernor, ConvergesWithTheOrderOfTheScheme)
{
  Member{1, 1, 0.02}.expect_order([](const auto &member) { return errors_of_governor(member).first; });
  Member{2, 0.5, 0.02}.expect_order([](const auto &member) { return errors_of_governor(member).first; });
}
