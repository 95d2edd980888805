#include <samara/base/quantity.h>

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Case
  {
    const char *text;
    const char *unit;
    double      si;
  };

  /** Values from NIST SP 811 and the definitions of the units. */
  const Case cases[] = {{"1 m", "m", 1},
                        {"1 mm", "m", 1e-3},
                        {"1 cm", "m", 1e-2},
                        {"1 km", "m", 1e3},
                        {"1 in", "m", 0.0254},
                        {"1 ft", "m", 0.3048},
                        {"1 kg", "kg", 1},
                        {"1 g", "kg", 1e-3},
                        {"1 t", "kg", 1e3},
                        {"1 lb", "kg", 0.45359237},
                        {"1 slug", "kg", 14.59390294},
                        {"1 s", "s", 1},
                        {"1 ms", "s", 1e-3},
                        {"1 min", "s", 60},
                        {"1 h", "s", 3600},
                        {"1 K", "K", 1},
                        {"1 N", "N", 1},
                        {"1 kN", "N", 1e3},
                        {"1 MN", "N", 1e6},
                        {"1 lbf", "N", 4.4482216152605},
                        {"1 Pa", "Pa", 1},
                        {"1 kPa", "Pa", 1e3},
                        {"1 MPa", "Pa", 1e6},
                        {"1 GPa", "N/m^2", 1e9},
                        {"1 psi", "Pa", 6894.757293168},
                        {"1 ksi", "Pa", 6894757.293168},
                        {"1 J", "N*m", 1},
                        {"1 kJ", "J", 1e3},
                        {"1 W", "J/s", 1},
                        {"1 kW", "W", 1e3},
                        {"1 hp", "W", 745.69987158},
                        {"1 Hz", "1/s", 1},
                        {"1 rad", "rad", 1},
                        {"45 deg", "rad", 0.785398163397448},
                        {"1 rev", "rad", 6.283185307179586},
                        {"750 rpm", "rad/s", 78.53981633974483},
                        {"1 kn", "m/s", 0.514444444444},
                        {"1 knot", "m/s", 0.514444444444},
                        {"30 %", "1", 0.3}};

  TEST(Units, ConvertToSI)
  {
    const Quantities quantities;
    for (const auto &c : cases)
      EXPECT_NEAR(quantities.number(c.text, c.unit), c.si, 1e-9 * c.si) << c.text;
  }



  TEST(Units, EveryUnitIsTested)
  {
    for (const auto &unit : units())
      {
        bool is_tested = false;
        for (const auto &c : cases)
          {
            const std::string text = c.text;
            is_tested              = is_tested || text.substr(text.find(' ') + 1) == unit.name;
          }
        EXPECT_TRUE(is_tested) << unit.name;
      }
  }



  TEST(Units, UniversalConstants)
  {
    const Quantities quantities;
    EXPECT_DOUBLE_EQ(quantities.number("pi", "rad"), 3.141592653589793);
    EXPECT_DOUBLE_EQ(quantities.number("ln(e)", "1"), 1);
    EXPECT_DOUBLE_EQ(quantities.number("2 g0", "m/s^2"), 19.6133);
  }



  TEST(Units, WhatIsDeclaredMustBeSI)
  {
    for (const char *unit : {"m", "N*m^2", "N m", "kg/m", "rad", "rad/s", "1", "1/s", "N*m*s/rad", "Hz", "K"})
      EXPECT_TRUE(Quantities::is_si_unit(unit)) << unit;
    for (const char *unit : {"", "ft", "deg", "mm", "%", "2 m", "metre", "m, s", "m +", "rpm", "0, 1"})
      EXPECT_FALSE(Quantities::is_si_unit(unit)) << unit;
  }



  TEST(Units, AreDescribedInWords)
  {
    EXPECT_EQ(describe({{1, 1, -2, 0, 0}}), "a force [N]");
    EXPECT_EQ(describe({{0, 0, 0, 0, 0}}), "a number");
    EXPECT_EQ(describe({{0, 0, -1, 1, 0}}), "an angular speed [rad/s]");
    EXPECT_EQ(describe({{5, 0, -0.5, 0, 0}}), "[m^5*s^-0.5]");
  }
} // namespace
