#include <samara/base/parameters.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  using Strings = std::vector<std::string>;

  template <typename T>
  T
  initial()
  {
    return T();
  }

  /** Eigen's own would be left without values. */
  template <>
  Eigen::Vector3d
  initial()
  {
    return Eigen::Vector3d::Zero();
  }

  /** Read "set x = text" into @p variable, and return the complaints. */
  template <typename T>
  Strings
  read(const std::string &text, T &variable, const std::string &documentation = "It [m].")
  {
    Parameters parameters;
    parameters.add("x", variable, documentation);
    Complaints complaints;
    parameters.parse(Outline::of_text("set x = " + text, "a.prm", complaints), Quantities(), complaints);
    return complaints.all();
  }

  /** What the text is read as; it must be accepted. */
  template <typename T>
  T
  value(const std::string &text, const std::string &documentation = "It [m].")
  {
    T variable = initial<T>();
    EXPECT_EQ(read(text, variable, documentation), Strings()) << text;
    return variable;
  }

  /** Whether the text is refused, and the variable left alone. */
  template <typename T>
  bool
  is_refused(const std::string &text, const std::string &documentation = "It [m].")
  {
    T          variable = initial<T>();
    const auto before   = Value<T>::write(variable);
    const bool refused  = !read(text, variable, documentation).empty();
    return refused && Value<T>::write(variable) == before;
  }



  TEST(Value, Integers)
  {
    EXPECT_EQ(value<int>("-3", "Some."), -3);
    EXPECT_EQ(value<unsigned int>("2*(1 + 3)", "Some."), 8u);
    EXPECT_TRUE(is_refused<int>("2.5", "Some."));
    EXPECT_TRUE(is_refused<int>("3e9", "Some."));
    EXPECT_TRUE(is_refused<int>("3 m", "Some."));
    EXPECT_TRUE(is_refused<unsigned int>("-1", "Some."));
  }



  TEST(Value, Bool)
  {
    bool b = false;
    EXPECT_EQ(read("yes", b), Strings());
    EXPECT_TRUE(b);
    EXPECT_EQ(read("false", b), Strings());
    EXPECT_FALSE(b);
    EXPECT_EQ(read("2 > 1", b), Strings());
    EXPECT_TRUE(b) << "a condition is 1 or 0";
    EXPECT_EQ(read("0", b), Strings());
    EXPECT_FALSE(b);
    EXPECT_TRUE(is_refused<bool>("2"));
    EXPECT_TRUE(is_refused<bool>("maybe"));
  }



  TEST(Value, Strings)
  {
    EXPECT_EQ(value<std::string>("hub.bracket S"), "hub.bracket S");
    EXPECT_EQ(value<Strings>("hub, shaft 1"), (Strings{"hub", "shaft 1"}));
    EXPECT_EQ(value<Strings>(""), Strings());
    EXPECT_TRUE(is_refused<Strings>("hub, , shaft 1"));
  }



  TEST(Value, Numbers)
  {
    EXPECT_DOUBLE_EQ(value<double>("1 ft"), 0.3048);
    EXPECT_DOUBLE_EQ(value<double>("4", "No unit."), 4);
    EXPECT_DOUBLE_EQ(value<double>("4", "No unit [-]."), 4);
    EXPECT_DOUBLE_EQ(value<double>("4 s", "Interval [0, 1] in time [s]."), 4) << "the last brackets count";
    EXPECT_TRUE(is_refused<double>("4 m", "No unit."));
    EXPECT_TRUE(is_refused<double>(""));
    EXPECT_TRUE(is_refused<double>("1, 2"));
  }



  TEST(Value, Vectors)
  {
    EXPECT_EQ(value<Eigen::Vector3d>("1, -2, 3e2"), Eigen::Vector3d(1, -2, 300));
    EXPECT_EQ(value<Eigen::Vector3d>("0, 0, 1 km"), Eigen::Vector3d(0, 0, 1000)) << "zero needs no unit";
    EXPECT_EQ(value<Eigen::Vector3d>("(1, max(1, 2), 3) km"), Eigen::Vector3d(1000, 2000, 3000));
    EXPECT_TRUE(is_refused<Eigen::Vector3d>("1, 2, 3 km")) << "one unit for all, or forgotten twice?";
    EXPECT_TRUE(is_refused<Eigen::Vector3d>("1, 2"));
    EXPECT_TRUE(is_refused<Eigen::Vector3d>("1, 2, 3, 4"));
    EXPECT_TRUE(is_refused<Eigen::Vector3d>("1, 2, x"));
    EXPECT_TRUE(is_refused<Eigen::Vector3d>("(1, 2, 3"));
    EXPECT_TRUE(is_refused<Eigen::Vector3d>("(1, 2, 3) kg"));
  }



  TEST(Value, Lists)
  {
    EXPECT_EQ(value<std::vector<double>>("1, 2 + 3, 4"), (std::vector<double>{1, 5, 4}));
    EXPECT_TRUE(value<std::vector<double>>("").empty());
    EXPECT_TRUE(is_refused<std::vector<double>>("1, , 2"));
    EXPECT_TRUE(is_refused<std::vector<double>>("1; 2"));

    using Points = std::vector<Eigen::Vector3d>;
    EXPECT_EQ(value<Points>("0, 0, 0; 6, 0, 0"), (Points{{0, 0, 0}, {6, 0, 0}}));
    EXPECT_EQ(value<Points>("(0, 0, 0; 6, 0, 0) km"), (Points{{0, 0, 0}, {6000, 0, 0}}));
    EXPECT_EQ(value<Points>("(0, 0, 1) km; 6, 0, 0"), (Points{{0, 0, 1000}, {6, 0, 0}}));
    EXPECT_TRUE(is_refused<Points>("0, 0, 0; 6, 0"));
  }



  TEST(Value, Functions)
  {
    EXPECT_DOUBLE_EQ(value<FunctionOfTime>("(1 - cos(t)) km")(M_PI), 2000);
    EXPECT_DOUBLE_EQ(value<FunctionOfTime>("table: 0 s, 0 m; 1 s, 1 km")(0.5), 500);
    EXPECT_TRUE(is_refused<FunctionOfTime>("2 kg*sin(t)"));
    EXPECT_TRUE(is_refused<FunctionOfTime>("s"));
    EXPECT_DOUBLE_EQ(value<Expression>("0.1*s")(2), 0.2);
    EXPECT_TRUE(is_refused<Expression>("t")) << "a tonne is no length";
  }



  TEST(Value, ListsOfFunctions)
  {
    using Functions = std::array<FunctionOfTime, 3>;
    const auto f    = value<Functions>("0, atan2(t, 1), 3 km");
    EXPECT_TRUE(f[0].is_zero());
    EXPECT_DOUBLE_EQ(f[1](1), M_PI / 4);
    EXPECT_TRUE(f[2].is_constant());
    EXPECT_DOUBLE_EQ(f[2](0), 3000);
    EXPECT_DOUBLE_EQ(value<Functions>("(0, t, t^2) km")[2](2), 4000);
    EXPECT_TRUE(is_refused<Functions>("0, t"));

    const auto e = value<std::array<Expression, 3>>("s, s^2, 0");
    EXPECT_DOUBLE_EQ(e[1](3), 9);
    EXPECT_EQ(value<std::vector<FunctionOfTime>>("1, t, table: 0 0; 1 5").size(), 3u);
  }
} // namespace
