#include <gtest/gtest.h>

#include "outline_of.h"

using namespace samara;

namespace
{
  using Strings = std::vector<std::string>;

  Strings
  complaints_about(const std::string &text)
  {
    Complaints complaints;
    Outline::of_text(text, "a.prm", complaints);
    return complaints.all();
  }



  TEST(Outline, KeepsNamesValuesPlacesAndOrder)
  {
    const auto outline = outline_of("set Title = A = b\n"
                                    "\n"
                                    "subsection Bodies   # all of them\n"
                                    "  subsection shaft 1\n"
                                    "    set Degree=3\n"
                                    "    set Empty =\n"
                                    "  end\n"
                                    "  subsection hub\n"
                                    "  end\n"
                                    "end\n");
    EXPECT_EQ(outline.where, "a.prm:1");
    EXPECT_EQ(outline.value("Title"), "A = b");
    ASSERT_NE(outline.section("Bodies"), nullptr);
    const auto &bodies = *outline.section("Bodies");
    EXPECT_EQ(bodies.where, "a.prm:3");
    EXPECT_EQ(bodies.section_names(), (Strings{"shaft 1", "hub"}));
    const auto &shaft = *bodies.section("shaft 1");
    EXPECT_EQ(shaft.where, "a.prm:4");
    ASSERT_NE(shaft.entry("Degree"), nullptr);
    EXPECT_EQ(shaft.entry("Degree")->value, "3");
    EXPECT_EQ(shaft.entry("Degree")->where, "a.prm:5");
    EXPECT_EQ(shaft.value("Empty", "nothing"), "");
    EXPECT_EQ(shaft.value("Other", "nothing"), "nothing");
    EXPECT_EQ(shaft.entry("Other"), nullptr);
    EXPECT_EQ(bodies.section("rotor"), nullptr);
  }



  TEST(Outline, ContinuesLines)
  {
    const auto outline = outline_of("set Points = 0, 0, 0; \\   # the root\r\n"
                                    "             6, 0, 0\n"
                                    "# a comment does not continue \\\n"
                                    "set Degree = 3\n");
    EXPECT_EQ(outline.value("Points"), "0, 0, 0; 6, 0, 0");
    EXPECT_EQ(outline.entry("Degree")->where, "a.prm:4");
  }



  TEST(Outline, AllComplaintsAtOnce)
  {
    EXPECT_EQ(complaints_about("set Mass 3\n"
                               "set Brace = {1|2}\n"
                               "hello world\n"
                               "end\n"
                               "set Twice = 1\n"
                               "set Twice = 2\n"
                               "subsection hub\n"
                               "end\n"
                               "subsection hub\n"
                               "end\n"
                               "subsection\n"
                               "end\n"
                               "set = 3\n"
                               "include\n"
                               "subsection open\n"
                               "  subsection deep\n"),
              (Strings{"a.prm:1: this 'set' has no '='.",
                       "a.prm:2: <Brace>: a value must not contain '{', except in <${name}>.",
                       "a.prm:3: expected 'set', 'subsection', 'end' or 'include', found <hello world>.",
                       "a.prm:4: this 'end' closes no subsection of this file.",
                       "a.prm:6: <Twice> was already set at a.prm:5.",
                       "a.prm:9: subsection <hub> was already opened at a.prm:7.",
                       "a.prm:11: this subsection has no name.",
                       "a.prm:13: this 'set' has no name before the '='.",
                       "a.prm:14: this 'include' names no file.",
                       "a.prm:15: subsection <open> has no 'end'.",
                       "a.prm:16: subsection <deep> has no 'end'."}));
  }



  TEST(Outline, TheSameNameInDifferentSectionsIsNoDuplicate)
  {
    outline_of("subsection a\n set x = 1\n subsection c\n end\nend\n"
               "subsection b\n set x = 1\n subsection c\n end\nend\n");
  }



  TEST(Outline, ThrowsIfThereIsNobodyToCollect)
  {
    EXPECT_THROW(Outline::of_file("/no/such/file.prm"), InputError);
    EXPECT_THROW(Outline::of_file("/"), InputError);
  }
} // namespace
