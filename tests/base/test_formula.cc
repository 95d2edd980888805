#include <samara/base/formula.h>
#include <samara/base/tokens.h>

#include <gtest/gtest.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace samara;

namespace
{
  const char *const expressions[] = {"-t^2",
                                     "2^3^2*t",
                                     "2^-1 + t",
                                     "-2*3 - 4/2/2 + t",
                                     "8 - 3 - t",
                                     "t < 1 ? 3*t : t^2",
                                     "t > 1 ? 2 : 0 ? 3 : 4",
                                     "1 < 2 == t > 0",
                                     "t && 0 || 1",
                                     "2 <= t != (t >= 1)",
                                     "sin(t)*cos(2*t) - tan(t/3)",
                                     "asin(t/4) + acos(t/4)*t + atan(t)",
                                     "atan2(t, 1 + t^2)",
                                     "sinh(t) + cosh(t) - tanh(t)",
                                     "asinh(t) + acosh(1 + t) + atanh(t/4)",
                                     "exp(-t) + ln(t) + log(t) + log2(t) + log10(t)",
                                     "sqrt(t)/(1 + t)",
                                     "t^2.5 + t^t + 2^t",
                                     "abs(t - 1) + sign(t - 1) + rint(t) + rint(2.5)",
                                     "min(t, 2*t, 1.3) + max(t, 0.7)",
                                     "(1 + t) (2 - t)"};

  /** The languages are one language: what muParser says about the text, and differences of what it says. */
  TEST(Formula, AgreesWithMuParser)
  {
    double     t = 0;
    mu::Parser parser;
    parser.DefineVar("t", &t);
    for (const std::string expression : expressions)
      {
        const Formula formula(expression, "t");
        parser.SetExpr(expression == "(1 + t) (2 - t)" ? "(1 + t)*(2 - t)" : expression);
        for (const double x : {0.3, 0.9, 1.7})
          {
            t = x;
            EXPECT_NEAR(formula(x).value, parser.Eval(), 1e-14 * (1 + std::abs(parser.Eval()))) << expression;
          }
      }
  }



  TEST(Formula, DerivativesAgreeWithDifferences)
  {
    const double h = 1e-3;
    for (const std::string expression : expressions)
      {
        const Formula f(expression, "t");
        for (const double x : {0.3, 0.9, 1.7})
          {
            // of sixth order, on both the value and the first derivative
            const auto difference = [&](double Jet::*what) {
              return (45 * (f(x + h).*what - f(x - h).*what) - 9 * (f(x + 2 * h).*what - f(x - 2 * h).*what) +
                      (f(x + 3 * h).*what - f(x - 3 * h).*what)) /
                     (60 * h);
            };
            const Jet jet = f(x);
            EXPECT_NEAR(jet.first, difference(&Jet::value), 1e-9 * (1 + std::abs(jet.first))) << expression;
            EXPECT_NEAR(jet.second, difference(&Jet::first), 1e-9 * (1 + std::abs(jet.second))) << expression;
          }
      }
  }



  TEST(Formula, EveryFunctionIsTested)
  {
    std::string all;
    for (const std::string expression : expressions)
      all += expression;
    for (const auto &name : function_names())
      {
        const bool is_in_mu_parser =
          name != "floor" && name != "ceil" && name != "saturate" && name != "deadband" && name != table_function;
        EXPECT_EQ(all.find(name + "(") != std::string::npos, is_in_mu_parser) << name;
      }
    EXPECT_EQ(Formula("floor(t) + 10*ceil(t)", "t")(1.5).value, 21);
  }



  TEST(Formula, IsExactWhereDifferencesAreNot)
  {
    EXPECT_EQ(Formula("t^2", "t")(0).second, 2);
    EXPECT_EQ(Formula("t^1", "t")(0).second, 0);
    EXPECT_EQ(Formula("t + sqrt(0)", "t")(0).first, 1);
    EXPECT_EQ(Formula("t < 1 ? 0 : 5*(t - 1)", "t")(1).first, 5);
    EXPECT_EQ(Formula("sin(1e6*t)", "t")(0).first, 1e6);
  }



  TEST(Formula, KnowsWhetherItIsConstant)
  {
    EXPECT_TRUE(Formula("2*(3 + 4)", "t").is_constant());
    EXPECT_EQ(Formula("2*(3 + 4)", "t")(5).value, 14);
    EXPECT_FALSE(Formula("0*t", "t").is_constant());
    EXPECT_TRUE(Formula(3).is_constant());
  }



  /** Branches of ?: are skipped, and numbers at their ends are no constants that could be computed beforehand. */
  TEST(Formula, ComputesNothingAcrossBranches)
  {
    for (const double x : {0.5, 1.5})
      {
        EXPECT_EQ(Formula("(t < 1 ? 2 : 3) + 4*5", "t")(x).value, x < 1 ? 22 : 23);
        EXPECT_EQ(Formula("max(7, t < 1 ? 8 : 3, 4)", "t")(x).value, x < 1 ? 8 : 7);
        EXPECT_EQ(Formula("-(t < 1 ? 2 : 3)^(1 ? 2 : t)", "t")(x).value, x < 1 ? -4 : -9);
        EXPECT_EQ(Formula("(t < 1 ? 1 : (0 ? t : 2)) * (0 ? t : 2)", "t")(x).value, x < 1 ? 2 : 4);
        EXPECT_EQ(Formula("(1 ? (t < 1 ? 5 : 6) : t) - (3 - 2)", "t")(x).value, x < 1 ? 4 : 5);
        EXPECT_EQ(Formula("t < 1 ? t ? 1 : 2 : t > 1 ? 3 : 4", "t")(x).value, x < 1 ? 1 : 3);
        EXPECT_EQ(Formula("t + sqrt(1 ? 0 : t)", "t")(x).first, 1);
      }
    EXPECT_TRUE(Formula("2 > 1 ? 3 : t", "t").is_constant());
    EXPECT_EQ(Formula("2 > 1 ? 3 : 4", "t")(0).value, 3);
  }



  // What is no number is not hidden by what it is compared with.
  TEST(Formula, KeepsWhatIsNoNumber)
  {
    for (const std::string text : {"max(x, 0/0)",
                                   "max(0/0, x)",
                                   "min(1, x, 0/0)",
                                   "min(0/0, 1, x)",
                                   "saturate(0/0, 0, x)",
                                   "saturate(x, 0/0, 1)",
                                   "saturate(x, 0, 0/0)",
                                   "deadband(0/0, x)",
                                   "deadband(x, 0/0)"})
      EXPECT_TRUE(std::isnan(Formula(text, "x")(0.5).value)) << text;
  }



  TEST(Formula, RefusesWhatItCannotRead)
  {
    for (const char *text : {"",
                             "1 +",
                             "* 2",
                             "(1",
                             "1)",
                             "1 000",
                             "x",
                             "sin",
                             "sin()",
                             "sin(1, 2)",
                             "atan2(1)",
                             "sine(t)",
                             "1, 2",
                             "t ? 1",
                             "t = 3",
                             "t $ 3",
                             "1e999",
                             "()"})
      EXPECT_THROW(Formula(text, "t"), std::invalid_argument) << text;
  }



  TEST(Formula, RefusesWhatItsStackCannotHold)
  {
    std::string deep = "t";
    for (unsigned int i = 0; i < 200; ++i)
      deep = "1 + (" + deep + ")";
    EXPECT_THROW(Formula(deep, "t"), std::invalid_argument);

    std::string shallow = "t";
    for (unsigned int i = 0; i < 200; ++i)
      shallow = "(" + shallow + ") + 1";
    EXPECT_EQ(Formula(shallow, "t")(1).value, 201);
  }
} // namespace
