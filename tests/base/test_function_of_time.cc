#include <samara/base/function_of_time.h>

#include <gtest/gtest.h>

#include <cmath>
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



  TEST(FunctionOfTime, RefusesBadTables)
  {
    for (const char *text : {"table:", "table: 1", "table: 0 0; 0 1", "table: 1 0; 0 1", "table: 0 x", "table: 1 2 3"})
      EXPECT_THROW(FunctionOfTime{std::string(text)}, std::invalid_argument) << text;
  }



  TEST(Expression, IsOfAnotherVariable)
  {
    EXPECT_EQ(Expression("1 + s")(2), 3);
    EXPECT_THROW(Expression("1 + t"), std::invalid_argument);
    EXPECT_THROW(FunctionOfTime("1 + s"), std::invalid_argument);
  }
} // namespace
