// IFToMM benchmark A05, the stiff flyball governor: heights of the slider and speeds of the shaft.
//
// Reference: equations with three unknowns by another program, derivable,
// tests/reference/multibody/flyball_governor.csv.
//
// Expected: its digits, though no step resolves the spring-dampers, whose rate is 1e4/s; orders 2 without and 3 with
// dissipation.

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
  EXPECT_LT(height, 1e-9);
  EXPECT_LT(speed, 1e-8);
}



TEST(FlyballGovernor, ConvergesWithTheOrderOfTheScheme)
{
  Member{1, 1, 0.02}.expect_order([](const auto &member) { return errors_of_governor(member).first; });
  Member{2, 0.5, 0.02}.expect_order([](const auto &member) { return errors_of_governor(member).first; });
}
