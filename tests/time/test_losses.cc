// What steps take of the energy, or leave open at a stop, is told with the step that would do; with that it is not.
//
// References: the amplification of the scheme for a mass on a spring; the height e² H of a ball that bounces; a lead
// screw behind a coupling, J θ'' = k(Ωt − θ) + m g p with the table's m p² in J.

#include <samara/analysis/dynamic.h>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** What a run with these entries tells; its analysis afterwards. */
  std::string
  told(const std::string              &text,
       const std::vector<std::string> &entries,
       DynamicAnalysis::Budget *const  budget = nullptr)
  {
    Scene scene(text, entries);
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.run(scene.context);
    if (budget != nullptr)
      *budget = dynamic.budget;
    return scene.stream.str();
  }

  double
  step_that_would_do(const std::string &said)
  {
    std::smatch found;
    return std::regex_search(said, found, std::regex("a <Step> of about ([^ ]+) s would do")) ? std::stod(found[1]) :
                                                                                                0.;
  }

  /** 1 kg on 100 N/m, 1 m/s at the start. */
  const std::string swinging =
    model(rigid_body("a", "set Mass = 1\n set Inertia = 1, 1, 1\n set Velocity = 0, 0, 1\n"),
          joint("slide",
                "prismatic",
                "set Body A = ground\n set Body B = a.centre\n" + motion("displacement", " set Spring = 100\n"))) +
    "set Analyses = dynamic\nsubsection Dynamic\n set End time = 3\n end\n";

  /** 1 kg falls by 1 m on a plane that gives back 0.8 of the speed. */
  const std::string bouncing_ball =
    model(
      rigid_body("ball", "set Mass = 1\n set Inertia = 0.004, 0.004, 0.004\n set Position = 0, 0, 1.1\n"),
      joint("floor",
            "ball on plane",
            "set Body A = ground\n set Body B = ball\n set Radius = 0.1\n set Stiffness = 1e6\n set Exponent = 1.5\n"
            " set Restitution = 0.8\n set Impact speed = sqrt(2*9.80665)\n"),
      "  subsection weight\n set Type = gravity\n end\n") +
    "set Analyses = dynamic\nsubsection Dynamic\n set End time = 0.8\n set Spectral radius = 1\n end\n";
} // namespace



TEST(Losses, NumericalDissipationIsToldWithTheStepThatWouldDo)
{
  struct Case
  {
    std::string n_stages, step, end;
  };
  for (const Case &c : {Case{"1", "0.001", "0.1"}, Case{"2", "0.05", "3"}, Case{"3", "0.15", "3"}})
    {
      SCOPED_TRACE(c.n_stages);
      const auto entries = [&](const std::string &step, const std::string &radius) {
        return std::vector<std::string>{"Dynamic/Stages = " + c.n_stages,
                                        "Dynamic/End time = " + c.end,
                                        "Dynamic/Step = " + step,
                                        "Dynamic/Spectral radius = " + radius};
      };
      DynamicAnalysis::Budget budget;
      const std::string       said = told(swinging, entries(c.step, "0"), &budget);
      ASSERT_NE(said.find("the integrator has dissipated"), std::string::npos) << said;
      EXPECT_GT(budget.dissipated, 5e-3 * 0.5);
      const double step = step_that_would_do(said);
      ASSERT_GT(step, 0);
      ASSERT_LT(step, std::stod(c.step));
      const std::string fine = told(swinging, entries(number_to_text("%g", step), "0"), &budget);
      EXPECT_EQ(fine.find("the integrator has dissipated"), std::string::npos) << fine;
      EXPECT_GT(budget.dissipated, 0.02 * 1e-3 * 0.5); // nor is it far too short
      const std::string kept = told(swinging, entries(c.step, "1"));
      EXPECT_EQ(kept.find("the integrator has dissipated"), std::string::npos) << kept;
    }
}



// A motor turns the spindle of a lead screw by a coupling of stiffness k; the nut lets a table of 20 kg down. The motor
// starts at once, so that the coupling oscillates, which long steps damp.
TEST(Losses, ALeadScrewWithLongStepsIsTold)
{
  const std::string small = "set Mass = 1\n set Inertia = 1e-3, 1e-3, 1e-3\n", axis = " set Axis = 0, 0, 1\n",
                    screw =
                      model(rigid_body("motor", small) + rigid_body("spindle", small) +
                              rigid_body("table", "set Mass = 20\n set Inertia = 1, 1, 1\n"),
                            joint("shaft",
                                  "revolute",
                                  "set Body A = ground\n set Body B = motor\n" + axis +
                                    motion("rotation", " set Prescribed = 30*t\n")) +
                              joint("coupling",
                                    "revolute",
                                    "set Body A = motor\n set Body B = spindle\n" + axis +
                                      motion("rotation", " set Spring = 40\n")) +
                              joint("thread",
                                    "screw",
                                    "set Body A = spindle\n set Body B = table\n set Pitch = 2e-3\n" + axis) +
                              joint("guide", "prismatic", "set Body A = ground\n set Body B = table\n" + axis),
                            "  subsection weight\n set Type = gravity\n end\n") +
                      "set Analyses = dynamic\nsubsection Dynamic\n set End time = 1\n set Spectral radius = 0\n end\n";
  // with steps that are short enough it is the motion of the equation
  const double k = 40, J = 1e-3 + 20 * 2e-3 * 2e-3, omega = std::sqrt(k / J), sag = 20 * 9.80665 * 2e-3 / k,
               theta = 30 + sag * (1 - std::cos(omega)) - 30 / omega * std::sin(omega);
  Scene fine(screw, {"Dynamic/Step = 1e-3"});
  fine.analysis<DynamicAnalysis>().run(fine.context);
  EXPECT_NEAR(fine.value("table.position z"), -2e-3 * theta, 1e-7);
  EXPECT_EQ(fine.stream.str().find("the integrator has dissipated"), std::string::npos) << fine.stream.str();
  for (const std::string long_step : {"0.02", "0.005"})
    {
      // of steps that do not resolve the oscillation at all the advice is nearer, and the next one right
      const unsigned int most = long_step == "0.02" ? 2 : 1;
      double             step = std::stod(long_step);
      std::string        said = told(screw, {"Dynamic/Step = " + long_step});
      ASSERT_NE(said.find("the integrator has dissipated"), std::string::npos) << said;
      for (unsigned int i = 0; i < most && said.find("the integrator has dissipated") != std::string::npos; ++i)
        {
          const double advised = step_that_would_do(said);
          ASSERT_GT(advised, 0) << said;
          ASSERT_LT(advised, step) << said;
          step = advised;
          said = told(screw, {"Dynamic/Step = " + number_to_text("%g", step)});
        }
      EXPECT_EQ(said.find("the integrator has dissipated"), std::string::npos) << step << said;
    }
}



TEST(Losses, ABounceInOneStepIsTold)
{
  const std::string said = told(bouncing_ball, {"Dynamic/Step = 0.01"});
  ASSERT_NE(said.find("contacts with stops are not resolved"), std::string::npos) << said;
  const double step = step_that_would_do(said);
  ASSERT_GT(step, 1e-4) << said;
  ASSERT_LT(step, 0.01) << said;
  Scene scene(bouncing_ball, {"Dynamic/Step = " + std::to_string(step)});
  scene.analysis<DynamicAnalysis>().run(scene.context);
  EXPECT_EQ(scene.stream.str().find("contacts with stops are not resolved"), std::string::npos) << scene.stream.str();
  const double z = scene.value("ball.position z"), v = scene.value("ball.velocity z");
  EXPECT_NEAR(z - 0.1 + v * v / (2 * 9.80665), 0.64, 0.01 * 0.64);
}



// A damper that begins within a step is of first order, whatever the scheme.
TEST(Losses, ADamperOfAStopThatBeginsWithinAStepIsTold)
{
  const std::string stopped =
    model(rigid_body("a", "set Mass = 1\n set Inertia = 1, 1, 1\n set Velocity = 0, 0, 1\n"),
          joint("slide",
                "prismatic",
                "set Body A = ground\n set Body B = a.centre\n" +
                  motion("displacement",
                         " set Upper stop = 0.01\n set Stop stiffness = 1\n set Stop damping = 20\n"))) +
    "set Analyses = dynamic\nsubsection Dynamic\n set End time = 0.3\n end\n";
  const std::string coarse = told(stopped, {"Dynamic/Step = 4e-3"}), fine = told(stopped, {"Dynamic/Step = 2e-5"});
  EXPECT_NE(coarse.find("contacts with stops are not resolved"), std::string::npos) << coarse;
  EXPECT_EQ(fine.find("contacts with stops are not resolved"), std::string::npos) << fine;
}
