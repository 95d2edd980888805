// Steady motion driven at a joint and passed on by flexible couplings, a flexible shaft and gears: speeds of the
// followers are exact, to the round-off of stiffnesses that lie far apart (1e-10).

#include "../scene.h"

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** Drive, coupling, flexible shaft, coupling, pinion about x; a gear to a wheel about y, another to a rotor about z. */
  const std::string train = R"(
set Analyses = static, modal
subsection Sections
  subsection rod
    set Type = tube
    set E = 70 GPa
    set Density = 2700 kg/m^3
    set Outer radius = 20 mm
    set Inner radius = 15 mm
  end
end
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 1
    set Inertia = 0.1, 0.1, 0.1
  end
  subsection shaft
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Section = rod
    set Elements = 3
  end
  subsection pinion
    set Type = rigid body
    set Position = 1, 0, 0
  end
  subsection wheel
    set Type = rigid body
    set Position = 1, 0, 0
    set Mass = 2
    set Inertia = 0.2, 0.4, 0.2
  end
  subsection rotor
    set Type = rigid body
    set Position = 1, 1, 0
    set Mass = 2
    set Inertia = 0.3, 0.3, 0.6
  end
end
subsection Joints
  subsection drive
    set Type = revolute
    set Body A = ground
    set Body B = hub.centre
    set Axis = 1, 0, 0
  end
  subsection coupling 1
    set Type = flexible joint
    set Body A = hub.centre
    set Body B = shaft.start
    set Axis = 1, 0, 0
    set Stiffness = 1e5, 1e6, 1e6
    set Rotational stiffness = 1e3, 1e3, 1e3
    set Damping = 1, 10, 10
    set Rotational damping = 1, 0, 0
  end
  subsection coupling 2
    set Copy of = coupling 1
    set Body A = pinion.centre
    set Body B = shaft.end
  end
  subsection in
    set Type = revolute
    set Body A = ground
    set Body B = pinion.centre
    set Axis = 1, 0, 0
  end
  subsection between
    set Type = revolute
    set Body A = ground
    set Body B = wheel.centre
    set Axis = 0, 1, 0
  end
  subsection out
    set Type = revolute
    set Body A = ground
    set Body B = rotor.centre
    set Axis = 0, 0, 1
  end
  subsection first gear
    set Type = gear
    set Joint A = in
    set Joint B = between
    set Ratio = 0.5
  end
  subsection second gear
    set Type = gear
    set Joint A = between
    set Joint B = out
    set Ratio = -3
  end
end
subsection Loads
  subsection speed
    set Type = steady rotation
    set Joint = drive
    set Speed = 40
  end
end
)";
} // namespace



// Followers turn at exact speeds: the shaft and the pinion at 40, the wheel at 20 about y, the rotor at −60 about z
// rad/s.
TEST(SteadyMotion, ThroughCouplingsAndGears)
{
  Scene        scene(train);
  const State &state = scene.equilibrium();
  const auto   spin  = [&](const std::string &body) {
    return Vector3(scene.value(body + ".angular velocity x"),
                   scene.value(body + ".angular velocity y"),
                   scene.value(body + ".angular velocity z"));
  };
  for (const std::string body : {"hub", "pinion", "shaft.start", "shaft.middle", "shaft.end"})
    EXPECT_LT((spin(body) - Vector3(40, 0, 0)).norm(), 40e-10) << body;
  EXPECT_LT((spin("wheel") - Vector3(0, 20, 0)).norm(), 40e-10);
  EXPECT_LT((spin("rotor") - Vector3(0, 0, -60)).norm(), 60e-10);
  EXPECT_NEAR(scene.value("out.rotation rate"), -60, 60e-10);
  const double J_rod = 2700 * M_PI / 2 * (std::pow(0.02, 4) - std::pow(0.015, 4));
  EXPECT_NEAR(scene.system.energy(state).kinetic, 0.5 * ((0.1 + J_rod) * 1600 + 0.4 * 400 + 0.6 * 3600), 1e-6);
}



// What nothing drives stays at rest: without the first gear, the wheel and the rotor.
TEST(SteadyMotion, StopsWhereNothingDrives)
{
  std::string text = train;
  const auto  gear = text.find("  subsection first gear"), next = text.find("  subsection second gear");
  text.erase(gear, next - gear);
  // two wheels free to turn have no stiffness; they are held
  text.insert(text.rfind("end\n"), "  subsection hold\n set Type = steady rotation\n set Joint = out\n end\n");
  Scene scene(text);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("pinion.angular velocity x"), 40, 40e-9);
  EXPECT_NEAR(scene.value("wheel.angular velocity y"), 0, 1e-9);
  EXPECT_NEAR(scene.value("rotor.angular velocity z"), 0, 1e-9);
}
