// Groups of contacts whose pairs have laws of their own, and that resist rolling and turning.
//
// References: a single contact of the same ball; decelerations of what slips and what rolls on a plane; restitution of
// the input.

#include <gtest/gtest.h>

#include "contact_motion.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  constexpr double g_of_laws = 9.80665;

  std::string
  group_with(const std::string &entries)
  {
    return joint("touching",
                 "contacts",
                 "set Planes = ground at 0 0 0 normal 0 0 1\n set Ball radius = 0.1\n set Stiffness = 1e6\n"
                 " set Exponent = 1.5\n set Sticking speed = 1e-5\n set Overlap = allowed\n" +
                   entries);
  }

  const double depth_of_laws = std::pow(g_of_laws / 1e6, 1 / 1.5); ///< of 1 kg on it

  Vector3
  velocity_in(const State &state, const unsigned int node)
  {
    return state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node]);
  }
} // namespace



// A ball that slips, rolls and turns on the spot: in a group as in a single contact, but for the arm of friction, which
// ends halfway in the penetration there. So both come together as the floor becomes stiff.
TEST(ContactLawsOfPairs, RollingAsInASingleContact)
{
  std::array<double, 2> apart{};
  for (unsigned int i = 0; i < 2; ++i)
    {
      const double      k = i == 0 ? 1e7 : 1e9, depth = std::pow(g_of_laws / k, 1 / 1.5);
      const std::string rubs = " set Radius = 0.1\n set Friction = 0.3\n set Rolling friction = 0.02\n"
                               " set Turning friction = 0.01\n set Sticking speed = 1e-4\n set Exponent = 1.5\n"
                               " set Stiffness = " +
                               number_of(k) + "\n";
      const auto run = [&](const std::string &joints) {
        const Scene scene(model(ball("a", 0.1, {0, 0, 0.1 - depth}, {1, 0.5, 0}, {0, -20, 3}), joints, gravity));
        return contact_motion(scene.system, Tableau(2, 0.5), 2e-3, 0.5);
      };
      const auto one = run(joint("contact",
                                 "ball on plane",
                                 "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n" + rubs));
      const auto many =
        run(joint("touching",
                  "contacts",
                  "set Balls = a\n set Planes = ground at 0 0 0 normal 0 0 1\n set Overlap = allowed\n" +
                    std::string(rubs).replace(1, 10, "set Ball radius")));
      apart[i] = (one.state.position(1) - many.state.position(1)).norm();
      EXPECT_NEAR(one.friction_loss, many.friction_loss, (i == 0 ? 1e-3 : 5e-5) * one.friction_loss);
      EXPECT_LT(many.drift, 1e-11);
      EXPECT_EQ(many.least_loss, 0);
    }
  EXPECT_LT(apart[1], 1e-5);
  EXPECT_LT(apart[1], 0.2 * apart[0]);
}



// Of three balls that roll, one is slowed by 5/7 μ g of its own law, one by that of the group, one by nothing.
TEST(ContactLawsOfPairs, EachRollsByItsOwn)
{
  const double R = 0.1, v = 1, T = 0.4;
  const auto   rolling = [&](const std::string &name, const double y) {
    return ball(name, R, {0, y, R - depth_of_laws}, {v, 0, 0}, {0, v / R, 0});
  };
  const Scene scene(
    model(rolling("felt", 0) + rolling("steel", 1) + rolling("plain", 2),
          group_with("set Balls = felt, steel, plain\n set Friction = 0.5\n set Rolling friction = 0.01\n"
                     " set Laws = fe* with ground rolling 0.05, ground with steel rolling 0\n"),
          gravity));
  const auto   m    = contact_motion(scene.system, Tableau(2, 0.5), 5e-3, T);
  const double mu[] = {0.05, 0, 0.01};
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(velocity_in(m.state, 1 + i)(0), v - 5. / 7 * mu[i] * g_of_laws * T, 1e-3) << i;
  EXPECT_LT(m.drift, 1e-11);
}



// Balls that slip without turning at first: v − μ g t, each with its μ; one that falls leaves with its own restitution.
TEST(ContactLawsOfPairs, FrictionAndRestitution)
{
  const double R = 0.1, v = 2, T = 0.05, fall = std::sqrt(0.5 * g_of_laws);
  const Scene  scene(model(ball("rubber", R, {0, 0, R - depth_of_laws}, {v, 0, 0}, {0, 0, 0}) +
                            ball("ice", R, {0, 1, R - depth_of_laws}, {v, 0, 0}, {0, 0, 0}) +
                            ball("clay", R, {0, 3, 1.25 * R}, {0, 0, -fall}, {0, 0, 0}),
                          group_with("set Balls = rubber, ice, clay\n set Friction = 0.1\n"
                                      " set Laws = rubber with ground friction 0.8, ice with ground friction 0, "
                                      "clay with ground restitution 0.4 speed " +
                                     number_of(std::sqrt(fall * fall + 2 * g_of_laws * 0.25 * R)) + " stiffness 1e8\n"),
                          gravity));
  const auto   m = contact_motion(scene.system, Tableau(2, 1.), 2e-4, T);
  EXPECT_NEAR(velocity_in(m.state, 1)(0), v - 0.8 * g_of_laws * T, 2e-3);
  EXPECT_NEAR(velocity_in(m.state, 2)(0), v, 1e-9);
  // back where it touched, against gravity
  const double up = velocity_in(m.state, 3)(2), z = m.state.position(3)(2) - R;
  EXPECT_NEAR(std::sqrt(up * up + 2 * g_of_laws * z) / std::sqrt(fall * fall + 2 * g_of_laws * 0.25 * R),
              0.4,
              1.5e-2); // weight acts in the contact, too
  EXPECT_LT(m.drift, 1e-10);
}



TEST(ContactLawsOfPairs, AreRefused)
{
  const auto answer = [&](const std::string &laws) -> std::string {
    try
      {
        const Scene scene(model(ball("a", 0.1, {0, 0, 0.2}, {0, 0, 0}, {0, 0, 0}),
                                group_with("set Balls = a\n set Laws = " + laws + "\n")));
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
  EXPECT_EQ(answer("a with ground friction 0.3 static 0.5 stribeck 0.1"), "");
  EXPECT_PRED2(has, answer("a with ground frictoin 0.3"), "says nothing of them");
  EXPECT_PRED2(has, answer("a with ground friction 0.3 stifness 2"), "did you mean <stiffness>");
  EXPECT_PRED2(has, answer("a and ground friction 0.3"), "<a with b friction 0.3>");
  EXPECT_PRED2(has, answer("a with ground friction -0.3"), "not below zero");
  EXPECT_PRED2(has, answer("a with ground friction nan"), "needs a number");
  EXPECT_PRED2(has, answer("a with ground friction"), "needs a number");
  EXPECT_PRED2(has, answer("a with ground friction 0.1 friction 0.2"), "twice");
  EXPECT_PRED2(has, answer("b with ground friction 0.3"), "no body of this group is <b>");
  EXPECT_PRED2(has, answer("a with a friction 0.3"), "does not touch itself");
  EXPECT_PRED2(has, answer("a with ground stiffness 0"), "a stiffness of zero");
  EXPECT_PRED2(has, answer("a with ground exponent 0.5"), "an exponent below 1");
  EXPECT_PRED2(has, answer("a with ground restitution 0.5"), "without a speed of impact");
  EXPECT_PRED2(has, answer("a with ground static 0.5 friction 0.3"), "without a Stribeck speed");
  EXPECT_PRED2(has, answer("a with ground friction 0.5 static 0.3"), "below that of what slips");
}
