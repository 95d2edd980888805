// Springs, forces and moments at joints in equilibrium, against closed forms: directions and signs. "Moment" and
// "Force" act on body B, their reactions on body A; a spring is free of load at "Rest".

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A body at (1, 0, 0) on a joint at the origin, and more. */
  std::string
  body_on_springs(const std::string &joint, const std::string &rest = "")
  {
    return "set Analyses = static\nsubsection Bodies\n subsection body\n set Type = rigid body\n set Mass = 2\n"
           " set Position = 1, 0, 0\n set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n subsection j\n set Body A = ground\n"
           " set Body B = body.centre\n set Position = 0, 0, 0\n" +
           joint + " end\nend\n" + rest;
  }

  std::string
  motion(const std::string &name, const std::string &entries)
  {
    return "subsection " + name + "\n" + entries + "end\n";
  }

  std::string
  load(const std::string &entries)
  {
    return "subsection Loads\n subsection f\n set Type = point load\n set At = body.centre\n" + entries + " end\nend\n";
  }

  double
  radians(const Scene &scene, const std::string &probe)
  {
    return scene.value(probe) * M_PI / 180;
  }
} // namespace



TEST(Springs, RevoluteWithMomentAndRest)
{
  Scene scene(body_on_springs("set Type = revolute\nset Axis = 0, 1, 0\n" +
                              motion("rotation", "set Spring = 2\nset Rest = 0.2\nset Moment = 3\n")));
  scene.equilibrium();
  EXPECT_NEAR(radians(scene, "j.rotation"), 0.2 + 3. / 2, 1e-9);
  // about +y, x turns towards −z
  EXPECT_NEAR(scene.value("body.position z"), -std::sin(1.7), 1e-9);
}



TEST(Springs, MomentIsAFunctionOfTime)
{
  Scene scene(body_on_springs("set Type = revolute\n" + motion("rotation", "set Spring = 2\nset Moment = t^2\n"),
                              "subsection Static\n set Time = 0.5\nend\n"));
  scene.equilibrium();
  EXPECT_NEAR(radians(scene, "j.rotation"), 0.125, 1e-9);
}



// An outer moment on the body turns it the same way as the joint's own.
TEST(Springs, OuterMoment)
{
  Scene scene(body_on_springs("set Type = revolute\nset Axis = 1, 2, 2\n" + motion("rotation", "set Spring = 2\n"),
                              load("set Moment = 1, 2, 2\n")));
  scene.equilibrium();
  EXPECT_NEAR(radians(scene, "j.rotation"), 1.5, 1e-9);
}



TEST(Springs, PrismaticForceAndOuterForce)
{
  Scene scene(body_on_springs("set Type = prismatic\nset Axis = 0, 0, 1\n" +
                                motion("displacement", "set Spring = 50\nset Rest = 0.1\nset Force = 10\n"),
                              load("set Force = 3, 4, 5\n")));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("body.displacement z"), 0.1 + 15. / 50, 1e-10);
  EXPECT_NEAR(scene.value("j.displacement"), 0.4, 1e-10);
}



// A torque on the nut: k_θ θ + k_d p (p θ) = M + p F.
TEST(Springs, Screw)
{
  Scene scene(body_on_springs("set Type = screw\nset Pitch = 0.3\nset Axis = 0, 0, 1\n" +
                              motion("rotation", "set Spring = 2\nset Moment = 1\n") +
                              motion("displacement", "set Spring = 30\nset Force = 4\n")));
  scene.equilibrium();
  const double theta = (1 + 0.3 * 4) / (2 + 0.09 * 30);
  EXPECT_NEAR(radians(scene, "j.rotation"), theta, 1e-9);
  EXPECT_NEAR(scene.value("body.displacement z"), 0.3 * theta, 1e-9);
}



// The reaction of a moment between A and B turns A the other way.
TEST(Springs, ReactionOnBodyA)
{
  const std::string more =
    "subsection Bodies\n subsection second\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n"
    " set Position = 2, 0, 0\n end\n";
  std::string text = body_on_springs("set Type = revolute\n" + motion("rotation", "set Spring = 5\n"));
  text.replace(text.find("subsection Bodies\n"), 18, more);
  text.replace(text.rfind("end\n"),
               4,
               "subsection k\n set Type = revolute\n set Body A = body.centre\n set Body B = second.centre\n" +
                 motion("rotation", "set Spring = 7\n set Rest = 0.3\n") + "end\nend\n");
  Scene unloaded(text);
  unloaded.equilibrium();
  EXPECT_NEAR(radians(unloaded, "j.rotation"), 0., 1e-9);
  EXPECT_NEAR(radians(unloaded, "k.rotation"), 0.3, 1e-9);
  // an outer moment on the second passes both springs, one inside the joint only its own
  Scene outer(
    text +
    "subsection Loads\n subsection f\n set Type = point load\n set At = second.centre\n set Moment = 0, 0, 2\n end\nend\n");
  outer.equilibrium();
  EXPECT_NEAR(radians(outer, "j.rotation"), 2. / 5, 1e-9);
  EXPECT_NEAR(radians(outer, "k.rotation"), 0.3 + 2. / 7, 1e-9);
  Scene inner(text, {"Joints/k/rotation/Moment = 2"});
  inner.equilibrium();
  EXPECT_NEAR(radians(inner, "j.rotation"), 0., 1e-9);
  EXPECT_NEAR(radians(inner, "k.rotation"), 0.3 + 2. / 7, 1e-9);
}



// A pendulum that its spring holds 0.6 rad below the horizontal: k θ = m g l cos θ.
TEST(Springs, PendulumUnderGravity)
{
  const double       k = 2 * 9.81 * std::cos(0.6) / 0.6;
  std::ostringstream spring;
  spring.precision(17);
  spring << "set Spring = " << k << "\n";
  Scene scene(body_on_springs(
    "set Type = revolute\nset Axis = 0, 1, 0\n" + motion("rotation", spring.str()),
    "subsection Loads\n subsection g\n set Type = gravity\n set Acceleration = 0, 0, -9.81\n end\nend\n"));
  scene.equilibrium();
  EXPECT_NEAR(radians(scene, "j.rotation"), 0.6, 1e-9);
  // the frequency about it: (m l² + J) ω² = k + m g l sin θ
  EXPECT_NEAR(scene.modes().at(0).frequency(), std::sqrt((k + 2 * 9.81 * std::sin(0.6)) / 3.), 1e-8);
}



// Both angles of a universal joint under moments in the joint: each spring sees its own.
TEST(Springs, Universal)
{
  Scene scene(body_on_springs("set Type = universal\n" + motion("rotation 1", "set Spring = 4\nset Moment = 2\n") +
                              motion("rotation 2", "set Spring = 5\nset Moment = -3\n")));
  scene.equilibrium();
  EXPECT_NEAR(radians(scene, "j.rotation 1"), 0.5, 1e-9);
  EXPECT_NEAR(radians(scene, "j.rotation 2"), -0.6, 1e-9);
}



// Planar: springs in both directions and a rotation; displacements go along the axes of A, which do not turn.
TEST(Springs, Planar)
{
  Scene        scene(body_on_springs("set Type = planar\nset Axis = 0, 0, 1\nset Axis 1 = 1, 0, 0\n" +
                                motion("displacement 1", "set Spring = 10\n") +
                                motion("displacement 2", "set Spring = 20\n") +
                                motion("rotation", "set Spring = 3\nset Moment = 1.5\n"),
                              load("set Force = 2, 8, 5\nset Moment = 0, 0, 0\n")));
  const State &state = scene.equilibrium();
  // k θ = M + (r × f)_z with the arm r = (cos θ, sin θ) of the body's centre from the joint
  const double theta = radians(scene, "j.rotation");
  EXPECT_NEAR(3 * theta, 1.5 + std::cos(theta) * 8 - std::sin(theta) * 2, 1e-8);
  EXPECT_NEAR(scene.value("j.displacement 1"), 0.2, 1e-9);
  EXPECT_NEAR(scene.value("j.displacement 2"), 0.4, 1e-9);
  EXPECT_NEAR(state.position(1)(1), 0.4 + std::sin(theta), 1e-9);
}
