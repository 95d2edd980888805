// Stops in statics and modes: linear springs and dampers that push on a free motion while their gap is positive. Closed
// forms.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A body at (1, 0, 0) on a joint at the origin, with the entries of one motion. */
  std::string
  body_with_stops(const std::string &kind, const std::string &motion, const std::string &entries)
  {
    return "set Analyses = static, modal\nsubsection Bodies\n subsection body\n set Type = rigid body\n set Mass = 2\n"
           " set Position = 1, 0, 0\n set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n subsection j\n"
           " set Body A = ground\n set Body B = body.centre\n set Position = 0, 0, 0\n set Type = " +
           kind + "\n subsection " + motion + "\n" + entries + " end\n end\nend\n";
  }

  const std::string both_stops = "set Lower stop = -0.5\nset Upper stop = 0.4\nset Stop stiffness = 10\n";
} // namespace



// They are all that an integrator sees: coordinates, places, sides.
TEST(Stops, AreListedInTheLayout)
{
  const Scene scene(body_with_stops("revolute", "rotation", both_stops + "set Stop damping = 3\n"));
  ASSERT_EQ(scene.system.layout.stops.size(), 2u);
  for (unsigned int i = 0; i < 2; ++i)
    {
      const Layout::Stop &stop = scene.system.layout.stops[i];
      EXPECT_EQ(stop.coordinate, 0u);
      EXPECT_EQ(stop.place, i == 0 ? -0.5 : 0.4);
      EXPECT_EQ(stop.side, i == 0 ? -1. : 1.);
      EXPECT_EQ(stop.law.stiffness, 10.);
      EXPECT_EQ(stop.law.damping, 3.);
      EXPECT_EQ(stop.name, std::string("joint j, ") + (i == 0 ? "lower" : "upper") + " stop of the rotation");
    }
}



TEST(Stops, OnlyOnOneSide)
{
  const Scene upper(body_with_stops("prismatic", "displacement", "set Upper stop = 0.4\nset Stop stiffness = 10\n"));
  ASSERT_EQ(upper.system.layout.stops.size(), 1u);
  EXPECT_EQ(upper.system.layout.stops[0].side, 1.);
  EXPECT_TRUE(Scene(body_with_stops("prismatic", "displacement", "")).system.layout.stops.empty());
}



// A stop at zero is one, too, and alone makes the motion an unknown.
TEST(Stops, UseTheMotion)
{
  EXPECT_EQ(Scene(body_with_stops("revolute", "rotation", "")).system.layout.n_coordinates, 0u);
  Scene scene(body_with_stops("revolute", "rotation", "set Lower stop = 0\nset Stop stiffness = 10\n"));
  EXPECT_EQ(scene.system.layout.n_coordinates, 1u);
  EXPECT_EQ(scene.system.layout.n_strains, 2u);
  EXPECT_EQ(scene.system.layout.stops.size(), 1u);
}



// Spring and stop share the moment, k θ + k_s (θ − θ_s) = M, on either side; the energy is ½ k θ² + ½ k_s (θ − θ_s)².
TEST(Stops, HoldAgainstAMoment)
{
  for (const bool upper : {false, true})
    {
      const double stop = upper ? 0.4 : -0.5, M = upper ? 3 : -3;
      Scene        scene(body_with_stops("revolute",
                                  "rotation",
                                  both_stops + "set Spring = 2\nset Moment = " + (upper ? "3\n" : "-3\n")));
      scene.equilibrium();
      const double theta = (M + 10 * stop) / 12;
      EXPECT_NEAR(scene.value("j.rotation") * M_PI / 180, theta, 1e-10);
      EXPECT_NEAR(scene.system.energy(scene.context.state).strain,
                  0.5 * 2 * theta * theta + 0.5 * 10 * std::pow(theta - stop, 2),
                  1e-9);
    }
}



// The force between A and B is that of the load, whoever transmits it.
TEST(Stops, ForceOfTheJoint)
{
  Scene scene(body_with_stops("prismatic", "displacement", both_stops + "set Spring = 2\n") +
              "subsection Loads\n subsection f\n set Type = point load\n set At = body.centre\n"
              " set Force = 0, 0, 7\n end\nend\n");
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.displacement"), (7 + 10 * 0.4) / 12, 1e-10);
  EXPECT_NEAR(scene.value("j.force 3"), -7., 1e-9);
}



// Short of the stop the spring is alone; where stops are left to an integrator they do nothing, wherever the motion is.
TEST(Stops, NothingWhileNotTouched)
{
  Scene scene(
    body_with_stops("revolute", "rotation", both_stops + "set Spring = 10\nset Moment = 3\nset Stop damping = 4\n"));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.rotation") * M_PI / 180, 0.3, 1e-10);
  EXPECT_NEAR(scene.system.energy(scene.context.state).strain, 0.5 * 10 * 0.3 * 0.3, 1e-9);
  State state          = scene.context.state;
  state.coordinates[0] = 1.5;
  double e[3];
  scene.system.strains(state.point(), e);
  EXPECT_EQ(e[1], 0.);
  EXPECT_NEAR(e[2], 1.1, 1e-15);
  state.stops = false;
  scene.system.strains(state.point(), e);
  EXPECT_NEAR(e[0], 1.5, 1e-15);
  EXPECT_EQ(e[1], 0.);
  EXPECT_EQ(e[2], 0.);
}



// Beyond its stop from the start, and pressed on it by F = 4, a body of m = 2 moves as m d¨ + c ḋ + k d = F, k = 8, c =
// 0.8. Touching nothing it is free.
TEST(Stops, Modes)
{
  const std::string text = body_with_stops("prismatic",
                                           "displacement",
                                           "set Upper stop = -0.1\nset Stop stiffness = 8\nset Stop damping = 0.8\n");
  Scene             touching(text + "subsection Loads\n subsection f\n set Type = point load\n set At = body.centre\n"
                                    " set Force = 0, 0, 4\n end\nend\n");
  touching.equilibrium();
  EXPECT_NEAR(touching.value("j.displacement"), 0.4, 1e-10);
  ASSERT_EQ(touching.modes().size(), 1u);
  EXPECT_NEAR(touching.modes()[0].frequency(), 2., 1e-10);
  EXPECT_NEAR(touching.modes()[0].damping_ratio(), 0.1, 1e-10);
  Scene free(body_with_stops("prismatic", "displacement", "set Upper stop = 0\nset Stop stiffness = 8\n"));
  EXPECT_LT(free.modes().at(0).frequency(), 1e-6);
}



TEST(Stops, DampingIsDissipation)
{
  EXPECT_FALSE(Scene(body_with_stops("revolute", "rotation", both_stops)).system.is_viscous());
  EXPECT_TRUE(
    Scene(body_with_stops("revolute", "rotation", both_stops + "set Stop damping = 0.1\n")).system.is_viscous());
  EXPECT_NE(complaint_of(body_with_stops("revolute", "rotation", "set Spring = 1\nset Stop damping = 0.1\n"))
              .find("<Stop damping> does nothing: there is no stop"),
            std::string::npos);
}



TEST(Stops, RefusesWhatIsSenseless)
{
  const auto refused = [](const std::string &entries, const std::string &words) {
    const std::string text = complaint_of(body_with_stops("revolute", "rotation", entries));
    EXPECT_NE(text.find(words), std::string::npos) << entries << text;
  };
  refused("set Lower stop = -1\n", "the stop of the rotation needs a <Stop stiffness> above zero");
  refused("set Upper stop = 1\nset Stop stiffness = 0\n", "needs a <Stop stiffness> above zero");
  refused("set Upper stop = 1\nset Stop stiffness = -3\n", "is not accepted");
  refused("set Upper stop = 1\nset Stop stiffness = 3\nset Stop damping = -1\n", "is not accepted");
  refused("set Upper stop = 1 m\nset Stop stiffness = 3\n", "<Upper stop>");
  refused("set Lower stop = 1\nset Upper stop = 1\nset Stop stiffness = 3\n",
          "the <Upper stop> of the rotation must be above its <Lower stop>");
  EXPECT_EQ(complaint_of(body_with_stops("revolute", "rotation", both_stops)), "");
}



// A ball on a guide rests on a cantilever, a beam that it touches at the nearest place, a: the contact is pressed by
// W/k, the beam bent by W a³/(3EI). On a stiffer beam it bounces on both springs in series.
TEST(Stops, BallRestsOnABeam)
{
  const double      W = 2e-3, k = 50, a = 0.55, EI = 3, GA = 1e5;
  const std::string text =
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 1e5\n set GA2 = 1e5\n"
    " set GA3 = 1e5\n set GJ = 3\n set EI2 = 3\n set EI3 = 3\n set Mass = 1\n set I2 = 0.01\n set I3 = 0.01\n end\nend\n"
    "subsection Bodies\n subsection beam\n set Type = beam\n set Section = s\n set Points = 0, 0, 0; 1, 0, 0\n"
    " set Elements = 4\n end\n subsection ball\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n"
    " set Position = 0.55, 0, 0.0999999\n end\nend\nsubsection Joints\n"
    " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = beam.start\n end\n"
    " subsection guide\n set Type = prismatic\n set Body A = ground\n set Body B = ball.centre\n set Axis = 0, 0, 1\n end\n"
    " subsection touching\n set Type = contacts\n set Balls = ball radius 0.08\n set Beams = beam radius 0.02\n"
    " set Stiffness = 50\n set Overlap = allowed\n end\nend\n"
    "subsection Loads\n subsection push\n set Type = point load\n set At = ball\n set Force = 0, 0, -2e-3\n end\nend\n";
  Scene scene(text);
  scene.equilibrium();
  const double bent = W * (a * a * a / (3 * EI) + a / GA);
  EXPECT_NEAR(scene.value("touching.ball.force z"), W, 1e-9);
  EXPECT_NEAR(scene.value("touching.depth"), W / k, 1e-9);
  EXPECT_NEAR(scene.value("ball.position z"), 0.1 - bent - W / k, 1e-2 * bent);
  std::string stiff = text;
  for (const std::string entry : {"EI2 = 3", "EI3 = 3"})
    stiff.insert(stiff.find(entry) + entry.size(), "000");
  Scene stiffer(stiff);
  stiffer.equilibrium();
  EXPECT_NEAR(stiffer.modes()[0].frequency(), std::sqrt(1 / (1 / k + a * a * a / (3000 * EI) + a / GA)), 7e-3);
}
