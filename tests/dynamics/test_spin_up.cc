// Spin-up of a cantilever to 6 rad/s, Kane, Ryan & Banerjee 1987, Simo & Vu-Quoc 1986.
//
// Reference: an independent staggered scheme, extrapolated, tests/reference/beams/spin_up_beam.csv, which gives its
// own error: up to 7e-5 m. The steady extension at 6 rad/s, tan(k)/k − 1 of the length with k² = m Ω² L²/EA, is exact.
// Expected: four cubic elements and a third of a radian a step are within the error of the reference; order 2s
// without dissipation.

#include "motion.h"

using namespace samara;

namespace
{
  const std::vector<std::string> middle_and_end = {"beam.middle.position x",
                                                   "beam.middle.position y",
                                                   "beam.end.position x",
                                                   "beam.end.position y"};

  const ReferenceRow spin_up[] = {{1, {4.99999325, 0.00744643709, 9.9999931, 0.00852921453}, 3e-8},
                                  {2.5, {4.97509111, 0.49781292, 9.95472438, 0.948629287}, 6e-7},
                                  {5, {0.113782175, 4.99809348, 0.372440492, 9.99138757}, 1.1e-6},
                                  {7.5, {4.66496371, 1.79729482, 9.38690596, 3.44151834}, 4e-6},
                                  {10, {-3.31568474, -3.74232371, -6.70287878, -7.42035403}, 1e-6},
                                  {12.5, {1.26874922, -4.83666051, 2.51033371, -9.68021125}, 1.9e-5},
                                  {15, {2.62638095, 4.25507433, 5.25238105, 8.51015717}, 2e-6},
                                  {17.5, {-4.76198696, -1.52545601, -9.5235096, -3.05172907}, 6e-5},
                                  {20, {4.60918837, -1.9387935, 9.21826992, -3.87734331}, 4e-5}};
} // namespace



TEST(SpinUp, IsWithinTheErrorOfTheReference)
{
  for (const double radius : {0.5, 1.})
    {
      const Motion motion("spin_up", integrator(3, radius, 0.05, "1e-11"), middle_and_end);
      for (const ReferenceRow &row : spin_up)
        EXPECT_LT(motion.error(row.t, row.places), row.error) << "t = " << row.t;
    }
}



TEST(SpinUp, ConvergesWithTheOrderOfTheScheme)
{
  const auto at_ten = [](std::vector<std::string> overrides) {
    overrides.push_back("Dynamic/End time = 10");
    return Motion("spin_up", overrides, middle_and_end).at(10);
  };
  const auto finest = at_ten(integrator(3, 1, 0.025));
  for (const Member &member : {Member{1, 1, 0.05}, Member{2, 1, 0.1}})
    member.expect_order(
      [&](const std::vector<std::string> &overrides) {
        const auto places = at_ten(overrides);
        double     error  = 0;
        for (unsigned int i = 0; i < places.size(); ++i)
          error = std::max(error, std::abs(places[i] - finest[i]));
        return error;
      },
      0.5);
}



TEST(SpinUp, ExtensionInSteadyRotation)
{
  // damped, so that the vibrations of the manoeuvre are over
  auto overrides = integrator(3, 0.5, 0.05, "1e-11");
  overrides.push_back("Bodies/beam/Damping = 0.1 s");
  overrides.push_back("Dynamic/End time = 25");
  const Motion motion("spin_up", overrides, middle_and_end);
  const auto  &end    = motion.at(25);
  const double length = std::hypot(end[2], end[3]), k = 60 * std::sqrt(1.2 / 2.8e7);
  EXPECT_NEAR(length - 10, 10 * (std::tan(k) / k - 1), 1e-6);
  EXPECT_NEAR(std::remainder(std::atan2(end[3], end[2]) - (6. * 25 - 45), 2 * M_PI), 0, 1e-6);
}
