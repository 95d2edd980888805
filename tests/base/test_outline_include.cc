#include <samara/base/outline.h>

#include <gtest/gtest.h>

#include "temporary_folder.h"

using namespace samara;

namespace
{
  using Strings = std::vector<std::string>;



  TEST(OutlineInclude, IsRelativeToTheIncludingFile)
  {
    const TemporaryFolder folder;
    folder.write("parts/deep/hub.inc", "set Mass = 3\n");
    folder.write("parts/bodies.inc", "subsection hub\n  include deep/hub.inc\nend\n");
    const auto main    = folder.write("main.prm", "subsection Bodies\n  include \"parts/bodies.inc\"\nend\n");
    const auto outline = Outline::of_file(main);
    const auto mass    = outline.section("Bodies")->section("hub")->entry("Mass");
    ASSERT_NE(mass, nullptr);
    EXPECT_EQ(mass->value, "3");
    EXPECT_EQ(mass->where, folder.path("parts/deep/hub.inc") + ":1");
  }



  TEST(OutlineInclude, MayBeOverridden)
  {
    const TemporaryFolder folder;
    folder.write("base.inc", "subsection Time\n  set Step = 1\n  set End = 2\nend\n");
    const auto main =
      folder.write("main.prm", "include base.inc\nsubsection Time\n  set Step = 0.1\n  set Start = 0\nend\n");
    const auto outline = Outline::of_file(main);
    ASSERT_EQ(outline.sections.size(), 1u);
    const auto &time = outline.sections[0];
    EXPECT_EQ(time.value("Step"), "0.1");
    EXPECT_EQ(time.entry("Step")->where, main + ":3");
    EXPECT_EQ(time.value("End"), "2");
    EXPECT_EQ(time.value("Start"), "0");
  }



  TEST(OutlineInclude, LaterFilesOverrideEarlierOnes)
  {
    const TemporaryFolder folder;
    folder.write("one.inc", "set Step = 1\n");
    folder.write("two.inc", "set Step = 2\n");
    const auto main = folder.write("main.prm", "include one.inc\ninclude two.inc\n");
    EXPECT_EQ(Outline::of_file(main).value("Step"), "2");
  }



  TEST(OutlineInclude, MustNotOverrideWhoIncludesIt)
  {
    const TemporaryFolder folder;
    folder.write("base.inc", "set Step = 1\n");
    const auto main = folder.write("main.prm", "set Step = 2\ninclude base.inc\n");
    Complaints complaints;
    Outline::of_file(main, complaints);
    EXPECT_EQ(complaints.all(), Strings{folder.path("base.inc") + ":1: <Step> was already set at " + main + ":1."});
  }



  TEST(OutlineInclude, TwiceInOneFileIsADuplicateAlsoAfterAnInclude)
  {
    const TemporaryFolder folder;
    folder.write("base.inc", "subsection Time\nend\n");
    const auto main = folder.write("main.prm", "include base.inc\nsubsection Time\nend\nsubsection Time\nend\n");
    Complaints complaints;
    Outline::of_file(main, complaints);
    EXPECT_EQ(complaints.all(), Strings{main + ":4: subsection <Time> was already opened at " + main + ":2."});
  }



  TEST(OutlineInclude, CyclesEnd)
  {
    const TemporaryFolder folder;
    const auto            a = folder.write("a.prm", "include sub/b.prm\n");
    const auto            b = folder.write("sub/b.prm", "set x = 1\ninclude ../a.prm\n");
    Complaints            complaints;
    const auto            outline = Outline::of_file(a, complaints);
    EXPECT_EQ(complaints.all(), Strings{b + ":2: <" + a + "> includes itself: " + a + " -> " + b + " -> " + a + "."});
    EXPECT_EQ(outline.value("x"), "1");
  }



  TEST(OutlineInclude, FilesKeepTheirEndsToThemselves)
  {
    const TemporaryFolder folder;
    const auto            open  = folder.write("open.inc", "subsection hub\n");
    const auto            close = folder.write("close.inc", "end\n");
    const auto main = folder.write("main.prm", "include open.inc\nsubsection a\ninclude close.inc\nset x = 1\nend\n");
    Complaints complaints;
    const auto outline = Outline::of_file(main, complaints);
    EXPECT_EQ(complaints.all(),
              (Strings{open + ":1: subsection <hub> has no 'end'.",
                       close + ":1: this 'end' closes no subsection of this file."}));
    EXPECT_EQ(outline.section("a")->value("x"), "1");
  }



  TEST(OutlineInclude, MissingFile)
  {
    const TemporaryFolder folder;
    const auto            main = folder.write("main.prm", "include none.inc\ninclude .\nset x = 1\n");
    Complaints            complaints;
    const auto            outline = Outline::of_file(main, complaints);
    ASSERT_EQ(complaints.all().size(), 2u);
    EXPECT_EQ(complaints.all()[0], main + ":1: cannot open the file <" + folder.path("none.inc") + ">.");
    EXPECT_EQ(outline.value("x"), "1");
  }
} // namespace
