// Subsystems: names, arguments, copies, what is changed in one of them, and what a file with them is written as.

#include <gtest/gtest.h>

#include <filesystem>

#include "said.h"

using namespace samara;

namespace
{
  const std::string hub = "subsection Bodies\n subsection hub\n set Type = rigid body\n set Mass = 3\n"
                          " set Inertia = 1, 1, 1\n end\n";
  const std::string arm = "include " SAMARA_SOURCE_DIR "/tests/input/parts/arm.prm\n";

  /** The hub and @p subsystems; the rest begins within the subsection of bodies. */
  std::string
  model(const std::string &subsystems, const std::string &rest = "end\n")
  {
    return hub + rest + "subsection Subsystems\n" + subsystems + "end\n";
  }

  Vector3
  position(const Scene &scene, const std::string &point)
  {
    return {scene.value(point + ".position x"), scene.value(point + ".position y"), scene.value(point + ".position z")};
  }

  void
  expect_near(const Vector3 &a, const Vector3 &b)
  {
    EXPECT_LT((a - b).norm(), 1e-14) << a.transpose() << " and " << b.transpose();
  }
} // namespace



TEST(Subsystems, CopiesAreTurned)
{
  const Scene four(model("subsection arm\n" + arm + "set Copies = 4 about z\nend\n"));
  expect_near(position(four, "arm 1:arm.tip"), {2, 0, 0});
  expect_near(position(four, "arm 2:arm.tip"), {0, 2, 0});
  expect_near(position(four, "arm 3:arm.tip"), {-2, 0, 0});
  expect_near(position(four, "arm 4:arm.tip"), {0, -2, 0});

  const Scene fan(model("subsection arm\n" + arm +
                        "set Copies = 3 about 0 0 -2 through 1 m, 1 m, 0 by 90 deg\n"
                        "set Position = 0, 0, 5\nend\n"));
  expect_near(position(fan, "arm 1:arm.tip"), {2, 0, 5});
  expect_near(position(fan, "arm 2:arm.tip"), {0, 0, 5});
  expect_near(position(fan, "arm 3:arm.tip"), {0, 2, 5});
}



TEST(Subsystems, PlacesAreNested)
{
  const std::string inner = "subsection Subsystems\n subsection inner\n" + arm +
                            " set Rotation = 90 deg, 0, 0\n"
                            " set Position = 0, 0, 1\n end\n end\n";
  const Scene scene(
    model("subsection outer\n set Position = 10, 0, 0\n set Rotation = 0, 0, 90 deg\n" + inner + "end\n"));
  // about z, up, about x, along x
  expect_near(position(scene, "outer:inner:arm.tip"), {10, -1, 2});
}



TEST(Subsystems, ArgumentsTakeThePlaceOfConstants)
{
  const std::string constants = "end\nsubsection Constants\n set length = 7 m\nend\n";
  const auto        tip       = [&](const std::string &arguments, const std::string &more = "") {
    const Scene scene(model("subsection arm\n" + arm + arguments + more + "end\n", constants));
    return scene.value("arm:arm.position x");
  };
  EXPECT_EQ(tip(""), 1.);
  EXPECT_EQ(tip("set Arguments = length = 50 cm\n"), 0.5);
  EXPECT_EQ(tip("set Arguments = length = 2*length\n"), 14.); // as it is understood outside
  EXPECT_EQ(tip("", "subsection Constants\n set length = 3 m\nend\n"), 3.);
  EXPECT_NE(complaint_of(model("subsection arm\n" + arm + "set Arguments = pi = 3\nend\n")), "");

  // copies know their numbers
  const Scene copies(model("subsection arm\n" + arm +
                           "set Arguments = length = 1 m\n set Copies = 2 about z\n"
                           "subsection Constants\n set mass = copy*1 kg\nend\nend\n"));
  EXPECT_NE(used(copies).find("set Mass = 2"), std::string::npos);
}



// What is not in the subsystem is looked for around it: the nearest of a name counts.
TEST(Subsystems, NamesAreLookedUpInsideFirst)
{
  const std::string inner_hub = "subsection Bodies\n subsection hub\n set Type = rigid body\n set Mass = 4\n"
                                " set Inertia = 1, 1, 1\n set Position = 0, 0, 9\n end\nend\n",
                    probe =
                      "subsection Output\n set Probes = arm.tip.position x, hub.position z, hinge.rotation\nend\n";
  Scene scene(model("subsection one\n" + arm + probe + "end\nsubsection two\n" + arm + inner_hub + probe + "end\n"));
  std::vector<std::string> names;
  for (const auto &p : scene.input.make_probes())
    names.push_back(p.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"one:arm.tip.position x",
                                      "hub.position z",
                                      "one:hinge.rotation",
                                      "two:arm.tip.position x",
                                      "two:hub.position z",
                                      "two:hinge.rotation"}));
  // the arm of two hangs on its own hub: the other one is free of it
  const auto with_load = [&](const std::string &body) {
    return model("subsection two\n" + arm + inner_hub +
                 "subsection Loads\n subsection push\n set Type = point load\n set At = " + body +
                 "\n set Force = 0, 0, 1\n end\nend\nend\n");
  };
  EXPECT_NE(residual(Scene(with_load("hub")).system), residual(Scene(with_load("arm")).system));
}



TEST(Subsystems, LawsSpeakOfTheirOwnCopy)
{
  const std::string state = "subsection States\n subsection filter\n set Unit = rad\n"
                            " set Rate = (hinge.rotation - filter)/(0.1 s) + arm.velocity z*1/m\n end\nend\n";
  const std::string force = "subsection Joints\n subsection hinge\n subsection rotation\n"
                            " set Moment = -3 N*m*filter - 2 N*m*hinge.rotation\n end\n end\nend\n";
  Scene             scene(model("subsection arm\n" + arm + state + force + "set Copies = 2 about x by 90 deg\nend\n"));
  const std::string text = used(scene);
  EXPECT_NE(text.find("arm 2:hinge.rotation"), std::string::npos) << text;
  EXPECT_NE(text.find("arm 2:filter"), std::string::npos) << text;
  // z of the second copy points along -y of the model
  EXPECT_NE(text.find("arm 2:arm.velocity y"), std::string::npos) << text;
  EXPECT_EQ(text.find("arm 2:arm.velocity z"), std::string::npos) << text;
  EXPECT_EQ(text.find("arm 1:arm.velocity y"), std::string::npos) << text;
  // what is written is the same model
  EXPECT_EQ(residual(scene.system), residual(Scene(text).system));
}



// The model can change one copy, in its file or from the command line.
TEST(Subsystems, OneCopyIsChanged)
{
  const std::string two    = "subsection arm\n" + arm + "set Copies = 2 about z\nend\n";
  const auto        masses = [](const Scene &scene) {
    const std::string   text = used(scene);
    std::vector<double> all;
    for (std::size_t at = 0; (at = text.find("set Mass = ", at)) != std::string::npos; ++at)
      all.push_back(std::stod(text.substr(at + 11)));
    return all;
  };
  EXPECT_EQ(masses(Scene(model(two))), (std::vector<double>{3, 2, 2}));
  EXPECT_EQ(masses(Scene(model(two, " subsection arm 2:arm\n set Mass = 2.5\n end\nend\n"))),
            (std::vector<double>{3, 2, 2.5}));
  EXPECT_EQ(masses(Scene(model(two), {"Bodies/arm 1:arm/Mass = 5"})), (std::vector<double>{3, 5, 2}));
  EXPECT_EQ(masses(Scene(model(two), {"Subsystems/arm/Bodies/arm/Mass = 7"})), (std::vector<double>{3, 7, 7}));
  EXPECT_EQ(masses(Scene(model(two), {"Subsystems/arm/Arguments = length = 2 m"})), (std::vector<double>{3, 4, 4}));
  EXPECT_EQ(masses(Scene(model(two), {"Subsystems/arm/Copies = 3 about z"})).size(), 4u);
  EXPECT_THROW(Scene(model(two), {"Bodies/arm 3:arm/Mass = 5"}), InputError);
}



// A model made of subsystems is written as one that runs by itself and is the same.
TEST(Subsystems, UsedIsTheSameModel)
{
  const Scene scene(
    model("subsection arm\n" + arm + "set Copies = 3 about 1 2 3 through 0.2 0 0\n set Rotation = 0.3, 0, 0.4\nend\n"));
  const std::string text = used(scene);
  EXPECT_EQ(text.find("Subsystems"), std::string::npos);
  const auto a = residual(scene.system), b = residual(Scene(text).system);
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], 1e-13);
}



// Copies, and copies of copies, by hand: the nearest thing to a second program.
TEST(Subsystems, CopyOfASubsystem)
{
  const std::string by_hand =
    "subsection one\n" + arm + "end\nsubsection two\n set Copy of = one\n set Rotation = 180 deg, 0, 0\nend\n";
  const Scene a(model(by_hand)), b(model("subsection arm\n" + arm + "set Copies = 2 about z\nend\n"));
  EXPECT_EQ(residual(a.system), residual(b.system));
}



// "pilot_2", an output of several, is that of the subsystem in which it is asked for, whatever the model has.
TEST(Subsystems, ProbesOfNumberedOutputs)
{
  const auto pilot = [](const std::string &input) {
    return "subsection States\n subsection pilot\n set Type = state space\n set A = -1\n set B = 1\n set C = 1; 2\n"
           " set Inputs = " +
           input + "\n end\nend\n";
  };
  const Scene scene(model("subsection sub\n" + pilot("7") + "subsection Output\n set Probes = pilot_2\nend\nend\n",
                          "end\n" + pilot("5")));
  const auto  probes = scene.input.make_probes();
  ASSERT_EQ(probes.size(), 1u);
  EXPECT_EQ(probes[0].name, "sub:pilot_2");
}



// What is left out is not there; what stays is as in a file that never had it. An entry is taken back by <none>.
TEST(Subsystems, ObjectsAreLeftOut)
{
  const std::string rest = "subsection weight\n set Type = rigid body\n set Mass = 7\n set Inertia = 1, 1, 1\n"
                           " set Position = none\n set Active = n > 0\n end\nend\nsubsection Constants\n set n = ";
  EXPECT_EQ(Scene(model("", rest + "0\nend\n")).system.model.nodes.size(), 2u) << "the ground and the hub";
  const Scene both(model("", rest + "1\nend\n"));
  EXPECT_EQ(both.system.model.nodes.size(), 3u);
  expect_near(position(both, "weight.centre"), {0, 0, 0});
  EXPECT_EQ(Scene(model("subsection arm\n" + arm + "set Active = false\nend\n")).system.model.nodes.size(), 2u);
}



// A point of an arm on a hub that is turned by 90 degrees about z: what moves with the observer stays where it was
// drawn.
TEST(Subsystems, ProbesAreSeenFromABody)
{
  const std::string joint =
    "end\nsubsection Joints\n subsection axis\n set Type = revolute\n set Body A = ground\n"
    " set Body B = hub\n set Axis = 0, 0, 1\n subsection rotation\n"
    " set Prescribed = pi/2 + 3 rad/s*t\n end\n end\n"
    " subsection clamp\n set Type = rigid\n set Body A = hub\n set Body B = weight\n end\nend\n";
  const std::string weight = "subsection weight\n set Type = rigid body\n set Mass = 7\n set Inertia = 1, 1, 1\n"
                             " set Position = 2, 0, 1\n end\n";
  Scene             scene(model("", weight + joint));
  scene.equilibrium();
  expect_near(position(scene, "weight.centre"), {0, 2, 1});
  EXPECT_NEAR(scene.value("weight.centre.position x seen from hub"), 2, 1e-14);
  EXPECT_NEAR(scene.value("weight.centre.displacement y seen from hub"), 0, 1e-14);
  EXPECT_NEAR(scene.value("weight.centre.rotation z seen from hub"), 0, 1e-12);
  EXPECT_NEAR(scene.value("ground.position x seen from ground"), 0, 1e-14);
}
