// Gusts: derivatives, frozen fields, corners in time and in space, closed forms of the lags, the distance to Sears.

#include <samara/analysis/dynamic.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  const double gust_speed = 30, gust_semichord = 0.25;

  /** A rigid wing that does not move in a wind of 30 m/s; three quarters of its chord are at x = 0.25 m. */
  std::string
  held_wing(const std::string &gust, const std::string &end_time, const std::string &step)
  {
    const std::string plate = "  subsection plate\n    set Type = analytic\n  end\n";
    std::string       text =
      "set Analyses = dynamic\n" +
      rigid_wing(air("30, 0, 0", "    set Speed of sound = 1\n    set Gust = " + gust + "\n"),
                 "    set Chord = 0.5\n    set Airfoils = plate\n") +
      "subsection Joints\n  subsection hold\n    set Type = revolute\n    set Body A = ground\n    set Body B = wing\n"
      "    set Axis = 0, 1, 0\n    subsection rotation\n      set Prescribed = 0\n    end\n  end\nend\n"
      "subsection Dynamic\n  set Stages = 3\n  set End time = " +
      end_time + "\n  set Step = " + step + "\n  set Pictures = 0\nend\n";
    return text.replace(text.find("subsection Airfoils\n"), 20, "subsection Airfoils\n" + plate);
  }

  /** Lift at the end, over that of a steady upwash of 1 m/s, and the time. */
  std::pair<double, double>
  lift_at_end(const std::string &text)
  {
    Scene scene(text);
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.run(scene.context);
    const double unit = M_PI * 1.225 * gust_speed * 0.5 * 4;
    return {scene.value("it.force z") / unit, scene.context.state.time};
  }

  /** What lags make of an upwash w e^{st} from t = 0 on. */
  std::complex<double>
  after_lags(const std::complex<double> &s, const double t)
  {
    std::complex<double> sum = 0.5 * std::exp(s * t);
    for (const auto &[A, b] : {std::pair<double, double>{0.165, 0.0455}, {0.335, 0.3}})
      {
        const double a = b * gust_speed / gust_semichord;
        sum += A * a / (a + s) * (std::exp(s * t) - std::exp(-a * t));
      }
    return sum;
  }
} // namespace



TEST(Gust, DerivativesAgainstComplexSteps)
{
  const std::string gust  = "    set Gust = 4*sin(x - 3*t), 2 m/s*(y + z)/(1 m), 3 m/s*cos(x*y/(2 m^2))*exp(-t)\n",
                    shear = "    set Shear exponent = 0.2\n    set Ground = -7\n";
  for (const std::string &text : {gust, gust + shear})
    {
      const Scene       scene(blade(air("20, 5, -3", text),
                              "    set Chord = 0.4 - 0.05*s\n    set Airfoils = full\n    set Virtual mass = true\n"));
      const ComplexStep step(scene.system, false, false, true);
      EXPECT_LT(step.error_of_tangent(), 1e-12);
      EXPECT_LT(step.error_of_damping(), 1e-12);
    }
}



// Air at rest that is not the same everywhere: a wing that flies through it, and one on which it is blown.
TEST(Gust, FrozenFieldPassesAsItIsFlownThrough)
{
  const std::string wing = "    set Chord = 0.5\n    set Airfoils = full\n    set Unsteady = quasi-steady\n",
                    head = "    set Gust = 2*sin(", rest = "/(3 m)), 0, 4*cos(";
  Scene flying(
    rigid_wing(air("0, 0, 0", head + "x" + rest + "x/(2 m) + y/(1 m))\n"), wing, "    set Velocity = -30, 0, 0\n")),
    blown(rigid_wing(air("30, 0, 0", head + "(x - 30 m/s*t)" + rest + "(x - 30 m/s*t)/(2 m) + y/(1 m))\n"), wing));
  State &state = flying.context.state;
  flying.system.add_initial_velocities(state);
  double largest = 0;
  for (const double t : {0., 0.03, 0.1})
    {
      state.q[12]              = -30 * t;
      blown.context.state.time = t;
      const double expected    = blown.value("it.force z");
      largest                  = std::max(largest, std::abs(expected));
      EXPECT_NEAR(flying.value("it.force z"), expected, 1e-10 * largest);
      EXPECT_NEAR(flying.value("it.force x"), blown.value("it.force x"), 1e-10 * largest);
    }
  EXPECT_GT(largest, 50.);
}



// A sinusoidal gust, from the start on: what the lags make of the upwash at three quarters of the chord. In the long
// run that is the circulation's part of W. R. Sears, J. Aeronaut. Sci. 8 (1941), S(k) = (J₀ − iJ₁) C + iJ₁ about half
// chord with Theodorsen's C; iJ₁, about k/2, is left out with the acceleration of the air.
TEST(Gust, SinusoidalGustThroughLags)
{
  using Complex = std::complex<double>;
  const Complex i(0, 1);
  for (const double k : {0.05, 0.3})
    {
      const double      wave = k / gust_semichord, omega = wave * gust_speed;
      const std::string gust = "0, 0, 1e-3*sin(" + number_to_text(wave) + "*(x - 30 m/s*t)/(1 m))";
      const auto [lift, t]   = lift_at_end(held_wing(gust, "0.15", "0.005"));
      const Complex all      = std::polar(1., wave * 0.25) * after_lags(-i * omega, t);
      EXPECT_NEAR(lift, 1e-3 * all.imag(), 1e-9) << k;

      const double  J0 = std::cyl_bessel_j(0, k), J1 = std::cyl_bessel_j(1, k);
      const Complex H0(J0, -std::cyl_neumann(0, k)), H1(J1, -std::cyl_neumann(1, k)), C = H1 / (H1 + i * H0);
      // e^{−iωt} goes the other way round than Sears's e^{iωt}
      const Complex circulation = std::polar(1., wave * 0.125) * std::conj((J0 - i * J1) * C),
                    forced      = std::exp(-i * omega * t);
      // of the start, what decays
      const Complex steady = std::polar(1., wave * 0.25) * (after_lags(-i * omega, 1e3) / std::exp(-i * omega * 1e3));
      const Complex decays = all - steady * forced;
      EXPECT_NEAR(lift / 1e-3 - decays.imag(), (circulation * forced).imag(), 0.021) << k;
    }
}



// An edge in time, and one that is blown over the wing: steps end there, and what follows is Wagner's function of lags.
TEST(Gust, StepsEndAtEdges)
{
  for (const std::string gust :
       {"t < 0.0416666666667 ? 0 : 1e-3", "(t < 0.0416666666667 ? 0 : 1e-3)*cos(0*x)", "x < 30 m/s*t - 1 m ? 1e-3 : 0"})
    {
      const auto [lift, t] = lift_at_end(held_wing("0, 0, " + gust, "0.1", "0.01"));
      EXPECT_NEAR(lift, 1e-3 * after_lags(0., t - 1.25 / 30).real(), 1e-8) << gust;
    }
}



TEST(Gust, Refuses)
{
  const auto of = [](const std::string &gust) {
    return complaint_of(
      rigid_wing(air("1, 0, 0", "    set Gust = " + gust + "\n"), "    set Chord = 0.5\n    set Airfoils = plain\n"));
  };
  EXPECT_EQ(of("0, 0, 3 m/s*x/(1 m)"), "");
  EXPECT_EQ(of("0, 0, 3*x/(1 s)"), "");
  EXPECT_EQ(of("table: 0 0; 1 2, 0, 0"), "");
  EXPECT_NE(of("0, 0, 3 N*x").find("Gust"), std::string::npos);
  EXPECT_NE(of("0, 0, 3*r").find("r"), std::string::npos);
  EXPECT_NE(of("0, 3").find("Gust"), std::string::npos);
}
