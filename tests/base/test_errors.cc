#include <samara/base/errors.h>
#include <samara/base/log.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace samara;

namespace
{
  TEST(Complaints, AllComeAtOnceInTheOrderOfAdding)
  {
    Complaints complaints;
    EXPECT_TRUE(complaints.empty());
    EXPECT_NO_THROW(complaints.throw_if_any());

    complaints.add("b.prm:2", "second line");
    complaints.add("a.prm:1", "first line");
    complaints.add("", "no place");
    EXPECT_FALSE(complaints.empty());
    try
      {
        complaints.throw_if_any();
        FAIL() << "nothing was thrown";
      }
    catch (const InputError &e)
      {
        EXPECT_STREQ(e.what(), "b.prm:2: second line\na.prm:1: first line\nno place");
        EXPECT_EQ(e.complaints.size(), 3u);
      }
  }



  TEST(Complaints, TheSameCountsOnce)
  {
    Complaints complaints;
    complaints.add("a.prm:1", "wrong");
    complaints.add("a.prm:1", "wrong");
    complaints.add("a.prm:2", "wrong");
    EXPECT_EQ(complaints.all().size(), 2u);
  }



  TEST(Complaints, WhatIsKnownCountsAgainForTheSecondObject)
  {
    Complaints complaints;
    complaints.add("a.prm:1", "there is no material <steal>");
    const auto before = complaints.count();
    complaints.add("a.prm:1", "there is no material <steal>"); // of a copy
    EXPECT_GT(complaints.count(), before) << "the copy would be taken for sound";
    EXPECT_EQ(complaints.all().size(), 1u) << "and it is said once";
  }



  TEST(Complaints, DoubtsRefuseNothing)
  {
    Complaints complaints;
    complaints.doubt("a.prm:1", "degrees?");
    complaints.doubt("a.prm:1", "degrees?");
    EXPECT_EQ(complaints.doubts(), std::vector<std::string>{"a.prm:1: degrees?"});
    EXPECT_EQ(complaints.count(), 0u);
    EXPECT_NO_THROW(complaints.throw_if_any());
  }



  TEST(Complaints, StandInTheOrderOfTheFile)
  {
    Complaints complaints;
    complaints.add("b.prm:10", "ten");
    complaints.add("a.prm:3", "three");
    complaints.add("b.prm:9", "nine");
    complaints.add("b.prm:10", "ten again: see a.prm:2: there");
    EXPECT_EQ(complaints.all(),
              (std::vector<std::string>{"b.prm:9: nine",
                                        "b.prm:10: ten",
                                        "b.prm:10: ten again: see a.prm:2: there",
                                        "a.prm:3: three"}));
  }



  TEST(Complaints, FollowUpsCountAndHaveNoWords)
  {
    Complaints complaints;
    complaints.add("a.prm:1", FollowUp().what());
    EXPECT_EQ(complaints.count(), 1u);
    EXPECT_TRUE(complaints.empty());
    EXPECT_NO_THROW(complaints.throw_if_any());
  }



  TEST(Complaints, OfVeryManyTheFirstOnesAreShown)
  {
    Complaints complaints;
    for (unsigned int i = 1; i <= 5000; ++i)
      complaints.add("a.prm:" + std::to_string(i), "wrong");
    try
      {
        complaints.throw_if_any();
        FAIL() << "nothing was thrown";
      }
    catch (const InputError &e)
      {
        ASSERT_EQ(e.complaints.size(), 1001u);
        EXPECT_EQ(e.complaints[999], "a.prm:1000: wrong");
        EXPECT_EQ(e.complaints[1000], "... and 4000 more mistakes.");
      }
  }



  TEST(InputError, GetsThePlaceThatItDoesNotHave)
  {
    EXPECT_EQ(with_place({"a.prm:1: wrong", "wrong: 3"}, "b.prm:7"),
              (std::vector<std::string>{"a.prm:1: wrong", "b.prm:7: wrong: 3"}));
  }



  TEST(InputError, OfOneLine)
  {
    const InputError error("a.prm:1: wrong");
    EXPECT_STREQ(error.what(), "a.prm:1: wrong");
    EXPECT_EQ(error.complaints, std::vector<std::string>{"a.prm:1: wrong"});
  }



  TEST(NotConverged, IsNoInputError)
  {
    const NotConverged error("at t = 1 s");
    EXPECT_EQ(dynamic_cast<const InputError *>(static_cast<const std::exception *>(&error)), nullptr);
    EXPECT_STREQ(error.what(), "at t = 1 s");
  }



  TEST(Log, QuietPrintsWarningsOnly)
  {
    std::ostringstream loud_text, quiet_text;
    Log                loud(loud_text), quiet(quiet_text, true);
    for (Log *log : {&loud, &quiet})
      {
        log->line("step 1");
        log->warning("a.prm:3", "large");
        EXPECT_EQ(log->n_warnings(), 1u);
      }
    EXPECT_EQ(loud_text.str(), "step 1\na.prm:3: warning: large\n");
    EXPECT_EQ(quiet_text.str(), "a.prm:3: warning: large\n");
  }
} // namespace
