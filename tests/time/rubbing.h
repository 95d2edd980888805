#ifndef samara_tests_time_rubbing_h
#define samara_tests_time_rubbing_h

// Scenes with closed forms that each law of friction is put to.

#include <gtest/gtest.h>

#include "contact_motion.h"

namespace samara
{
  /** Weight of 1 kg [N]. */
  constexpr double g_n = 9.80665;

  /** A block of 1 kg on a slope that rises along x by @p angle, with a speed up it and these entries of its friction.
   */
  inline std::string
  block_on_slope(const double angle, const double speed, const std::string &friction)
  {
    const double      c = std::cos(angle), s = std::sin(angle);
    const std::string axis = number_of(c) + ", 0, " + number_of(s);
    return systems::model(systems::rigid_body("a",
                                              "set Mass = 1\n set Inertia = 1, 1, 1\n" +
                                                systems::moving(number_of(speed * c) + ", 0, " + number_of(speed * s),
                                                                "0, 0, 0")),
                          systems::joint("slope",
                                         "prismatic",
                                         "set Body A = ground\n set Body B = a.centre\n set Axis = " + axis + "\n" +
                                           systems::motion("displacement", friction)),
                          systems::gravity);
  }

  /**
   * Stick-slip of a mass of 1 kg on a belt of speed V = 1 m/s, held by a spring k = 10 N/m: with coefficients 0.4 and,
   * at rest, 0.6 of Coulomb's law its period is (π + 2 atan2(V/ω, D))/ω + 2 D/V, D = (μ_s − μ_d) N/k. @p friction: what
   * the law says besides. @p look gets the motions with 2 and 3 stages.
   */
  template <typename Look>
  void
  expect_period_of_stick_slip(const std::string &friction, const Look &look)
  {
    const double k = 10, V = 1, w = std::sqrt(k), D = (0.6 - 0.4) * g_n / k;
    const double period = (M_PI + 2 * std::atan2(V / w, D)) / w + 2 * D / V;
    const auto   mass   = [](const std::string &name) {
      return systems::rigid_body(name,
                                 "set Mass = 1\n set Inertia = 1, 1, 1\n" + systems::moving("1, 0, 0", "0, 0, 0"));
    };
    const Scene scene(
      systems::model(mass("belt") + mass("a"),
                     systems::joint("drive",
                                    "prismatic",
                                    "set Body A = ground\n set Body B = belt.centre\n set Axis = 1, 0, 0\n" +
                                      systems::motion("displacement", " set Prescribed = t\n")) +
                       systems::joint("slip",
                                      "prismatic",
                                      "set Body A = belt.centre\n set Body B = a.centre\n set Axis = 1, 0, 0\n" +
                                        systems::motion("displacement",
                                                        " set Friction = 0.4\n set Static friction = 0.6\n"
                                                        " set Stribeck speed = 1e-2\n" +
                                                          friction)) +
                       systems::joint("spring",
                                      "spring",
                                      "set Body A = ground\n set Body B = a.centre\n set Position = -100, 0, 0\n" +
                                        systems::motion("length", " set Spring = 10\n set Rest = 100\n")),
                     systems::gravity));
    for (const unsigned int s : {2, 3})
      {
        std::vector<double> starts; // of slips, when the mass leaves the speed of the belt
        double              before = 0, t_before = 0;
        const auto          m =
          contact_motion(scene.system, Tableau(s, 0.5), 0.01, 14., [&](const State &state, const StepResult &) {
            const double slip = state.rates[1];
            if (before > -0.05 && slip <= -0.05)
              starts.push_back(t_before + (state.time - t_before) * (before + 0.05) / (before - slip));
            before   = slip;
            t_before = state.time;
          });
        ASSERT_GE(starts.size(), 4u);
        EXPECT_NEAR((starts.back() - starts[1]) / (starts.size() - 2) / period, 1, 0.01) << s;
        EXPECT_LT(m.drift, 1e-10) << s;
        look(m);
      }
  }
} // namespace samara

#endif
