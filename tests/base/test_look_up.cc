// Tables from files, in expressions and by themselves, and the functions that choose.

#include <samara/base/function_of_time.h>
#include <samara/base/quantity.h>

#include <gtest/gtest.h>

#include <cmath>

#include "temporary_folder.h"

using namespace samara;

namespace
{
  const std::string hill = "0, 0\n1, 2\n3, 2.5\n4, 2\n7, 6\n";

  Jet
  at(const LookUp &table, const double x, const double y = 0)
  {
    const Jet arguments[] = {{x, 1, 0}, {y, 0, 0}};
    return table(arguments);
  }

  std::string
  problem_of(const std::string &text, const unsigned int n_arguments = 1, const std::string &column = "")
  {
    try
      {
        LookUp(text, "some.csv", column, n_arguments, false);
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



TEST(LookUp, IsLinearAndKeepsItsEnds)
{
  const LookUp table(hill, "hill", "", 1, false);
  EXPECT_EQ(at(table, 0.25).value, 0.5);
  EXPECT_EQ(at(table, 0.25).first, 2);
  EXPECT_EQ(at(table, 5.5).value, 4);
  EXPECT_EQ(at(table, 7).value, 6);
  for (const double beyond : {-3., 11.})
    {
      EXPECT_EQ(at(table, beyond).value, beyond < 0 ? 0 : 6);
      EXPECT_EQ(at(table, beyond).first, 0);
    }
}



// Against scipy.interpolate.PchipInterpolator of the same rows, values and slopes.
TEST(LookUp, CubicIsThatOfFritschAndButland)
{
  const LookUp table(hill, "hill", "", 1, true);
  const double wanted[][3] = {{0.5, 1.262105855855856, 2.232545045045045},
                              {2, 2.3716216216216215, 0.2533783783783784},
                              {3.5, 2.25, -0.75},
                              {5, 2.435185185185185, 0.875},
                              {6.5, 4.763310185185185, 2.239583333333333}};
  for (const auto &[x, value, slope] : wanted)
    {
      EXPECT_NEAR(at(table, x).value, value, 1e-14);
      EXPECT_NEAR(at(table, x).first, slope, 1e-14);
    }
  const double h = 1e-4;
  for (const double x : {0.3, 1.7, 3.2, 6.})
    EXPECT_NEAR(at(table, x).second, (at(table, x + h).first - at(table, x - h).first) / (2 * h), 1e-9);
}



TEST(LookUp, CubicIsMonotoneSmoothAndExactForLines)
{
  const LookUp steps("0, 0\n1, 0\n1.1, 5\n2, 5\n4, 5.1\n", "steps", "", 1, true),
    line("-1, 5\n0.5, 2\n4, -5\n", "line", "", 1, true), two("1, 4\n3, 8\n", "two", "", 1, true);
  for (double x = 0.001; x < 4; x += 0.003)
    EXPECT_GE(at(steps, x).first, 0) << x;
  for (const double x : {1., 1.1, 2.})
    EXPECT_NEAR(at(steps, x - 1e-12).first, at(steps, x + 1e-12).first, 1e-7);
  for (const double x : {-0.5, 0.5, 2., 3.9})
    {
      EXPECT_NEAR(at(line, x).value, 3 - 2 * x, 1e-14);
      EXPECT_NEAR(at(line, x).first, -2, 1e-14);
    }
  EXPECT_DOUBLE_EQ(at(two, 1.5).value, 5);
}



TEST(LookUp, OfTwoVariablesIsExactForProducts)
{
  std::string text = "x, y, f\n";
  const auto  f    = [](const double x, const double y) { return 1 + 2 * x - 3 * y + 4 * x * y; };
  for (const double y : {2., -1., 0.5}) // in any order
    for (const double x : {0., 1., 3., 7.})
      text += std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(f(x, y)) + "\n";
  const LookUp table(text, "map", "", 2, false);
  for (const double x : {0., 0.7, 3., 6.5})
    for (const double y : {-1., 0.1, 1.9})
      EXPECT_NEAR(at(table, x, y).value, f(x, y), 1e-12);
  // along a line x = 1 + t, y = 2 t at t = 0.3
  const Jet along[] = {{1.3, 1, 0}, {0.6, 2, 0}}, value = table(along);
  EXPECT_NEAR(value.first, 2 - 3 * 2 + 4 * (0.6 + 1.3 * 2), 1e-12);
  EXPECT_NEAR(value.second, 4 * 2 * 2, 1e-12);
  EXPECT_NEAR(at(table, 9, 5).value, f(7, 2), 1e-12); // kept beyond each end
  EXPECT_EQ(at(table, 9, 1).first, 0);
}



TEST(LookUp, RefusesWhatIsNoTable)
{
  EXPECT_NE(problem_of("").find("empty"), std::string::npos);
  EXPECT_NE(problem_of("x, y\n1, 2\n").find("fewer than two"), std::string::npos);
  EXPECT_NE(problem_of("x, y\n1, 2\n1, 3\n").find("some.csv:3: the numbers of the first column must increase"),
            std::string::npos);
  EXPECT_NE(problem_of("x, y\n1, 2\n2, 3, 4\n").find("some.csv:3: there are 3 fields"), std::string::npos);
  EXPECT_NE(problem_of("x, y\n1, 2\n2, nan\n").find("some.csv:3: <nan> is not a number"), std::string::npos);
  EXPECT_NE(problem_of("x, y, z\n1, 2, 3\n2, 3, 4\n").find("3 columns; 2 are wanted"), std::string::npos);
  EXPECT_NE(problem_of("x, y, z\n1, 2, 3\n2, 3, 4\n", 1, "w").find("no column <w>"), std::string::npos);
  EXPECT_NE(problem_of("x, y, z\n1, 2, 3\n2, 3, 4\n", 1, "x").find("is an argument"), std::string::npos);
  EXPECT_NE(problem_of("x [mm], y [pound]\n1, 2\n2, 3\n").find("some.csv:1: "), std::string::npos);
  EXPECT_NE(problem_of("0, 0, 1\n0, 1, 1\n1, 0, 1\n", 2).find("no row for x = 1, y = 1"), std::string::npos);
  EXPECT_NE(problem_of("0, 0, 1\n0, 1, 1\n1, 0, 1\n0, 1, 2\n", 2).find("two rows for x = 0, y = 1"), std::string::npos);
  EXPECT_EQ(problem_of("0, 0, 1\n0, 1, 1\n1, 0, 1\n1, 1, 2\n", 2), "");
  EXPECT_EQ(problem_of("# what it is\nx, \"a, b\", z\n1, 2, 3\n\n2, 3, 4\n", 1, "a, b"), "");
}



TEST(LookUp, StandsInFormulas)
{
  const TemporaryFolder folder;
  const std::string     file = folder.write("hill, steep (old).csv", hill), call = "table(\"" + file + "\", ";
  const Formula         formula("3 + 2*" + call + "t^2 - 1)", "t");
  EXPECT_DOUBLE_EQ(formula(1.5).value, 3 + 2 * (2 + 0.25 * 0.25));
  EXPECT_DOUBLE_EQ(formula(1.5).first, 2 * 0.25 * 2 * 1.5);
  EXPECT_DOUBLE_EQ(formula(1.5).second, 2 * 0.25 * 2);
  EXPECT_TRUE(Formula(call + "2)", "t").is_constant());
  EXPECT_EQ(Formula(call + "2, linear)", "t")(0).value, 2.25);
  EXPECT_EQ(Formula(call + "(2), cubic)", "t")(0).value, at(LookUp(hill, "", "", 1, true), 2).value);
  // the tables of a table, and of a branch
  EXPECT_EQ(Formula(call + call + "t))", "t")(1).value, 2.25);
  EXPECT_EQ(Formula("t > 0 ? " + call + "t) : 1", "t")(1).value, 2);

  const ScalarFunction function(call + "2*t - 1)", "t");
  std::vector<double>  corners;
  for (double x = -9; (x = function.next_corner(x, 9.)) < 9;)
    corners.push_back(x);
  ASSERT_EQ(corners.size(), 5u);
  for (unsigned int i = 0; i < 5; ++i)
    EXPECT_NEAR(corners[i], std::vector<double>({0.5, 1, 2, 2.5, 4})[i], 1e-12);
  EXPECT_NEAR(ScalarFunction(call + "t^3, cubic)", "t").next_corner(0.1, 9.), std::cbrt(7.), 1e-12);

  for (const std::string &faulty : {std::string("table(t)"),
                                    std::string("table(\"\", t)"),
                                    "table(\"" + file + "\")",
                                    call + "t, 1, 2)",
                                    call + "t, 1, cubic)",
                                    call + "t, 1)",
                                    call + "cubic)",
                                    call + "t",
                                    "\"" + file + "\"",
                                    "3 \"" + file + "\"",
                                    "sin(\"" + file + "\")",
                                    "table(\"" + folder.path("none.csv") + "\", t)"})
    EXPECT_THROW(Formula(faulty, "t"), std::invalid_argument) << faulty;
}



TEST(LookUp, HasUnits)
{
  const TemporaryFolder folder;
  folder.write("spring.csv", "stretch [mm], pull [kN]\n-10, -3\n0, 0\n5, 1\n");
  folder.write("plain.csv", "0, 0\n5, 1\n");
  folder.write("polar.csv", "alpha [deg], mach, lift, drag [N]\n-9, 0, 1, 2\n-9, 1, 3, 4\n9, 0, 5, 6\n9, 1, 7, 8\n");
  Quantities q;
  q.signals.add_object("slide");
  q.signals.add_object("spring"); // not what stands in quotes
  const auto law = [&](const std::string &text, const std::string &unit) {
    return q.law(with_tables_beside(text, folder.path("model.prm") + ":12"), unit);
  };
  const auto value = [&](const std::string &text, const std::string &unit, const double signal) {
    const double variables[] = {0.5, signal, 0.25};
    return law(text, unit).value(variables);
  };
  const auto refused = [&](const std::string &text, const std::string &unit) {
    try
      {
        law(text, unit);
      }
    catch (const std::invalid_argument &)
      {
        return true;
      }
    return false;
  };
  EXPECT_DOUBLE_EQ(value("-table(\"spring.csv\", slide.displacement)", "N", 0.0025), -500);
  EXPECT_DOUBLE_EQ(value("2*table(\"spring.csv\", slide.displacement rate*0.1 s)/(1 m)", "N/m", 0.025), 1000);
  EXPECT_TRUE(refused("-table(\"spring.csv\", slide.displacement rate)", "N"));
  EXPECT_TRUE(refused("-table(\"spring.csv\", slide.displacement)", "N*m"));
  // where it is flat, too
  EXPECT_TRUE(refused("table(\"spring.csv\", 1000*slide.rotation)", "N") &&
              refused("table(\"spring.csv\", 20 s*slide.displacement rate^2/(1 m/s) + 1 s)", "N"));
  // without units of its own it is of pure numbers
  EXPECT_DOUBLE_EQ(value("table(\"plain.csv\", slide.displacement/(1 mm))*1 kN", "N", 0.0025), 500);
  EXPECT_DOUBLE_EQ(value("table(\"plain.csv\", slide.displacement)", "N", 2.5), 0.5);
  // of two variables, with a column by name
  EXPECT_DOUBLE_EQ(
    value("table(\"polar.csv: drag\", slide.rotation, slide.displacement rate/(1 m/s))", "N", 9 * M_PI / 180), 6.5);
  EXPECT_DOUBLE_EQ(value("2 N*table(\"polar.csv: lift\", slide.rotation, slide.displacement/(1 m))", "N", 0), 7);
  // what is printed reads as the same law
  const Law    first = law("-table(\"spring.csv\", slide.displacement)", "N"), again = q.law(first.text(), "N");
  const double at[] = {0, 0.004};
  EXPECT_DOUBLE_EQ(again.value(at), first.value(at));

  // functions of time, and numbers
  const auto function = [&](const std::string &text, const std::string &unit) {
    return FunctionOfTime(q.expression(with_tables_beside(text, folder.path("model.prm") + ":12"), unit, {"t"}));
  };
  folder.write("drive.csv", "time [ms], angle [deg]\n0, 0\n100, 90\n");
  EXPECT_NEAR(function("table(\"drive.csv\", t)", "rad")(0.05), M_PI / 4, 1e-15);
  EXPECT_NEAR(function("table(\"drive.csv\", t)", "rad").next_corner(0.01, 1), 0.1, 1e-15);
  EXPECT_DOUBLE_EQ(q.number(with_tables_beside("2*table(\"spring.csv\", 2.5 mm)", folder.path("x")), "N"), 1000);
  EXPECT_THROW(q.number(with_tables_beside("table(\"spring.csv\", 2.5 s)", folder.path("x")), "N"),
               std::invalid_argument);
}



TEST(Choices, SaturateAndDeadband)
{
  const Formula limited("saturate(2*t, -1, 3)", "t"), idle("deadband(2*t, 0.5)", "t");
  const double  x[] = {-2, 0.25, 1, 2}, limits[] = {-1, 0.5, 2, 3}, slopes[] = {0, 2, 2, 0};
  const double  rest[] = {-3.5, 0, 1.5, 3.5}, rest_slopes[] = {2, 0, 2, 2};
  for (unsigned int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(limited(x[i]).value, limits[i]);
      EXPECT_EQ(limited(x[i]).first, slopes[i]);
      EXPECT_EQ(idle(x[i]).value, rest[i]);
      EXPECT_EQ(idle(x[i]).first, rest_slopes[i]);
    }
  EXPECT_EQ(Formula("saturate(5, 0, 2 + t)", "t")(1).first, 1);
  EXPECT_EQ(Formula("deadband(-9, t)", "t")(1).value, -8);
  EXPECT_EQ(Formula("deadband(-9, t)", "t")(1).first, 1);
  EXPECT_TRUE(std::isnan(Formula("deadband(sqrt(-t), 1)", "t")(1).value));
  EXPECT_TRUE(std::isnan(Formula("saturate(sqrt(-t), 0, 1)", "t")(1).value));
  for (const std::string text : {"saturate(t, 2, 1)", "deadband(t, -1)", "saturate(t, 1)", "deadband(t)"})
    EXPECT_THROW(Formula(text, "t"), std::invalid_argument) << text;

  const auto corners = [](const std::string &text) {
    const ScalarFunction function(text, "t");
    std::vector<double>  places;
    for (double x = -9; (x = function.next_corner(x, 9.)) < 9;)
      places.push_back(std::round(1e9 * x) / 1e9);
    return places;
  };
  EXPECT_EQ(corners("saturate(2*t, -1, 3)"), (std::vector<double>{-0.5, 1.5}));
  EXPECT_EQ(corners("deadband(2*t, 0.5)"), (std::vector<double>{-0.25, 0.25}));
  EXPECT_EQ(corners("abs(deadband(t, 1) - 1)"), (std::vector<double>{-1, 1, 2}));
  EXPECT_EQ(corners("deadband(t^3, 8)"), (std::vector<double>{-2, 2}));
}



// What is not chosen where dimensions are measured has a dimension, too.
TEST(Choices, AllArgumentsHaveUnits)
{
  Quantities q;
  q.signals.add_object("slide");
  for (const std::string right : {"min(2 N/m*slide.displacement, 50 kN)",
                                  "saturate(2 N/m*slide.displacement, -1 N, 0.1 kN)",
                                  "deadband(2 N*s/m*slide.displacement rate, 0.1 N)",
                                  "2*max(0, 3 N)*sign(slide.displacement)"})
    EXPECT_NO_THROW(q.law(right, "N")) << right;
  for (const std::string wrong : {"min(2 N/m*slide.displacement, 50 km)",
                                  "saturate(2 N/m*slide.displacement, -1 N, 5 km)",
                                  "saturate(2 N/m*slide.displacement, -1 m, 5 kN)",
                                  "saturate(2 N*slide.displacement/(1 s), -1 N, 5 kN)",
                                  "deadband(2 N/m*slide.displacement, 0.1 m)"})
    EXPECT_THROW(q.law(wrong, "N"), std::invalid_argument) << wrong;
  EXPECT_DOUBLE_EQ(q.number("saturate(3 m, 0, 50 cm) + deadband(-2 m, 1 m) + min(2 m, 1 ft, 1 m)", "m"),
                   0.5 - 1 + 0.3048);
  EXPECT_THROW(q.number("min(2 m, 1 s)", "m"), std::invalid_argument);
}
