/*
 * Problem:   controls for which a periodic motion meets its targets
 * Reference: a shaken mass in closed form; a flapping rotor in forward flight,
 * tests/reference/rotor/trim_flapping_rotor.csv, and the textbook's closed form
 */

#include <samara/analysis/dynamic.h>
#include <samara/analysis/trim.h>
#include <samara/base/errors.h>
#include <samara/study/trim_variants.h>

#include "../reference.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  const std::string mass = "prm/examples/trim/shaken_mass.prm", rotor = "prm/rotorcraft/flapping_rotor.prm";
  const std::string with_way = "tests/trim/along_a_way.prm"; ///< the same with constants of continuations

  const TrimAnalysis &
  trimmed(Scene &scene)
  {
    auto &trim = scene.analysis<TrimAnalysis>();
    trim.run(scene.context);
    return trim;
  }

  /** What a search that fails says. */
  std::string
  failure_of(Scene &scene)
  {
    try
      {
        trimmed(scene);
      }
    catch (const NotConverged &problem)
      {
        return problem.what();
      }
    return "";
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace



// For a linear system the controls are known, whichever way they are found.
TEST(Trim, ShakenMassInClosedForm)
{
  const double m = 2, c = 20, k = 200, omega = 8, a = 0.005, b = 0;
  const double expected[] = {k * 0.01,
                             (k - m * omega * omega) * a + c * omega * b,
                             (k - m * omega * omega) * b - c * omega * a};
  for (const std::string method : {"Newton-Krylov", "discrete", "auto-pilot"})
    {
      Scene       scene(mass, {"Trim/Method = " + method, "Trim/Tolerance = 1e-9"});
      const auto &trim = trimmed(scene);
      for (unsigned int j = 0; j < 3; ++j)
        EXPECT_NEAR(trim.report.controls[j], expected[j], 1e-6) << method;
      EXPECT_LT(trim.report.periodicity, 1e-9) << method;
      EXPECT_LT(trim.report.turns, method == "Newton-Krylov" ? 25 : 90) << method;
    }
}



// The tangent of a step knows nonlinear springs.
TEST(Trim, NonlinearSpring)
{
  Scene scene(
    mass,
    {"Joints/slide/displacement/Spring = 0",
     "Joints/slide/displacement/Spring force = 200 N/m * slide.displacement + 1e5 N/m^3 * slide.displacement^3"});
  const auto &trim = trimmed(scene);
  EXPECT_GT(trim.report.products, 0u);
  // harmonic balance of x³, x = m + a cos ωt: mean m³ + 3/2 m a², cosine 3 m² a + 3/4 a³; the third harmonic is in the
  // orbit
  const double m = 0.01, a = 0.005;
  EXPECT_NEAR(trim.report.controls[0], 200 * m + 1e5 * (m * m * m + 1.5 * m * a * a), 2e-3);
}



// Steps with dry friction have no exact tangent: then products are differences of turns.
TEST(Trim, WithoutTangent)
{
  Scene       scene(mass,
              {"Joints/slide/displacement/Friction = 0.1",
                     "Joints/slide/displacement/Friction preload = 1 N",
                     "Joints/slide/displacement/Sticking speed = 10 mm/s"});
  const auto &trim = trimmed(scene);
  EXPECT_NE(scene.stream.str().find("products by differences of turns"), std::string::npos) << scene.stream.str();
  EXPECT_EQ(trim.report.products, 0u);
  // friction has no mean
  EXPECT_NEAR(trim.report.controls[0], 200 * 0.01, 1e-6);
}



// The first turns bounce on a stop, which has no tangent; those behind them do not, and have one.
TEST(Trim, TangentsComeBack)
{
  Scene       scene(mass,
              {"Joints/slide/displacement/Upper stop = 25 mm",
                     "Joints/slide/displacement/Stop stiffness = 2 kN/m",
                     "Trim/Settle = 1",
                     "States/bias/Value = 8 N"});
  const auto &trim = trimmed(scene);
  const auto  said = scene.stream.str();
  EXPECT_NE(said.find("products by differences of turns"), std::string::npos) << said;
  EXPECT_NE(said.find("products by tangents again"), std::string::npos) << said;
  EXPECT_GT(trim.report.products, 0u);
  EXPECT_NEAR(trim.report.controls[0], 200 * 0.01, 1e-5);
}



// The error of the controls is that of the integrator: 2s - 1 where it dissipates.
TEST(Trim, OrderOfControls)
{
  const auto error = [](const unsigned int s, const unsigned int n) {
    Scene       scene(mass,
                {"Trim/Stages = " + std::to_string(s), "Trim/Steps = " + std::to_string(n), "Trim/Tolerance = 1e-10"});
    const auto &trim = trimmed(scene);
    return std::hypot(trim.report.controls[1] - 72 * 0.005, trim.report.controls[2] + 160 * 0.005);
  };
  EXPECT_NEAR(std::log2(error(1, 20) / error(1, 40)), 1, 0.2);
  EXPECT_NEAR(std::log2(error(2, 10) / error(2, 20)), 3, 0.4);
}



// The motion after it is the one that was found: no start of its own.
TEST(Trim, MotionGoesOn)
{
  Scene scene(mass);
  trimmed(scene);
  const State start  = scene.context.state;
  auto       &motion = scene.analysis<DynamicAnalysis>();
  double      sum = 0, cosine = 0;
  unsigned    n   = 0;
  const Probe x   = scene.input.model.probe("slide.displacement");
  motion.observer = [&](const State &state) {
    if (n++ == 0)
      return; // the first is the last
    sum += x.value(state) / 24;
    cosine += 2 * x.value(state) * std::cos(8 * state.time) / 24;
  };
  motion.run(scene.context);
  EXPECT_EQ(n, 25u);
  EXPECT_NEAR(sum, 0.01, 1e-9);
  EXPECT_NEAR(cosine, 0.005, 1e-9);
  EXPECT_NEAR(x.value(scene.context.state), x.value(start), 1e-9);

  Scene late(mass, {"Dynamic/Start time = 0.1"});
  trimmed(late);
  try
    {
      late.analysis<DynamicAnalysis>().run(late.context);
      FAIL() << "The motion begins at another time.";
    }
  catch (const InputError &error)
    {
      EXPECT_TRUE(contains(error.what(), "has come to t = 0 s")) << error.what();
    }
}



// A start at another time is another phase of the same orbit.
TEST(Trim, StartTime)
{
  Scene       scene(mass, {"Trim/Start time = 0.31"});
  const auto &trim = trimmed(scene);
  EXPECT_NEAR(trim.report.controls[1], 72 * 0.005, 1e-6);
  EXPECT_NEAR(trim.report.controls[2], -160 * 0.005, 1e-6);
  EXPECT_DOUBLE_EQ(scene.context.state.time, 0.31);
}



TEST(Trim, LimitsOfControls)
{
  for (const std::string method : {"Newton-Krylov", "discrete", "auto-pilot"})
    {
      Scene             scene(mass,
                  {"Trim/Method = " + method,
                               "Trim/Most turns = 60",
                               "Trim/Controls = bias, cosine from 0 N to 0.2 N, sine"});
      const std::string text = failure_of(scene);
      EXPECT_TRUE(contains(text, "<cosine> is at its upper limit, 0.2 N")) << method << ": " << text;
      EXPECT_TRUE(contains(text, "slide.displacement> is")) << method << ": " << text;
      // the best is kept
      EXPECT_LE(scene.analysis<TrimAnalysis>().report.controls[1], 0.2 + 1e-12);
      EXPECT_GT(scene.analysis<TrimAnalysis>().report.controls[0], 0);
    }
}



TEST(Trim, SingularControls)
{
  const std::string force = "Joints/slide/displacement/Force = ";
  struct Case
  {
    std::string force, says;
  };
  for (const Case &c :
       {Case{"bias + cosine*cos(omega*t)", "the control <sine> has no effect on any target"},
        Case{"bias + cosine*cos(omega*t) + 2*sine*cos(omega*t)", "the matrix of the controls is singular"},
        Case{"bias*cos(omega*t) + cosine*cos(omega*t) + sine*sin(omega*t)",
             "targets <slide.displacement> cannot be met"}})
    for (const std::string method : {"Newton-Krylov", "discrete", "auto-pilot"})
      {
        Scene             scene(mass, {force + c.force, "Trim/Method = " + method});
        const std::string text = failure_of(scene);
        EXPECT_TRUE(contains(text, c.says)) << method << ": " << text;
      }
}



// What acts has half the period that is given, or twice, or none.
TEST(Trim, WrongPeriod)
{
  for (const std::string method : {"Newton-Krylov", "discrete"})
    {
      Scene scene(
        mass,
        {"Trim/Method = " + method,
         "Joints/slide/displacement/Force = bias + cosine*cos(omega*t) + sine*sin(omega*t) + 0.5*cos(omega*t/2)"});
      const std::string text = failure_of(scene);
      EXPECT_TRUE(contains(text, "does not have this <Period>")) << method << ": " << text;
    }
}



TEST(Trim, Refusals)
{
  struct Case
  {
    std::string entry, says;
  };
  for (
    const Case &c :
    {Case{"Trim/Controls = bias, cosine, sin", "there is no state <sin>; did you mean <sine>?"},
     Case{"Trim/Controls = bias, cosine", "there are 2 <Controls> and 3 <Targets>"},
     Case{"Trim/Controls = bias, cosine, bias", "<bias> is there twice"},
     Case{"Trim/Controls = bias from 1 N to 2 N, cosine, sine", "<bias> is 0 N at the start, outside of its limits"},
     Case{"Trim/Controls = bias from -1 m, cosine, sine", "<bias>"},
     Case{
       "Trim/Targets = slide.displacement = 1 N, cos 1 of slide.displacement = 0 m, sin 1 of slide.displacement = 0 m",
       "<slide.displacement>"},
     Case{
       "Trim/Targets = slide.displacment = 1 m, cos 1 of slide.displacement = 0 m, sin 1 of slide.displacement = 0 m",
       "slide.displacment"},
     Case{
       "Trim/Targets = slide.displacement = 1 m, cos 12 of slide.displacement = 0 m, sin 1 of slide.displacement = 0 m",
       "harmonic 12"},
     Case{"Trim/Scales = 1 m, 1 N, 1 m", "<slide.displacement>"},
     Case{"Trim/Scales = 1 m, 1 m", "and 2 <Scales>"},
     Case{"Trim/Scales = 1 m, 0 m, 1 m", "must not be zero"},
     Case{"Trim/Period = 0", "the <Period> must be positive"},
     Case{"Trim/Spectral radius = 1", "at most 0.95"}})
    {
      SCOPED_TRACE(c.entry);
      try
        {
          Scene scene(mass, {c.entry});
          trimmed(scene);
          ADD_FAILURE() << "It was not refused.";
        }
      catch (const InputError &error)
        {
          EXPECT_TRUE(contains(error.what(), c.says)) << error.what();
        }
    }
  Scene moving(mass, {"States/sine/Type = first order", "States/sine/Rate = 1 N/s", "States/sine/Scale = 1"});
  EXPECT_THROW(trimmed(moving), InputError);
}



// Statics leave a control as it is given; in motion it keeps still.
TEST(Trim, ControlInStatics)
{
  Scene scene(mass, {"States/bias/Value = 3 N", "States/cosine/Value = 0 N"});
  scene.context.state.states[0] = 7;
  scene.equilibrium();
  EXPECT_NEAR(scene.value("bias"), 3, 1e-12);
  EXPECT_NEAR(scene.value("slide.displacement"), 3. / 200, 1e-9);
  const auto &trim = trimmed(scene);
  EXPECT_NEAR(trim.report.controls[0], 2, 1e-6);
}



// Rigid blades on flap hinges, strips of linear lift: prescribed pitch by controls, inflow, means of what turns. All
// rows of the reference, hover as next to no wind; one of them by another method, which takes many turns.
TEST(Trim, FlappingRotor)
{
  unsigned int n_rows = 0;
  for (const auto &row : reference_rows("rotor/trim_flapping_rotor.csv"))
    {
      const std::string inflow = row.at("inflow");
      const double      mu     = std::stod(row.at("mu"));
      const bool        others = inflow == "glauert" && mu == 0.1;
      SCOPED_TRACE(inflow + ", mu = " + row.at("mu"));
      Scene       scene(rotor,
                  {std::string("Aerodynamics/flow/Type = ") +
                           (inflow == "glauert" ? "uniform inflow" : "Pitt-Peters inflow"),
                         "Constants/mu = " + (mu > 0 ? row.at("mu") : "1e-7"),
                         "Constants/tilt = " + row.at("alpha_deg") + " deg",
                         std::string("Trim/Method = ") + (others ? "discrete" : "Newton-Krylov"),
                         std::string("Trim/Steps = ") + (mu == 0.3 ? "48" : "30")});
      const auto &trim = trimmed(scene);
      EXPECT_LE(trim.report.turns, others ? 200 : 30);
      EXPECT_EQ(trim.report.products > 0, !others);
      for (const auto &[j, name] : {std::pair{0, "th0_deg"}, {1, "th1c_deg"}, {2, "th1s_deg"}})
        EXPECT_NEAR(trim.report.controls[j] * 180 / M_PI, std::stod(row.at(name)), 1e-5) << name;
      ++n_rows;
    }
  EXPECT_EQ(n_rows, 7u);
}



// The chord has a direction: lift is normal to the flow at the quarter chord, half a chord ahead of the axis. With a
// thousandth of the chord, and a thousand times the slope and the drag, it has none, and the controls are those of
// strips on a line.
TEST(Trim, FlappingRotorWithStripsOnALine)
{
  unsigned int count = 0;
  for (const auto &row : reference_rows("rotor/trim_strips_on_a_line.csv"))
    {
      const double mu = std::stod(row.at("mu"));
      SCOPED_TRACE(mu);
      if (mu == 0)
        continue;
      Scene       scene(rotor,
                  {"Aerodynamics/flow/Type = uniform inflow",
                         "Constants/mu = " + std::to_string(mu),
                         "Constants/tilt = " + row.at("alpha_deg") + " deg",
                         "Constants/chord = 1e-3*0.08*pi/4*R",
                         "Constants/I_blade = rho*5.7e3*chord*R^4/8",
                         "Airfoils/straight/Lift slope = 5.7e3",
                         "Airfoils/straight/Drag = 10",
                         "Trim/Steps = 30"});
      const auto &trim = trimmed(scene);
      for (const auto &[j, name] : {std::pair{0, "th0_deg"}, {1, "th1c_deg"}, {2, "th1s_deg"}})
        {
          EXPECT_NEAR(trim.report.controls[j] * 180 / M_PI, std::stod(row.at(name)), 5e-5) << name;
        }
      ++count;
    }
  EXPECT_EQ(count, 3u);
}



namespace
{
  /** A force that cannot be more than 4 N, from a start at which the control has hardly any effect. */
  std::vector<std::string>
  saturated(const std::string &target)
  {
    return {"Constants/way = 1",
            "States/bias/Value = 6*way N",
            "Joints/slide/displacement/Force = 4 N*tanh(bias/(1 N))",
            "Trim/Controls = bias from -20 N to 20 N",
            "Trim/Targets = slide.displacement = " + target,
            "Trim/Scales = 10 mm",
            "Trim/Tolerance = 1e-9",
            "Trim/Continue = way from 0.05"};
  }
} // namespace



// From afar Newton's method does not come back; along the way it does.
TEST(Trim, Continuation)
{
  const auto alone = saturated("15*way mm");
  Scene      scene(with_way, alone);
  EXPECT_NE(failure_of(scene), "");

  let_trim_continue(scene.input, SAMARA_SOURCE_DIR "/" + with_way, alone);
  scene.context.state = scene.system.reference();
  const auto &trim    = trimmed(scene);
  EXPECT_NEAR(trim.report.controls[0], std::atanh(200 * 0.015 / 4), 1e-6);
  EXPECT_TRUE(contains(scene.stream.str(), "by continuation")) << scene.stream.str();
}



// The force is enough up to 20 mm of 40: there the way ends, and what stops it is said.
TEST(Trim, ContinuationStops)
{
  const auto overrides = saturated("40*way mm");
  Scene      scene(with_way, overrides);
  let_trim_continue(scene.input, SAMARA_SOURCE_DIR "/" + with_way, overrides);
  const std::string text  = failure_of(scene);
  const auto        stops = text.find("stops at way = ");
  ASSERT_NE(stops, std::string::npos) << text;
  const double at = std::stod(text.substr(stops + 15));
  EXPECT_LT(at, 0.5) << text;
  EXPECT_GT(at, 0.45) << text;
  EXPECT_TRUE(contains(text, "the targets 1.00 <slide.displacement>, which the controls 1.00 <bias> move by")) << text;
  EXPECT_FALSE(contains(text, "limit point")) << text; // an asymptote
}



// The force has its largest value, 4 N, at bias = 1 N, and less beyond: the path turns round at half of the way.
TEST(Trim, ContinuationNamesALimitPoint)
{
  auto overrides = saturated("40*way mm");
  overrides[1]   = "States/bias/Value = 0.1 N";
  overrides[2]   = "Joints/slide/displacement/Force = 8 N*(bias/(1 N))/(1 + (bias/(1 N))^2)";
  Scene scene(with_way, overrides);
  let_trim_continue(scene.input, SAMARA_SOURCE_DIR "/" + with_way, overrides);
  const std::string text = failure_of(scene), before = "limit point, which would be at about way = ";
  const auto        point = text.find(before);
  ASSERT_NE(point, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(point + before.size())), 0.5, 0.02) << text;
}



TEST(Trim, RefusalsOfContinuation)
{
  const auto complaint = [](const std::string &entry) {
    try
      {
        Scene scene(with_way, {entry});
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  EXPECT_TRUE(contains(complaint("Trim/Continue = omega"), "a continuation is written"));
  EXPECT_TRUE(contains(complaint("Trim/Continue = none from 1"), "<none> is zero"));
  EXPECT_TRUE(contains(complaint("Trim/Continue = omega from 8 rad/s"), "has this value already"));
  EXPECT_TRUE(contains(complaint("Trim/Continue = omga from 1 rad/s"), "omga"));
  EXPECT_TRUE(contains(complaint("Trim/Continue = omega from 1 m"), "m"))
    << complaint("Trim/Continue = omega from 1 m");
}
