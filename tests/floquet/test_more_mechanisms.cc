/*
 * Problem:   multipliers of a column of beams, behind gears, along a sweep of speeds; what is asked for and not there
 * Reference: Mathieu's equation of the column's first mode by Runge and Kutta's method; the unsymmetric shaft of
 *            test_multipliers.cc; Hammond's rotor, which has twelve multipliers
 */

#include <samara/analysis/floquet.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "floquet_models.h"

using namespace samara;
using namespace floquet_models;

namespace
{
  std::string
  shipped(const std::string &model)
  {
    return "include " SAMARA_SOURCE_DIR "/" + model + "\n";
  }

  /** The unsymmetric shaft without its drive. */
  std::string
  free_shaft()
  {
    std::ostringstream text;
    text << std::ifstream(std::string(SAMARA_SOURCE_DIR) + "/" + shaft).rdbuf();
    std::string       result = text.str();
    const std::string drive  = "      set Prescribed = Omega*t\n";
    return result.erase(result.find(drive), drive.size());
  }

  /** The largest multiplier of q̈ + c q̇ + (a − b cos ωt) q = 0, real, over 2π/ω. */
  double
  largest_of_mathieu(const double a, const double b, const double c, const double omega)
  {
    const unsigned int n = 4000;
    const double       h = 2 * M_PI / omega / n;
    const auto         f = [&](const double t, const std::array<double, 2> &y) {
      return std::array<double, 2>{{y[1], -c * y[1] - (a - b * std::cos(omega * t)) * y[0]}};
    };
    const auto plus = [](const std::array<double, 2> &y, const double s, const std::array<double, 2> &k) {
      return std::array<double, 2>{{y[0] + s * k[0], y[1] + s * k[1]}};
    };
    std::array<std::array<double, 2>, 2> columns{{{{1, 0}}, {{0, 1}}}};
    for (auto &y : columns)
      for (unsigned int i = 0; i < n; ++i)
        {
          const double t  = i * h;
          const auto   k1 = f(t, y), k2 = f(t + h / 2, plus(y, h / 2, k1)), k3 = f(t + h / 2, plus(y, h / 2, k2)),
                     k4 = f(t + h, plus(y, h, k3));
          for (unsigned int j = 0; j < 2; ++j)
            y[j] += h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
        }
    const double half = (columns[0][0] + columns[1][1]) / 2,
                 det  = columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0];
    return std::abs(half) + std::sqrt(half * half - det);
  }
} // namespace



// A pinned column under P = 5 + cos ωt: sin(πx) obeys q̈ + π⁴(1 − P/π²) q = 0, in parametric resonance for ω of twice
// its frequency. The column is elastic along its axis, so that it moves on its orbit.
TEST(MoreMechanisms, ColumnUnderAPulsatingForce)
{
  const double pi2 = M_PI * M_PI, omega = 13.9;
  Scene        scene(shipped("prm/benchmarks/euler_column.prm"),
              {"Analyses = floquet",
                      "Constants/P = 5",
                      "Loads/force/Force = -(P + cos(13.9*t)), 0, 0",
                      "Bodies/column/Elements = 2",
                      "Floquet/Period = 2*pi/13.9",
                      "Floquet/Steps = 24",
                      "Floquet/Spectral radius = 0.5",
                      "Floquet/Settle = 6",
                      "Floquet/Highest frequency = 20",
                      "Floquet/Animations = 0"});
  auto        &floquet = scene.analysis<FloquetAnalysis>();
  floquet.run(scene.context);
  const double expected = largest_of_mathieu(pi2 * pi2 - 5 * pi2, pi2, 0, omega);
  ASSERT_FALSE(floquet.modes.empty());
  EXPECT_GT(expected, 1.05);
  EXPECT_NEAR(floquet.modes[0].multiplier.real(), -expected, 2e-4);
  EXPECT_EQ(floquet.modes[0].multiplier.imag(), 0);
}



// The shaft is driven through gears by a motor of three times its speed.
TEST(MoreMechanisms, UnsymmetricShaftBehindGears)
{
  std::string model  = free_shaft();
  const auto  insert = [&](const std::string &behind, const std::string &text) {
    model.insert(model.find(behind) + behind.size(), text);
  };
  insert("subsection Bodies\n", R"(
  subsection motor
    set Type    = rigid body
    set Mass    = 1 kg
    set Inertia = (0.1, 0.1, 0.1) kg*m^2
  end
)");
  insert("subsection Joints\n", R"(
  subsection drive
    set Type   = revolute
    set Body A = ground
    set Body B = motor
    set Axis   = 1, 0, 0
    subsection rotation
      set Prescribed = 3*Omega*t
    end
  end
  subsection gears
    set Type    = gear
    set Joint A = drive
    set Joint B = shaft
    set Ratio   = 1/3
  end
)");
  Scene scene(
    model,
    {"Analyses = floquet", "Loads/turning/Joint = drive", "Loads/turning/Speed = 3*Omega", "Floquet/Animations = 0"});
  auto &floquet = scene.analysis<FloquetAnalysis>();
  floquet.run(scene.context);
  ASSERT_GE(floquet.modes.size(), 3u);
  EXPECT_NEAR(floquet.modes[0].growth(), 1.099711268, 3e-7);
}



// Along a sweep a mode keeps its number, and each speed has its file. A shaft that turns freely has a multiplier of
// one besides.
TEST(MoreMechanisms, BranchesAlongASweep)
{
  const std::string folder = "floquet_sweep_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  Scene scene(free_shaft(), {"Analyses = floquet", "Rotor speeds = 47.5, 48, 48.5"});
  auto &floquet                = scene.analysis<FloquetAnalysis>();
  scene.context.folder         = folder;
  scene.context.pictures       = false;
  const std::vector<double> at = {47.5, 48, 48.5};
  scene.context.sweep          = at;
  floquet.start(scene.context);
  for (const double speed : at)
    {
      scene.context.speeds = scene.context.speeds_at(speed);
      scene.context.state  = scene.system.reference();
      floquet.run(scene.context);
    }
  floquet.finish(scene.context);

  std::ifstream                              in(folder + "/floquet_speeds.csv");
  std::string                                line;
  std::map<std::string, std::vector<double>> growth;
  std::getline(in, line);
  EXPECT_EQ(line.find("speed [rad/s],branch,multiplier,growth rate [1/s]"), 0u) << line;
  while (std::getline(in, line))
    {
      std::istringstream       words(line);
      std::vector<std::string> cells(4);
      for (auto &cell : cells)
        std::getline(words, cell, ',');
      growth[cells[1]].push_back(std::stod(cells[3]));
    }
  const double expected[] = {0.9795360108, 1.099711268, 0.9795413672};
  unsigned int n_growing  = 0;
  for (const auto &[branch, rates] : growth)
    if (rates[0] > 0.5)
      {
        ++n_growing;
        ASSERT_EQ(rates.size(), 3u) << branch;
        for (unsigned int i = 0; i < 3; ++i)
          EXPECT_NEAR(rates[i], expected[i], 3e-7) << at[i];
      }
  EXPECT_EQ(n_growing, 1u);
  for (const std::string speed : {"47.5", "48", "48.5"})
    EXPECT_TRUE(std::filesystem::exists(folder + "/floquet_" + speed + ".csv")) << speed;
  scene.input.analyses.clear();
  std::filesystem::remove_all(folder);
}



// A picture a step, at the times of the orbit.
TEST(MoreMechanisms, AnimationOfAMode)
{
  const std::string folder = "floquet_animation_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  Scene scene(pendulum, {"Analyses = floquet", "Floquet/Steps = 12", "Floquet/Animations = 1"});
  scene.context.folder   = folder;
  scene.context.pictures = true;
  scene.analysis<FloquetAnalysis>().run(scene.context);
  std::stringstream series;
  series << std::ifstream(folder + "/floquet_1.pvd").rdbuf();
  std::string           line;
  std::set<std::string> times;
  while (std::getline(series, line))
    if (const auto at = line.find("timestep=\""); at != std::string::npos)
      {
        times.insert(line.substr(at + 10, line.find('"', at + 10) - at - 10));
        const auto file = line.find("file=\"");
        ASSERT_NE(file, std::string::npos) << line;
        EXPECT_TRUE(std::filesystem::exists(folder + "/" + line.substr(file + 6, line.find('"', file + 6) - file - 6)))
          << line;
      }
  EXPECT_EQ(times.size(), 12u);
  EXPECT_FALSE(std::filesystem::exists(folder + "/floquet_2.pvd"));
  scene.input.analyses.clear();
  std::filesystem::remove_all(folder);
}



// Whoever wants more multipliers than there are gets those that there are, and no round-off beside them.
TEST(MoreMechanisms, NoMoreMultipliersThanThereAre)
{
  for (const std::string wanted : {"13", "1000"})
    {
      Scene scene(hammond, {"Floquet/Wanted = " + wanted, "Floquet/Method = implicit", "Floquet/Steps = 24"});
      auto &floquet = scene.analysis<FloquetAnalysis>();
      floquet.run(scene.context);
      ASSERT_EQ(floquet.modes.size(), 6u) << wanted; // pairs
      EXPECT_NEAR(std::abs(floquet.modes[0].multiplier), 0.863262002, 2e-8) << wanted;
      EXPECT_GT(std::abs(floquet.modes[5].multiplier), 0.4) << wanted;
    }
}



// A rotor with four flapping blades and eleven states of inflow in hover: seen in axes that turn, inflow and all, the
// coefficients are constant, and modes are there; in axes that stand they are periodic, and multipliers are the same.
TEST(MoreMechanisms, InflowInHoverHasModesAndMultipliers)
{
  const std::string        model = "include " SAMARA_SOURCE_DIR "/prm/rotorcraft/flapping_rotor.prm\n"
                                   R"(
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = Omega
  end
end
subsection Aerodynamics
  subsection flow
    set Type      = Peters-He inflow
    set Harmonics = 2
    set Power     = 3
  end
end
)";
  std::vector<std::string> hover = {"Constants/mu = 0",
                                    "Constants/tilt = 0",
                                    "States/sine/Value = 0 deg",
                                    "Subsystems/blade/Surfaces/blade/Stations = 4",
                                    "Analyses = static, modal",
                                    "Modal/Modes = 20",
                                    "Aerodynamics/flow/Hub = hub.centre"};
  Scene                    turning(model, hover);
  turning.equilibrium();
  const auto modes = turning.modes();

  hover[4] = "Analyses = floquet";
  hover[6] = "Aerodynamics/flow/Hub = ground";
  hover.insert(hover.end(),
               {"Floquet/Period = T", "Floquet/Method = classical", "Floquet/Wanted = 60", "Floquet/Animations = 0"});
  hover[5] = "Floquet/Steps = 48";
  Scene standing(model, hover);
  standing.context.state          = turning.context.state; // at t = 0 both axes are the same
  standing.context.is_equilibrium = turning.context.is_equilibrium;
  auto &floquet                   = standing.analysis<FloquetAnalysis>();
  floquet.run(standing.context);
  unsigned int n = 0;
  for (const auto &mode : modes)
    if (const auto expected = std::exp(mode.lambda * (2 * M_PI / 30)); !mode.is_free() && std::abs(expected) > 1e-3)
      {
        ++n;
        double nearest = 1;
        for (const auto &found : floquet.modes)
          nearest = std::min(
            {nearest, std::abs(expected - found.multiplier), std::abs(std::conj(expected) - found.multiplier)});
        EXPECT_LT(nearest, 1e-8) << mode.lambda;
      }
  EXPECT_GE(n, 7u);
}



// The spring of a pendulum on a moving hinge fades away, ever so slowly; with it the pendulum would be stable. What a
// period lacks is small, and the motion that repeats itself is far away: it has no spring, and is Mathieu's.
TEST(MoreMechanisms, OrbitFarBehindASmallGap)
{
  for (const std::string memory : {"10 s", "1e3 s", "1e5 s", "1e7 s"})
    {
      SCOPED_TRACE(memory);
      Scene scene(shipped(pendulum) + R"(
subsection States
  subsection fading
    set Type    = first order
    set Rate    = -fading/memory
    set Initial = 0.5
    set Scale   = 1
  end
end
subsection Constants
  set memory = 10 s
end
subsection Joints
  subsection hinge
    subsection rotation
      set Moment = -0.3*fading*hinge.rotation
    end
  end
end
)",
                  {"Constants/memory = " + memory, "Floquet/Animations = 0"});
      auto &floquet = scene.analysis<FloquetAnalysis>();
      floquet.run(scene.context);
      EXPECT_LT(std::abs(floquet.orbit.states[0]), 1e-6);
      const std::string said = scene.stream.str();
      EXPECT_NE(said.find(memory == "1e7 s" ? "moved the start by up to 5.0e-01 of the scales (state fading)" :
                                              "of the scales (state fading)"),
                std::string::npos)
        << said;
      ASSERT_EQ(floquet.modes.size(), 3u);
      EXPECT_NEAR(std::abs(floquet.modes[0].multiplier), 1.26394066521, 1e-6);
    }
}
