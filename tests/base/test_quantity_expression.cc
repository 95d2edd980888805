#include <samara/base/function_of_time.h>
#include <samara/base/quantity.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace samara;

namespace
{
  FunctionOfTime
  of_time(const std::string &text, const std::string &unit, const Quantities &quantities = Quantities())
  {
    return FunctionOfTime(quantities.expression(text, unit, {"t"}));
  }

  std::string
  fault_of_expression(const std::string &text, const std::string &unit)
  {
    try
      {
        return "no fault: " + Quantities().expression(text, unit, {"t"});
      }
    catch (const std::invalid_argument &e)
      {
        return e.what();
      }
  }



  TEST(QuantityExpression, ConvertsUnits)
  {
    EXPECT_DOUBLE_EQ(of_time("12*(1 - cos(2*pi*t)) N*m", "N*m")(0.25), 12);
    EXPECT_DOUBLE_EQ(of_time("(1 - cos(t)) kN", "N")(M_PI), 2000);
    EXPECT_DOUBLE_EQ(of_time("3 ft/s * t", "m")(2), 6 * 0.3048);
    EXPECT_DOUBLE_EQ(of_time("750 rpm * t", "rad")(1), 25 * M_PI);
    EXPECT_DOUBLE_EQ(of_time("sin(5 rad/s * t)", "1")(0.1), std::sin(0.5));
    EXPECT_DOUBLE_EQ(of_time("t < 0.5 s ? 3 N : 4 N", "N")(1), 4);
    EXPECT_DOUBLE_EQ(of_time("5 deg * sin(t)", "rad")(M_PI / 2), M_PI / 36);
    EXPECT_DOUBLE_EQ(of_time("10 t", "m")(3), 30) << "a variable is not the tonne";
  }



  TEST(QuantityExpression, WithoutVariablesIsANumber)
  {
    EXPECT_EQ(Quantities().expression("5 kN", "N", {"t"}), "5000");
    EXPECT_NE(fault_of_expression("5 kg", "N").find("a mass [kg], but [N] is wanted"), std::string::npos);
  }



  TEST(QuantityExpression, ReplacesConstants)
  {
    Quantities quantities;
    Complaints complaints;
    quantities.add_constant("F0", "-3 kN", "here", complaints);
    quantities.add_constant("w", "2 lb", "here", complaints);
    complaints.throw_if_any();
    EXPECT_EQ(of_time("F0*t^2", "N", quantities)(2), -12000);
    EXPECT_DOUBLE_EQ(of_time("w*t", "N", quantities)(1), 2 * 4.4482216152605);
    EXPECT_DOUBLE_EQ(of_time("w*t", "kg", quantities)(1), 2 * 0.45359237);
  }



  TEST(QuantityExpression, ChecksTheDimensionAsFarAsItIsCertain)
  {
    EXPECT_EQ(fault_of_expression("2 kg * sin(t)", "N"), "<2 kg * sin(t)> is a mass [kg], but [N] is wanted.");
    EXPECT_NE(fault_of_expression("2 kg * t", "N").find("but [N] is wanted"), std::string::npos);
    EXPECT_NE(fault_of_expression("5 lb + 3*t", "N").find("write lbf"), std::string::npos);
    EXPECT_EQ(of_time("5 lbf + 3*t", "N")(1), 5 * 4.4482216152605 + 3) << "nobody knows what 3 is";
    EXPECT_EQ(of_time("3*t", "N")(1), 3);
  }



  TEST(QuantityExpression, SIsALength)
  {
    const auto expression = [](const std::string &text, const std::string &unit) {
      return Expression(Quantities().expression(text, unit, {"s"}));
    };
    EXPECT_DOUBLE_EQ(expression("1 ft + 0.1*s", "m")(2), 0.5048);
    EXPECT_DOUBLE_EQ(expression("2 kg/m^2 * s", "kg/m")(3), 6);
    EXPECT_DOUBLE_EQ(expression("0.2 ft * (1 - s)", "m")(0), 0.06096);
  }



  TEST(QuantityExpression, Tables)
  {
    const auto f = of_time("table: 0 s, 0 N; 500 ms, 2 kN; 1, -(1 kN)", "N");
    EXPECT_DOUBLE_EQ(f(0.25), 1000);
    EXPECT_DOUBLE_EQ(f(2), -1000);
    EXPECT_DOUBLE_EQ(of_time("table: 0 0; 1 3", "N")(0.5), 1.5);
  }



  TEST(QuantityExpression, RefusesWhatItCannotRead)
  {
    for (const char *text : {"",
                             "t +",
                             "x*t",
                             "t s t",
                             "table: 0 0; 1 kg, 3",
                             "table: 0, 2 kg",
                             "table: 0",
                             "table: 0 0; 0 1; 0 2",
                             "t(3)",
                             "sin(t, 1)"})
      EXPECT_EQ(fault_of_expression(text, "N").find("no fault"), std::string::npos)
        << text << fault_of_expression(text, "N");
  }
} // namespace
