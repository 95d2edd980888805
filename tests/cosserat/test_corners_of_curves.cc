// Corners of curves that expressions describe: elements end there, as at those of a polyline of the same shape. Before,
// an element went round the corner.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  frame(const std::string &shape)
  {
    return "set Analyses = static\nsubsection Sections\n subsection s\n set Type = engineering constants\n set EA = 1e4\n"
           " set GA2 = 4e3\n set GA3 = 3e3\n set GJ = 0.8\n set EI2 = 1\n set EI3 = 2\n set Mass = 1\n end\nend\n"
           "subsection Bodies\n subsection frame\n set Type = beam\n set Axis 2 = 0.1, 0, 1\n set Section = s\n" +
           shape +
           " set Elements = 6\n end\nend\nsubsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n"
           " set Body B = frame.start\n end\nend\nsubsection Loads\n subsection pull\n set Type = point load\n"
           " set At = frame.end\n set Force = 0.3, -0.2, 0.4\n end\nend\n";
  }
} // namespace



TEST(CornersOfCurves, ExpressionsAsPolylines)
{
  // the second corner lies on no simple number
  const std::pair<std::string, std::string> shapes[] = {
    {" set Shape = expressions\n set Expressions = s, abs(s - 0.5), 0\n", " set Points = 0, 0.5, 0; 0.5, 0, 0; 1, 0.5, 0\n"},
    {" set Shape = expressions\n set Expressions = 2*s, min(s, 1/3), max(0, s - 0.7123)\n",
     " set Points = 0, 0, 0; 2/3, 1/3, 0; 1.4246, 1/3, 0; 2, 1/3, 0.2877\n"}};
  for (const auto &[expressions, points] : shapes)
    {
      Scene by_expressions(frame(expressions)), by_points(frame(points));
      by_expressions.equilibrium();
      by_points.equilibrium();
      ASSERT_EQ(by_expressions.system.size(), by_points.system.size());
      for (const std::string probe :
           {"frame.end.displacement x", "frame.end.displacement y", "frame.end.displacement z", "frame.start.moment 2"})
        {
          const double expected = by_points.value(probe);
          EXPECT_NEAR(by_expressions.value(probe), expected, 1e-8 * std::max(0.01, std::abs(expected)))
            << probe << " of\n" << expressions;
        }
    }
}
