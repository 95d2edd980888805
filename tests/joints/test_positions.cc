// Where joints are: springs and distances begin at their Position on body A, whatever body that is. Expected: the same
// equations as with a named point there, to round-off; a weight that hangs, m g.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  /** Two bodies and a joint from a point of @p a at (1, 0.4, 0.2), a named one or a position, to the second body. */
  std::string
  joint_to_second_body(const std::string &kind, const std::string &entries)
  {
    return "subsection Bodies\n subsection a\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1, 1\n"
           " set Position = 0.3, -0.2, 0.1\n set Rotation = 0.4, 0.2, -0.7\n set Frames = end at 1 0.4 0.2\n end\n"
           " subsection b\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1, 1\n set Position = 2, 1, 1\n end\nend\n"
           "subsection Joints\n subsection j\n set Type = " +
           kind + "\n set Body B = b\n" + entries + " end\nend\n";
  }

  /** The residual somewhere. */
  Eigen::VectorXd
  residual(const std::string &text)
  {
    const Scene                            scene(text);
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> number(-0.3, 0.3);
    State                                  state = scene.system.reference();
    std::vector<double>                    z(scene.system.size()), r;
    std::generate(z.begin(), z.end(), [&]() { return number(random); });
    scene.system.update(state, z);
    scene.system.stresses(state, state.stress);
    scene.system.residual(state, state.stress, r);
    return Eigen::Map<Eigen::VectorXd>(r.data(), r.size());
  }
} // namespace



TEST(Positions, SpringsAndDistancesBeginThere)
{
  const std::string length = " subsection length\n set Spring = 5\n set Rest = 1\n end\n";
  for (const auto &[kind, entries] : {std::pair<std::string, std::string>("spring", length), {"distance", ""}})
    for (const std::string body : {"a", "ground"})
      {
        Eigen::VectorXd with_position =
          residual(joint_to_second_body(kind, entries + " set Body A = " + body + "\n set Position = 1, 0.4, 0.2\n"));
        if (body == "a")
          {
            const Eigen::VectorXd of_named = residual(joint_to_second_body(kind, entries + " set Body A = a.end\n"));
            EXPECT_LT((with_position - of_named).norm(), 1e-13) << kind;
          }
        EXPECT_GT(
          (with_position - residual(joint_to_second_body(kind, entries + " set Body A = " + body + "\n"))).norm(), 1e-3)
          << kind << " on " << body;
      }
}



// A mass of 1 kg hangs 1 m below the end of a rod on the ground: it stays there, and the rod carries its weight.
TEST(Positions, WeightHangsOnARod)
{
  Scene scene("set Analyses = dynamic\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n"
              " set Inertia = 1, 1, 1\n set Position = 1, 0, 0\n end\nend\nsubsection Joints\n subsection rod\n"
              " set Type = distance\n set Body A = ground\n set Position = 1, 0, 1\n set Body B = b\n end\nend\n"
              "subsection Loads\n subsection g\n set Type = gravity\n end\nend\n"
              "subsection Dynamic\n set End time = 0.1\n set Step = 0.01\nend\n");
  auto &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_NEAR(scene.value("b.displacement x"), 0, 1e-12);
  EXPECT_NEAR(scene.value("b.displacement z"), 0, 1e-12);
  EXPECT_NEAR(scene.value("rod.force"), 9.80665, 1e-9);
}
