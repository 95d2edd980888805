// Roll-up of a cantilever by an end moment.
//
// Reference: analytic, tests/reference/beams/rollup_end_moment.csv: with a = 2πk the end is at (sin a/a, (1 − cos
// a)/a) of the length, for every axial and shear stiffness. Expected order 2p at the nodes, no locking, one load step.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Result
  {
    double       error; ///< of the end's position, relative to the length
    unsigned int load_steps;
  };

  Result
  roll_up(const double turns, const unsigned int degree, const unsigned int elements, const double slenderness = 100)
  {
    // EA = 12 (L/h)² EI/L² for a rectangle of height h
    const double EA = 12 * slenderness * slenderness;
    Scene        scene("prm/benchmarks/roll_up.prm",
                {"Constants/turns = " + std::to_string(turns),
                        "Constants/EA = " + std::to_string(EA) + " N",
                        "Constants/GA = " + std::to_string(EA / 3) + " N",
                        "Bodies/beam/Degree = " + std::to_string(degree),
                        "Bodies/beam/Elements = " + std::to_string(elements)});
    scene.equilibrium();
    const double a = 2 * M_PI * turns;
    return {std::hypot(scene.value("beam.end.position x") - std::sin(a) / a,
                       scene.value("beam.end.position z") - (1 - std::cos(a)) / a),
            scene.analysis<StaticAnalysis>().n_steps};
  }
} // namespace



TEST(RollUp, EveryRowOfTheReference)
{
  struct Row
  {
    double turns, x, z;
  };
  for (const Row &row : {Row{0.1, 0.9354892837886389, 0.3039588939177435},
                         Row{0.25, 0.6366197723675814, 0.6366197723675813},
                         Row{0.5, 0., 0.6366197723675814},
                         Row{0.75, -0.2122065907891938, 0.2122065907891938},
                         Row{1, 0., 0.},
                         Row{2, 0., 0.}})
    {
      Scene scene("prm/benchmarks/roll_up.prm",
                  {"Constants/turns = " + std::to_string(row.turns),
                   "Bodies/beam/Degree = 4",
                   "Bodies/beam/Elements = 48"});
      scene.equilibrium();
      EXPECT_NEAR(scene.value("beam.end.position x"), row.x, 2e-11) << row.turns << " turns";
      EXPECT_NEAR(scene.value("beam.end.position z"), row.z, 2e-11) << row.turns << " turns";
      EXPECT_NEAR(scene.value("beam.middle.moment 2"), -2 * M_PI * row.turns, 1e-6) << row.turns << " turns";
    }
}



TEST(RollUp, ConvergesWithOrderTwiceTheDegree)
{
  const unsigned int coarse[] = {0, 64, 16, 8, 8, 4, 2};
  for (unsigned int p = 1; p <= 6; ++p)
    {
      const Result one = roll_up(1, p, coarse[p]), two = roll_up(1, p, 2 * coarse[p]);
      EXPECT_NEAR(std::log2(one.error / two.error), 2. * p, 0.3) << "degree " << p;
      EXPECT_GT(two.error, 1e-13) << "round-off: the order means nothing, degree " << p;
    }
}



TEST(RollUp, NeedsOneLoadStepForAFullCircle)
{
  for (const unsigned int p : {2, 3, 4, 5, 6})
    EXPECT_EQ(roll_up(1, p, 8).load_steps, 1u) << "degree " << p;
}



TEST(RollUp, DoesNotLockWhenSlender)
{
  for (unsigned int p = 1; p <= 6; ++p)
    {
      const unsigned int n      = (p < 5 ? 48 : 24) / p; // far from round-off
      const double       stocky = roll_up(1, p, n, 1e2).error;
      for (const double slenderness : {1e3, 1e4})
        EXPECT_NEAR(roll_up(1, p, n, slenderness).error / stocky, 1., 1e-3)
          << "degree " << p << ", slenderness " << slenderness;
    }
}
