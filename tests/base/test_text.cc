#include <samara/base/text.h>

#include <gtest/gtest.h>

#include <limits>

using namespace samara;

namespace
{
  using Strings = std::vector<std::string>;

  TEST(Text, Trim)
  {
    EXPECT_EQ(trim(" \t a b\r\n"), "a b");
    EXPECT_EQ(trim(" \n"), "");
  }



  TEST(Text, SplitsOutsideOfParenthesesOnly)
  {
    EXPECT_EQ(split_top_level("atan2(1, (2)), 3 ,x", ','), (Strings{"atan2(1, (2))", "3", "x"}));
    EXPECT_EQ(split_top_level("a;;b;", ';'), (Strings{"a", "", "b", ""}));
    EXPECT_TRUE(split_top_level("  ", ',').empty());
  }



  TEST(Text, EditDistance)
  {
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("same", "same"), 0u);
  }



  TEST(Text, SuggestsTheNearest)
  {
    EXPECT_EQ(did_you_mean("Mas", {"Moment", "Mass", "Name"}), "; did you mean <Mass>?");
    EXPECT_EQ(did_you_mean("mass", {"Mars", "Mass"}), "; did you mean <Mass>?");
  }



  TEST(Text, ListsFewNamesIfNoneIsNear)
  {
    EXPECT_EQ(did_you_mean("Temperature", {"Mass", "Name"}), "; known: Mass, Name.");
    EXPECT_EQ(did_you_mean("x", {"y"}), "; known: y.") << "no letter in common is no suggestion";
    EXPECT_EQ(did_you_mean("Temperature", Strings(13, "Mass")), ".");
    EXPECT_EQ(did_you_mean("Temperature", {}), ".");
  }



  TEST(Text, NumbersSurviveTheWayThroughText)
  {
    for (const double x : {0.1, 1. / 3, -2.5e-300, 6.02214076e23, 0., 4.})
      {
        double y = 99;
        ASSERT_TRUE(text_to_number(number_to_text(x), y)) << number_to_text(x);
        EXPECT_EQ(x, y);
      }
    EXPECT_EQ(number_to_text(0.1), "0.1");
    double largest = 0;
    EXPECT_TRUE(text_to_number(number_to_text(std::numeric_limits<double>::infinity()), largest));
    EXPECT_EQ(largest, std::numeric_limits<double>::max());
  }



  TEST(Text, WhatIsNoPlainNumber)
  {
    double x = 0;
    for (const char *text : {"", "+", "-", "1 m", "0x10", "nan", "inf", "-inf", "1e", "+-1", "--1", "1e999", "1,5"})
      EXPECT_FALSE(text_to_number(text, x)) << text;
    EXPECT_TRUE(text_to_number("+.5", x));
    EXPECT_EQ(x, 0.5);
  }



  TEST(Text, SplitAt)
  {
    std::string name, place;
    ASSERT_TRUE(split_at("look at me at  0.3 ", name, place));
    EXPECT_EQ(name, "look at me");
    EXPECT_EQ(place, "0.3");
    for (const char *text : {"", "at 0.3", " at 0.3", "pin", "pin at", "pin at ", "pinat 3"})
      EXPECT_FALSE(split_at(text, name, place)) << text;
  }
} // namespace
