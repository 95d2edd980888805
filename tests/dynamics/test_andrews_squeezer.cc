// Andrews' squeezing mechanism: seven bars in a plane and a spring, from rest to 2.5 turns of the crank in 0.03 s.
//
// Reference: the equations of Hairer & Wanner, Solving ODEs II, VII.7, by an extrapolated midpoint rule in quadruple
// precision (20 digits); and the published values of PSIDE with tolerance 1e-14,
// tests/reference/multibody/A03_andrews_squeezer_t0.03.csv. Those are off by 3e-10 in the angles, 5e-8 in the
// velocities, 1.3e-6 in accelerations and multipliers, relative: as if they were 1e-12 s later. Expected: order 2s,
// 2s − 1 with dissipation.

#include <map>

#include "motion.h"

using namespace samara;

namespace
{
  struct Coordinate
  {
    double start, end, velocity, acceleration; ///< [rad, rad/s, rad/s²]
  };

  using Coordinates = std::map<std::string, Coordinate>;

  const Coordinates exact_coordinates = {
    {"beta", {-0.0617138900142764496, 15.810771195153707097, 1139.9203022591060642, -24631.76312287463447}},
    {"theta", {0, -15.75637105841183947, -1424.3792951775400732, 51850.319636464231534}},
    {"gamma", {0.455279819163070380, 0.040822240119645804858, 11.032911910618593745, 324102.60070757860581}},
    {"phi", {0.222668390165885885, -0.53473011634207959377, 19.293374105032040832, 566749.42200099532649}},
    {"delta", {0.487364979543842550, 0.52440996587995406937, 0.57356991482950245382, 16743.63541834544461}},
    {"omega", {-0.222668390165885885, 0.53473011634207959377, -19.293374105032040832, -566749.42200099532649}},
    {"epsilon", {1.23054744454982119, 1.0480807410419378731, 0.32317914924913087499, 9826.5078015441626885}}};
  const double exact_multipliers[] = {199.17534810453862819,
                                      -29.755309974971763324,
                                      23.066543611622151129,
                                      31.452725275771137075,
                                      22.642494786394378578,
                                      11.617392352611255907};

  const Coordinates published = {{"beta", {0, 15.81077119629904, 1139.920302151208, -24631.76316945196}},
                                 {"theta", {0, -15.75637105984298, -1424.379294994111, 51850.37701610329}},
                                 {"gamma", {0, 0.04082224013073101, 11.03291221937134, 324102.5686413781}},
                                 {"phi", {0, -0.5347301163226948, 19.29337464421385, 566749.3645176213}},
                                 {"delta", {0, 0.5244099658805303, 0.5735699284790808, 16743.62929479361}},
                                 {"omega", {0, 0.5347301163226948, -19.29337464421385, -566749.3645176222}},
                                 {"epsilon", {0, 1.048080741042263, 0.3231791658026955, 9826.520791458423}}};
  const double      published_multipliers[] =
    {199.175333373191, -29.75531228015052, 23.06654119098399, 31.45271365475927, 22.64249232082739, 11.61740700019673};

  /** Which angles add up to that of a bar. */
  const std::vector<std::pair<std::string, std::vector<std::string>>> bars = {{"OF", {"beta"}},
                                                                              {"EF", {"beta", "theta"}},
                                                                              {"EBD", {"gamma"}},
                                                                              {"GE", {"phi", "delta"}},
                                                                              {"AG", {"delta"}},
                                                                              {"HE", {"omega", "epsilon"}},
                                                                              {"AH", {"epsilon"}}};

  std::vector<std::string>
  rotations_and_forces()
  {
    std::vector<std::string> names;
    for (const auto &bar : bars)
      for (const std::string quantity : {"rotation", "angular velocity", "angular acceleration"})
        names.push_back(bar.first + "." + quantity + " z");
    for (const std::string joint : {"E of EBD", "E of GE", "E of HE"})
      for (const std::string axis : {"1", "2"})
        names.push_back(joint + ".force " + axis);
    return names;
  }

  /** The coordinates of Hairer & Wanner at the end, angles as near to the reference as whole turns allow. */
  Coordinates
  coordinates(const Motion &motion)
  {
    const auto &v = motion.at(0.03);
    Coordinates result;
    for (unsigned int i = 0; i < bars.size(); ++i)
      {
        // the last angle of the sum is new; of GE and HE, which come before AG and AH, it is the first
        Coordinate  bar{0, v[3 * i] * M_PI / 180, v[3 * i + 1], v[3 * i + 2]};
        std::string unknown;
        for (const auto &name : bars[i].second)
          {
            bar.end += exact_coordinates.at(name).start;
            if (result.count(name) > 0)
              {
                bar.end -= result[name].end;
                bar.velocity -= result[name].velocity;
                bar.acceleration -= result[name].acceleration;
              }
            else
              unknown = unknown.empty() ? name : unknown;
          }
        result[unknown] = bar;
      }
    // what came too early: delta and epsilon
    for (const auto &[first, second] : {std::make_pair("phi", "delta"), {"omega", "epsilon"}})
      {
        result[first].end -= result[second].end;
        result[first].velocity -= result[second].velocity;
        result[first].acceleration -= result[second].acceleration;
      }
    for (auto &[name, c] : result)
      c.end -= 2 * M_PI * std::round((c.end - exact_coordinates.at(name).end) / (2 * M_PI));
    return result;
  }

  /** With a stop, after 0.03 s: turns of the bars since the start and their velocities, from
   * tests/reference/multibody/andrews_squeezer_stop.csv. */
  struct StoppedBar
  {
    std::string name;
    double      turn, velocity;
  };
  const std::vector<StoppedBar> stopped_bars = {{"OF", 15.6751237249, 1023.44145591},
                                                {"EF", 0.16537665656, -253.871561915},
                                                {"EBD", -0.411506503762, -40.3797707824},
                                                {"GE", -0.715043712677, -72.5975576231},
                                                {"AG", 0.037194641241, -1.99641547085},
                                                {"HE", 0.569869962378, 69.0940428899},
                                                {"AH", -0.182368391541, -1.50709926237}};

  /** Forces of EF on the three other bodies at E, inertial components. */
  std::vector<double>
  multipliers(const Motion &motion)
  {
    const auto         &v = motion.at(0.03);
    const double        c = std::cos(v[3] * M_PI / 180), s = std::sin(v[3] * M_PI / 180); // axes of EF
    std::vector<double> result;
    for (unsigned int i = 21; i < 27; i += 2)
      {
        result.push_back(c * v[i] - s * v[i + 1]);
        result.push_back(s * v[i] + c * v[i + 1]);
      }
    return result;
  }

  /** Largest relative error of angles, velocities, accelerations. */
  Coordinate
  error(const Coordinates &computed, const Coordinates &reference)
  {
    Coordinate error{0, 0, 0, 0};
    for (const auto &[name, r] : reference)
      {
        const Coordinate &c = computed.at(name);
        error.end           = std::max(error.end, std::abs(c.end / r.end - 1));
        error.velocity      = std::max(error.velocity, std::abs(c.velocity / r.velocity - 1));
        error.acceleration  = std::max(error.acceleration, std::abs(c.acceleration / r.acceleration - 1));
      }
    return error;
  }
} // namespace



TEST(AndrewsSqueezer, NineDigitsOfTheReferenceAndThePublishedValues)
{
  const Motion motion("andrews_squeezer", integrator(3, 1, 5e-5), rotations_and_forces());
  const auto   forces = multipliers(motion);
  Coordinate   e      = error(coordinates(motion), exact_coordinates);
  EXPECT_LT(e.end, 1e-9);
  EXPECT_LT(e.velocity, 1e-8);
  EXPECT_LT(e.acceleration, 1e-7);
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_NEAR(forces[i] / exact_multipliers[i], 1, 1e-7) << i;
  EXPECT_LT(motion.report.largest_balance, 1e-10);

  e = error(coordinates(motion), published);
  EXPECT_LT(e.end, 1e-9);
  EXPECT_LT(e.velocity, 1e-7);
  EXPECT_LT(e.acceleration, 2e-6);
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_NEAR(forces[i] / published_multipliers[i], 1, 2e-6) << i;
}



TEST(AndrewsSqueezer, SixDigitsWithHalfARadianAStep)
{
  const Motion motion("andrews_squeezer", integrator(3, 1, 2e-4), rotations_and_forces());
  EXPECT_LT(error(coordinates(motion), exact_coordinates).end, 1e-6);
}



TEST(AndrewsSqueezer, ConvergesWithTheOrderOfTheScheme)
{
  for (const Member &member : {Member{1, 1, 1e-4},
                               Member{2, 1, 2e-4},
                               Member{2, 0, 1e-4},
                               Member{3, 1, 2e-4},
                               Member{3, 0.5, 2e-4},
                               Member{3, 0, 2e-4}})
    member.expect_order([](const std::vector<std::string> &overrides) {
      return error(coordinates(Motion("andrews_squeezer", overrides, rotations_and_forces())), exact_coordinates)
        .velocity;
    });
}



// The plate touches a stop three times; the reference is stopped where it is touched and left, the run is not.
TEST(AndrewsSqueezer, FollowsTheReferenceWithAStop)
{
  std::vector<std::string> names;
  for (const auto &bar : stopped_bars)
    for (const std::string quantity : {".rotation z", ".angular velocity z"})
      names.push_back(bar.name + quantity);
  const auto error = [&](const unsigned int s, const double rho, const double h) {
    const Motion motion("andrews_squeezer_stop", integrator(s, rho, h), names);
    double       largest = 0;
    for (unsigned int i = 0; i < stopped_bars.size(); ++i)
      {
        const double turn = motion.at(0.03)[2 * i] * M_PI / 180 - stopped_bars[i].turn;
        largest           = std::max({largest,
                                      std::abs(std::remainder(turn, 2 * M_PI)),
                                      1e-2 * std::abs(motion.at(0.03)[2 * i + 1] / stopped_bars[i].velocity - 1)});
      }
    EXPECT_LT(motion.report.largest_balance, 1e-10);
    return largest;
  };
  EXPECT_LT(error(3, 1, 1e-4), 2e-4);
  EXPECT_LT(error(3, 0.5, 5e-5), 2e-5);
  EXPECT_LT(error(3, 1, 1.25e-5), 1e-6);
}
