#include <gtest/gtest.h>

#include "outline_of.h"

using namespace samara;

namespace
{
  using Strings = std::vector<std::string>;

  const char *const shafts = "subsection Bodies\n"
                             "  subsection shaft 1\n"
                             "    set Type = beam\n"
                             "    set Degree = 3\n"
                             "    subsection Mesh\n"
                             "      set Elements = 4\n"
                             "      subsection Grading\n"
                             "        set Ratio = 2\n"
                             "      end\n"
                             "    end\n"
                             "  end\n"
                             "  subsection shaft 2\n"
                             "    set Copy of = shaft 1\n"
                             "    set Degree = 2\n"
                             "    subsection Mesh\n"
                             "      set Shape = fine\n"
                             "    end\n"
                             "  end\n"
                             "end\n";

  const Outline &
  body(const Outline &outline, const std::string &name)
  {
    return *outline.section("Bodies")->section(name);
  }



  TEST(CopyOf, CopiesRecursivelyAndIsOverridden)
  {
    const auto  outline = outline_of(shafts);
    const auto &copy    = body(outline, "shaft 2");
    EXPECT_EQ(copy.value("Type"), "beam");
    EXPECT_EQ(copy.entry("Type")->where, "a.prm:3");
    EXPECT_EQ(copy.value("Degree"), "2");
    EXPECT_EQ(copy.section("Mesh")->value("Elements"), "4");
    EXPECT_EQ(copy.section("Mesh")->value("Shape"), "fine");
    EXPECT_EQ(copy.section("Mesh")->section("Grading")->value("Ratio"), "2");
    EXPECT_EQ(body(outline, "shaft 1").value("Degree"), "3") << "the original stays";
    EXPECT_EQ(body(outline, "shaft 1").section("Mesh")->entry("Shape"), nullptr);
  }



  TEST(CopyOf, Chains)
  {
    const auto  outline = outline_of("subsection Bodies\n"
                                     "subsection c\n set Copy of = b\n set z = 1\nend\n"
                                     "subsection b\n set Copy of = a\n set y = 1\nend\n"
                                     "subsection a\n set x = 1\n set y = 2\n set z = 2\nend\n"
                                     "end\n");
    const auto &c       = body(outline, "c");
    EXPECT_EQ(c.value("x"), "1");
    EXPECT_EQ(c.value("y"), "1");
    EXPECT_EQ(c.value("z"), "1");
    EXPECT_EQ(c.value("Copy of"), "b");
  }



  TEST(CopyOf, CopiesInsideOfCopiesSeeWhatIsOverridden)
  {
    const auto outline = outline_of("subsection Bodies\n"
                                    "subsection a\n"
                                    "  subsection left\n   set x = 1\n   set y = 1\n  end\n"
                                    "  subsection right\n   set Copy of = left\n  end\n"
                                    "end\n"
                                    "subsection b\n"
                                    "  set Copy of = a\n"
                                    "  subsection left\n   set x = 2\n  end\n"
                                    "end\n"
                                    "end\n");
    EXPECT_EQ(body(outline, "a").section("right")->value("x"), "1");
    EXPECT_EQ(body(outline, "b").section("right")->value("x"), "2");
    EXPECT_EQ(body(outline, "b").section("right")->value("y"), "1");
  }



  TEST(CopyOf, UnknownSibling)
  {
    outline_of("subsection Bodies\n"
               "subsection shaft 1\nend\n"
               "subsection shaft 2\n set Copy of = shaft1\nend\n"
               "end\n",
               {"a.prm:5: <shaft 2>: there is no <shaft1> beside it to copy; did you mean <shaft 1>?"});
  }



  TEST(CopyOf, Cycles)
  {
    outline_of("subsection a\n set Copy of = a\nend\n", {"a.prm:2: <a> is, in the end, a copy of itself."});
    Complaints complaints;
    Outline::of_text("subsection a\n set Copy of = b\nend\n"
                     "subsection b\n set Copy of = c\nend\n"
                     "subsection c\n set Copy of = a\nend\n",
                     "a.prm",
                     complaints);
    EXPECT_EQ(complaints.all(), Strings{"a.prm:2: <a> is, in the end, a copy of itself."});
  }



  TEST(Set, ReplacesAndCreatesEntries)
  {
    auto       outline = outline_of(shafts);
    Complaints complaints;
    outline.set("Bodies/shaft 1/Degree = 4", complaints);
    outline.set(" Bodies / shaft 1 / Formula = a = b ", complaints);
    outline.set("Title=x", complaints);
    EXPECT_TRUE(complaints.empty());
    EXPECT_EQ(body(outline, "shaft 1").value("Degree"), "4");
    EXPECT_EQ(body(outline, "shaft 1").entry("Degree")->where, "--set");
    EXPECT_EQ(body(outline, "shaft 1").value("Formula"), "a = b");
    EXPECT_EQ(outline.value("Title"), "x");
  }



  TEST(Set, CopiesFollow)
  {
    auto       outline = outline_of(shafts);
    Complaints complaints;
    outline.set("Bodies/shaft 1/Type = cable", complaints);
    outline.set("Bodies/shaft 1/Degree = 5", complaints);
    outline.set("Bodies/shaft 1/Mesh/Elements = 8", complaints);
    outline.set("Bodies/shaft 2/Mesh/Grading/Ratio = 7", complaints);
    EXPECT_TRUE(complaints.empty());
    const auto &copy = body(outline, "shaft 2");
    EXPECT_EQ(copy.value("Type"), "cable");
    EXPECT_EQ(copy.value("Degree"), "2") << "what it says itself";
    EXPECT_EQ(copy.section("Mesh")->value("Elements"), "8");
    EXPECT_EQ(copy.section("Mesh")->section("Grading")->value("Ratio"), "7");
    EXPECT_EQ(body(outline, "shaft 1").section("Mesh")->section("Grading")->value("Ratio"), "2");
  }



  TEST(Set, MayChangeWhatIsCopied)
  {
    auto       outline = outline_of(shafts);
    Complaints complaints;
    outline.set("Bodies/shaft 2/Copy of = shaft 3", complaints);
    EXPECT_EQ(complaints.all(),
              Strings{"--set: <shaft 2>: there is no <shaft 3> beside it to copy; did you mean <shaft 1>?"});
    EXPECT_EQ(body(outline, "shaft 2").entry("Type"), nullptr);
  }



  TEST(Set, Refuses)
  {
    auto       outline = outline_of(shafts);
    Complaints complaints;
    outline.set("Bodies/shaft 1/Degree", complaints);
    outline.set("Bodys/shaft 1/Degree = 4", complaints);
    outline.set("Bodies/shaft 9/Degree = 4", complaints);
    outline.set("Bodies/shaft 1/ = 4", complaints);
    outline.set("Bodies/shaft 1/Degree = {4", complaints);
    EXPECT_EQ(complaints.all(),
              (Strings{"--set: <Bodies/shaft 1/Degree> has no '='; write \"Section/name/Entry = value\".",
                       "--set: <Bodys/shaft 1/Degree>: there is no subsection <Bodys>; did you mean <Bodies>?",
                       "--set: <Bodies/shaft 9/Degree>: there is no subsection <shaft 9>; did you mean <shaft 1>?",
                       "--set: <Bodies/shaft 1/ = 4> does not name an entry.",
                       "--set: <Bodies/shaft 1/Degree>: a value must not contain '{', except in <${name}>."}));
    EXPECT_EQ(body(outline, "shaft 1").value("Degree"), "3");
  }
} // namespace
