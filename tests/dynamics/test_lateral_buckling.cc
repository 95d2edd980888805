// A high cantilever that a crank bends until it gives way to the side (Bauchau, Betsch, Cardona et al. 2016).
//
// Reference: a narrow strip under a force P at its end, which a link holds sideways but lets turn. With ξ from the end,
// the twist β, b = β + R/P and R what the link holds: GJ b'' + (P ξ)²/EI₃ b = 0, b' = 0 at both ends, so that P = 2 j
// √(EI₃ GJ)/L², j = 3.4910 the first zero of J₃/₄; bent in its plane before, it buckles at 1/√((1 − EI₃/EI₂)(1 −
// GJ/EI₂)) times that.

#include "motion.h"

using namespace samara;

namespace
{
  const std::vector<std::string> middle_of_strip = {"beam.middle.displacement y", "beam.middle.displacement z"};
}



// Pushed up slowly, with a hundredth of a millimetre out of its plane: from there on the force hardly grows.
TEST(DrivenLateralBuckling, ForceOfTheLink)
{
  Scene scene(
    "prm/benchmarks/dynamics/lateral_buckling.prm",
    {"Analyses = static", "Constants/d = 1e-5", "Joints/drive/rotation/Prescribed = -0.63", "Static/Load steps = 30"});
  scene.equilibrium();
  const double EI2 = 60830, EI3 = 608.3, GJ = 877.2, j = 3.49100,
               P = 2 * j * std::sqrt(EI3 * GJ / (1 - EI3 / EI2) / (1 - GJ / EI2));
  EXPECT_NEAR(-scene.value("link.start.force 1"), P, 2e-3 * P);
  EXPECT_GT(std::abs(scene.value("beam.middle.displacement y")), 3e-3);
}



// The motion until it has buckled, and back: other members with longer steps find the same.
TEST(DrivenLateralBuckling, MembersAgree)
{
  const auto at = [](const unsigned int s, const double rho, const double h) {
    auto overrides = integrator(s, rho, h, "1e-10");
    overrides.push_back("Dynamic/End time = 0.3");
    return Motion("lateral_buckling", overrides, middle_of_strip);
  };
  const Motion fine = at(3, 1, 1e-3), coarse = at(3, 0, 2e-3), two = at(2, 0.5, 1e-3);
  EXPECT_LT(fine.at(0.15)[0], -0.03);
  for (const double t : {0.1, 0.2, 0.3})
    {
      EXPECT_LT(coarse.error(t, fine.at(t)), 2e-4) << t;
      EXPECT_LT(two.error(t, fine.at(t)), 2e-4) << t;
    }
  EXPECT_LT(fine.report.largest_balance, 1e-8);
}
