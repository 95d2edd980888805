// Steps that do not resolve a state of first order say so, for what they compute there is wrong with every sign of
// success.

#include <samara/analysis/dynamic.h>
#include <samara/base/errors.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "scenes.h"

using namespace samara;

namespace
{
  /** The report of 100 steps of 0.01 s with a state ż = @p rate. */
  DynamicAnalysis::Report
  report_of(const std::string &rate, const std::string &member, const std::string &force = "-50*slide.displacement")
  {
    Scene scene("set Analyses = dynamic\n" +
                on_a_slide("subsection x\n set Rate = " + rate + "\n set Initial = 1\nend\n", "set Force = " + force) +
                "subsection Dynamic\n set End time = 1\n set Step = 0.01\n" + member + "end\n");
    auto &dynamics = scene.analysis<DynamicAnalysis>();
    dynamics.start(scene.context);
    dynamics.run(scene.context);
    EXPECT_EQ(dynamics.report.n_unresolved > 3, scene.stream.str().find("are not resolved in") != std::string::npos);
    return dynamics.report;
  }

  const std::string two   = " set Stages = 2\n set Spectral radius = 0.5\n",
                    gauss = " set Stages = 3\n set Spectral radius = 1\n",
                    one   = " set Stages = 1\n set Spectral radius = 1\n";
} // namespace



// e^(10) a step: no integrator follows
TEST(Resolution, GrowthWithinAStep)
{
  for (const auto &member : {one, two, gauss})
    {
      const auto report = report_of("1e3*x", member);
      EXPECT_GT(report.n_unresolved, 90u) << member;
      EXPECT_EQ(report.unresolved_state, "x");
      EXPECT_EQ(report.first_unresolved, 0.);
    }
}



// the Gauss members keep |x| = 1 where hλ = −1e4; those with dissipation are at rest after a few steps
TEST(Resolution, DecayWithinAStep)
{
  EXPECT_GT(report_of("-1e6*x", gauss).n_unresolved, 90u);
  EXPECT_LT(report_of("-1e6*(x - slide.displacement)", two).n_unresolved, 4u);
}



TEST(Resolution, OscillationWithinAStep)
{
  for (const auto &member : {one, two, gauss})
    EXPECT_GT(report_of("800*cos(800*t)", member).n_unresolved, 50u) << member;
}



TEST(Resolution, WhatIsResolvedIsNotTold)
{
  for (const auto &member : {one, two, gauss})
    for (const std::string rate : {"-20*x", "3*x", "-20*(x - slide.displacement)", "cos(20*t)", "0"})
      EXPECT_EQ(report_of(rate, member).n_unresolved, 0u) << rate << member;
}



// A state with a weight decides on adaptive steps: the error of a filter at the end of the run is in proportion to the
// tolerance over the weight, against the closed form. Without a weight it does not, which is told; controls never do,
// which is no news.
TEST(Resolution, StatesWithAWeightDecideOnSteps)
{
  const double a = 30, w = 40, T = 0.5;
  const double exact = std::exp(-a * T) * (1 + a * w / (a * a + w * w)) +
                       (a * a * std::sin(w * T) - a * w * std::cos(w * T)) / (a * a + w * w);
  struct Outcome
  {
    double       error;
    unsigned int n_steps;
    bool         warns;
  };
  const auto outcome = [&](const std::string &weight, const std::string &tolerance, const std::string &member) {
    Scene scene(
      "set Analyses = dynamic\n" +
      on_a_slide("subsection x\n set Rate = 30*(sin(40*t) - x)\n set Initial = 1\n set Scale = 1e-3\n" + weight +
                   "end\nsubsection lever\n set Type = control\n set Value = 1\nend\n",
                 "set Force = 0*x") +
      "subsection Dynamic\n set End time = 0.5\n set Step = 0.01\n set Step control = adaptive\n set Tolerance = " +
      tolerance + "\n" + member + "end\n");
    auto &dynamics = scene.analysis<DynamicAnalysis>();
    dynamics.start(scene.context);
    dynamics.run(scene.context);
    return Outcome{std::abs(scene.value("x") - exact),
                   dynamics.report.n_steps,
                   scene.stream.str().find("the state <x> does not count") != std::string::npos};
  };
  for (const auto &member : {two, gauss, std::string(" set Stages = 3\n set Spectral radius = 0\n")})
    {
      unsigned int n_before = 0;
      double       finest   = 0;
      for (const std::string tolerance : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6"})
        {
          SCOPED_TRACE(member + tolerance);
          const Outcome weighted = outcome(" set Weight = 1\n", tolerance, member);
          EXPECT_LT(weighted.error, std::stod(tolerance));
          EXPECT_GE(weighted.n_steps, n_before);
          EXPECT_FALSE(weighted.warns);
          n_before = weighted.n_steps;
          finest   = weighted.error;
        }
      const Outcome without = outcome("", "1e-5", member), more = outcome(" set Weight = 10\n", "1e-4", member),
                    one = outcome(" set Weight = 1\n", "1e-5", member);
      EXPECT_TRUE(without.warns);
      EXPECT_GT(without.error, 3 * finest);
      EXPECT_LT(without.n_steps, n_before / 2);
      EXPECT_EQ(more.n_steps, one.n_steps); // ten times the weight is a tenth of the tolerance, where nothing moves
    }
}



// A law that ends where it is no longer defined is told from a motion that does not go on.
TEST(Resolution, LawThatIsNoNumber)
{
  try
    {
      report_of("0", two, "-50*sqrt(0.05 - slide.displacement)");
      FAIL() << "a force of sqrt(-1) N";
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("not a finite number"), std::string::npos) << problem.what();
    }
}
