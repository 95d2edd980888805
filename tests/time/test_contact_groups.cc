// Groups of contacts: pairs that are searched for, in steps.
//
// References: energies, with the potential of a search of its own; momenta of free bodies; Hertz' time of contact
// (Landau & Lifshitz, Theory of Elasticity, § 9); restitution of one body; a row of equal balls.

#include <samara/model/contact_group.h>
#include <samara/solvers/diagonal_order.h>
#include <samara/time/step_tangent.h>
#include <samara/time/wider_pattern.h>

#include <gtest/gtest.h>

#include "contact_motion.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  std::string
  group(const std::string &entries)
  {
    return joint("touching", "contacts", entries);
  }

  const ContactGroup &
  group_of(const System &system)
  {
    return *system.layout.contact_groups.at(0);
  }

  /** Numbers of the pairs that are near in a step from the start. */
  std::vector<ContactGroup::Pair>
  near_pairs(const System &system, const double h)
  {
    const State                     state = start_of({"", "", 0, 0}, system);
    std::vector<ContactGroup::Pair> pairs;
    ContactGroup::Margins           margins;
    group_of(system).find_pairs(state.q.data(), state.y.data(), h, pairs, margins);
    return pairs;
  }
} // namespace



// 2.9432 (5 m/(4 k))^(2/5) v^(−1/5), m the reduced mass; then both have exchanged their velocities.
TEST(ContactGroups, HertzTime)
{
  const double k = 1e6, v = 0.7, T = 2.943275 * std::pow(5 * 0.5 / (4 * k), 0.4) * std::pow(v, -0.2);
  const Scene  scene(model(
    ball("a", 0.1, {0, 0, 0}, {v, 0, 0}, {0, 0, 0}) + ball("b", 0.1, {0.2, 0, 0}, {0, 0, 0}, {0, 0, 0}),
    group("set Balls = a, b\n set Ball radius = 0.1\n set Stiffness = " + number_of(k) + "\n set Exponent = 1.5\n")));
  double       last = 0, end = 0, before = 0;
  const auto   look = [&](const State &state, const StepResult &) {
    const double gap = 0.2 - (state.position(2) - state.position(1)).norm();
    if (before > 0 && gap <= 0)
      end = last + (state.time - last) * before / (before - gap);
    before = gap;
    last   = state.time;
  };
  const auto run = contact_motion(scene.system, Tableau(3, 1.), T / 50, 1.1 * T, look);
  EXPECT_NEAR(end, T, 1e-5 * T);
  EXPECT_LT(run.drift, 1e-12);
  EXPECT_NEAR(run.state.y[6], 0, 1e-6 * v);
  EXPECT_NEAR(run.state.y[12], v, 1e-6 * v);
}



// Oblique, spinning, with damping, and with friction: energy, both momenta; nothing but the two balls takes up a
// moment. Momenta are exact where triads of stages are orthonormal: the error is that of a high power of the angle a
// step turns.
TEST(ContactGroups, MomentaOfFreeBalls)
{
  const std::array<double, 3> allowed = {{1e-4, 1e-8, 1e-9}};
  for (const bool rubs : {false, true})
    for (unsigned int s = 1; s <= 3; ++s)
      {
        const Scene   scene(model(
          ball("a", 0.1, {0, 0, 0}, {1, 0.2, -0.3}, {3, -5, 4}) +
            ball("b", 0.15, {0.27, 0.03, 0.02}, {-0.4, 0, 0.1}, {-2, 1, 7}),
          group("set Balls = a, b radius 0.15\n set Ball radius = 0.1\n set Stiffness = 1e5\n set Exponent = 1.5\n"
                  " set Restitution = 0.7\n set Impact speed = 1\n" +
                std::string(rubs ? " set Friction = 0.3\n set Sticking speed = 1e-2\n" : ""))));
        const Vector6 start = momentum_of(scene.system, start_of({"", "", 0, 0}, scene.system));
        const auto    run   = contact_motion(scene.system, Tableau(s, 1.), 1e-3, 0.1);
        EXPECT_LT(run.drift, 1e-11) << s;
        EXPECT_EQ(run.friction_loss > 1e-3, rubs);
        EXPECT_GT(run.viscous_loss, 1e-3);
        const Vector6 change = momentum_of(scene.system, run.state) - start;
        EXPECT_LT(change.head<3>().norm(), allowed[s - 1] * start.head<3>().norm()) << s;
        EXPECT_LT(change.tail<3>().norm(), allowed[s - 1] * start.tail<3>().norm()) << s;
        EXPECT_LT(run.state.y[6], 0.9);
      }
}



// One body leaves a wall with the restitution of the input, whatever the surface that it meets.
TEST(ContactGroups, Restitution)
{
  for (const std::string surface : {"Planes = ground at 0 0 -0.1 normal 0 0 1",
                                    "Cylinders = ground at 0 0 -0.6 axis 0 1 0 radius 0.5",
                                    "Tubes = ground at 0 0 0.4 axis 0 1 0 radius 0.5",
                                    "Hollow balls = ground at 0 0 0.4 radius 0.5"})
    {
      const Scene scene(model(ball("a", 0.1, {0, 0, 0}, {0, 0, -1}, {0, 0, 0}),
                              group("set Balls = a\n set Ball radius = 0.1\n set " + surface +
                                    "\n set Stiffness = 1e5\n set Restitution = 0.6\n set Impact speed = 1\n")));
      const auto  run = contact_motion(scene.system, Tableau(3, 1.), 5e-4, 0.05);
      EXPECT_NEAR(run.state.y[8], 0.6, 1e-3) << surface;
      EXPECT_LT(run.drift, 1e-11) << surface;
    }
}



// Five balls that touch or do not: the last one takes all when they are apart.
TEST(ContactGroups, RowOfBalls)
{
  std::string balls;
  for (unsigned int i = 0; i < 5; ++i)
    balls += ball("b" + std::to_string(i), 0.1, {0.21 * i, 0, 0}, {i == 0 ? 1. : 0., 0, 0}, {0, 0, 0});
  const Scene scene(
    model(balls, group("set Balls = b*\n set Ball radius = 0.1\n set Stiffness = 1e6\n set Exponent = 1.5\n")));
  const auto run = contact_motion(scene.system, Tableau(3, 1.), 2e-4, 0.1);
  for (unsigned int i = 0; i < 5; ++i)
    EXPECT_NEAR(run.state.y[6 * (i + 1)], i == 4 ? 1. : 0., 1e-5) << i;
  EXPECT_LT(run.drift, 1e-11);
}



// Margins belong to bodies: the pairs of a lattice grow with its size, and a bullet adds its own alone.
TEST(ContactGroups, NearPairsAreFew)
{
  const auto lattice = [](const unsigned int n, const double speed) {
    std::string balls;
    for (unsigned int i = 0; i < n; ++i)
      balls += ball(
        "b" + std::to_string(i), 0.1, {0.205 * (i % 5), 0.205 * (i / 5 % 5), 0.205 * (i / 25)}, {0, 0, 0}, {0, 0, 0});
    balls += ball("bullet", 0.1, {-0.3, 0, 0}, {speed, 0, 0}, {0, 0, 0});
    return model(balls, group("set Balls = b*\n set Ball radius = 0.1\n set Stiffness = 1e6\n"));
  };
  const auto n_near = [&](const unsigned int n, const double speed) {
    const Scene scene(lattice(n, speed));
    return near_pairs(scene.system, 0.01).size();
  };
  // of a lattice 5 × 5 × m the neighbours along the axes: 20 + 20 a layer, 25 between two layers
  EXPECT_EQ(n_near(50, 0), 2 * 40 + 25u);
  EXPECT_EQ(n_near(100, 0), 4 * 40 + 3 * 25u);
  EXPECT_EQ(n_near(400, 0), 16 * 40 + 15 * 25u); // a thousand
  const std::size_t with_bullet = n_near(100, 60) - n_near(100, 0);
  EXPECT_GT(with_bullet, 20u);
  EXPECT_LE(with_bullet, 100u);
}



namespace
{
  /** Multiplications of the factors of a step in which all pairs that are near touch. */
  double
  operations_of_factors(const std::string &text)
  {
    const Scene                                        scene(text);
    const Layout                                      &layout = scene.system.layout;
    std::vector<std::pair<unsigned int, unsigned int>> couplings;
    std::vector<unsigned int>                          nodes;
    for (const auto &pair : near_pairs(scene.system, 0.01))
      {
        group_of(scene.system).nodes_of(pair, nodes);
        for (const auto a : nodes)
          for (const auto b : nodes)
            if (a != 0 && b != 0 && a != b)
              couplings.emplace_back(a, b);
      }
    std::sort(couplings.begin(), couplings.end());
    couplings.erase(std::unique(couplings.begin(), couplings.end()), couplings.end());
    std::vector<int>  from;
    const auto        pattern = wider_pattern(*layout.pattern, couplings, from);
    std::vector<bool> is_late(scene.system.size(), false);
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      is_late[layout.of_multiplier(i)] = true;
    return DiagonalOrder(*pattern, is_late).n_operations;
  }

  /** Balls that touch, close to each other in layers of @p width × @p width. */
  std::string
  tower_of_balls(const unsigned int width, const unsigned int n_layers)
  {
    std::string balls;
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      for (unsigned int j = 0; j < width; ++j)
        for (unsigned int i = 0; i < width; ++i)
          balls += ball("b" + std::to_string((layer * width + j) * width + i),
                        0.1,
                        {0.2 * (i + 0.5 * ((j + layer) % 2)),
                         0.2 * std::sqrt(0.75) * (j + layer % 2 / 3.),
                         0.2 * std::sqrt(2. / 3) * layer},
                        {0, 0, 0},
                        {0, 0, 0});
    return model(balls,
                 group("set Balls = b*\n set Ball radius = 0.1\n set Stiffness = 1e6\n set Overlap = allowed\n"));
  }

  /** Links with ball joints that lie on a drum. */
  std::string
  chain_around_drum(const unsigned int n)
  {
    std::string bodies = rigid_body("drum", "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 0, 0, -10.1\n"),
                joints;
    for (unsigned int i = 0; i < n; ++i)
      {
        const std::string name = "b" + std::to_string(i);
        const double      at   = 0.25 / 10.1 * i;
        bodies += ball(name, 0.1, {10.1 * std::sin(at), 0, 10.1 * (std::cos(at) - 1)}, {0, 0, 0}, {0, 0, 0});
        if (i > 0)
          joints += joint("j" + std::to_string(i),
                          "spherical",
                          "set Body A = b" + std::to_string(i - 1) + ".centre\n set Body B = " + name + ".centre\n");
      }
    return model(bodies,
                 joints + group("set Balls = b*\n set Ball radius = 0.1\n set Stiffness = 1e6\n"
                                " set Cylinders = drum at 0 0 -10.1 axis 0 1 0 radius 10\n"));
  }
} // namespace



// The factors of what is long cost in proportion to its length: of chains in the air, on a drum that is one body, and,
// once it is longer than wide, of a pile. A heap in space is not long: its factors grow as n^1.5 to n^2.5. (Of fewer
// than 45 balls, a thousand pairs, all are in the pattern, for statics.)
TEST(ContactGroups, WorkOfFactors)
{
  EXPECT_NEAR(operations_of_factors(tower_of_balls(1, 120)) / operations_of_factors(tower_of_balls(1, 60)), 2, 0.1);
  EXPECT_NEAR(operations_of_factors(chain_around_drum(120)) / operations_of_factors(chain_around_drum(60)), 2, 0.1);
  const double n_8 = operations_of_factors(tower_of_balls(3, 8)), n_16 = operations_of_factors(tower_of_balls(3, 16)),
               n_32 = operations_of_factors(tower_of_balls(3, 32));
  EXPECT_NEAR((n_32 - n_16) / (n_16 - n_8), 2, 0.3);
  const double exponent =
    std::log(operations_of_factors(tower_of_balls(6, 6)) / operations_of_factors(tower_of_balls(4, 4))) /
    std::log(216. / 64);
  EXPECT_GT(exponent, 1.5);
  EXPECT_LT(exponent, 2.5);
}



// A surface that moves meets a ball at rest in a step as long as its way to it: as seen by who moves with it.
TEST(ContactGroups, MovingSurfaceMeetsWhatRests)
{
  for (const std::string surface :
       {"Planes = wall at -2 0 0 normal 1 0 0", "Cylinders = wall at -3 0 0 axis 0 0 1 radius 1"})
    {
      const std::string bodies = rigid_body("wall",
                                            "set Mass = 1e6\n set Inertia = 1e6, 1e6, 1e6\n set Position = -3, 0, 0\n" +
                                              moving("100, 0, 0", "0, 0, 0")) +
                                 ball("a", 0.1, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
      const Scene scene(
        model(bodies, group("set Balls = a\n set Ball radius = 0.1\n set Stiffness = 1e7\n set " + surface + "\n")));
      const auto run = contact_motion(scene.system, Tableau(2, 1.), 0.02, 0.04);
      EXPECT_NEAR(run.state.y[12], 200, 0.01) << surface;
      EXPECT_LT(run.drift, 1e-9) << surface;
    }
}



// A bullet that would be behind a ball after a step has no step: it is halved until the two meet.
TEST(ContactGroups, NothingPassesUnseen)
{
  const Scene scene(
    model(ball("a", 0.1, {0, 0, 0}, {50, 0, 0}, {0, 0, 0}) + ball("b", 0.1, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}),
          group("set Balls = a, b\n set Ball radius = 0.1\n set Stiffness = 1e6\n set Exponent = 1.5\n")));
  const auto run = contact_motion(scene.system, Tableau(2, 1.), 0.05, 0.1);
  EXPECT_NEAR(run.state.y[6], 0, 1.);
  EXPECT_NEAR(run.state.y[12], 50, 1.);
  EXPECT_LT(run.drift, 1e-10);
  EXPECT_GT(run.n_failed, 0u);
}



// A tumbling cylinder strikes a ball: its potential is not quadratic, and what its forces along the gradient would miss
// is made good.
TEST(ContactGroups, BalanceSeesThePotential)
{
  const std::string bodies =
    rigid_body("drum", "set Mass = 2\n set Inertia = 0.2, 0.3, 0.4\n" + moving("0, 0, 0", "6, 3, -4")) +
    ball("a", 0.1, {0.4, 0.1, 0.3}, {-1, 0, -0.4}, {0, 0, 0});
  const Scene   scene(model(bodies,
                          group("set Balls = a\n set Ball radius = 0.1\n set Stiffness = 1e4\n set Exponent = 1.5\n"
                                  " set Friction = 0.2\n set Sticking speed = 0.01\n"
                                  " set Cylinders = drum at 0 0 0 axis 0 0 1 radius 0.2\n")));
  const Vector6 start = momentum_of(scene.system, start_of({"", "", 0, 0}, scene.system));
  double        most  = 0;
  const auto    look  = [&](const State &state, const StepResult &) {
    most = std::max(most, group_of(scene.system).energy(state.q.data()));
  };
  const auto run = contact_motion(scene.system, Tableau(3, 1.), 2e-3, 0.3, look, 1e-10);
  EXPECT_GT(most, 0.01);
  EXPECT_LT(run.drift, 150 * 1e-10);
  EXPECT_LT((momentum_of(scene.system, run.state) - start).norm(), 1e-8 * start.norm());
}



// What touches has no tangent of its step for floquet and trim: they are told which pair it is.
TEST(ContactGroups, TangentOfAStepNamesThePair)
{
  const Scene scene(
    model(ball("a", 0.1, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}) + ball("b", 0.1, {0.201, 0, 0}, {0, 0, 0}, {0, 0, 0}),
          group("set Balls = a, b\n set Ball radius = 0.1\n set Stiffness = 1e5\n")));
  StageIntegrator integrator(scene.system, Tableau(2, 1.), 1e-12);
  State           state = start_of({"", "", 0, 0}, scene.system);
  for (const bool touches : {false, true})
    {
      const State start = state;
      ASSERT_TRUE(integrator.step(state, touches ? 1e-3 : 5e-4).converged);
      std::string said;
      try
        {
          integrator.linearize(start);
        }
      catch (const NotConverged &problem)
        {
          said = problem.what();
        }
      EXPECT_EQ(said.find("<a> and <b>") != std::string::npos, touches) << said;
    }
}
