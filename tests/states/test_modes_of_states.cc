// Modes of models in which most unknowns, or all, are states of first order.

#include <gtest/gtest.h>

#include "../scene.h"

using namespace samara;

namespace
{
  /** n states that decay at 1, 2, 3, ... 1/s, and a body that is held, or slides on a spring with 1000 rad/s. */
  std::string
  decaying(const unsigned int n, const bool is_held, const unsigned int n_modes)
  {
    std::string text = "set Analyses = modal\nsubsection States\n";
    for (unsigned int i = 1; i <= n; ++i)
      text += "  subsection s" + std::to_string(i) + "\n    set Rate = -" + std::to_string(i) + "*s" +
              std::to_string(i) + " / 1 s\n  end\n";
    return text + R"(
end
subsection Bodies
  subsection block
    set Type    = rigid body
    set Mass    = 1
    set Inertia = 1, 1, 1
  end
end
subsection Joints
  subsection slide
    set Type   = )" +
           (is_held ? "rigid" : "prismatic") + R"(
    set Body A = ground
    set Body B = block
)" + (is_held ? "" : "    subsection displacement\n      set Spring = 1e6\n    end\n") +
           "  end\nend\nsubsection Modal\n  set Modes = " + std::to_string(n_modes) + "\nend\n";
  }
} // namespace



// Nothing moves, and nothing that could move has mass: what decays has modes all the same.
TEST(ModesOfStates, Alone)
{
  for (const unsigned int n : {1, 3, 100})
    {
      Scene      scene(decaying(n, true, 3));
      const auto modes = scene.modes();
      ASSERT_EQ(modes.size(), std::min(n, 3u)) << n;
      for (unsigned int i = 0; i < modes.size(); ++i)
        EXPECT_NEAR(std::abs(modes[i].lambda + (i + 1.)), 0, 1e-9) << n;
    }
}



// Many more states than masses: none is missing.
TEST(ModesOfStates, ManyBesideOneMass)
{
  Scene      scene(decaying(120, false, 40));
  const auto modes = scene.modes();
  ASSERT_EQ(modes.size(), 40u);
  for (unsigned int i = 0; i < modes.size(); ++i)
    EXPECT_NEAR(std::abs(modes[i].lambda + (i + 1.)), 0, 1e-8 * (i + 1)) << i;
}
