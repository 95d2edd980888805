// Rotors on shafts. Turned by a joint with all that it carries, a rotor has the modes it has when ground and all turn:
// the equations are the same, so that frequencies agree to round-off. Closed form: a teetering rotor without undersling
// tilts at its own speed, if its blades are thin.

#include "../scene.h"
#include <gtest/gtest.h>

#include "modes.h"
#include "rotors.h"

using namespace samara;

TEST(Rotors, ByJointAsByTheWholeModel)
{
  for (const std::string kind : {"hinged", "teetering", "hingeless"})
    for (const std::string omega : {"10", "30", "60"})
      {
        Scene      by_joint(rotor(kind, Turned::by_joint), {"Constants/Omega = " + omega});
        Scene      whole(rotor(kind, Turned::as_a_whole), {"Constants/Omega = " + omega});
        const auto a = frequencies(by_joint), b = frequencies(whole);
        ASSERT_EQ(a.size(), b.size());
        for (unsigned int i = 0; i < a.size(); ++i)
          EXPECT_NEAR(a[i], b[i], 1e-8 * b[i]) << kind << " at " << omega << ", mode " << i + 1;
        for (const std::string probe :
             {"blade 1.end.displacement x", "blade 1.start.force 1", "blade 2.end.velocity y"})
          EXPECT_NEAR(by_joint.value(probe), whole.value(probe), 1e-8 * std::abs(whole.value(probe)))
            << kind << ", " << probe;
        if (kind == "teetering")
          {
            const double speed = std::stod(omega);
            // rotary inertia of the sections over that of the rotor: 1e-4
            EXPECT_TRUE(std::any_of(a.begin(), a.end(), [=](double f) { return std::abs(f - speed) < 1e-4 * speed; }));
          }
      }
}



// The blade's first flap bending of a model rotor with free hinges at its root: a turning shaft carries it along.
// Compared with the same blade where ground and all turn.
TEST(Rotors, BladeOnAShaft)
{
  std::ifstream     file(SAMARA_SOURCE_DIR "/prm/rotorcraft/model_blade.prm");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto        with = [](std::string result, const std::string &old, const std::string &replacement) {
    return result.replace(result.find(old), old.size(), replacement);
  };
  const std::string turning = with(text, "model_blade.csv", SAMARA_SOURCE_DIR "/prm/rotorcraft/model_blade.csv");
  // ground and all: the shaft is held
  Scene      by_joint(turning), held(with(with(turning, "set Joint = shaft", ""), "= revolute", "= rigid"));
  const auto a = frequencies(by_joint), b = frequencies(held);
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], 1e-7 * b[i]);
  EXPECT_TRUE(std::any_of(a.begin(), a.end(), [](double f) { return std::abs(f - 185.8) < 0.05; }));
}



// Modes of a universal joint on a bend would be those of one moment: refused, with the rate that varies, unless
// allowed.
TEST(Rotors, NoModesOfAMotionThatIsNotSteady)
{
  const std::string text = R"(
set Analyses = modal
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
  end
  subsection out
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
    set Position = 0.25, 0, 0.4330127018922193
  end
end
subsection Joints
  subsection shaft
    set Type = revolute
    set Body A = ground
    set Body B = hub
  end
  subsection cross
    set Type = universal
    set Body A = hub
    set Body B = out
    set Position = 0, 0, 0
    set Axis = 0, 1, 0
    set Second axis = 0.8660254037844387, 0, -0.5
  end
  subsection bearing
    set Type = flexible joint
    set Body A = ground
    set Body B = out
    set Axis = 0.5, 0, 0.8660254037844387
    set Stiffness = 0, 1e6, 1e6
    set Rotational stiffness = 0, 1e5, 1e5
  end
end
subsection Loads
  subsection turning
    set Type = steady rotation
    set Joint = shaft
    set Speed = 10
  end
end
subsection Modal
  set Modes = 1
end
)";
  Scene             refused(text);
  try
    {
      refused.modes();
      FAIL() << "modes of one moment";
    }
  catch (const InputError &problem)
    {
      const std::string what = problem.what();
      EXPECT_NE(what.find("<bearing.rotation 1> goes from 8.66 to 11.5"), std::string::npos) << what;
      EXPECT_NE(what.find("Unsteady motion = allow"), std::string::npos) << what;
    }
  Scene allowed(text, {"Modal/Unsteady motion = allow"});
  EXPECT_NO_THROW(allowed.modes());
}
