/*
 * Problem:   names of modes in air; free motions of a body in wind; modes of a moment
 * Reference: the same model in thin air, where names are those of the vacuum; what wind leaves an aircraft: it may be
 * anywhere and at any angle of roll, and nothing else, since its tail plane resists pitch and its fin yaw; the modes of
 * the same mount drawn as one joint
 */

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  /** Frequencies of the modes of this family, and their numbers by family. */
  std::vector<double>
  frequencies_of_family(const std::string &family, const std::vector<std::string> &overrides)
  {
    Scene scene("prm/rotorcraft/puma_fan_in_air.prm", overrides);
    scene.equilibrium();
    auto &modal = scene.analysis<ModalAnalysis>();
    modal.run(scene.context);
    std::vector<double> result;
    for (unsigned int i = 0; i < modal.contents.size(); ++i)
      if (modal.contents[i].family == family)
        result.push_back(modal.modes[i].frequency());
    return result;
  }

  /** Ground resonance on a mount that is the same in all directions, drawn as two slides in a row. */
  std::string
  on_two_slides()
  {
    std::ifstream      in(SAMARA_SOURCE_DIR "/prm/examples/floquet/ground_resonance.prm");
    std::ostringstream whole;
    whole << in.rdbuf();
    std::string       text  = whole.str();
    const auto        mount = text.find("  # moves along both"), shaft = text.find("  subsection shaft");
    const std::string slide = "    subsection displacement\n      set Spring = 1240481.8 N/m\n"
                              "      set Damper = 4000 N*s/m\n    end\n  end\n";
    text.replace(mount,
                 shaft - mount,
                 "  subsection x slide\n    set Type = prismatic\n    set Body A = ground\n    set Body B = carriage\n"
                 "    set Axis = 1, 0, 0\n" +
                   slide +
                   "  subsection y slide\n    set Type = prismatic\n    set Body A = carriage\n    set Body B = "
                   "airframe\n    set Axis = 0, 1, 0\n" +
                   slide);
    text.replace(text.find("subsection Bodies\n"),
                 18,
                 "subsection Bodies\n  subsection carriage\n    set Type = rigid body\n  end\n");
    return text;
  }
} // namespace



// Lift of blades that twist moves them in flap: most of the energy is there, but flap does not twist them.
TEST(ModesInAir, TorsionIsNotCalledFlap)
{
  const std::vector<std::string> fan    = {"Rotor speeds = ", "Analyses = static, modal"};
  const std::vector<std::string> single = {"Rotor speeds = ", "Analyses = static, modal", "Modal/Symmetry = "};
  for (auto overrides : {fan, single})
    {
      const auto in_air = frequencies_of_family("torsion 1", overrides);
      overrides.push_back("Constants/rho = 1e-5");
      const auto in_vacuum = frequencies_of_family("torsion 1", overrides);
      ASSERT_EQ(in_vacuum.size(), 4u);
      ASSERT_EQ(in_air.size(), 4u);
      for (unsigned int i = 0; i < 4; ++i)
        EXPECT_NEAR(in_air[i] / in_vacuum[i], 1, 0.02);
    }
}



TEST(ModesInAir, AnAircraftMayBeAnywhereAndRoll)
{
  for (const std::string solver : {"KLU", "MUMPS"})
    {
      Scene scene("prm/examples/aero/tail_plane.prm", {"Linear solver = " + solver});
      auto &modal = scene.analysis<ModalAnalysis>();
      modal.run(scene.context);
      Matrix6      sum    = Matrix6::Zero();
      unsigned int n_free = 0;
      for (const auto &mode : modal.modes)
        if (mode.is_free())
          {
            ++n_free;
            sum += (mode.shape * mode.shape.adjoint()).real();
          }
      EXPECT_EQ(n_free, 4u) << solver;
      EXPECT_EQ(modal.modes.size(), 7u) << solver;
      // neither pitch nor yaw
      EXPECT_NEAR(sum(4, 4), 0, 1e-6) << solver;
      EXPECT_NEAR(sum(5, 5), 0, 1e-6) << solver;
    }
}



// What changes is no small part of these modes: it is said with its size and what to do, and not recommended.
TEST(ModesInAir, MountsOfTwoSlidesHaveNoModes)
{
  const std::vector<std::string> at_26 = {"Rotor speeds = ", "Loads/turning/Speed = 26 rad/s"};
  Scene                          refused(on_two_slides(), at_26);
  refused.equilibrium();
  try
    {
      refused.analysis<ModalAnalysis>().run(refused.context);
      FAIL() << "no modes";
    }
  catch (const InputError &problem)
    {
      const std::string what = problem.what();
      EXPECT_NE(what.find("Analyses = floquet"), std::string::npos) << what;
      EXPECT_NE(what.find("planar with springs in fixed axes"), std::string::npos) << what;
      EXPECT_EQ(what.find("Unsteady motion = allow"), std::string::npos) << what;
    }
  auto allowing = at_26;
  allowing.push_back("Modal/Unsteady motion = allow");
  Scene allowed(on_two_slides(), allowing);
  allowed.equilibrium();
  allowed.analysis<ModalAnalysis>().run(allowed.context);
  const std::string told = allowed.stream.str();
  EXPECT_NE(told.find("warning: "), std::string::npos) << told;
  EXPECT_NE(told.find("do not last"), std::string::npos) << told;
  EXPECT_NE(told.find("wrong by as much"), std::string::npos) << told;
  // as one joint it has modes, those of Floquet's theory (doc/theory/modes.md)
  Scene planar("prm/examples/floquet/ground_resonance.prm", at_26);
  planar.equilibrium();
  auto &modal = planar.analysis<ModalAnalysis>();
  modal.run(planar.context);
  double growth = 0;
  for (const auto &mode : modal.modes)
    growth = std::max(growth, mode.lambda.real());
  EXPECT_NEAR(growth, 2.32022, 1e-4);
}
