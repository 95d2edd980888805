// Controls keep their values: they are no modes, and what they prescribe stays where it is.
//
// Reference: closed forms of a mass on a spring in rotation, and of a blade that flaps behind an offset hinge.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  /** A ball of 1 kg on 100 N/m, on a cart that turns at 1 rad/s and is lifted by a control. */
  const std::string lifted = R"(
set Analyses = static, modal
subsection States
  subsection u
    set Type = control
    set Unit = m
  end
  subsection unused
    set Type = control
  end
end
subsection Bodies
  subsection hub
    set Type    = rigid body
    set Mass    = 1 kg
    set Inertia = 1, 1, 1
  end
  subsection cart
    set Type    = rigid body
    set Mass    = 1 kg
    set Inertia = 1, 1, 1
  end
  subsection ball
    set Type    = rigid body
    set Mass    = 1 kg
    set Inertia = 1, 1, 1
  end
end
subsection Joints
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = hub
    subsection rotation
      set Prescribed = 1 rad/s*t
    end
  end
  subsection lift
    set Type   = prismatic
    set Body A = hub
    set Body B = cart
    subsection displacement
      set Prescribed = u
    end
  end
  subsection slide
    set Type   = prismatic
    set Body A = cart
    set Body B = ball
    set Axis   = 1, 0, 0
    subsection displacement
      set Spring = 100 N/m
    end
  end
end
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 1 rad/s
  end
end
)";

  void
  replace(std::string &text, const std::string &from, const std::string &to)
  {
    const auto place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
  }

  /** The plate of the shipped file by controls, and blades of 30 kg that flap behind hinges at 0.5 m. */
  std::string
  hover()
  {
    std::ostringstream shipped;
    shipped << std::ifstream(std::string(SAMARA_SOURCE_DIR) + "/prm/rotorcraft/swash_plate.prm").rdbuf();
    std::string text = shipped.str();
    replace(text, "set Analyses = dynamic", "set Analyses = static, modal");
    replace(text, "(0.01198 m)*up", "lift");
    replace(text, "(0.0172 rad)*up", "tilt_1");
    replace(text, "(0.0182 rad)*up", "tilt_2");
    replace(text,
            "    include parts/blade_of_plate.prm\n",
            "    include " + std::string(SAMARA_SOURCE_DIR) +
              "/prm/rotorcraft/parts/blade_of_plate.prm\n"
              "    subsection Bodies\n      subsection flapper\n        set Type     = rigid body\n"
              "        set Mass     = 30 kg\n        set Inertia  = 0.3, 50, 50\n        set Position = 3, 0, 0\n"
              "      end\n    end\n");
    replace(text,
            "    subsection Joints\n      subsection pitch\n",
            "    subsection Joints\n      subsection flap\n        set Type     = revolute\n"
            "        set Body A   = root\n        set Body B   = flapper\n        set Position = 0.5, 0, 0\n"
            "        set Axis     = 0, 1, 0\n      end\n      subsection pitch\n");
    return text + "subsection States\n"
                  "  subsection lift\n    set Type = control\n    set Unit = m\n    set Value = 0.01198\n  end\n"
                  "  subsection tilt_1\n    set Type = control\n    set Unit = rad\n  end\n"
                  "  subsection tilt_2\n    set Type = control\n    set Unit = rad\n  end\n"
                  "end\n";
  }
} // namespace



// k/m − Ω² of the ball alone, whether joints are held or free, and whatever value a trim has left the control with.
TEST(HeldControls, AreNoModes)
{
  for (const std::string hold : {"true", "false"})
    for (const double value : {0., 0.3})
      {
        SCOPED_TRACE(hold + ", " + std::to_string(value));
        Scene scene(lifted, {"Modal/Hold rotations = " + hold});
        scene.equilibrium();
        scene.context.state.states[1] = value;
        const auto modes              = scene.modes();
        ASSERT_EQ(modes.size(), 1u) << scene.stream.str();
        EXPECT_NEAR(modes[0].frequency(), std::sqrt(99.), 1e-9);
        EXPECT_NEAR(modes[0].lambda.real(), 0., 1e-9);
      }
}



// Where the plate stays, all blades are alike, at the pitch θ of the links: ω² I = Ω² (m e s + (I − I_x) cos² θ).
TEST(HeldControls, LeaveHoverModesThoughATiltWouldMakeItPeriodic)
{
  for (const std::string n_modes : {"4", "10"})
    {
      Scene scene(hover(), {"Modal/Modes = " + n_modes});
      scene.equilibrium();
      const auto modes = scene.modes();
      ASSERT_EQ(modes.size(), 4u) << scene.stream.str();
      const double theta = scene.value("blade 2:pitch.rotation") * M_PI / 180, m = 30, s = 2.5, e = 0.5,
                   I = 50 + m * s * s;
      EXPECT_GT(std::abs(theta), 0.05);
      for (const auto &mode : modes)
        EXPECT_NEAR(mode.frequency(), 27 * std::sqrt((m * e * s + (I - 0.3) * std::pow(std::cos(theta), 2)) / I), 1e-6);
    }
}
