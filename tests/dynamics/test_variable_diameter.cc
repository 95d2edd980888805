// Shipped models with sliding joints: the blade of a rotor of variable diameter, forces and energy while the nut on its
// jackscrew draws it in; a carriage on a boom beside one with the classical joint.
//
// References: m Ω² r of the blade's centre (17.1 kg, 2.667 m to 1.372 m at 20 rad/s: 18.24 kN to 9.38 kN); the Coriolis
// moment 2 Ω v m r; the statics of a screw.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;



// In 5 s instead of 20: the nut at 0.26 m/s. The strap carries the blade, the screw the strap and the nut.
TEST(VariableDiameter, ForcesOfStrapAndScrew)
{
  Scene        scene("prm/rotorcraft/variable_diameter_blade.prm", {"Constants/time = 5 s", "Dynamic/End time = 5 s"});
  const double m = 17.1, w = 20, drawn = 1.295, speed = drawn / 4.9, lead = 62.83;
  double       start = 0, end = 0, worst_strap = 0, worst_screw = 0, worst_moment = 0, worst_way = 0, tube = 0,
         sum_of_moments = 0, sum_of_reference = 0;
  auto &dynamics    = scene.analysis<DynamicAnalysis>();
  dynamics.observer = [&](const State &state) {
    const auto   value = [&](const std::string &probe) { return scene.input.model.probe(probe).value(state); };
    const double t = state.time, way = speed * (t < 0.2 ? t * t / 0.4 : t - 0.1), r = 2.667 - way;
    const double strap = value("strap.force"), screw = value("nut on screw.force 1");
    start        = t == 0 ? strap : start;
    end          = strap;
    worst_way    = std::max(worst_way, std::abs(value("nut on screw.displacement") + way));
    worst_moment = std::max(worst_moment, std::abs(value("nut on screw.moment 1") + screw / lead));
    if (t > 0.5)
      {
        worst_strap = std::max(worst_strap, std::abs(strap - m * w * w * r));
        worst_screw = std::max(worst_screw, std::abs(screw + strap + w * w * (1.9 - way)));
        tube        = std::max(tube, std::abs(value("tube.start.force 1") - 10 * w * w * 1.05));
        sum_of_moments += value("shaft.moment 3");
        sum_of_reference += -2 * w * speed * (m * r + 1.9 - way);
      }
  };
  scene.equilibrium();
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_NEAR(start, 18240, 20);
  EXPECT_NEAR(end, 9380, 20);
  EXPECT_LT(worst_strap, 2e-3 * 18240);
  EXPECT_LT(worst_screw, 2e-3 * 18240);
  EXPECT_LT(worst_moment, 2e-3 * 302);
  EXPECT_LT(worst_way, 5e-3);
  EXPECT_LT(tube, 0.01 * end); // nothing but its own weight
  EXPECT_NEAR(std::abs(sum_of_moments / sum_of_reference), 1, 0.02);
  EXPECT_LT(std::abs(dynamics.budget.balance()), 1e-8 * dynamics.budget.kinetic);
}



// Where the carriage stands still it is as low as the cantilever bends under it and its own weight, and the drive holds
// m g w'; the classical joint goes straight on.
TEST(SlidingBoom, FollowsTheBeam)
{
  Scene        scene("prm/benchmarks/sliding_boom.prm", {"Constants/sag = 1e-2", "Dynamic/End time = 1.5 s"});
  const double g = 9.80665, P = 2 * g, q = 0.5 * g, L = 2, S = 1.8, EI = P * L * L / (3 * 1e-2);
  const double w      = P * S * S * S / (3 * EI) + q * S * S * (6 * L * L - 4 * L * S + S * S) / (24 * EI);
  const double slope  = P * S * S / (2 * EI) + q * S * (3 * L * L - 3 * L * S + S * S) / (6 * EI);
  double       height = 0, force = 0, root = 0, classical = 0, n = 0;
  auto        &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.observer     = [&](const State &state) {
    const auto value = [&](const std::string &probe) { return scene.input.model.probe(probe).value(state); };
    classical        = std::max({classical,
                                 std::abs(value("classical carriage.position z")),
                          state.time > 1.01 ? std::abs(value("classical slide.force 3")) : 0.});
    if (state.time < 1.01)
      return;
    height += value("carriage.position z");
    force += value("slide.force 1");
    root += value("boom.start.moment 2");
    ++n;
  };
  scene.equilibrium();
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_NEAR(height / n, -w, 0.01 * w);
  EXPECT_NEAR(force / n, -P * slope, 0.02 * P * slope);
  EXPECT_NEAR(root / n, P * S + q * L * L / 2, 0.01 * P * S);
  EXPECT_LT(classical, 1e-6);
  EXPECT_LT(std::abs(dynamics.budget.balance()), 1e-9 * P);
}
