#include <samara/base/function_of_time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace samara;

namespace
{
  TEST(FunctionOfTime, IsZeroByDefault)
  {
    const FunctionOfTime f;
    EXPECT_EQ(f(3), 0);
    EXPECT_TRUE(f.is_zero());
    EXPECT_TRUE(f.is_constant());
  }



  TEST(FunctionOfTime, Constant)
  {
    const FunctionOfTime f = 2.5;
    EXPECT_EQ(f(7), 2.5);
    EXPECT_EQ(f.derivative(7), 0);
    EXPECT_TRUE(f.is_constant());
    EXPECT_FALSE(f.is_zero());
    EXPECT_EQ(f.text(), "2.5");
  }



  TEST(FunctionOfTime, Text)
  {
    const FunctionOfTime f("3*sin(2*t)");
    EXPECT_DOUBLE_EQ(f(0.4), 3 * std::sin(0.8));
    EXPECT_DOUBLE_EQ(f.derivative(0.4), 6 * std::cos(0.8));
    EXPECT_DOUBLE_EQ(f.second_derivative(0.4), -12 * std::sin(0.8));
    EXPECT_FALSE(f.is_constant());
    EXPECT_FALSE(f.is_zero());
  }



  TEST(FunctionOfTime, CopiesShareNothing)
  {
    FunctionOfTime       f("t^2");
    const FunctionOfTime g = f;
    f                      = FunctionOfTime("5");
    EXPECT_EQ(g(3), 9);
    EXPECT_EQ(f(3), 5);
  }



  TEST(FunctionOfTime, Table)
  {
    const FunctionOfTime f("table: 0 1; 2 5; 3, 5; 4 -1");
    EXPECT_EQ(f(-1), 1);
    EXPECT_EQ(f(0), 1);
    EXPECT_EQ(f(0.5), 2);
    EXPECT_EQ(f(2), 5);
    EXPECT_EQ(f(2.5), 5);
    EXPECT_EQ(f(3.5), 2);
    EXPECT_EQ(f(9), -1);
    EXPECT_EQ(f.derivative(1), 2);
    EXPECT_EQ(f.derivative(2), 0) << "at a corner, the slope to the right";
    EXPECT_EQ(f.derivative(3.5), -6);
    EXPECT_EQ(f.derivative(9), 0);
    EXPECT_EQ(f.second_derivative(1), 0);
    EXPECT_FALSE(f.is_constant());
  }



  TEST(FunctionOfTime, TableThatIsConstant)
  {
    EXPECT_TRUE(FunctionOfTime("table: 0 0; 1 0").is_zero());
    EXPECT_TRUE(FunctionOfTime("table: 0 2; 1 2").is_constant());
    EXPECT_FALSE(FunctionOfTime("table: 0 0; 1 1").is_zero());
  }



  // An abscissa that comes twice is a jump: at it the value is that to the right, and a corner is found there once.
  TEST(FunctionOfTime, TableWithAJump)
  {
    const FunctionOfTime f("table: 0 0; 1.5 3; 1.5 5; 2 4");
    EXPECT_EQ(f(1.5), 5);
    EXPECT_NEAR(f(1.5 - 1e-9), 3, 1e-8);
    EXPECT_EQ(f.derivative(1.5), -2);
    EXPECT_EQ(f.derivative(1), 2);
    EXPECT_EQ(f.next_corner(0, 2), 1.5);
    EXPECT_GT(f.next_corner(1.5, 2), 2);
    const FunctionOfTime same(f.formula_text());
    for (const double t : {-1., 0.3, 1.4999, 1.5, 1.7, 3.})
      EXPECT_NEAR(same(t), f(t), 1e-14) << t;
  }



  TEST(FunctionOfTime, RefusesBadTables)
  {
    for (const char *text : {"table:", "table: 1", "table: 0 0; 0 1; 0 2", "table: 1 0; 0 1", "table: 0 x", "table: 1 2 3"})
      EXPECT_THROW(FunctionOfTime{std::string(text)}, std::invalid_argument) << text;
  }



  const double none = std::numeric_limits<double>::infinity();

  /** All corners in an interval, each sought from the one before. */
  std::vector<double>
  corners(const std::string &text, double from, const double to)
  {
    const FunctionOfTime f(text);
    std::vector<double>  result;
    while (result.size() < 100 && (from = f.next_corner(from, to)) != none)
      result.push_back(from);
    return result;
  }

  void
  expect_corners(const std::string &text, const double from, const double to, const std::vector<double> &expected)
  {
    const auto found = corners(text, from, to);
    ASSERT_EQ(found.size(), expected.size()) << text;
    for (unsigned int i = 0; i < found.size(); ++i)
      EXPECT_DOUBLE_EQ(found[i], expected[i]) << text;
  }



  TEST(NextCorner, OfBranches)
  {
    const FunctionOfTime f("t < 1 ? 0 : t < 2 ? 12*(1 - cos(2*3.141592653589793*t)) : 0");
    EXPECT_EQ(f.next_corner(0, 10), 1);
    EXPECT_EQ(f.next_corner(1, 10), 2);
    EXPECT_EQ(f.next_corner(2, 10), none);
    EXPECT_EQ(f.next_corner(1.2, 1.9), none);
    EXPECT_EQ(f.next_corner(1 - 1e-14, 10), 2) << "at the beginning, but for round-off";
    EXPECT_EQ(f.next_corner(0, 1), none) << "at the end";
    EXPECT_EQ(f.next_corner(0, 1 + 1e-14), none);
    EXPECT_EQ(f.next_corner(1 - 1e-11, 1 + 1e-11), 1);
    EXPECT_EQ(f.next_corner(2, 0), none);
  }



  TEST(NextCorner, OfComparisonsIsExact)
  {
    for (const std::string comparison : {"<", "<=", ">", ">=", "==", "!="})
      expect_corners("(t " + comparison + " 0.1)*t", -3, 7, {0.1});
    expect_corners("(3*t - 0.5 < 0.2*t + 1)*t", 0, 1e5, {1.5 / 2.8});
    expect_corners("t > 0 ? 1 : 0", -1, 1, {0});
    expect_corners("t >= 1 && t < 1.001 || t > 9", 0, 10, {1, 1.001, 9});
    expect_corners("t > 1e6 ? 1 : 0", 0, 1e7, {1e6});
  }



  TEST(NextCorner, OfFunctions)
  {
    const double pi = M_PI;
    expect_corners("abs(sin(t))", 0, 10, {pi, 2 * pi, 3 * pi});
    expect_corners("sign(t - 1)", 0, 2, {1});
    expect_corners("min(t, 1, 3 - t)", 0, 4, {1, 2});
    expect_corners("max(0, t - 1)", 0, 4, {1});
    expect_corners("floor(t)", 0.5, 3.5, {1, 2, 3});
    expect_corners("ceil(t)", 0.5, 3.5, {1, 2, 3});
    expect_corners("rint(t)", 0, 3, {0.5, 1.5, 2.5});
    // from pi to -pi at t = pi; and at the ends of the half plane, which does no harm
    expect_corners("atan2(sin(t), cos(t))", 0, 6, {pi / 2, pi, 3 * pi / 2});
    expect_corners("floor(sqrt(t - 1))", 0, 6, {2, 5});
  }



  /** What is compared is linear, also by parts: however close two switches are, and however long the interval. */
  TEST(NextCorner, NoneIsMissedWhereLinesAreCompared)
  {
    const double far = 1e6;
    expect_corners("t > 0.5 && t < 0.5001 ? 1 : 0", -far, far, {0.5, 0.5001});
    expect_corners("min(1, max(0, (t - 1)/2))", -far, far, {1, 3});
    expect_corners("(t > 3) - (t > 3.00001)", -far, far, {3, 3.00001});
    expect_corners("abs(3 - 2*t) < 1e-3 ? 1 : 0", -far, far, {1.4995, 1.5, 1.5005});
    expect_corners("-t > -0.7 ? t : t < 0.7001 ? 0.7 : t < 1 ? 2*t : -t", -far, far, {0.7, 0.7001, 1});
    expect_corners("max(t, 2, 4 - 1.5*t)", -far, far, {4. / 3, 2});
    expect_corners("(t < 1 ? t : 2 - t) > 0.99 ? 1 : 0", -far, far, {0.99, 1, 1.01});
    // not where another branch is taken
    expect_corners("t < 0 ? abs(t - 5) : t < 1 ? min(t, -3) : 0", -far, far, {0, 1});
  }



  /** What is not linear, or is rounded, is sought by looking at it. */
  TEST(NextCorner, OfOtherComparisons)
  {
    expect_corners("t^2 < 4 ? 1 : 0", 0, 10, {2});
    expect_corners("t - floor(t) < 0.5 ? 1 : 0", 0.1, 2.2, {0.5, 1, 1.5, 2});
    expect_corners("(t < 5 ? sin(t) : 3) > 0 ? 1 : 0", 1, 8, {M_PI, 5});
    expect_corners("t*t < 4 ? 1 : 0", 0, 10, {2});
    expect_corners("1/t < 4 ? 1 : 0", 0.1, 10, {0.25});
  }



  TEST(NextCorner, OnlyWhereItCounts)
  {
    expect_corners("t < 1 ? abs(sin(40*t)) : 2*t", 0.99, 100, {1});
    expect_corners("t < 1 ? t : floor(t) > 3 ? 1 : 0", 0.2, 4.5, {1, 2, 3, 4});
    expect_corners("1 ? t : abs(t - 1)", 0, 4, {});
  }



  TEST(NextCorner, OfWhatIsSmooth)
  {
    for (const std::string text : {"3", "2 < 1 ? 3 : 4", "sin(t)", "t^2/(1 + t)", "table: 0 2; 1 2", "abs(1 + t^2)"})
      expect_corners(text, 0, 100, {});
    EXPECT_EQ(FunctionOfTime(3).next_corner(0, 1), none);
  }



  /** Whatever the interval is, one switch in it is found. */
  TEST(NextCorner, OneIsNeverMissed)
  {
    const FunctionOfTime f("t < 0.7310585786 ? 0 : t");
    for (unsigned int i = 1; i < 200; ++i)
      {
        const double before = std::pow(10., 4 - 0.07 * i), after = std::pow(10., 0.07 * i - 10);
        EXPECT_EQ(f.next_corner(0.7310585786 - before, 0.7310585786 + after), 0.7310585786) << before << " " << after;
      }
  }



  TEST(NextCorner, OfTables)
  {
    expect_corners("table: 0 1; 2 5; 3, 5; 4 -1", -1, 9, {0, 2, 3, 4});
    expect_corners("table: 0 1; 2 5; 3, 5; 4 -1", 0, 4, {2, 3});
    expect_corners("table: 0 1; 2 5; 3, 5; 4 -1", 2, none, {3, 4});
  }



  TEST(Expression, IsOfAnotherVariable)
  {
    EXPECT_EQ(Expression("1 + s")(2), 3);
    EXPECT_THROW(Expression("1 + t"), std::invalid_argument);
    EXPECT_THROW(FunctionOfTime("1 + s"), std::invalid_argument);
  }
} // namespace
