// Kinds of states that are controllers: PID, transfer functions, state spaces, delays.

#include <samara/base/dense.h>

#include "../complex_step.h"
#include <gtest/gtest.h>

#include "scenes.h"
#include "started.h"

using namespace samara;

namespace
{
  /** A mass that nothing moves, so that there is a body, with states. */
  std::string
  states_alone(const std::string &states)
  {
    return on_a_slide(states, "set Spring = 8");
  }

  State
  moved(const System &system, const Tableau &tableau, const double T, const unsigned int n)
  {
    const Record record = run(system, started(system), tableau, T / n, n);
    EXPECT_EQ(record.n_steps, n);
    return record.state;
  }

  double
  probe(const Scene &scene, const std::string &name, const State &state)
  {
    return scene.input.model.probe(name).value(state);
  }

  /** Of the λ of the modes, the distance to the nearest to @p wanted. */
  double
  distance_to_mode(Scene &scene, const std::complex<double> &wanted)
  {
    double least = 1e300;
    for (const auto &mode : scene.modes())
      least = std::min({least, std::abs(mode.lambda - wanted), std::abs(std::conj(mode.lambda) - wanted)});
    return least;
  }

  const std::string modal = "set Analyses = static, modal\nsubsection Modal\n set Modes = 5\nend\n";

  const std::string pid = R"(
  subsection pilot
    set Type = PID
    set Signal = slide.displacement
    set Signal unit = m
    set Target = 0.3
    set Unit = N
    set Proportional gain = 40 N/m
    set Integral gain = 60 N/(m s)
    set Derivative gain = 6 N s/m
    set Filter time = 0.05 s
)";

  const std::string weight = "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n";
} // namespace



// Gains, filter and integral by hand, as laws and states of first order, move in the same way.
TEST(Controllers, PidIsWhatItsLawsAre)
{
  const std::string by_hand =
    on_a_slide(R"(
  subsection I
    set Rate = 60*(0.3 - slide.displacement)
  end
  subsection f
    set Rate = (0.3 - slide.displacement - f)/0.05
  end
)",
               "set Force = 40*(0.3 - slide.displacement) + I + 6*(0.3 - slide.displacement - f)/0.05");
  const Scene hand(by_hand + weight), kind(on_a_slide(pid + " end\n", "set Force = pilot") + weight);
  for_all_members([&](const Tableau &tableau) {
    const State a = moved(hand.system, tableau, 0.6, 20), b = moved(kind.system, tableau, 0.6, 20);
    EXPECT_NEAR(a.coordinates[0], b.coordinates[0], 1e-12);
    EXPECT_NEAR(a.states[0], b.states[0], 1e-11);
    EXPECT_NEAR(a.states[1], b.states[1], 1e-12);
    EXPECT_NEAR(probe(kind, "pilot", b),
                40 * (0.3 - a.coordinates[0]) + a.states[0] + 120 * (0.3 - a.coordinates[0] - a.states[1]),
                1e-10);
  });
}



// In equilibrium there is no error, and the integral carries the weight; modes are roots of the closed loop.
TEST(Controllers, PidStaticsAndModes)
{
  Scene scene(modal + on_a_slide(pid + " end\n", "set Force = pilot") + weight);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("slide.displacement"), 0.3, 1e-10);
  EXPECT_NEAR(scene.value("pilot"), 2 * 9.80665, 1e-9);
  // (2 s³ + 40 s + 60)(1 + 0.05 s) + 6 s²
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.row(0) << -2 / 0.1, -(0.05 * 40 + 6) / 0.1, -(40 + 0.05 * 60) / 0.1, -60 / 0.1;
  companion.bottomLeftCorner<3, 3>().setIdentity();
  const Eigen::Vector4cd roots = general_eigenvalues(companion);
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_LT(distance_to_mode(scene, roots(i)), 1e-8) << roots(i);
}



// With the rate of the signal as it is there is no filter.
TEST(Controllers, PidWithARateOfItsOwn)
{
  Scene scene(modal + on_a_slide(pid + " set Signal rate = slide.displacement rate\n end\n", "set Force = pilot"));
  ASSERT_EQ(scene.system.layout.n_states, 1u);
  scene.equilibrium();
  Eigen::Matrix3d companion = Eigen::Matrix3d::Zero();
  companion.row(0) << -3, -20, -30; // 2 s³ + 6 s² + 40 s + 60
  companion.bottomLeftCorner<2, 2>().setIdentity();
  const Eigen::Vector3cd roots = general_eigenvalues(companion);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_LT(distance_to_mode(scene, roots(i)), 1e-8) << roots(i);
}



// Between limits, with the integral led back: against Runge and Kutta's rule with steps of 1e-5 s.
TEST(Controllers, PidBetweenLimits)
{
  const Scene scene(
    on_a_slide(pid + " set Upper limit = 5 N\n set Lower limit = -2 N\n set Tracking time = 0.2 s\n end\n",
               "set Force = pilot"));
  StageIntegrator integrator(scene.system, Tableau(2, 1.), 1e-12);
  Stepper         stepper(scene.system, integrator, 0.01, 1e-12);
  State           state = started(scene.system);

  std::array<double, 4> x    = {0, 1, 0, 0}; // displacement, velocity, integral, filter
  const auto            rate = [](const std::array<double, 4> &x) -> std::array<double, 4> {
    const double e = 0.3 - x[0], v = 40 * e + x[2] + 120 * (e - x[3]), u = std::min(5., std::max(-2., v));
    return {x[1], u / 2, 60 * e + (u - v) / 0.2, (e - x[3]) / 0.05};
  };
  const auto moved = [](std::array<double, 4> x, const std::array<double, 4> &k, const double h) {
    for (unsigned int i = 0; i < 4; ++i)
      x[i] += h * k[i];
    return x;
  };
  double most = 0;
  for (const double end : {0.5, 1., 2., 4.})
    {
      while (state.time < end)
        stepper.advance(state, end);
      const double h = 1e-5;
      for (double t = most; t < end - h / 2; t += h)
        {
          const auto a = rate(x), b = rate(moved(x, a, h / 2)), c = rate(moved(x, b, h / 2)), d = rate(moved(x, c, h));
          for (unsigned int i = 0; i < 4; ++i)
            x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
      most = end;
      EXPECT_NEAR(state.coordinates[0], x[0], 1e-6) << end;
      EXPECT_NEAR(state.states[0], x[2], 1e-4) << end;
    }
}



// Static gain, poles, and what a sine becomes.
TEST(Controllers, TransferFunction)
{
  const std::string text = states_alone(R"(
  subsection y
    set Type = transfer function
    set Input = 3*sin(2*t) + slide.displacement
    set Numerator = 1, 4, 50
    set Denominator = 2, 8, 40, 50
  end
)");
  const Scene       scene(text);
  // the slide moves as sin(2 t)/2; after 30 s only the response at 2 rad/s is left
  const double               T     = 40;
  const State                state = moved(scene.system, Tableau(3, 1.), T, 800);
  const std::complex<double> s(0, 2), H = (s * s + 4. * s + 50.) / (2. * s * s * s + 8. * s * s + 40. * s + 50.);
  EXPECT_NEAR(state.coordinates[0], 0.5 * std::sin(2 * T), 1e-8);
  EXPECT_NEAR(probe(scene, "y", state), 3.5 * (H * std::exp(s * T)).imag(), 1e-8);

  Scene poles(modal + text);
  poles.equilibrium();
  Eigen::Matrix3d companion = Eigen::Matrix3d::Zero();
  companion.row(0) << -4, -20, -25;
  companion.bottomLeftCorner<2, 2>().setIdentity();
  const Eigen::Vector3cd roots = general_eigenvalues(companion);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_LT(distance_to_mode(poles, roots(i)), 1e-8) << roots(i);
}



// What goes through at once, and zeros of the denominator at s = 0.
TEST(Controllers, TransferFunctionThatIsNotStrictlyProper)
{
  const Scene scene(states_alone(R"(
  subsection y
    set Type = transfer function
    set Input = 2*cos(3*t)
    set Numerator = 5, 1, 2
    set Denominator = 1, 4, 0
  end
)"));
  // y = 5 u + ∫…: (5 s² + s + 2)/(s² + 4 s) = 5 + 0.5/s − 19.5/(s + 4)
  const double T = 1.5, integral = 2. / 3 * std::sin(3 * T),
               lag = 2 * (4 * std::cos(3 * T) + 3 * std::sin(3 * T)) / 25 - 8. / 25 * std::exp(-4 * T);
  EXPECT_NEAR(probe(scene, "y", moved(scene.system, Tableau(3, 1.), T, 60)),
              10 * std::cos(3 * T) + 0.5 * integral - 19.5 * lag,
              1e-8);
}



// Two inputs, two outputs: against the exponential of the matrix.
TEST(Controllers, StateSpace)
{
  const Scene  scene(states_alone(R"(
  subsection filter
    set Type = state space
    set Inputs = 1 + 0*t, slide.displacement rate
    set A = -1, 2; -3, -0.5
    set B = 1, 0.5; 0, 2
    set C = 1, 0; 1, 1
    set D = 0, 1; 2, 0
    set Initial = 0.3, -0.2
  end
  subsection sum
    set Rate = filter_1 - 2*filter_2 - sum
  end
)"));
  const double T     = 1.2;
  const State  state = moved(scene.system, Tableau(3, 1.), T, 40);
  // x, the constant 1, the sine and cosine of the slide's motion, and the sum: one linear system of rates
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 6);
  A.row(0) << -1, 2, 1, 0, 0.5, 0;
  A.row(1) << -3, -0.5, 0, 0, 2, 0;
  A(3, 4) = 2; // displacement sin(2t)/2 as sine, rate cos(2t)
  A(4, 3) = -2;
  A.row(5) << 1 - 2, -2, -4, 0, 1, -1;
  Eigen::VectorXd x(6);
  x << 0.3, -0.2, 1, 0, 1, 0;
  const unsigned int n = 4096; // by Taylor's series of many small steps
  for (unsigned int i = 0; i < n; ++i)
    {
      Eigen::VectorXd term = x;
      for (unsigned int k = 1; k < 8; ++k)
        x += (term = A * term * (T / n / k)).eval();
    }
  EXPECT_NEAR(state.states[0], x(0), 1e-9);
  EXPECT_NEAR(state.states[1], x(1), 1e-9);
  EXPECT_NEAR(state.states[2], x(5), 1e-9);
  EXPECT_NEAR(probe(scene, "filter_1", state), x(0) + x(4), 1e-9);
  EXPECT_NEAR(probe(scene, "filter_2", state), x(0) + x(1) + 2, 1e-9);
}



// A sine comes later; polynomials of low degree do exactly; a constant that has been there is there at once.
TEST(Controllers, Delay)
{
  const auto later = [](const std::string &input, const std::string &more, const double T) {
    const Scene scene(
      states_alone("  subsection y\n set Type = delay\n set Time = 0.4 s\n set Order = 6\n set Input = " + input +
                   "\n" + more + " end\n"));
    return probe(scene, "y", moved(scene.system, Tableau(3, 1.), T, 100 * T));
  };
  EXPECT_NEAR(later("sin(3*t)", "", 4), std::sin(3 * 3.6), 1e-7);
  EXPECT_NEAR(later("1 + 2*t + 3*t^2", "", 4), 1 + 2 * 3.6 + 3 * 3.6 * 3.6, 1e-7);
  EXPECT_NEAR(later("0.7", "set Initial = 0.7\n", 1), 0.7, 1e-13);
  EXPECT_NEAR(later("0.7", "", 0.1), 0., 0.1);
}



// A loop that is delayed: the roots of s² + 2 d s + ω² with a force that comes late, e^(−sT) as the approximant.
TEST(Controllers, DelayInALoop)
{
  Scene scene(modal + on_a_slide(R"(
  subsection late
    set Type = delay
    set Time = 0.1 s
    set Order = 8
    set Unit = m
    set Input = slide.displacement
  end
)",
                                 "set Spring = 50\n set Force = -20 N/m*late"));
  scene.equilibrium();
  std::complex<double> s(0, 6); // 2 s² + 50 + 20 e^(−0.1 s) = 0
  for (unsigned int i = 0; i < 20; ++i)
    {
      const auto e = std::exp(-0.1 * s);
      s -= (2. * s * s + 50. + 20. * e) / (4. * s - 2. * e);
    }
  EXPECT_GT(s.real(), 0.1); // what comes late drives it
  EXPECT_LT(distance_to_mode(scene, s), 1e-9);
}



// All kinds at once, with signals of places, velocities and reactions: exact derivatives.
TEST(Controllers, TangentsAreDerivatives)
{
  std::string text = top_with_controls();
  text.replace(text.find("subsection roll"), 0, R"(subsection pilot
    set Type = PID
    set Signal = b.tip.position x*b.angular velocity z
    set Target = drift*sin(t)
    set Proportional gain = 2
    set Integral gain = 3
    set Derivative gain = 0.4
    set Filter time = 0.1
    set Upper limit = 50
  end
  subsection shaped
    set Type = transfer function
    set Input = pilot*b.velocity x
    set Numerator = 1, 2, 3
    set Denominator = 1, 2, 5
  end
  subsection late
    set Type = delay
    set Time = 0.2
    set Input = ball.force 1 + 2*ball.force 3*b.velocity y
  end
  )");
  text.replace(text.find("-2*drift,"), 9, "-2*drift + pilot*shaped + 0.1*late,");
  const Scene       scene(text);
  const ComplexStep moving(scene.system, true, false, true);
  EXPECT_LT(moving.error_of_tangent(), 1e-13);
  EXPECT_LT(moving.error_of_damping(), 1e-13);
}



TEST(Controllers, RefuseWhatMakesNoSense)
{
  const auto expect = [](const std::string &states, const std::string &message, const std::string &force = "0") {
    const std::string said = complaint_of(on_a_slide(states, "set Force = " + force));
    EXPECT_NE(said.find(message), std::string::npos) << states << said;
  };
  const std::string of_one = "  subsection y\n set Type = ";
  expect(of_one + "PID\n set Signal = slide.displacement\n end\n", "all gains of <y> are zero");
  expect(of_one + "PID\n set Proportional gain = 2\n end\n", "Signal");
  expect(pid + " set Upper limit = 2\n set Lower limit = 3\n end\n", "must be above");
  expect(of_one + "PID\n set Signal = t\n set Derivative gain = 2\n end\n", "Filter time");
  expect(of_one + "PID\n set Signal = t\n set Integral gain = 2\n set Upper limit = 1\n end\n", "Tracking time");
  expect(of_one + "PID\n set Signal = slide.displacement\n set Proportional gain = 2 N/m\n set Unit = N\n end\n",
         "Proportional gain");
  expect(of_one + "transfer function\n set Input = t\n set Numerator = 1, 2, 3\n set Denominator = 1, 2\n end\n",
         "degree");
  expect(of_one + "transfer function\n set Input = t\n set Numerator = 1\n set Denominator = 0, 2\n end\n", "zero");
  expect(of_one + "transfer function\n set Input = t\n set Numerator = 1\n set Denominator = 2\n end\n", "no state");
  expect(of_one + "state space\n set Inputs = t\n set A = -1, 2\n set B = 1\n set C = 1\n end\n", "<A>");
  expect(of_one + "state space\n set Inputs = t\n set A = -1\n set B = 1, 2\n set C = 1\n end\n", "<B>");
  expect(of_one + "delay\n set Input = t\n set Time = 0\n end\n", "above zero");
  expect(of_one + "delay\n set Input = 2 m + slide.displacement\n set Time = 1 s\n set Unit = N\n end\n",
         "slide.displacement");
  expect(of_one + "delay\n set Input = slide.nothing\n set Time = 1 s\n end\n", "nothing");
  // of itself, and of each other
  expect(of_one + "PID\n set Signal = 2*y\n set Proportional gain = 2\n end\n", "depends on itself");
  expect(
    of_one + "PID\n set Signal = z\n set Proportional gain = 2\n end\n" +
      "  subsection z\n set Type = transfer function\n set Input = y\n set Numerator = 1, 2\n set Denominator = 1, 3\n"
      " end\n",
    "depends on itself");
  EXPECT_EQ(complaint_of(
              on_a_slide(of_one + "PID\n set Signal = z\n set Proportional gain = 2\n end\n" +
                           "  subsection z\n set Type = transfer function\n set Input = y\n set Numerator = 2\n"
                           " set Denominator = 1, 3\n end\n",
                         "set Force = y")),
            "");
}



// Who integrates and has nothing that leads it back has no steady state, and is named.
TEST(Controllers, StaticsNameIntegratorsWithoutASteadyState)
{
  for (const std::string kind :
       {"first order\n set Rate = 2*sin(t) + slide.displacement",
        "transfer function\n set Input = slide.displacement\n set Numerator = 1\n set Denominator = 1, 2, 0",
        "PID\n set Signal = slide.displacement\n set Integral gain = 2\n set Proportional gain = 1"})
    {
      Scene scene("set Analyses = static\n" + states_alone("  subsection lonely\n set Type = " + kind + "\n end\n") +
                  weight);
      try
        {
          scene.equilibrium();
          ADD_FAILURE() << kind << ": " << scene.value("lonely");
        }
      catch (const std::exception &problem)
        {
          EXPECT_NE(std::string(problem.what()).find("lonely"), std::string::npos) << problem.what();
        }
    }
}
