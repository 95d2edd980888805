// Friction with bristles in groups of contacts, where a pair has its own as long as it touches.
//
// References: single contacts of the same bodies; v²/(2a) of a block on a slope; momenta; a table that turns.

#include <samara/analysis/dynamic.h>

#include "../momentum.h"
#include <gtest/gtest.h>

#include "contact_motion.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  constexpr double  g_of_bristles = 9.80665;
  const std::string bristles_of_group =
    " set Friction = 0.5\n set Bristle stiffness = 1e4\n set Bristle damping = 50\n";

  /** A ball of 0.1 m that cannot turn, on a slope that rises along x, with a speed up it; @p touch holds it up. */
  std::string
  ball_on_slope(const double angle, const double speed, const std::string &touch)
  {
    // pressed in by its weight
    const double  c = std::cos(angle), s = std::sin(angle), depth = g_of_bristles * c / 1e6;
    const Vector3 n(-s, 0, c);
    return model(ball("a", 0.1, (0.1 - depth) * n, {speed * c, 0, speed * s}, {0, 0, 0}),
                 joint("plane",
                       "planar",
                       "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 1, 0\n" +
                         motion("rotation", " set Prescribed = 0\n")) +
                   touch,
                 gravity);
  }

  std::string
  group_on_plane(const Vector3 &n, const std::string &law)
  {
    return joint(
      "touching",
      "contacts",
      "set Balls = a\n set Ball radius = 0.1\n set Overlap = allowed\n set Planes = ground at 0 0 0 normal " +
        number_of(n(0)) + " " + number_of(n(1)) + " " + number_of(n(2)) + "\n" + law);
  }

  std::string
  single_on_plane(const Vector3 &n, const std::string &law)
  {
    return joint(
      "touching",
      "ball on plane",
      "set Body A = ground\n set Body B = a.centre\n set Radius = 0.1\n set Position = 0, 0, 0\n set Axis = " +
        number_of(n(0)) + ", " + number_of(n(1)) + ", " + number_of(n(2)) + "\n" + law);
  }

  /** What bristles of a state store [J]. */
  double
  bent_energy(const State &state, const double stiffness)
  {
    double sum = 0;
    for (const PairBristle &b : state.bristles)
      sum += 0.5 * stiffness * b.deflection.squaredNorm();
    return sum;
  }
} // namespace



// Up the slope it stops after v²/(2 g (sin α + μ cos α)) and stays, with what pulls it in its bristles: the same motion
// as with a single contact, step by step.
TEST(GroupBristles, BlockOnASlopeAsWithASingleContact)
{
  const double angle = 0.3, v = 2, pull = g_of_bristles * std::sin(angle),
               way = v * v / (2 * (pull + 0.5 * g_of_bristles * std::cos(angle)));
  const Vector3     n(-std::sin(angle), 0, std::cos(angle)), up(std::cos(angle), 0, std::sin(angle));
  const std::string law = " set Stiffness = 1e6\n" + bristles_of_group;
  const Scene       many(ball_on_slope(angle, v, group_on_plane(n, law))),
    one(ball_on_slope(angle, v, single_on_plane(n, law)));
  for (const auto &[s, rho] :
       {std::make_pair(1, 1. / 3), std::make_pair(2, 0.5), std::make_pair(3, 0.5), std::make_pair(3, 1.)})
    {
      SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + number_of(rho));
      const auto of_group = contact_motion(many.system, Tableau(s, rho), 2.5e-3, 1.),
                 of_one   = contact_motion(one.system, Tableau(s, rho), 2.5e-3, 1.);
      EXPECT_LT(of_group.drift, 1e-11);
      EXPECT_LT(of_group.up, 1e-11);
      EXPECT_GE(of_group.least_loss, -1e-14);
      EXPECT_LT((of_group.state.position(1) - of_one.state.position(1)).norm(), 1e-8);
      EXPECT_NEAR(of_group.friction_loss, of_one.friction_loss, 1e-7);
      EXPECT_EQ(of_group.n_failed, 0u);
      EXPECT_LT(of_group.n_iterations, 12 * of_group.n_steps);
      EXPECT_NEAR(up.dot(of_group.state.position(1)) / way, 1, 0.03);
      ASSERT_EQ(of_group.state.bristles.size(), 1u);
      if (rho < 1)
        {
          EXPECT_LT(Eigen::Map<const Vector3>(&of_group.state.y[6]).norm(), 1e-6);
          EXPECT_NEAR(-1e4 * up.dot(of_group.state.bristles[0].deflection), pull, 1e-4 * pull);
          EXPECT_NEAR(n.dot(of_group.state.bristles[0].deflection), 0, 1e-15);
        }
    }
}



// A spinning ball falls and bounces: in the air it has no bristles, each touch begins with straight ones; then it
// rolls, as fast as with friction that has none. (Not quite as fast as a ball that is not pressed in: what rubs is
// nearer to its centre by the depth, up to 4 mm.)
TEST(GroupBristles, BallBouncesAndRolls)
{
  const double      R = 0.1;
  const std::string law =
    " set Stiffness = 1e6\n set Exponent = 1.5\n set Restitution = 0.5\n set Impact speed = 1\n set Friction = 0.3\n"
    " set Bristle stiffness = 1e5\n set Bristle damping = 100\n";
  const std::string thrown  = ball("a", R, {0, 0, R + 0.05}, {1, 0.5, 0}, {0, -20, 3}),
                    without = law.substr(0, law.find(" set Bristle")) + " set Sticking speed = 1e-4\n";
  const Scene scene(model(thrown, group_on_plane({0, 0, 1}, law), gravity)),
    plain(model(thrown, group_on_plane({0, 0, 1}, without), gravity));
  const State   rolling  = contact_motion(plain.system, Tableau(2, 0.5), 1e-3, 1.5).state;
  const Vector3 expected = rolling.triad(1) * Eigen::Map<const Vector3>(&rolling.y[6]);
  for (const unsigned int s : {2, 3})
    {
      unsigned int n_flights = 0;
      bool         flew      = true;
      const auto   m =
        contact_motion(scene.system, Tableau(s, 0.5), 1e-3, 1.5, [&](const State &state, const StepResult &) {
          const bool flies = state.position(1)(2) > R;
          EXPECT_EQ(state.bristles.empty(), flies);
          EXPECT_LT(bent_energy(state, 1e5), 0.1);
          n_flights += flies && !flew;
          flew = flies;
        });
      const Vector3 velocity = m.state.triad(1) * Eigen::Map<const Vector3>(&m.state.y[6]);
      const Vector3 spin     = m.state.triad(1) * Eigen::Map<const Vector3>(&m.state.y[9]);
      EXPECT_GT(n_flights, 2u);
      EXPECT_LT(m.drift, 1e-11) << s;
      EXPECT_GE(m.least_loss, -1e-13);
      EXPECT_NEAR(velocity(0), expected(0), 1e-3) << s;
      EXPECT_NEAR(velocity(1), expected(1), 1e-3) << s;
      EXPECT_NEAR(velocity(0), (1 - 0.4 * R * 20) / 1.4, 1e-2) << s;
      EXPECT_NEAR(velocity(1), 0.5 / 1.4, 1e-2) << s;
      EXPECT_NEAR(spin(1) * R, velocity(0), 1e-3);
      EXPECT_NEAR(spin(0) * R, -velocity(1), 1e-3);
    }
}



// Free balls that meet spinning: nothing but the two takes up a moment, and the energy is accounted for.
TEST(GroupBristles, MomentaOfFreeBalls)
{
  for (unsigned int s = 2; s <= 3; ++s)
    {
      const Scene   scene(model(ball("a", 0.1, {0, 0, 0}, {1, 0.2, -0.3}, {3, -5, 4}) +
                                ball("b", 0.15, {0.27, 0.03, 0.02}, {-0.4, 0, 0.1}, {-2, 1, 7}),
                              joint("touching",
                                    "contacts",
                                    "set Balls = a, b radius 0.15\n set Ball radius = 0.1\n set Stiffness = 1e5\n"
                                      " set Exponent = 1.5\n" +
                                      bristles_of_group)));
      const Vector6 start  = momentum_of(scene.system, start_of({"", "", 0, 0}, scene.system));
      const auto    run    = contact_motion(scene.system, Tableau(s, 1.), 1e-3, 0.1);
      const Vector6 change = momentum_of(scene.system, run.state) - start;
      EXPECT_LT(run.drift, 1e-11) << s;
      EXPECT_GT(run.friction_loss, 1e-3);
      EXPECT_GE(run.least_loss, -1e-14);
      EXPECT_LT(change.head<3>().norm(), 3e-8 * start.head<3>().norm()) << s;
      EXPECT_LT(change.tail<3>().norm(), 3e-8 * start.tail<3>().norm()) << s;
      EXPECT_TRUE(run.state.bristles.empty());
    }
}



// On a table that turns what sticks has bristles that turn with it: after two turns a tripod stands where it stood, and
// they hold m Ω² r.
TEST(GroupBristles, TurnWithTheTable)
{
  const double      Omega = 3, r = 0.5, T = 4 * M_PI / Omega;
  const std::string tripod = rigid_body("a",
                                        "set Mass = 1\n set Inertia = 0.01, 0.01, 0.01\n set Position = 0.5, 0, 0.1\n"
                                        " set Frames = i at 0.6 0 0.1, k at 0.45 0.08 0.1, l at 0.45 -0.08 0.1\n" +
                                          moving("0, 1.5, 0", "0, 0, 3")),
                    table =
                      rigid_body("table", "set Mass = 1\n set Inertia = 1, 1, 1\n" + moving("0, 0, 0", "0, 0, 3"));
  const Scene   scene(model(tripod + table,
                          joint("drive",
                                "revolute",
                                "set Body A = ground\n set Body B = table.centre\n set Axis = 0, 0, 1\n" +
                                  motion("rotation", " set Prescribed = 3*t\n")) +
                            joint("touching",
                                  "contacts",
                                  "set Balls = a.i, a.k, a.l\n set Ball radius = 0.1\n set Stiffness = 1e6\n"
                                    " set Planes = table at 0 0 0 normal 0 0 1\n set Friction = 0.8\n"
                                    " set Bristle stiffness = 1e5\n set Bristle damping = 300\n"),
                          gravity));
  const auto    m = contact_motion(scene.system, Tableau(2, 0.5), 5e-3, T);
  const Vector3 x = m.state.triad(2).transpose() * m.state.position(1);
  EXPECT_LT(m.drift, 1e-9);
  EXPECT_EQ(m.state.bristles.size(), 3u);
  // what holds it on its circle is in the bristles; the sudden start let it slip by some ten times their deflection at
  // most
  Vector3 held = Vector3::Zero();
  for (const PairBristle &b : m.state.bristles)
    held += 1e5 * (m.state.triad(2).transpose() * b.deflection);
  EXPECT_NEAR(std::abs(held(0)), Omega * Omega * r, 0.02 * Omega * Omega * r);
  EXPECT_NEAR(held(1), 0, 0.02 * Omega * Omega * r);
  EXPECT_NEAR(x(0), r, 2e-4);
  EXPECT_NEAR(x(1), 0, 2e-4);
}



// A state has all that a run needs: one that is taken up half way goes on as if nothing had been.
TEST(GroupBristles, GoOnFromAState)
{
  const Scene     scene(ball_on_slope(
    0.3, 2, group_on_plane({-std::sin(0.3), 0, std::cos(0.3)}, " set Stiffness = 1e6\n" + bristles_of_group)));
  StageIntegrator one(scene.system, Tableau(3, 0.5), 1e-13);
  State           state = start_of({"", "", 0, 0}, scene.system), copy;
  for (unsigned int i = 0; i < 60; ++i)
    {
      if (i == 40)
        copy = state;
      ASSERT_TRUE(one.step(state, 0.005).converged);
    }
  StageIntegrator other(scene.system, Tableau(3, 0.5), 1e-13);
  for (unsigned int i = 40; i < 60; ++i)
    ASSERT_TRUE(other.step(copy, 0.005).converged);
  ASSERT_EQ(state.bristles.size(), 1u);
  EXPECT_GT(state.bristles[0].deflection.norm(), 1e-5);
  EXPECT_LT((copy.bristles.at(0).deflection - state.bristles[0].deflection).norm(), 1e-11);
  EXPECT_LT((copy.position(1) - state.position(1)).norm(), 1e-11);
}



// Laws of pairs may have bristles of their own, or none: of three balls that slip one stops, one creeps down, one
// slides.
TEST(GroupBristles, LawsOfPairs)
{
  const double      angle = 0.2;
  const Vector3     n(-std::sin(angle), 0, std::cos(angle));
  const double      depth = g_of_bristles * n(2) / 1e6;
  std::string       bodies, holds;
  const std::string names[] = {"rough", "creeping", "ice"};
  for (unsigned int i = 0; i < 3; ++i)
    {
      bodies += ball(names[i], 0.1, (0.1 - depth) * n + Vector3(0, i, 0), {0, 0, 0}, {0, 0, 0});
      holds += joint("plane of " + names[i],
                     "planar",
                     "set Body A = ground\n set Body B = " + names[i] + ".centre\n set Axis = 0, 1, 0\n" +
                       motion("rotation", " set Prescribed = 0\n"));
    }
  const Scene scene(
    model(bodies,
          holds + joint("touching",
                        "contacts",
                        "set Balls = rough, creeping, ice\n set Ball radius = 0.1\n set Overlap = allowed\n"
                        " set Stiffness = 1e6\n set Planes = ground at 0 0 0 normal " +
                          number_of(n(0)) + " 0 " + number_of(n(2)) +
                          "\n set Friction = 0.5\n set Sticking speed = 1e-3\n set Laws = rough with ground "
                          "bristle 1e5 bending 300, ice with ground friction 0 bristle 0\n"),
          gravity));
  const double T    = 0.5;
  const auto   m    = contact_motion(scene.system, Tableau(2, 0.5), 5e-3, T);
  const auto   down = [&](const unsigned int i) {
    return -(m.state.position(1 + i) - (0.1 - depth) * n - Vector3(0, i, 0)).dot(Vector3(n(2), 0, -n(0)));
  };
  const double pull = g_of_bristles * std::sin(angle), most = 0.5 * g_of_bristles * std::cos(angle);
  EXPECT_LT(m.drift, 1e-10);
  // as far as bristles are bent, and what they crept as the weight came all at once: less than they bend before they
  // slip
  EXPECT_NEAR(1e5 * m.state.bristles.at(0).deflection.norm(), pull, 0.02 * pull);
  EXPECT_GT(down(0), 0.99 * pull / 1e5);
  EXPECT_LT(down(0), most / 1e5);
  EXPECT_NEAR(down(1), 1e-3 * pull / std::sqrt(most * most - pull * pull) * T, 2e-5);
  EXPECT_NEAR(down(2), 0.5 * pull * T * T, 1e-3 * pull * T * T);
  EXPECT_EQ(m.state.bristles.size(), 1u);
}



TEST(GroupBristles, AreRefused)
{
  const auto answer = [&](const std::string &law) -> std::string {
    try
      {
        const Scene scene(model(ball("a", 0.1, {0, 0, 0.2}, {0, 0, 0}, {0, 0, 0}),
                                group_on_plane({0, 0, 1}, " set Stiffness = 1e6\n" + law)));
      }
    catch (const std::exception &problem)
      {
        return problem.what();
      }
    return "";
  };
  const auto has = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(answer(bristles_of_group), "");
  EXPECT_PRED2(has,
               answer(bristles_of_group + " set Sticking speed = 1e-3\n"),
               "has no place beside a <Bristle stiffness>");
  EXPECT_PRED2(has, answer(" set Friction = 0.5\n set Bristle damping = 50\n"), "needs a <Bristle stiffness>");
  EXPECT_PRED2(has, answer(bristles_of_group + " set Laws = a with ground sticking 1e-3\n"), "beside bristles");
  EXPECT_PRED2(has, answer(" set Friction = 0.5\n set Laws = a with ground bending 3\n"), "without a stiffness");
  EXPECT_PRED2(has, answer(" set Laws = a with ground bristle 1e5\n"), "bristles without friction");
  Scene modes("set Analyses = modal\n" + ball_on_slope(0.3,
                                                       0,
                                                       group_on_plane({-std::sin(0.3), 0, std::cos(0.3)},
                                                                      " set Stiffness = 1e6\n" + bristles_of_group)));
  try
    {
      modes.modes();
      FAIL() << "modes do not know bristles of groups";
    }
  catch (const std::exception &problem)
    {
      EXPECT_PRED2(has, problem.what(), "has bristles, which come and go");
    }
}



// Adaptive steps do not look at bristles, and say so.
TEST(GroupBristles, AdaptiveStepsSayThatTheyDoNotLook)
{
  const auto is_told = [](const std::string &control, const std::string &law) {
    Scene scene(
      "set Analyses = dynamic\n" + ball_on_slope(0, 1, group_on_plane({0, 0, 1}, " set Stiffness = 1e6\n" + law)) +
      "subsection Dynamic\n set End time = 0.02\n set Step = 0.01\n set Step control = " + control + "\nend\n");
    auto &dynamics = scene.analysis<DynamicAnalysis>();
    dynamics.start(scene.context);
    dynamics.run(scene.context);
    return scene.stream.str().find("do not look at bristles") != std::string::npos;
  };
  EXPECT_TRUE(is_told("adaptive", bristles_of_group));
  EXPECT_FALSE(is_told("fixed", bristles_of_group));
  EXPECT_FALSE(is_told("adaptive", " set Friction = 0.5\n set Sticking speed = 1e-3\n"));
}
