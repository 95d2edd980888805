// Dry friction in time steps, of joints and of contacts: losses, and closed forms of blocks, pendulums and balls.

#include <gtest/gtest.h>

#include "rubbing.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  std::string
  friction_of(const double mu, const double epsilon)
  {
    return " set Friction = " + number_of(mu) + "\n set Sticking speed = " + number_of(epsilon) + "\n";
  }
} // namespace



// Up the slope with v: it stops after v²/(2 g (sin α + μ cos α)) and creeps back with ε tan α/√(μ² − tan² α).
TEST(DryFriction, BlockOnASlope)
{
  const double angle = 0.3, mu = 0.5, v = 2, epsilon = 1e-4;
  const double way   = v * v / (2 * g_n * (std::sin(angle) + mu * std::cos(angle))),
               creep = epsilon * std::tan(angle) / std::sqrt(mu * mu - std::pow(std::tan(angle), 2));
  const Scene scene(block_on_slope(angle, v, friction_of(mu, epsilon)));
  for (const auto &[s, rho] : {std::make_pair(1, 1. / 3),
                               std::make_pair(2, 0.5),
                               std::make_pair(3, 0.5),
                               std::make_pair(2, 1.),
                               std::make_pair(3, 1.)})
    {
      SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + number_of(rho));
      const auto m = contact_motion(scene.system, Tableau(s, rho), 0.01, 1.);
      EXPECT_LT(m.drift, 1e-12);
      EXPECT_LT(m.up, 1e-12);
      EXPECT_EQ(m.least_loss, 0);
      EXPECT_NEAR(m.state.coordinates[0] / way, 1, s == 1 ? 0.03 : 1e-3);
      if (rho < 1)
        {
          EXPECT_NEAR(m.state.rates[0] / -creep, 1, 1e-5);
        }
      EXPECT_NEAR(m.friction_loss + m.dissipated, 0.5 * v * v - g_n * std::sin(angle) * m.state.coordinates[0], 1e-6);
    }
  // less friction than the slope: down again, v² = 2 g s (sin α − μ cos α) behind
  const Scene  slips(block_on_slope(angle, v, friction_of(0.2, epsilon)));
  const double up = v * v / (2 * g_n * (std::sin(angle) + 0.2 * std::cos(angle))), t_up = 2 * up / v,
               a = g_n * (std::sin(angle) - 0.2 * std::cos(angle));
  const auto m   = contact_motion(slips.system, Tableau(3, 0.5), 1e-3, 2.);
  EXPECT_NEAR(m.state.coordinates[0], up - 0.5 * a * std::pow(2 - t_up, 2), 1e-3);
}



// A ring of reactions: a bead that slides round a hoop without weight, N = m v²/R, v = v₀/(1 + μ v₀ t/R), as a body on
// a revolute with its mass at the rim and a pin as large as that.
TEST(DryFriction, NormalForceOfAReaction)
{
  const double mu = 0.3, R = 1, w = 2;
  const Scene  scene(
    model(rigid_body("a",
                     "set Mass = 1\n set Inertia = 1e-9, 1e-9, 1e-9\n set Position = 1, 0, 0\n" +
                       moving("0, 2, 0", "0, 0, 2")),
          joint("hinge",
                "revolute",
                "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n set Axis = 0, 0, 1\n" +
                  motion("rotation", " set Friction = 0.3\n set Friction radius = 1\n set Sticking speed = 1e-6\n"))));
  const double end = 2, exact = w / (1 + mu / std::sqrt(1 - mu * mu) * w * end / R);
  for (const unsigned int s : {1, 2, 3})
    {
      const double first  = s < 3 ? 0.1 : 0.4; // longer ones have no solution, and would be halved
      double       before = 0, order = 0;
      for (const double h : {first, first / 2, first / 4})
        {
          const auto   m     = contact_motion(scene.system, Tableau(s, 1.), h, end);
          const double error = std::abs(m.state.rates[0] - exact);
          EXPECT_LT(m.drift, 1e-12);
          EXPECT_EQ(m.least_loss, 0);
          order  = before > 0 ? std::log2(before / error) : 0;
          before = error;
        }
      EXPECT_GT(order, s < 3 ? 1.9 : 2.9) << s; // of rates at the ends of steps
      EXPECT_LT(before, s < 3 ? 1e-3 : 1e-6) << s;
    }
}



// Stick-slip of a mass on a belt.
TEST(DryFriction, StickSlip)
{
  expect_period_of_stick_slip(" set Sticking speed = 1e-4\n", [](const auto &m) { EXPECT_EQ(m.least_loss, 0); });
}



// A ball that is thrown along the floor slips until 2 v₀/(7 μ g), then rolls with 5/7 v₀; the loss is 1/7 m v₀². Also
// across the axes of the floor, and where the floor is tilted with gravity along its normal.
TEST(DryFriction, BallSlipsAndRolls)
{
  const double mu = 0.3, v = 2, R = 0.1, k = 1e6, depth = std::pow(g_n / k, 1 / 1.5);
  for (const bool is_tilted : {false, true})
    {
      const Matrix3 Q    = is_tilted ? rotation_of_angles({0.4, -0.7, 0.3}, "321") : Matrix3::Identity();
      const auto    list = [](const Vector3 &a) {
        return number_of(a(0)) + ", " + number_of(a(1)) + ", " + number_of(a(2));
      };
      const Scene scene(model(
        ball("a", R, Q * Vector3(0, 0, R - depth), Q * Vector3(1.2, 1.6, 0), {0, 0, 0}),
        joint("floor",
              "ball on plane",
              "set Body A = ground\n set Body B = a.centre\n set Radius = 0.1\n set Position = 0, 0, 0\n set Axis = " +
                list(Q.col(2)) +
                "\n set Stiffness = 1e6\n set Exponent = 1.5\n set Friction = 0.3\n"
                " set Sticking speed = 1e-4\n"),
        "subsection weight\n set Type = gravity\n set Acceleration = " + list(-g_n * Q.col(2)) + "\n end\n"));
      for (const unsigned int s : {2, 3})
        {
          const double t_roll       = 2 * v / (7 * mu * g_n);
          double       slip_at_half = 0;
          const auto   m            = contact_motion(
            scene.system, Tableau(s, 0.5), t_roll / 40, 2 * t_roll, [&](const State &state, const StepResult &) {
              if (std::abs(state.time - t_roll / 2) < 1e-9)
                slip_at_half = std::hypot(state.rates[1], state.rates[2]);
            });
          const Vector3 velocity = Q.transpose() * m.state.triad(1) * Eigen::Map<const Vector3>(&m.state.y[6]);
          EXPECT_NEAR(velocity(0), 5. / 7 * 1.2, 2e-4);
          EXPECT_NEAR(velocity(1), 5. / 7 * 1.6, 2e-4);
          EXPECT_NEAR(velocity(2), 0, 1e-5);
          EXPECT_NEAR(slip_at_half,
                      v - 3.5 * mu * g_n * t_roll / 2,
                      3e-4); // rates at the ends of steps, of lower order
          EXPECT_NEAR(m.friction_loss, v * v / 7, 1e-3);
          EXPECT_LT(m.drift, 1e-11);
          EXPECT_EQ(m.least_loss, 0);
        }
    }
}



// Two discs of a clutch, as shipped: torque μ N R until they have one speed, J₁ J₂ (w₁ − w₂)/((J₁ + J₂) μ N R) after
// the start; then both turn with J₁ w₁/(J₁ + J₂), and what they had against each other is lost.
TEST(DryFriction, Clutch)
{
  const double J_1 = 0.2, J_2 = 0.1, w = 100, r_i = 0.06, r_o = 0.1, N = 500, mu = 0.3,
               R = 2. / 3 * (std::pow(r_o, 3) - std::pow(r_i, 3)) / (r_o * r_o - r_i * r_i),
               J = J_1 * J_2 / (J_1 + J_2), locked = J * w / (mu * N * R);
  const Scene scene("prm/examples/clutch.prm");
  for (const unsigned int s : {2, 3})
    {
      double     before = -w, t_before = 0, t_locked = 0;
      const auto m =
        contact_motion(scene.system, Tableau(s, 0.5), 5e-3, 0.7, [&](const State &state, const StepResult &) {
          // the straight line of the last step that slips
          const double rate = state.rates[0];
          if (rate < -0.1)
            t_locked = state.time - rate * (state.time - t_before) / (rate - before);
          before   = rate;
          t_before = state.time;
        });
      EXPECT_NEAR(t_locked, locked, 1e-4 * locked) << s;
      EXPECT_NEAR(m.state.y[6 + 5], J_1 * w / (J_1 + J_2), 1e-6 * w) << s;
      EXPECT_NEAR(m.state.y[12 + 5], J_1 * w / (J_1 + J_2), 1e-6 * w) << s;
      EXPECT_NEAR(m.friction_loss, 0.5 * J * w * w, 1e-4 * J * w * w) << s;
      EXPECT_LT(m.drift, 1e-10) << s;
      EXPECT_EQ(m.least_loss, 0) << s;
    }
}



// How far it crept where it should stick is told: ε tan α/√(μ² − tan² α) times the time, here from the start on.
TEST(DryFriction, CreepIsReported)
{
  const double angle = 0.3, mu = 0.5, epsilon = 1e-4, end = 0.5,
               creep = epsilon * std::tan(angle) / std::sqrt(mu * mu - std::pow(std::tan(angle), 2));
  double      crept  = 0;
  const auto  sum    = [&](const State &, const StepResult &step) { crept += step.creep.at(0); };
  const Scene sticks(block_on_slope(angle, 0, friction_of(mu, epsilon)));
  const auto  m = contact_motion(sticks.system, Tableau(2, 0.5), 0.01, end, sum);
  EXPECT_NEAR(crept, creep * end, 1e-2 * creep * end);
  EXPECT_NEAR(crept, -m.state.coordinates[0], 1e-6 * crept);
  // what slips does not creep, but while it starts
  crept = 0;
  const Scene slips(block_on_slope(angle, 0, friction_of(0.2, epsilon)));
  const auto  slid = contact_motion(slips.system, Tableau(2, 0.5), 0.01, end, sum);
  EXPECT_LT(crept, 1e-3 * -slid.state.coordinates[0]);
}



// A puck on a plane is slowed along its own way, whatever the axes of the joint: v²/(2 μ g).
TEST(DryFriction, OnAPlane)
{
  const double mu = 0.2, v = 1;
  for (const std::string kind : {"planar", "in plane"})
    {
      const Scene scene(
        model(rigid_body("a", "set Mass = 2\n set Inertia = 1, 1, 1\n" + moving("0.6, 0.8, 0", "0, 0, 0")),
              joint("ice",
                    kind,
                    "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 0, 1\n set Axis 1 = 1, 0.3, 0\n" +
                      motion("displacement", friction_of(mu, 1e-5))),
              gravity));
      for (const unsigned int s : {2, 3})
        {
          const auto    m   = contact_motion(scene.system, Tableau(s, 0.5), 0.02, 0.6);
          const double  way = v * v / (2 * mu * g_n);
          const Vector3 x   = m.state.position(1);
          EXPECT_NEAR(x(0), 0.6 * way, 1e-3 * way) << kind;
          EXPECT_NEAR(x(1), 0.8 * way, 1e-3 * way) << kind;
          EXPECT_NEAR(m.friction_loss, v * v, 1e-4) << kind; // half of 2 kg
          EXPECT_LT(m.drift, 1e-11) << kind;
          EXPECT_EQ(m.least_loss, 0);
        }
    }
}



// A gyroscope of equal inertias that hangs in a ball joint at its centre is slowed about the axis that it turns about,
// by μ N R/J, and stands still; also between two bodies, and with bristles.
TEST(DryFriction, OfABall)
{
  const double mu = 0.2, R = 0.05, m_g = 2 * g_n, w = 3, J = 0.1, slowed = mu * m_g * R / J;
  for (const std::string law :
       {"set Sticking speed = 1e-5\n", "set Bristle stiffness = 1e6\n set Bristle damping = 100\n"})
    {
      const Scene scene(
        model(rigid_body("a", "set Mass = 2\n set Inertia = 0.1, 0.1, 0.1\n" + moving("0, 0, 0", "1, 2, 2")),
              joint("ball",
                    "spherical",
                    "set Body A = ground\n set Body B = a.centre\n" +
                      motion("rotation", " set Friction = 0.2\n set Friction radius = 0.05\n " + law)),
              gravity));
      for (const unsigned int s : {2, 3})
        {
          double     at_half = 0;
          const auto m =
            contact_motion(scene.system, Tableau(s, 0.5), 0.02, 2., [&](const State &state, const StepResult &) {
              if (std::abs(state.time - 1) < 1e-9)
                at_half =
                  (state.triad(1) * Eigen::Map<const Vector3>(&state.y[9]) - (w - slowed) * Vector3(1, 2, 2) / 3)
                    .norm();
            });
          EXPECT_LT(at_half, 2e-3 * w) << law << s;
          EXPECT_LT(Eigen::Map<const Vector3>(&m.state.y[9]).norm(), 1e-3 * w) << law << s;
          EXPECT_NEAR(m.friction_loss, 0.5 * J * w * w, 1e-3 * J * w * w) << law << s;
          EXPECT_LT(m.drift, 1e-10) << law << s;
        }
    }
}



// A body that sticks and slips on a rough block while it falls on it: two contacts of an upright pair of balls; and
// what is redundant is refused, not computed with a reaction that is arbitrary.
TEST(DryFriction, RedundantReactionsAreRefused)
{
  const std::string slide = "set Body A = ground\n set Body B = a.centre\n set Axis = 1, 0, 0\n",
                    rough = motion("displacement", " set Friction = 0.3\n");
  Scene           scene(model(rigid_body("a", "set Mass = 1\n set Inertia = 1, 1, 1\n" + moving("1, 0, 0", "0, 0, 0")),
                    joint("one", "prismatic", slide + rough) + joint("two", "prismatic", slide + rough),
                    gravity));
  StageIntegrator integrator(scene.system, Tableau(2, 1.));
  State           state = scene.context.state;
  EXPECT_FALSE(state.left_out.empty() && scene.system.dropped_multipliers().empty());
  EXPECT_THROW(integrator.step(state, 0.01), NotConverged);
}
