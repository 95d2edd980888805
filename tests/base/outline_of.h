#ifndef samara_tests_base_outline_of_h
#define samara_tests_base_outline_of_h

#include <samara/base/outline.h>

#include <gtest/gtest.h>

namespace samara
{
  /** The outline of a file <a.prm> with this text, about which there are exactly these complaints. */
  inline Outline
  outline_of(const std::string &text, const std::vector<std::string> &expected_complaints = {})
  {
    Complaints complaints;
    auto       outline = Outline::of_text(text, "a.prm", complaints);
    EXPECT_EQ(complaints.all(), expected_complaints);
    return outline;
  }
} // namespace samara

#endif
