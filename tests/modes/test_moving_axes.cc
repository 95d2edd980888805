// Parts that turn against each other: modes are found in axes in which coefficients are constant, and refused where
// there are none. Independent references: the same rotor alone; closed forms of a disc on springs.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "modes.h"

using namespace samara;

namespace
{
  /** Blocks of an input file. */
  struct Parts
  {
    std::string bodies, joints, loads;

    Parts &
    operator+=(const Parts &other)
    {
      bodies += other.bodies;
      joints += other.joints;
      loads += other.loads;
      return *this;
    }
  };

  /** A rotor of equal blades about z at the height z, on a shaft in the body @p carrier. */
  Parts
  rotor_on_shaft(const std::string &name,
                 const unsigned int n_blades,
                 const double       z,
                 const std::string &carrier,
                 const double       speed,
                 const bool         is_hinged)
  {
    Parts parts;
    parts.bodies = " subsection " + name + "\n set Type = rigid body\n set Mass = 5\n set Inertia = 0.1, 0.1, 0.2\n" +
                   " set Position = 0, 0, " + exact(z) + "\n end\n";
    parts.joints = " subsection shaft of " + name + "\n set Type = revolute\n set Body A = " + carrier +
                   "\n set Body B = " + name + "\n set Position = 0, 0, " + exact(z) + "\n end\n";
    parts.loads = " subsection drive of " + name + "\n set Type = steady rotation\n set Joint = shaft of " + name +
                  "\n set Speed = " + exact(speed) + "\n end\n";
    for (unsigned int i = 0; i < n_blades; ++i)
      {
        const double      angle = 2 * M_PI * i / n_blades, c = std::cos(angle), s = std::sin(angle);
        const std::string blade = "blade " + std::to_string(i) + " of " + name;
        parts.bodies += " subsection " + blade + "\n set Type = beam\n set Points = " + exact(0.1 * c) + ", " +
                        exact(0.1 * s) + ", " + exact(z) + "; " + exact(2 * c) + ", " + exact(2 * s) + ", " + exact(z) +
                        "\n set Axis 2 = " + exact(-s) + ", " + exact(c) +
                        ", 0\n set Elements = 2\n set Section = blade\n set Twist = 0.1 + 0.05*s\n end\n";
        parts.joints +=
          " subsection root of " + blade + "\n set Type = " + (is_hinged ? "universal" : "rigid") +
          "\n set Body A = " + name + "\n set Body B = " + blade + ".start\n" +
          (is_hinged ? " set Axis = " + exact(-s) + ", " + exact(c) + ", 0\n set Second axis = 0, 0, 1\n" : "") +
          " end\n";
      }
    return parts;
  }

  /** A body that springs of the ground carry, @p stiffness along z, x, y. */
  Parts
  pylon(const std::string &stiffness)
  {
    return {" subsection pylon\n set Type = rigid body\n set Mass = 20\n set Inertia = 1, 1, 1\n end\n",
            " subsection mount\n set Type = flexible joint\n set Body A = ground\n set Body B = pylon\n"
            " set Axis = 0, 0, 1\n set Axis 2 = 1, 0, 0\n set Stiffness = " +
              stiffness + "\n set Rotational stiffness = 1e5, 1e5, 1e5\n end\n",
            ""};
  }

  std::string
  model(const std::vector<Parts> &all, const unsigned int n_modes)
  {
    Parts sum;
    for (const auto &parts : all)
      sum += parts;
    return "set Analyses = static, modal\nsubsection Sections\n subsection blade\n set Type = engineering constants\n"
           " set EA = 1e7\n set GA2 = 3e6\n set GA3 = 2e6\n set GJ = 400\n set EI2 = 300\n set EI3 = 3000\n set Mass = 2\n"
           " set I2 = 1e-4\n set I3 = 1e-3\n end\nend\nsubsection Bodies\n" +
           sum.bodies + "end\nsubsection Joints\n" + sum.joints + "end\nsubsection Loads\n" + sum.loads +
           "end\nsubsection Modal\n set Modes = " + std::to_string(n_modes) + "\n set Hold rotations = true\nend\n";
  }

  /** Why modes of this model are refused; empty if they are not. */
  std::string
  refusal(const std::string &text)
  {
    Scene scene(text);
    scene.equilibrium();
    try
      {
        scene.modes();
      }
    catch (const InputError &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



// Two rotors turn against each other in rigid ground: each has the modes that it has alone, seen in its own axes.
TEST(MovingAxes, RotorsWithNothingInCommonButTheGround)
{
  for (const bool is_hinged : {false, true})
    {
      Scene alone(model({rotor_on_shaft("one", 2, 0, "ground", 30, is_hinged)}, 6)),
        both(model({rotor_on_shaft("one", 2, 0, "ground", 30, is_hinged),
                    rotor_on_shaft("two", 2, 1, "ground", -30, is_hinged)},
                   12));
      const auto a = frequencies(alone), b = frequencies(both);
      ASSERT_EQ(b.size(), 2 * a.size());
      for (unsigned int i = 0; i < b.size(); ++i)
        EXPECT_NEAR(b[i], a[i / 2], 1e-8 * b[i]);
      EXPECT_NE(both.stream.str().find("constant in axes that turn with each part\n"), std::string::npos)
        << both.stream.str();
    }
}



// Springs that are the same in all directions turn with a rotor as well: then its pylon is seen in the rotor's axes,
// and a rotor in rigid ground beside it in its own. Ground and all, turned about the same axis, has the same modes.
TEST(MovingAxes, RotorsOnYieldingMounts)
{
  for (const unsigned int n_blades : {2, 4})
    {
      const Parts one = rotor_on_shaft("one", n_blades, 0, "pylon", 30, false);
      Scene       by_joint(model({pylon("1e6, 1e5, 1e5"), one}, 8));
      const auto  a = frequencies(by_joint);
      EXPECT_NE(by_joint.stream.str().find("constant in axes that all turn with <one>\n"), std::string::npos);
      EXPECT_NE(refusal(model({pylon("1e6, 1e5, 2e5"), one}, 8)).find("Coefficients are periodic"), std::string::npos);

      Parts two = rotor_on_shaft("two", 3, 1, "ground", -20, true);
      Scene both(model({pylon("1e6, 1e5, 1e5"), one, two}, 14)), other(model({two}, 6));
      auto  b = frequencies(both), c = frequencies(other);
      c.insert(c.end(), a.begin(), a.end());
      std::sort(c.begin(), c.end());
      for (unsigned int i = 0; i < 10; ++i)
        EXPECT_NEAR(b[i], c[i], 1e-8 * c[i]);
    }
}



// Whoever sets the axes is warned, with the modes that do not last.
TEST(MovingAxes, AxesThatAreSetAreWarnedAbout)
{
  const std::string text = model({pylon("1e6, 1e5, 2e5"), rotor_on_shaft("one", 2, 0, "pylon", 30, false)}, 6);
  for (const std::string entry : {"Axes = fixed", "Axes = turning"})
    {
      Scene scene(text, {"Modal/" + entry});
      EXPECT_EQ(frequencies(scene).size(), 6u);
      EXPECT_NE(scene.stream.str().find("its response to forces changes"), std::string::npos);
      EXPECT_NE(scene.stream.str().find("modes of this moment do not last"), std::string::npos);
    }
  Scene allowed(text, {"Modal/Unsteady motion = allow"});
  EXPECT_EQ(frequencies(allowed).size(), 6u);
  EXPECT_NE(allowed.stream.str().find("modes are those of this moment in axes that all turn with <one>"),
            std::string::npos);

  // alone in rigid ground, but seen in fixed axes
  Scene fixed(model({rotor_on_shaft("one", 2, 0, "ground", 30, false)}, 6), {"Modal/Axes = fixed"});
  frequencies(fixed);
  EXPECT_NE(fixed.stream.str().find("its response to forces changes"), std::string::npos);
}



// A disc that turns and moves in its plane, on springs of the ground that are not the same in all directions. All that
// turns turns as a whole, yet only fixed axes see constant coefficients: √(k/m) along each direction. With one
// stiffness, axes that turn with the disc are as good, and come first: |√(k/m) ± Ω|.
TEST(MovingAxes, DiscOnSpringsOfTheGround)
{
  const auto disc = [](const std::string &stiffness) {
    return model(
      {{" subsection disc\n set Type = rigid body\n set Mass = 2\n set Inertia = 0.1, 0.1, 0.2\n end\n",
        " subsection plane\n set Type = planar\n set Body A = ground\n set Body B = disc\n set Axis = 0, 0, 1\n end\n"
        " subsection springs\n set Type = flexible joint\n set Body A = ground\n set Body B = disc\n"
        " set Axis = 0, 0, 1\n set Axis 2 = 1, 0, 0\n set Stiffness = 0, " +
          stiffness + "\n set Rotational stiffness = 0, 0, 0\n end\n",
        " subsection drive\n set Type = steady rotation\n set Joint = plane\n set Speed = 7\n end\n"}},
      2);
  };
  Scene      different(disc("800, 1800")), equal(disc("800, 800"));
  const auto a = frequencies(different), b = frequencies(equal);
  EXPECT_NE(different.stream.str().find("constant in fixed axes\n"), std::string::npos) << different.stream.str();
  EXPECT_NEAR(a[0], 20, 1e-9);
  EXPECT_NEAR(a[1], 30, 1e-9);
  EXPECT_NEAR(b[0], 13, 1e-9);
  EXPECT_NEAR(b[1], 27, 1e-9);
}



// Two hinged blades on a soft mount near resonance: by the modes the pylon whirls at growing radius. So it does in time
// after a small blow, at the same rate.
TEST(MovingAxes, WhirlGrowsInTimeAsModesTell)
{
  Parts rotor_and_blow = rotor_on_shaft("one", 2, 0, "pylon", 29.57, true);
  rotor_and_blow.loads += " subsection blow\n set Type = point load\n set At = blade 0 of one.end\n set Axes = body\n"
                          " set Force = 0, 0.002*(t < 0.4 ? 1 - cos(2*pi*t/0.4) : 0), 0\n end\n";
  Scene  scene(model({pylon("1e6, 88300, 88300"), rotor_and_blow}, 4) +
                "subsection Dynamic\n set End time = 4\n set Step = 0.01\n set Stages = 3\n set Spectral radius = 1\n"
                 " set Newton tolerance = 1e-13\nend\n",
              {"Analyses = static, modal, dynamic", "Modal/Hold rotations = false"});
  double growth = 0;
  scene.equilibrium();
  for (const auto &mode : scene.modes())
    growth = std::max(growth, mode.lambda.real());
  EXPECT_GT(growth, 1.);
  const Probe x = scene.input.model.probe("pylon.displacement x"), y = scene.input.model.probe("pylon.displacement y");
  std::map<double, double> radius;
  auto                    &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.observer                 = [&](const State &state) {
    radius[std::round(100 * state.time)] = std::hypot(x.value(state), y.value(state));
  };
  dynamics.run(scene.context);
  EXPECT_LT(radius.at(400), 1e-3);
  EXPECT_NEAR(std::log(radius.at(400) / radius.at(300)), growth, 2e-3 * growth);
}



// Neither fuselage nor shaft is axisymmetric, which the model allows: those fixed axes are taken in which the paper's
// frequencies are found, with a word on how much they change.
TEST(MovingAxes, TailRotor)
{
  Scene                     scene("prm/rotorcraft/tail_rotor_transmission.prm");
  const auto                a        = frequencies(scene);
  const std::vector<double> expected = {46.9815, 49.1137, 51.8288, 61.1458};
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NEAR(a[2 + i], expected[i], 1e-4);
  EXPECT_NE(scene.stream.str().find("changes by up to 1.3 %; modes are those of this moment in fixed axes"),
            std::string::npos)
    << scene.stream.str();
}
