#ifndef samara_tests_catalogue_analysis_models_h
#define samara_tests_catalogue_analysis_models_h

#include <regex>
#include <string>

/** Small models in which the entries of one analysis have something to say. */
namespace samara::models
{
  /** A shallow arch of two bars, springs, under a weight that may or may not push it through. */
  inline std::string
  arch(const double weight)
  {
    return R"(
set Analyses = static
subsection Bodies
  subsection top
    set Type     = rigid body
    set Mass     = )" +
           std::to_string(weight) + R"(
    set Inertia  = 1, 1, 1
    set Position = 0, 0, 0.3
  end
end
subsection Joints
  subsection slide
    set Type   = prismatic
    set Body A = ground
    set Body B = top
    set Axis   = 0, 0, 1
  end
  subsection left
    set Type     = spring
    set Body A   = ground
    set Position = -1, 0, 0
    set Body B   = top
    subsection length
      set Spring = 1000
    end
  end
  subsection right
    set Type     = spring
    set Body A   = ground
    set Position = 1, 0, 0
    set Body B   = top
    subsection length
      set Spring = 1000
    end
  end
end
subsection Loads
  subsection weight
    set Type         = gravity
    set Acceleration = 0, 0, -1
  end
end
subsection Output
  set Probes = top.displacement z
end
)";
  }

  /** A hinge with a spring, on which functions of time act. */
  const std::string oscillator = R"(
set Analyses = dynamic
subsection Bodies
  subsection b
    set Type     = rigid body
    set Mass     = 1
    set Inertia  = 0.1, 0.1, 0.1
    set Position = 1, 0, 0
  end
end
subsection Joints
  subsection h
    set Type     = revolute
    set Body A   = ground
    set Body B   = b
    set Position = 0, 0, 0
    set Axis     = 0, 1, 0
    subsection rotation
      set Spring = 100
      set Moment = 10*sin(5*t) + 3
    end
  end
end
subsection Loads
  subsection g
    set Type = gravity
  end
end
subsection Output
  set Probes = h.rotation
end
subsection Dynamic
  set End time = 0.2
  set Step     = 0.05
  set Pictures = 0
end
)";

  /** Two arms on lag hinges of a hub that turns, with moments once a turn, and something that turns twice as fast. */
  const std::string turning_arms = R"(
set Analyses = floquet
subsection Bodies
  subsection hub
    set Type = rigid body
  end
  subsection arm 1
    set Type     = rigid body
    set Mass     = 1
    set Inertia  = 0.1, 0.1, 0.1
    set Position = 1, 0, 0
  end
  subsection arm 2
    set Copy of  = arm 1
    set Position = -1, 0, 0
  end
  subsection top
    set Copy of          = arm 1
    set Position         = 0, 0, 1
    set Angular velocity = 0, 0, 10
  end
end
subsection Joints
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = hub
    subsection rotation
      set Prescribed = 5*t
    end
  end
  subsection lag 1
    set Type     = revolute
    set Body A   = hub
    set Body B   = arm 1
    set Position = 0.2, 0, 0
    subsection rotation
      set Damper = 2
      set Moment = 0.3*sin(5*t)
    end
  end
  subsection lag 2
    set Type     = revolute
    set Body A   = hub
    set Body B   = arm 2
    set Position = -0.2, 0, 0
    subsection rotation
      set Damper = 2
      set Moment = -0.3*sin(5*t)
    end
  end
  subsection spin
    set Type   = revolute
    set Body A = ground
    set Body B = top
    subsection rotation
      set Prescribed = 10*t
    end
  end
end
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 5
  end
end
subsection Floquet
  set Turns of   = shaft
  set Steps      = 8
  set Symmetry   = arm 1, arm 2; lag 1, lag 2
  set Turning    = hub, shaft, top, spin
  set Animations = 0
end
)";

  /** The same, for a state space. */
  const std::string periodic_arms =
    std::regex_replace(turning_arms, std::regex("= floquet"), "= periodic linear system") +
    "subsection States\n subsection push\n set Type = control\n end\n subsection pull\n set Type = control\n end\nend\n"
    "subsection Periodic linear system\n set Period = 0.4*pi\n set Samples = 8\n set Steps = 2\n set Largest gap = 1\n"
    " set Symmetry = arm 1, arm 2; lag 1, lag 2\n set Turning = hub, shaft, top, spin\nend\n"
    "subsection Output\n set Probes = lag 1.rotation\nend\n";

  /** The same, for the loads on its shaft. */
  const std::string turning_loads =
    std::regex_replace(turning_arms, std::regex("= floquet"), "= harmonics") +
    "subsection Harmonics\n set Period = 0.4*pi\n set Loads of = shaft\n set Steps = 24\n set Harmonics = 3\n"
    " set Largest gap = 100\nend\n";

  /** A rotor on the ground with a body that wobbles, for modes. */
  const std::string rotor = R"(
set Analyses = static, modal
subsection Bodies
  subsection disk
    set Type     = rigid body
    set Mass     = 2
    set Inertia  = 1, 1.2, 2
  end
  subsection tip
    set Type     = rigid body
    set Mass     = 1
    set Inertia  = 0.1, 0.2, 0.3
    set Position = 1, 0, 0
  end
end
subsection Joints
  subsection shaft
    set Type   = revolute
    set Body A = ground
    set Body B = disk
  end
  subsection root
    set Type                 = flexible joint
    set Body A               = disk
    set Body B               = tip
    set Stiffness            = 1e3, 1e3, 1e3
    set Rotational stiffness = 1e2, 2e2, 3e2
  end
end
subsection Loads
  subsection turn
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 5
  end
end
)";

  /** A disk with a tip on a flexible joint, which two controls push. */
  const std::string pushed_rotor =
    std::regex_replace(std::regex_replace(rotor, std::regex("modal"), "linear system"),
                       std::regex("subsection Loads\n"),
                       "subsection Loads\n  subsection at tip\n    set Type = point load\n    set At = tip\n"
                       "    set Force = 0, 0, push - 2*pull\n  end\n") +
    R"(
subsection States
  subsection push
    set Type = control
    set Unit = N
  end
  subsection pull
    set Copy of = push
  end
end
subsection Output
  set Probes = tip.displacement z, tip.displacement x
end
)";

  /** A mass on a hard spring that is shaken by two controls. */
  const std::string shaken = R"(
set Analyses = trim, dynamic
subsection States
  subsection push
    set Type = control
    set Unit = N
  end
  subsection swing
    set Type  = control
    set Unit  = N
    set Value = 0.1
  end
end
subsection Bodies
  subsection mass
    set Type    = rigid body
    set Mass    = 2
    set Inertia = 1, 1, 1
  end
end
subsection Joints
  subsection slide
    set Type   = prismatic
    set Body A = ground
    set Body B = mass.centre
    set Axis   = 1, 0, 0
    subsection displacement
      set Damper = 20
      set Force  = push + swing*cos(2*pi*t/(1 s)) - 200 N/m*slide.displacement - 1e6 N/m^3*slide.displacement^3
    end
  end
end
subsection Trim
  set Controls = push, swing from -5 N to 5 N
  set Targets  = slide.displacement = 1 mm, cos 1 of slide.displacement = 1 mm
  set Period   = 1 s
  set Steps    = 12
end
subsection Dynamic
  set End time = 0.2
  set Step     = 0.1
  set Pictures = 0
end
subsection Output
  set Probes = slide.displacement, push, swing
end
)";
} // namespace samara::models

#endif
