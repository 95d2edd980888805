// Extension of a rod that turns steadily about its end: steady rotation of the whole model.
//
// Reference: exact, tests/reference/beams/rotating_rod_extension.csv: with k = ΩL sqrt(m/EA) an extension of
// tan k/k − 1 of the length, and a root force of EA (1/cos k − 1).

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  double
  extension(const double k, const unsigned int degree, const unsigned int elements)
  {
    Scene scene("prm/benchmarks/spinning_rod.prm",
                {"Constants/k = " + std::to_string(k),
                 "Bodies/rod/Degree = " + std::to_string(degree),
                 "Bodies/rod/Elements = " + std::to_string(elements)});
    scene.equilibrium();
    return scene.value("rod.end.displacement x") / 2.;
  }
} // namespace



TEST(SpinningRod, EveryRowOfTheReference)
{
  struct Row
  {
    double k, extension;
  };
  for (const Row &row :
       {Row{0.1, 0.0033467208545055}, {0.3, 0.031120832032077}, {0.5, 0.092604979687581}, {1, 0.5574077246549}})
    {
      EXPECT_NEAR(extension(row.k, 4, 8) / row.extension, 1., 1e-11) << row.k;
    }
}



TEST(SpinningRod, ConvergesWithOrderTwiceTheDegree)
{
  const double       exact    = std::tan(1.) - 1;
  const unsigned int coarse[] = {0, 16, 4, 2, 1};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      const double one = extension(1, p, coarse[p]) - exact, two = extension(1, p, 2 * coarse[p]) - exact;
      EXPECT_NEAR(std::log2(one / two), 2. * p, 0.3) << "degree " << p;
    }
}



// The force on the ground is the root force, on a line through any point and about any axis.
TEST(SpinningRod, PullsAtTheGround)
{
  Scene               scene("prm/benchmarks/spinning_rod.prm", {"Bodies/rod/Elements = 8"});
  const State        &state = scene.equilibrium();
  std::vector<double> r;
  scene.system.residual(state, state.stress, r);
  const double pull = 3e5 * (1 / std::cos(1.) - 1);
  const auto   n    = scene.system.size();
  EXPECT_NEAR(-r[n] / pull, 1., 1e-10);
  for (unsigned int i = 1; i < 6; ++i)
    EXPECT_NEAR(r[n + i] / pull, 0., 1e-10) << i;
}
