/*
 * Problem:   where and when in a motion a section is nearest to failure, and the stresses of its layers there
 * Reference: the same stresses found from probes at each time; bending of a strip of plies in closed form
 */

#include <samara/analysis/dynamic.h>
#include <samara/cosserat/section_kinds.h>
#include <samara/recovery/section_report.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace samara;

namespace
{
  /** A cantilever of a strip of three plies along x, with a force at its end that swings. */
  const std::string swinging_strip = R"(
set Analyses = dynamic, section
subsection Materials
  subsection ply
    set Type = orthotropic
    set E1   = 100e9
    set E2   = 10e9
    set G12  = 5e9
    set nu12 = 0
    set nu23 = 0
    set Density = 1500
    set Tensile strength     = 1e9, 5e7, 5e7
    set Compressive strength = 8e8, 2e8, 2e8
    set Shear strength       = 7e7, 7e7, 5e7
  end
end
subsection Layups
  subsection three
    set Material      = ply
    set Angles        = 0/90/0
    set Ply thickness = 2 mm
  end
end
subsection Sections
  subsection strip
    set Type     = rectangle
    set Width 2  = 40 mm
    set Layup    = three
    set Elements = 4
    set Degree   = 2
  end
end
subsection Bodies
  subsection beam
    set Type     = beam
    set Points   = 0, 0, 0; 0.5, 0, 0
    set Section  = strip
    set Elements = 2
    set Damping  = 1 ms
  end
end
subsection Joints
  subsection clamp
    set Type   = rigid
    set Body A = ground
    set Body B = beam.start
  end
end
subsection Loads
  subsection push
    set Type  = point load
    set At    = beam.end
    set Force = (0, 0, 40*sin(60*t))
  end
end
subsection Dynamic
  set End time = 0.1
  set Step     = 0.005
  set Stages   = 2
end
subsection Section
  set Largest of = beam
  set Criterion  = Tsai-Wu
end
)";



  struct ResultFolder
  {
    std::string name = "largest_stress_" + std::to_string(getpid());

    ResultFolder()
    {
      std::filesystem::create_directories(name);
    }
    ~ResultFolder()
    {
      std::filesystem::remove_all(name);
    }
  };



  /** Runs all analyses, the motion seen by the report of sections. @p seen is called in each reported state. */
  void
  run_watched(Scene &scene, const std::string &folder, const std::function<void(const State &)> &seen)
  {
    scene.context.folder                       = folder;
    scene.analysis<DynamicAnalysis>().observer = seen;
    auto &report                               = scene.analysis<SectionReport>();
    report.watch(scene.input.model, scene.input.analyses);
    scene.analysis<DynamicAnalysis>().run(scene.context);
    report.run(scene.context);
  }
} // namespace



TEST(LargestStress, IsThatOfTheProbes)
{
  const ResultFolder folder;
  Scene              scene(swinging_strip);
  const auto        &model   = scene.input.model;
  double             largest = 0, time = -1, place = -1;
  run_watched(scene, folder.name, [&](const State &state) {
    for (const double x : {0., 0.25, 0.5, 0.75, 1.})
      if (const double index = model.probe("beam.at " + number_to_text(x) + ".Tsai-Wu index").value(state);
          index > largest)
        {
          largest = index;
          time    = state.time;
          place   = x;
        }
  });
  EXPECT_EQ(place, 0.);
  EXPECT_GT(time, 0.01);
  EXPECT_LT(time, 0.09); // not the last one

  const auto rows = [&](const std::string &file) {
    std::ifstream                         in(folder.name + "/" + file);
    std::vector<std::vector<std::string>> result;
    for (std::string line; std::getline(in, line);)
      result.push_back(split_top_level(line, ','));
    return result;
  };
  const auto whole = rows("stresses.csv");
  ASSERT_EQ(whole.size(), 2u);
  const auto column = [&](const std::string &name) {
    return std::find(whole[0].begin(), whole[0].end(), name) - whole[0].begin();
  };
  EXPECT_NEAR(std::stod(whole[1].at(column("time [s]"))), time, 1e-12);
  EXPECT_NEAR(std::stod(whole[1].at(column("index of Tsai-Wu"))), largest, 1e-6 * largest);
  EXPECT_EQ(whole[1][0], "beam at 0");

  // three layers; the outer ones have the stress of plies in bending, at their outer faces
  const auto plies = rows("stresses_of_plies.csv");
  ASSERT_EQ(plies.size(), 4u);
  const double M = std::stod(whole[1].at(column("M2 [N m]"))), h = 0.002, b = 0.04;
  const double EI = b / 12 * (100e9 * (std::pow(3 * h, 3) - std::pow(h, 3)) + 10e9 * std::pow(h, 3));
  EXPECT_GT(std::abs(M), 5.);
  const double z = 1.5 * h;
  EXPECT_NEAR(std::stod(plies[1][7]), -100e9 * z * M / EI, 1e-3 * 100e9 * z * std::abs(M) / EI);
  EXPECT_NEAR(std::stod(plies[3][7]), 100e9 * z * M / EI, 1e-3 * 100e9 * z * std::abs(M) / EI);
  EXPECT_EQ(plies[2][6], "90");
  // across its fibres the middle ply is stressed along the beam: 22 in its own axes
  const double middle = 10e9 * 0.5 * h * std::abs(M) / EI;
  EXPECT_NEAR(std::abs(std::stod(plies[2][8])), middle, 1e-3 * middle);
}



TEST(LargestStress, WithoutAMotionItIsThatOfTheStateReached)
{
  const ResultFolder folder;
  std::string        text = swinging_strip;
  text.replace(text.find("dynamic, section"), 16, "static, section");
  text.replace(text.find("40*sin(60*t)"), 12, "40");
  Scene scene(text);
  scene.context.folder = folder.name;
  scene.equilibrium();
  auto &report = scene.analysis<SectionReport>();
  report.watch(scene.input.model, scene.input.analyses);
  report.run(scene.context);
  EXPECT_NE(scene.stream.str().find("is largest at 0 of its length"), std::string::npos) << scene.stream.str();
  EXPECT_TRUE(std::filesystem::exists(folder.name + "/stresses_of_plies.csv"));
}



TEST(LargestStress, MissingStrengthsAndBeamsAreRefused)
{
  const ResultFolder folder;
  const auto         said = [&](const std::string &from, const std::string &to) {
    std::string text = swinging_strip;
    text.replace(text.find(from), from.size(), to);
    try
      {
        Scene scene(text);
        run_watched(scene, folder.name, {});
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  EXPECT_NE(said("Largest of = beam", "Largest of = bean").find("beam"), std::string::npos);
  EXPECT_NE(said("    set Shear strength       = 7e7, 7e7, 5e7\n", "").find("strengths"), std::string::npos);
  EXPECT_NE(said("Criterion  = Tsai-Wu", "Criterion  = von Mises").find("strengths"), std::string::npos);
  EXPECT_EQ(said("Criterion  = Tsai-Wu", "Criterion  = max stress"), "");
}
