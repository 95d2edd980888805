// IFToMM benchmark A02, N = 2: two parallelograms in a row, which pass singular positions.
//
// Reference: the equation of motion of a parallelogram, derivable, tests/reference/multibody/A02_N_four_bar.csv.
// Expected: where all bars lie in one line the mechanism could go on in several ways, and takes that of the reference;
// order 2s − 1 in spite of that. Without dissipation there is no way past these positions (not tested: it is a limit).

#include "motion.h"

using namespace samara;

namespace
{
  const std::vector<std::string> places_on_the_coupler = {"coupler 1.position x",
                                                          "coupler 1.position y",
                                                          "coupler 1.velocity x",
                                                          "coupler 2.position x",
                                                          "coupler 2.position y",
                                                          "coupler 1.rotation z"};

  /** From those of the corner B0. */
  std::vector<double>
  couplers(const double x, const double y, const double velocity)
  {
    return {x + 0.5, y, velocity, x + 1.5, y, 0};
  }
} // namespace



TEST(FourBar, PassesSingularPositions)
{
  const Motion motion("four_bar", integrator(3, 0.5, 0.01, "1e-10"), places_on_the_coupler);
  EXPECT_LT(motion.error(4, couplers(0.117616102376, 0.993059138451, 1.06903926503)), 1e-6);
  EXPECT_LT(motion.error(10, couplers(0.328458111533, 0.944518538181, 1.42305147019)), 1e-6);
  EXPECT_LT(motion.budget.dissipated, 1e-5); // of 35 J
}



TEST(FourBar, ConvergesWithTheOrderOfTheScheme)
{
  std::vector<double> errors;
  for (const double step : {0.02, 0.01})
    errors.push_back(Motion("four_bar", integrator(2, 0.5, step, "1e-10"), places_on_the_coupler)
                       .error(10, couplers(0.328458111533, 0.944518538181, 1.42305147019)));
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 3, 0.3);
}
