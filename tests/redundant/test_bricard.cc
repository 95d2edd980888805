// Bricard's mechanism of six revolutes: 30 rows on 30 velocities, one of them redundant, and 15 weights of the
// redundancy pass zero while it moves. The motion is that of the same mechanism with a cylindrical joint, which has no
// redundant row.

#include "run.h"

using namespace samara;

namespace
{
  const std::string bricard = "prm/benchmarks/peers/bricard.prm", P3 = "bar 2.end";

  std::vector<std::string>
  bricard_settings(const std::string &stages,
                   const std::string &radius,
                   const std::string &step,
                   const std::string &joint = "revolute")
  {
    return {"Joints/P5/Type = " + joint,
            "Dynamic/Stages = " + stages,
            "Dynamic/Spectral radius = " + radius,
            "Dynamic/Step = " + step,
            "Dynamic/Newton tolerance = 1e-12"};
  }

  const Outcome &
  reference()
  {
    static const Outcome run = run_motion(bricard, P3, bricard_settings("3", "1", "0.005", "cylindrical"));
    return run;
  }

  /** Largest errors of P3 in 10 s as an independent program in Python has them (dense border, exact Newton), and some
   * more. */
  struct Case
  {
    std::string s, radius, step;
    double      error;
  };

  class Bricard : public testing::TestWithParam<Case>
  {};


  TEST_P(Bricard, MovesAsWithoutRedundantRows)
  {
    const Case    c   = GetParam();
    const Outcome run = run_motion(bricard, P3, bricard_settings(c.s, c.radius, c.step));
    EXPECT_EQ(run.n_redundant, 1u);
    EXPECT_LT(run.gap, 1e-9);
    EXPECT_LT(run.balance, 1e-8);
    EXPECT_EQ(run.n_failed, 0u);
    EXPECT_LT(run.error(reference()), 1.35 * c.error + 1e-9);
  }

  INSTANTIATE_TEST_SUITE_P(Redundant,
                           Bricard,
                           testing::Values(Case{"1", "1", "0.05", 1.2e-2},
                                           Case{"1", "1", "0.01", 4.7e-4},
                                           Case{"1", "1", "0.001", 4.7e-6},
                                           Case{"1", "0.5", "0.05", 0.19},
                                           Case{"1", "0", "0.05", 0.41},
                                           Case{"2", "1", "0.05", 4.1e-6},
                                           Case{"2", "1", "0.02", 9.8e-8},
                                           Case{"2", "0.5", "0.05", 4.5e-5},
                                           Case{"2", "0.5", "0.02", 2.7e-6},
                                           Case{"2", "0.5", "0.0025", 5.3e-9},
                                           Case{"2", "0", "0.05", 1.2e-4},
                                           Case{"3", "1", "0.05", 1.5e-9},
                                           Case{"3", "0.5", "0.05", 1.6e-8},
                                           Case{"3", "0", "0.05", 4.5e-8},
                                           Case{"3", "0", "0.0025", 1.5e-9}));
} // namespace



TEST(Bricard, AdaptiveSteps)
{
  auto overrides = bricard_settings("3", "0.5", "0.01");
  overrides.push_back("Dynamic/Step control = adaptive");
  const Outcome run = run_motion(bricard, P3, overrides);
  EXPECT_LT(run.gap, 1e-9);
  EXPECT_LT(run.balance, 1e-8);
  EXPECT_EQ(run.n_failed, 0u);
}
