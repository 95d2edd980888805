// The force and moment with which body A of a joint acts on body B: probes "force 1" ... "moment 3".
//
// A body on the ground under a dead force and moment that act at the joint: whatever the joint lets it do, A answers
// with the opposite, along and about the axes of A; a rotation of the universal joint, about its own axis.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  // joint axes in the reference configuration
  const Vector3 E1 = Vector3(2, 1, -2) / 3., E3 = Vector3(1, 2, 2) / 3., E2 = E3.cross(E1);

  std::string
  text_of(const Vector3 &v)
  {
    std::ostringstream text;
    text.precision(17);
    text << v(0) << ", " << v(1) << ", " << v(2);
    return text.str();
  }

  std::string
  model(const std::string &joint, const Vector3 &force, const Vector3 &moment)
  {
    return "subsection Bodies\n subsection body\n  set Type = rigid body\n  set Mass = 2\n"
           "  set Position = 0.4, 0.3, 0.2\n  set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n subsection j\n"
           "  set Body A = ground\n  set Body B = body.centre\n" +
           joint +
           " end\nend\nsubsection Loads\n subsection f\n  set Type = point load\n  set At = body.centre\n  set Force = " +
           text_of(force) + "\n  set Moment = " + text_of(moment) + "\n end\nend\n";
  }

  std::string
  springs(const std::vector<std::string> &motions)
  {
    std::string text;
    for (const auto &motion : motions)
      text += "  subsection " + motion + "\n   set Spring = 40\n  end\n";
    return text;
  }

  const std::string axes  = "  set Axis = 1, 2, 2\n  set Axis 1 = 2, 1, -2\n";
  const Vector3     force = Vector3(3, -2, 5), moment(7, 4, -6);
} // namespace



TEST(ForcesOfJoints, AreOppositeToTheLoads)
{
  const std::map<std::string, std::vector<std::string>> kinds = {{"rigid", {}},
                                                                 {"revolute", {"rotation"}},
                                                                 {"prismatic", {"displacement"}},
                                                                 {"cylindrical", {"displacement", "rotation"}},
                                                                 {"planar",
                                                                  {"displacement 1", "displacement 2", "rotation"}}};
  for (const auto &[kind, motions] : kinds)
    {
      Scene scene(model("  set Type = " + kind + "\n" + axes + (kind == "rigid" ? "  set Reaction = true\n" : "") +
                          springs(motions),
                        force,
                        moment));
      scene.equilibrium();
      const Vector3 E[] = {E1, E2, E3};
      for (unsigned int i = 0; i < 3; ++i)
        {
          const std::string axis = std::to_string(i + 1);
          EXPECT_NEAR(scene.value("j.force " + axis), -force.dot(E[i]), 1e-9) << kind << axis;
          EXPECT_NEAR(scene.value("j.moment " + axis), -moment.dot(E[i]), 1e-9) << kind << axis;
        }
      EXPECT_EQ(scene.input.model.probe("j.force 2").unit, "N");
      EXPECT_EQ(scene.input.model.probe("j.moment 2").unit, "N m");
    }
}



// The example that showed the order and the signs of the multipliers: moments (10, 20, 30) about x, y, z.
TEST(ForcesOfJoints, MomentsInTheOrderOfAxes)
{
  Scene scene(model("  set Type = rigid\n  set Reaction = true\n", {1, 2, 3}, {10, 20, 30}));
  scene.equilibrium();
  for (const int i : {1, 2, 3})
    {
      EXPECT_NEAR(scene.value("j.force " + std::to_string(i)), -i, 1e-12);
      EXPECT_NEAR(scene.value("j.moment " + std::to_string(i)), -10 * i, 1e-12);
    }
}



// The hinge has turned by a radian, where its axes 1 and 2 on A and B differ; the motor holds the moment about axis 3.
TEST(ForcesOfJoints, PrescribedRotation)
{
  Scene scene(
    model("  set Type = revolute\n" + axes + "  subsection rotation\n   set Prescribed = 1\n  end\n", force, moment));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.rotation"), 180 / M_PI, 1e-9);
  EXPECT_NEAR(scene.value("j.moment 1"), -moment.dot(E1), 1e-9);
  EXPECT_NEAR(scene.value("j.moment 2"), -moment.dot(E2), 1e-9);
  EXPECT_NEAR(scene.value("j.moment 3"), -moment.dot(E3), 1e-9);
}



// Rotation 1 is about axis 1 of A, rotation 2 about axis 2 of B; the moment that is locked is about the normal of both.
TEST(ForcesOfJoints, Universal)
{
  Scene         scene(model("  set Type = universal\n  set Axis = 2, 1, -2\n  set Second axis = " + text_of(E2) + "\n" +
                      springs({"rotation 1", "rotation 2"}),
                    force,
                    moment));
  const Matrix3 D      = scene.equilibrium().triad(1);
  const Vector3 axis_2 = D * E2; // of body B, whose axes were the inertial ones
  EXPECT_GT((axis_2 - E2).norm(), 0.05);
  EXPECT_NEAR(axis_2.dot(E1), 0, 1e-12);
  EXPECT_NEAR(scene.value("j.moment 1"), -moment.dot(E1), 1e-9);
  EXPECT_NEAR(scene.value("j.moment 2"), -moment.dot(axis_2), 1e-9);
  EXPECT_NEAR(scene.value("j.moment 3"), -moment.dot(E1.cross(axis_2)), 1e-9);
  EXPECT_NEAR(scene.value("j.force 1"), -force.dot(E1), 1e-9);
}



// What nothing holds is not known, and what is not there is not told.
TEST(ForcesOfJoints, OnlyWhatIsTransmitted)
{
  const Scene hinge(model("  set Type = revolute\n", force, Vector3::Zero()));
  EXPECT_NO_THROW(hinge.value("j.moment 2"));
  EXPECT_THROW(hinge.value("j.moment 3"), std::invalid_argument);
  const Scene slide(model("  set Type = prismatic\n", force, Vector3::Zero()));
  EXPECT_THROW(slide.value("j.force 3"), std::invalid_argument);
  EXPECT_NO_THROW(slide.value("j.moment 3"));
}



// A carriage on a slide along x, pulled by 5 N, hangs on a rod of length √2 at 45 degrees: tension 5 √2 N.
TEST(ForcesOfJoints, TensionOfDistanceJoint)
{
  for (const double pull : {5., -5.})
    for (const bool swapped : {false, true})
      {
        const std::string place[] = {"foot.centre", "carriage.centre"};
        Scene             scene(
          "subsection Bodies\n subsection carriage\n  set Type = rigid body\n  set Mass = 1\n"
                      "  set Position = 1, 0, 0\n end\n subsection foot\n  set Type = rigid body\n"
                      "  set Position = 0, 0, 1\n end\nend\nsubsection Joints\n subsection clamp\n  set Type = rigid\n"
                      "  set Body A = ground\n  set Body B = foot.centre\n end\n subsection slide\n  set Type = prismatic\n"
                      "  set Body A = ground\n  set Body B = carriage.centre\n  set Axis = 1, 0, 0\n end\n"
                      " subsection rod\n  set Type = distance\n  set Body A = " +
          place[swapped] + "\n  set Body B = " + place[!swapped] +
          "\n end\nend\nsubsection Loads\n subsection f\n  set Type = point load\n  set At = carriage.centre\n"
                      "  set Force = " +
          text_of({pull, 0, 0}) + "\n end\nend\n");
        scene.equilibrium();
        EXPECT_NEAR(scene.value("rod.force"), pull * std::sqrt(2.), 1e-10);
        EXPECT_EQ(scene.input.model.probe("rod.force").unit, "N");
      }
}



// A hub that turns at ω, held at an angle by its prescribed motion: the rotation does not hold it a second time. The
// hinge pulls the body towards the axis with m ω² r, and needs no moment.
TEST(ForcesOfJoints, SteadyRotationOfPrescribedJoint)
{
  const std::string hub = "subsection Bodies\n subsection hub\n  set Type = rigid body\n  set Mass = 2\n"
                          "  set Inertia = 1, 1, 1\n  set Position = 0.5, 0, 0\n end\nend\nsubsection Joints\n"
                          " subsection hinge\n  set Type = revolute\n  set Body A = ground\n  set Body B = hub.centre\n"
                          "  set Position = 0, 0, 0\n  subsection rotation\n";
  const std::string turning =
    "  end\n end\nend\nsubsection Loads\n subsection turning\n  set Type = steady rotation\n  set Joint = hinge\n"
    "  set Speed = 5\n";
  for (const std::string &text : {hub + "   set Prescribed = 0.3\n" + turning + " end\nend\n",
                                  hub + turning + "  set Azimuth = 0.3\n end\nend\n"})
    {
      Scene scene(text);
      EXPECT_TRUE(check_model(scene.system).redundant.empty());
      scene.equilibrium();
      EXPECT_NEAR(scene.value("hinge.rotation"), 0.3 * 180 / M_PI, 1e-10);
      EXPECT_NEAR(scene.value("hinge.rotation rate"), 5, 1e-10);
      EXPECT_NEAR(scene.value("hub.velocity x"), -5 * 0.5 * std::sin(0.3), 1e-10);
      EXPECT_NEAR(scene.value("hinge.force 1"), -2 * 25 * 0.5 * std::cos(0.3), 1e-9);
      EXPECT_NEAR(scene.value("hinge.force 2"), -2 * 25 * 0.5 * std::sin(0.3), 1e-9);
      EXPECT_NEAR(scene.value("hinge.moment 3"), 0, 1e-9);
    }
}
