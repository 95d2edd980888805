// Friction with bristles (LuGre): losses of stages, derivatives, and closed forms of what sticks without creep.
//
// References: the law itself, term by term; v²/(2a) of a block on a slope; the period of stick-slip with Coulomb's law;
// the prototype of the design notes (contact.md, 4.5).

#include <samara/time/stage_bristles.h>

#include <gtest/gtest.h>

#include <random>

#include "rubbing.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** A random law, deflections, slips and normal forces of up to three slips, over many orders; some press nowhere. */
  struct RandomBristles
  {
    unsigned int    n;
    FrictionLaw     law;
    double          h;
    Eigen::VectorXd start, slips;
    double          normal[3];

    RandomBristles(std::mt19937 &random, const unsigned int s)
    {
      std::uniform_real_distribution<double> number(-1, 1);
      const auto scale      = [&](const double decades) { return std::pow(10., decades * number(random)); };
      n                     = 1 + random() % 3;
      law.kinetic           = 0.3 * scale(1);
      law.breakaway         = law.kinetic * (1.5 + 0.5 * number(random));
      law.stribeck_speed    = scale(2);
      law.bristle_stiffness = 1e4 * scale(2);
      law.bristle_damping   = number(random) < -0.5 ? 0. : 30 * scale(2);
      h                     = 1e-2 * scale(1.5);
      const double size = scale(3), force = scale(3);
      for (unsigned int k = 0; k < 3; ++k)
        normal[k] = number(random) < -0.6 ? 0. : force * std::abs(number(random));
      start.resize(n);
      slips.resize(n * s);
      for (double &z : start)
        z = force * law.kinetic / law.bristle_stiffness * number(random);
      for (double &w : slips)
        w = size * number(random);
    }

    BristleForces
    forces(const Tableau &t, const bool with_slopes) const
    {
      return bristle_forces(law, t, start, slips, normal, h, with_slopes);
    }
  };
} // namespace



// Equations of the stages; the power that is lost in each of them; and the sum of the three parts over a step.
TEST(Bristles, NeverGain)
{
  std::mt19937 random(4);
  for (unsigned int s = 1; s <= 3; ++s)
    for (const double rho : {1., 0.5, 0.})
      {
        const Tableau t(s, rho);
        unsigned int  n_free = 0;
        for (unsigned int trial = 0; trial < 500; ++trial)
          {
            const RandomBristles b(random, s);
            const BristleForces  f    = b.forces(t, false);
            double               work = 0, size = 1e-300, stored = 0;
            bool                 is_free = true;
            for (unsigned int k = 0; k < s; ++k)
              is_free = is_free && b.normal[k] == 0;
            n_free += is_free;
            for (unsigned int k = 0; k < s; ++k)
              {
                double square = 0, lost = 0, parts = 0;
                for (unsigned int i = 0; i < b.n; ++i)
                  square += std::pow(b.slips(s * i + k), 2);
                const double G = b.normal[k] * b.law.coefficient(square).c, speed = std::sqrt(square);
                for (unsigned int i = 0; i < b.n; ++i)
                  {
                    const unsigned int j = s * i + k;
                    double             z = b.start(i);
                    for (unsigned int l = 0; l < s; ++l)
                      z += b.h * t.a_alpha(k, l) * f.rate(s * i + l);
                    const double size_of_z = std::abs(b.start(i)) + b.h * speed;
                    EXPECT_NEAR(f.deflection(j), z, 1e-12 * size_of_z);
                    if (G > 0)
                      {
                        EXPECT_NEAR(G * (f.rate(j) - b.slips(j)) + b.law.bristle_stiffness * speed * z,
                                    0,
                                    1e-10 *
                                      (G * speed + b.law.bristle_stiffness * speed * size_of_z + G / b.h * size_of_z));
                      }
                    else if (!is_free)
                      {
                        EXPECT_EQ(f.force(j), 0);
                      }
                    lost += f.force(j) * b.slips(j) - b.law.bristle_stiffness * f.deflection(j) * f.rate(j);
                    parts += std::abs(f.force(j) * b.slips(j)) +
                             b.law.bristle_stiffness * std::abs(f.deflection(j) * f.rate(j));
                    work += b.h * t.b(k) * f.force(j) * b.slips(j);
                  }
                size += b.h * parts;
                if (!is_free)
                  {
                    EXPECT_GE(lost, -1e-10 * parts);
                  }
              }
            for (unsigned int i = 0; i < b.n; ++i)
              {
                double end = b.start(i);
                for (unsigned int k = 0; k < s; ++k)
                  end += b.h * t.b(k) * f.rate(s * i + k);
                stored += 0.5 * b.law.bristle_stiffness * (end * end - b.start(i) * b.start(i));
                size += b.law.bristle_stiffness * (end * end + b.start(i) * b.start(i));
                if (is_free)
                  {
                    EXPECT_NEAR(end, 0, 1e-12 * std::abs(b.start(i)));
                  }
              }
            EXPECT_NEAR(f.elastic, stored, 1e-12 * size);
            EXPECT_NEAR(work, f.elastic + f.loss + f.dissipated, 1e-11 * size);
            EXPECT_GE(f.loss, -1e-11 * size);
            EXPECT_GE(f.dissipated, 0);
          }
        EXPECT_GT(n_free, 0u);
      }
}



TEST(Bristles, SlopesAreDerivatives)
{
  std::mt19937 random(5);
  for (unsigned int s = 1; s <= 3; ++s)
    {
      const Tableau t(s, 0.5);
      for (unsigned int trial = 0; trial < 200; ++trial)
        {
          const RandomBristles b(random, s);
          const BristleForces  f      = b.forces(t, true);
          const double         size_w = b.slips.lpNorm<Eigen::Infinity>();
          for (unsigned int l = 0; l < s * b.n; ++l)
            {
              RandomBristles forth = b, back = b;
              const double   step = 1e-6 * std::max(std::abs(b.slips(l)), 1e-3 * size_w);
              forth.slips(l) += step;
              back.slips(l) -= step;
              const Eigen::VectorXd d = (forth.forces(t, false).force - back.forces(t, false).force) / (2 * step);
              EXPECT_LE((d - f.by_slip.col(l)).norm(), 1e-4 * (f.by_slip.norm() + f.force.norm() / step * 1e-8))
                << trial;
            }
          for (unsigned int l = 0; l < s; ++l)
            if (b.normal[l] > 0)
              {
                RandomBristles forth = b, back = b;
                const double   step = 1e-6 * b.normal[l];
                forth.normal[l] += step;
                back.normal[l] -= step;
                const Eigen::VectorXd d = (forth.forces(t, false).force - back.forces(t, false).force) / (2 * step);
                EXPECT_LE((d - f.by_normal.col(l)).norm(), 1e-5 * (f.by_normal.norm() + f.force.norm() / b.normal[l]))
                  << trial;
              }
        }
    }
}



// Up the slope with v: it stops after v²/(2 g (sin α + μ cos α)), to the deflection of the bristles, and stays: what
// pulls is in the bristles. With a sticking speed it creeps for ever.
TEST(Bristles, BlockOnASlopeStays)
{
  const double angle = 0.3, mu = 0.5, v = 2, g = g_n;
  const double way  = v * v / (2 * g * (std::sin(angle) + mu * std::cos(angle)));
  const double pull = g * std::sin(angle);
  for (const auto &[stiffness, damping] : {std::make_pair(1e4, 50.), std::make_pair(1e6, 1000.)})
    {
      const Scene scene(block_on_slope(angle,
                                       v,
                                       " set Friction = 0.5\n set Bristle stiffness = " + number_of(stiffness) +
                                         "\n set Bristle damping = " + number_of(damping) + "\n"));
      for (const auto &[s, rho] : {std::make_pair(1, 1. / 3),
                                   std::make_pair(2, 0.5),
                                   std::make_pair(3, 0.5),
                                   std::make_pair(2, 1.),
                                   std::make_pair(3, 1.)})
        for (const double h : {0.01, 0.0025})
          {
            SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + number_of(rho) + ", h = " + number_of(h) +
                         ", stiffness = " + number_of(stiffness));
            const auto m = contact_motion(scene.system, Tableau(s, rho), h, 1.5);
            EXPECT_LT(m.drift, 1e-12);
            EXPECT_LT(m.up, 1e-12);
            EXPECT_GE(m.least_loss, -1e-15);
            EXPECT_EQ(m.creep, 0);
            EXPECT_NEAR(m.state.coordinates[0] / way, 1, s == 1 ? 0.03 : stiffness > 1e5 ? 2e-3 : 1e-2);
            if (rho < 1)
              {
                EXPECT_NEAR(m.state.rates[0], 0, 1e-6);
                EXPECT_NEAR(stiffness * m.state.states[0], -pull, 1e-4 * pull);
                EXPECT_NEAR(m.friction_loss + m.dissipated,
                            0.5 * v * v - pull * m.state.coordinates[0] - 0.5 * pull * pull / stiffness,
                            1e-6);
              }
          }
    }
}



// The same force as Coulomb's where it slips: the closed form of the bearing that slows a mass, N a reaction.
TEST(Bristles, NormalForceOfAReaction)
{
  const double mu = 0.3, w = 2, end = 2, exact = w / (1 + mu / std::sqrt(1 - mu * mu) * w * end);
  const Scene  scene(
    model(rigid_body("a",
                     "set Mass = 1\n set Inertia = 1e-9, 1e-9, 1e-9\n set Position = 1, 0, 0\n" +
                       moving("0, 2, 0", "0, 0, 2")),
          joint("hinge",
                "revolute",
                "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n set Axis = 0, 0, 1\n" +
                  motion("rotation",
                         " set Friction = 0.3\n set Friction radius = 1\n set Bristle stiffness = 1e5\n"
                          " set Bristle damping = 100\n"))));
  for (const unsigned int s : {2, 3})
    {
      const auto m = contact_motion(scene.system, Tableau(s, 0.5), 0.02, end);
      EXPECT_LT(m.drift, 1e-12);
      EXPECT_GE(m.least_loss, -1e-15);
      EXPECT_NEAR(m.state.rates[0] / exact, 1, 1e-3) << s; // bristles need w t σ₀/G ≫ 1 to bend
    }
}



// Stick-slip on a belt has the period of Coulomb's law, with few iterations.
TEST(Bristles, StickSlip)
{
  expect_period_of_stick_slip(" set Bristle stiffness = 1e5\n set Bristle damping = 150\n", [](const auto &m) {
    EXPECT_GE(m.least_loss, -1e-13);
    EXPECT_LT(m.n_iterations, 8 * m.n_steps);
  });
}



// A spinning ball falls on a rough floor and bounces: bristles straighten in the air, so that nothing comes back from
// one impact to the next; then it rolls, and sticks. All of it from a stop that opens and closes.
TEST(Bristles, BallBouncesAndRolls)
{
  const double R = 0.1;
  const Scene  scene(
    model(ball("a", R, {0, 0, R + 0.05}, {1, 0.5, 0}, {0, -20, 3}),
          joint("floor",
                "ball on plane",
                "set Body A = ground\n set Body B = a.centre\n set Radius = 0.1\n set Position = 0, 0, 0\n"
                 " set Axis = 0, 0, 1\n set Stiffness = 1e6\n set Exponent = 1.5\n set Restitution = 0.5\n"
                 " set Impact speed = 1\n set Friction = 0.3\n set Bristle stiffness = 1e5\n"
                 " set Bristle damping = 100\n"),
          gravity));
  for (const unsigned int s : {2, 3})
    {
      double     largest_in_air = 0;
      bool       was_open       = false;
      const auto m =
        contact_motion(scene.system, Tableau(s, 0.5), 1e-3, 1.5, [&](const State &state, const StepResult &step) {
          if (step.touched_stops.empty() && was_open)
            largest_in_air = std::max(largest_in_air, std::hypot(state.states[0], state.states[1]));
          was_open = step.touched_stops.empty();
        });
      const Vector3 velocity = m.state.triad(1) * Eigen::Map<const Vector3>(&m.state.y[6]);
      const Vector3 spin     = m.state.triad(1) * Eigen::Map<const Vector3>(&m.state.y[9]);
      EXPECT_LT(m.drift, 1e-11) << s;
      EXPECT_GE(m.least_loss, -1e-13);
      EXPECT_LT(largest_in_air, 1e-18);
      // of the angular momentum about the line of the floor that it touches nothing is lost
      const double x = (1 + 0.4 * R * 20. * -1) / 1.4;
      EXPECT_NEAR(velocity(0), x, 2e-3) << s;
      EXPECT_NEAR(velocity(1), 0.5 / 1.4, 2e-3) << s;
      EXPECT_NEAR(spin(1) * R, velocity(0), 1e-4);
      EXPECT_NEAR(spin(0) * R, -velocity(1), 1e-4);
    }
}



// A state holds all that a run needs: one that is taken up half way goes on as if nothing had been.
TEST(Bristles, GoOnFromAState)
{
  const Scene scene(
    block_on_slope(0.3, 2, " set Friction = 0.5\n set Bristle stiffness = 1e4\n set Bristle damping = 50\n"));
  StageIntegrator one(scene.system, Tableau(3, 0.5), 1e-13);
  State           state = start_of({"", "", 0, 0}, scene.system), copy;
  for (unsigned int i = 0; i < 50; ++i)
    {
      if (i == 30)
        copy = state;
      ASSERT_TRUE(one.step(state, 0.01).converged);
    }
  StageIntegrator other(scene.system, Tableau(3, 0.5), 1e-13);
  for (unsigned int i = 30; i < 50; ++i)
    ASSERT_TRUE(other.step(copy, 0.01).converged);
  EXPECT_GT(std::abs(state.states[0]), 1e-4);
  EXPECT_NEAR(copy.states[0], state.states[0], 1e-12);
  EXPECT_NEAR(copy.coordinates[0], state.coordinates[0], 1e-12);
}
