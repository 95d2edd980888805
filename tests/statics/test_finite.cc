// No analysis ends well with numbers that are not finite: loads and drives that are infinite or no numbers at its time.

#include <samara/analysis/dynamic.h>
#include <samara/base/errors.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  rod(const std::string &force)
  {
    return "subsection Sections\n subsection s\n set Type = tube\n set E = 2e11\n set Density = 7800\n"
           " set Outer radius = 0.01\n end\nend\nsubsection Bodies\n subsection rod\n set Type = beam\n"
           " set Points = 0, 0, 0; 1, 0, 0\n set Section = s\n end\nend\nsubsection Joints\n subsection clamp\n"
           " set Type = rigid\n set Body A = ground\n set Body B = rod.start\n end\nend\nsubsection Loads\n"
           " subsection wind\n set Type = point load\n set At = rod.end\n set Force = 0, 0, " +
           force + "\n end\nend\nsubsection Dynamic\n set End time = 0.02\n set Step = 0.01\nend\n";
  }
} // namespace



TEST(Finite, EveryAnalysisRefusesLoadsThatAreNot)
{
  for (const std::string force : {"1/t", "sqrt(t - 1)", "ln(-1 - t)"})
    {
      EXPECT_THROW(Scene(rod(force)).equilibrium(), NotConverged) << force;
      EXPECT_THROW(Scene(rod(force)).modes(), NotConverged) << force;
    }
  for (const std::string force : {"sqrt(t - 1)", "ln(-1 - t)"})
    {
      Scene scene(rod(force));
      EXPECT_THROW(scene.analysis<DynamicAnalysis>().run(scene.context), NotConverged) << force;
    }
}



TEST(Finite, TheUnknownIsNamed)
{
  Scene scene(rod("1"));
  State state = scene.system.reference();
  EXPECT_NO_THROW(require_finite_state(scene.system, state));
  state.y[6 * 2 + 4] = std::nan("");
  try
    {
      require_finite_state(scene.system, state);
      FAIL();
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find(scene.system.layout.name_of(scene.system.layout.of_node(2) + 4)),
                std::string::npos)
        << problem.what();
    }
}
