// Modes of blades have names by what blades do: of a uniform blade whose frequencies are known by name (Wright et al.
// 1982: clamped at the axis, eta = 12, flap 13.1702, 37.6031, 79.6145), of a strip as a beam and as a shell, in any
// direction.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  /** Names and frequencies of the equilibrium's modes. */
  std::vector<std::pair<std::string, double>>
  named_modes(Scene &scene)
  {
    scene.equilibrium();
    auto &modal = scene.analysis<ModalAnalysis>();
    modal.run(scene.context);
    std::vector<std::pair<std::string, double>> result;
    for (unsigned int i = 0; i < modal.contents.size(); ++i)
      result.emplace_back(modal.contents[i].family, modal.modes[i].frequency());
    return result;
  }

  void
  expect_named(const std::vector<std::pair<std::string, double>> &modes,
               const std::string                                 &name,
               const double                                       frequency)
  {
    const auto found = std::find_if(modes.begin(), modes.end(), [&](const auto &mode) { return mode.first == name; });
    ASSERT_NE(found, modes.end()) << name;
    EXPECT_NEAR(found->second, frequency, 1e-3 * frequency) << name;
  }

  std::vector<std::string>
  names_of_strip(const std::string &model, const std::vector<std::string> &overrides)
  {
    Scene                    scene(model, overrides);
    std::vector<std::string> names;
    for (const auto &mode : named_modes(scene))
      names.push_back(mode.first);
    return names;
  }
} // namespace



TEST(ModeNames, UniformBlade)
{
  // lag has four times the stiffness: its frequencies are mixed with those of flap
  Scene      turning("prm/benchmarks/rotating_beam.prm", {"Sections/slender/EI3 = 4"});
  const auto modes = named_modes(turning);
  expect_named(modes, "flap 1", 13.1702);
  expect_named(modes, "flap 2", 37.6031);
  expect_named(modes, "flap 3", 79.6145);
  expect_named(modes, "lag 1", 2 * 4.263225);

  // at rest, too
  Scene      still("prm/benchmarks/rotating_beam.prm", {"Sections/slender/EI3 = 4", "Constants/eta = 0"});
  const auto at_rest = named_modes(still);
  for (const double factor : {1., 2.})
    for (const auto &[number, frequency] : {std::pair(1, 3.51602), std::pair(2, 22.0345), std::pair(3, 61.6972)})
      expect_named(at_rest, (factor == 1 ? "flap " : "lag ") + std::to_string(number), factor * frequency);
}



TEST(ModeNames, OtherAxis)
{
  // about the axis of y flap is what moves along y
  const std::string model = R"(
subsection Sections
  subsection slender
    set Type = engineering constants
    set EA   = 1e8
    set GA2  = 1e7
    set GA3  = 1e7
    set GJ   = 1
    set EI2  = 4
    set EI3  = 1
    set Mass = 1
  end
end
subsection Bodies
  subsection blade
    set Type    = beam
    set Points  = 0, 0, 0.1; 0, 0, 1.1
    set Axis 2  = 0, 1, 0
    set Section = slender
  end
end
subsection Joints
  subsection root
    set Type   = rigid
    set Body A = ground
    set Body B = blade.start
  end
end
subsection Loads
  subsection rotor
    set Type  = steady rotation
    set Axis  = 0, 1, 0
    set Speed = 0.01
  end
end
subsection Modal
  set Modes = 4
end
)";
  Scene             scene(model);
  const auto        modes = named_modes(scene);
  expect_named(modes, "flap 1", 3.51602);
  expect_named(modes, "lag 1", 2 * 3.51602);
}



TEST(ModeNames, BeamAndShellAlike)
{
  const auto beam  = names_of_strip("prm/studies/blade_of_a_strip.prm", {"Modal/Modes = 6", "Modal/Animations = 0"});
  const auto shell = names_of_strip("prm/studies/blade_of_a_strip_shell.prm",
                                    {"Modal/Modes = 6", "Modal/Animations = 0", "Constants/n = 4"});
  EXPECT_EQ(beam, shell);
  for (const std::string name : {"flap 1", "flap 2", "lag 1", "torsion 1"})
    EXPECT_EQ(std::count(beam.begin(), beam.end(), name), 1) << name;
}



// What is no blade has modes without names: a shaft along its axis, and what turns about nothing.
TEST(ModeNames, NoBlades)
{
  Scene      shaft("prm/benchmarks/spinning_shaft.prm");
  const auto modes = named_modes(shaft);
  ASSERT_FALSE(modes.empty());
  for (const auto &[name, frequency] : modes)
    EXPECT_EQ(name, "") << frequency;
  Scene still("prm/benchmarks/timoshenko_beam.prm");
  EXPECT_TRUE(named_modes(still).empty());
}
