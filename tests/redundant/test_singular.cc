// Parallelograms in a row pass positions in which all bars lie in one line (IFToMM A02): there the rows are dependent
// for a moment and the mechanism could go on in several ways. Of all revolutes three rows a loop are redundant besides.
//
// Reference: the equation of motion of one parallelogram, tests/reference or derivable: the corner is at
// (0.328458111533, 0.944518538181) after 10 s.

#include "run.h"

using namespace samara;

namespace
{
  std::vector<std::string>
  singular_settings(const std::string &stages, const std::string &radius, const std::string &step)
  {
    return {"Dynamic/Stages = " + stages, "Dynamic/Spectral radius = " + radius, "Dynamic/Step = " + step};
  }

  std::vector<std::string>
  all_revolutes(std::vector<std::string> overrides)
  {
    overrides.push_back("Joints/B1/Type = revolute");
    overrides.push_back("Joints/B2/Type = revolute");
    return overrides;
  }

  Vector3
  end_of(const Outcome &run)
  {
    return run.places.at(10000);
  }

  const Vector3 coupler(0.328458111533 + 0.5, 0.944518538181, 0);
} // namespace



// The spectral radius of 1 damps nothing, so that round-off normal to the mechanism's path stays.
TEST(Singular, TwoParallelogramsPass)
{
  for (const std::string s : {"1", "2", "3"})
    for (const std::string radius : {"0", "0.5", "1"})
      {
        if (s == "1" && radius != "1")
          continue; // of first order: its error is not small
        const Outcome run = run_motion("prm/benchmarks/dynamics/four_bar.prm",
                                       "coupler 1",
                                       all_revolutes(singular_settings(s, radius, "0.01")));
        EXPECT_EQ(run.n_redundant, 6u);
        EXPECT_LT(run.gap, 1e-9) << s << ' ' << radius;
        EXPECT_LT(run.balance, 1e-8) << s << ' ' << radius;
        ASSERT_EQ(run.places.count(10000), 1u);
        EXPECT_LT((end_of(run) - coupler).norm(),
                  s == "1"                  ? 2e-3 :
                  s == "2" && radius != "1" ? 6e-3 :
                                              1e-6)
          << s << ' ' << radius;
      }
}



TEST(Singular, FortyParallelogramsPassOnce)
{
  for (const std::string radius : {"0.5", "1"})
    {
      auto overrides = singular_settings("3", radius, "0.01");
      overrides.push_back("Dynamic/End time = 1.5");
      const Outcome run = run_motion("prm/benchmarks/peers/n_four_bar.prm", "crank 0.B", overrides);
      EXPECT_EQ(run.n_redundant, 0u);
      EXPECT_EQ(run.n_failed, 0u);
      EXPECT_LT(run.gap, 1e-9);
      EXPECT_LT(run.balance, 1e-8);
      ASSERT_EQ(run.places.count(1500), 1u);
      EXPECT_LT((run.places.at(1500) - Vector3(-0.622202098384, 0.782856659144, 0)).norm(), 1e-5);
    }
}
