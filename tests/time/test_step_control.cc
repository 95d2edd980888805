// Step control: the dissipation relation of an oscillator, decisions, and errors proportional to the tolerance.
//
// References: the amplification R(z) = 1 + z bᵀ(I − z a_α)⁻¹ 1 of the tableau, and two problems whose solutions are
// known, a pendulum that swings to x = 2 asin k, Y = 2k (cn t, sn t), and one that is loaded from rest.

#include <samara/base/errors.h>
#include <samara/time/step_control.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

using namespace samara;

namespace
{
  const double infinity = std::numeric_limits<double>::infinity();

  /** Stages (I − z a_α)⁻¹ 1 of an oscillator. */
  Eigen::VectorXcd
  oscillator_stages(const Tableau &t, const std::complex<double> z)
  {
    const Eigen::MatrixXcd A = Eigen::MatrixXcd::Identity(t.s, t.s) - z * t.a_alpha.cast<std::complex<double>>();
    return A.partialPivLu().solve(Eigen::VectorXcd::Ones(t.s));
  }

  std::complex<double>
  amplification(const Tableau &t, const std::complex<double> z)
  {
    return 1. + z * t.b.cast<std::complex<double>>().cwiseProduct(oscillator_stages(t, z)).sum();
  }

  template <class Check>
  void
  for_all_members(const Check &check)
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
  for_all_members([](const Tableau &t) {
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
  for_all_members([](const Tableau &t) {
    const DissipationRelation relation(t);
    EXPECT_EQ(relation.value(0), 0);
    for (double Y = 1e-10; Y < 1e6; Y *= 2)
      EXPECT_LT(relation.value(Y), relation.value(2 * Y)) << Y;
    EXPECT_NEAR(relation.value(1e18), 4 / std::pow(1 + t.alpha, 2), 1e-13);
  });
}



TEST(DissipationRelation, Inverse)
{
  for_all_members([](const Tableau &t) {
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
  for_all_members([](const Tableau &t) {
    const DissipationRelation  relation(t);
    const double               h = t.s == 1 ? 1e-3 : 0.05;
    const std::complex<double> z(0, h);
    const double               error = 2 * M_PI / h * std::abs(amplification(t, z) * std::exp(-z) - 1.);
    EXPECT_NEAR(relation.period_error(h * h) / error, 1, 5e-3);
    for (double tolerance = 1e-14; tolerance < 1; tolerance *= 10)
      EXPECT_NEAR(relation.period_error(relation.inverse_period_error(tolerance)) / tolerance, 1, 1e-12);
  });
}



TEST(StepController, ReachesTheRightStepAtOnce)
{
  for_all_members([](const Tableau &t) {
    StepController control(t, {});
    control.update(3.);
    EXPECT_NEAR(control.relation.period_error(control.Y_target), 1e-4, 1e-15);
    const double w = 40, right = std::sqrt(control.Y_target) / w;
    for (const double factor : {0.5, 0.7, 0.85, 1., 2.5})
      {
        const double h        = factor * right;
        const auto   decision = control.decide(3. * control.relation.value(std::pow(w * h, 2)), 0., h);
        const bool   stays    = factor > 0.8 && factor < 1.03; // not worth a change
        EXPECT_NEAR(decision.next_h / right, stays ? factor : 0.9, 1e-12);
        EXPECT_EQ(decision.accept, factor <= 1);
      }
    EXPECT_EQ(control.n_rejections, 1u);
  });
}



TEST(StepController, Limits)
{
  StepController::Settings settings;
  settings.worth_a_change = 1; // the formula itself
  settings.smallest_step  = 1e-3;
  settings.largest_step   = 0.5;
  StepController control(Tableau(2, 0.5), settings);
  control.update(2);
  control.update(1); // the largest counts
  EXPECT_EQ(control.E_ref, 2);
  const double target = 2 * control.zeta_target;

  auto d = control.decide(1e-6 * target, 0., 0.1);
  EXPECT_TRUE(d.accept);
  EXPECT_DOUBLE_EQ(d.next_h, 0.2); // at most twice as long
  EXPECT_DOUBLE_EQ(control.decide(1e-6 * target, 0., 0.4).next_h, 0.5);
  EXPECT_TRUE(control.decide(1.99 * target, 0., 0.1).accept);

  d = control.decide(2.01 * target, 0., 0.1);
  EXPECT_FALSE(d.accept);
  EXPECT_LT(d.next_h, 0.09);
  d = control.decide(100., 0., 0.1); // more than any oscillator can lose
  EXPECT_FALSE(d.accept);
  EXPECT_DOUBLE_EQ(d.next_h, 0.03);
  d = control.decide(100., 0., 2e-3);
  EXPECT_FALSE(d.accept);
  EXPECT_DOUBLE_EQ(d.next_h, 1e-3);
  EXPECT_EQ(control.n_forced, 0u);
  d = control.decide(100., 0., 1e-3);
  EXPECT_TRUE(d.accept); // the smallest step is accepted
  EXPECT_DOUBLE_EQ(d.next_h, 1e-3);
  EXPECT_EQ(control.n_forced, 1u);
  EXPECT_EQ(control.n_rejections, 3u);
}



TEST(StepController, NoLongerStepAfterARejectionOrFailure)
{
  StepController control(Tableau(3, 0.5), {});
  control.update(1);
  EXPECT_FALSE(control.decide(1., 0., 0.1).accept);
  EXPECT_DOUBLE_EQ(control.decide(0., 0., 0.1).next_h, 0.1);
  EXPECT_DOUBLE_EQ(control.decide(0., 0., 0.1).next_h, 0.2);
  EXPECT_DOUBLE_EQ(control.after_failure(0.2), 0.1);
  EXPECT_FALSE(control.decide(1., 0., 0.1).accept);
  for (unsigned int i = 0; i < 10; ++i)
    EXPECT_DOUBLE_EQ(control.decide(0., 0., 0.1).next_h, 0.1);
  EXPECT_DOUBLE_EQ(control.decide(0., 0., 0.1).next_h, 0.2);
  EXPECT_EQ(control.n_rejections, 2u);
  EXPECT_EQ(control.n_failures, 1u);
}



TEST(StepController, FailureAtTheSmallestStepIsTheEnd)
{
  StepController::Settings settings;
  settings.worth_a_change = 1; // the formula itself
  settings.smallest_step  = 1e-3;
  StepController control(Tableau(3, 0.5), settings);
  EXPECT_DOUBLE_EQ(control.after_failure(1.5e-3), 1e-3);
  EXPECT_THROW(control.after_failure(1e-3), NotConverged);
}



TEST(StepController, WithoutEnergy)
{
  StepController control(Tableau(2, 0.), {});
  EXPECT_TRUE(control.decide(0., 0., 0.1).accept);
  EXPECT_FALSE(control.decide(1e-20, 0., 0.1).accept);
  control.update(1e-10); // the least that matters
  EXPECT_TRUE(control.decide(1e-20, 0., 0.1).accept);
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
  refused([](auto &s) { s.safety = 1.1; });
  refused([](auto &s) { s.least_ratio = 1; });
  refused([](auto &s) { s.largest_ratio = 1; });
  refused([](auto &s) { s.reject_factor = 0.5; });
}



namespace
{
  /**
   * x" = −sin x + torque, in the form of the design notes: q = (cos x/2, sin x/2), q̇ = v/2 J q, strain e = 2 sin x/2,
   * ė = q₀ v, v̇ = −q₀ e + torque; Y = (v, e) turns with the rate q₀ and energy ½|Y|² = ½ẋ² + 1 − cos x.
   */
  struct Pendulum
  {
    Eigen::Vector2d q;
    double          v, torque;

    Eigen::Vector2d
    Y() const
    {
      return {v, 2 * q(1)};
    }

    /** One step of the family, by fixed-point iteration; size: of Y. Returns D/α, negative if it did not converge. */
    double
    step(const Tableau &t, const double h, const double size)
    {
      using Stages    = Eigen::Matrix<double, 2, Eigen::Dynamic>; // one column a stage
      const Stages Y0 = Y().replicate(1, t.s), q0 = q.replicate(1, t.s);
      Stages       Y_k = Y0, Q = q0, F(2, t.s), dQ(2, t.s);
      for (unsigned int i = 0; i < 100; ++i)
        {
          for (unsigned int k = 0; k < t.s; ++k)
            {
              F.col(k) << torque - Q(0, k) * Y_k(1, k), Q(0, k) * Y_k(0, k);
              dQ.col(k) << -Y_k(0, k) / 2 * Q(1, k), Y_k(0, k) / 2 * Q(0, k);
            }
          const Stages last = Y_k;
          Y_k               = Y0 + h * F * t.a_alpha.transpose();
          Q                 = q0 + h * dQ * t.a.transpose();
          if ((Y_k - last).norm() < 1e-15 * size)
            {
              q += h * dQ * t.b;
              v += h * F.row(0) * t.b;
              return h * h / (2 * (2. * t.s - 1)) * (F * t.b.cwiseProduct(t.p)).squaredNorm();
            }
        }
      return -1;
    }
  };

  /** Jacobi's sn and cn of modulus k, by the arithmetic-geometric mean. */
  Eigen::Vector2d
  cn_sn(const double t, const double k)
  {
    std::vector<double> ratios;
    double              a = 1, b = std::sqrt(1 - k * k), scale = 1;
    for (double c = k; c > 1e-17; scale *= 2)
      {
        c              = (a - b) / 2;
        const double m = (a + b) / 2;
        b              = std::sqrt(a * b);
        a              = m;
        ratios.push_back(c / a);
      }
    double phase = scale * a * t;
    for (auto ratio = ratios.rbegin(); ratio != ratios.rend(); ++ratio)
      phase = (phase + std::asin(*ratio * std::sin(phase))) / 2;
    return {std::cos(phase), std::sin(phase)};
  }

  /** k > 0: swings freely from the bottom; k = 0: loaded from rest by a small torque, Y = torque (sin t, 1 − cos t). */
  struct Problem
  {
    double k, torque, T, first_step;

    double
    size() const
    {
      return k > 0 ? 2 * k : 2 * torque;
    }

    Eigen::Vector2d
    exact() const
    {
      return k > 0 ? 2 * k * cn_sn(T, k) : torque * Eigen::Vector2d(std::sin(T), 1 - std::cos(T));
    }
  };

  struct Result
  {
    double       error; ///< at T, relative to the largest Y
    unsigned int n_steps = 0, n_rejections = 0;
  };

  Result
  integrate(const Problem &problem, const Tableau &t, const double tolerance)
  {
    StepController::Settings settings;
    settings.worth_a_change = 1; // the formula itself
    settings.tolerance      = tolerance;
    StepController control(t, settings);
    Pendulum       state = {{1, 0}, 2 * problem.k, problem.torque};
    Result         result;
    double         time = 0, h = problem.first_step;
    control.update(state.Y().squaredNorm() / 2);
    while (time < problem.T)
      {
        Pendulum     next      = state;
        const double step      = std::min(h, problem.T - time);
        const double indicator = next.step(t, step, problem.size());
        if (indicator < 0)
          {
            h = control.after_failure(step);
            continue;
          }
        const double before = state.Y().squaredNorm() / 2, after = next.Y().squaredNorm() / 2;
        const double work = 2 * problem.torque * std::asin(state.q(0) * next.q(1) - state.q(1) * next.q(0));
        EXPECT_NEAR(after - before, work - t.alpha * indicator, 1e-11 * std::pow(problem.size(), 2));
        control.update(after);
        const auto decision = control.decide(indicator, 0., step);
        h                   = decision.next_h;
        if (decision.accept)
          {
            time += step;
            state = next;
            ++result.n_steps;
          }
      }
    result.error        = (state.Y() - problem.exact()).norm() / problem.size();
    result.n_rejections = control.n_rejections;
    return result;
  }

  /** Errors between @p least and @p most tolerances; slope of log error over log tolerance 1 ± @p slope_error. */
  void
  expect_proportional(const Problem     &problem,
                      const unsigned int s,
                      const double       rho,
                      const double       least,
                      const double       most,
                      const double       slope_error)
  {
    SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
    // one stage with dissipation is of first order: one decade is enough
    const double first = s > 1 ? 3 : 2, last = s > 1 ? 8 : rho == 1 ? 6 : 3;
    double       covariance = 0, variance = 0;
    for (double decade = first; decade <= last; decade += 0.5)
      {
        const double tolerance = std::pow(10., -decade), x = decade - (first + last) / 2;
        const Result result = integrate(problem, Tableau(s, rho), tolerance);
        EXPECT_GT(result.error, least * tolerance);
        EXPECT_LT(result.error, most * tolerance);
        EXPECT_LE(result.n_rejections, 8 + result.n_steps / 8);
        covariance -= x * std::log10(result.error);
        variance += x * x;
      }
    EXPECT_NEAR(covariance / variance, 1, slope_error);
  }
} // namespace



TEST(ErrorOverTolerance, LinearOscillator)
{
  // two periods of a pendulum that swings by 2e-6: 2 · 0.9^(2s−1) … 2 · 0.9^(2s) tolerances, as all steps have 0.9 of
  // the length that was asked for
  for (const double first_step : {1e-3, 5.})
    for (unsigned int s = 1; s <= 3; ++s)
      for (const double rho : {0., 0.5, 0.98, 1.})
        expect_proportional({1e-6, 0, 4 * M_PI, first_step}, s, rho, 0.7, 1.85, 0.05);
}



TEST(ErrorOverTolerance, Pendulum)
{
  // more than two swings by 128°. What it loses in amplitude changes its period, which multiplies errors.
  for (unsigned int s = 1; s <= 3; ++s)
    for (const double rho : {0., 0.5, 1.})
      expect_proportional({0.9, 0, 20, 0.1}, s, rho, 0.1, 20, 0.1);
}



TEST(ErrorOverTolerance, LoadedFromRest)
{
  for (const double first_step : {1e-6, 0.5})
    for (unsigned int s = 1; s <= 3; ++s)
      for (const double rho : {0., 0.5, 1.})
        expect_proportional({0, 1e-6, 4 * M_PI, first_step}, s, rho, 0.8, 3, 0.05);
}
