/*
 * Problem:   cells that are bent more sharply than their polynomials represent
 * Reference: elements of a beam, whose highest coefficient of curvature is that of doc/theory/element.md; Sze, Liu & Lo
 *            (2004), problem 3.6, a cylinder that is pinched until folds run through it: its path has no limit points
 * Expected:  a strip is folded as the beam is; the cylinder with cells larger than its folds is refused at its first
 *            limit point, which is one of the mesh, with the cell and what would do
 */

#include <samara/base/errors.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/shell.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

TEST(Folds, OfAStripAreThoseOfABeam)
{
  // ν = 0, EI = 1 N m² of 1 m × 0.1 m: a force that bends it by a radian and a half
  const std::string force = "0, 0, 4",
                    load  = " subsection tip\n set Type = point load\n set At = BODY.end\n set Force = " + force +
                           "\n end\nend\n";
  const auto with = [](std::string text, const std::string &body) {
    text.replace(text.find("BODY"), 4, body);
    return text;
  };
  Scene beam(
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 120000\n set GA2 = 50000\n"
    " set GA3 = 50000\n set GJ = 1\n set EI2 = 1\n set EI3 = 100\n set Mass = 1\n set I2 = 1e-3\n set I3 = 1e-3\n end\nend\n"
    "subsection Bodies\n subsection b\n set Type = beam\n set Points = 0, 0, 0; 1, 0, 0\n set Section = s\n set Elements = 2\n"
    " set Degree = 3\n end\nend\nsubsection Joints\n subsection root\n set Type = rigid\n set Body A = ground\n"
    " set Body B = b.start\n end\nend\nsubsection Loads\n" +
    with(load, "b"));
  Scene strip(
    "subsection Bodies\n subsection s\n set Type = shell\n set Patches = u, 0.1*v, 0\n set Elements = 2, 1\n"
    " set Degree = 3\n set E = 120e6\n set Thickness = 0.01\n set Rigid edges = end at edge u1\n end\nend\nsubsection Joints\n"
    " subsection root\n set Type = support\n set Along = s.edge u0\n end\nend\nsubsection Loads\n" +
    with(load, "s"));
  beam.equilibrium();
  strip.equilibrium();
  const auto         &b = beam.input.model.find<Beam>("b", "body");
  const auto         &s = strip.input.model.find<Shell>("s", "body");
  std::vector<double> e(b.n_strains());
  b.strains_at(beam.context.state.point(), e.data());
  for (unsigned int i = 0; i < 2; ++i)
    {
      const double of_beam = b.turn(i, beam.context.state, e.data()).unresolved;
      EXPECT_NEAR(s.fold(i, strip.context.state), of_beam, 0.05 * of_beam) << i;
    }
}



TEST(Folds, PinchedCylinderIsRefusedWhereCellsAreLarger)
{
  const auto support = [](const std::string &name, const std::string &edge, const std::string &fixed) {
    return " subsection " + name + "\n set Type = support\n set Along = c." + edge + "\n set Fixed = " + fixed +
           "\n end\n";
  };
  Scene scene(
    "set Analyses = static\nsubsection Bodies\n subsection c\n set Type = shell\n"
    " set Patches = 100*u, 100*sin(pi/2*v), 100*cos(pi/2*v)\n set Elements = 6, 6\n set Degree = 3\n set E = 30e3\n"
    " set Poisson ratio = 0.3\n set Thickness = 1\n set Frames = A at 0 0\n end\nend\nsubsection Joints\n" +
    support("mid", "edge u0", "displacement 1, rotation 2, rotation 3") +
    support("diaphragm", "edge u1", "displacement 2, displacement 3") +
    support("top", "edge v0", "displacement 2, rotation 1, rotation 3") +
    support("side", "edge v1", "displacement 3, rotation 1, rotation 2") +
    "end\nsubsection Loads\n subsection P\n set Type = point load\n set At = c.A\n set Force = 0, 0, -3000\n end\nend\n"
    "subsection Static\n set Path = arc length\n set Load steps = 40\nend\n");
  try
    {
      scene.equilibrium();
      ADD_FAILURE() << "not refused";
    }
  catch (const NotConverged &refusal)
    {
      const std::string text = refusal.what();
      EXPECT_NE(text.find("none of the structure but of its mesh"), std::string::npos) << text;
      EXPECT_NE(text.find("shell <c>, the cell"), std::string::npos) << text;
      EXPECT_NE(text.find("times as small"), std::string::npos) << text;
    }
}
