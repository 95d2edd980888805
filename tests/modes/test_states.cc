// Modes belong to an equilibrium: a state whose loads nothing balances is refused, an unloaded one needs no statics.
// And they belong to what has mass: there are no more of them than masses.

#include <samara/analysis/dynamic.h>

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  const std::string rod = R"(
set Analyses = static, modal
subsection Sections
  subsection round
    set Type         = tube
    set E            = 210 GPa
    set Density      = density
    set Outer radius = 10 mm
  end
end
subsection Bodies
  subsection rod
    set Type    = beam
    set Points  = 0, 0, 0; 0, 0, -20 m
    set Section = round
  end
  #bodies
end
subsection Joints
  subsection clamp
    set Type   = rigid
    set Body A = ground
    set Body B = rod.start
  end
  #joints
end
subsection Loads
  #loads
end
)";

  std::string
  rod_with(const std::vector<std::pair<std::string, std::string>> &texts)
  {
    std::string result = rod;
    for (const auto &[place, text] : texts)
      result.replace(result.find(place), place.size(), text);
    return result;
  }

  const std::string weight = "subsection weight\n set Type = gravity\n end\n";
} // namespace



// A hanging chain, ω₁ = 1.2024 √(g/L), with a little stiffness, ω_b = 1.8751² √(EI/μL⁴): ω² ≥ ω₁² + ω_b² (Southwell),
// and by Rayleigh's quotient ω² ≤ that of w = x²: with EI alone 20 EI/μL⁴, with the weight alone 5/3 g/L.
TEST(StateOfModes, HangingRodNeedsItsTension)
{
  const std::string model = rod_with({{"density", "7800"}, {"#loads", weight}});
  Scene             without(model);
  EXPECT_THROW(without.modes(), NotConverged);

  Scene scene(model);
  scene.equilibrium();
  const double chain     = std::pow(2.404825557695773 / 2, 2) * 9.80665 / 20,
               stiffness = 2.1e11 * 1e-4 / 4 / 7800 / std::pow(20., 4);
  const double square    = std::pow(scene.modes().at(0).frequency(), 2);
  EXPECT_GT(square, chain + std::pow(1.875104068711961, 4) * stiffness);
  EXPECT_LT(square, 5. / 3 * 9.80665 / 20 + 20 * stiffness);
}



TEST(StateOfModes, UnloadedModelsNeedNoStatics)
{
  Scene        scene(rod_with({{"density", "7800"}}));
  const double expected = std::pow(1.875104068711961, 2) * std::sqrt(2.1e11 * 1e-4 / 4 / 7800) / 400;
  EXPECT_NEAR(scene.modes().at(0).frequency(), expected, 1e-5 * expected);
}



// Rigid bodies that hang where they are need no statics: the reactions that carry them are found. Where they do not
// hang in balance they are refused. The bearing holds against the pendulum's weight; ω² = m g l/(J + m l²).
TEST(StateOfModes, ReactionsAreFound)
{
  const auto pendulum = [](const std::string &place) {
    return "set Analyses = modal\nsubsection Bodies\n subsection bob\n set Type = rigid body\n set Mass = 2\n"
           " set Inertia = 1, 1, 1\n set Position = " +
           place +
           "\n end\nend\nsubsection Joints\n subsection pin\n set Type = revolute\n set Body A = ground\n set Body B = bob.centre\n"
           " set Position = 0, 0, 0\n set Axis = 0, 1, 0\n end\nend\nsubsection Loads\n" +
           weight + "end\n";
  };
  Scene hanging(pendulum("0, 0, -3"));
  EXPECT_NEAR(hanging.modes().at(0).frequency(), std::sqrt(2 * 9.80665 * 3 / (1 + 18.)), 1e-9);
  Scene oblique(pendulum("0.1, 0, -3"));
  EXPECT_THROW(oblique.modes(), NotConverged);
}



// A turning blade without its centrifugal stresses, and a body that falls.
TEST(StateOfModes, InertiaForcesAreLoads)
{
  Scene blade("prm/benchmarks/rotating_beam.prm");
  EXPECT_THROW(blade.modes(), NotConverged);
  Scene falling("set Analyses = modal\nsubsection Bodies\n subsection stone\n set Type = rigid body\n set Mass = 2\n"
                " set Inertia = 1, 1, 1\n end\nend\nsubsection Loads\n" +
                weight + "end\n");
  EXPECT_THROW(falling.modes(), NotConverged);
}



// A point mass at the end of a massless cantilever: ω² = 3EI/(m L³) twice, EA/(m L) once, and nothing else, though ten
// modes are asked for. The body has no inertia of rotation.
TEST(StateOfModes, NoMoreModesThanMasses)
{
  Scene       scene(rod_with(
    {{"density", "0"},
           {"#bodies", "subsection bob\n set Type = rigid body\n set Mass = 2\n set Position = 0, 0, -20\n end\n"},
           {"#joints", "subsection fix\n set Type = rigid\n set Body A = rod.end\n set Body B = bob.centre\n end\n"}}));
  const auto &modes = scene.modes();
  ASSERT_EQ(modes.size(), 3u);
  const double EA = 2.1e11 * M_PI * 1e-4, bending = std::sqrt(3 * EA * 1e-4 / 4 / (2 * 8000.));
  EXPECT_NEAR(modes[0].frequency(), bending, 1e-5 * bending);
  EXPECT_NEAR(modes[1].frequency(), bending, 1e-5 * bending);
  EXPECT_NEAR(modes[2].frequency(), std::sqrt(EA / 40), 1e-9 * std::sqrt(EA / 40));
  EXPECT_NE(scene.stream.str().find("no other motion moves mass"), std::string::npos);
  EXPECT_THROW(Scene(rod_with({{"density", "0"}})).modes(), NotConverged);
}



namespace
{
  /** A disc on a gimbal with springs of 10 N m/rad, both about axes through its centre. */
  const std::string gyroscope = R"(
set Analyses = dynamic, modal
subsection Bodies
  subsection gimbal
    set Type    = rigid body
    set Mass    = 0.1
    set Inertia = 0.001, 0.001, 0.001
  end
  subsection disc
    set Type             = rigid body
    set Mass             = 1
    set Inertia          = 0.1, 0.1, 0.2
    set Angular velocity = 0, 0, 100
  end
end
subsection Joints
  subsection hinges
    set Type        = universal
    set Body A      = ground
    set Body B      = gimbal
    set Axis        = 1, 0, 0
    set Second axis = 0, 1, 0
    subsection rotation 1
      set Spring = 10
    end
    subsection rotation 2
      set Spring = 10
    end
  end
  subsection bearing
    set Type   = revolute
    set Body A = gimbal
    set Body B = disc
  end
end
subsection Dynamic
  set Step     = 0.01
  set End time = 0.02
end
)";
} // namespace



// What a motion has left turning has gyroscopic terms that no steady motion of the model knows of: modes at rest are
// not its modes.
TEST(StateOfModes, MotionsThatNoRotationDescribesAreRefused)
{
  for (const std::string unsteady : {"refuse", "allow"})
    {
      Scene scene(gyroscope, {"Modal/Unsteady motion = " + unsteady});
      scene.analysis<DynamicAnalysis>().run(scene.context);
      if (unsteady == "allow")
        EXPECT_NEAR(scene.modes().at(1).frequency(), std::sqrt(10 / 0.101), 0.01); // those without the spin
      else
        EXPECT_THROW(scene.modes(), InputError);
    }
  Scene at_rest(gyroscope, {"Bodies/disc/Angular velocity = 0, 0, 1e-5"});
  at_rest.analysis<DynamicAnalysis>().run(at_rest.context);
  EXPECT_NO_THROW(at_rest.modes());
}
