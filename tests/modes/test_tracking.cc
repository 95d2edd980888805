// Modes keep their numbers along a sweep of the speed, also where two branches cross.
//
// The clamped blade of prm/benchmarks/rotating_beam.prm with a lag stiffness 4 times the flap stiffness: flap 1 starts
// below lag 1 and crosses it between Ω = 6 and 8. References: rotating_beam.inc, clamped, delta = 0; lag in units of
// its own stiffness, ω = 2 μ_lag(Ω/2). 6 digits are kept here.

#include "../said_by.h"
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

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
    double      speed, branch, frequency;
    std::string family, pattern;
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
        std::istringstream       words(line);
        std::vector<std::string> cells(8);
        for (auto &cell : cells)
          std::getline(words, cell, ',');
        rows.push_back({std::stod(cells[0]), std::stod(cells[1]), std::stod(cells[2]), cells[6], cells[7]});
      }
    return rows;
  }



  /** The fan of a model at some speeds. */
  std::vector<TrackedMode>
  fan_of(Scene &scene, const std::vector<double> &at)
  {
    const std::string folder = "tracking_" + std::to_string(getpid());
    std::filesystem::create_directory(folder);
    scene.context.folder   = folder;
    scene.context.pictures = false;
    scene.context.sweep    = at;
    auto &statics          = scene.analysis<StaticAnalysis>();
    auto &modal            = scene.analysis<ModalAnalysis>();
    statics.start(scene.context);
    modal.start(scene.context);
    for (const double speed : at)
      {
        scene.context.speeds = scene.context.speeds_at(speed);
        statics.run(scene.context);
        modal.run(scene.context);
      }
    modal.finish(scene.context);
    scene.input.analyses.clear(); // they write until they end
    const auto fan = read_fan(folder + "/fan.csv");
    std::filesystem::remove_all(folder);
    return fan;
  }
} // namespace



TEST(Tracking, BranchesCross)
{
  Scene      scene("prm/benchmarks/rotating_beam.prm",
              {"Constants/eta = 1", "Sections/slender/EI3 = 4", "Modal/Animations = 0"});
  const auto fan = fan_of(scene, speeds);
  EXPECT_EQ(fan.at(0).family, "flap 1");
  EXPECT_EQ(fan.at(0).pattern, "");

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



// Between 14 and 16 rad/s the airframe's regressive motion changes its sense of turning as the rotor sees it: the other
// member of its pair is told from there on, with the conjugate shape. It is one branch all the same.
TEST(Tracking, ThroughZeroInTurningAxes)
{
  const std::vector<double>                  at = {10, 12, 14, 16, 18, 20, 22};
  Scene                                      scene("prm/examples/floquet/ground_resonance.prm", {});
  std::map<double, std::vector<TrackedMode>> branches;
  for (const auto &row : fan_of(scene, at))
    branches[row.branch].push_back(row);
  EXPECT_EQ(branches.size(), 6u);
  unsigned int turned = 0;
  for (const auto &[number, rows] : branches)
    {
      EXPECT_EQ(rows.size(), at.size()) << number;
      turned += rows.front().pattern == "progressive" && rows.back().pattern == "regressive";
    }
  EXPECT_EQ(turned, 1u);
}



// A progressive wave and a regressive one are conjugates of each other, but two modes: where one leaves those that are
// looked at and the other enters, far from the real axis, a branch ends and another begins. Near it, or near the band,
// it is one.
TEST(Tracking, ConjugateShapes)
{
  const unsigned int n       = 4;
  auto               pattern = std::make_shared<Pattern>();
  for (unsigned int i = 0; i <= n; ++i)
    pattern->column_start.push_back(i);
  for (unsigned int i = 0; i < n; ++i)
    pattern->rows.push_back(i);
  SparseMatrix M(pattern);
  std::fill(M.values.begin(), M.values.end(), 1.);
  const std::complex<double> I(0, 1);
  const Eigen::VectorXcd     collective = Eigen::Vector4cd(1, 1, 1, 1), wave = Eigen::Vector4cd(1, I, -1, -I);
  const auto                 mode = [&](const double frequency, const Eigen::VectorXcd &shape) {
    return Mode{{-0.1, frequency}, shape.normalized(), 0.};
  };
  using Numbers = std::vector<unsigned int>;
  // frequencies of the wave before and after, the band; whether it is one branch
  const std::tuple<double, double, double, bool> cases[] = {{10, 10.1, INFINITY, false},
                                                            {0.3, 0.2, INFINITY, true},
                                                            {0.3, 0.8, INFINITY, false},
                                                            {10.1, 9.8, 10.2, true},
                                                            {10.1, 0.1, 10.2, false}};
  for (const auto &[before, after, band, is_one] : cases)
    {
      ModeTracking      tracking;
      std::vector<Mode> modes = {mode(5, collective), mode(before, wave)};
      EXPECT_EQ(tracking.follow(modes, M, band), (Numbers{1, 2}));
      modes = {mode(6, collective), mode(after, wave.conjugate())};
      EXPECT_EQ(tracking.follow(modes, M, band), (Numbers{1, is_one ? 2u : 3u})) << before << " " << after;
      modes = {mode(7, collective), mode(after, wave.conjugate())};
      EXPECT_EQ(tracking.follow(modes, M, band), (Numbers{1, is_one ? 2u : 3u})) << before << " " << after;
    }
}



// Four blades that do not feel each other have each mode four times, and any combination of these is one. Branches are
// not lost among them, and with a symmetry each is one pattern of one family over all speeds.
TEST(Tracking, EqualBlades)
{
  const std::vector<double> at = {5.6, 16.8, 28};
  for (const std::string symmetry : {"", "blade 1, blade 2, blade 3, blade 4"})
    {
      Scene      scene("prm/rotorcraft/puma_fan.prm", {"Modal/Symmetry = " + symmetry, "Modal/Modes = 12"});
      const auto fan = fan_of(scene, at);
      std::map<double, std::vector<TrackedMode>> branches;
      for (const auto &row : fan)
        branches[row.branch].push_back(row);
      EXPECT_EQ(fan.size(), 36u);
      EXPECT_EQ(branches.size(), 12u) << symmetry;
      std::map<std::string, std::set<std::string>> patterns;
      for (const auto &[number, rows] : branches)
        for (const auto &row : rows)
          {
            EXPECT_EQ(row.family, rows[0].family) << number;
            EXPECT_EQ(row.pattern, rows[0].pattern) << number;
            patterns[row.family].insert(row.pattern);
          }
      const std::set<std::string> all = {"collective", "progressive", "regressive", "differential"};
      if (symmetry.empty())
        EXPECT_EQ(patterns,
                  (std::map<std::string, std::set<std::string>>{{"flap 1", {""}}, {"flap 2", {""}}, {"lag 1", {""}}}));
      else
        EXPECT_EQ(patterns,
                  (std::map<std::string, std::set<std::string>>{{"flap 1", all}, {"flap 2", all}, {"lag 1", all}}));
    }
}



TEST(Tracking, SymmetryOfUnknownParts)
{
  Scene scene("prm/rotorcraft/puma_fan.prm",
              {"Modal/Symmetry = blade 1, blade 2, blade 3, blade 5", "Modal/Modes = 4"});
  scene.equilibrium();
  const std::string said = said_by<InputError>([&]() { scene.modes(); });
  EXPECT_NE(said.find("<blade 5:"), std::string::npos) << said;
}



// A diagram that starts at standstill: three clamped blades on a held hub. There, too, names are those of other speeds,
// and no mixture of that speed is handed on to the next one.
TEST(Tracking, NamesFromStandstillOn)
{
  Scene                     scene(R"(
set Analyses = static, modal
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = 1e8
    set GA2 = 1e8
    set GA3 = 1e8
    set GJ = 1e5
    set EI2 = 1e5
    set EI3 = 1e6
    set Mass = 10
    set I2 = 0.1
    set I3 = 0.5
  end
end
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 10
    set Inertia = 1, 1, 1
  end
end
subsection Subsystems
  subsection b
    set Copies = 3 about z
    subsection Bodies
      subsection blade
        set Type = beam
        set Points = 0.5, 0, 0; 6, 0, 0
        set Section = s
      end
    end
    subsection Joints
      subsection root
        set Type = rigid
        set Body A = hub
        set Body B = blade.start
        set Gap = allowed
      end
    end
  end
end
subsection Joints
  subsection shaft
    set Type = revolute
    set Body A = ground
    set Body B = hub
  end
end
subsection Loads
  subsection spin
    set Type = steady rotation
    set Joint = shaft
    set Speed = 10
  end
end
subsection Modal
  set Modes = 9
  set Hold rotations = true
  set Symmetry = b 1, b 2, b 3
  set Animations = 0
end
)");
  const std::vector<double> at      = {0, 5, 10};
  scene.context.sweep               = at;
  auto                       &modal = scene.analysis<ModalAnalysis>();
  const std::set<std::string> all   = {"collective", "progressive", "regressive"};
  for (const double speed : at)
    {
      SCOPED_TRACE(speed);
      scene.context.speeds = scene.context.speeds_at(speed);
      scene.equilibrium();
      modal.run(scene.context);
      ASSERT_EQ(modal.contents.size(), 9u) << scene.stream.str();
      std::map<std::string, std::set<std::string>> patterns;
      for (const auto &content : modal.contents)
        {
          patterns[content.family].insert(content.pattern);
          EXPECT_GT(content.pattern_share, 0.99) << content.family << " " << content.pattern;
        }
      EXPECT_EQ(patterns,
                (std::map<std::string, std::set<std::string>>{{"flap 1", all}, {"flap 2", all}, {"lag 1", all}}));
    }
  EXPECT_EQ(scene.stream.str().find("do not turn about one axis"), std::string::npos) << scene.stream.str();
}
