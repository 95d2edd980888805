// Modes keep their numbers along a sweep of the speed, also where two branches cross.
//
// The clamped blade of prm/benchmarks/rotating_beam.prm with a lag stiffness 4 times the flap stiffness: flap 1 starts
// below lag 1 and crosses it between Ω = 6 and 8. References: rotating_beam.inc, clamped, delta = 0; lag in units of
// its own stiffness, ω = 2 μ_lag(Ω/2). 6 digits are kept here.

#include <gtest/gtest.h>

#include <filesystem>

#include "modes.h"

using namespace samara;

namespace
{
  const std::vector<double> speeds = {0, 2, 4, 6, 8, 10, 12};
  const double              flap[] = {3.51602, 4.13732, 5.58500, 7.36037, 9.25684, 11.20233, 13.17015};
  const double              lag[] =
    {2 * 3.516015, 2 * 3.543236, 2 * 3.621797, 2 * 3.743512, 2 * 3.897723, 2 * 4.073896, 2 * 4.263225};

  struct TrackedMode
  {
    double speed, branch, frequency;
  };

  std::vector<TrackedMode>
  read_fan(const std::string &name)
  {
    std::ifstream            in(name);
    std::string              line;
    std::vector<TrackedMode> rows;
    std::getline(in, line);
    while (std::getline(in, line))
      {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        TrackedMode        row;
        words >> row.speed >> row.branch >> row.frequency;
        rows.push_back(row);
      }
    return rows;
  }
} // namespace



TEST(Tracking, BranchesCross)
{
  const std::string folder = "tracking_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  {
    Scene scene("prm/benchmarks/rotating_beam.prm",
                {"Constants/eta = 1", "Sections/slender/EI3 = 4", "Modal/Animations = 0"});
    scene.context.folder   = folder;
    scene.context.pictures = false;
    scene.context.sweep    = speeds;
    auto &statics          = scene.analysis<StaticAnalysis>();
    auto &modal            = scene.analysis<ModalAnalysis>();
    statics.start(scene.context);
    modal.start(scene.context);
    for (const double speed : speeds)
      {
        scene.context.speeds = scene.context.speeds_at(speed);
        statics.run(scene.context);
        modal.run(scene.context);
      }
    modal.finish(scene.context);
  }
  const auto fan = read_fan(folder + "/fan.csv");
  std::filesystem::remove_all(folder);

  for (unsigned int i = 0; i < speeds.size(); ++i)
    for (const unsigned int branch : {1, 2})
      {
        const double expected = branch == 1 ? flap[i] : lag[i];
        const auto   row      = std::find_if(fan.begin(), fan.end(), [&](const TrackedMode &r) {
          return r.speed == speeds[i] && r.branch == branch;
        });
        ASSERT_NE(row, fan.end()) << "no branch " << branch << " at speed " << speeds[i];
        EXPECT_NEAR(row->frequency, expected, 1e-4 * expected) << "branch " << branch << " at speed " << speeds[i];
      }
}



// At a crossing two shapes are any two of a plane. Those that continue the branches are found there, so that each goes
// on through it; without that, one in two crossings changes their numbers.
TEST(Tracking, EqualFrequenciesOnTheWay)
{
  const unsigned int n       = 4;
  auto               pattern = std::make_shared<Pattern>();
  for (unsigned int i = 0; i <= n; ++i)
    pattern->column_start.push_back(i);
  for (unsigned int i = 0; i < n; ++i)
    pattern->rows.push_back(i);
  SparseMatrix M(pattern);
  for (unsigned int i = 0; i < n; ++i)
    M.values[i] = 1. + i;

  const auto mode = [&](const double frequency, const Eigen::VectorXcd &shape) {
    return Mode{{0., frequency}, shape.normalized(), 0.};
  };
  const Eigen::VectorXcd a = Eigen::Vector4cd(1, 0, 0, 0), b = Eigen::Vector4cd(0, 1, 0.2, 0);
  for (const double angle : {0.1, 0.7853, 1.2, 2.5})
    {
      ModeTracking      tracking;
      std::vector<Mode> before = {mode(1, a), mode(2, b)};
      EXPECT_EQ(tracking.follow(before, M), (std::vector<unsigned int>{1, 2}));
      std::vector<Mode> at = {mode(1.5, std::cos(angle) * a + std::sin(angle) * b),
                              mode(1.5, std::sin(angle) * a - std::cos(angle) * b)};
      tracking.follow(at, M);
      std::vector<Mode> after = {mode(1.8, b), mode(1.9, a)};
      EXPECT_EQ(tracking.follow(after, M), (std::vector<unsigned int>{2, 1})) << angle;
    }
}
