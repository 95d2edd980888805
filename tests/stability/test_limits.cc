// Steps that are too long, stops, singular positions, thin beams, long flights: stories of doc/benchmarks/stability.md.
//
// References: the energy of the start; the momentum of the start; the elastica.

#include "trial.h"

using namespace samara;



// A heavy top at 150 rad/s. One radian a step is solved with one matrix for all stages; two and more need the exact
// matrix of all stages, which the report tells, and no halving. The energy is that of the start.
TEST(Solvability, LongStepsTakeTheExactMatrix)
{
  const auto top = [](const unsigned int s, const double radians, const std::vector<std::string> &more = {}) {
    const Trial trial("dynamics/heavy_top",
                      family(s, 1) +
                        std::vector<std::string>{"Dynamic/Step = " + text_of(radians / 150),
                                                 "Dynamic/End time = 0.5",
                                                 "Dynamic/Newton tolerance = 1e-10"} +
                        more);
    EXPECT_TRUE(trial.motion) << trial.failure;
    EXPECT_NEAR(trial.left(), 1, 1e-8);
    return trial.motion->report;
  };
  EXPECT_EQ(top(2, 1).n_exact_steps, 0u);
  for (const unsigned int s : {2, 3})
    {
      EXPECT_GT(top(s, 2).n_exact_steps, 0u) << s;
      EXPECT_EQ(top(s, 2).n_failed, 0u) << s;
    }
  EXPECT_EQ(top(1, 2).n_failed, 0u); // solvable, but its result is wrong: see the page
  // step control begins with six radians, too long, and ends with less than three
  const auto adaptive = top(3, 6, {"Dynamic/Step control = adaptive", "Dynamic/Tolerance = 1e-3"});
  EXPECT_GT(adaptive.n_failed + adaptive.n_rejected, 0u);
  EXPECT_LT(75. / adaptive.n_steps, 3.);
}



// The stiff stop. A step of the family keeps the energy through contact, and dissipation takes a tenth. Generalised α makes
// energy with one step and loses it with another, as its contact force has no exact work.
TEST(StopImpact, Energy)
{
  const auto lost =
    [](const std::vector<std::string> &method, const std::string &step = "4e-3", const std::string &end = "0.5") {
      const Trial trial("stability/stop_impact",
                        method + std::vector<std::string>{"Dynamic/Step = " + step, "Dynamic/End time = " + end});
      EXPECT_TRUE(trial.motion) << trial.failure;
      if (method[0].find("Stages") != std::string::npos)
        {
          EXPECT_GT(trial.motion->report.n_touches, 1u);
        }
      return -trial.energy() / 9.81; // of the energy at the stop
    };
  EXPECT_NEAR(lost(family(1, 1)), 0, 1e-7);
  EXPECT_NEAR(lost(family(2, 1)), 0, 1e-7);
  EXPECT_NEAR(lost(family(2, 1), "1e-3", "0.84"), 0, 1e-7); // with a contact that is over within a step
  EXPECT_GT(lost(family(2, 0)), 0.02);
  EXPECT_LT(lost(rival("generalised alpha", 0.5)), -5e-3);
  EXPECT_LT(lost(rival("generalised alpha", 0)), -5e-3);
  EXPECT_GT(lost(rival("generalised alpha", 0), "2e-3"), 0.05);
}



// Where all bars lie in one line the exact matrix of all stages leads on, without dissipation, too.
TEST(FourBar, SingularPositions)
{
  const auto passes = [](const std::vector<std::string> &method, const std::string &end = "4") {
    const Trial trial("dynamics/four_bar",
                      method + std::vector<std::string>{"Dynamic/End time = " + end,
                                                        "Dynamic/Step = 0.02",
                                                        "Dynamic/Smallest step = 1e-5"});
    return trial.motion != nullptr;
  };
  EXPECT_TRUE(passes(family(2, 1)));
  EXPECT_TRUE(passes(family(2, 0.99)));
  EXPECT_TRUE(passes(family(1, 1), "5.3"));
  EXPECT_TRUE(passes(family(2, 0.5)));
  EXPECT_TRUE(passes(family(3, 0.5)));
  EXPECT_TRUE(passes(rival("generalised alpha", 1)));
}



// The error of a mesh does not depend on the thickness: no locking, between 1/10 and 1/100 000 of the length.
TEST(ThinCantilever, DoesNotLock)
{
  const double exact = -0.8106090248815;
  for (const auto &[p, n] : {std::make_pair(1, 8), std::make_pair(2, 4), std::make_pair(3, 4)})
    {
      std::vector<double> errors;
      for (const std::string thickness : {"1e-3", "1e-4", "1e-5"})
        {
          Scene scene("prm/benchmarks/stability/thin_cantilever.prm",
                      {"Constants/thickness = " + thickness + " m",
                       "Bodies/beam/Degree = " + std::to_string(p),
                       "Bodies/beam/Elements = " + std::to_string(n)});
          scene.equilibrium();
          errors.push_back(std::abs(scene.value("beam.end.displacement z") / exact - 1));
        }
      for (const double error : errors)
        EXPECT_NEAR(error, errors[0], 0.02 * errors[0]) << "p = " << p;
      EXPECT_LT(errors[0], p == 1 ? 0.04 : 0.01);
    }
}



// A thousand steps of free flight. Where the spring is resolved, moments stay as well as the order of the scheme makes
// them, and the energy to round-off; where it is not, members without dissipation lose the momentum: forces of stages
// are not quite opposite, and they ring. That is a weakness.
TEST(FreeFlight, Momentum)
{
  const auto change = [](const std::vector<std::string> &method, const std::string &spring) {
    Scene                scene("prm/benchmarks/stability/free_flight.prm",
                method + std::vector<std::string>{"Constants/steps = 1000", "Joints/tie/length/Spring = " + spring});
    auto                &dynamics = scene.analysis<DynamicAnalysis>();
    std::vector<Vector6> momenta;
    dynamics.observer = [&](const State &state) { momenta.push_back(momentum_of(scene.system, state)); };
    dynamics.start(scene.context);
    dynamics.run(scene.context);
    const auto &b = dynamics.budget;
    return std::make_pair((b.kinetic + b.strain) / b.start - 1,
                          (momenta.back() - momenta.front()).head<3>().norm() / momenta.front().head<3>().norm());
  };
  for (const unsigned int s : {2, 3})
    {
      const auto soft = change(family(s, 1), "10");
      EXPECT_NEAR(soft.first, 0, 1e-7);
      EXPECT_LT(soft.second, s == 2 ? 1e-2 : 1e-5);
    }
  const auto stiff = change(family(2, 1), "1e4");
  EXPECT_NEAR(stiff.first, 0, 1e-7);
  EXPECT_GT(stiff.second, 5e-3);
  EXPECT_LT(change(family(3, 0.5), "1e4").second, 2e-3);
  EXPECT_LT(change(rival("energy decaying", 0), "1e4").second, 1e-7); // exact there, but the energy is gone
}
