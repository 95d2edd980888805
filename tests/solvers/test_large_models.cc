// What is said of a model before it is solved, for more constraints than dense elimination is used for: 110 bodies in a
// zigzag with ball joints, hung up at every tenth joint, have 3 (109 + 11) = 360.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  garland(const std::string &more_joints = "")
  {
    const auto ball = [](const std::string &name, const std::string &a, const int b) {
      return "subsection " + name + "\n set Type = spherical\n set Body A = " + a + "\n set Body B = b" +
             std::to_string(b) + "\n set Position = " + std::to_string(b) + ", 0, " + (b % 2 ? "0.5" : "0") + "\nend\n";
    };
    std::string bodies, joints;
    for (int i = 0; i < 110; ++i)
      {
        const std::string n = std::to_string(i);
        bodies += "subsection b" + n +
                  "\n set Type = rigid body\n set Mass = 1\n set Inertia = 0.1, 0.1, 0.1\n set Position = " + n +
                  ".5, 0, 0.25\nend\n";
        if (i > 0)
          joints += ball("j" + n, "b" + std::to_string(i - 1), i);
        if (i % 10 == 0)
          joints += ball("hook" + n, "ground", i);
      }
    return "subsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints + more_joints + "end\n";
  }
} // namespace



TEST(LargeModels, IndependentConstraintsAreFoundSo)
{
  Scene scene(garland());
  ASSERT_EQ(scene.system.layout.n_multipliers, 360u);
  ModelCheck check;
  find_redundant(scene.system, check);
  EXPECT_TRUE(check.redundant.empty());
}



TEST(LargeModels, RepeatedConstraintsAreNamed)
{
  // the same hook a second time: three constraints too many
  Scene      scene(garland("subsection again\n set Type = spherical\n set Body A = ground\n set Body B = b50\n"
                           " set Position = 50, 0, 0\nend\n"));
  ModelCheck check;
  find_redundant(scene.system, check);
  EXPECT_EQ(check.redundant_multipliers.size(), 3u);
  ASSERT_EQ(check.redundant.size(), 1u);
  for (const auto &sentence : check.redundant)
    {
      EXPECT_NE(sentence.find("again"), std::string::npos) << sentence;
      EXPECT_NE(sentence.find("hook50"), std::string::npos) << sentence;
    }
}



TEST(LargeModels, ManyFreeMotionsAreNotAllCounted)
{
  // 660 − 360 = 300 are free: no more than 32 of them are looked for, and the text says that there are others
  Scene      scene(garland());
  ModelCheck check;
  find_free_motions(scene.system, check);
  EXPECT_EQ(check.n_free_motions, 32u);
  EXPECT_NE(check.free_motions_text().find("others"), std::string::npos);
}
