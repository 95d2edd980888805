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



  TEST(Text, KnowsWhatOtherProgramsCallIt)
  {
    EXPECT_EQ(did_you_mean("pin", {"spherical", "revolute"}), "; did you mean <revolute>?");
    EXPECT_EQ(did_you_mean("Pin Joint", {"spherical", "revolute"}), "; did you mean <revolute>?");
    EXPECT_EQ(did_you_mean("rod", {"rigid body", "beam"}), "; did you mean <beam>?");
    EXPECT_EQ(did_you_mean("rod", {"revolute", "distance"}), "; did you mean <distance>?");
    EXPECT_EQ(did_you_mean("pin", {"x"}), "; known: x.") << "who is not there is not suggested";
  }



  TEST(Text, LongWordsAreNoMistypedOnes)
  {
    EXPECT_EQ(did_you_mean(std::string(1'000'000, 'a'), {std::string(999'999, 'a')}),
              "; known: " + std::string(999'999, 'a') + ".");
  }



  TEST(Text, WhatIsNotPrintableIsEscaped)
  {
    EXPECT_EQ(readable("a\x1b[31m\x7f\tb"), "a\\x1b[31m\\x7f b");
    EXPECT_EQ(readable("two\nlines"), "two\nlines");
    EXPECT_EQ(readable("Träger 5 µm €"), "Träger 5 µm €");
    EXPECT_EQ(readable("Tr\xe4ger"), "Tr\\xe4ger") << "Latin-1 is not UTF-8";
    EXPECT_EQ(readable("\xc2\x9b"), "\\xc2\\x9b") << "a control character of two bytes";
    EXPECT_EQ(readable(std::string(1, '\0')), "\\x00");
    EXPECT_EQ(readable("\xe2\x82"), "\\xe2\\x82") << "cut in its middle";
  }



  TEST(Text, LongLinesAreCutInTheirMiddle)
  {
    const std::string exactly(400, 'x');
    EXPECT_EQ(readable(exactly), exactly);
    for (const std::size_t size : {401, 5000, 1'000'000})
      {
        const std::string text = readable("begin" + std::string(size, 'x') + "end\n" + exactly);
        EXPECT_EQ(text.size(), 240 + 5 + 140 + 1 + 400u);
        EXPECT_EQ(text.substr(0, 6), "beginx");
        EXPECT_EQ(text.substr(240, 5), " ... ");
        EXPECT_EQ(text.substr(240 + 5 + 136, 5), "xend\n");
      }
    std::string euros;
    for (unsigned int i = 0; i < 5000; ++i)
      euros += "€";
    EXPECT_EQ(readable(euros).size(), 3 * (240 + 140) + 5u) << "no letter of several bytes is cut";
  }



  TEST(Text, FilesAreRelativeToThoseThatNameThem)
  {
    EXPECT_EQ(file_beside("models/rotor.prm:12", "blade.csv"), "models/blade.csv");
    EXPECT_EQ(file_beside("models/rotor.prm:12", "../blade.csv"), "blade.csv");
    EXPECT_EQ(file_beside("models/rotor.prm:12", "/data/blade.csv"), "/data/blade.csv");
    EXPECT_EQ(file_beside("rotor.prm:12", "blade.csv"), "blade.csv");
    EXPECT_EQ(file_beside("--set", "blade.csv"), "blade.csv");
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



  TEST(Text, QuotesStandAroundWordsAndMarksWithinAreLetters)
  {
    using Pieces = std::vector<std::string>;
    EXPECT_EQ(split_top_level("table(\"a,b.csv\", x), y", ','), (Pieces{"table(\"a,b.csv\", x)", "y"}));
    EXPECT_EQ(split_top_level("\"a,b.csv\", y", ','), (Pieces{"\"a,b.csv\"", "y"}));
    EXPECT_EQ(split_top_level("a\"b.end, c\"d.start", ','), (Pieces{"a\"b.end", "c\"d.start"}));
    EXPECT_EQ(split_top_level("3\" pipe.end, 4\" pipe.end", ','), (Pieces{"3\" pipe.end", "4\" pipe.end"}));
    EXPECT_EQ(split_top_level("\"a.x, \"b.x", ','), (Pieces{"\"a.x", "\"b.x"}));
  }
} // namespace
