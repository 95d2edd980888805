// The shipped scenes with laws of the state against closed forms.

#include <samara/analysis/dynamic.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>
#include <samara/time/stepper.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** Go on to @p end with steps of @p h, switches and corners on the way. */
  State
  moved_to(const System &system, const Tableau &tableau, const double h, const double end)
  {
    StageIntegrator integrator(system, tableau, 1e-12);
    Stepper         stepper(system, integrator, h, 1e-12);
    State           state = system.reference();
    system.add_initial_velocities(state);
    state.held = false;
    Projection(system).velocities(state);
    for (unsigned int n = 0; n < 20000 && state.time < end; ++n)
      stepper.advance(state, end);
    EXPECT_NEAR(state.time, end, 1e-12);
    return state;
  }

  /** The polynomial at the complex number @p s, the highest power first. */
  std::complex<double>
  polynomial(const std::vector<double> &coefficients, const std::complex<double> &s)
  {
    std::complex<double> value = 0;
    for (const double c : coefficients)
      value = value * s + c;
    return value;
  }

  void
  expect_roots(const std::vector<Mode> &modes, const std::vector<double> &coefficients)
  {
    std::vector<double> absolute;
    for (const double c : coefficients)
      absolute.push_back(std::abs(c));
    EXPECT_GE(modes.size(), 2u); // one of a pair, one real
    for (const auto &mode : modes)
      EXPECT_LT(std::abs(polynomial(coefficients, mode.lambda)),
                1e-9 * polynomial(absolute, std::abs(mode.lambda)).real())
        << mode.lambda;
  }
} // namespace



// Amplitude from the energy, period from an elliptic integral.
TEST(LawScenes, HardeningSpring)
{
  const Scene  scene("prm/examples/laws/hardening_spring.prm");
  const double m = 2, k = 50, k3 = 2000, E = 0.5 * m * 0.36;
  const double A2 = (-k + std::sqrt(k * k + 4 * k3 * E)) / k3, // ½ k A² + ¼ k₃ A⁴ = E
    omega = std::sqrt((k + k3 * A2) / m), modulus = std::sqrt(k3 * A2 / (2 * (k + k3 * A2))),
               period = 4 * std::comp_ellint_1(modulus) / omega;
  // after a period where it began, after a quarter as far as it goes
  const State around = moved_to(scene.system, Tableau(3, 1.), period / 40, period);
  EXPECT_NEAR(around.coordinates[0], 0., 1e-7);
  EXPECT_NEAR(around.rates[0], 0.6, 1e-6);
  EXPECT_NEAR(moved_to(scene.system, Tableau(3, 1.), period / 40, period / 4).coordinates[0], std::sqrt(A2), 1e-8);
}



// Between the switches the motion is a parabola, which the family follows to round-off; what is left is where steps
// end.
TEST(LawScenes, Relay)
{
  const Scene scene("prm/examples/laws/relay.prm");
  for (const unsigned int s : {1, 2, 3})
    for (const double end : {0.9, 3.1, 9.})
      {
        const State  state = moved_to(scene.system, Tableau(s, s == 1 ? 1. : 0.5), 0.07, end);
        const double phase = std::fmod(end, 4.), side = phase < 2 ? 1 : -1, t = std::fmod(phase, 2.);
        EXPECT_NEAR(state.coordinates[0], side * (t - t * t / 2), 1e-6) << "s = " << s << ", t = " << end;
        EXPECT_NEAR(state.rates[0], side * (1 - t), 1e-6);
      }
}



TEST(LawScenes, PidPendulum)
{
  Scene scene("prm/examples/laws/pid_pendulum.prm");
  scene.equilibrium();
  expect_roots(scene.modes(), {0.32, 1.5, 20 - 1.2 * 9.80665 * 0.5, 30});
  // a steady force is balanced by the integral: 2 N at 0.5 m, upright
  const State state = moved_to(scene.system, Tableau(3, 0.5), 0.02, 20.);
  EXPECT_NEAR(state.coordinates[0], 0., 1e-9);
  EXPECT_NEAR(state.states[0], -2 * 0.5 / 30, 1e-9);
}



TEST(LawScenes, LagDamper)
{
  Scene scene("prm/examples/laws/lag_damper.prm");
  scene.equilibrium();
  const double I = 140, k = 0.3 * 40 * 900, tau = 0.05;
  expect_roots(scene.modes(), {tau * I, I, tau * k + 400, k});
}



// A governor that sees the rotor and drives the turbine: against two inertias with the shafts as a spring between them.
TEST(LawScenes, GovernorOfTheTailRotor)
{
  Scene scene("prm/rotorcraft/tail_rotor_governor.prm");
  scene.equilibrium();
  EXPECT_NEAR(scene.value("engine"), 200., 1e-5); // what statics leave unbalanced
  const double shaft = 6 + 1.2 * std::sqrt(2.), own = 0.5 * 0.002 * shaft, J1 = 0.50005 + own,
               J2 = (3 + 4 * (2.45 * 0.992 / 3 + 0.6)) / 4 + own, k = 1 / (shaft / 22.1e3 + 4e-5),
               c = 40 * std::pow(k / 1e5, 2), B = 10, K = 60, T = 0.1;
  const auto defect = [&](const std::complex<double> &s) {
    const std::complex<double> kk = k + c * s;
    return ((J1 * s * s + kk) * (J2 * s * s + B * s + kk) - kk * kk) * (1. + T * s) / s + kk * K;
  };
  for (std::complex<double> s : {std::complex<double>(-7, 15), std::complex<double>(-0.2, 78)})
    {
      for (unsigned int i = 0; i < 30; ++i) // Newton's method, by differences
        {
          const double h = 1e-5;
          s -= defect(s) * h / (defect(s + h) - defect(s));
        }
      double nearest = 1e300;
      for (const auto &mode : scene.modes())
        nearest = std::min(nearest, std::abs(mode.lambda - s));
      EXPECT_LT(nearest, 4e-3 * std::abs(s)) << s;
    }
}



// Where a controller slides along its switch, time does not go on: the run says so.
TEST(LawScenes, SlidingIsRefused)
{
  const Scene scene(
    "prm/examples/laws/relay.prm",
    {"Joints/slide/displacement/Force = slide.displacement rate > 0 ? -3 N : slide.displacement rate < 0 ? 3 N : 0 N",
     "Joints/slide/displacement/Spring = 1"});
  StageIntegrator integrator(scene.system, Tableau(2, 0.5), 1e-12);
  Stepper         stepper(scene.system, integrator, 0.07, 1e-12);
  State           state = scene.system.reference();
  scene.system.add_initial_velocities(state);
  state.held = false;
  Projection(scene.system).velocities(state);
  try
    {
      while (state.time < 2)
        stepper.advance(state, 2.);
      ADD_FAILURE() << "it came to t = " << state.time;
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("slides along a switch"), std::string::npos) << problem.what();
    }
}
