// Rigid spatial slider-crank of the IFToMM library.
//
// Reference: the equation of motion with one unknown, by an extrapolated midpoint rule in quadruple precision. It
// agrees with tests/reference/multibody/spatial_slider_crank.csv to 2e-9 m, 7e-8 m/s and 9e-7 rad/s, which is what
// that has (Runge-Kutta with a tolerance of 1e-11). Expected: order 2s, 2s − 1 with dissipation, once the steps resolve
// the quick passages, 0.03 s long, near the crank's dead points.

#include "motion.h"

using namespace samara;

namespace
{
  const std::vector<std::string> slider_and_crank = {"slider.position x",
                                                     "slider.velocity x",
                                                     "crank.angular velocity x"};

  struct Variant
  {
    std::string                                         arm; ///< of the crank's centre of mass
    std::vector<std::pair<double, std::vector<double>>> rows;
  };

  const Variant variants[] = {{"0",
                               {{1, {0.22902508953375239, -0.52688478810240589, 10.028772073775321}},
                                {2, {0.26389761106448644, 0.40406006604208592, 9.3918799072924328}},
                                {3, {0.20334536546802819, 0.24522147985309857, 5.7012020357306898}},
                                {4, {0.22189464679024389, -0.50674867574687487, 9.8114074481534474}},
                                {5, {0.2695615821733366, 0.41679211209258588, 10.671404596198015}}}},
                              {"0.04",
                               {{1, {0.20789584070643892, -0.48524643994905069, 10.498994445579959}},
                                {2, {0.28983549566041151, -0.14415917761920437, 27.297862393322545}},
                                {3, {0.23497243363276988, 0.33217202886804645, 6.3269645509273177}},
                                {4, {0.19434867160181973, 0.22926124246615998, 6.9279028013937049}},
                                {5, {0.22025265458673386, -0.53947528494902245, 10.518928948745357}}}}};
} // namespace



TEST(SliderCrank, EveryDigitOfTheTable)
{
  for (const Variant &variant : variants)
    {
      auto overrides = integrator(3, 1, 2.5e-3);
      overrides.push_back("Constants/arm = " + variant.arm);
      const Motion motion("slider_crank", overrides, slider_and_crank);
      EXPECT_EQ(motion.log.find("obey"), std::string::npos) << "the velocities at the start fit";
      for (const auto &[t, row] : variant.rows)
        {
          const auto &computed = motion.at(t);
          EXPECT_NEAR(computed[0], row[0], 1e-9) << "arm " << variant.arm << ", t = " << t;
          EXPECT_NEAR(computed[1], row[1], 1e-8) << "arm " << variant.arm << ", t = " << t;
          EXPECT_NEAR(computed[2], row[2], 3e-7) << "arm " << variant.arm << ", t = " << t;
        }
    }
}



TEST(SliderCrank, ConvergesWithTheOrderOfTheScheme)
{
  for (const Member &member :
       {Member{1, 1, 2.5e-3}, Member{2, 1, 5e-3}, Member{2, 0, 2.5e-3}, Member{3, 1, 5e-3}, Member{3, 0.5, 5e-3}})
    member.expect_order(
      [](std::vector<std::string> overrides) {
        overrides.push_back("Dynamic/End time = 1");
        const Motion motion("slider_crank", overrides, slider_and_crank);
        return std::abs(motion.at(1)[0] - variants[1].rows[0].second[0]);
      },
      0.5);
}



// Velocities at the end of a step violate constraints, most without dissipation; seen from there the next step begins
// with a jump, which no step size resolves. It must not count.
TEST(SliderCrank, AdaptiveStepsDoNotCollapse)
{
  for (const unsigned int s : {1, 2, 3})
    {
      auto overrides = integrator(s, 1, 1e-2);
      overrides.push_back("Dynamic/Step control = adaptive");
      overrides.push_back("Dynamic/Tolerance = 1e-3");
      const Motion motion("slider_crank", overrides, slider_and_crank);
      EXPECT_LT(motion.report.n_rejected, 0.3 * motion.report.n_steps);
      EXPECT_LT(motion.report.n_steps, s == 1 ? 10000u : 1000u);
    }
}



TEST(SliderCrank, AdaptiveStepsMeetTheTolerance)
{
  for (const double tolerance : {1e-4, 1e-7})
    {
      auto overrides = integrator(3, 1, 1e-2, "1e-12");
      overrides.push_back("Dynamic/Step control = adaptive");
      overrides.push_back("Dynamic/Tolerance = " + text_of(tolerance));
      const Motion motion("slider_crank", overrides, slider_and_crank);
      EXPECT_LT(std::abs(motion.at(5)[0] - variants[1].rows[4].second[0]), 40 * tolerance);
    }
}
