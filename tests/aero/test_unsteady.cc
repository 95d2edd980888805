// Unsteady loads: lift deficiency, Theodorsen's lift and moment, divergence, flutter of Goland's wing.

#include <samara/analysis/modal.h>
#include <samara/analysis/static.h>
#include <samara/base/dense.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>

#include "../reference.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include "goland_exact.h"
#include "growth.h"
#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  using Complex = std::complex<double>;

  /** R. T. Jones's C(k). */
  Complex
  deficiency(const double k)
  {
    const Complex s(0, k);
    return 1. - 0.165 * s / (s + 0.0455) - 0.335 * s / (s + 0.3);
  }

  const double speed = 30, semichord = 0.25, density = 1.225, span = 4;

  /** A rigid wing of chord 0.5 m in a wind of 30 m/s, its node @p a semichords behind half chord; no drag. */
  std::string
  thin_wing(const double a, const std::string &more)
  {
    const std::string plate = "  subsection plate\n    set Type = analytic\n  end\n";
    std::string       text  = rigid_wing(air("30, 0, 0", "    set Speed of sound = 1\n"),
                                  "    set Chord = 0.5\n    set Airfoils = plate\n    set Quarter chord = " +
                                    number_to_text((0.5 + a) * semichord) + "\n" + more);
    return text.replace(text.find("subsection Airfoils\n"), 20, "subsection Airfoils\n" + plate);
  }

  /** Force along z and moment about y [N, N m] of the air for unit harmonic motions along z and about y. */
  Eigen::Matrix2cd
  response(const Scene &scene, const double omega)
  {
    const System &system = scene.system;
    SparseMatrix  K(system.layout.pattern), C(K), M(K);
    system.tangent(scene.context.state, K);
    system.damping(scene.context.state, C);
    system.mass(M);
    Eigen::MatrixXcd S = K.dense().cast<Complex>() + Complex(0, omega) * C.dense() - omega * omega * M.dense();
    // what is not air
    Eigen::VectorXd body(6);
    body << 5, 5, 5, 2, 1, 2.5;
    S.topLeftCorner<6, 6>() += omega * omega * Eigen::MatrixXd(body.asDiagonal());
    const unsigned int n         = S.rows() - 6;
    Eigen::MatrixXcd   condensed = S.topLeftCorner<6, 6>();
    if (n > 0)
      condensed -= S.topRightCorner(6, n) * solution(S.bottomRightCorner(n, n), S.bottomLeftCorner(n, 6));
    Eigen::Matrix2cd F;
    F << -condensed(2, 2), -condensed(2, 4), -condensed(4, 2), -condensed(4, 4);
    return F;
  }
} // namespace



TEST(Unsteady, LiftDeficiencyOfTwoLags)
{
  const Scene scene(thin_wing(0., "")), steady(thin_wing(0., "    set Unsteady = quasi-steady\n"));
  for (const auto &row : reference_rows("rotor/lift_deficiency.csv"))
    {
      const double  k = std::stod(row.at("k")), omega = k * speed / semichord;
      const Complex C = response(scene, omega)(0, 0) / response(steady, omega)(0, 0);
      EXPECT_NEAR(C.real(), std::stod(row.at("jones_re")), 1e-9);
      EXPECT_NEAR(C.imag(), std::stod(row.at("jones_im")), 1e-9);
      EXPECT_NEAR(std::abs(C - Complex(std::stod(row.at("re")), std::stod(row.at("im")))), 0., 0.015);
    }
  // quasi-steady lift of a motion up is −2π ρ U b S iω
  EXPECT_NEAR(std::abs(response(steady, 7.)(0, 0) + Complex(0, 14.) * M_PI * density * speed * semichord * span),
              0.,
              1e-8);
}



// Lags in fast air: C(k) with b (1 − M²) in place of b, M = 0.6.
TEST(Unsteady, CompressibleLags)
{
  const auto wing = [](const std::string &more) {
    std::string text = thin_wing(0., more);
    return text.replace(text.find("Speed of sound = 1\n"), 19, "Speed of sound = 50\n");
  };
  const Scene  scene(wing("    set Compressible lags = true\n")), steady(wing("    set Unsteady = quasi-steady\n"));
  const double slower = 1 - 0.6 * 0.6;
  for (const double k : {0.02, 0.1, 0.5})
    {
      const double  omega = k * speed / semichord;
      const Complex C     = response(scene, omega)(0, 0) / response(steady, omega)(0, 0), s(0, k);
      EXPECT_LT(std::abs(C - (1. - 0.165 * s / (s + 0.0455 * slower) - 0.335 * s / (s + 0.3 * slower))), 1e-7) << k;
    }
  // beyond M = 0.9 they stay: the speed of sound of thin_wing() is 1 m/s
  const Scene   fast(thin_wing(0., "    set Compressible lags = true\n"));
  const double  least = 1 - 0.9 * 0.9, omega = 0.1 * speed / semichord;
  const Complex s(0, 0.1), C                 = response(fast, omega)(0, 0) / response(steady, omega)(0, 0);
  EXPECT_LT(std::abs(C - (1. - 0.165 * s / (s + 0.0455 * least) - 0.335 * s / (s + 0.3 * least))), 1e-7);
}



// T. Theodorsen, NACA Report 496 (1935), with C(k) of the lags: heave and pitch, lift and moment, any axis.
TEST(Unsteady, LiftAndMomentOfTheodorsen)
{
  for (const double a : {-0.5, -0.34, 0., 0.2})
    {
      const Scene scene(thin_wing(a, "    set Virtual mass = true\n"));
      for (const double k : {0.05, 0.3, 1., 4.})
        {
          const Complex s(0, k), C = deficiency(k);
          // h down in semichords, α nose up; lift up over ρU²b, moment nose up over ρU²b²
          const Complex L_h = M_PI * s * s + 2 * M_PI * C * s,
                        L_a = M_PI * (s - a * s * s) + 2 * M_PI * C * (1. + (0.5 - a) * s),
                        M_h = M_PI * a * s * s + 2 * M_PI * (a + 0.5) * C * s,
                        M_a = M_PI * (-(0.5 - a) * s - (1. / 8 + a * a) * s * s) +
                              2 * M_PI * (a + 0.5) * C * (1. + (0.5 - a) * s);
          const double           q     = density * speed * speed * semichord * span;
          const Eigen::Matrix2cd F     = response(scene, k * speed / semichord);
          const double           bound = 1e-9 * (1 + k * k);
          EXPECT_LT(std::abs(F(0, 0) * semichord / q + L_h), bound) << a << " " << k;
          EXPECT_LT(std::abs(F(0, 1) / q - L_a), bound) << a << " " << k;
          EXPECT_LT(std::abs(F(1, 0) / q + M_h), bound) << a << " " << k;
          EXPECT_LT(std::abs(F(1, 1) / (q * semichord) - M_a), bound) << a << " " << k;
        }
    }
}



// Where a section turns, the force along the chord is the suction of its leading edge, 2πρ(c/2) w² with the upwash w at
// half chord: I. E. Garrick, NACA Report 567 (1936), steady circulation. With lift normal to the flow at three quarters
// of the chord the slope would be twice that; this one decides on the power of coned blades.
TEST(Unsteady, SuctionOfTheLeadingEdge)
{
  const double alpha = 0.02;
  Scene        scene(thin_wing(-0.5, "    set Unsteady = quasi-steady\n"),
              {"Aerodynamics/air/Wind = " + number_to_text(speed * std::cos(alpha)) + ", 0, " +
                      number_to_text(speed * std::sin(alpha))});
  State       &state   = scene.context.state;
  const auto   suction = [&](const double spin) {
    state.y[6 + 4] = spin; // nose up, about the quarter chord
    return -scene.value("it.force x");
  };
  const double per_square = 2 * M_PI * density * semichord * span, upwash = speed * alpha;
  EXPECT_NEAR(suction(0), per_square * upwash * upwash, 1e-3 * per_square * upwash * upwash);
  const double slope = (suction(0.2) - suction(-0.2)) / 0.4, expected = per_square * upwash * semichord;
  EXPECT_NEAR(slope, expected, 1e-2 * expected);
}



namespace
{
  /**
   * M. Goland's wing (J. Appl. Mech. 12, 1945) in a wind along x: 6.096 m, chord 1.8288 m, elastic axis at 0.33, mass
   * centre at 0.43 of the chord; stiff in what is not bending up and twist. All of it is turned by R.
   */
  std::string
  goland(const double speed, const std::string &surface, const Eigen::Matrix3d &R = Eigen::Matrix3d::Identity())
  {
    const auto turned = [&](const double x, const double y, const double z) {
      const Eigen::Vector3d v = R * Eigen::Vector3d(x, y, z);
      return number_to_text(v(0)) + ", " + number_to_text(v(1)) + ", " + number_to_text(v(2));
    };
    return R"(
set Analyses = static, modal
subsection Sections
  subsection wing
    set Type        = engineering constants
    set EA          = 1e11
    set GA2         = 1e11
    set GA3         = 1e11
    set GJ          = 0.987e6
    set EI2         = 9.77e6
    set EI3         = 1e11
    set Mass        = 35.71
    set Mass centre = -0.18288, 0
    set I2          = 0
    set I3          = 7.445665
  end
end
subsection Bodies
  subsection wing
    set Type     = beam
    set Points   = 0, 0, 0; )" +
           turned(0, 6.096, 0) + "\n    set Axis 2   = " + turned(-1, 0, 0) + R"(
    set Section  = wing
    set Elements = 5
  end
end
subsection Joints
  subsection root
    set Type   = rigid
    set Body A = ground
    set Body B = wing.start
  end
end
subsection Airfoils
  subsection plate
    set Type = analytic
  end
end
)" + subsection("Aerodynamics", air(turned(speed, 0, 0))) +
           subsection("Surfaces",
                      subsection("lift",
                                 "    set Body = wing\n    set Chord = 1.8288\n    set Quarter chord = 0.146304\n"
                                 "    set Airfoils = plate\n    set Upper side = " +
                                   turned(0, 0, 1) +
                                   "\n    set Stations = 3\n    set Breaks = 1.2192, 2.4384, 3.6576, 4.8768\n" +
                                   surface)) +
           "subsection Modal\n  set Modes = 34\nend\n";
  }

  /** The eigenvalue that grows most among those that turn, or among those that do not. */
  Complex
  least_stable(const double speed, const bool that_turns = true)
  {
    Scene   scene(goland(speed, "    set Virtual mass = true\n"));
    Complex least(-1e300, 0);
    for (const auto &mode : scene.modes())
      if ((mode.lambda.imag() > 20) == that_turns && mode.lambda.real() > least.real())
        least = mode.lambda;
    return least;
  }

  /** The speed between two of a sweep at which that grows no more, by the rule of the false position, and its λ. */
  std::pair<double, Complex>
  onset(double low, double high, const bool that_turns)
  {
    Complex of_low = least_stable(low, that_turns), of_high = least_stable(high, that_turns);
    EXPECT_LT(of_low.real(), 0.);
    EXPECT_GT(of_high.real(), 0.);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double  U  = low - of_low.real() * (high - low) / (of_high.real() - of_low.real());
        const Complex at = least_stable(U, that_turns);
        if (std::abs(at.real()) < 1e-7 * std::abs(of_high - of_low))
          return {U, at};
        (at.real() < 0 ? low : high)       = U;
        (at.real() < 0 ? of_low : of_high) = at;
      }
    const double share = -of_low.real() / (of_high.real() - of_low.real());
    return {low + share * (high - low), of_low + share * (of_high - of_low)};
  }
} // namespace



// A clamped wing with a small angle of attack twists by α (1/cos κL − 1), κ² = q c e a/GJ; it diverges at κL = π/2.
TEST(Unsteady, TwistBeforeDivergence)
{
  const double L = 6.096, c = 1.8288, e = 0.146304, alpha = 1e-4;
  for (const double U : {100., 200., 220.})
    {
      const double kappa = std::sqrt(0.5 * 1.225 * U * U * c * e * 2 * M_PI / 0.987e6);
      ASSERT_LT(kappa * L, M_PI / 2);
      Scene scene(goland(U, "    set Twist = 1e-4\n"));
      scene.equilibrium();
      const double twist = scene.value("wing.end.rotation y") * M_PI / 180,
                   exact = alpha * (1 / std::cos(kappa * L) - 1);
      EXPECT_NEAR(twist, exact, 1e-5 * exact) << U;
    }
}



// C(k) of cylinder functions is that of the table, to its digits.
TEST(Unsteady, LiftDeficiencyOfTheodorsen)
{
  for (const auto &row : reference_rows("rotor/lift_deficiency.csv"))
    EXPECT_LT(std::abs(GolandWing::theodorsen(std::stod(row.at("k"))) -
                       Complex(std::stod(row.at("re")), std::stod(row.at("im")))),
              1e-9)
      << row.at("k");
}



// A sweep of speed: the least damped mode crosses zero where the exact solution with the C(k) of the lags has it, to
// what five elements leave, and within 0.3 % in speed and 1 % in frequency of that with Theodorsen's C(k).
TEST(Unsteady, FlutterOfGolandsWing)
{
  double last = -1e300;
  for (const double U : {130., 134., 140.}) // from where it is the least damped
    {
      const Complex lambda = least_stable(U);
      EXPECT_GT(lambda.real(), last) << U;
      EXPECT_EQ(lambda.real() > 0, U > 138) << U;
      last = lambda.real();
    }
  const auto [U, lambda] = onset(134., 140., true);
  GolandWing wing;
  wing.deficiency  = deficiency;
  const auto lags  = wing.flutter(137., 70.);
  wing.deficiency  = GolandWing::theodorsen;
  const auto exact = wing.flutter(137., 70.);
  EXPECT_LT(lags.left, 1e-12);
  EXPECT_LT(exact.left, 1e-12);
  EXPECT_NEAR(U, lags.U, 1e-4 * lags.U);
  EXPECT_NEAR(lambda.imag(), lags.omega, 1e-4 * lags.omega);
  EXPECT_NEAR(U, exact.U, 0.003 * exact.U);
  EXPECT_NEAR(lambda.imag(), exact.omega, 0.01 * exact.omega);
}



// It diverges where the twist of a clamped wing has no bounds, κL = π/2: there a real eigenvalue is zero.
TEST(Unsteady, DivergenceOfGolandsWing)
{
  const double L = 6.096, c = 1.8288, e = 0.146304,
               expected  = M_PI / 2 / L * std::sqrt(0.987e6 / (0.5 * 1.225 * c * e * 2 * M_PI));
  const auto [U, lambda] = onset(0.99 * expected, 1.01 * expected, false);
  EXPECT_NEAR(U, expected, 1e-5 * expected);
  EXPECT_EQ(lambda.imag(), 0.);
}



// The same as a motion, three per cent below and above: after a blow all but the mode that flutters die away, and it
// decays and grows as the modes tell.
TEST(Unsteady, FlutterOfGolandsWingInTime)
{
  for (const double U : {133., 141.})
    {
      const Complex expected = least_stable(U);
      EXPECT_EQ(expected.real() > 0, U > 137);
      Scene  scene(goland(U, "    set Virtual mass = true\n"));
      State &state = scene.context.state;
      for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
        state.y[6 * node + 2] = 1e-5 * std::pow(state.position(node)(1), 2);
      state.held = false;
      Projection(scene.system).velocities(state);
      const Probe         tip = scene.input.model.probe("wing.end.displacement z");
      const double        h   = 0.01;
      StageIntegrator     integrator(scene.system, Tableau(3, 1.), 1e-12, 50);
      std::vector<double> values;
      for (unsigned int i = 0; i < 150; ++i)
        {
          ASSERT_TRUE(integrator.step(state, h).converged);
          if (i >= 100)
            values.push_back(tip.value(state));
        }
      EXPECT_LT(std::abs(growth_of(values, h) - expected), 1e-3 * std::abs(expected)) << U << " " << expected;
    }
}



// The wing has no inertia about one of its axes: in axes that are turned that is a round-off of zero, beside couplings
// that are larger by many orders. Frequencies far below and far above it are those of the wing that is not turned.
TEST(Unsteady, ModesDoNotDependOnAxes)
{
  const auto modes_of = [](const Eigen::Matrix3d &R) {
    Scene                scene(goland(100, "    set Virtual mass = true\n", R));
    std::vector<Complex> values;
    for (const auto &mode : scene.modes())
      values.push_back(mode.lambda);
    std::sort(values.begin(), values.end(), [](const Complex &a, const Complex &b) {
      return std::abs(a) < std::abs(b);
    });
    return values;
  };
  const auto straight = modes_of(Eigen::Matrix3d::Identity()),
             turned   = modes_of((Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()) *
                                Eigen::AngleAxisd(2., Eigen::Vector3d::UnitX()))
                                 .toRotationMatrix());
  ASSERT_EQ(straight.size(), turned.size());
  for (unsigned int i = 0; i < straight.size(); ++i)
    EXPECT_NEAR(std::abs(straight[i]), std::abs(turned[i]), 1e-6 * std::abs(straight[i])) << i;
}
