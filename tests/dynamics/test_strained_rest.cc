/*
 * Problem:   a bent frame of two stiff tubes in its equilibrium, computed on with a Newton tolerance of 1e-13
 * Reference: it stays where it is, and the energy account closes: strain energy is known to the round-off of the
 * strains, σ ε, not of itself. Of a tube in tension the bound is exact: N ε Σ |B| x with Σ |B| x = 2 L/L of two nodes.
 */

#include <samara/analysis/dynamic.h>
#include <samara/analysis/dynamic_parts.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <limits>

using namespace samara;

namespace
{
  std::string
  tube(const std::string &name, const std::string &points, const std::string &more)
  {
    return " subsection " + name + "\n set Type = beam\n set Section = s\n set Points = " + points + "\n" + more +
           " end\n";
  }

  /** Clamped tubes, pulled at the end of the last one. */
  std::string
  frame(const std::string &bodies, const std::string &joints, const std::string &end, const std::string &force)
  {
    return "set Analyses = static, dynamic\n"
           "subsection Sections\n subsection s\n set Type = tube\n set E = 2e9\n set Density = 2500\n"
           " set Outer radius = 0.05\n end\nend\n"
           "subsection Bodies\n" +
           bodies +
           "end\n"
           "subsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = a.start\n end\n" +
           joints +
           "end\n"
           "subsection Loads\n subsection pull\n set Type = point load\n set At = " +
           end + "\n set Force = " + force +
           "\n end\nend\n"
           "subsection Dynamic\n set Step = 0.005\n set End time = 0.05\n set Newton tolerance = 1e-13\nend\n";
  }
} // namespace



TEST(StrainedRest, ClosesItsEnergyAccount)
{
  Scene scene(frame(tube("a", "0.3, -0.9, 0.2; 1, -0.5, 0.5", " set Elements = 2\n") +
                      tube("b", "1, -0.5, 0.5; 1.7, 0.1, -0.3", " set Elements = 2\n"),
                    " subsection weld\n set Type = rigid\n set Body A = a.end\n set Body B = b.start\n end\n",
                    "b.end",
                    "10, 13, -70"));
  scene.equilibrium();
  const State start    = scene.context.state;
  auto       &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.start(scene.context);
  EXPECT_NO_THROW(dynamics.run(scene.context));
  EXPECT_TRUE(dynamics.report.does_close);
  for (unsigned int i = 0; i < start.q.size(); ++i)
    EXPECT_NEAR(scene.context.state.q[i], start.q[i], 1e-10);
}



TEST(StrainedRest, KnowsItsStrainEnergyToTheRoundOffOfStrains)
{
  // one element of degree 1, 1 m long, the model's length: one strain is (x₂ − x₁)/L
  const double force = 1000;
  Scene scene(frame(tube("a", "0, 0, 0; 1, 0, 0", " set Elements = 1\n set Degree = 1\n"), "", "a.end", "1000, 0, 0"));
  scene.equilibrium();
  const double bound = force * std::numeric_limits<double>::epsilon();
  const double told  = round_off_of_strain_energy(scene.context.system, scene.context.state);
  // of the two nodes one is held: its column is there, or not
  EXPECT_GT(told, 0.99 * bound);
  EXPECT_LT(told, 2.02 * bound);
}
