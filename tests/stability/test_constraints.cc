// What becomes of constraints: gaps, starts that violate them, ways that end. Stories of doc/benchmarks/stability.md.
//
// References: gaps are zero; the projection of a velocity v at an angle off the allowed direction is v cos(off).

#include "trial.h"

using namespace samara;

namespace
{
  /** Largest distance of the two ends at the elbow of the double pendulum in three seconds. */
  double
  gap(const std::vector<std::string> &method)
  {
    const Trial trial("stability/double_pendulum",
                      method + std::vector<std::string>{"Dynamic/End time = 5"},
                      {"a.end.position x",
                       "b.start.position x",
                       "a.end.position y",
                       "b.start.position y",
                       "a.end.position z",
                       "b.start.position z"});
    EXPECT_TRUE(trial.motion) << trial.failure;
    double largest = 0;
    for (const auto &v : trial.motion->values)
      largest = std::max(largest, std::hypot(v[0] - v[1], v[2] - v[3], v[4] - v[5]));
    return largest;
  }
} // namespace



TEST(Drift, OfTheJointsOfADoublePendulum)
{
  EXPECT_LT(gap(family(2, 1)), 1e-9);
  EXPECT_LT(gap(rival("generalised alpha", 0.5)), 1e-9);
  EXPECT_LT(gap({"Dynamic/Integrator = BDF index 2"}), 1e-3); // 3e-5 to 2e-4: the motion amplifies round-off
  EXPECT_GT(gap({"Dynamic/Integrator = BDF index 1"}), 1e-2);
}



// Closed forms: the nearest velocity has cos² of the energy, the rod the tension m v² cos²/L at once and for ever.
TEST(InconsistentVelocities, AreProjected)
{
  for (const double off : {0.01, 30., 85.})
    {
      const Trial trial("stability/inconsistent_velocities",
                        {"Constants/off = " + text_of(off) + " deg", "Dynamic/End time = 0.2"},
                        {"rod.force"});
      ASSERT_TRUE(trial.motion) << trial.failure;
      const double part = std::pow(std::cos(off * M_PI / 180), 2);
      EXPECT_NEAR(trial.motion->budget.start, 4.5 * part, 1e-12);
      for (const auto &v : trial.motion->values)
        EXPECT_NEAR(v[0], 9 * part, 1e-6);
      EXPECT_NE(trial.motion->log.find("do not obey the constraints"), std::string::npos);
    }
}



// Nothing is left of a velocity along the rod: what was given is the scale, not round-off of rest.
TEST(InconsistentVelocities, OfRestAreTold)
{
  const Trial trial("stability/inconsistent_velocities",
                    {"Constants/off = 90 deg", "Dynamic/End time = 0.1"},
                    {"rod.force"});
  ASSERT_TRUE(trial.motion) << trial.failure;
  EXPECT_NE(trial.motion->log.find("are different by 100 % of the largest"), std::string::npos) << trial.motion->log;
}



TEST(InconsistentVelocities, AreRefusedIfWanted)
{
  const std::vector<std::string> refuse = {"Dynamic/Inconsistent velocities = refuse", "Dynamic/End time = 0.1"};
  const Trial                    off("stability/inconsistent_velocities", refuse);
  EXPECT_FALSE(off.motion);
  EXPECT_NE(off.failure.find("bob"), std::string::npos) << off.failure;
  const Trial right("stability/inconsistent_velocities", refuse + std::vector<std::string>{"Constants/off = 0"});
  EXPECT_TRUE(right.motion) << right.failure;
}



// Without the projection, by which every run of the program begins: 4.5 J, of which 3.375 J are allowed. Members of the
// family without dissipation carry the rest along for ever, beside a right motion; dissipation takes it away. Rivals of
// index 3 and BDF drop it in the first step. In inertial velocities it spoils the motion.
TEST(InconsistentVelocities, WhatIntegratorsDoWithThem)
{
  Scene        scene("prm/benchmarks/stability/inconsistent_velocities.prm");
  const auto  &system = scene.system;
  const double across = 3 * std::cos(M_PI / 6), allowed = across * across / 2;
  const auto   after = [&](const std::string &name, const double rho, const unsigned int s = 0) {
    State start = system.reference();
    system.add_initial_velocities(start);
    IntegratorSettings settings;
    settings.spectral_radius  = rho;
    settings.newton_tolerance = 1e-12;
    const std::unique_ptr<Integrator> integrator =
      s > 0 ? std::make_unique<StageIntegrator>(system, Tableau(s, rho), 1e-12) : make_rival(name, system, settings);
    const Record r = run(system, start, *integrator, 0.02, 20);
    EXPECT_EQ(r.n_steps, 20u) << name;
    State reported = r.state;
    Projection(system).velocities(reported);
    return std::make_pair(energy_of(system, r.state), std::sqrt(2 * energy_of(system, reported)));
  };
  for (const unsigned int s : {1, 2, 3})
    {
      SCOPED_TRACE("s = " + std::to_string(s));
      const auto preserving = after("", 1, s), decaying = after("", 0, s);
      EXPECT_NEAR(preserving.first, 4.5, 1e-9);
      EXPECT_NEAR(preserving.second, across, 1e-9);
      EXPECT_NEAR(decaying.first, s == 1 ? 3.12 : allowed, s == 1 ? 0.01 : 1e-3);
      EXPECT_NEAR(decaying.second, across, s == 1 ? 0.11 : 1e-4);
    }
  for (const std::string name : {"generalised alpha", "trapezoidal", "BDF index 2", "BDF index 1"})
    for (const double rho : {1., 0.5})
      {
        SCOPED_TRACE(name);
        const auto rival = after(name, rho);
        EXPECT_NEAR(rival.first, allowed, 1e-4);
        EXPECT_NEAR(rival.second, across, 1e-4);
      }
  EXPECT_LT(after("energy decaying", 1).second, 0.5 * across);
  EXPECT_LT(after("energy decaying", 0.5).second, 0.95 * across);
}
