// Loops that cannot close: which, by how much, and what would mend it.

#include <gtest/gtest.h>

#include <regex>

#include "drawings.h"

using namespace samara;
using namespace drawings;

namespace
{
  /** "length of <coupler> from <B> to <C> 1.5 m, 0.5 m longer than drawn": the first number behind the words, 0 if they
   * are not there. */
  double
  wanted_length(const std::string &text, const std::string &what)
  {
    std::smatch found;
    return std::regex_search(text, found, std::regex(what + "[^\n]*> ([0-9.e+-]+) m, ")) ? std::stod(found[1]) : 0.;
  }
} // namespace



// The bars together are shorter than the ground: stretched they miss 0.15 m, wherever one puts it.
TEST(Refusals, BarsThatAreTooShort)
{
  Bars bars;
  bars.coupler              = 0.2;
  bars.rocker               = 0.3;
  const std::string message = complaint_of(four_bar(bars, 0.5, ""));
  EXPECT_NE(message.find(".prm:"), std::string::npos) << message;
  EXPECT_NE(message.find("gaps of"), std::string::npos) << message;
  for (const std::string name : {"<ground> - A - <crank> - B - <coupler> - C - <rocker> - D - <ground>"})
    EXPECT_NE(message.find(name), std::string::npos) << message;
  // 1.15 − 0.5 − 0.2 − 0.3
  EXPECT_NEAR(wanted_length(message, "length of <crank"), 0.65, 2e-3) << message;
  EXPECT_NEAR(wanted_length(message, "length of <coupler"), 0.35, 2e-3) << message;
  EXPECT_NEAR(wanted_length(message, "length of <rocker"), 0.45, 2e-3) << message;
}



// With the length that the message wants the loop closes, with one a little less it does not.
TEST(Refusals, TheLengthThatMendsIt)
{
  Bars bars;
  bars.rocker  = 0.3;
  bars.coupler = 0.3495;
  EXPECT_NE(complaint_of(four_bar(bars, 0.5, "")), "");
  bars.coupler = 0.3505;
  EXPECT_EQ(complaint_of(four_bar(bars, 0.5, "")), "");
}



// A hinge whose axis is tilted out of the plane of a loop of hinges has no length that mends it.
TEST(Refusals, AxesThatDoNotFit)
{
  std::string model = four_bar(Bars(), 0.5, "set Fixed bodies = crank");
  model.insert(model.find(" set Body A = coupler.end"), " set Axis = 0.3, 0, 1\n set Axis on B = 0, 0, 1\n");
  const std::string message = complaint_of(model);
  EXPECT_NE(message.find("cannot be assembled"), std::string::npos) << message;
  EXPECT_NE(message.find("joint "), std::string::npos) << message;
}



TEST(Refusals, FixedBodiesThatAreApart)
{
  const std::string message = complaint_of(four_bar(Bars(), 0.5, "set Fixed bodies = crank, coupler"));
  EXPECT_NE(message.find("<crank> - B - <coupler>"), std::string::npos) << message;
}



// Without the word nothing has changed: gaps are refused, and the message knows the way out.
TEST(Refusals, GapsAreRefusedAsBefore)
{
  std::string       model   = four_bar(Bars(), 0.5, "set Gaps = refused");
  const std::string message = complaint_of(model);
  EXPECT_NE(message.find("joint <B>: the points it connects are 0.07"), std::string::npos) << message;
  EXPECT_NE(message.find("Gap = closed"), std::string::npos) << message;
}



TEST(Refusals, WrongWords)
{
  const auto said = [](const std::string &assembly) { return complaint_of(four_bar(Bars(), 0.5, assembly)); };
  EXPECT_NE(said("set Fixed bodies = crnak").find("there is no body <crnak>; did you mean <crank>"), std::string::npos)
    << said("set Fixed bodies = crnak");
  for (const std::string weights :
       {"rocker: -1", "rocker", "rocker: 1e400", "rocker: nan", "rocker: 0", "rocker: 1 kg"})
    EXPECT_NE(said("set Weights = " + weights).find("is not a name and a weight above zero"), std::string::npos)
      << weights;
}
