// Ellipsoids and discs on planes, and what resists rolling and turning.
//
// References: closed forms of balls and discs; an ellipsoid of equal axes against a ball; the steady motion of a coin;
// a rattleback that rolls without slip, integrated by a program of its own from the equations of Kane & Levinson
// (Int. J. Non-Linear Mech. 17 (1982) 175) in body axes, by Runge and Kutta with 1e-4 s, its energy constant to 1e-10.

#include <samara/base/errors.h>

#include <gtest/gtest.h>

#include "contact_motion.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  constexpr double gravity_constant = 9.80665;

  std::string
  listed(const Vector3 &a)
  {
    return number_of(a(0)) + ", " + number_of(a(1)) + ", " + number_of(a(2));
  }

  std::string
  on_floor(const std::string &kind, const std::string &body, const std::string &entries)
  {
    return joint("floor",
                 kind,
                 "set Body A = ground\n set Body B = " + body + "\n set Position = 0, 0, 0\n set Axis = 0, 0, 1\n" +
                   entries);
  }

  Vector3
  velocity_of(const State &state)
  {
    return state.triad(1) * Eigen::Map<const Vector3>(&state.y[6]);
  }
  Vector3
  spin_of(const State &state)
  {
    return state.triad(1) * Eigen::Map<const Vector3>(&state.y[9]);
  }

  const std::string hertz = "set Stiffness = 1e6\n set Exponent = 1.5\n";
  const double      depth = std::pow(gravity_constant / 1e6, 1 / 1.5); ///< of 1 kg on it
} // namespace



// A ball that rolls is slowed by 5/7 μ_r g, stops, and stays; all of its energy is lost to what resists rolling.
TEST(Ellipsoids, RollingIsResisted)
{
  const double R = 0.1, v = 1, mu = 0.05, a = 5. / 7 * mu * gravity_constant;
  const Scene  scene(model(ball("a", R, {0, 0, R - depth}, {0.6 * v, 0.8 * v, 0}, {-0.8 * v / R, 0.6 * v / R, 0}),
                          on_floor("ball on plane",
                                   "a.centre",
                                   hertz + " set Radius = 0.1\n set Friction = 0.5\n set Rolling friction = 0.05\n"
                                            " set Sticking speed = 1e-5\n"),
                          gravity));
  for (const unsigned int s : {2, 3})
    {
      double     at_half = 0;
      const auto m       = contact_motion(
        scene.system, Tableau(s, 0.5), v / a / 80, 1.5 * v / a, [&](const State &state, const StepResult &) {
          if (std::abs(state.time - v / a / 2) < 1e-9)
            at_half = velocity_of(state).norm();
        });
      EXPECT_NEAR(at_half, v / 2, 1e-3);
      EXPECT_LT(velocity_of(m.state).norm(), 1e-5);
      EXPECT_NEAR(std::hypot(m.state.position(1)(0), m.state.position(1)(1)) / (v * v / (2 * a)), 1, 2e-3) << s;
      EXPECT_NEAR(m.friction_loss + m.dissipated, 0.7 * v * v, 1e-6);
      EXPECT_LT(m.drift, 1e-11);
      EXPECT_EQ(m.least_loss, 0);
    }
}



// On the spot: J dω/dt = −μ_t m g R.
TEST(Ellipsoids, TurningIsResisted)
{
  const double R = 0.1, w = 10, mu = 0.02, t_stop = 0.4 * R * w / (mu * gravity_constant);
  const Scene  scene(
    model(ball("a", R, {0, 0, R - depth}, {0, 0, 0}, {0, 0, w}),
          on_floor("ball on plane",
                   "a.centre",
                   hertz + " set Radius = 0.1\n set Turning friction = 0.02\n set Sticking speed = 1e-5\n"),
          gravity));
  double     at_half = 0;
  const auto m       = contact_motion(
    scene.system, Tableau(3, 0.5), t_stop / 40, 1.5 * t_stop, [&](const State &state, const StepResult &) {
      if (std::abs(state.time - t_stop / 2) < 1e-9)
        at_half = spin_of(state)(2);
    });
  EXPECT_NEAR(at_half, w / 2, 1e-4 * w);
  EXPECT_LT(spin_of(m.state).norm(), 1e-6 * w);
  EXPECT_NEAR(m.friction_loss + m.dissipated, 0.2 * R * R * w * w, 1e-9);
  EXPECT_LT(m.drift, 1e-11);
}



// One with equal axes is a ball; and so is what is half a ball and half rounding. It bounces, slips and rolls.
TEST(Ellipsoids, EqualAxesAreABall)
{
  const auto run = [&](const std::string &kind, const std::string &shape) {
    const Scene scene(
      model(ball("a", 0.1, {0, 0, 0.11}, {1, 0.5, 0}, {0, -20, 3}),
            on_floor(kind,
                     "a.centre",
                     hertz + shape + " set Restitution = 0.6\n set Impact speed = 1\n set Friction = 0.3\n" +
                       " set Rolling friction = 0.02\n set Turning friction = 0.01\n"),
            gravity));
    return contact_motion(scene.system, Tableau(2, 0.5), 2e-3, 0.3).state;
  };
  const State reference = run("ball on plane", " set Radius = 0.1\n");
  for (const std::string shape :
       {" set Semi-axes = 0.1, 0.1, 0.1\n", " set Semi-axes = 0.03, 0.03, 0.03\n set Rounding = 0.07\n"})
    {
      const State state = run("ellipsoid on plane", shape);
      EXPECT_LT((state.position(1) - reference.position(1)).norm(), 1e-9);
      EXPECT_LT((state.triad(1) - reference.triad(1)).norm(), 1e-7);
      EXPECT_LT((velocity_of(state) - velocity_of(reference)).norm(), 1e-8);
    }
}



// An egg falls on ice and jumps about: no energy is made or lost, and nothing pushes it along.
TEST(Ellipsoids, EggOnIce)
{
  const Scene scene(model(
    rigid_body(
      "a",
      "set Mass = 1\n set Inertia = 2e-3, 3e-3, 4e-3\n set Position = 0, 0, 0.3\n set Rotation = 0.4, 0.7, -0.5\n" +
        moving("0.3, -0.2, 0", "1, -3, 5")),
    on_floor("ellipsoid on plane",
             "a.centre",
             "set Stiffness = 1e5\n set Exponent = 1.5\n set Semi-axes = 0.12, 0.08, 0.06\n"),
    gravity));
  for (const unsigned int s : {1, 2, 3})
    {
      double       lowest    = 1;
      unsigned int n_touched = 0;
      const auto   m =
        contact_motion(scene.system, Tableau(s, 1.), 2e-3, 1.5, [&](const State &state, const StepResult &step) {
          n_touched += !step.touched_stops.empty();
          lowest = std::min(lowest, state.position(1)(2));
        });
      EXPECT_LT(m.drift, 1e-11) << s;
      const double error = s == 1 ? 1e-3 : s == 2 ? 1e-6 : 1e-8; // of the integrator, in the axes of what tumbles
      EXPECT_NEAR(velocity_of(m.state)(0), 0.3, error);
      EXPECT_NEAR(velocity_of(m.state)(1), -0.2, error);
      EXPECT_GT(n_touched, 5u);
      EXPECT_GT(lowest, 0.05);
    }
}



// An upright disc with a round rim that spins backwards is thrown: it slips, comes back and rolls. About the line that
// it runs on, m v R + J w stays; (v − w R)² m J/(2 (J + m R²)) is lost.
TEST(Ellipsoids, SpinningDiscSlipsAndRolls)
{
  const double R = 0.1, J = 0.5 * 0.1 * 0.1, v = 1, w = -30, k = 1e6, sink = gravity_constant / k;
  const Scene  scene(
    model(rigid_body("a",
                     "set Mass = 1\n set Inertia = 2.5e-3, 2.5e-3, 5e-3\n set Rotation = 0, 0, 1.5707963267948966\n"
                      " set Position = 0, 0, " +
                       number_of(R - sink) + "\n" + moving("1, 0, 0", "0, -30, 0")),
          on_floor("ellipsoid on plane",
                   "a.centre",
                   "set Stiffness = 1e6\n set Semi-axes = 0.09, 0.09, 0\n set Rounding = 0.01\n"
                    " set Friction = 0.4\n set Sticking speed = 1e-5\n"),
          gravity));
  const double rolls = (v * R + J * w) / (R + J / R);
  for (const unsigned int s : {2, 3})
    {
      const auto m = contact_motion(scene.system, Tableau(s, 0.5), 5e-3, 0.8);
      EXPECT_NEAR(velocity_of(m.state)(0), rolls, 1e-4) << s;
      EXPECT_NEAR(spin_of(m.state)(1), rolls / R, 1e-2) << s;
      EXPECT_NEAR(velocity_of(m.state)(1), 0, 1e-9);
      EXPECT_NEAR(m.friction_loss, std::pow(v - w * R, 2) * J / (2 * (J + R * R)), 1e-3);
      EXPECT_LT(m.drift, 1e-11);
      EXPECT_EQ(m.least_loss, 0);
    }
}



// The coin of prm/examples/rolling_disc.prm, held by friction alone: it leans by the same angle all the time while its
// axle turns about the vertical with 4 rad/s.
TEST(Ellipsoids, CoinRollsOnACircle)
{
  const double R = 0.3, th = 1.1, Omega = 4, m = 1.2, J1 = 0.03, J3 = 0.054;
  const double p = (J1 * Omega * Omega * std::sin(th) * std::cos(th) - m * gravity_constant * R * std::cos(th)) /
                   ((J3 + m * R * R) * Omega * std::sin(th));
  const Vector3 spin(p * std::sin(th) - Omega * std::sin(th) * std::cos(th),
                     0,
                     p * std::cos(th) + Omega * std::sin(th) * std::sin(th));
  const Scene   scene(model(
    rigid_body("a",
               "set Mass = 1.2\n set Inertia = 0.03, 0.03, 0.054\n set Rotation = 0, 1.1, 0\n set Position = 0, 0, " +
                 number_of(R * std::sin(th)) + "\n" + moving(listed({0, -R * p, 0}), listed(spin))),
    on_floor("ellipsoid on plane",
             "a.centre",
             "set Stiffness = 1e7\n set Damping = 2e3\n set Semi-axes = 0.3, 0.3, 0\n set Friction = 0.8\n"
               " set Bristle stiffness = 1e6\n set Bristle damping = 500\n"),
    gravity));
  double        worst = 0;
  const auto    run =
    contact_motion(scene.system, Tableau(3, 0.5), 5e-3, 1.5, [&](const State &state, const StepResult &) {
      worst = std::max(worst, std::abs(std::acos(state.triad(1)(2, 2)) - th));
    });
  EXPECT_LT(worst, 2e-3);
  const Matrix3 D = run.state.triad(1);
  EXPECT_NEAR(std::remainder(std::atan2(D(1, 2), D(0, 2)) - Omega * 1.5, 2 * M_PI), 0, 1e-2);
  EXPECT_LT(run.drift, 1e-10);
}



namespace
{
  /** A rattleback tilted about its long axis by @p tilt, on its feet, with a spin about its third axis. */
  std::string
  rattleback(const double tilt, const double spin)
  {
    const Matrix3 D      = rotation_of_angles({-tilt, 0, 0}, "123");
    const Vector3 normal = D.row(2), a_2(0.04, 0.0009, 0.0004);
    const double  h = std::sqrt(a_2.dot(normal.cwiseAbs2())), k = 1e8;
    const Vector3 centre(0, 0, h - gravity_constant / k), mass  = centre - D * Vector3(0, 0, 0.01),
                                                          touch = centre - D * Vector3(a_2.cwiseProduct(normal)) / h,
                                                          omega = D * Vector3(0, 0, spin);
    return model(
      rigid_body("a",
                 "set Mass = 1\n set Inertia = 2e-4, 1.6e-3, 1.7e-3, -2e-5, 0, 0\n set Rotation sequence = 123\n"
                 " set Rotation = " +
                   number_of(-tilt) + ", 0, 0\n set Position = " + listed(mass) + "\n set Frames = middle at " +
                   number_of(centre(0)) + " " + number_of(centre(1)) + " " + number_of(centre(2)) + "\n" +
                   moving(listed(omega.cross(mass - touch)), listed(omega))),
      on_floor("ellipsoid on plane",
               "a.middle",
               "set Stiffness = 1e8\n set Damping = 1000\n set Semi-axes = 0.2, 0.03, 0.02\n set Friction = 3\n"
               " set Bristle stiffness = 1e8\n set Bristle damping = 3000\n"),
      gravity);
  }
} // namespace



// It spins well in one direction. In the other one it begins to rattle, and turns round.
TEST(Ellipsoids, Rattleback)
{
  const Scene  bad(rattleback(0.0698131700797731833, -5)), good(rattleback(0.0698131700797731833, 5));
  const double reference[] = {-4.987820, -4.906228, -4.474265, -3.714099, -2.168907, -1.087212}; // at 0, 0.5, 1, …
  unsigned int n           = 0;
  double       most        = 0;
  const auto   m = contact_motion(bad.system, Tableau(3, 0.5), 2e-3, 2.5, [&](const State &state, const StepResult &) {
    if (std::abs(state.time - 0.5 * (n + 1)) < 1e-9)
      most = std::max(most, std::abs(spin_of(state)(2) - reference[++n]));
  });
  EXPECT_EQ(n, 5u);
  EXPECT_LT(most, 5e-3);
  EXPECT_LT(m.drift, 1e-9);
  EXPECT_GE(m.least_loss, -1e-14);
  EXPECT_LT(spin_of(contact_motion(good.system, Tableau(3, 0.5), 2e-3, 0.5).state)(2) / 5 - 1, 0.02);
}



// Where the distance is a root, the other branch of it would let a disc that falls flat, or a ball that crosses the
// centre of a hollow one, go through the wall: steps that lead there have no solution.
TEST(Ellipsoids, RootsStayOnTheirBranch)
{
  const std::vector<std::string> models = {
    model(rigid_body(
            "a",
            "set Mass = 1\n set Inertia = 2.5e-3, 2.5e-3, 5e-3\n set Rotation = 0, 0.4, 0\n set Position = 0, 0, " +
              number_of(0.1 * std::sin(0.4)) + "\n"),
          on_floor("ellipsoid on plane",
                   "a.centre",
                   "set Stiffness = 1e5\n set Damping = 100\n set Semi-axes = 0.1, 0.1, 0\n"),
          gravity),
    model(
      ball("a", 0.1, {0.5, 0, 0}, {-3, 0, 0}, {0, 0, 0}),
      joint(
        "bowl",
        "ball on ball",
        "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n set Radius = 0.1\n set Radius A = 1\n"
        " set Side = inside\n set Stiffness = 1e5\n"))};
  for (const auto &text : models)
    {
      const Scene scene(text);
      EXPECT_THROW(contact_motion(scene.system, Tableau(2, 0.5), 2e-3, 2.), NotConverged);
    }
  // a bit off the centre it goes across, and comes back from the wall on the other side
  const Scene off(
    model(ball("a", 0.1, {0.5, 0.01, 0}, {-3, 0, 0}, {0, 0, 0}),
          joint("bowl",
                "ball on ball",
                "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n set Radius = 0.1\n"
                " set Radius A = 1\n set Side = inside\n set Stiffness = 1e6\n")));
  const auto m = contact_motion(off.system, Tableau(2, 1.), 2e-3, 0.6);
  EXPECT_LT(m.drift, 1e-11);
  EXPECT_GT(velocity_of(m.state)(0), 2.9);
}
