#ifndef samara_tests_cosserat_bodies_h
#define samara_tests_cosserat_bodies_h

#include "../scene.h"

namespace samara
{
  /**
   * Two rigid bodies, welded together though they are apart, and a beam with a corner. @p ball, @p plate and @p rod are
   * further entries of theirs, @p joints further joints.
   */
  inline std::string
  bodies(const std::string &ball, const std::string &plate, const std::string &rod, const std::string &joints = "")
  {
    return R"(
subsection Sections
  subsection s
    set Type = matrices
    set Stiffness = 9e4, 7e4, 6e4, 3e4, 2e4, 4e4
    set Inertia = 2, 2, 2, 0.3, 0.2, 0.1
  end
end
subsection Bodies
  subsection ball
    set Type = rigid body
    set Mass = 2
    set Position = 1, 0.5, -0.3
    set Rotation = 0.3, -0.2, 0.5
    set Centre of mass = 0.1, 0.2, -0.3
    set Inertia = 0.3, 0.4, 0.5
    set Frames = tip at 1.5 0.7 0.2
    )" + ball +
           R"(
  end
  subsection plate
    set Type = rigid body
    set Mass = 3
    set Position = -0.4, 0.2, 0.1
    set Rotation = 1, 0.4, -0.7
    set Inertia = 0.2, 0.3, 0.4
    )" + plate +
           R"(
  end
  subsection rod
    set Type = beam
    set Section = s
    set Points = 0.5, 0, 0; 1.2, 0.4, 0.3; 1.4, -0.2, 0.9
    set Frames = quarter at 0.25
    )" + rod +
           R"(
  end
end
subsection Joints
  subsection weld
    set Type = rigid
    set Body A = ball.centre
    set Body B = plate.centre
  end
)" + joints +
           "end\n";
  }

  const std::string weld_rod_to_plate =
    "subsection root\n set Type = rigid\n set Body A = plate.centre\n set Body B = rod.start\nend\n";
  const std::string weld_rod_to_ground =
    "subsection root\n set Type = rigid\n set Body A = ground\n set Body B = rod.start\nend\n";

  /** A vector by a probe: "ball.tip.velocity". */
  inline Vector3
  vector_of(const Scene &scene, const std::string &probe)
  {
    return {scene.value(probe + " x"), scene.value(probe + " y"), scene.value(probe + " z")};
  }

  const std::vector<std::string> points_of_bodies = {"ball.centre", "ball.centre of mass", "ball.tip", "plate.centre"},
                                 points_of_rod = {"rod.start", "rod.quarter", "rod.at 0.31", "rod.at 0.77", "rod.end"};
} // namespace samara

#endif
