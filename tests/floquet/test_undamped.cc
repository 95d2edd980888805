/*
 * Problem:   wind turbines without any damping, free in yaw, in their own weight
 * Reference: multipliers of what is conservative and reversible lie on the unit circle; free yaw has 1 twice, with one
 *            shape, which round-off and gaps move by their root
 */

#include <samara/analysis/floquet.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "floquet_models.h"

using namespace samara;

namespace
{
  /** Three blades on flap springs, on a nacelle on a spring in pitch. */
  std::string
  turbine_free_in_yaw(const std::string &spring, const std::string &speed)
  {
    return R"(
set Analyses = floquet
subsection Bodies
  subsection nacelle
    set Type = rigid body
    set Mass = 100
    set Inertia = 60, 50, 70
  end
  subsection hub
    set Type = rigid body
    set Mass = 10
    set Inertia = 1, 1, 1
    set Position = 1, 0, 0
  end
end
subsection Joints
  subsection tower
    set Type = universal
    set Body A = ground
    set Body B = nacelle
    set Axis = 0, 0, 1
    set Second axis = 0, 1, 0
    subsection rotation 2
      set Spring = 3e4
    end
  end
  subsection shaft
    set Type = revolute
    set Body A = nacelle
    set Body B = hub
    set Axis = 1, 0, 0
    set Position = 1, 0, 0
    subsection rotation
      set Prescribed = )" +
           speed + R"(*t
    end
  end
end
subsection Subsystems
  subsection blade
    set Copies = 3 about x
    subsection Bodies
      subsection blade
        set Type = rigid body
        set Mass = 5
        set Inertia = 3, 3, 0.05
        set Position = 1, 0, 2
      end
    end
    subsection Joints
      subsection flap
        set Type = revolute
        set Body A = hub
        set Body B = blade
        set Position = 1, 0, 0.2
        set Axis = 0, 1, 0
        subsection rotation
          set Spring = )" +
           spring + R"(
        end
      end
    end
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
  subsection turning
    set Type = steady rotation
    set Joint = shaft
    set Speed = )" +
           speed + R"(
  end
end
subsection Floquet
  set Turns of = shaft
  set Settle = 2
  set Animations = 0
  # at 8 rad/s the orbit closes to 1e-7 or to 1e-11, by what round-off of steps with 1e-12 and 1e-13 makes of a pair of ones
  set Newton tolerance = 1e-14
end
)";
  }
} // namespace



TEST(Undamped, IsCalledNeitherStableNorUnstable)
{
  for (const std::string speed : {"8", "9", "12"})
    {
      Scene scene(turbine_free_in_yaw("4000", speed));
      auto &floquet = scene.analysis<FloquetAnalysis>();
      floquet.run(scene.context);
      const std::string said = scene.stream.str();
      EXPECT_NE(said.find("neither stable nor unstable to first order"), std::string::npos) << said;
      ASSERT_GE(floquet.modes.size(), 5u) << said; // half of the columns: the yaw is free, in a pair of ones
      // what is told covers what there is
      for (const auto &mode : floquet.modes)
        EXPECT_LE(std::abs(std::abs(mode.multiplier) - 1), std::max(1e-6, mode.error)) << speed << said;
    }
}



// And what is known well is called by its name: Mathieu's pendulum grows with 0.0996 1/s less half of its damping.
TEST(Undamped, IsNoExcuseForWhatGrows)
{
  for (const std::string damping : {"0.21", "0.18"})
    {
      Scene scene(floquet_models::pendulum, {"Constants/c = " + damping, "Floquet/Animations = 0"});
      auto &floquet = scene.analysis<FloquetAnalysis>();
      floquet.run(scene.context);
      EXPECT_LT(floquet.modes.at(0).error, 1e-6);
      const std::string said = scene.stream.str(), word = damping == "0.18" ? "unstable" : "stable";
      EXPECT_NE(said.find("the motion is " + word + ":"), std::string::npos) << said;
    }
}
