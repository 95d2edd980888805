// Steps that are too long, stops, singular positions, thin beams, long flights: stories of doc/benchmarks/stability.md.
//
// References: the energy of the start; the momentum of the start; the elastica.

#include "trial.h"

using namespace samara;



// A heavy top at 150 rad/s. Steps of up to five radians are solved with one matrix for all stages, which converges by
// its acceleration, and without halving. The energy is that of the start.
TEST(Solvability, LongStepsHaveSolutions)
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
  for (const unsigned int s : {1, 2, 3})
    for (const double radians : {1., 2., 3., 5.}) // beyond one the result is wrong: see the page
      {
        const auto report = top(s, radians);
        EXPECT_EQ(report.n_exact_steps, 0u) << s << ", " << radians;
        EXPECT_EQ(report.n_failed, 0u) << s << ", " << radians;
      }
  // step control begins with six radians, too long, and ends with less than three
  const auto adaptive = top(3, 6, {"Dynamic/Step control = adaptive", "Dynamic/Tolerance = 1e-3"});
  EXPECT_GT(adaptive.n_failed + adaptive.n_rejected, 0u);
  EXPECT_LT(75. / adaptive.n_steps, 3.);
}



// The stiff stop. A step of the family keeps the energy through contact, and dissipation takes a tenth. Generalised α
// makes energy with one step and loses it with another, as its contact force has no exact work.
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
  unsigned int n_exact = 0; // steps that only the exact matrix of all stages solves
  const auto   passes  = [&n_exact](const std::vector<std::string> &method, const std::string &end = "4") {
    const Trial trial("dynamics/four_bar",
                      method + std::vector<std::string>{"Dynamic/End time = " + end,
                                                        "Dynamic/Step = 0.02",
                                                        "Dynamic/Smallest step = 1e-5"});
    n_exact = trial.motion ? trial.motion->report.n_exact_steps : 0;
    return trial.motion != nullptr;
  };
  EXPECT_TRUE(passes(family(2, 1)));
  EXPECT_GT(n_exact, 0u);
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



// A thousand steps of free flight. Members without dissipation keep momentum and energy, whether the spring is resolved
// or not; what the others lose of momentum is of the order of the scheme.
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
  for (const std::string spring : {"10", "1e4"})
    for (const unsigned int s : {1, 2, 3})
      {
        const auto [energy, momentum] = change(family(s, 1), spring);
        EXPECT_NEAR(energy, 0, 1e-7) << s << ", " << spring;
        EXPECT_LT(momentum, 1e-7) << s << ", " << spring;
      }
  EXPECT_LT(change(family(2, 0), "10").second, 3e-2);
  EXPECT_LT(change(family(3, 0), "10").second, 5e-5);
  EXPECT_LT(change(family(3, 0.5), "1e4").second, 2e-3);
  EXPECT_LT(change(rival("energy decaying", 0), "1e4").second, 1e-7); // exact there, but the energy is gone
}
