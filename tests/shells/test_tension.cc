// Cells that are long for their tension are soft in bending, as elements of beams are: the strip of
// doc/theory/element.md as a shell, 1 m long, EI = 0.29 N m², pulled by 0.7 kN. First frequency of bending 115.5 rad/s,
// of a beam of the same EI. And a sheet whose rotations about the normal, to and fro from corner to corner of its
// cells, tension makes unstable, as doc/theory/shell.md derives.

#include <samara/analysis/negative_directions.h>
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

  /** A sheet of 2 × 2 cells, 0.25 × 0.2 m each and 15 mm thick, free but for its rigid motions, pulled along x. */
  std::string
  pulled_sheet(const double N, const unsigned int degree)
  {
    const auto pull = [&](const std::string &name, const std::string &edge, const double force) {
      return " subsection " + name + "\n set Type = line load\n set Body = sheet\n set Edge = " + edge +
             "\n set Force = " + std::to_string(force) + ", 0, 0\n end\n";
    };
    return "set Analyses = static\nsubsection Bodies\n subsection sheet\n set Type = shell\n"
           " set Patches = 0.5*u - 0.25, 0.4*v - 0.2, 0\n set Elements = 2, 2\n set Degree = " +
           std::to_string(degree) +
           "\n set E = 70e9\n set Poisson ratio = 0.3\n set Thickness = 0.015\n set Density = 2700\n set Frames = middle at 0.5 0.5\n end\nend\n"
           "subsection Joints\n subsection hold\n set Type = revolute\n set Body A = ground\n set Body B = sheet.middle\n set Axis = 0, 0, 1\n"
           " end\nend\nsubsection Loads\n" +
           pull("left", "edge u0", -N) + pull("right", "edge u1", N) +
           "end\nsubsection Static\n set Stability limits = pass\nend\n";
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



// N = 2 D p³ (p + 1)/(2p + 1) (1/a² + 1/b²) of cells a × b, D the stiffness of K₁₃ and K₂₃: beyond it rotations about the
// normal that vanish at all points where strains are sampled are unstable. D is such that N is 1 % of A₆₆ = G h for every
// degree and size of cells that are not thick. A hinge about the normal holds the middle, a node of four cells.
TEST(ShellTension, RotationsAboutTheNormalOfCellsTooLarge)
{
  for (const int p : {2, 3, 4})
    {
      const double N = 0.01 * 70e9 / 2.6 * 0.015;
      for (const double ratio : {0.95, 1.05})
        {
          Scene scene(pulled_sheet(ratio * N, p));
          scene.equilibrium();
          const auto found = negative_directions(scene.system, scene.context.state);
          EXPECT_EQ(found.number > 0, ratio > 1) << p << " " << ratio << "\n" << scene.stream.str();
          if (ratio < 1)
            continue;
          double about_normal = 0;
          for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
            about_normal += std::pow(found.worst(scene.system.layout.of_node(node) + 5), 2);
          EXPECT_GT(about_normal, 0.99 * found.worst.squaredNorm());
        }
    }
}
