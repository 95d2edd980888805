// What is hard for an eigenvalue solver: free motions (double zeros without a full set of eigenvectors) and many modes
// of the same frequency, both usual in rotorcraft models.

#include "modes.h"

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** No supports at all. */
  const std::string free_beam = R"(
set Analyses = modal
subsection Sections
  subsection slender
    set Type = engineering constants
    set EA   = 1e6
    set GA2  = 1e7
    set GA3  = 1e7
    set GJ   = 1
    set EI2  = 1
    set EI3  = 1
    set Mass = 1
    set I2   = 1e-8
    set I3   = 1e-8
  end
end
subsection Bodies
  subsection beam
    set Type     = beam
    set Points   = 0, 0, 0; 1, 0, 0
    set Section  = slender
    set Elements = 8
    set Degree   = 4
  end
end
subsection Modal
  set Modes = 24
  set Shift = 5
end
)";

  /** Four equal cantilevers with equal bending stiffnesses: each frequency eight times. */
  std::string
  star()
  {
    std::string       model  = free_beam.substr(0, free_beam.find("subsection Bodies")) + "subsection Bodies\n";
    const std::string ends[] = {"1, 0, 0", "0, 1, 0", "-1, 0, 0", "0, -1, 0"};
    for (unsigned int i = 0; i < 4; ++i)
      model += " subsection arm" + std::to_string(i) + "\n set Type = beam\n set Points = 0, 0, 0; " + ends[i] +
               "\n set Section = slender\n set Elements = 6\n end\n";
    model += "end\nsubsection Joints\n";
    for (unsigned int i = 0; i < 4; ++i)
      model += " subsection clamp" + std::to_string(i) +
               "\n set Type = rigid\n set Body A = ground\n set Body B = arm" + std::to_string(i) + ".start\n end\n";
    return model + "end\nsubsection Modal\n set Modes = 20\nend\n";
  }
} // namespace



// A free slender beam: (β L)² with cos(βL) cosh(βL) = 1, each in two planes, and six rigid motions without frequency.
// Shear changes the frequencies by less than 1e-5.
TEST(FreeBeam, Frequencies)
{
  const double        beta[] = {4.730040744862704, 7.853204624095838, 10.995607838001671};
  Scene               scene(free_beam);
  unsigned int        n_rigid = 0;
  std::vector<double> bending;
  for (const auto &mode : scene.modes())
    if (mode.is_free())
      ++n_rigid;
    else if (share(scene.system, mode, 1) + share(scene.system, mode, 2) > 0.5)
      bending.push_back(mode.frequency());
  EXPECT_EQ(n_rigid, 6u) << "six motions, each with a double zero, told once";
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_EQ(scene.analysis<ModalAnalysis>().modes.at(i).damping_ratio(), 0.);
  EXPECT_EQ(check_model(scene.system).n_free_motions, 6u);
  ASSERT_GE(bending.size(), 6u);
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_NEAR(bending[i], beta[i / 2] * beta[i / 2], 1e-5 * beta[i / 2] * beta[i / 2]) << i;
}



// Reference (β L)² with cos(βL) cosh(βL) = −1. Shear and rotary inertia change them by less than 1e-5.
TEST(EqualCantilevers, EveryModeIsFound)
{
  const double beta[] = {1.875104068711961, 4.694091132974174};
  Scene        scene(star());
  unsigned int found[2] = {0, 0};
  for (const auto &mode : scene.modes())
    for (unsigned int i = 0; i < 2; ++i)
      found[i] += std::abs(mode.frequency() / (beta[i] * beta[i]) - 1) < 2e-5;
  EXPECT_EQ(found[0], 8u);
  EXPECT_EQ(found[1], 8u);
}



// The same with other numbers of modes and other shifts: whether they are found must not depend on luck.
TEST(EqualCantilevers, ForAnyShiftAndNumber)
{
  for (const unsigned int n : {4, 8, 9, 16, 20, 30})
    for (const std::string shift : {"0.1", "1", "7", "30"})
      {
        Scene scene(star(), {"Modal/Modes = " + std::to_string(n), "Modal/Shift = " + shift});
        EXPECT_NO_THROW(scene.modes()) << n << " modes, shift " << shift;
      }
  for (const unsigned int n : {6, 12, 16, 20, 30})
    for (const std::string shift : {"0.1", "1", "7", "30"})
      {
        Scene scene(free_beam, {"Modal/Modes = " + std::to_string(n), "Modal/Shift = " + shift});
        EXPECT_NO_THROW(scene.modes()) << "free beam, " << n << " modes, shift " << shift;
      }
}
