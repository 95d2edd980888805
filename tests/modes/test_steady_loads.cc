// Motions whose kinematics are steady, but whose loads are not: weight and dead forces across the axis, reactions of a
// rotor out of balance on a support that yields. Statics warns, modes are refused unless they are allowed.

#include "../scene.h"
#include <gtest/gtest.h>

#include "rotors.h"

using namespace samara;

namespace
{
  std::string
  with_inserted(std::string text, const std::string &place, const std::string &more)
  {
    return text.insert(text.find(place) + place.size(), more);
  }

  std::string
  with_load(const std::string &rotor, const std::string &load)
  {
    return with_inserted(rotor, "subsection Loads\n", "  subsection load\n" + load + "  end\n");
  }

  const std::string gravity = "    set Type = gravity\n    set Acceleration = ";

  std::string
  force(const std::string &at, const std::string &components, const std::string &axes)
  {
    return "    set Type = point load\n    set At = " + at + "\n    set Force = " + components +
           "\n    set Axes = " + axes + "\n";
  }

  /** What statics warns of, and what modes are refused for. */
  void
  expect_unsteady(const std::string &text, const std::vector<std::string> &words)
  {
    Scene scene(text);
    scene.equilibrium();
    std::string refusal;
    try
      {
        scene.modes();
        ADD_FAILURE() << "modes of one moment";
      }
    catch (const InputError &problem)
      {
        refusal = problem.what();
      }
    for (const auto &word : words)
      {
        EXPECT_NE(scene.stream.str().find(word), std::string::npos) << word << " in\n" << scene.stream.str();
        EXPECT_NE(refusal.find(word), std::string::npos) << word << " in\n" << refusal;
      }
    Scene allowed(text, {"Modal/Unsteady motion = allow"});
    allowed.equilibrium();
    EXPECT_NO_THROW(allowed.modes());
  }

  void
  expect_steady(const std::string &text)
  {
    Scene scene(text);
    scene.equilibrium();
    EXPECT_EQ(scene.stream.str().find("as parts turn"), std::string::npos) << scene.stream.str();
    EXPECT_EQ(scene.stream.str().find("azimuth"), std::string::npos) << scene.stream.str();
    EXPECT_NO_THROW(scene.modes());
  }
} // namespace



TEST(SteadyLoads, WeightAlongAndAcrossTheAxis)
{
  for (const std::string kind : {"hinged", "teetering", "hingeless"})
    for (const Turned turned : {Turned::by_joint, Turned::as_a_whole})
      {
        SCOPED_TRACE(kind);
        expect_steady(with_load(rotor(kind, turned), gravity + "0, 0, -9.81\n"));
        expect_unsteady(with_load(rotor(kind, turned), gravity + "0, -9.81, 0\n"),
                        {"the equilibrium changes", "as <load> changes by up to", "seen in its own axes"});
      }
}



TEST(SteadyLoads, DeadAndFollowingForces)
{
  const std::string model = rotor("hingeless", Turned::by_joint);
  expect_steady(with_load(model, force("blade 1.end", "1, 2, 30", "body")));
  expect_steady(with_load(model, force("hub", "0, 0, 100", "inertial")));
  expect_steady(with_load(model, force("blade 1.end", "0, 0, 30", "inertial")));
  expect_unsteady(with_load(model, force("blade 1.end", "0, 0.1, 0", "inertial")),
                  {"as <load> changes by up to 0.186408 N on <blade 1>"});
}



// The blades are unlike: what carries the shaft has to bear a force that turns with them. The ground can, whichever
// its direction; a mount would whirl.
TEST(SteadyLoads, RotorOutOfBalance)
{
  const auto on_mount = [](const std::string &stiffness, const bool alike) {
    std::string text = rotor("hingeless", Turned::by_joint);
    text             = with_inserted(
      text,
      "subsection Bodies\n",
      "  subsection pylon\n    set Type = rigid body\n    set Mass = 20\n    set Inertia = 1, 1, 1\n  end\n");
    text.replace(text.find("Body A = ground"), 15, "Body A = pylon");
    text = with_inserted(
      text,
      "subsection Joints\n",
      "  subsection mount\n    set Type = flexible joint\n    set Body A = ground\n    set Body B = pylon\n"
      "    set Stiffness = " +
        stiffness + "\n    set Rotational stiffness = 1e6, 1e6, 1e6\n  end\n");
    if (alike)
      {
        const auto soft = text.find("set Section = soft");
        text.replace(soft, 18, "set Section = stiff");
      }
    return text;
  };
  expect_steady(rotor("hingeless", Turned::by_joint));
  expect_steady(on_mount("1e6, 1e6, 1e6", true));
  expect_unsteady(on_mount("1e6, 1e6, 1e6", false), {"the equilibrium changes", "<mount>", "out of balance"});
  expect_unsteady(on_mount("1e6, 2e6, 1e6", false), {"the equilibrium changes", "<mount>"});
}



// A slow shaft behind a gear: weight along the fast one acts across it.
TEST(SteadyLoads, SlowShaft)
{
  const auto model = [](const std::string &weight) {
    return "set Analyses = static, modal\nsubsection Bodies\n subsection fast\n set Type = rigid body\n set Mass = 1\n"
           " set Inertia = 1, 1, 1\n end\n subsection slow\n set Type = rigid body\n set Mass = 2\n"
           " set Inertia = 1, 1, 1\n set Position = 1, 0.1, 0\n end\nend\nsubsection Joints\n subsection input\n"
           " set Type = revolute\n set Body A = ground\n set Body B = fast\n end\n subsection output\n"
           " set Type = revolute\n set Body A = ground\n set Body B = slow\n set Position = 1, 0, 0\n"
           " set Axis = 1, 0, 0\n end\n subsection wheels\n set Type = gear\n set Joint A = input\n set Joint B = output\n"
           " set Ratio = 0.01\n end\nend\nsubsection Loads\n subsection turning\n set Type = steady rotation\n"
           " set Joint = input\n set Speed = 100\n end\n subsection load\n" +
           gravity + weight + "\n end\nend\nsubsection Modal\n set Modes = 1\nend\n";
  };
  expect_steady(model("-9.81, 0, 0")); // nothing lies off the axis of the fast one
  expect_unsteady(model("0, 0, -9.81"), {"the moment of a drive", "as <load> changes by up to", "on <slow>"});
}
