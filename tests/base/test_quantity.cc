#include <samara/base/quantity.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace samara;

namespace
{
  /** What number() complains about. */
  std::string
  fault_of_number(const Quantities &quantities, const std::string &text, const std::string &unit)
  {
    try
      {
        return "no fault: " + std::to_string(quantities.number(text, unit));
      }
    catch (const std::invalid_argument &e)
      {
        return e.what();
      }
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  /** Quantities with constants, about which nobody complains. */
  Quantities
  with_constants(const std::vector<std::pair<std::string, std::string>> &constants)
  {
    Quantities quantities;
    Complaints complaints;
    for (const auto &c : constants)
      quantities.add_constant(c.first, c.second, "here", complaints);
    complaints.throw_if_any();
    return quantities;
  }



  TEST(Quantity, ReadsExpressions)
  {
    const Quantities q;
    EXPECT_EQ(q.number("3", "m"), 3);
    EXPECT_EQ(q.number(" -2.5e3 ", "kg"), -2500);
    EXPECT_DOUBLE_EQ(q.number("6.0 ft", "m"), 1.8288);
    EXPECT_DOUBLE_EQ(q.number("6ft + 2 in", "m"), 1.8796);
    EXPECT_DOUBLE_EQ(q.number("1/2 m", "m"), 0.5);
    EXPECT_DOUBLE_EQ(q.number("(1 + 2) (3 + 4) N", "N"), 21);
    EXPECT_DOUBLE_EQ(q.number("sqrt(4 m^2)", "m"), 2);
    EXPECT_DOUBLE_EQ(q.number("sin(30 deg)", "1"), 0.5);
    EXPECT_DOUBLE_EQ(q.number("max(1 ft, 1 m)", "m"), 1);
    EXPECT_DOUBLE_EQ(q.number("2 min", "s"), 120) << "a unit called like a function";
    EXPECT_DOUBLE_EQ(q.number("min(2, 3)", "1"), 2);
    EXPECT_DOUBLE_EQ(q.number("10% + 5 %", "1"), 0.15);
    EXPECT_DOUBLE_EQ(q.number("floor(2.7) + ceil(0.1)", "1"), 3);
    EXPECT_DOUBLE_EQ(q.number("2 e", "1"), 2 * std::exp(1.));
  }



  TEST(Quantity, RefusesTheWrongDimension)
  {
    const Quantities q;
    EXPECT_EQ(fault_of_number(q, "5 m", "kg"), "<5 m> is a length [m], but [kg] is wanted.");
    EXPECT_EQ(fault_of_number(q, "5 m", "1"), "<5 m> is a length [m], but a number without unit is wanted.");
    EXPECT_EQ(fault_of_number(q, "45 deg", "m"), "<45 deg> is an angle [rad], but [m] is wanted.");
    EXPECT_TRUE(contains(fault_of_number(q, "45 deg", "rad/s"), "an angle [rad]"));
    EXPECT_TRUE(contains(fault_of_number(q, "5 m^2", "m"), "an area"));
    EXPECT_TRUE(contains(fault_of_number(q, "5 kg/m", "kg"), "a mass per length"));
    EXPECT_EQ(q.number("5 m", ""), 5) << "no unit is declared";
  }



  TEST(Quantity, RefusesMixedDimensions)
  {
    const Quantities q;
    for (const char *text : {"1 m + 1 kg",
                             "1 + 1 m",
                             "exp(1 m)",
                             "1 m + 1 m^2",
                             "sin(2 s)",
                             "min(1 m, 2 s)",
                             "1 m < 2 s ? 3 m : 4 m",
                             "2 m > 1 m ? 1 m : 1 s",
                             "atan2(1 m, 1 s) * 1 m",
                             "2^(1 m) * 1 m"})
      {
        EXPECT_TRUE(contains(fault_of_number(q, text, "m"), "mixes dimensions"))
          << text << ": " << fault_of_number(q, text, "m");
        EXPECT_TRUE(contains(fault_of_number(q, text, ""), "mixes dimensions")) << text;
      }
    EXPECT_EQ(q.number("6.0 ft - 6.0 ft", "m"), 0);
    EXPECT_EQ(q.number("2 m > 1 m ? 3 : 1 m", "m"), 3) << "a bare number has the dimension of the other branch";
    EXPECT_EQ(q.number("2 > 1 ? 0 : 1 m", "m"), 0) << "a zero has any dimension";
    EXPECT_EQ(q.number("sqrt(4 m^2) + saturate(3 m, 0, 1 m)", "m"), 3);
    EXPECT_NEAR(q.number("6.0 ft - 1.8288 m", "m"), 0, 1e-15) << "what rounding leaves has a dimension, too";
  }



  TEST(Quantity, AnAngleIsANumber)
  {
    const Quantities q;
    EXPECT_DOUBLE_EQ(q.number("2 N*m/rad", "N*m"), 2);
    EXPECT_DOUBLE_EQ(q.number("2 N*m", "N*m/rad"), 2);
    EXPECT_DOUBLE_EQ(q.number("180 N*m/deg", "N*m/rad"), 180 * 180 / M_PI);
    EXPECT_DOUBLE_EQ(q.number("90 deg", "1"), M_PI / 2);
    EXPECT_DOUBLE_EQ(q.number("2/s", "rad/s"), 2) << "no unit of angle is no contradiction";
  }



  TEST(Quantity, RefusesToGuessWhatACycleIs)
  {
    const Quantities q;
    EXPECT_TRUE(contains(fault_of_number(q, "5 Hz", "rad/s"), "rev/s"));
    EXPECT_TRUE(contains(fault_of_number(q, "300 rpm", "Hz"), "cycles"));
    EXPECT_EQ(q.number("5 Hz", "Hz"), 5);
    EXPECT_EQ(q.number("5 Hz", "1/s"), 5);
    EXPECT_DOUBLE_EQ(q.number("5 rev/s", "rad/s"), 10 * M_PI);
  }



  TEST(Quantity, APoundIsAMassUnlessAForceIsWanted)
  {
    const Quantities q;
    const double     mass = 0.45359237, force = mass * 9.80665, ft = 0.3048;
    EXPECT_DOUBLE_EQ(q.number("2 lb", "kg"), 2 * mass);
    EXPECT_DOUBLE_EQ(q.number("2 lb", "N"), 2 * force);
    EXPECT_DOUBLE_EQ(q.number("2 lb", ""), 2 * mass);
    EXPECT_DOUBLE_EQ(q.number("1e6 lb*ft^2", "N*m^2"), 1e6 * force * ft * ft);
    EXPECT_DOUBLE_EQ(q.number("1e6 lb*ft^2", "kg*m^2"), 1e6 * mass * ft * ft);
    EXPECT_DOUBLE_EQ(q.number("1 lb*s^2/ft", "kg"), force / ft) << "a slug";
    EXPECT_TRUE(contains(fault_of_number(q, "1 lb", "m"), "a mass"));
    EXPECT_DOUBLE_EQ(q.number("1 lb + 1 N", "N"), force + 1);
  }



  TEST(Quantity, APoundInAConstantKeepsBothReadings)
  {
    const auto   q    = with_constants({{"w", "10 lb"}, {"w2", "2*w"}, {"f", "1 lb + 1 N"}});
    const double mass = 0.45359237, force = mass * 9.80665;
    EXPECT_DOUBLE_EQ(q.number("w2", "kg"), 20 * mass);
    EXPECT_DOUBLE_EQ(q.number("w2", "N"), 20 * force);
    EXPECT_DOUBLE_EQ(q.number("f", "N"), force + 1);
    EXPECT_TRUE(contains(fault_of_number(q, "f", "kg"), "a force"));
  }



  TEST(Quantity, ConstantsCarryTheirDimension)
  {
    const auto q = with_constants({{"L", "6.0 ft"}, {"n", "4"}, {"A", "L^2"}, {"Omega", "300 rpm"}, {"neg", "-2 m"}});
    EXPECT_DOUBLE_EQ(q.number("L", "m"), 1.8288);
    EXPECT_DOUBLE_EQ(q.number("L/n", "m"), 0.4572);
    EXPECT_DOUBLE_EQ(q.number("A", "m^2"), 1.8288 * 1.8288);
    EXPECT_DOUBLE_EQ(q.number("Omega", "rad/s"), 10 * M_PI);
    EXPECT_DOUBLE_EQ(q.number("n", "kg"), 4) << "a number takes the declared unit";
    EXPECT_DOUBLE_EQ(q.number("neg^2", "m^2"), 4);
    EXPECT_TRUE(contains(fault_of_number(q, "A", "m"), "an area"));
  }



  TEST(Quantity, ZeroIsZeroInEveryUnit)
  {
    EXPECT_EQ(Quantities().number("0 ft", "kg"), 0);
  }



  TEST(Quantity, SaysWhichWordIsUnknown)
  {
    const auto q = with_constants({{"span", "6 m"}});
    EXPECT_EQ(fault_of_number(q, "2*spam", "m"),
              "<2*spam>: <spam> is neither a constant nor a unit nor a function; did you mean <span>?");
    EXPECT_TRUE(contains(fault_of_number(q, "2 slugs", "kg"), "did you mean <slug>?"));
    EXPECT_TRUE(contains(fault_of_number(q, "sine(2)", "1"), "did you mean <sin>?"));
    EXPECT_TRUE(contains(fault_of_number(q, "span(2)", "m"), "<span> is not a function"));
  }



  TEST(Quantity, RefusesWhatItCannotRead)
  {
    const Quantities q;
    for (const char *text :
         {"",   "  ",    "1 +",     "(1",  "1)",       "1 000", "1; 2",     "sin()",     "3 = 3", "1, 2",
          "()", "m = 3", "max(,1)", "1/0", "sqrt(-1)", "* 3",   "atan2(1)", "sin(1, 2)", "\"a\"", "3 µm"})
      EXPECT_FALSE(contains(fault_of_number(q, text, "1"), "no fault")) << text << fault_of_number(q, text, "1");
    EXPECT_TRUE(contains(fault_of_number(q, "1 000", "1"), "operator is missing before <000>"));
    EXPECT_TRUE(contains(fault_of_number(q, "1/0", "1"), "not a finite number"));
    EXPECT_TRUE(contains(fault_of_number(q, "3 µm", "1"), "<µ>"));
  }



  TEST(Quantity, RefusesBadConstants)
  {
    Quantities q;
    Complaints complaints;
    q.add_constant("L", "3 m", "a.prm:1", complaints);
    ASSERT_TRUE(complaints.empty());
    unsigned int line = 1;
    for (const char *name : {"L", "%", "true", "pi", "sin", "", "2x", "blade mass", "a-b"})
      {
        q.add_constant(name, "3", "a.prm:" + std::to_string(++line), complaints);
        EXPECT_EQ(complaints.all().size(), line - 1) << name;
      }
    q.add_constant("x", "3 + 2 m", "a.prm:77", complaints);
    q.add_constant("y", "3 z", "a.prm:78", complaints);
    EXPECT_EQ(complaints.all().size(), line + 1);
    EXPECT_TRUE(contains(complaints.all()[2], "a.prm:4: constant <true>: there is already a constant of that name"));
    EXPECT_EQ(q.number("L", "m"), 3) << "the first one holds";
    EXPECT_THROW(q.number("2*x", "m"), FollowUp) << "there is a complaint about it already";
  }



  TEST(Quantity, PercentAreOfSomething)
  {
    const auto q = with_constants({{"Omega", "20 rad/s"}, {"turns", "3"}});
    EXPECT_DOUBLE_EQ(q.number("50 %", "1"), 0.5);
    EXPECT_DOUBLE_EQ(q.number("50 %*Omega", "rad/s"), 10);
    EXPECT_DOUBLE_EQ(q.number("50 %*turns", "rad/s"), 1.5) << "a constant without unit has the declared one";
    EXPECT_DOUBLE_EQ(q.number("2 m + 3 m*10 %", "m"), 2.3);
    for (const char *unit : {"rad/s", "m", "N", "rad", "s"})
      for (const char *text : {"100 %", "2*50 %", "(1 + 1)*5 %"})
        try
          {
            q.number(text, unit);
            FAIL() << text << " in " << unit;
          }
        catch (const std::invalid_argument &problem)
          {
            EXPECT_TRUE(contains(problem.what(), "% of what?")) << problem.what();
          }
    EXPECT_THROW(q.expression("100 %*sin(3*t)", "m", {"t"}), std::invalid_argument);
    EXPECT_THROW(q.expression("5 %*t", "rad", {"t"}), std::invalid_argument);
    EXPECT_NO_THROW(q.expression("5 %*Omega*t", "rad", {"t"}));
  }



  TEST(Quantity, SubsystemsHideConstantsAndLeaveThoseAroundAlone)
  {
    Quantities around = with_constants({{"L", "3 m"}, {"n", "2"}});
    Quantities first = around, second = around;
    Complaints complaints;
    for (Quantities *const inner : {&first, &second})
      inner->begin_subsystem();
    first.add_constant("L", "5 m", "a.prm:1", complaints);
    around.add_constant("later", "1", "a.prm:2", complaints);
    EXPECT_DOUBLE_EQ(first.number("n*L", "m"), 10);
    EXPECT_DOUBLE_EQ(second.number("n*L", "m"), 6);
    EXPECT_DOUBLE_EQ(around.number("n*L", "m"), 6);
    EXPECT_THROW(first.number("later", "1"), std::invalid_argument) << "it is defined behind";
    EXPECT_TRUE(complaints.empty());
    first.add_constant("L", "6 m", "a.prm:3", complaints);
    first.add_constant("pi", "3", "a.prm:4", complaints);
    EXPECT_EQ(complaints.all().size(), 2u) << "twice in one subsystem, a universal constant";
  }



  TEST(Quantity, ConstantsMayHaveTheNamesOfUnits)
  {
    const auto q =
      with_constants({{"m", "2 kg"}, {"h", "0.1 m"}, {"N", "4"}, {"e", "0.3 m"}, {"t", "5 s"}, {"P", "3"}});
    EXPECT_DOUBLE_EQ(q.number("P*m", "kg"), 6);
    EXPECT_DOUBLE_EQ(q.number("h/2", "m"), 0.05);
    EXPECT_DOUBLE_EQ(q.number("-m*g0", "N"), -2 * 9.80665);
    EXPECT_DOUBLE_EQ(q.number("2*m", "kg"), 4) << "nothing but a number directly before it makes a unit";
    EXPECT_DOUBLE_EQ(q.number("2 m", "m"), 2);
    EXPECT_DOUBLE_EQ(q.number("3m + h", "m"), 3.1);
    EXPECT_DOUBLE_EQ(q.number("e + 1 m", "m"), 1.3);
    EXPECT_DOUBLE_EQ(q.number("t/2", "s"), 2.5);
    EXPECT_DOUBLE_EQ(q.number("(3 N*m)*P", "N*m"), 9) << "alone in parentheses all are units";
    EXPECT_DOUBLE_EQ(q.number("(3 N)*h", "N*m"), 0.3);
    for (const char *text : {"3 kN/m*h", "3 kN*m", "(1 + 2) N", "P m"})
      try
        {
          q.number(text, "");
          FAIL() << text;
        }
      catch (const std::invalid_argument &problem)
        {
          EXPECT_TRUE(contains(problem.what(), "is a unit and a constant of this model")) << problem.what();
        }
    EXPECT_THROW(q.expression("3 m/s*t", "m", {"t"}), std::invalid_argument) << "t is the time there";
  }



  TEST(Quantity, FunctionsOfTimeHaveNames)
  {
    auto       q = with_constants({{"v", "3 m/s"}});
    Complaints complaints;
    q.add_function("ramp", "t < 0.2 s ? t^2/(0.4 s) : t - 0.1 s", "a.prm:1", complaints);
    q.add_function("way", "v*ramp", "a.prm:2", complaints);
    ASSERT_TRUE(complaints.empty());
    const FunctionOfTime way(q.expression("2*way + 1 m", "m", {"t"}));
    for (const double t : {0.05, 0.15, 0.7})
      {
        const double ramp = t < 0.2 ? t * t / 0.4 : t - 0.1, rate = t < 0.2 ? t / 0.2 : 1, bend = t < 0.2 ? 5 : 0;
        EXPECT_NEAR(way(t), 6 * ramp + 1, 1e-14);
        EXPECT_NEAR(way.derivative(t), 6 * rate, 1e-13);
        EXPECT_NEAR(way.second_derivative(t), 6 * bend, 1e-12);
      }
    EXPECT_THROW(q.expression("way", "N", {"t"}), std::invalid_argument);
    EXPECT_THROW(q.number("way", "m"), std::invalid_argument) << "a number does not change";
    EXPECT_THROW(q.expression("way*s", "m", {"s"}), std::invalid_argument);
  }



  TEST(Quantity, TextsStandInPlaceOfTheirNames)
  {
    const auto q =
      with_constants({{"n", "3"}, {"file", "\"a b.csv\""}, {"kind", "n > 2 ? \"many\" : \"few\""}, {"L", "0.25 km"}});
    EXPECT_EQ(q.with_texts("${file}: x"), "a b.csv: x");
    EXPECT_EQ(q.with_texts("${ kind } of ${kind}"), "many of many");
    EXPECT_EQ(q.with_texts("${L}"), "250") << "numbers are in SI units";
    EXPECT_EQ(q.with_texts("none"), "none");
    EXPECT_THROW(q.with_texts("${knd}"), std::invalid_argument);
    EXPECT_THROW(q.with_texts("${kind"), std::invalid_argument);
  }



  TEST(Quantity, ThereIsAListOfWords)
  {
    const auto words = with_constants({{"span", "6 m"}}).known_words();
    for (const char *word : {"span", "ft", "sin", "pi"})
      EXPECT_EQ(std::count(words.begin(), words.end(), word), 1) << word;
  }
} // namespace
