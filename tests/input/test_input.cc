// What stands above the single entries of an input file: used.prm says the same as the file it came from, and analyses
// are done in the order in which they are asked for.

#include <samara/study/study.h>

#include <gtest/gtest.h>

#include <filesystem>

#include "said.h"

using namespace samara;

namespace
{
  const std::string turning_hub = R"(
subsection Constants
  set speed = 300 rpm
end
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 2 lb
    set Inertia = (2, 2, 2) kg*cm^2
    set Position = 1 ft, 0, 0
  end
  subsection second hub
    set Copy of = hub
    set Position = (0, 1, 0) ft
  end
end
subsection Joints
  subsection hinge
    set Type = revolute
    set Body A = ground
    set Body B = hub.centre
    subsection rotation
      set Prescribed = table: 0 s, 0 deg; 1 s, 20 deg
    end
  end
  subsection second hinge
    set Copy of = hinge
    set Body B = second hub
    subsection rotation
      set Prescribed = speed*t
      set Spring = 2 lbf*ft/rad
    end
  end
end
subsection Loads
  subsection turning
    set Type = steady rotation
    set Speed = speed
  end
  subsection push
    set Type = point load
    set At = hub
    set Force = 3 lbf * sin(2*pi*t), 0, 5 - t
  end
end
)";
} // namespace



// A subsystem that stands for a body is none any more in what is printed.
TEST(UsedPrm, NamesTheBodiesOfParts)
{
  const Scene       original("prm/rotorcraft/articulated_rotor.prm",
                       {"Output/Probes = blade 1:blade.end.position z seen from hub, hub.position z"});
  const std::string text = used(original);
  EXPECT_EQ(text.find("seen from hub,"), std::string::npos) << text;
  const Scene again(text);
  EXPECT_EQ(used(again), text);
  EXPECT_EQ(again.value("blade 1:blade.end.position z seen from hub:hub"),
            original.value("blade 1:blade.end.position z seen from hub"));
}



TEST(UsedPrm, IsTheSameModel)
{
  std::vector<std::string> models = {turning_hub};
  for (const auto &entry : std::filesystem::recursive_directory_iterator(SAMARA_SOURCE_DIR "/prm"))
    if (entry.path().extension() == ".prm" && entry.path().parent_path().filename() != "parts" &&
        !Study::is_study(Outline::of_file(entry.path().string())))
      models.push_back("prm/" + std::filesystem::relative(entry.path(), SAMARA_SOURCE_DIR "/prm").string());
  EXPECT_GT(models.size(), 10u);
  for (const auto &model : models)
    {
      const Scene       original(model);
      const std::string text = used(original);
      const Scene       again(text);
      EXPECT_EQ(used(again), text) << model;
      ASSERT_EQ(again.system.layout.n_multipliers, original.system.layout.n_multipliers) << model;
      for (unsigned int i = 0; i < again.system.layout.n_multipliers; ++i)
        ASSERT_EQ(again.system.layout.name_of_multiplier(i), original.system.layout.name_of_multiplier(i)) << model;
      EXPECT_EQ(residual(again.system), residual(original.system)) << model;
      EXPECT_EQ(again.context.speeds, original.context.speeds) << model;
      EXPECT_EQ(again.input.rotor_speeds, original.input.rotor_speeds) << model;
      EXPECT_EQ(again.input.probes, original.input.probes) << model;
      EXPECT_EQ(again.input.analyses.size(), original.input.analyses.size()) << model;
    }
}



// What the file does not say must not be said by its copy: a joint without "Position" is where body B is, and a motion
// without "Prescribed" is free.
TEST(UsedPrm, LeavesDefaultsToBeDefaults)
{
  const std::string text = used(Scene(turning_hub));
  EXPECT_NE(text.find("\nsubsection Joints\n  subsection hinge\n    set Type = revolute\n    set Body A = ground\n"
                      "    set Body B = hub.centre\n    # set Position = 0, 0, 0\n"),
            std::string::npos)
    << text;
  EXPECT_NE(text.find("\n    set Mass = 0.90718474\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("Constants"), std::string::npos);
  EXPECT_EQ(text.find("Copy of"), std::string::npos);
}



TEST(Input, AnalysesInTheOrderOfTheFile)
{
  const Scene scene("set Analyses = modal, static\n" + turning_hub);
  ASSERT_EQ(scene.input.analyses.size(), 2u);
  EXPECT_NE(dynamic_cast<ModalAnalysis *>(scene.input.analyses[0].get()), nullptr);
  EXPECT_NE(dynamic_cast<StaticAnalysis *>(scene.input.analyses[1].get()), nullptr);
}



// An override of the kind of a joint: what the file says of the motions that the new kind has, too, is kept.
TEST(Input, OverrideOfTheKindOfAJoint)
{
  const Scene scene("prm/benchmarks/swept_tip_dynamics.prm", {"Joints/root/Type = cylindrical"});
  EXPECT_NE(used(scene).find("set Type = cylindrical"), std::string::npos);
  EXPECT_NE(used(scene).find("set Prescribed = 78.5"), std::string::npos);
}
