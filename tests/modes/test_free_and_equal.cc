// What is hard for an eigenvalue solver: free motions (double zeros without a full set of eigenvectors) and many modes
// of the same frequency, both usual in rotorcraft models.

#include <gtest/gtest.h>

#include "modes.h"

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



// Of cantilevers whose masses are multiplied by 1 + δ frequencies are divided by √(1 + δ), whatever the mesh: those of
// four arms, each twice, that differ by parts in 1e5 to 1e10, or not at all.
TEST(EqualCantilevers, NearlyEqualFrequenciesToNineDigits)
{
  for (const double delta : {1e-5, 1e-7, 1e-9, 1e-10, 0.})
    for (const std::string shift : {"0", "30"})
      {
        SCOPED_TRACE("delta = " + number_to_text(delta) + ", shift " + shift);
        std::string       model = star(), sections;
        const std::string whole =
          model.substr(model.find("  subsection slender"),
                       model.find("subsection Bodies") - model.find("  subsection slender") - 4);
        for (unsigned int i = 0; i < 4; ++i)
          {
            std::string own = whole;
            for (const std::string entry : {"Mass = 1", "I2   = 1e-8", "I3   = 1e-8"})
              own.replace(own.find(entry),
                          entry.size(),
                          entry + "*(1 + " + std::to_string(i) + "*" + number_to_text("%.17g", delta) + ")");
            own.replace(own.find("slender"), 7, "slender" + std::to_string(i));
            sections += own;
            const auto arm = model.find("Section = slender", model.find("arm" + std::to_string(i)));
            model.insert(arm + 17, std::to_string(i));
          }
        model.replace(model.find(whole), whole.size(), sections);
        Scene               scene(model, {"Modal/Shift = " + shift});
        std::vector<double> found;
        for (const auto &mode : scene.modes())
          found.push_back(mode.frequency());
        for (const double beta : {1.875104068711961, 4.694091132974174})
          {
            std::vector<double> group;
            for (const double f : found)
              if (std::abs(f / (beta * beta) - 1) < 1e-3)
                group.push_back(f);
            ASSERT_EQ(group.size(), 8u);
            std::sort(group.rbegin(), group.rend());
            for (unsigned int i = 0; i < 8; ++i)
              EXPECT_NEAR(group[i] / group[0] * std::sqrt(1 + (i / 2) * delta), 1, 1e-9) << i;
          }
      }
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
