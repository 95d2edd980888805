#ifndef samara_tests_catalogue_models_h
#define samara_tests_catalogue_models_h

#include <string>

/** Small models in which the entries of one kind have something to say. */
namespace samara::models
{
  const std::string two_steps = "subsection Dynamic\n set End time = 0.02\n set Step = 0.01\n set Stages = 1\n"
                                " set Pictures = 0\nend\n";

  /** A body that flies. */
  const std::string rigid_body = R"(
set Analyses = dynamic
subsection Bodies
  subsection it
    set Type             = rigid body
    set Mass             = 2
    set Inertia          = 1, 1.5, 2
    set Position         = 0.3, -0.2, 0.1
    set Rotation         = 0.4, 0.2, -0.7
    set Frames           = end at 1 0.4 0.2
    set Angular velocity = 0.3, 0.2, -0.5
  end
end
subsection Loads
  subsection push
    set Type  = point load
    set At    = it.end
    set Force = 1, 2, 3
  end
end
subsection Output
  set Probes = it.end.position x, it.end.position y, it.centre.position z, it.centre of mass.velocity x
end
subsection Dynamic
  set End time = 0.02
  set Step     = 0.01
  set Stages   = 1
  set Pictures = 1
end
)";

  /** A beam that flies and is bent; its section is @p section. */
  inline std::string
  beam(const std::string &section)
  {
    return R"(
set Analyses = dynamic
subsection Sections
  subsection it
)" + section +
           R"(  end
  subsection other
    set Type         = tube
    set E            = 1e6
    set Density      = 1000
    set Outer radius = 0.05
  end
  subsection thick
    set Type         = tube
    set E            = 1e6
    set Density      = 1000
    set Outer radius = 0.06
  end
end
subsection Bodies
  subsection beam
    set Type     = beam
    set Points   = 0, 0, 0; 1, 0, 0.2
    set Section  = it
    set Elements = 2
    set Degree   = 2
    set Frames   = place at 0.5
  end
  subsection second
    set Type     = beam
    set Points   = 0, 1, 0; 1, 1, 0
    set Section  = other
    set Elements = 1
    set Degree   = 1
  end
end
subsection Loads
  subsection push
    set Type   = point load
    set At     = beam.end
    set Force  = 10, 20, 30
    set Moment = 3, 2, 1
  end
end
subsection Output
  set Probes = beam.place.position x, beam.end.position y, beam.end.position z, beam.place.rotation x, second.end.position z
end
subsection Dynamic
  set End time = 0.02
  set Step     = 0.01
  set Stages   = 1
  set Pictures = 1
end
)";
  }

  const std::string rectangle = "set Type = rectangle\n set E = 1e6\n set Density = 1000\n set Width 2 = 0.05\n"
                                " set Width 3 = 0.1\n";
  const std::string tube      = "set Type = tube\n set E = 1e6\n set Density = 1000\n set Outer radius = 0.05\n";
  const std::string engineering_constants =
    "set Type = engineering constants\n set EA = 1e4\n set GA2 = 5e3\n set GA3 = 4e3\n set GJ = 20\n set EI2 = 30\n"
    " set EI3 = 40\n set Mass = 2\n set I2 = 0.01\n set I3 = 0.02\n";
  const std::string matrices = "set Type = matrices\n set Stiffness = 1e4, 5e3, 4e3, 20, 30, 40\n"
                               " set Inertia = 2, 2, 2, 0.03, 0.01, 0.02\n";
  const std::string table    = "set Type = table\n set Stations = other at 0, other at 1\n";

  /** Two bodies and a joint <it> between them, both in motion. */
  inline std::string
  joint(const std::string &kind, const std::string &entries, const std::string &probes)
  {
    return R"(
set Analyses = dynamic
subsection Bodies
  subsection a
    set Type             = rigid body
    set Mass             = 2
    set Inertia          = 1, 1.5, 2
    set Position         = 0.3, -0.2, 0.1
    set Rotation         = 0.4, 0.2, -0.7
    set Frames           = end at 1 0.4 0.2, other at 0.2 0.5 1
    set Angular velocity = 0.3, 0.2, -0.5
  end
  subsection b
    set Type             = rigid body
    set Mass             = 3
    set Inertia          = 1, 1.5, 1
    set Position         = 2, 1, 1
    set Frames           = end at 1 0.4 0.2, far at 1 0.4 2.2, other at 1.5 0.2 0.3
    set Angular velocity = -0.2, 0.6, 0.1
  end
end
subsection Joints
  subsection it
    set Type   = )" +
           kind + "\n    set Body A = a.end\n    set Body B = b." +
           (kind == "spring" || kind == "distance" ? "far" : "end") + "\n" + entries + R"(
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
end
subsection Output
  set Probes = a.position x, a.position y, a.position z, b.rotation x, b.rotation y, b.position z)" +
           (probes.empty() ? "" : ", ") + probes + "\nend\n" + two_steps;
  }

  /** Two wheels on the ground, the first with a spring, and a gear <it> between them. */
  const std::string gear = R"(
set Analyses = dynamic
subsection Bodies
  subsection a
    set Type             = rigid body
    set Mass             = 2
    set Inertia          = 1, 1.5, 2
    set Angular velocity = 0, 0, 1
  end
  subsection b
    set Type     = rigid body
    set Mass     = 3
    set Inertia  = 1, 1.5, 1
    set Position = 2, 0, 0
  end
  subsection c
    set Type     = rigid body
    set Mass     = 1
    set Inertia  = 1, 1.5, 1
    set Position = 4, 0, 0
  end
end
subsection Joints
  subsection on a
    set Type   = revolute
    set Body A = ground
    set Body B = a
    subsection rotation
      set Moment = 1
    end
  end
  subsection on b
    set Type   = revolute
    set Body A = ground
    set Body B = b
  end
  subsection on c
    set Type   = revolute
    set Body A = ground
    set Body B = c
    subsection rotation
      set Moment = 3
    end
  end
  subsection it
    set Type    = gear
    set Joint A = on a
    set Joint B = on b
    set Ratio   = 2
  end
end
subsection Output
  set Probes = on a.rotation, on b.rotation, on c.rotation, it.moment
end
)" + two_steps;

  /** A soft blade, clamped or on a hinge about z; <it> is a load, added where it is wanted. */
  inline std::string
  blade(const std::string &load, const bool hinged = false)
  {
    return R"(
set Analyses = static
subsection Sections
  subsection section
    set Type         = rectangle
    set E            = 1e8
    set Density      = 1000
    set Width 2      = 0.05
    set Width 3      = 0.1
  end
end
subsection Bodies
  subsection blade
    set Type     = beam
    set Points   = 0.1, 0, 0; 1, 0, 0
    set Section  = section
    set Elements = 2
    set Degree   = 2
  end
  subsection second
    set Type     = beam
    set Points   = 0, 1, 0; 1, 1, 0
    set Section  = section
    set Elements = 1
    set Degree   = 2
  end
  subsection plate
    set Type      = shell
    set Patches   = u, 2 + 0.5*v, 0
    set Elements  = 1, 1
    set Degree    = 2
    set E         = 1e8
    set Thickness = 0.05
  end
end
subsection Joints
  subsection root of the plate
    set Type  = support
    set Along = plate.edge u0
  end
  subsection root
    set Type     = )" +
           std::string(hinged ? "revolute" : "rigid") + R"(
    set Body A   = ground
    set Body B   = blade.start
    set Position = 0, 0, 0
  end
  subsection root of the second
    set Type   = rigid
    set Body A = ground
    set Body B = second.start
  end
end
subsection Loads
  subsection it
)" + load + R"(  end
end
subsection Output
  set Probes = blade.end.displacement x, blade.end.displacement y, blade.end.displacement z, second.end.displacement z, blade.end.position y
end
)";
  }

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
