// Reactions: "force i" and "moment i" of a joint are those of A on B, along and about the axes of A.
//
// A body is held at large prescribed motions under a dead force and moment. Equilibrium of the body about the joint's
// frame on B at x_B: force = −F, moment = −(M + (x_C − x_B) × F). Expected: exact, 1e-8.

#include "../scene.h"
#include <gtest/gtest.h>

#include "skew_axes.h"

using namespace samara;

namespace
{
  using namespace skew_axes;

  const Vector3 F(3, -5, 7), M(2, 4, -1);

  std::string
  loaded_body(const std::string &kind, const std::string &entries)
  {
    return R"(
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
    set Body A = ground
    set Body B = body.centre
    set Position = 0.4, -0.3, 0.2
    set Type = )" +
           kind + "\n" + entries + R"(
  end
end
subsection Loads
  subsection f
    set Type = point load
    set At = body.centre
    set Force = 3, -5, 7
    set Moment = 2, 4, -1
  end
end
subsection Static
  set Load steps = 8
end
)";
  }

  std::string
  prescribed_formula(const std::string &motion, const std::string &value)
  {
    return "subsection " + motion + "\n set Prescribed = " + value + "\nend\n";
  }

  struct DisplacedJoint
  {
    std::string entries;
    Vector3     displacement; ///< of the frame on B
  };
} // namespace



TEST(Reactions, AllMotionsPrescribed)
{
  const std::string                           axes  = "set Axis = 1, 2, -2\nset Axis 1 = 2, 1, 2\n";
  const std::map<std::string, DisplacedJoint> kinds = {
    {"revolute", {axes + prescribed_formula("rotation", "2.5"), Vector3::Zero()}},
    {"prismatic", {axes + prescribed_formula("displacement", "0.7"), 0.7 * a}},
    {"cylindrical",
     {axes + prescribed_formula("displacement", "0.7") + prescribed_formula("rotation", "-1.2"), 0.7 * a}},
    {"planar",
     {axes + prescribed_formula("displacement 1", "0.7") + prescribed_formula("displacement 2", "-0.4") +
        prescribed_formula("rotation", "4"),
      0.7 * b - 0.4 * c}},
    {"rigid", {axes + "set Reaction = true\n", Vector3::Zero()}}};
  const Vector3 E[] = {b, c, a};
  for (const auto &[name, kind] : kinds)
    {
      Scene         scene(loaded_body(name, kind.entries));
      const State  &state  = scene.equilibrium();
      const Vector3 moment = -(M + (state.position(1) - (J + kind.displacement)).cross(F));
      for (unsigned int i = 0; i < 3; ++i)
        {
          EXPECT_NEAR(scene.value("j.force " + std::to_string(i + 1)), -F.dot(E[i]), 1e-8) << name << i + 1;
          EXPECT_NEAR(scene.value("j.moment " + std::to_string(i + 1)), moment.dot(E[i]), 1e-8) << name << i + 1;
        }
    }
}



// The moments of a universal joint are about its two axes, the first fixed in A, the second in B, and the normal of
// both.
TEST(Reactions, Universal)
{
  Scene         scene(loaded_body("universal",
                          "set Axis = 1, 2, -2\nset Second axis = 2, 1, 2\n" + prescribed_formula("rotation 1", "0.8") +
                            prescribed_formula("rotation 2", "-1.1")));
  const State  &state  = scene.equilibrium();
  const Vector3 moment = -(M + (state.position(1) - J).cross(F));
  const Vector3 second = Eigen::AngleAxisd(0.8, a) * b, normal = a.cross(second);
  const Vector3 axes_A[] = {a, b, c};
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(scene.value("j.force " + std::to_string(i + 1)), -F.dot(axes_A[i]), 1e-8);
  EXPECT_NEAR(scene.value("j.moment 1"), moment.dot(a), 1e-8);
  EXPECT_NEAR(scene.value("j.moment 2"), moment.dot(second), 1e-8);
  EXPECT_NEAR(scene.value("j.moment 3"), moment.dot(normal), 1e-8);
}



// The same where the axes are not at a right angle.
TEST(Reactions, SkewUniversal)
{
  Scene         scene(loaded_body("skew universal",
                          "set Axis = 1, 2, -2\nset Second axis = 3, 3, 0\n" + prescribed_formula("rotation 1", "0.8") +
                            prescribed_formula("rotation 2", "-1.1")));
  const State  &state  = scene.equilibrium();
  const Vector3 moment = -(M + (state.position(1) - J).cross(F));
  const Vector3 second = Eigen::AngleAxisd(0.8, a) * (a + b).normalized(), normal = a.cross(second).normalized();
  EXPECT_NEAR(scene.value("j.moment 1"), moment.dot(a), 1e-8);
  EXPECT_NEAR(scene.value("j.moment 2"), moment.dot(second), 1e-8);
  EXPECT_NEAR(scene.value("j.moment 3"), moment.dot(normal), 1e-8);
  EXPECT_NEAR(scene.value("j.force 1"), -F.dot(a), 1e-8);
  EXPECT_NEAR(scene.value("j.force 2"), -F.dot(b), 1e-8);
}



// Without an unknown of its own a free motion has no reaction, and no probe.
TEST(Reactions, NoneWhereFree)
{
  Scene scene(loaded_body("spherical", ""));
  EXPECT_NO_THROW(scene.input.model.probe("j.force 3"));
  EXPECT_THROW(scene.input.model.probe("j.moment 3"), std::invalid_argument);
}
