/*
 * Problem:   points of bodies as another body sees them, where welds have merged nodes and numbered the others anew
 * Reference: the reference configuration, in which each point is where it is drawn; a rigid motion, in which nothing
 *            moves as its own body sees it; positions and rotations of both ends by themselves
 * Expected:  round-off
 */

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  // Three beams in a row on a hub that is no node of its own: four welds.
  const std::string row_of_bodies = R"(
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = 1e7
    set GA2 = 1e6
    set GA3 = 1e6
    set GJ = 20
    set EI2 = 30
    set EI3 = 50
    set Mass = 0.4
  end
end
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
    set Position = 0.1, 0.2, -0.3
    set Frames = arm at 0.4 0.3 -0.3
  end
  subsection first
    set Type = beam
    set Points = 0.4, 0.3, -0.3; 1.4, 0.3, -0.2
    set Section = s
    set Elements = 2
  end
  subsection second
    set Type = beam
    set Points = 1.4, 0.3, -0.2; 1.9, 1.1, 0.2
    set Section = s
    set Elements = 3
  end
  subsection tip
    set Type = rigid body
    set Mass = 0.1
    set Inertia = 0.01, 0.01, 0.01
    set Position = 1.9, 1.1, 0.2
    set Frames = eye at 1.9 1.3 0.2
  end
end
subsection Joints
  subsection shaft
    set Type = revolute
    set Body A = ground
    set Body B = hub.centre
    subsection rotation
      set Spring = 10
    end
  end
  subsection a
    set Type = rigid
    set Body A = hub.arm
    set Body B = first.start
  end
  subsection b
    set Type = rigid
    set Body A = first.end
    set Body B = second.start
  end
  subsection c
    set Type = rigid
    set Body A = second.end
    set Body B = tip.centre
  end
end
subsection Loads
  subsection push
    set Type = point load
    set At = tip.eye
    set Force = 1, 6, -3
  end
end
)";

  const std::vector<std::string> points =
    {"first.start", "first.end", "second.start", "second.end", "tip.centre", "tip.eye"};

  Vector3
  vector(const Scene &scene, const std::string &quantity, const std::string &seen = "")
  {
    return {scene.value(quantity + " x" + seen),
            scene.value(quantity + " y" + seen),
            scene.value(quantity + " z" + seen)};
  }
} // namespace



TEST(PointsSeen, AreWhereTheyAreDrawn)
{
  const Scene scene(row_of_bodies);
  for (const auto &point : points)
    EXPECT_LT((vector(scene, point + ".position", " seen from hub") - vector(scene, point + ".position")).norm(), 1e-14)
      << point;
}



TEST(PointsSeen, ArePositionsInTheAxesOfTheBody)
{
  Scene         scene(row_of_bodies);
  const Vector3 hub = vector(scene, "hub.position");
  scene.equilibrium();
  const Matrix3 turned = rotation_of_vector(Vector3(vector(scene, "hub.rotation") * M_PI / 180));
  for (const auto &point : points)
    {
      const Vector3 x      = vector(scene, point + ".position"),
                    wanted = hub + turned.transpose() * (x - vector(scene, "hub.position"));
      EXPECT_LT((vector(scene, point + ".position", " seen from hub") - wanted).norm(), 1e-12) << point;
    }
  // what is welded to the hub does not move as the hub sees it, and what bends does
  EXPECT_LT(vector(scene, "first.start.displacement", " seen from hub").norm(), 1e-12);
  EXPECT_GT(vector(scene, "tip.eye.displacement", " seen from hub").norm(), 1e-2);
  EXPECT_LT(vector(scene, "tip.eye.displacement", " seen from tip").norm(), 1e-12);
}
