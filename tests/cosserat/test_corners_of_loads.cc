// Time steps end at the corners of the functions of time that loads have.

#include <gtest/gtest.h>

#include "bodies.h"

using namespace samara;

namespace
{
  std::vector<double>
  corners(const std::string &load)
  {
    const Scene scene(bodies("", "", "") + "subsection Loads\nsubsection l\n" + load + "end\nend\n");
    const auto         &c = scene.system;
    std::vector<double> result;
    for (double t = c.next_corner(0, 10); t < 10 && result.size() < 100; t = c.next_corner(t, 10))
      result.push_back(t);
    return result;
  }

  TEST(CornersOfLoads, OfAllTheirComponents)
  {
    const std::string         components = "set Force = 1, t < 3 ? 0 : sin(t), table: 0 0; 1 7; 2 0\n"
                                           "set Moment = t < 1.5 ? 0 : 2, 0, abs(t - 9)\n";
    const std::vector<double> expected   = {1, 1.5, 2, 3, 9};
    EXPECT_EQ(corners("set Type = point load\n set At = ball.tip\n" + components), expected);
    // a function of s has corners in space only
    EXPECT_EQ(corners("set Type = line load\n set Body = rod\n set Variation = s < 0.5 ? 1 : 2\n" + components),
              expected);
    EXPECT_EQ(corners("set Type = gravity\n set Acceleration = t < 1 ? 0 : 3, 0, table: 0 0; 2 1; 3 1\n"),
              (std::vector<double>{1, 2, 3}));
  }



  TEST(CornersOfLoads, OfWhatIsSmooth)
  {
    EXPECT_TRUE(corners("set Type = point load\n set At = ball.tip\n set Force = 1, sin(t), t^2\n").empty());
    EXPECT_TRUE(corners("set Type = gravity\n").empty());
  }
} // namespace
