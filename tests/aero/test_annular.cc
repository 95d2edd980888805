// Annular momentum: closed forms, a solution of blade elements of its own, derivatives, hover.

#include <samara/aero/annular_momentum.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** No losses; in a still hub. */
  AnnularMomentum
  disk()
  {
    AnnularMomentum theory;
    theory.density      = 1.2;
    theory.radius       = 10;
    theory.blades       = 3;
    theory.has_tip_loss = theory.has_skew = false;
    theory.least_speed                    = 1e-6;
    return theory;
  }

  /** Pressure [Pa] that holds the inflow w in the free air @p u, at 6 m from the axis. */
  double
  pressure(const AnnularMomentum &theory, const Vector3 &u, const double w, const Vector3 &relative = {0, -50, 10})
  {
    const AnnularMomentum::Place<double> at{{6, 0, 0}, u, w, 0};
    // ẇ = (Q f₃/(2πr ρ) − 2 F w V)/(k R)
    const double rate = theory.rates<double>(at, relative, Vector3::Zero(), 1.)[0];
    return -rate * theory.apparent_mass * theory.radius * theory.density;
  }

  /** Blades of a rotor at 30 rad/s about z, as many as wanted, from 0.6 to 3 m. */
  std::string
  rotor(const unsigned int n, const std::string &wind, const std::string &flow, const std::string &entries)
  {
    const std::string airfoils = R"(
subsection Airfoils
  subsection ideal
    set Type       = analytic
    set Form       = linear
    set Lift slope = 6
    set Drag       = 0
  end
  subsection real
    set Type       = analytic
    set Form       = linear
    set Lift slope = 6
    set Drag       = 0.01, 0, 0.4
  end
end
)";
    return turning_rotor(
      n,
      entries,
      airfoils,
      air(wind) +
        subsection("flow", "    set Type = annular inflow\n    set Hub = ground\n    set Radius = 3\n" + flow));
  }
} // namespace



TEST(AnnularMomentum, ClosedForms)
{
  const auto   theory = disk();
  const double U = 8, q = 0.5 * 1.2 * U * U;
  // the least speed is 1e-6 of the air at the blade: 1e-12 of its square, times what slopes make of it
  for (const double a : {-0.2, 0.1, 1. / 3, 0.4})
    {
      EXPECT_NEAR(pressure(theory, {0, 0, U}, a * U), 4 * a * (1 - a) * q, 1e-10 * q) << a;
      // a propeller climbs; and the mirror image of a turbine
      EXPECT_NEAR(pressure(theory, {0, 0, -U}, a * U), 4 * a * std::abs(1 + a) * q, 1e-10 * q) << a;
      EXPECT_NEAR(pressure(theory, {0, 0, -U}, -a * U), -4 * a * (1 - a) * q, 1e-10 * q) << a;
      // yaw: H. Glauert
      EXPECT_NEAR(pressure(theory, {3, 4, U}, a * U),
                  2 * 1.2 * a * U * std::sqrt(25 + std::pow(1 - a, 2) * U * U),
                  1e-10 * q);
    }
  // M. L. Buhl
  for (const double a : {0.5, 0.8, 1., 1.5})
    EXPECT_NEAR(pressure(theory, {0, 0, U}, a * U), (8. / 9 - 4. / 9 * a + 14. / 9 * a * a) * q, 3e-10 * q) << a;
  // hover, and slow descent
  EXPECT_NEAR(pressure(theory, {0, 0, 0}, 5), 2 * 1.2 * 25, 1e-10 * 60);
  EXPECT_NEAR(pressure(theory, {0, 0, 1}, 5), 2 * 1.2 * 5 * 4, 1e-10 * 60);
  EXPECT_EQ(pressure(theory, {0, 0, U}, 0.), 0.);

  // pieces meet, at w = 0.4 s with one slope
  for (const double F : {1., 0.7, 0.2})
    {
      const auto   p = [&](const double w) { return w * AnnularMomentum::axial_flow(U, w, F); };
      const double e = 1e-6, w = 0.4 * U;
      EXPECT_NEAR(p(w + e) - p(w), p(w) - p(w - e), 1e-10);
      double last = 0;
      for (double x = 0.01; x < 4 * U; x += 0.01)
        {
          EXPECT_LT(std::abs(p(x) - last), 0.01 * (8 * x + 2 * U) / F) << x;
          last = p(x);
        }
    }
  // nothing jumps from descent to climb
  for (const double w : {4., -4.})
    for (double s = -20; s < 20; s += 0.01)
      EXPECT_LT(std::abs(pressure(theory, {1, 0, s + 0.01}, w) - pressure(theory, {1, 0, s}, w)), 1.) << s;
}



TEST(AnnularMomentum, FactorOfTipAndRoot)
{
  auto theory         = disk();
  theory.has_tip_loss = true;
  theory.root         = 1.5;
  const auto F        = [](const double f) { return 2 / M_PI * std::acos(std::exp(-f)); };
  for (const double r : {2., 6., 9., 9.9})
    EXPECT_NEAR(theory.loss(r, 0.2), F(1.5 * (10 - r) / (r * 0.2)) * F(1.5 * (r - 1.5) / (1.5 * 0.2)), 1e-14);
  EXPECT_GT(theory.loss(10., 0.2), 0.); // at and beyond the edge
  EXPECT_GT(theory.loss(11., 0.2), 0.);
  EXPECT_GT(theory.loss(1., 0.2), 0.);
  // the angle is that of the relative air
  const AnnularMomentum::Place<double> at{{0, 6, 0}, {0, 0, 8}, 2, 0};
  EXPECT_NEAR(AnnularMomentum::sine_of<double>(at, {-40, 7, 30}), 0.6, 1e-15);
  EXPECT_NEAR(AnnularMomentum::sine_of<double>(at, {40, 7, -30}), 0.6, 1e-15);
}



// Yawed flow: more where the wake goes, by Pitt and Peters; the mean is w. Swirl goes round.
TEST(AnnularMomentum, SkewedWake)
{
  auto theory                                = disk();
  theory.has_skew                            = true;
  const double                         chi_2 = 0.5 * std::atan2(6., 8. - 3.);
  const AnnularMomentum::Place<double> downwind{{5, 0, 0}, {6, 0, 8}, 3, 0.5}, upwind{{-5, 0, 0}, {6, 0, 8}, 3, 0},
    aside{{0, 5, 0}, {6, 0, 8}, 3, 0};
  EXPECT_NEAR(-theory.induced(downwind)(2), 3 * (1 + 15 * M_PI / 32 * std::tan(chi_2) / 2), 1e-9);
  EXPECT_NEAR(theory.induced(downwind)(2) + theory.induced(upwind)(2), -6, 1e-12);
  EXPECT_NEAR(theory.induced(aside)(2), -3, 1e-12);
  EXPECT_NEAR(theory.induced(downwind)(1), -0.5, 1e-15);
  EXPECT_NEAR(theory.induced(downwind)(0), 0, 1e-15);
}



// An optimum rotor without swirl: a = 1/3 at all radii, thrust 8/9 and power 16/27 of the annuli that blades pass.
TEST(AnnularInflow, OptimumRotor)
{
  // wind 10 m/s, c_l = 0.6 at 0.1 rad: tan φ = 2/(3 λ_r), λ_r = 3 s', chord 8πr sin φ/(3 Q c_l λ_r)
  const std::string r = "(0.6 + s)", l = "(3*(0.6 + s))", phi = "atan(2/(3*" + l + "))";
  Scene             scene(rotor(3,
                    "0, 0, 10",
                    "    set Tip loss = none\n    set Swirl = false\n",
                    "    set Chord = 8*pi*" + r + "*sin(" + phi + ")/(9*0.6*" + l + ")\n    set Twist = 0.1 - " + phi +
                      "\n    set Airfoils = ideal\n    set Breaks = 0.3, 0.8, 1.5\n    set Stations = 12\n"));
  scene.equilibrium();
  const double area = M_PI * (9 - 0.36), T = 0.5 * 1.225 * 100 * area * 8 / 9, P = 0.5 * 1.225 * 1000 * area * 16 / 27;
  EXPECT_NEAR(scene.value("blade 1.at 0.5.inflow"), 10. / 3, 1e-6);
  EXPECT_NEAR(scene.value("blade 3.at 2.3.inflow"), 10. / 3, 1e-6);
  EXPECT_NEAR(scene.value("blade 2.at 2.3.angle of attack"), 0.1 * 180 / M_PI, 1e-6);
  EXPECT_NEAR(scene.value("flow.thrust"), T, 1e-6 * T);
  EXPECT_NEAR(scene.value("flow.power"), -P, 1e-6 * P);
  EXPECT_NEAR(scene.value("flow.mean"), 10. / 3, 1e-6);
}



// The ideal rotor in hover: a chord ~ 1/r whose angle of attack is constant makes a uniform inflow, C_P = C_T^{3/2}/√2.
TEST(AnnularInflow, IdealRotorInHover)
{
  // w = 5: φ = atan(5/(30 r)); forces on the thrust axis 2πr 2ρw²/Q = ½ρ c U² c_l cos φ, c_l = 0.48 at 0.08 rad
  const std::string r = "(0.6 + s)", phi = "atan(5/(30*" + r + "))", U2 = "(25 + 900*" + r + "^2)",
                    chord = "8*pi*" + r + "*25/(4*0.48*" + U2 + "*cos(" + phi + "))";
  Scene scene(rotor(4,
                    "0, 0, 0",
                    "    set Tip loss = none\n    set Swirl = false\n",
                    "    set Chord = " + chord + "\n    set Twist = 0.08 + " + phi +
                      "\n    set Airfoils = ideal\n    set Breaks = 0.3, 0.8, 1.5\n    set Stations = 12\n"));
  scene.equilibrium();
  const double area = M_PI * (9 - 0.36), T = 2 * 1.225 * area * 25;
  EXPECT_NEAR(scene.value("flow.mean"), 5, 1e-5);
  EXPECT_NEAR(scene.value("flow.thrust"), T, 1e-5 * T);
  EXPECT_NEAR(scene.value("flow.power"), T * 5, 1e-5 * T * 5);
}



namespace
{
  /** Blade elements in the textbooks' form: a and a' of a rotor in wind, by iteration. */
  struct Induction
  {
    double a = 0.3, prime = 0;

    Induction(const double       U,
              const double       r,
              const double       R,
              const double       root,
              const double       Omega,
              const double       twist,
              const double       chord,
              const unsigned int Q)
    {
      const double sigma = Q * chord / (2 * M_PI * r);
      for (unsigned int i = 0; i < 4000; ++i)
        {
          const double axial = (1 - a) * U, around = (1 + prime) * Omega * r, phi = std::atan2(axial, around),
                       alpha = phi + twist, cl = 6 * alpha, cd = 0.01 + 0.4 * alpha * alpha,
                       W2 = axial * axial + around * around, cn = cl * std::cos(phi) + cd * std::sin(phi),
                       ct = cl * std::sin(phi) - cd * std::cos(phi), CT = sigma * cn * W2 / (U * U);
          const auto   factor = [](const double f) { return 2 / M_PI * std::acos(std::exp(-f)); };
          const double s      = std::abs(std::sin(phi)),
                       F      = factor(0.5 * Q * (R - r) / (r * s)) * factor(0.5 * Q * (r - root) / (root * s));
          // C_T = 4aF(1 − a), or Buhl's, solved for a
          double to = CT < 0.96 * F ?
                        0.5 * (1 - std::sqrt(1 - CT / F)) :
                        (18 * F - 20 - 3 * std::sqrt(CT * (50 - 36 * F) + 12 * F * (3 * F - 4))) / (36 * F - 50);
          a += 0.02 * (to - a);
          prime += 0.02 * (sigma * ct * W2 / (CT * U * Omega * r) * a - prime);
        }
    }
  };
} // namespace



// Tip, root, swirl, drag, light and high thrust: station by station against a solution in the textbooks' form.
TEST(AnnularInflow, BladeElementsOfItsOwn)
{
  for (const double chord : {0.1, 0.25, 0.6})
    {
      Scene scene(rotor(3,
                        "0, 0, 10",
                        "    set Root = 0.5\n",
                        "    set Chord = " + number_to_text(chord) +
                          "\n    set Twist = -0.25 + 0.09*s\n    set Airfoils = real\n    set Stations = 6\n"));
      scene.equilibrium();
      // Gauss's points of one panel of 2.4 m
      for (const double x : {0.033765242898423975, 0.38069040695840155, 0.830604693233132, 0.966234757101576})
        {
          const double    s = 2.4 * x;
          const Induction own(10, 0.6 + s, 3, 0.5, 30, -0.25 + 0.09 * s, chord, 3);
          EXPECT_NEAR(scene.value("blade 2.at " + number_to_text(s) + ".inflow"), 10 * own.a, 1e-7)
            << chord << " " << x;
        }
    }
}



TEST(AnnularInflow, DerivativesAgainstComplexSteps)
{
  const std::string entries = "    set Chord = 0.2\n    set Twist = 0.2 - 0.02*s\n    set Airfoils = real\n";
  for (const std::string wind : {"0, 0, 12", "2, 3, 4", "0, 0, 0", "-4, 1, -6"})
    for (const std::string more : {"", "    set Unsteady = two lags\n    set Virtual mass = true\n"})
      {
        std::string text = rotor(2, wind, "    set Root = 0.3\n", entries);
        if (!more.empty())
          for (std::size_t at; (at = text.find("    set Unsteady = quasi-steady\n")) != std::string::npos;)
            text.replace(at, 32, more);
        for (const std::string hub : {"ground", "rotor.centre"})
          {
            std::string with = text;
            with.replace(with.find("set Hub = ground"), 16, "set Hub = " + hub);
            const Scene       scene(with);
            const ComplexStep step(scene.system, false, false, true);
            EXPECT_LT(step.error_of_tangent(), 1e-12) << wind << hub << more;
            EXPECT_LT(step.error_of_damping(), 1e-12) << wind << hub << more;
          }
      }
  // elastic blades
  const Scene       scene(blade(air("3, 2, 5") + subsection("flow",
                                                      "    set Type = annular inflow\n    set Hub = hub.off\n"
                                                            "    set Radius = 6\n    set Axis = 0, 0.1, 1\n"),
                          "    set Chord = 0.2\n    set Airfoils = full\n    set Inflow = flow\n"
                                "    set Unsteady = dynamic stall\n    set Range = 0.5, 2.5\n"));
  const ComplexStep step(scene.system, false, false, true);
  EXPECT_LT(step.error_of_tangent(), 1e-12);
  EXPECT_LT(step.error_of_damping(), 1e-12);
}



// Where a rotor descends into its wake it is told so: against v_h = √(T/2ρA), from 0.3 v_h to √2 v_h, where the thrust
// is that of a disk that lets nothing pass, C_T = 2. Hover, a climb, a turbine in its working range and flight are not.
TEST(AnnularInflow, VortexRingsAreWarnedAbout)
{
  struct Case
  {
    std::string wind;
    bool        is_told;
  };
  // thrust is positive, along z: the wind blows along it where the rotor descends
  for (const Case &c : {Case{"0, 0, 0", false},
                        Case{"0, 0, -5", false},
                        Case{"0, 0, 0.5", false},
                        Case{"0, 0, 5", true},
                        Case{"0, 0, 8", true},
                        Case{"0, 0, 20", false},
                        Case{"30, 0, 5", false}})
    {
      SCOPED_TRACE(c.wind);
      Scene scene(rotor(
        4, c.wind, "    set Swirl = false\n", "    set Chord = 0.3\n    set Twist = 0.15\n    set Airfoils = real\n"));
      scene.equilibrium();
      EXPECT_EQ(scene.stream.str().find("vortex rings") != std::string::npos, c.is_told) << scene.stream.str();
      const double T = scene.value("flow.thrust"), hover = std::sqrt(T / (2 * 1.225 * M_PI * 9));
      EXPECT_GT(T, 0.);
      // the cases are what they are meant to be
      const double descent = std::stod(c.wind.substr(c.wind.rfind(' '))) / hover;
      EXPECT_EQ(descent > 0.3 && descent < std::sqrt(2.) && c.wind[0] == '0', c.is_told) << descent;
    }
}



TEST(AnnularInflow, RefusesWhatItCannotBe)
{
  const std::string entries = "    set Chord = 0.2\n    set Airfoils = real\n";
  EXPECT_NE(complaint_of(rotor(2, "0, 0, 5", "    set Root = 3\n", entries)).find("radius of the root"),
            std::string::npos);
  // a line along the thrust axis
  std::string along = rotor(1, "0, 0, 5", "", entries);
  along.replace(along.find("Line = 0.6, 0, 0; 3, 0, 0"), 25, "Line = 1, 0, 0; 1, 0, 3");
  EXPECT_NE(complaint_of(along).find("across annuli"), std::string::npos) << complaint_of(along);
}
