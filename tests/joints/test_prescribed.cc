// Prescribed motions of joints, small and large. A motion of B seen from A: rotations turn by the right hand about
// "Axis", displacements go along it, and angles count beyond a half turn. Expected: exact, so 1e-9, Newton's tolerance.

#include "../scene.h"
#include <gtest/gtest.h>

#include "skew_axes.h"

using namespace samara;

namespace
{
  using namespace skew_axes;

  const Vector3 centre(1, 0.5, -0.3);

  Matrix3
  rotation_matrix(const double angle, const Vector3 &axis)
  {
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }

  /** A body on a joint at J; @p reversed: the body is A and the ground B. */
  std::string
  prescribed_body(const std::string &kind, const std::string &entries, const bool reversed = false)
  {
    return std::string(R"(
set Analyses = static
subsection Bodies
  subsection body
    set Type = rigid body
    set Mass = 2
    set Position = 1, 0.5, -0.3
    set Inertia = 0.3, 0.4, 0.5
  end
end
subsection Joints
  subsection j
    set Position = 0.4, -0.3, 0.2
    set Type = )") +
           kind + "\n" +
           (reversed ? "set Body A = body.centre\nset Body B = ground\n" :
                       "set Body A = ground\nset Body B = body.centre\n") +
           entries + "end\nend\nsubsection Static\n set Load steps = 8\nend\n";
  }

  std::string
  prescribed_value(const std::string &motion, const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << "subsection " << motion << "\n set Prescribed = " << value << "\nend\n";
    return text.str();
  }

  /** The body must have been turned by R about J and then moved by d. */
  void
  expect_motion(Scene &scene, const Matrix3 &R, const Vector3 &d, const std::string &what)
  {
    const State &state = scene.equilibrium();
    EXPECT_LT((state.triad(1) - R).norm(), 1e-9) << what << ": the body's axes are\n"
                                                 << state.triad(1) << "\ninstead of\n"
                                                 << R;
    EXPECT_LT((state.position(1) - (J + d + R * (centre - J))).norm(), 1e-9) << what;
  }

  const std::string axis = "set Axis = 1, 2, -2\nset Axis 1 = 2, 1, 2\n";
} // namespace



TEST(Prescribed, Revolute)
{
  for (const double angle : {0.6, -0.6, 2.5, 4., -7.})
    {
      Scene scene(prescribed_body("revolute", axis + prescribed_value("rotation", angle)));
      expect_motion(scene, rotation_matrix(angle, a), Vector3::Zero(), "revolute " + std::to_string(angle));
      EXPECT_NEAR(scene.value("j.rotation"), angle * 180 / M_PI, 1e-7);
    }
}



// The ground turns by the angle seen from the body: the body turns by the opposite.
TEST(Prescribed, SeenFromBodyA)
{
  Scene scene(prescribed_body("revolute", axis + prescribed_value("rotation", 0.6), true));
  expect_motion(scene, rotation_matrix(-0.6, a), Vector3::Zero(), "reversed revolute");
  Scene slide(prescribed_body("prismatic", axis + prescribed_value("displacement", 0.7), true));
  expect_motion(slide, Matrix3::Identity(), -0.7 * a, "reversed prismatic");
}



TEST(Prescribed, Prismatic)
{
  Scene scene(prescribed_body("prismatic", axis + prescribed_value("displacement", -1.7)));
  expect_motion(scene, Matrix3::Identity(), -1.7 * a, "prismatic");
  EXPECT_NEAR(scene.value("j.displacement"), -1.7, 1e-9);
}



TEST(Prescribed, Screw)
{
  for (const double angle : {0.6, 4.})
    {
      Scene by_angle(prescribed_body("screw", axis + "set Pitch = 0.3\n" + prescribed_value("rotation", angle)));
      expect_motion(by_angle, rotation_matrix(angle, a), 0.3 * angle * a, "screw");
      Scene by_displacement(
        prescribed_body("screw", axis + "set Pitch = 0.3\n" + prescribed_value("displacement", 0.3 * angle)));
      expect_motion(by_displacement, rotation_matrix(angle, a), 0.3 * angle * a, "screw by its displacement");
    }
}



TEST(Prescribed, Cylindrical)
{
  Scene scene(
    prescribed_body("cylindrical", axis + prescribed_value("rotation", 2.5) + prescribed_value("displacement", 0.8)));
  expect_motion(scene, rotation_matrix(2.5, a), 0.8 * a, "cylindrical");
}



TEST(Prescribed, Planar)
{
  Scene scene(prescribed_body("planar",
                              axis + prescribed_value("rotation", 4) + prescribed_value("displacement 1", 0.8) +
                                prescribed_value("displacement 2", -0.5)));
  expect_motion(scene, rotation_matrix(4, a), 0.8 * b - 0.5 * c, "planar");
}



// First about the axis of A, then about that of B, which the first has turned.
TEST(Prescribed, Universal)
{
  for (const auto &[first, second] : {std::pair(0.6, 0.), {0., 0.6}, {0.6, -0.8}, {2.5, 1.2}, {-4., 2.8}})
    {
      Scene         scene(prescribed_body("universal",
                                  "set Axis = 1, 2, -2\nset Second axis = 2, 1, 2\n" +
                                    prescribed_value("rotation 1", first) + prescribed_value("rotation 2", second)));
      const Matrix3 E = triad(a, b);
      expect_motion(scene,
                    rotation_matrix(first, a) * rotation_matrix(second, b),
                    Vector3::Zero(),
                    "universal " + std::to_string(first) + ", " + std::to_string(second));
      EXPECT_LT(
        (scene.context.state.triad(1) - E * rotation_of_angles({first, second, 0}, "123") * E.transpose()).norm(),
        1e-9);
      EXPECT_NEAR(scene.value("j.rotation 1"), first * 180 / M_PI, 1e-7);
      EXPECT_NEAR(scene.value("j.rotation 2"), second * 180 / M_PI, 1e-7);
    }
}



// Functions of time are taken at the time the statics are asked for.
TEST(Prescribed, AtATime)
{
  Scene scene(prescribed_body("revolute", axis + "subsection rotation\n set Prescribed = 0.2 + 0.1*t^2\nend\n"),
              {"Static/Time = 2"});
  expect_motion(scene, rotation_matrix(0.6, a), Vector3::Zero(), "at t = 2");
}



// A joint on a body that turns: angles are relative, axes are carried along.
TEST(Prescribed, ChainOfTwo)
{
  std::string text = prescribed_body("revolute", axis + prescribed_value("rotation", 0.9));
  text.replace(
    text.find("end\nsubsection Joints"),
    0,
    "  subsection second\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 2, 0, 0\n end\n");
  text.replace(
    text.find("end\nend\nsubsection Static"),
    4,
    "end\n subsection k\n set Type = revolute\n set Axis = 2, 1, 2\n set Body A = body.centre\n set Body B = second.centre\n" +
      prescribed_value("rotation", -2.2) + " end\n");
  Scene        scene(text);
  const State &state = scene.equilibrium();
  EXPECT_LT((state.triad(2) - rotation_matrix(0.9, a) * rotation_matrix(-2.2, b)).norm(), 1e-9);
  EXPECT_LT((state.position(2) - (J + rotation_matrix(0.9, a) * (Vector3(2, 0, 0) - J))).norm(), 1e-9);
}



// What has no unknown of its own is told all the same, between −180° and 180°.
TEST(Prescribed, UnusedMotionIsTold)
{
  std::string text = prescribed_body("revolute", axis);
  text.replace(
    text.find("end\nend\nsubsection Static"),
    4,
    "end\n subsection same axis\n set Type = cylindrical\n set Position = 0.4, -0.3, 0.2\n set Axis = 1, 2, -2\n"
    " set Body A = ground\n set Body B = body.centre\n" +
      prescribed_value("rotation", 2.) + " end\n");
  Scene scene(text);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.rotation"), 2. * 180 / M_PI, 1e-7);
}



// The first corner of all that is a function of time at a joint.
TEST(Prescribed, NextCorner)
{
  const Scene scene(prescribed_body("cylindrical",
                                    axis +
                                      "subsection rotation\n set Prescribed = table: 0 0; 1 0.5; 3 0.5\n end\n"
                                      "subsection displacement\n set Spring = 2\n set Force = t < 2 ? 0 : t\n end\n"));
  const auto &joint = scene.system;
  EXPECT_NEAR(joint.next_corner(-0.5, 10), 0., 1e-12);
  EXPECT_NEAR(joint.next_corner(0, 10), 1., 1e-12);
  EXPECT_NEAR(joint.next_corner(1, 10), 2., 1e-12);
  EXPECT_NEAR(joint.next_corner(2, 10), 3., 1e-12);
  EXPECT_EQ(joint.next_corner(3, 10), std::numeric_limits<double>::infinity());
  EXPECT_EQ(joint.next_corner(1, 1.5), std::numeric_limits<double>::infinity());
}
