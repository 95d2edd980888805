// Step control: the dissipation relation of an oscillator, what a step says about its error, decisions, and errors in
// proportion to the tolerance.
//
// References: the amplification R(z) = 1 + z bᵀ(I − z a_α)⁻¹ 1 of the tableau, its derivative by α, an oscillator that
// is free or loaded from rest, and a pendulum that swings to x = 2 asin k, sin(x/2) = k sn t.

#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/time/stepper.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  const double infinity = std::numeric_limits<double>::infinity();

  /** Stages (I − z a_α)⁻¹ 1 of an oscillator. */
  Eigen::VectorXcd
  oscillator_stages(const Tableau &t, const std::complex<double> z)
  {
    const Eigen::MatrixXcd A = Eigen::MatrixXcd::Identity(t.s, t.s) - z * t.a_alpha.cast<std::complex<double>>();
    return solution(A, Eigen::VectorXcd::Ones(t.s));
  }

  std::complex<double>
  amplification(const Tableau &t, const std::complex<double> z)
  {
    return 1. + z * t.b.cast<std::complex<double>>().cwiseProduct(oscillator_stages(t, z)).sum();
  }

  template <class Check>
  void
  for_wide_members(const Check &check)
  {
    for (unsigned int s = 1; s <= 3; ++s)
      for (const double rho : {0., 0.3, 0.8, 0.99, 1.})
        {
          SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
          check(Tableau(s, rho));
        }
  }
} // namespace



TEST(DissipationRelation, IsThatOfTheTableau)
{
  for_wide_members([](const Tableau &t) {
    for (double Y = 1e-2; Y < 1e9; Y *= 3)
      {
        const std::complex<double> z(0, std::sqrt(Y));
        const auto                 p    = t.b.cwiseProduct(t.p).cast<std::complex<double>>();
        const double               sum  = std::norm(p.cwiseProduct(oscillator_stages(t, z)).sum());
        const double               zeta = DissipationRelation(t).value(Y);
        EXPECT_NEAR(zeta / (Y / (2. * t.s - 1) * sum), 1, 1e-11) << Y;
        EXPECT_NEAR(std::norm(amplification(t, z)), 1 - t.alpha * zeta, 1e-13) << Y;
      }
  });
}



TEST(DissipationRelation, IncreasesToItsLimit)
{
  for_wide_members([](const Tableau &t) {
    const DissipationRelation relation(t);
    EXPECT_EQ(relation.value(0), 0);
    for (double Y = 1e-10; Y < 1e6; Y *= 2)
      EXPECT_LT(relation.value(Y), relation.value(2 * Y)) << Y;
    EXPECT_NEAR(relation.value(1e18), 4 / std::pow(1 + t.alpha, 2), 1e-13);
  });
}



TEST(DissipationRelation, Inverse)
{
  for_wide_members([](const Tableau &t) {
    const DissipationRelation relation(t);
    const double              limit = 4 / std::pow(1 + t.alpha, 2);
    for (double zeta = 1e-60; zeta < 0.9 * limit; zeta *= 1.7)
      EXPECT_NEAR(relation.value(relation.inverse(zeta)) / zeta, 1, 1e-14) << zeta;
    for (double Y = 1e-20; Y < 10; Y *= 1.7)
      EXPECT_NEAR(relation.inverse(relation.value(Y)) / Y, 1, 1e-12) << Y;
    for (const double gap : {1e-2, 1e-6, 1e-10})
      EXPECT_NEAR(relation.value(relation.inverse(limit * (1 - gap))) / limit, 1 - gap, 1e-15) << gap;
    EXPECT_EQ(relation.inverse(limit * (1 + 1e-12)), infinity);
    EXPECT_EQ(relation.inverse(infinity), infinity);
    EXPECT_EQ(relation.inverse(0), 0);
    EXPECT_EQ(relation.inverse(-1), 0);
  });
}



TEST(DissipationRelation, ErrorOfAPeriod)
{
  for_wide_members([](const Tableau &t) {
    const DissipationRelation  relation(t);
    const double               h = t.s == 1 ? 1e-3 : 0.05;
    const std::complex<double> z(0, h);
    const double               error = 2 * M_PI / h * std::abs(amplification(t, z) * std::exp(-z) - 1.);
    EXPECT_NEAR(relation.period_error(h * h) / error, 1, 5e-3);
    for (double tolerance = 1e-14; tolerance < 1; tolerance *= 10)
      EXPECT_NEAR(relation.period_error(relation.inverse_period_error(tolerance)) / tolerance, 1, 1e-12);
  });
}



namespace
{
  /** A step with the error @p error and nothing else. */
  StepController::Judged
  of_error(const double error)
  {
    return {error, 0., 0.};
  }
} // namespace



TEST(StepController, StepsHaveHalfOfWhatTheyMay)
{
  // errors of order 2s, or 2s + 1 without dissipation: c h^{order of error − 1} tends to 1
  for_wide_members([](const Tableau &t) {
    StepController::Settings settings;
    settings.tolerance      = 1e-4;
    settings.duration       = 10;
    settings.length         = 2;
    settings.worth_a_change = 1;
    StepController control(t, settings);
    const double   order = t.alpha < 0.1 ? 2 * t.s + 1 : 2 * t.s;
    double         h     = 1e-3;
    // c = 1 at h = 0.3
    const double factor = 0.5 * 1e-4 * 2 / 10 * std::pow(0.3, 1 - order);
    for (unsigned int i = 0; i < 60; ++i)
      {
        const auto decision = control.decide(of_error(factor * std::pow(h, order)), h);
        EXPECT_TRUE(decision.accept) << h;
        EXPECT_LE(decision.next_h, 0.33);
        h = decision.next_h;
      }
    EXPECT_NEAR(h, 0.3, 0.3 * 0.035);
    EXPECT_EQ(control.n_rejections, 0u);
  });
}



TEST(StepController, LongerRunsAndShorterLengthsAllowLess)
{
  const auto next = [](const double duration, const double length, const double displacement) {
    StepController::Settings settings;
    settings.duration = duration;
    settings.length   = length;
    StepController control(Tableau(2, 1.), settings);
    control.update(1, displacement);
    return control.decide(of_error(1e-7), 1e-2).next_h;
  };
  const double base = next(10, 1, 0);
  EXPECT_LT(next(20, 1, 0), base);
  EXPECT_LT(next(10, 0.5, 0), base);
  EXPECT_EQ(next(20, 1, 2), base); // the largest displacement counts if it is more
  EXPECT_EQ(next(10, 1, 0.5), base);
}



TEST(StepController, RejectsTwiceWhatItAimsAt)
{
  StepController::Settings settings;
  settings.tolerance     = 1e-4;
  settings.smallest_step = 1e-3;
  settings.largest_step  = 0.5;
  const double allowed   = 1e-4 * 0.1;
  for (const double share : {0.1, 0.99, 1.01, 1e3})
    {
      StepController control(Tableau(3, 0.5), settings);
      const auto     d = control.decide(of_error(share * allowed), 0.1);
      EXPECT_EQ(d.accept, share < 1) << share;
      EXPECT_EQ(d.next_h<0.1, share> 0.6) << share;
      EXPECT_GE(d.next_h, 0.02);
      EXPECT_LE(d.next_h, 0.1 * (1 + M_PI / 2));
      EXPECT_EQ(control.n_rejections, share > 1 ? 1u : 0u);
      EXPECT_NEAR(control.share() / share, 1, 1e-12);
    }
  StepController control(Tableau(3, 0.5), settings);
  EXPECT_DOUBLE_EQ(control.decide(of_error(0), 0.4).next_h, 0.5);
  EXPECT_DOUBLE_EQ(control.decide(of_error(1), 2e-3).next_h, 1e-3);
  EXPECT_TRUE(control.decide(of_error(1), 1e-3).accept); // the smallest step is accepted
  EXPECT_EQ(control.n_forced, 1u);
}



TEST(StepController, EnergyIsAGuard)
{
  for_wide_members([](const Tableau &t) {
    StepController control(t, {});
    control.update(3., 0.);
    EXPECT_NEAR(control.relation.period_error(control.Y_guard), 0.1, 1e-12);
    const double w = 40, right = std::sqrt(control.Y_guard) / w;
    for (const double factor : {0.9, 1., 2.5})
      {
        const double h        = factor * right;
        const auto   decision = control.decide({0., 3. * control.relation.value(std::pow(w * h, 2)), 0.}, h);
        EXPECT_NEAR(decision.next_h / right, std::max(0.9, 0.3 * factor), 1e-9);
        EXPECT_EQ(decision.accept, factor <= 1);
      }
  });
}



TEST(StepController, AfterAFailureStepsGrowSlowly)
{
  StepController::Settings settings;
  settings.smallest_step = 1e-3;
  StepController control(Tableau(3, 0.5), settings);
  EXPECT_DOUBLE_EQ(control.after_failure(0.2), 0.1);
  double h = 0.1;
  for (unsigned int i = 1; i < 8; ++i)
    {
      const double next = control.decide(of_error(0), h).next_h;
      EXPECT_LE(next, 0.16 * std::pow(1.05, i) * (1 + 1e-12));
      EXPECT_GE(next, h);
      h = next;
    }
  EXPECT_GT(h, 0.2);
  EXPECT_EQ(control.n_failures, 1u);
  EXPECT_DOUBLE_EQ(control.after_failure(1.5e-3), 1e-3);
  EXPECT_THROW(control.after_failure(1e-3), NotConverged);
}



TEST(StepController, ALimitThatFailsIsLowered)
{
  StepController control(Tableau(3, 0.5), {});
  control.after_failure(0.2);
  const double limit = control.decide(of_error(0), 0.1).next_h;
  EXPECT_DOUBLE_EQ(limit, 0.16 * 1.05);
  EXPECT_DOUBLE_EQ(control.after_failure(limit), limit / 2);
  EXPECT_DOUBLE_EQ(control.decide(of_error(0), limit / 2).next_h, 0.6 * 1.05 * limit);
}



TEST(StepController, StepsOfManyIterationsAreShortened)
{
  StepController control(Tableau(3, 0.5), {});
  EXPECT_GT(control.decide({0., 0., 0., 30}, 0.1).next_h, 0.1);
  EXPECT_DOUBLE_EQ(control.decide({0., 0., 0., 31}, 0.1).next_h, 0.09);
  EXPECT_DOUBLE_EQ(control.decide(of_error(0), 0.09).next_h, 0.09 * 1.05);
}



TEST(StepController, WithoutEnergy)
{
  StepController control(Tableau(2, 0.), {});
  EXPECT_TRUE(control.decide({0., 0., 0.}, 0.1).accept);
  EXPECT_FALSE(control.decide({0., 1e-20, 0.}, 0.1).accept);
  control.update(1e-10, 0); // the least that matters
  EXPECT_TRUE(control.decide({0., 1e-20, 0.}, 0.1).accept);
}



TEST(StepController, RefusesSettings)
{
  const auto refused = [](const auto &change) {
    StepController::Settings settings;
    change(settings);
    EXPECT_THROW(StepController(Tableau(2, 0.5), settings), std::invalid_argument);
  };
  refused([](auto &s) { s.tolerance = 0; });
  refused([](auto &s) { s.tolerance = 1; });
  refused([](auto &s) { s.smallest_step = 0; });
  refused([](auto &s) { s.largest_step = 1e-10; });
  refused([](auto &s) { s.duration = 0; });
  refused([](auto &s) { s.length = 0; });
  refused([](auto &s) { s.guard = 0; });
  refused([](auto &s) { s.worth_a_change = 0.9; });
}



namespace
{
  State
  displaced(const System &system, const double by)
  {
    State state = system.reference();
    state.q[14] += by;
    state.coordinates[0] = by;
    system.stresses(state, state.stress);
    return state;
  }
} // namespace



// |∂Y_f/∂α| = ½ ζ |Y_i| for an oscillator, exactly, for every s, α and step.
TEST(Neighbour, OfAnOscillatorIsHalfOfWhatIsLost)
{
  const Scene scene(pushed("0"));
  for_wide_members([&](const Tableau &t) {
    for (const double angle : {0.1, 1., 5., 40.})
      {
        const double    w = 5, h = angle / w, amplitude = 0.01;
        StageIntegrator integrator(scene.system, t, 1e-13);
        integrator.wants_estimates = true;
        State      state           = displaced(scene.system, amplitude);
        const auto result          = integrator.step(state, h);
        ASSERT_TRUE(result.converged);
        const double x = result.difference.neighbour.displacement[2], v = result.difference.neighbour.rate[2];
        const double expected = 0.5 * DissipationRelation(t).value(angle * angle) * amplitude;
        EXPECT_NEAR(std::hypot(x, v / w) / expected, 1, 1e-6) << angle;
      }
  });
}



namespace
{
  struct Result
  {
    double       error;
    unsigned int n_steps = 0, n_rejected = 0;
  };

  /** Distance of (x, v/ω) of the body from @p exact at @p T. */
  Result
  integrate(const Scene                                &scene,
            State                                       state,
            const Tableau                              &t,
            const double                                tolerance,
            const double                                length,
            const double                                T,
            const std::function<double(const State &)> &error)
  {
    StageIntegrator          integrator(scene.system, t, 1e-12);
    StepController::Settings settings;
    settings.tolerance    = tolerance;
    settings.duration     = T;
    settings.length       = length;
    settings.largest_step = T / 10;
    Stepper stepper(scene.system, integrator, 1e-2, settings);
    Result  result;
    while (state.time < T)
      {
        const Advance advance = stepper.advance(state, T);
        ++result.n_steps;
        result.n_rejected += advance.n_rejected;
      }
    result.error = error(state) / length;
    return result;
  }

  /** Errors between @p least and @p most tolerances, more steps for smaller tolerances. */
  void
  expect_proportional(const Scene                                &scene,
                      const State                                &start,
                      const double                                length,
                      const double                                T,
                      const double                                least,
                      const double                                most,
                      const std::function<double(const State &)> &error)
  {
    for (const auto &[s, rho] : {std::make_pair(2, 0.), {2, 0.5}, {2, 1.}, {3, 0.}, {3, 0.5}, {3, 1.}, {1, 1.}})
      {
        unsigned int n_before = 0;
        for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
          {
            if (s == 1 && tolerance < 1e-4)
              continue;
            SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho) + ", " +
                         std::to_string(tolerance));
            const Result result = integrate(scene, start, Tableau(s, rho), tolerance, length, T, error);
            EXPECT_GT(result.error, least * tolerance);
            EXPECT_LT(result.error, most * tolerance);
            EXPECT_GE(result.n_steps, n_before);
            EXPECT_LE(result.n_rejected, 10 + result.n_steps / 5);
            n_before = result.n_steps;
          }
      }
  }
} // namespace



TEST(ErrorOverTolerance, Oscillator)
{
  // three periods
  const Scene  scene(pushed("0"));
  const double w = 5, T = 6 * M_PI / w;
  expect_proportional(scene, displaced(scene.system, 0.1), 0.1, T, 0.1, 2, [&](const State &state) {
    return std::hypot(state.coordinates[0] - 0.1, state.rates[0] / w);
  });
}



TEST(ErrorOverTolerance, LoadedFromRest)
{
  const Scene  scene(pushed("5"));
  const double w = 5, T = 5 * M_PI / w;
  expect_proportional(scene, scene.system.reference(), 0.2, T, 0.05, 2, [&](const State &state) {
    return std::hypot(state.coordinates[0] - 0.2, state.rates[0] / w);
  });
}



TEST(ErrorOverTolerance, LoadsBetweenTheStages)
{
  // a blow of a tenth of a second without corners, when everything is at rest; 2 N s
  const Scene  scene(pushed("2/(0.03*sqrt(pi))*exp(-((t - 0.5)/0.03)^2)"));
  const double w = 5, T = 0.5 + 2 * M_PI / w, push = std::exp(-std::pow(0.03 * w / 2, 2));
  expect_proportional(scene, scene.system.reference(), 0.2, T, 1e-4, 2, [&](const State &state) {
    return std::hypot(state.coordinates[0], state.rates[0] / w - 2 / (2 * w) * push);
  });
}
