// Load steps by a function: loading, unloading, and what cannot be followed.

#include "../output/scratch_folder.h"
#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A soft cantilever whose end is pushed to about half its length. */
  std::string
  cantilever(const std::string &settings)
  {
    return "set Analyses = static\nsubsection Sections\n subsection it\n set Type = engineering constants\n set EA = 1e5\n set GA2 = 1e5\n"
           " set GA3 = 1e5\n set GJ = 1\n set EI2 = 1\n set EI3 = 1\n end\nend\nsubsection Bodies\n subsection beam\n set Type = beam\n"
           " set Points = 0, 0, 0; 1, 0, 0\n set Section = it\n end\nend\nsubsection Joints\n subsection clamp\n set Type = rigid\n"
           " set Body A = ground\n set Body B = beam.start\n end\nend\nsubsection Loads\n subsection push\n set Type = point load\n"
           " set At = beam.end\n set Force = 0, 0, 3\n end\nend\nsubsection Output\n set Probes = beam.end.displacement z\nend\n"
           "subsection Static\n" +
           settings + "end\n";
  }
} // namespace



TEST(LoadFactor, LoadsAndUnloads)
{
  Scene full(cantilever(""));
  full.equilibrium();
  const double deflection = full.value("beam.end.displacement z");
  EXPECT_GT(deflection, 0.5);

  const ScratchFolder folder;
  Scene               scene(cantilever("set Load factor = table: 0 0; 0.37 1; 1 0\n set Load steps = 6\n"));
  scene.context.folder = folder.path;
  scene.context.probes = scene.input.make_probes();
  auto &analysis       = scene.analysis<StaticAnalysis>();
  analysis.start(scene.context);
  analysis.run(scene.context);
  analysis.finish(scene.context);
  EXPECT_EQ(scene.context.state.factor, 0.);
  EXPECT_LT(std::abs(scene.value("beam.end.displacement z")), 1e-9);

  // the peak is one of the steps, and it is the equilibrium of the full load
  std::istringstream rows(content_of(folder.path + "/static.csv"));
  double             at_peak = 0, last = 0;
  unsigned int       n_falling = 0;
  for (std::string line; std::getline(rows, line);)
    {
      std::istringstream cells(line);
      double             factor = 0, value = 0;
      char               comma;
      if (!(cells >> factor >> comma >> value))
        continue;
      at_peak = factor == 1 ? value : at_peak;
      n_falling += factor < last;
      last = factor;
    }
  EXPECT_NEAR(at_peak, deflection, 1e-8);
  EXPECT_GE(n_falling, 2u);
}



// Steps are no longer than asked for: a smooth function is not skipped.
TEST(LoadFactor, StepsDoNotGrow)
{
  Scene scene(cantilever("set Load factor = sin(2*pi*s)\n set Load steps = 20\n"));
  scene.equilibrium();
  EXPECT_EQ(scene.analysis<StaticAnalysis>().n_steps, 20u);
  EXPECT_LT(std::abs(scene.value("beam.end.displacement z")), 1e-8);
  // half of the load, reached from above
  Scene down(cantilever("set Load factor = table: 0 0; 0.5 1.5; 1 0.5\n set Load steps = 10\n")),
    up(cantilever("set Load factor = 0.5*s\n"));
  down.equilibrium();
  up.equilibrium();
  EXPECT_GT(up.value("beam.end.displacement z"), 0.2);
  EXPECT_NEAR(down.value("beam.end.displacement z"), up.value("beam.end.displacement z"), 1e-8);
}



TEST(LoadFactor, Refusals)
{
  EXPECT_NE(complaint_of(cantilever("set Load factor = 1 - s\n")).find("must begin with 0"), std::string::npos);
  EXPECT_NE(
    complaint_of(cantilever("set Load factor = s\n set Path = arc length\n")).find("finds the load factor itself"),
    std::string::npos);
  EXPECT_NE(complaint_of(cantilever("set Load factor = table: 0 0; 0.5 1; 0.5 0; 1 0\n")).find("must not jump"),
            std::string::npos);
  EXPECT_EQ(complaint_of(cantilever("set Load factor = s^2\n")), "");
}
