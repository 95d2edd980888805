// The energy decaying rival: its orders, its energy statement, and what it does to a rotor.

#include <samara/time/rival_energy_decaying.h>

#include "../dynamics/motion.h"

#include "rival_trial.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** Hinged to the ground at the origin, turning at 20 rad/s about z; stretching at some ten radians a step of 5°. */
  MovingSystem
  blade()
  {
    return {"blade",
            "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 1e8\n set GA2 = 1e8\n"
            " set GA3 = 1e8\n set GJ = 1e4\n set EI2 = 1e4\n set EI3 = 1e4\n set Mass = 1\n set I2 = 1e-3\n"
            " set I3 = 1e-3\n end\nend\n"
            "subsection Bodies\n subsection rod\n set Type = beam\n set Elements = 4\n set Degree = 2\n"
            " set Section = s\n set Points = 0.2, 0, 0; 3, 0, 0\n set Axis 2 = 0, 1, 0\n" +
              moving("0, 4, 0", "0, 0, 20") + "end\nend\nsubsection Joints\n" +
              joint("hinge",
                    "revolute",
                    "set Body A = ground\n set Body B = rod.start\n set Position = 0, 0, 0\n set Axis = 0, 0, 1\n") +
              "end\n",
            0,
            0};
  }
} // namespace



// Order 3, or 4 without dissipation, for linear systems; 2 for a body in flight and for a free beam.
TEST(EnergyDecaying, OrderWithoutConstraints)
{
  const Trial linear(oscillator());
  for (const double rho : {0., 1.})
    {
      const Errors one = linear.errors("energy decaying", settings(rho), 16),
                   two = linear.errors("energy decaying", settings(rho), 32);
      EXPECT_NEAR(order(one.y, two.y), rho == 0 ? 3 : 4, 0.15) << one.y << ", " << two.y;
    }
  for (const std::string name : {"offset body in flight", "flying beam, EA = 30"})
    {
      const Trial trial(system_named(name));
      for (const double rho : {0., 0.5, 1.})
        {
          const Errors one = trial.errors("energy decaying", settings(rho), 32),
                       two = trial.errors("energy decaying", settings(rho), 64);
          EXPECT_NEAR(order(one.q, two.q), 2, 0.1) << name;
          EXPECT_NEAR(order(one.y, two.y), 2, 0.15) << name;
        }
    }
}



// A constraint turns the chord, not the velocity at the end: that has a part across the constraint of half the turn of
// a step. It is dissipated in the next step if ρ∞ = 0 (first order), and added up if ρ∞ = 1: no convergence.
TEST(EnergyDecaying, OrderWithConstraints)
{
  for (const std::string name : {"double pendulum", "crank and slider with a massless rod"})
    {
      SCOPED_TRACE(name);
      const Trial  trial(system_named(name));
      const Errors one = trial.errors("energy decaying", settings(0), 64),
                   two = trial.errors("energy decaying", settings(0), 128);
      EXPECT_NEAR(order(one.q, two.q), 1, 0.1);
      EXPECT_NEAR(order(one.y, two.y), 1, 0.1);
      const Errors three = trial.errors("energy decaying", settings(1), 64),
                   four  = trial.errors("energy decaying", settings(1), 128);
      EXPECT_NEAR(order(three.y, four.y), 0, 0.05);
      EXPECT_GT(four.y, 0.1);
    }
}



// |Y_f|² = |Y_i|² − α |Y_j − Y_i|² step by step, also with quadratic constraints and whatever the stiffness.
TEST(EnergyDecaying, EnergyStatement)
{
  const std::vector<MovingSystem> systems = {system_named("offset body in flight"),
                                             flying_beam("1e8", "100", 0.005, 0),
                                             blade()};
  for (const MovingSystem &what : systems)
    for (const double rho : {0., 0.5, 1.})
      {
        SCOPED_TRACE(what.name + ", rho = " + std::to_string(rho));
        const Scene    scene(what.text);
        const State    start = start_of(what, scene.system);
        State          state = start;
        EnergyDecaying rival(scene.system, settings(rho));
        for (unsigned int i = 0; i < 20; ++i)
          {
            const StepResult r = rival.step(state, what.h > 0 ? what.h : 1e-3);
            ASSERT_TRUE(r.converged);
            EXPECT_NEAR(r.dissipated, rival.jump_energy, 1e-9 * energy_of(scene.system, start));
            EXPECT_EQ(rival.jump_energy > 0, rho < 1);
          }
      }
}



// Steady rotation is no equilibrium in inertial velocities: E/E₀ = 1/(1 + N z²) after N steps of z = 5° for a stiff
// blade of points and ρ∞ = 0, from the jump z V across the blade; more than half for ρ∞ = ½. The family loses what the
// stretching takes that the start has in it, below 1e-4, and nothing for ρ∞ = 1.
TEST(EnergyDecaying, LosesASpinningBlade)
{
  const MovingSystem what = blade();
  const Scene        scene(what.text);
  const System      &system = scene.system;
  const State        start  = start_of(what, system);
  const double       z = M_PI / 36, h = z / 20, energy = energy_of(system, start);
  const auto         left = [&](const double rho) {
    const auto   rival = make_rival("energy decaying", system, settings(rho));
    const Record r     = run(system, start, *rival, h, 72);
    EXPECT_EQ(r.n_steps, 72u);
    EXPECT_GE(r.least_dissipated, -1e-9 * energy);
    return energy_of(system, r.state) / energy;
  };
  EXPECT_NEAR(left(0), 1 / (1 + 72 * z * z), 0.02);
  EXPECT_LT(left(0.5), 0.5);
  for (const double rho : {0., 0.5, 1.})
    {
      const Record r = run(system, start, Tableau(2, rho), h, 72);
      EXPECT_EQ(r.n_steps, 72u);
      EXPECT_NEAR(energy_of(system, r.state) / energy, 1, rho < 1 ? 1e-4 : 1e-11);
    }
}
