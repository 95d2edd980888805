// Walls of different layups: a box of four patches, each with its own, bends and twists as the beam whose section has
// these walls. Caps of oblique plies couple bending and torsion, so that a layup on the wrong wall, fibres of the wrong
// sign, or a normal that points outwards would be seen. Its end is a rib: without one thin walls distort, and a torque
// that is shared among their edges turns it nearly three times as far.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const std::string walls_of_box = R"(
subsection Materials
  subsection carbon
    set Type    = orthotropic
    set E1      = 135e9
    set E2      = 9e9
    set G12     = 5e9
    set nu12    = 0.3
    set nu23    = 0.4
    set Density = 1580
  end
end
subsection Layups
  subsection lower
    set Plies = carbon, 0, 1 mm; carbon, 25, 1 mm
  end
  subsection upper
    set Plies = carbon, -25, 1.5 mm; carbon, 0, 0.5 mm
  end
  subsection web
    set Plies = carbon, 45, 0.5 mm; carbon, -45, 0.5 mm
  end
end
)";

  const std::string box_as_shell = R"(
subsection Bodies
  subsection box
    set Type         = shell
    set Patches      = 2*u, 0.0495*(2*v - 1), -0.029; 2*u, 0.0495, 0.029*(2*v - 1); \
                       2*u, 0.0495*(1 - 2*v), 0.029; 2*u, -0.0495, 0.029*(1 - 2*v)
    set Elements     = 6, 1
    set Degree       = 3
    set Patch layups = lower, web, upper, web
    set Axis 1       = 1, 0, 0
    set Rigid edges  = bottom at edge u1, right at patch 2 edge u1, top at patch 3 edge u1, left at patch 4 edge u1
  end
  subsection end
    set Type     = rigid body
    set Position = 2, 0, 0
    set Mass     = 1
    set Inertia  = 1, 1, 1
    set Frames   = bottom at 2 0 -0.029
  end
end
subsection Joints
  subsection root
    set Type  = support
    set Along = box.edge u0, box.patch 2 edge u0, box.patch 3 edge u0, box.patch 4 edge u0
  end
  subsection tip
    set Type   = rigid
    set Body A = box.bottom
    set Body B = end.bottom
  end
end
subsection Loads
  subsection tip
    set Type   = point load
    set At     = end
)";

  const std::string box_as_beam = R"(
subsection Sections
  subsection s
    set Type            = box
    set Width 2         = 100 mm
    set Width 3         = 60 mm
    set Layup           = web
    set Layup of bottom = lower
    set Layup of top    = upper
    set Degree          = 2
  end
end
subsection Bodies
  subsection box
    set Type    = beam
    set Points  = 0, 0, 0; 2, 0, 0
    set Axis 2  = 0, 1, 0
    set Section = s
  end
end
subsection Joints
  subsection root
    set Type   = rigid
    set Body A = ground
    set Body B = box.start
  end
end
subsection Loads
  subsection tip
    set Type   = point load
    set At     = box.end
)";

  /** Displacements and angles of the end under a load. */
  std::vector<double>
  end_of_box(const std::string &model, const std::string &body, const std::string &load)
  {
    Scene scene(walls_of_box + model + "    set " + load + "\n  end\nend\n");
    scene.equilibrium();
    std::vector<double> result;
    for (const std::string quantity : {"displacement y", "displacement z", "angle 1", "angle 2", "angle 3"})
      result.push_back(scene.value(body + "." + quantity));
    return result;
  }
} // namespace



TEST(PatchLayups, BoxIsTheBeamOfItsSection)
{
  for (const std::string load : {"Force = 0, 0, 10", "Force = 0, 10, 0", "Moment = 10, 0, 0", "Force = 1000, 0, 0"})
    {
      const auto shell = end_of_box(box_as_shell, "end", load), beam = end_of_box(box_as_beam, "box.end", load);
      double     largest = 0;
      for (const double value : beam)
        largest = std::max(largest, std::abs(value));
      for (unsigned int i = 0; i < beam.size(); ++i)
        EXPECT_NEAR(shell[i], beam[i], 0.03 * largest) << load << ", number " << i;
    }
  const auto twisted = end_of_box(box_as_beam, "box.end", "Force = 0, 0, 10");
  EXPECT_GT(std::abs(twisted[2]), 0.1 * std::abs(twisted[3])) << "bending twists";
}



TEST(PatchLayups, MassOfEachWall)
{
  Scene  scene(walls_of_box + box_as_shell + "    set Force = 0, 0, 0\n  end\nend\n");
  double mass = -1; // without the body at the end
  for (const auto &node : scene.system.model.nodes)
    mass += node.inertia(0, 0);
  EXPECT_NEAR(mass, 1580 * 2 * (2 * 0.099 * 0.002 + 2 * 0.058 * 0.001), 1e-9);
}
