/*
 * Problem:   a motion that feeds itself says so while it runs
 * Reference: a spring with a force along its velocity: the energy grows with exp(c t/m) of the force c v along the velocity v
 */

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  said_with(const std::string &force)
  {
    Scene scene("set Analyses = dynamic\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1 kg\n"
                " set Inertia = 1, 1, 1\n set Velocity = 0, 0, 1\n end\nend\nsubsection Joints\n subsection slide\n"
                " set Type = prismatic\n set Body A = ground\n set Body B = b\n set Axis = 0, 0, 1\n"
                " subsection displacement\n  set Spring = 100\n" +
                force +
                " end\n end\nend\nsubsection Dynamic\n set End time = 12\n set Step = 0.02\n set Stages = 3\n"
                " set Spectral radius = 1\nend\n");
    auto &dynamics = scene.analysis<DynamicAnalysis>();
    dynamics.start(scene.context);
    dynamics.run(scene.context);
    return scene.stream.str();
  }
} // namespace



TEST(Growth, IsToldWhileItRuns)
{
  const std::string grows = "the motion grows";
  EXPECT_EQ(said_with("").find(grows), std::string::npos);
  EXPECT_EQ(said_with("  set Damper = 1\n").find(grows), std::string::npos);
  // exp(0.8 t) over the largest of the first 1.2 s is 100 at the peak behind 1.2 s + 5.76 s
  const std::string said = said_with("  set Force = 0.8*slide.displacement rate\n");
  EXPECT_NE(said.find(grows), std::string::npos) << said;
  EXPECT_NE(said.find("at t = 7"), std::string::npos) << said;
}
