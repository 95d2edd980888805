/*
 * Problem:   trim over a part of the period, behind which repeated parts take each other's places
 * Reference: the same trim over whole periods; differences of turns
 */

#include <samara/analysis/trim.h>
#include <samara/base/errors.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "turns.h"

using namespace samara;

namespace
{
  const std::string of_sections = "prm/rotorcraft/flapping_rotor.prm";

  // coordinates of all blades, as a target asks for that of the first
  const std::string all_flaps = "Output/Probes = blade 1:flap.rotation, blade 2:flap.rotation, blade 3:flap.rotation, "
                                "blade 4:flap.rotation";

  const std::string few_stations = "Subsystems/blade/Surfaces/blade/Stations = 4";

  /** Four blades in sections of a quarter of a turn, besides @p more. */
  std::vector<std::string>
  in_quarters(const std::vector<std::string> &more)
  {
    std::vector<std::string> result = {all_flaps,
                                       few_stations,
                                       "Trim/Steps = 24",
                                       "Trim/Symmetry = blade 1, blade 2, blade 3, blade 4",
                                       "Trim/Turning = hub, shaft"};
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }

  std::string
  answer_in_sections(const std::vector<std::string> &entries, const std::string &model = of_sections)
  {
    try
      {
        Scene scene(model, entries);
        scene.analysis<TrimAnalysis>().run(scene.context);
      }
    catch (const std::exception &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



// Controls, averages and the orbit are those of whole periods; and so are all methods'.
TEST(Sections, SameTrimAsWholePeriods)
{
  Scene whole(of_sections, {all_flaps, few_stations, "Trim/Steps = 24", "Trim/Tolerance = 1e-9"});
  auto &of_whole = whole.analysis<TrimAnalysis>();
  of_whole.run(whole.context);
  for (const std::string method : {"Newton-Krylov", "discrete", "auto-pilot"})
    {
      SCOPED_TRACE(method);
      Scene scene(of_sections, in_quarters({"Trim/Tolerance = 1e-7", "Trim/Method = " + method}));
      auto &trim = scene.analysis<TrimAnalysis>();
      trim.run(scene.context);
      for (unsigned int j = 0; j < 3; ++j)
        EXPECT_NEAR(trim.report.controls[j], of_whole.report.controls[j], 1e-6);
      if (method != "Newton-Krylov")
        continue;
      EXPECT_LT(trim.report.turns, 0.8 * of_whole.report.turns);
      // what is left lies on the same orbit
      const auto x      = increment(scene.system, whole.context.state, scene.context.state, true);
      const auto scales = scales_of_increment(scene.system, 1. / 30);
      double     size   = 0;
      for (unsigned int i = 0; i < x.size(); ++i)
        size = std::max(size, std::abs(x[i]) / scales[i]);
      EXPECT_LT(size, 1e-5); // 100 tolerances
      EXPECT_DOUBLE_EQ(scene.context.state.time, whole.context.state.time);
    }
}



// Two blades lie on one line: what they turn about has to tell how one comes to the place of the other.
TEST(Sections, TwoBlades)
{
  const std::vector<std::string> two = {"Subsystems/blade/Copies = 2 about z",
                                        "Constants/weight = 0.0032*rho*pi*R^2*(Omega*R)^2",
                                        "Output/Probes = blade 1:flap.rotation, blade 2:flap.rotation",
                                        few_stations,
                                        "Trim/Steps = 24"};
  Scene                          whole(of_sections, two);
  whole.analysis<TrimAnalysis>().run(whole.context);
  auto halves = two;
  halves.insert(halves.end(), {"Trim/Symmetry = blade 1, blade 2", "Trim/Turning = hub, shaft"});
  Scene scene(of_sections, halves);
  scene.analysis<TrimAnalysis>().run(scene.context);
  for (unsigned int j = 0; j < 3; ++j)
    EXPECT_NEAR(scene.analysis<TrimAnalysis>().report.controls[j],
                whole.analysis<TrimAnalysis>().report.controls[j],
                1e-6);
}



// The tangent of a section and of averages over the whole period, away from the orbit.
TEST(Sections, Tangent)
{
  Scene                            scene(of_sections, in_quarters({"Trim/Tolerance = 0.1"}));
  const Model                     &model = scene.system.model;
  const std::vector<PeriodAverage> averages{{PeriodAverage::mean, 0, model.probe("flow.thrust")},
                                            {PeriodAverage::cosine, 1, model.probe("blade 1:flap.rotation")},
                                            {PeriodAverage::sine, 2, model.probe("blade 2:flap.rotation")}};
  scene.analysis<TrimAnalysis>().run(scene.context);
  const State    start = scene.context.state;
  PeriodicMotion motion(scene.context, 2 * M_PI / 30, 24, {0.5, 1e-13, 50, 1e-4, 3}, averages);
  RepeatedParts  parts(scene.system, {{"blade 1", "blade 2", "blade 3", "blade 4"}}, {"hub", "shaft"});
  parts.align_as_built(start);
  motion.repeat(parts);
  expect_tangent_of_differences(scene.system, motion, start, 3);
}



TEST(Sections, Refusals)
{
  const std::string blades = "Trim/Symmetry = blade 1, blade 2, blade 3, blade 4", turning = "Trim/Turning = ";
  struct Case
  {
    std::vector<std::string> entries;
    std::string              says;
  };
  for (const Case &c :
       {Case{{blades, turning + "hub, shaft"}, "ask for those of all parts"},
        Case{{blades, turning + "hub", all_flaps}, "<shaft.rotation> turns by 90 degrees in 1/4 of the period"},
        Case{{blades, turning + "shaft", all_flaps}, "<hub> turns by 90 degrees"},
        Case{{"Trim/Symmetry = blade 1, blade 4, blade 3, blade 2", turning + "hub, shaft", all_flaps},
             "in another order"},
        Case{{"Trim/Symmetry = blade 1, blade 3, blade 2, blade 4", turning + "hub, shaft", all_flaps},
             "each part is 180 degrees"},
        Case{{"Trim/Symmetry = blade 1, blade 2, blade 3", turning + "hub, shaft", all_flaps}, "each part is"},
        Case{{"Trim/Symmetry = blade 1, blade 2, blade 3, blade 5", turning + "hub, shaft"}, "blade 5"},
        Case{{blades, "Trim/Steps = 26"}, "must be a multiple of the 4 repeated parts"},
        Case{{turning + "hub"}, "<Turning> belongs to a <Symmetry>"}})
    {
      const std::string answer = answer_in_sections(c.entries);
      EXPECT_NE(answer.find(c.says), std::string::npos) << c.entries[0] << ": " << answer;
    }
}



// What is not alike is found before the search; what is another in a later part of the turn behind it.
TEST(Sections, NoSymmetry)
{
  const std::string model = "include " SAMARA_SOURCE_DIR "/" + of_sections + "\n";
  const std::string one   = answer_in_sections(
    in_quarters({}),
    model + "subsection Joints\n subsection blade 3:flap\n  subsection rotation\n   set Damper = 1e4 N*m*s/rad\n  end\n"
              " end\nend\n");
  EXPECT_NE(one.find("the <Symmetry> is none"), std::string::npos) << one;
  EXPECT_NE(one.find("the best motion that was reached is kept"), std::string::npos) << one;
  const std::string late =
    answer_in_sections(in_quarters({}),
                       model + "subsection Loads\n subsection push\n  set Type = point load\n  set At = blade 1:rod\n"
                               "  set Force = 0, 0, 1 kN*max(0, -sin(Omega*t))\n end\nend\n");
  EXPECT_NE(late.find("not after the next one as a whole"), std::string::npos) << late;
  EXPECT_NE(late.find("or this <Symmetry>"), std::string::npos) << late;
}



// One blade that differs by a part in a thousand is refused, one that differs by a part in 1e8 changes nothing that is
// told. What a turn has and a quarter has not, the first harmonic of a force that four blades share, no control moves.
TEST(Sections, AlmostSymmetric)
{
  const std::string model   = "include " SAMARA_SOURCE_DIR "/" + of_sections + "\n";
  const auto        heavier = [&](const std::string &by) {
    return model + "subsection Bodies\n subsection blade 3:rod\n  set Mass = 3*I_blade/(R - hinge)^2*(1 + " + by +
           ")\n end\nend\n";
  };
  const std::string refused = answer_in_sections(in_quarters({}), heavier("1e-3"));
  EXPECT_NE(refused.find("the <Symmetry> is none"), std::string::npos) << refused;
  EXPECT_EQ(answer_in_sections(in_quarters({"Trim/Tolerance = 1e-6"}), heavier("1e-8")), "");

  const std::string blind = answer_in_sections(in_quarters(
    {"Trim/Targets = flow.thrust = weight, cos 1 of flow.thrust = 0 N, sin 1 of blade 1:flap.rotation = 0 deg",
     "Trim/Scales = weight, weight, 1 rad"}));
  EXPECT_NE(blind.find("no control has an effect on the target <cos 1 of flow.thrust>"), std::string::npos) << blind;
}



// A beacon on the hub turns, and is in another place after a quarter of the turn; so do the three arms of another
// rotor, which no quarter of a turn carries into themselves, and no motion goes on from there.
TEST(Sections, WhatTurnsBesideTheAxis)
{
  const auto with = [](const std::string &more, const std::string &turning) {
    return answer_in_sections({all_flaps,
                               few_stations,
                               "Trim/Steps = 24",
                               "Trim/Symmetry = blade 1, blade 2, blade 3, blade 4",
                               "Trim/Turning = hub, shaft, " + turning},
                              "include " SAMARA_SOURCE_DIR "/" + of_sections + "\n" + more);
  };
  const std::string body = R"(
      set Type             = rigid body
      set Mass             = 1 kg
      set Inertia          = 0.1, 0.1, 0.1
      set Position         = 1 m, 0, 0
      set Angular velocity = 0, 0, Omega
      set Velocity         = 0, Omega*1 m, 0
    end
  end
)";
  const std::string one  = with("subsection Bodies\n  subsection beacon" + body + R"(
subsection Joints
  subsection stalk
    set Type   = revolute
    set Body A = hub
    set Body B = beacon
    set Axis   = 1, 0, 0
    subsection rotation
      set Prescribed = 0
    end
  end
end
)",
                               "beacon");
  EXPECT_NE(one.find("the <Symmetry> is none"), std::string::npos) << one;
  EXPECT_NE(one.find("beacon"), std::string::npos) << one;

  const std::string three =
    with("subsection Subsystems\n subsection arm\n  set Copies = 3 about z\n  subsection Bodies\n"
         "   subsection rod" +
           body + R"(
    subsection Joints
      subsection flap
        set Type     = revolute
        set Body A   = hub
        set Body B   = rod
        set Position = 0.3 m, 0, 0
        set Axis     = 0, -1, 0
        subsection rotation
          set Damper = 100
        end
      end
    end
  end
end
)",
         "arm 1, arm 2, arm 3");
  EXPECT_NE(three.find("<Symmetry>"), std::string::npos) << three;
}
