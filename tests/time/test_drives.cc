// Driven joints: the work of drives closes the account of energy; what is prescribed is there, and takes the moment or
// the force that it must take.

#include <samara/analysis/dynamic.h>
#include <samara/solvers/steady_motion.h>

#include <gtest/gtest.h>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** A wheel, J₃ = 3, about an axis through its centre of mass, or a carriage, m = 2, on a slide; f(t) is prescribed.
   */
  std::string
  driven(const bool is_rotation, const std::string &f)
  {
    return model(rigid_body("a", "set Mass = 2\n set Inertia = 1, 2, 3\n set Position = 0.2, 0, 0\n"),
                 joint("j",
                       is_rotation ? "revolute" : "prismatic",
                       "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 0, 1\n" +
                         motion(is_rotation ? "rotation" : "displacement", " set Prescribed = " + f + "\n")));
  }
} // namespace



// The angle is exact at every step, and its rate and the moment as accurate as all that is reported; the work of the
// drive is the kinetic energy.
TEST(Drives, OfAWheelAndOfACarriage)
{
  const double T = 1.3, f = 0.5 * std::sin(2 * T) + T * T, rate = std::cos(2 * T) + 2 * T,
               second = -2 * std::sin(2 * T) + 2;
  for (const bool is_rotation : {true, false})
    {
      SCOPED_TRACE(is_rotation ? "rotation" : "displacement");
      Scene        scene(driven(is_rotation, "0.5*sin(2*t) + t^2"));
      const State  start = start_of({"", "", 0, 0}, scene.system);
      const double J     = is_rotation ? 3 : 2;
      EXPECT_NEAR(start.rates[0], 1, 1e-14);
      for_all_members([&](const Tableau &tableau) {
        const unsigned int n = 20;
        const Record       r = run(scene.system, start, tableau, T / n, n);
        EXPECT_LT(r.balance, 1e-12);
        EXPECT_LT(r.gap, 1e-12);
        EXPECT_NEAR(r.state.coordinates[0], f, 1e-12);
        EXPECT_NEAR(r.work_of_drives - r.dissipated, energy_of(scene.system, r.state) - 0.5 * J, 1e-11);
        scene.context.state = r.state;
        Projection(scene.system).report(scene.context.state);
        EXPECT_NEAR(scene.context.state.rates[0], rate, 1e-12);
        EXPECT_NEAR(energy_of(scene.system, scene.context.state), 0.5 * J * rate * rate, 1e-11);
        EXPECT_NEAR(scene.value(is_rotation ? "j.moment 3" : "j.force 3"), J * second, 1e-8);
      });
    }
}



// Of drives that have more to do, the reported moment integrated over the angle is the work, to the order of Simpson's
// rule on the steps.
TEST(Drives, WorkIsMomentTimesAngle)
{
  for_all_systems([](const MovingSystem &what, const System &system, const State &start) {
    if (what.name != "prescribed rotation")
      return;
    const unsigned int n      = 40;
    const double       T      = 0.4;
    const unsigned int lambda = system.model.prescribed.begin()->second;
    StageIntegrator    integrator(system, Tableau(3, 1.), 1e-14);
    Projection         projection(system);
    double             work = 0, integral = 0;
    State              state = start;
    for (unsigned int i = 0; i <= n; ++i)
      {
        State reported = state;
        projection.report(reported);
        const double power = -reported.multipliers[lambda] * (2.4 * std::cos(3 * state.time) + 1);
        integral += power * T / (3. * n) * (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2);
        if (i < n)
          work += integrator.step(state, T / n).work_of_drives;
      }
    EXPECT_NEAR(work, integral, 1e-5 * std::abs(work));
  });
}



// The whole budget of an analysis, loads, drives, dampers and dissipation, to round-off.
TEST(Drives, BudgetOfAnAnalysis)
{
  for_all_systems([](const MovingSystem &what, const System &, const State &) {
    if (what.T == 0 || what.kick)
      return;
    std::ostringstream dynamic;
    dynamic << "set Analyses = dynamic\nsubsection Dynamic\n set End time = " << 20 * what.h
            << "\n set Step = " << what.h << "\n set Newton tolerance = 1e-14\n set Pictures = 0\nend\n";
    Scene scene(dynamic.str() + what.text);
    auto &analysis = scene.analysis<DynamicAnalysis>();
    analysis.run(scene.context);
    EXPECT_EQ(analysis.report.n_steps, 20u);
    EXPECT_EQ(analysis.report.n_failed, 0u);
    EXPECT_LT(analysis.report.largest_balance, 1e-12);
    const bool is_driven = !scene.system.model.prescribed.empty();
    EXPECT_EQ(std::abs(analysis.budget.drives) > 1e-3 * analysis.budget.kinetic, is_driven);
  });
}



// A hub that turns in its place, and the force that holds it there: no velocity depends on it, so that only a look at
// the force itself tells whether the factors, which are kept for a large part of a turn, still serve.
TEST(Drives, ForceOnAHubThatStaysInItsPlace)
{
  Scene         scene("prm/benchmarks/swept_tip_dynamics.prm");
  const System &system = scene.system;
  State         state  = system.reference();
  set_steady_motion(system, state, scene.context.speeds);
  StageIntegrator integrator(system, Tableau(3, 1.));
  double          largest = 0, largest_reported = 0;
  for (unsigned int i = 0; i < 1200; ++i)
    {
      ASSERT_TRUE(integrator.step(state, 2.5e-5).converged);
      State reported = state;
      if (i % 20 == 19)
        {
          Projection(system).report(reported);
          for (const double lambda : reported.multipliers)
            largest_reported = std::max(largest_reported, std::abs(lambda));
        }
      for (const double lambda : state.multipliers)
        largest = std::max(largest, std::abs(lambda));
    }
  EXPECT_LT(largest, 3 * largest_reported);
  EXPECT_GT(largest, 0.3 * largest_reported);
}



// What is reported of something that hardly moves: accelerations of a drive that starts from rest and stops, whatever
// its time is, also next to its corners; differences over a time in which nothing moves would be wrong there.
TEST(Drives, ReportsNextToRest)
{
  for (const double T : {1e-4, 1., 1e4})
    {
      const std::string tau = "(t/" + number_to_text("%.17g", T) + ")";
      Scene             scene(
        driven(false,
               "t < " + number_to_text("%.17g", T) + " ? 10*" + tau + "^3 - 15*" + tau + "^4 + 6*" + tau + "^5 : 1"));
      const double largest = 2 * 10 / std::sqrt(3.) / (T * T); // 2 kg
      for (const double x : {0., 1e-5, 1e-3, 0.01, 0.3, 0.5, 0.99, 0.9999, 1., 1.001, 1.5, 10.})
        {
          State &state                          = scene.context.state;
          state                                 = start_of({"", "", 0, 0}, scene.system);
          state.time                            = x * T;
          state.held                            = false;
          state.coordinates[0]                  = x < 1 ? x * x * x * (10 - 15 * x + 6 * x * x) : 1;
          Eigen::Map<Vector3> (&state.q[12])(2) = state.coordinates[0];
          Projection(scene.system).report(state);
          EXPECT_NEAR(scene.value("j.force 3"),
                      x < 1 ? 2 * (60 * x - 180 * x * x + 120 * x * x * x) / (T * T) : 0,
                      1e-5 * largest)
            << "at " << x << " of " << T;
        }
    }
}



// Fast and small oscillations: where their rate is zero, and where it is so small that nothing tells how fast they are.
TEST(Drives, ReportsFastOscillations)
{
  struct Oscillation
  {
    double amplitude, frequency;
  };
  for (const auto &[a, f] : {Oscillation{0.1, 10}, Oscillation{0.1, 7}, Oscillation{1e-5, 200}, Oscillation{1e-4, 1000}})
    {
      const double w = 2 * M_PI * f;
      Scene        scene(driven(false, number_to_text("%.17g", a) + "*sin(" + number_to_text("%.17g", w) + "*t)"));
      for (const double periods : {0., 0.25, 0.5, 0.75, 1., 3.1, 10.25, 47.337})
        {
          const double t                        = periods / f, value = a * std::sin(w * t);
          State       &state                    = scene.context.state;
          state                                 = start_of({"", "", 0, 0}, scene.system);
          state.time                            = t;
          state.held                            = false;
          state.coordinates[0]                  = value;
          Eigen::Map<Vector3> (&state.q[12])(2) = value;
          Projection(scene.system).report(state);
          EXPECT_NEAR(scene.value("j.force 3"), -2 * w * w * value, 1e-5 * 2 * w * w * a) << f << " Hz at " << t << " s";
        }
    }
}
