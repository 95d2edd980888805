// A hub whose axis is off by a millionth turns with its blades all the same; one that stands still does not.
//
// Reference: the same rotor with both on one axis.

#include "../said_by.h"
#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  /** Blades on a rotor about z, inflow by a hub on an axis of its own, with equal speeds. */
  std::string
  rotor_beside_its_hub(const std::string &axis,
                       const std::string &speed_of_hub,
                       const std::string &inflow = "Peters-He inflow")
  {
    return R"(
set Analyses = static
subsection Bodies
  subsection rotor
    set Type    = rigid body
    set Mass    = 5
    set Inertia = 2, 2, 4
  end
  subsection hub
    set Type    = rigid body
    set Mass    = 1
    set Inertia = 1, 1, 1
  end
end
subsection Joints
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = rotor
  end
  subsection other
    set Type   = revolute
    set Body A = ground
    set Body B = hub
    set Axis   = )" +
           axis + R"(
  end
end
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 30 rad/s
  end
  subsection turning beside
    set Type  = steady rotation
    set Joint = other
    set Speed = )" +
           speed_of_hub + R"(
  end
end
subsection Airfoils
  subsection section
    set Type = analytic
    set Drag = 0.01, 0, 0.5
  end
end
subsection Aerodynamics
  subsection air
    set Type = air
  end
  subsection flow
    set Type      = )" +
           inflow + R"(
    set Hub       = hub.centre
    set Radius    = 3 m
  end
end
subsection Surfaces
  subsection blade 1
    set Body         = rotor
    set Line         = 0.6, 0, 0; 3, 0, 0
    set Leading edge = 0, 1, 0
    set Chord        = 0.2 m
    set Twist        = 8 deg
    set Airfoils     = section
    set Unsteady     = quasi-steady
    set Inflow       = flow
  end
  subsection blade 2
    set Copy of      = blade 1
    set Line         = -0.6, 0, 0; -3, 0, 0
    set Leading edge = 0, -1, 0
  end
end
)";
  }
} // namespace



TEST(LeaningHub, HasTheThrustOfAStraightOne)
{
  for (const std::string inflow : {"uniform inflow", "Pitt-Peters inflow", "Peters-He inflow", "annular inflow"})
    {
      Scene straight(rotor_beside_its_hub("0, 0, 1", "30 rad/s", inflow));
      straight.equilibrium();
      const double thrust = straight.value("flow.thrust");
      EXPECT_GT(thrust, 100);
      EXPECT_EQ(straight.stream.str().find("changes as parts turn"), std::string::npos) << inflow;
      for (const std::string axis : {"4e-7, 0, 1", "1e-4, 0, 1"})
        {
          Scene leaning(rotor_beside_its_hub(axis, "30 rad/s", inflow));
          leaning.equilibrium();
          EXPECT_NEAR(leaning.value("flow.thrust"), thrust, 1e-6 * thrust) << inflow << ' ' << axis;
          // the mean flow alone knows no azimuth
          if (inflow != "uniform inflow")
            EXPECT_NE(leaning.stream.str().find("changes as parts turn"), std::string::npos) << inflow << ' ' << axis;
        }
    }
}



TEST(LeaningHub, ThatStandsStillIsRefused)
{
  Scene             scene(rotor_beside_its_hub("0, 0, 1", "0 rad/s"));
  const std::string said = said_by<InputError>([&]() { scene.equilibrium(); });
  EXPECT_NE(said.find("does not turn with its blades"), std::string::npos) << said;
}
