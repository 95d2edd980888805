// Multipliers of motions with nonlinear springs.
//
// Reference: Hammond's rotor with linear springs of the same moment and slope where it turns steadily; Duffing's
// oscillator, its motion and variational equation by Runge and Kutta's method of fourth order.

#include <samara/analysis/floquet.h>

#include "../scene.h"
#include "../states/scenes.h"
#include <gtest/gtest.h>

#include <cmath>

#include "floquet_models.h"

using namespace samara;

namespace
{
  std::vector<std::complex<double>>
  multipliers_of(Scene &scene)
  {
    auto &analysis = scene.analysis<FloquetAnalysis>();
    if (scene.input.has_analysis("static"))
      scene.equilibrium();
    analysis.run(scene.context);
    std::vector<std::complex<double>> result;
    for (const auto &mode : analysis.modes)
      result.push_back(mode.multiplier);
    return result;
  }

  constexpr double forcing = 10, omega = 5; // N, rad/s

  /** x, ẋ, and two changes of both, of 2 ẍ + 1.5 ẋ + 50 x + 2000 x³ = 10 cos 5t. */
  using Swing = Eigen::Matrix<double, 6, 1>;

  Swing
  rates_of_swing(const double t, const Swing &u)
  {
    const double slope = 50 + 6000 * u(0) * u(0);
    Swing        rates;
    rates << u(1), (forcing * std::cos(omega * t) - 1.5 * u(1) - (50 + 2000 * u(0) * u(0)) * u(0)) / 2, u(3),
      -(1.5 * u(3) + slope * u(2)) / 2, u(5), -(1.5 * u(5) + slope * u(4)) / 2;
    return rates;
  }

  void
  swing_through_period(Swing &u, const unsigned int n)
  {
    const double h = 2 * M_PI / omega / n;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double t   = i * h;
        const Swing  k_1 = rates_of_swing(t, u), k_2 = rates_of_swing(t + h / 2, u + h / 2 * k_1),
                    k_3 = rates_of_swing(t + h / 2, u + h / 2 * k_2), k_4 = rates_of_swing(t + h, u + h * k_3);
        u += h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + k_4);
      }
  }
} // namespace



// A motion far from small: it stretches the spring to where it is more than twice as stiff.
TEST(FloquetNonlinearSprings, OfDuffingsOscillator)
{
  Swing u = Swing::Zero();
  for (unsigned int i = 0; i < 60; ++i)
    swing_through_period(u, 400);
  u(2) = u(5) = 1;
  swing_through_period(u, 4000);
  EXPECT_GT(6000 * u(0) * u(0), 25.);
  const double trace = u(2) + u(5), product = std::exp(-1.5 / 2 * 2 * M_PI / omega);
  EXPECT_NEAR(u(2) * u(5) - u(3) * u(4), product, 1e-10); // Liouville

  Scene      scene("set Analyses = floquet\n" +
              on_a_slide("",
                         "set Damper = 1.5\n set Force = 10*cos(5*t)\n"
                              " set Spring force = 50*slide.displacement + 2000*slide.displacement^3") +
              "subsection Floquet\n set Period = 2*pi/5\n set Steps = 64\n set Settle = 12\nend\n");
  const auto found = multipliers_of(scene);
  ASSERT_FALSE(found.empty());
  // of a pair of complex ones only the first is told
  const std::complex<double> other = found.size() > 1 ? found[1] : std::conj(found[0]);
  EXPECT_NEAR((found[0] + other).real(), trace, 1e-7);
  EXPECT_NEAR((found[0] * other).real(), product, 1e-7);
}



// Blades that a moment holds at a lag of 0.08 rad against springs that harden, and against the rotation, S e Ω² sin ζ.
// Small motions are those on linear springs with the same moment and slope there, and so are the multipliers.
TEST(FloquetNonlinearSprings, OfHammondsRotor)
{
  const double k = 2e4, k_3 = 4e6, lag = 0.08, spring = k * lag + k_3 * lag * lag * lag,
               slope = k + 3 * k_3 * lag * lag, Omega = 10 * M_PI,
               moment = spring + 289.1 * 0.3048 * Omega * Omega * std::sin(lag);
  const auto text     = [](const double number) { return number_to_text("%.17g", number); };
  const auto with     = [&](const std::vector<std::string> &entries) {
    const std::string        rotation = "Subsystems/blade/Joints/lag/rotation/";
    std::vector<std::string> all      = {"Analyses = static, floquet",
                                         "Floquet/Method = fast",
                                         "Floquet/Steps = 24",
                                         rotation + "Moment = " + text(moment)};
    for (const auto &entry : entries)
      all.push_back(rotation + entry);
    Scene      scene(floquet_models::hammond, all);
    const auto result = multipliers_of(scene);
    EXPECT_NEAR(scene.value("blade 1:lag.rotation"), lag * 180 / M_PI, 1e-7);
    return result;
  };
  const auto hardening = with({"Spring moment = " + text(k) + "*lag.rotation + " + text(k_3) + "*lag.rotation^3"});
  const auto linear    = with({"Spring = " + text(slope), "Rest = " + text(lag - spring / slope)});
  ASSERT_EQ(hardening.size(), linear.size());
  ASSERT_GE(linear.size(), 6u);
  for (unsigned int i = 0; i < linear.size(); ++i)
    EXPECT_LT(std::abs(hardening[i] - linear[i]), 1e-8) << i;
}
