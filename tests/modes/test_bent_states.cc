// Modes of a twisted cantilever at rest, bent by a dead force, and bent by a force that follows it while it turns with
// the ground: 3 cubic elements, GA L²/EI from 4e4 to 4e9. Reference: tests/reference/beams/bent_twisted_modes.csv, the
// same discrete problem written anew in 60 digits, with its equilibrium and its tangents.

#include "../reference.h"
#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  std::string
  cantilever_under_load(const std::map<std::string, std::string> &row)
  {
    const bool  turns = row.at("Omega") != "0", follows = row.at("follows") == "1";
    std::string loads;
    if (turns)
      loads += " subsection turning\n set Type = steady rotation\n set Speed = " + row.at("Omega") + "\n end\n";
    loads += " subsection pull\n set Type = point load\n set At = beam.end\n set Force = " + row.at("F1") + ", " +
             row.at("F2") + ", " + row.at("F3") + "\n set Axes = " + (follows ? "body" : "inertial") + "\n end\n";
    const std::string GA = row.at("GA");
    return "set Analyses = static, modal\nsubsection Sections\n subsection s\n set Type = engineering constants\n set EA = 3*" +
           GA + "\n set GA2 = " + GA + "\n set GA3 = " + GA +
           "\n set GJ = 0.8\n set EI2 = 1\n set EI3 = 2\n set Mass = 1\n set I2 = 1e-3\n set I3 = 2e-3\n end\nend\n"
           "subsection Bodies\n subsection beam\n set Type = beam\n set Points = 0, 0, 0; 2, 0, 0\n set Axis 2 = 0, 1, 0\n"
           " set Twist = 0.6*s\n set Section = s\n set Elements = 3\n set Degree = 3\n end\nend\nsubsection Joints\n"
           " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = beam.start\n end\nend\n"
           "subsection Loads\n" +
           loads + "end\nsubsection Static\n set Tolerance = 1e-12\nend\nsubsection Modal\n set Modes = 5\nend\n";
  }
} // namespace



TEST(BentStates, DiscreteFrequenciesToTwelveDigits)
{
  unsigned int n_modes = 0;
  for (const auto &row : reference_rows("beams/bent_twisted_modes.csv"))
    {
      Scene scene(cantilever_under_load(row));
      scene.equilibrium();
      const auto                &modes = scene.modes();
      const std::complex<double> expected(std::stod(row.at("real")), std::stod(row.at("imaginary")));
      const unsigned int         i = std::stoul(row.at("mode")) - 1;
      ASSERT_LT(i, modes.size());
      const double error = std::abs(modes[i].lambda - expected) / std::abs(expected);
      EXPECT_LT(error, 1e-12) << "GA = " << row.at("GA") << ", Omega = " << row.at("Omega") << ", F2 = " << row.at("F2")
                              << ", mode " << i + 1;
      EXPECT_LT(modes[i].error, 1e-11);
      ++n_modes;
    }
  EXPECT_EQ(n_modes, 25u);
}
