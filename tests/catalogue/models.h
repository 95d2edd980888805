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

  /** Two balls and a beam on a plane. */
  const std::string contacts = R"(
set Analyses = dynamic
subsection Sections
  subsection s
    set Type         = tube
    set E            = 1e6
    set Density      = 1000
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection a
    set Type     = rigid body
    set Mass     = 2
    set Inertia  = 1, 1.5, 2
    set Position = 0, 0, 0.19
    set Velocity = 1, 0, 0
  end
  subsection b
    set Type     = rigid body
    set Mass     = 3
    set Inertia  = 1, 1.5, 1
    set Position = 0.3, 0.2, 0.17
    set Velocity = -1, 0, -0.2
  end
  subsection rod
    set Type     = beam
    set Points   = 1, 0, 0.19; 2, 0.3, 0.19
    set Section  = s
    set Elements = 1
    set Velocity = 0.2, 0, -0.1
  end
end
subsection Joints
  subsection it
    set Type           = contacts
    set Balls          = a, b
    set Ball radius    = 0.2
    set Beams          = rod radius 0.2
    set Planes         = ground at 0 0 0 normal 0 0 1
    set Stiffness      = 100
    set Line stiffness = 100
    set Overlap        = allowed
    set Friction       = 0
  end
end
subsection Output
  set Probes = a.position x, a.position y, a.position z, b.rotation x, b.position z, rod.end.position z, it.depth
end
)" + two_steps;

  /** Two bodies that slide on a rod towards each other, and touch by the buffer <it>; others slide, too. */
  inline const std::string buffer = R"(
set Analyses = dynamic
subsection Sections
  subsection s
    set Type         = tube
    set E            = 1e9
    set Density      = 1000
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection rod
    set Type    = beam
    set Points  = 0, 0, 0; 2, 0, 0
    set Section = s
    set Rigid   = true
  end
  subsection b
    set Type     = rigid body
    set Mass     = 3
    set Inertia  = 1, 1, 1
    set Position = 0.5, 0, 0
    set Velocity = 1, 0, 0
  end
  subsection c
    set Copy of  = b
    set Position = 1, 0, 0
    set Velocity = 0, 0, 0
  end
  subsection d
    set Copy of  = c
    set Position = 1.5, 0, 0
  end
end
subsection Joints
  subsection at b
    set Type   = sliding sleeve
    set Body A = rod
    set Body B = b
  end
  subsection at c
    set Copy of = at b
    set Body B  = c
  end
  subsection at d
    set Copy of = at b
    set Body B  = d
  end
  subsection it
    set Type      = buffer
    set Joint A   = at b
    set Joint B   = at c
    set Length    = 0.5
    set Stiffness = 1000
  end
end
subsection Output
  set Probes = b.position x, c.position x, d.position x, it.gap, it.force
end
)" + two_steps;

  /** A beam that flies, and a body <b> that slides along it by the joint <it>. */
  inline std::string
  sliding(const std::string &kind, const std::string &entries)
  {
    return R"(
set Analyses = dynamic
subsection Sections
  subsection s
    set Type         = tube
    set E            = 1e6
    set Density      = 1000
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection rod
    set Type             = beam
    set Points           = 0, 0, 0; 1, 0.3, 0; 2, 0, 0.4
    set Shape            = arc
    set Section          = s
    set Angular velocity = 0.3, 0.2, -0.5
  end
  subsection other
    set Type             = beam
    set Points           = 0, 0.3, 0; 2, 0.3, 0
    set Section          = s
    set Angular velocity = 0.3, 0.2, 0.5
  end
  subsection b
    set Type             = rigid body
    set Mass             = 3
    set Inertia          = 1, 1.5, 1
    set Position         = 1, 0.3, 0
    set Frames           = arm at 1 0.3 0.3
    set Velocity         = 1, 0, 0
    set Angular velocity = -0.2, 0.6, 0.1
  end
end
subsection Joints
  subsection it
    set Type   = )" +
           kind + "\n    set Body A = rod\n    set Body B = b\n" + entries + R"(
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
end
subsection Output
  set Probes = b.position x, b.rotation y, rod.end.position z, it.displacement, it.force 2, it.force
end
)" + two_steps;
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
} // namespace samara::models

#endif
