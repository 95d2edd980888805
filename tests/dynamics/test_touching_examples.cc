// The shipped examples of what touches, rubs, rolls: each runs, its energies balance, and one number of it has a closed
// form, that of its header.

#include "motion.h"

using namespace samara;

namespace
{
  constexpr double g_of_examples = 9.80665;

  struct Touching
  {
    std::string                         file;
    std::vector<std::string>            probes;
    std::function<void(const Motion &)> check;
    std::vector<std::string>            overrides = {}; ///< shorter, or with fewer bodies
  };

  /** Largest size of what a probe has been. */
  double
  largest(const Motion &motion, const unsigned int probe)
  {
    double result = 0;
    for (const auto &row : motion.values)
      result = std::max(result, std::abs(row[probe]));
    return result;
  }

  /** When a probe first goes through @p level upwards, or with @p sign = -1 downwards, after @p from. */
  double
  crossing(const Motion      &motion,
           const unsigned int probe,
           const double       level,
           const double       sign = 1,
           const double       from = 0)
  {
    for (unsigned int i = 1; i < motion.times.size(); ++i)
      {
        const double a = sign * (motion.values[i - 1][probe] - level), b = sign * (motion.values[i][probe] - level);
        if (motion.times[i - 1] >= from && a < 0 && b >= 0)
          return motion.times[i - 1] + (motion.times[i] - motion.times[i - 1]) * a / (a - b);
      }
    return std::nan("");
  }

  /** A probe at a time between steps. */
  double
  value_at(const Motion &motion, const unsigned int probe, const double time)
  {
    for (unsigned int i = 1; i < motion.times.size(); ++i)
      if (motion.times[i] >= time)
        {
          const double part = (time - motion.times[i - 1]) / (motion.times[i] - motion.times[i - 1]);
          return (1 - part) * motion.values[i - 1][probe] + part * motion.values[i][probe];
        }
    return std::nan("");
  }

  /** Balls of one size hand over all their speed, one after the other. */
  void
  expect_last_ball_takes_all(const Motion &motion, const double speed)
  {
    EXPECT_NEAR(largest(motion, 1), speed, 0.01 * speed);
    EXPECT_LT(std::abs(motion.values.back()[0]), 0.01 * speed);
  }

  /** Half a swing of a pendulum of this length, by the mean of the arithmetic and geometric one. */
  double
  half_swing(const double length, const double angle)
  {
    double a = 1, b = std::cos(angle / 2);
    for (unsigned int i = 0; i < 6; ++i)
      std::tie(a, b) = std::make_pair((a + b) / 2, std::sqrt(a * b));
    return M_PI * std::sqrt(length / g_of_examples) / a;
  }

  /** Speed of the rope of chain_on_drum.prm where its heavy end has sunk by @p s. */
  double
  speed_of_rope(const double s)
  {
    const double P = 0.2, C = P * std::cos(M_PI / 24), density = 0.1 / (P * M_PI / 12);
    return std::sqrt(2 * g_of_examples * (2 * s - P * std::sin(s / P) + density * s * s) / (4.2 + 0.05 / (C * C)));
  }

  std::vector<Touching>
  examples_that_touch()
  {
    const std::string tight = "Dynamic/Newton tolerance = 1e-12";
    return {{"pile",
             {"pile.ground.force z"},
             [](const Motion &m) { // the last balls still settle
               double sum = 0, n = 0;
               for (unsigned int i = 0; i < m.times.size(); ++i)
                 if (m.times[i] > 0.8)
                   {
                     sum -= m.values[i][0];
                     ++n;
                   }
               EXPECT_NEAR(sum / n / (50 * 1.3 * g_of_examples), 1, 0.02);
             },
             {"Subsystems/layer/Copies = 2 about z by 0 deg", "Dynamic/Output every = 1"}},
            {"chain_on_drum",
             {"heavy.displacement z", "heavy.velocity z"},
             [](const Motion &m) {
               EXPECT_NEAR(-value_at(m, 1, crossing(m, 0, -0.1, -1)) / speed_of_rope(0.1), 1, 0.01);
             }},
            {"crossing_beams", // the bow falls freely, until it meets the rail, which itself sags by a few millimetres
             {"touching.touched", "bow.middle.position z"},
             [](const Motion &m) {
               EXPECT_NEAR(m.at(0.05)[1], 0.06 - g_of_examples * 0.05 * 0.05 / 2, 1e-8);
               EXPECT_NEAR(crossing(m, 0, 0.5), 0.081, 0.004);
               EXPECT_LE(largest(m, 0), 2);
             },
             {"Dynamic/End time = 0.1"}},
            {"contacts",
             {"ball 1.velocity x", "ball 5.velocity x"},
             [](const Motion &m) { expect_last_ball_takes_all(m, 1.6); },
             {"Dynamic/End time = 0.05"}},
            {"ball_on_ball",
             {"b1.velocity x", "b5.velocity x"},
             [](const Motion &m) { expect_last_ball_takes_all(m, 0.5); },
             {"Dynamic/End time = 0.02"}},
            {"rod_impact", // St. Venant: v √(EA ρA) for 2 L/c, then all of it flies back
             {"wall.ground.force x", "rod.middle.velocity x", "wall.touched"},
             [](const Motion &m) {
               double sum = 0, n = 0;
               for (unsigned int i = 0; i < m.times.size(); ++i)
                 if (m.times[i] > 1e-3 && m.times[i] < 3e-3)
                   {
                     sum += m.values[i][0];
                     ++n;
                   }
               EXPECT_NEAR(sum / n / 1000, 1, 0.01);
               EXPECT_NEAR(crossing(m, 2, 0.5, -1) - crossing(m, 2, 0.5), 4e-3, 2.5e-4);
               EXPECT_NEAR(m.values.back()[1], -1, 0.02);
             }},
            {"ball_on_plane", // slips, then rolls
             {"ball.velocity x", "lane.slip"},
             [](const Motion &m) {
               EXPECT_NEAR(m.values.back()[0], 5, 1e-3);
               EXPECT_NEAR(crossing(m, 1, 0.01, -1), 2 * 7 / (7 * 0.14 * g_of_examples), 5e-3);
             },
             {tight}},
            {"ball_on_cylinder", // swings as a pendulum of 7/5 (R − r), as far as it goes now
             {"ball.position y"},
             [](const Motion &m) {
               const double up = crossing(m, 0, 0, 1, 1), down = crossing(m, 0, 0, -1, up);
               double       far = 0;
               for (unsigned int i = 0; i < m.times.size(); ++i)
                 if (m.times[i] > up && m.times[i] < down)
                   far = std::max(far, m.values[i][0]);
               EXPECT_NEAR((down - up) / half_swing(1.4 * 0.25, std::asin(far / 0.25)), 1, 0.01);
             },
             {tight}},
            {"ellipsoid_on_plane", // turns round
             {"stone.angular velocity z"},
             [](const Motion &m) { EXPECT_NEAR(crossing(m, 0, 0), 3.2, 0.1); },
             {"Dynamic/End time = 3.5"}},
            {"friction",
             {"rubbing.displacement rate"},
             [](const Motion &m) {
               const double w = std::sqrt(10.), V = 0.1, D = 0.2 * g_of_examples / 10;
               const double first = crossing(m, 0, -0.01, -1), second = crossing(m, 0, -0.01, -1, first + 1);
               EXPECT_NEAR((second - first) / ((M_PI + 2 * std::atan2(V / w, D)) / w + 2 * D / V), 1, 0.01);
             }},
            {"clutch", // the moment that is told is that of the friction
             {"linings.moment 3"},
             [](const Motion &m) {
               const double radius = 2. / 3 * (std::pow(0.1, 3) - std::pow(0.06, 3)) / (0.1 * 0.1 - 0.06 * 0.06);
               EXPECT_NEAR(std::abs(m.values[10][0]) / (0.3 * 500 * radius), 1, 1e-6);
             },
             {"Dynamic/End time = 0.1"}},
            {"thread", // one holds itself and creeps, the other one sinks as a block on a slope
             {"held.velocity z", "sinking.displacement z", "sinking.acceleration z"},
             [](const Motion &m) {
               const auto on_flank = [](const double t) { // μ/cos β_n
                 return 0.15 * std::hypot(1, std::tan(M_PI / 12) * std::cos(std::atan(t)));
               };
               const double f = on_flank(0.08), creep = 1e-4 * 0.08 / std::sqrt(f * f - 0.08 * 0.08),
                            across = std::tan(std::atan(0.4) - std::atan(on_flank(0.4)));
               EXPECT_NEAR(m.values.back()[0] / (-creep * std::sin(std::atan(0.08))), 1, 1e-5);
               const double a = -g_of_examples / (1 + 0.009 / (5 * 0.02 * 0.02 * 0.4 * across));
               EXPECT_NEAR(m.values.back()[1] / (0.5 * a), 1, 1e-3);
               EXPECT_NEAR(m.values.back()[2] / a, 1, 1e-5);
             }},
            {"nut_friction", // sinks as the steep one of thread
             {"nut.displacement z", "nut.angular velocity z"},
             [](const Motion &m) {
               const double f      = 0.15 * std::hypot(1, std::tan(M_PI / 12) * std::cos(std::atan(0.4))),
                            across = std::tan(std::atan(0.4) - std::atan(f)),
                            a      = g_of_examples / (1 + 0.009 / (5 * 0.02 * 0.02 * 0.4 * across));
               EXPECT_NEAR(m.values.back()[0] / (-0.5 * a), 1, 1e-3);
               EXPECT_NEAR(std::abs(m.values.back()[1]) / (a / 0.008), 1, 1e-3);
               EXPECT_NEAR(m.budget.friction / (2.5 * g_of_examples * a - 0.5 * (5 + 0.009 / (0.008 * 0.008)) * a * a),
                           1,
                           5e-3);
             }},
            {"wire_friction", // both of a sleeve's speeds go down alike
             {"wire.displacement", "wire.displacement rate", "bore.displacement rate", "sleeve.angular velocity x"},
             [](const Motion &m) {
               EXPECT_NEAR(m.values.back()[0] / (0.5 * std::log(2.2) / 0.3), 1, 1e-4);
               EXPECT_NEAR(m.values.back()[1] / (2 / 2.2), 1, 1e-4);
               EXPECT_NEAR(value_at(m, 2, 0.5) / 0.3, 1, 1e-3);
               EXPECT_NEAR(value_at(m, 3, 0.5) / 20, 1, 1e-3);
               EXPECT_NEAR(m.budget.friction / (0.5 + 2 - 2 / (2.2 * 2.2)), 1, 1e-3);
             },
             {tight}},
            {"worm_gear", // spur teeth let the wheel drive, a worm holds it
             {"shaft bearing.rotation rate", "worm bearing.rotation rate"},
             [](const Motion &m) {
               const double part = 2 - 1 / 0.9;
               EXPECT_NEAR(std::abs(m.values.back()[0]) / (0.5 * 0.5 * part / (0.01 + 0.45 / 400 * part)), 1, 1e-3);
               EXPECT_NEAR(std::abs(m.values.back()[1]) / (1e-5 / std::sqrt(1.25) / 0.01), 1, 1e-3);
             }},
            {"jamming_guide",
             {"slides.displacement", "jams.displacement rate"},
             [](const Motion &m) {
               EXPECT_NEAR(m.values.back()[0] / (0.5 * 2 * 0.5 * 0.5), 1, 1e-3);
               EXPECT_NEAR(m.values.back()[1] / (1e-4 / std::sqrt(1.2 * 1.2 - 1)), 1, 1e-4);
             }},
            {"constant_velocity_friction", // what the drive does, and what is lost, in 2 rad
             {"second.angular velocity x", "drive.moment 3"},
             [](const Motion &m) {
               const double s = std::sin(35 * M_PI / 360), c = std::cos(35 * M_PI / 360), arm = 0.03 / 0.5,
                            k = 0.1 * (arm * s + 1 / c) / (1 - 0.1 * arm * c), drive = 50 * (c + k * s) / (c - k * s);
               EXPECT_NEAR(m.budget.drives / (2 * drive), 1, 1e-5);
               EXPECT_NEAR(m.budget.friction / (2 * (drive - 50)), 1, 1e-4);
               EXPECT_NEAR(m.values.back()[0], 20 * std::sin(35 * M_PI / 180), 1e-9);
               EXPECT_NEAR(m.values.back()[1] / drive, 1, 1e-6);
             }},
            {"backlash", // both flanks are touched, and pressed in by no more than the mesh gives way
             {"teeth.play", "teeth.moment"},
             [](const Motion &m) {
               EXPECT_LT(crossing(m, 0, 0.49), 0.5);
               EXPECT_LT(crossing(m, 0, -0.49, -1), 0.5);
               EXPECT_LT(largest(m, 0), 0.5 + largest(m, 1) / 2e4 * 180 / M_PI + 1e-6);
             }},
            {"rolling_disc", // a steady motion
             {"edge.tilt", "edge.force 3"},
             [](const Motion &m) {
               EXPECT_NEAR(m.values.back()[0], (1.1 - M_PI / 2) * 180 / M_PI, 1e-5);
               EXPECT_NEAR(m.values.back()[1], 1.2 * g_of_examples, 1e-5);
             }},
            {"rolling_ball", // round a circle in 7/2 turns of the table
             {"ball.position x", "ball.position y", "contact.force 3"},
             [](const Motion &m) {
               EXPECT_LT(m.error(3.5, {0.4, 0, 0.5 * g_of_examples}), 1e-4);
               EXPECT_LT(value_at(m, 0, 1.75), 0.4 - 2 * 0.8 / (2 * M_PI * 2 / 7) + 1e-4); // across it
             }},
            {"knife_edge", // a cycloid across the slope
             {"sledge.position x", "sledge.position y"},
             [](const Motion &m) {
               const double a = g_of_examples * std::sin(0.2);
               EXPECT_LT(m.error(M_PI / 4, {a / 8, a * (M_PI / 2) / 8}), 1e-7);
               EXPECT_LT(m.error(M_PI / 2, {0, a * M_PI / 8}), 1e-7);
             }},
            {"rolling_friction",
             {"roller.velocity x", "top.angular velocity z", "roller.position x"},
             [](const Motion &m) {
               EXPECT_NEAR(m.at(1)[0], 1 - 5. / 7 * 0.1 * g_of_examples, 1e-3);
               EXPECT_NEAR(m.at(1)[1], 20 - 2.5 * 0.05 * g_of_examples / 0.1, 0.02);
               EXPECT_NEAR(m.at(2)[2], 0.5 / (5. / 7 * 0.1 * g_of_examples), 2e-3);
             }},
            {"group_bristles",
             {"feet.ground.force x", "stool.velocity x", "stool.foot 1.displacement x"},
             [](const Motion &m) {
               EXPECT_NEAR(m.values.back()[0], 2 * g_of_examples * std::sin(0.2), 1e-6);
               EXPECT_LT(std::abs(m.values.back()[1]), 1e-10);
               EXPECT_NEAR(m.values.back()[2], m.at(0.3)[2], 1e-10);
               EXPECT_LT(m.values.back()[2], 1e-4);
             }}};
  }
} // namespace



TEST(TouchingExamples, GiveWhatTheySay)
{
  for (const Touching &example : examples_that_touch())
    {
      SCOPED_TRACE(example.file);
      const Motion motion("../../examples/" + example.file, example.overrides, example.probes);
      const auto  &b = motion.budget;
      const double energy =
        std::max({b.kinetic, b.strain, std::abs(b.potential), std::abs(b.start), std::abs(b.drives), b.friction});
      EXPECT_LT(std::abs(b.balance()), 1e-9 * energy);
      EXPECT_GE(b.friction, 0);
      EXPECT_GE(b.viscous, 0);
      example.check(motion);
    }
}
