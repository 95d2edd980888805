// Stops: linear springs and dampers that act on a free motion while their switches are on. Closed forms.
//
// Statics do not turn switches; here they are turned by hand, so that what a stop does can be told by equilibria and
// modes.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A body at (1, 0, 0) on a joint at the origin, with the entries of one motion. */
  std::string
  model(const std::string &kind, const std::string &motion, const std::string &entries)
  {
    return "set Analyses = static, modal\nsubsection Bodies\n subsection body\n set Type = rigid body\n set Mass = 2\n"
           " set Position = 1, 0, 0\n set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n subsection j\n"
           " set Body A = ground\n set Body B = body.centre\n set Position = 0, 0, 0\n set Type = " +
           kind + "\n subsection " + motion + "\n" + entries + " end\n end\nend\n";
  }

  const std::string both_stops = "set Lower stop = -0.5\nset Upper stop = 0.4\nset Stop stiffness = 10\n";

  const Contribution &
  joint(const Scene &scene)
  {
    for (const auto &c : scene.input.model.contributions)
      if (c->name == "j")
        return *c;
    throw std::logic_error("no joint");
  }

  /** The first of the joint's switches is that of the lower stop. */
  void
  turn_on(Scene &scene, const unsigned int i)
  {
    scene.context.state.switches.at(joint(scene).first_switch + i) = 1;
  }

  std::string
  complaint(const std::string &text)
  {
    try
      {
        Scene scene(text);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



// What is positive is touched: lower − θ, θ − upper.
TEST(Stops, SwitchFunctions)
{
  Scene  scene(model("revolute", "rotation", both_stops));
  State &state = scene.context.state;
  ASSERT_EQ(scene.system.layout.n_switches, 2u);
  ASSERT_EQ(state.switches.size(), 2u);
  for (const double theta : {-0.7, -0.1, 3.})
    {
      state.coordinates[0] = theta;
      double values[2];
      joint(scene).switch_values(state.point(), values);
      EXPECT_DOUBLE_EQ(values[0], -0.5 - theta);
      EXPECT_DOUBLE_EQ(values[1], theta - 0.4);
    }
}



TEST(Stops, OnlyOnOneSide)
{
  Scene upper(model("prismatic", "displacement", "set Upper stop = 0.4\nset Stop stiffness = 10\n"));
  ASSERT_EQ(upper.system.layout.n_switches, 1u);
  double value;
  joint(upper).switch_values(upper.context.state.point(), &value);
  EXPECT_DOUBLE_EQ(value, -0.4);
  Scene none(model("prismatic", "displacement", "set Stop stiffness = 10\n"));
  EXPECT_EQ(none.system.layout.n_switches, 0u);
}



// A stop at zero is one, too, and alone makes the motion an unknown.
TEST(Stops, UseTheMotion)
{
  EXPECT_EQ(Scene(model("revolute", "rotation", "")).system.layout.n_coordinates, 0u);
  Scene scene(model("revolute", "rotation", "set Lower stop = 0\nset Stop stiffness = 10\n"));
  EXPECT_EQ(scene.system.layout.n_coordinates, 1u);
  EXPECT_EQ(scene.system.layout.n_strains, 2u);
  EXPECT_EQ(scene.system.layout.n_switches, 1u);
}



// Spring and stop share the moment, k θ + k_s (θ − θ_s) = M, on either side; the energy is ½ k θ² + ½ k_s (θ − θ_s)².
TEST(Stops, HoldAgainstAMoment)
{
  for (const bool upper : {false, true})
    {
      const double stop = upper ? 0.4 : -0.5, M = upper ? 3 : -3;
      Scene        scene(
        model("revolute", "rotation", both_stops + "set Spring = 2\nset Moment = " + (upper ? "3\n" : "-3\n")));
      turn_on(scene, upper ? 1 : 0);
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
  Scene scene(model("prismatic", "displacement", both_stops) +
              "subsection Loads\n subsection f\n set Type = point load\n set At = body.centre\n"
              " set Force = 0, 0, 7\n end\nend\n");
  turn_on(scene, 1);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.displacement"), 0.4 + 7. / 10, 1e-10);
  EXPECT_NEAR(scene.value("j.force 3"), -7., 1e-9);
}



// A stop whose switch is off does nothing, wherever the motion is; neither does one without switches.
TEST(Stops, NothingWhileOff)
{
  Scene scene(model("revolute", "rotation", both_stops + "set Spring = 2\nset Moment = 3\nset Stop damping = 4\n"));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.rotation") * M_PI / 180, 1.5, 1e-10);
  EXPECT_NEAR(scene.system.energy(scene.context.state).strain, 0.5 * 2 * 1.5 * 1.5, 1e-9);
  Point<double> point = scene.context.state.point();
  point.switches      = nullptr;
  double e[3];
  joint(scene).strains(point, e);
  EXPECT_NEAR(e[0], 1.5, 1e-10);
  EXPECT_EQ(e[1], 0.);
  EXPECT_EQ(e[2], 0.);
}



// A body that touches a stop and stays there: m d¨ + c ḋ + k d = 0, m = 2, k = 8, c = 0.8. Touching nothing it is free.
TEST(Stops, Modes)
{
  const std::string text =
    model("prismatic", "displacement", "set Upper stop = 0\nset Stop stiffness = 8\nset Stop damping = 0.8\n");
  Scene touching(text);
  turn_on(touching, 0);
  ASSERT_EQ(touching.modes().size(), 1u);
  EXPECT_NEAR(touching.modes()[0].frequency(), 2., 1e-10);
  EXPECT_NEAR(touching.modes()[0].damping_ratio(), 0.1, 1e-10);
  Scene free(text);
  EXPECT_LT(free.modes().at(0).frequency(), 1e-6);
}



TEST(Stops, DampingIsDissipation)
{
  EXPECT_FALSE(joint(Scene(model("revolute", "rotation", both_stops))).has_damping());
  EXPECT_TRUE(joint(Scene(model("revolute", "rotation", both_stops + "set Stop damping = 0.1\n"))).has_damping());
  EXPECT_FALSE(joint(Scene(model("revolute", "rotation", "set Spring = 1\nset Stop damping = 0.1\n"))).has_damping());
}



TEST(Stops, RefusesWhatIsSenseless)
{
  const auto refused = [](const std::string &entries, const std::string &words) {
    const std::string text = complaint(model("revolute", "rotation", entries));
    EXPECT_NE(text.find(words), std::string::npos) << entries << text;
  };
  refused("set Lower stop = -1\n", "the stop of the rotation needs a <Stop stiffness> above zero");
  refused("set Upper stop = 1\nset Stop stiffness = 0\n", "needs a <Stop stiffness> above zero");
  refused("set Upper stop = 1\nset Stop stiffness = -3\n", "is not accepted");
  refused("set Upper stop = 1\nset Stop stiffness = 3\nset Stop damping = -1\n", "is not accepted");
  refused("set Upper stop = 1 m\nset Stop stiffness = 3\n", "<Upper stop>");
  refused("set Lower stop = 1\nset Upper stop = 1\nset Stop stiffness = 3\n",
          "the <Upper stop> of the rotation must be above its <Lower stop>");
  EXPECT_EQ(complaint(model("revolute", "rotation", both_stops)), "");
}
