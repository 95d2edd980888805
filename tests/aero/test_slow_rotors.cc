// Air has no speed of its own as long as it is not compressed: a rotor that hovers slowly is one that hovers fast. Its
// thrust and torque are those of Ω², exactly, and so is the inflow of annular momentum those of Ω.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** Three rigid blades on a hub, of radius 6 m. */
  std::string
  slow_rotor(const std::string &speed)
  {
    return R"(
set Analyses = static
subsection Bodies
  subsection hub
    set Type    = rigid body
    set Mass    = 10
    set Inertia = 1, 1, 1
  end
end
subsection Subsystems
  subsection b
    set Copies = 3 about z
    subsection Bodies
      subsection blade
        set Type     = rigid body
        set Mass     = 10
        set Inertia  = 1, 10, 10
        set Position = 3, 0, 0
      end
    end
    subsection Surfaces
      subsection air
        set Body         = blade
        set Line         = 0.6, 0, 0; 6, 0, 0
        set Leading edge = 0, 1, 0
        set Upper side   = 0, 0, 1
        set Chord        = 0.4
        set Twist        = 8 deg
        set Stations     = 12
        set Airfoils     = profile
        set Unsteady     = quasi-steady
        set Inflow       = flow
      end
    end
    subsection Joints
      subsection root
        set Type   = rigid
        set Body A = hub
        set Body B = blade
        set Gap    = allowed
      end
    end
  end
end
subsection Joints
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = hub
    set Axis   = 0, 0, 1
  end
end
subsection Airfoils
  subsection profile
    set Type = analytic
  end
end
subsection Aerodynamics
  subsection air
    set Type = air
  end
  subsection flow
    set Type   = annular inflow
    set Hub    = hub.centre
    set Axis   = 0, 0, 1
    set Radius = 6
  end
end
subsection Loads
  subsection spin
    set Type  = steady rotation
    set Joint = shaft
    set Speed = )" +
           speed + "\n  end\nend\n";
  }
} // namespace



TEST(SlowRotors, AnnularHoverGrowsWithTheSquareOfTheSpeed)
{
  const auto thrust_and_torque = [](const std::string &speed) {
    Scene scene(slow_rotor(speed));
    scene.equilibrium();
    const double square = std::pow(std::stod(speed), 2);
    return std::pair(scene.value("shaft.force 3") / square, scene.value("shaft.moment 3") / square);
  };
  const auto fast = thrust_and_torque("10");
  EXPECT_GT(std::abs(fast.first), 10);
  for (const std::string speed : {"0.1", "0.01", "0.001"})
    {
      const auto slow = thrust_and_torque(speed);
      EXPECT_NEAR(slow.first / fast.first, 1, 1e-7) << speed;
      EXPECT_NEAR(slow.second / fast.second, 1, 1e-7) << speed;
    }
}
