/*
 * Problem:   a rotor with hinged blades, no spring anywhere and a damper on its shaft, whose motions are as slow as the
 *            speed of rotation says; what damps them is slower by 1e-4
 * Reference: flap ω² = Ω² (I − Iₓ + m e c)/I of a blade with the mass m, its centre c behind a hinge at e, the inertia
 * I about it and Iₓ about its length; the shaft decays with its damper over its inertia Expected:  nine digits at any
 * speed: no frequency is measured by a rad/s
 */

#include "../scene.h"
#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  constexpr double mass = 0.4, arm = 0.25, hinge = 0.16, about_centre = 7e-3, along = 2e-3, of_hub = 5, slowness = 1e-4;

  /** About the shaft. */
  double
  whole_inertia()
  {
    return of_hub + 2 * (about_centre + mass * (hinge + arm) * (hinge + arm));
  }

  /** Two blades on a shaft that turns with @p speed [rad/s], and is damped. */
  std::string
  slow_rotor(const double speed)
  {
    const auto        text  = [](const double x) { return number_to_text("%.17g", x); };
    const std::string blade = "    set Type           = rigid body\n    set Mass           = " + text(mass) +
                              "\n    set Inertia        = " + text(along) + ", " + text(about_centre) + ", " +
                              text(about_centre) + "\n    set Centre of mass = " + text(arm) + ", 0, 0\n";
    const std::string flap = "    set Type   = revolute\n    set Axis   = 0, 1, 0\n    set Body A = hub.";
    return "set Analyses = static, modal\n"
           "subsection Bodies\n"
           "  subsection hub\n    set Type    = rigid body\n    set Mass    = 3\n    set Inertia = 3, 3, " +
           text(of_hub) + "\n    set Frames  = right at " + text(hinge) + " 0 0, left at " + text(-hinge) +
           " 0 0\n  end\n"
           "  subsection blade 1\n" +
           blade + "    set Position = " + text(hinge) +
           ", 0, 0\n  end\n"
           "  subsection blade 2\n" +
           blade + "    set Position = " + text(-hinge) +
           ", 0, 0\n    set Rotation = 180 deg, 0, 0\n  end\n"
           "end\n"
           "subsection Joints\n"
           "  subsection shaft\n    set Type   = revolute\n    set Body A = ground\n    set Body B = hub\n"
           "    subsection rotation\n      set Damper = " +
           text(slowness * speed * whole_inertia()) +
           "\n    end\n  end\n"
           "  subsection flap 1\n" +
           flap +
           "right\n    set Body B = blade 1\n  end\n"
           "  subsection flap 2\n" +
           flap +
           "left\n    set Body B = blade 2\n  end\n"
           "end\n"
           "subsection Loads\n  subsection turning\n    set Type  = steady rotation\n    set Joint = shaft\n"
           "    set Speed = " +
           text(speed) +
           " rad/s\n  end\nend\n"
           "subsection Modal\n  set Modes      = 4\n  set Animations = 0\nend\n";
  }
} // namespace



TEST(SlowModels, HaveModesInProportionToTheirSpeed)
{
  const double inertia = about_centre + mass * arm * arm,
               flap    = std::sqrt((inertia - along + mass * hinge * arm) / inertia);
  for (const double speed : {20., 2e-2, 2e-5, 2e-8, 2e7})
    {
      Scene scene(slow_rotor(speed));
      scene.equilibrium();
      const auto &modes = scene.modes();
      ASSERT_EQ(modes.size(), 4u) << speed;
      EXPECT_TRUE(modes[0].is_free()) << speed; // the azimuth
      EXPECT_NEAR(modes[1].lambda.real() / speed, -slowness, 1e-7 * slowness) << speed;
      for (const unsigned int i : {2, 3})
        EXPECT_NEAR(modes[i].frequency() / speed, flap, 1e-9 * flap) << speed;
    }
}
