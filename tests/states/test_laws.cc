// Laws of the state: derivatives of all signals, units, and what is refused.

#include <samara/base/quantity.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include "scenes.h"

using namespace samara;

namespace
{
  Quantities
  quantities()
  {
    Quantities result;
    result.signals.add_object("slider");
    result.signals.add_object("flap 1");
    result.signals.add_object("blade");
    result.signals.add_state("filter", "m/s^2");
    return result;
  }

  std::string
  problem_of(const std::string &text, const std::string &unit)
  {
    try
      {
        quantities().law(text, unit);
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



TEST(Laws, AreReadWithUnits)
{
  const Law law = quantities().law("-200 N * tanh(slider.displacement  rate / 0.01 m/s) + 2 kN*t/(1 s)", "N");
  ASSERT_EQ(law.signals(), std::vector<std::string>{"slider.displacement rate"});
  const double at[] = {0.5, 0.004};
  EXPECT_DOUBLE_EQ(law.value(at), -200 * std::tanh(0.4) + 1000);
  EXPECT_DOUBLE_EQ(law.derivative(at, 0), 2000.);
  EXPECT_NEAR(law.derivative(at, 1), -200 / std::pow(std::cosh(0.4), 2) / 0.01, 1e-9);
  // what is printed reads as the same law
  const Law again = quantities().law(law.text(), "N");
  EXPECT_EQ(again.signals(), law.signals());
  EXPECT_DOUBLE_EQ(again.value(at), law.value(at));
}



// A number and the unit behind it are one where only that fits; where both readings do, who writes must say which is
// meant.
TEST(Laws, UnitsBehindNumbers)
{
  const auto value = [](const std::string &text, const std::string &unit, const double signal) {
    const double at[] = {0.5, signal};
    return quantities().law(text, unit).value(at);
  };
  EXPECT_DOUBLE_EQ(value("-2 N*tanh(slider.displacement rate / 10 mm/s)", "N", 0.004), -2 * std::tanh(0.4));
  EXPECT_DOUBLE_EQ(value("sin(slider.displacement / 10 mm)", "1", 0.004), std::sin(0.4));
  EXPECT_NE(problem_of("slider.displacement / 10 mm > 0.3 ? 1 N : 2 N", "N").find("two ways"), std::string::npos);
  EXPECT_DOUBLE_EQ(value("slider.displacement > 3 mm ? 1 N : 2 N", "N", 0.004), 1.);
  EXPECT_NE(problem_of("-2 N*flap 1.rotation / 5 deg", "N").find("two ways"), std::string::npos);
  EXPECT_DOUBLE_EQ(value("-2 N*flap 1.rotation / (5 deg)", "N", 0.1), -0.2 / (5 * M_PI / 180));
  // what fits in no reading is refused
  EXPECT_NE(problem_of("-2 N*tanh(slider.displacement/1 s) + 3 m", "N"), "");
  EXPECT_NE(problem_of("-2 kN*slider.displacement rate - 1 kg*slider.displacement", "N"), "");
}



// Variables count with different values, or a difference would be zero, which fits any unit.
TEST(Laws, DifferencesAreMeasured)
{
  const double at[] = {0, 3, 1};
  EXPECT_DOUBLE_EQ(quantities().law("(slider.displacement - blade.tip.position x) / 50 ms", "m/s").value(at), 40.);
  EXPECT_NE(problem_of("5 kg*(slider.displacement rate - blade.tip.velocity x)", "N"), "");
  EXPECT_EQ(problem_of("5 kg/s*(slider.displacement rate - blade.tip.velocity x)", "N"), "");
}



TEST(Laws, StatesHaveNamesOfTheirOwn)
{
  for (const std::string name : {"N", "s", "t", "pi", "sin", "x-y", "a b", "_signal_0"})
    {
      std::string text = oscillator_with_lag();
      text.replace(text.find("subsection lag"), 14, "subsection " + name);
      EXPECT_NE(complaint_of(text).find("state <" + name + ">"), std::string::npos)
        << name << ": " << complaint_of(text);
    }
}



// A copy of a state that does not say its type is one of the same kind.
TEST(Laws, CopiesOfStates)
{
  std::string text = oscillator_with_lag();
  text.replace(text.find("end\nsubsection Bodies"),
               3,
               " subsection second\n set Copy of = lag\n set Initial = 2\n end\nend");
  const Scene scene(text);
  ASSERT_EQ(scene.system.layout.n_states, 2u);
  EXPECT_EQ(scene.system.reference().states, (std::vector<double>{0.4, 2}));
}



// What switches with time alone is a corner, whatever else is in the law.
TEST(Laws, CornersInTime)
{
  const Law law =
    quantities().law("(sin(2*pi*t/(0.05 s)) > 0 ? 2 N : 0 N)*abs(slider.displacement)/(1 m) + (t < 0.3 s ? 1 N : 0 N)",
                     "N");
  EXPECT_NEAR(law.next_corner(0.001, 0.05), 0.025, 1e-12);
  EXPECT_NEAR(law.next_corner(0.2751, 0.31), 0.3, 1e-12);
  EXPECT_EQ(quantities().law("abs(slider.displacement)*1 N*t/(1 s)", "N").next_corner(0, 1),
            std::numeric_limits<double>::infinity());
}



TEST(Laws, NamesMayHaveBlanksAndNumbers)
{
  const Law law =
    quantities().law("3*flap 1.rotation - 2*flap 1.rotation rate + blade.at 0.5.velocity z*blade.tip.velocity z",
                     "N*m");
  EXPECT_EQ(law.signals(),
            (std::vector<std::string>{
              "flap 1.rotation", "flap 1.rotation rate", "blade.at 0.5.velocity z", "blade.tip.velocity z"}));
  const double at[] = {0, 0.1, 0.2, 3, 5};
  EXPECT_DOUBLE_EQ(law.value(at), 0.3 - 0.4 + 15);
}



TEST(Laws, ThatOfTimeIsAFunctionOfTime)
{
  const Law law = quantities().law("3 kN * sin(t)", "N");
  EXPECT_FALSE(law.depends_on_state());
  EXPECT_DOUBLE_EQ(law.of_time()(1.), 3000 * std::sin(1.));
}



TEST(Laws, RefuseWhatDoesNotFit)
{
  EXPECT_NE(problem_of("2 m * slider.displacement", "N").find("slider.displacement"), std::string::npos);
  EXPECT_NE(problem_of("2*slider.displacment", "N").find("displacement"), std::string::npos);
  EXPECT_NE(problem_of("2*filtre", "m/s^2").find("filtre"), std::string::npos);
  EXPECT_EQ(problem_of("2*filter", "m/s^2"), "");
  EXPECT_NE(problem_of("2 N*s * filter", "N*m"), "");
}



// Numbers of a file: who has no such signal is told so with file and line.
TEST(Laws, UnknownSignalsHaveTheirLine)
{
  std::string text = oscillator_with_lag();
  text.replace(text.find("20 N * lag"), 10, "20 N*s/m * m.velocity q");
  EXPECT_NE(complaint_of(text).find(":2"), std::string::npos) << complaint_of(text);
  text = oscillator_with_lag();
  text.replace(text.find("20 N * lag"), 10, "20 N*s/m * m.tip.velocity x");
  EXPECT_NE(complaint_of(text).find("has no point <tip>"), std::string::npos) << complaint_of(text);
}



// Of laws with all kinds of signals: coordinates, rates, places and velocities of points, spins, states.
TEST(Laws, TangentsAreDerivatives)
{
  for (const auto &text : {oscillator_with_lag(), top_with_controls()})
    {
      const Scene       scene(text);
      const ComplexStep moving(scene.system, true, false, true);
      EXPECT_LT(moving.error_of_tangent(), 1e-13);
      EXPECT_LT(moving.error_of_damping(), 1e-13);
    }
}



namespace
{
  /** λ of λ² m + λ c + k of the motions and states that the constraints leave, all finite ones. */
  std::vector<std::complex<double>>
  dense_eigenvalues(const System &system, const State &state)
  {
    const int    n = system.size(), first = system.layout.of_multiplier(0);
    SparseMatrix M(system.layout.pattern), C(system.layout.pattern), K(system.layout.pattern);
    system.mass(M);
    system.damping(state, C);
    system.tangent(state, K);
    // more digits than what is compared with it: the pencil is singular, with as many infinite λ as states
    using Matrix       = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    const auto   dense = [](const SparseMatrix &S) { return S.dense().cast<long double>().eval(); };
    const Matrix Z     = dense(K).bottomRows(n - first).leftCols(first).fullPivLu().kernel();
    const auto   part  = [&](const SparseMatrix &S) {
      return (Z.transpose() * dense(S).topLeftCorner(first, first) * Z).eval();
    };
    const int r = Z.cols();
    Matrix    A = Matrix::Zero(2 * r, 2 * r), B = Matrix::Identity(2 * r, 2 * r);
    A.topRightCorner(r, r).setIdentity();
    A.bottomLeftCorner(r, r)  = -part(K);
    A.bottomRightCorner(r, r) = -part(C);
    B.bottomRightCorner(r, r) = part(M);
    const Eigen::GeneralizedEigenSolver<Matrix> solver(A, B);
    std::vector<std::complex<double>>           result;
    for (int i = 0; i < 2 * r; ++i)
      if (std::abs(solver.betas()(i)) > 1e-12L * std::abs(solver.alphas()(i)))
        result.emplace_back(solver.alphas()(i) / solver.betas()(i));
    return result;
  }
} // namespace



// λ of modes with states against the dense pencil λ²M + λC + K, each to 1e-12 of its size: a lag, and a PID controller
// with the lag of its derivative that holds up a pendulum. That lag, −45.5/s, is farthest from where modes are looked
// for, and is found to 2e-12.
TEST(Laws, ModesWithStatesAgainstDenseMatrices)
{
  const std::string pendulum = R"(
subsection States
  subsection controller
    set Type = PID
    set Signal = pin.rotation
    set Signal unit = rad
    set Unit = N*m
    set Target = 0.1
    set Proportional gain = 60
    set Integral gain = 80
    set Derivative gain = 9
    set Filter time = 0.02 s
  end
end
subsection Bodies
  subsection bob
    set Type = rigid body
    set Mass = 2
    set Position = 0, 0, 1
    set Inertia = 0.1, 0.2, 0.3
  end
end
subsection Joints
  subsection pin
    set Type = revolute
    set Axis = 0, 1, 0
    set Body A = ground
    set Body B = bob.centre
    set Position = 0, 0, 0
    subsection rotation
      set Moment = controller
    end
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
end
)";
  unsigned int      n        = 0;
  for (const auto &[text, n_modes] : {std::pair(oscillator_with_lag(), 2u), {pendulum, 3u}})
    {
      Scene scene("set Analyses = static, modal\nsubsection Modal\n set Modes = 4\nend\n" + text);
      scene.equilibrium();
      const auto expected = dense_eigenvalues(scene.system, scene.context.state);
      for (const Mode &mode : scene.modes())
        {
          double nearest = 1e300;
          for (const auto &lambda : expected)
            nearest = std::min({nearest, std::abs(mode.lambda - lambda), std::abs(std::conj(mode.lambda) - lambda)});
          EXPECT_LT(nearest, (std::abs(mode.lambda) < 10 ? 1e-12 : 1e-11) * std::abs(mode.lambda)) << mode.lambda;
          ++n;
        }
      EXPECT_GE(scene.modes().size(), n_modes);
    }
  EXPECT_GE(n, 5u);
}
