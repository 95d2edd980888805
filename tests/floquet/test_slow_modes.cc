// Multipliers of slow modes, names of modes, and what belongs to a sweep.
//
// Reference: all columns of the same map; modes in hover; Hammond's linear equations with the damper of one blade out,
// by Runge and Kutta's method with 4000 steps a turn in another program (tests/reference has its data).

#include <samara/analysis/floquet.h>

#include "../said_by.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "floquet_models.h"

using namespace samara;
using namespace floquet_models;

namespace
{
  const std::string elastic = "prm/examples/floquet/elastic_rotor.prm";

  /** The modes of a shipped model with other entries. */
  std::vector<FloquetMode>
  modes_of(const std::string &model, const std::vector<std::string> &overrides, std::string *const said = nullptr)
  {
    Scene scene(model, overrides);
    auto &analysis = scene.analysis<FloquetAnalysis>();
    analysis.run(scene.context);
    if (said != nullptr)
      *said = scene.stream.str();
    return analysis.modes;
  }

  std::string
  name_of(const FloquetMode &mode)
  {
    return mode.content.family + ", " + mode.content.pattern;
  }
} // namespace



// Among some hundred multipliers of an elastic rotor on an airframe those of the slow modes are found.
TEST(SlowModes, AreAmongAllMultipliers)
{
  const auto expected = modes_of(
    elastic,
    {"Floquet/Steps = 6", "Floquet/Method = classical", "Floquet/Highest frequency = 0", "Floquet/Wanted = 30"});
  ASSERT_EQ(expected.size(), 30u);
  std::string                said;
  const auto                 found = modes_of(elastic, {"Floquet/Steps = 6", "Floquet/Method = implicit"}, &said);
  std::multiset<std::string> families;
  for (const auto &mode : found)
    {
      families.insert(mode.content.family);
      double nearest = 1;
      for (const auto &other : expected)
        nearest = std::min({nearest,
                            std::abs(mode.multiplier - other.multiplier),
                            std::abs(mode.multiplier - std::conj(other.multiplier))});
      EXPECT_LT(nearest, 1e-5) << name_of(mode);
    }
  EXPECT_EQ(families,
            (std::multiset<std::string>{"flap 1", "flap 1", "flap 1", "lag 1", "lag 1", "lag 1", "lag 1", "support"}))
    << said;
  EXPECT_NE(said.find("the motion is unstable"), std::string::npos) << said;
}



// Two motions of Hammond's blades leave the airframe at rest, and are damped alike: the fast map tells them apart. With
// less damping on one blade it is one blade that moves, and no pattern.
TEST(SlowModes, HaveNamesByTheirContent)
{
  const auto                 modes = modes_of(hammond, {"Floquet/Steps = 24"});
  std::multiset<std::string> at_rest;
  ASSERT_EQ(modes.size(), 6u);
  EXPECT_EQ(name_of(modes[0]), "lag 1, regressive");
  EXPECT_EQ(name_of(modes[3]), "lag 1, progressive");
  EXPECT_EQ(modes[5].content.family, "support");
  for (const unsigned int i : {1, 2})
    at_rest.insert(name_of(modes[i]));
  EXPECT_EQ(at_rest, (std::multiset<std::string>{"lag 1, collective", "lag 1, differential"}));

  const auto one = modes_of(hammond,
                            {"Subsystems/blade/Joints/lag/rotation/Damper = (copy == 1) ? 1e-3 : damper",
                             "Floquet/Method = classical",
                             "Floquet/Steps = 24"});
  EXPECT_NEAR(std::abs(one[0].multiplier), 1.0124006861, 1e-6);
  EXPECT_EQ(name_of(one[0]), "lag 1, mixed");
}



// A pendulum on a moving hinge has one slow mode at the start and two real multipliers, whose product is that of
// Liouville, exp(-c T): neither is left out, whether one grows or, with more damping, both decay.
TEST(SlowModes, OfWhichOneBecomesTwoAreNotLeftOut)
{
  std::ostringstream text;
  text << std::ifstream(std::string(SAMARA_SOURCE_DIR) + "/" + pendulum).rdbuf();
  // with more than 60 columns not all of them are taken
  text << R"(
subsection Subsystems
  subsection fast
    set Copies = 30 about y
    subsection Bodies
      subsection mass
        set Type    = rigid body
        set Mass    = 1 kg
        set Inertia = 1, 1, 1
      end
    end
    subsection Joints
      subsection slide
        set Type   = prismatic
        set Body A = block.centre
        set Body B = mass.centre
        set Axis   = 0, 1, 0
        subsection displacement
          set Spring = 900 + 10*copy
          set Damper = 1
        end
      end
    end
  end
end
)";
  const auto multipliers = [&](const std::string &q, const double c) {
    const auto modes = modes_of(text.str(),
                                {"Constants/q = " + q,
                                 "Constants/c = " + number_to_text("%.17g", c),
                                 "Floquet/Highest frequency = 5",
                                 "Floquet/Steps = 24",
                                 "Floquet/Method = implicit",
                                 "Floquet/Animations = 0"});
    EXPECT_EQ(modes.size(), 2u) << q << " " << c;
    double product = 1;
    for (const auto &mode : modes)
      {
        EXPECT_EQ(mode.multiplier.imag(), 0) << q << " " << c;
        product *= mode.multiplier.real();
      }
    EXPECT_NEAR(product, std::exp(-c * M_PI), 1e-5) << q << " " << c;
    return std::abs(modes.at(0).multiplier);
  };
  for (const std::string q : {"0.2", "-0.2"}) // either may be nearer to the mode at the start
    EXPECT_NEAR(multipliers(q, 0.05), 1.26394066521, 1e-5);
  EXPECT_LT(multipliers("0.2", 0.25), 1);
}



// Real multipliers that are there six times come out of round-off as pairs here and there. Reference: closed form, and
// for the fast ones the steps' own error.
TEST(Multipliers, EqualRealOnesAreAllThere)
{
  std::string bodies, joints;
  for (const char *const name : {"a", "b", "c", "d", "e", "f"})
    {
      bodies +=
        std::string("subsection ") + name + "\nset Type = rigid body\nset Mass = 2\nset Inertia = 1, 1, 1\nend\n";
      joints += std::string("subsection on ") + name +
                "\nset Type = prismatic\nset Body A = ground\nset Body B = " + name +
                "\nsubsection displacement\nset Spring = 8\nset Damper = 20\nend\nend\n";
    }
  const std::string model = "set Title = six\nset Analyses = floquet\nsubsection Bodies\n" + bodies +
                            "end\nsubsection Joints\n" + joints +
                            "end\nsubsection Floquet\nset Period = 1\nset Steps = 20\nset Wanted = 12\nend\n";
  for (const char *const way : {"Floquet/Method = implicit", "Floquet/Method = classical"})
    {
      SCOPED_TRACE(way);
      const auto modes = modes_of(model, {way});
      ASSERT_EQ(modes.size(), 12u);
      for (unsigned int i = 0; i < 12; ++i)
        {
          EXPECT_EQ(modes[i].frequency(), 0.) << i;
          EXPECT_NEAR(modes[i].growth(), -5 + (i < 6 ? 1 : -1) * std::sqrt(21.), i < 6 ? 1e-9 : 1e-5) << i;
        }
    }
}



TEST(SlowModes, AreRefusedWhereNothingIsSlow)
{
  const std::string said = said_by<NotConverged>([&]() {
    modes_of(elastic, {"Floquet/Steps = 6", "Floquet/Settle = 1", "Floquet/Highest frequency = 0.1"});
  });
  EXPECT_NE(said.find("as slow as the <Highest frequency>"), std::string::npos) << said;
}



// Seen at one moment two modes are slower than 5 rad/s; over the period all are faster.
TEST(SlowModes, AreRefusedWhereTheyAreSlowAtTheStartAlone)
{
  const std::string said = said_by<NotConverged>([&]() {
    modes_of(elastic, {"Floquet/Steps = 6", "Floquet/Method = implicit", "Floquet/Highest frequency = 5"});
  });
  EXPECT_NE(said.find("is slow over all of it"), std::string::npos) << said;
}



// The unstable band, in revolutions per minute.
TEST(Multipliers, BandOfHammondsRotorWithADamperOut)
{
  const std::vector<std::pair<double, int>> edges = {{210.37112772, 1}, {307.07545367, -1}};
  for (const auto &[rpm, into] : edges)
    for (const double beside : {-0.01, 0.01})
      {
        const auto modes = modes_of(hammond,
                                    {"Constants/out = 1",
                                     "Constants/Omega = " + number_to_text("%.12g", rpm + beside) + "*2*pi/60",
                                     "Floquet/Method = classical",
                                     "Floquet/Steps = 12"});
        EXPECT_EQ(std::abs(modes[0].multiplier) > 1, into * beside > 0) << rpm << " " << beside;
      }
}



// Flap and lag in hover: coefficients are constant in turning axes.
TEST(Multipliers, InHoverAreThoseOfModes)
{
  Scene scene(flap_lag, {"Constants/mu = 0", "Constants/theta_c = 0", "Constants/theta_s = 0"});
  scene.equilibrium();
  const auto modes   = scene.modes();
  auto      &floquet = scene.analysis<FloquetAnalysis>();
  floquet.run(scene.context);
  ASSERT_EQ(floquet.modes.size(), 2u);
  for (const auto &mode : floquet.modes)
    {
      double nearest = 1;
      for (const auto &m : modes)
        nearest = std::min(nearest, std::abs(std::exp(m.lambda * 2. * M_PI) - mode.multiplier));
      EXPECT_LT(nearest, 1e-8);
    }
}



// Cyclic pitch is no part of a steady rotation: what is found of one azimuth, with the blade's pitch at rest, are no
// modes.
TEST(Multipliers, OfCyclicPitchAreNoModes)
{
  Scene scene(flap_lag, {"Constants/mu = 0", "Constants/theta_c = 0", "Constants/theta_s = 0.05"});
  scene.equilibrium();
  const std::string said = said_by<InputError>([&]() { scene.modes(); });
  EXPECT_NE(said.find("<pitch.rotation> is prescribed to move"), std::string::npos) << said;
  EXPECT_NE(said.find("0.05 rad/s"), std::string::npos) << said;
}
