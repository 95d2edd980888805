// Cells that are long for their tension are soft in bending, as elements of beams are: the strip of
// doc/theory/element.md as a shell, 1 m long, EI = 0.29 N m², pulled by 0.7 kN. First frequency of bending 115.5 rad/s,
// of a beam of the same EI.

#include <samara/base/errors.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  pulled_strip(const unsigned int elements)
  {
    return "subsection Bodies\n subsection strip\n set Type = shell\n set Patches = u, 0.1*(v - 0.5), 0\n"
           " set Elements = " +
           std::to_string(elements) +
           ", 1\n set Degree = 3\n set E = 70e9\n set Thickness = 0.7922e-3\n set Density = 3408.3\n"
           " set Rigid edges = end at edge u1\n end\nend\n"
           "subsection Joints\n subsection clamp\n set Type = support\n set Along = strip.edge u0\n end\nend\n"
           "subsection Loads\n subsection pull\n set Type = point load\n set At = strip.end\n set Force = 700, 0, 0\n"
           " end\nend\nsubsection Modal\n set Modes = 2\nend\n";
  }
} // namespace



TEST(ShellTension, LongCellsAreToldOf)
{
  // long ones are told of, and buckle where nothing is compressed
  Scene coarse(pulled_strip(4));
  EXPECT_THROW(coarse.equilibrium(), NotConverged);
  EXPECT_NE(coarse.stream.str().find("for its tension N a cell is long, N (h/p)^2/D = "), std::string::npos)
    << coarse.stream.str();

  Scene fine(pulled_strip(8));
  fine.equilibrium();
  EXPECT_EQ(fine.stream.str().find("too soft"), std::string::npos) << fine.stream.str();
  EXPECT_NEAR(fine.modes()[1].frequency(), 115.5, 0.02 * 115.5); // the first one twists it
}
