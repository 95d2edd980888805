#ifndef samara_tests_aero_models_h
#define samara_tests_aero_models_h

#include <cmath>
#include <string>

namespace samara::aero_models
{
  /** Air with a wind, inertial components [m/s]. */
  inline std::string
  air(const std::string &wind, const std::string &more = "")
  {
    return "  subsection air\n    set Type = air\n    set Wind = " + wind + "\n" + more + "  end\n";
  }

  inline std::string
  subsection(const std::string &name, const std::string &content)
  {
    return "subsection " + name + "\n" + content + "end\n";
  }

  /** A section that stalls, depends on the Mach number and pitches. */
  inline std::string
  airfoils()
  {
    return subsection("Airfoils", R"(
  subsection plain
    set Type   = analytic
    set Drag   = 0.01, 0.02, 0.5
    set Moment = -0.02, 0.1
  end
  subsection full
    set Type            = analytic
    set Zero-lift angle = -3 deg
    set Drag            = 0.01, 0, 0.4
    set Moment          = -0.05, 0.2
    set Compressible    = true
    set Stall angle     = 14 deg
    set Stall width     = 2 deg
  end
)");
  }

  /** A curved, twisted, elastic blade on the ground, with @p entries of its surface. */
  inline std::string
  blade(const std::string &aerodynamics, const std::string &entries)
  {
    return R"(
subsection Sections
  subsection bar
    set Type    = rectangle
    set E       = 2e7
    set Density = 800
    set Width 2 = 0.2
    set Width 3 = 0.05
  end
end
subsection Bodies
  subsection blade
    set Type        = beam
    set Shape       = expressions
    set Expressions = 3*s, 0.3*s^2, 0.2*s^2
    set Section     = bar
    set Elements    = 2
    set Twist       = 0.3 - 0.05*s
  end
  subsection hub
    set Type     = rigid body
    set Mass     = 3
    set Inertia  = 1, 1, 2
    set Position = -0.2, 0, 0.1
    set Rotation = 0.2, 0.1, -0.1
    set Frames   = off at -0.1 0.05 0.2
  end
end
subsection Joints
  subsection root
    set Type   = spherical
    set Body A = hub.off
    set Body B = blade.start
    set Gap    = allowed
  end
end
)" + airfoils() +
           subsection("Aerodynamics", aerodynamics) +
           subsection("Surfaces", subsection("it", "    set Body = blade\n" + entries));
  }

  /** A rigid body that carries a straight wing of 4 m, leading edge to −x, from y = −1 to 3. */
  inline std::string
  rigid_wing(const std::string &aerodynamics, const std::string &entries, const std::string &body = "")
  {
    return R"(
subsection Bodies
  subsection wing
    set Type    = rigid body
    set Mass    = 5
    set Inertia = 2, 1, 2.5
)" + body + "  end\nend\n" +
           airfoils() + subsection("Aerodynamics", aerodynamics) +
           subsection(
             "Surfaces",
             subsection("it",
                        "    set Body = wing\n    set Line = 0, -1, 0; 0, 3, 0\n    set Leading edge = -1, 0, 0\n"
                        "    set Upper side = 0, 0, 1\n" +
                          entries));
  }

  /** Blades from 0.6 to 3 m, as many as wanted, on a body that turns at 30 rad/s about z, in the inflow <flow>. */
  inline std::string
  turning_rotor(const unsigned int n,
                const std::string &blade,
                const std::string &airfoils,
                const std::string &aerodynamics)
  {
    const auto at = [](const double x, const double y) {
      const auto text = [](const double z) { return number_to_text(std::abs(z) < 1e-15 ? 0. : z); };
      return text(x) + ", " + text(y) + ", 0";
    };
    std::string surfaces;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double c = std::cos(2 * M_PI * k / n), s = std::sin(2 * M_PI * k / n);
        surfaces += subsection("blade " + std::to_string(k + 1),
                               "    set Body = rotor\n    set Line = " + at(0.6 * c, 0.6 * s) + "; " +
                                 at(3 * c, 3 * s) + "\n    set Leading edge = " + at(-s, c) +
                                 "\n    set Inflow = flow\n    set Unsteady = quasi-steady\n" + blade);
      }
    return R"(
subsection Bodies
  subsection rotor
    set Type    = rigid body
    set Mass    = 5
    set Inertia = 2, 2, 4
  end
end
subsection Joints
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = rotor.centre
    set Axis   = 0, 0, 1
  end
end
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 30
  end
end
)" + airfoils +
           subsection("Aerodynamics", aerodynamics) + subsection("Surfaces", surfaces);
  }

  /** Four blades of it; hub, inflow and wind as given. */
  inline std::string
  four_bladed_rotor(const std::string &inflow,
                    const std::string &hub,
                    const std::string &wind = "0, 0, 0",
                    const std::string &more = "")
  {
    return turning_rotor(
      4,
      "    set Chord = 0.2\n    set Twist = 10 deg - 1.2 deg*s\n    set Airfoils = plain\n" + more,
      airfoils(),
      air(wind) + subsection("flow", "    set Type = " + inflow + "\n    set Hub = " + hub + "\n    set Radius = 3\n"));
  }

  /** A body that turns at 30 rad/s about z, for Bodies. */
  inline std::string
  turning_hub(const std::string &name)
  {
    return "  subsection " + name + R"(
    set Type             = rigid body
    set Mass             = 5
    set Inertia          = 1, 1, 2
    set Angular velocity = 0, 0, 30
  end
)";
  }

  /** What drives it at this speed, for Joints. */
  inline std::string
  driven_shaft(const std::string &hub)
  {
    return R"(
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = )" +
           hub + R"(.centre
    set Axis   = 0, 0, 1
    subsection rotation
      set Prescribed = 30*t
    end
  end
)";
  }

  /** A hub that is driven at 30 rad/s about z, and a blade on a hinge <@p hinge> with @p motion, 0.2 m from it. */
  inline std::string
  blade_on_driven_hub(const std::string &hinge, const std::string &axis, const std::string &motion)
  {
    return "subsection Bodies\n" + turning_hub("hub") + R"(  subsection blade
    set Type             = rigid body
    set Mass             = 3
    set Inertia          = 0.01, 1.5, 1.5
    set Position         = 1.6, 0, 0
    set Angular velocity = 0, 0, 30
    set Velocity         = 0, 48, 0
  end
end
subsection Joints)" +
           driven_shaft("hub") + "  subsection " + hinge + R"(
    set Type     = revolute
    set Body A   = hub.centre
    set Body B   = blade.centre
    set Position = 0.2, 0, 0
    set Axis     = )" +
           axis + "\n    subsection rotation\n      " + motion + "\n    end\n  end\nend\n";
  }

} // namespace samara::aero_models

#endif
