/*
 * Problem:   long analyses that say nothing while they work
 * Reference: a line in each of given intervals, and none in less; counts by hand
 */

#include <samara/analysis/linearization.h>
#include <samara/analysis/progress.h>
#include <samara/analysis/section_map.h>
#include <samara/solvers/eigen.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

using namespace samara;

namespace
{
  std::vector<std::string>
  lines_of(const std::string &text)
  {
    std::istringstream       in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }
} // namespace



TEST(Progress, LinesSayWhatIsBeingDone)
{
  std::ostringstream out;
  Log                log(out);
  {
    Progress progress(log, "modal", "first", nullptr, 0.2);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    progress.teller()("second, 3 of 7");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  const auto lines = lines_of(out.str());
  ASSERT_GE(lines.size(), 2u); // a busy machine may leave some out
  EXPECT_EQ(lines.front().rfind("  modal: first, ", 0), 0u) << lines.front();
  EXPECT_EQ(lines.back().rfind("  modal: second, 3 of 7, ", 0), 0u) << lines.back();
  EXPECT_EQ(log.text(), ""); // nothing that a report has to keep
}



TEST(Progress, ShortAnalysesSayNothing)
{
  std::ostringstream out;
  Log                log(out), quiet(out, true);
  for (unsigned int i = 0; i < 20; ++i)
    Progress(log, "modal", "first", nullptr)("second");
  {
    const Progress progress(quiet, "modal", "first", nullptr, 0.05);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  EXPECT_EQ(out.str(), "");
}



TEST(Progress, SearchesForModesSayHowFarTheyAre)
{
  // 200 elements: more than what dense matrices are for
  Scene                    scene(R"(
subsection Sections
  subsection round
    set Type = tube
    set E = 210 GPa
    set Density = 7800
    set Outer radius = 1 cm
  end
end
subsection Bodies
  subsection rod
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Section = round
    set Elements = 200
  end
end
subsection Joints
  subsection clamp
    set Type = rigid
    set Body A = ground
    set Body B = rod.start
  end
end
)");
  std::vector<std::string> said;
  const Linearization      motion(scene.system, scene.context.state);
  const auto               modes = find_modes(motion, 5, {}, [&](const std::string &text) { said.push_back(text); });
  ASSERT_EQ(modes.found.size(), 5u);
  const auto n_with = [&](const std::string &part) {
    return std::count_if(said.begin(), said.end(), [&](const auto &s) { return s.find(part) != std::string::npos; });
  };
  EXPECT_GT(n_with("factors of the matrix of "), 0);
  EXPECT_GT(n_with("basis of "), 0);
  EXPECT_GT(n_with("of 10"), 0) << "which of ten eigenvalues";
}



TEST(Progress, MapsOverAPeriodCountTheirProducts)
{
  Scene                    scene("prm/examples/floquet/mathieu_pendulum.prm");
  const RepeatedParts      none(scene.system);
  SectionMap               map(scene.system, {1., 8, 2, 1., 1e-10, 20}, none);
  std::vector<std::string> said;
  map.listener = [&](const std::string &text) { said.push_back(text); };
  map.settle(scene.context.state, 3, 0.);
  ASSERT_EQ(said.size(), 3u); // one a period
  EXPECT_EQ(said[0], "the motion settles, period 1 of at most 3");
  EXPECT_EQ(said[2].rfind("the motion settles, period 3 of at most 3, it lacks ", 0), 0u) << said[2];
  said.clear();
  std::vector<double> x(map.map.size(), 0.);
  map.begin("columns", 2);
  map.apply(x.data());
  map.apply(x.data());
  EXPECT_EQ(said,
            std::vector<std::string>({"columns",
                                      "columns, 1 of at most 2 products with the map over the period",
                                      "columns, 2 of at most 2 products with the map over the period"}));
}
