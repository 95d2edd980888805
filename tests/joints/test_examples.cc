// The small models in prm/examples, one for each kind of joint, give what their headers say.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Expected
  {
    std::string                                 file;
    std::vector<std::pair<std::string, double>> probes;
    std::vector<double>                         frequencies; ///< all there are
  };

  const double g = 9.80665;

  const Expected examples[] = {
    {"revolute",
     {{"hinge.rotation", 0.5 * 180 / M_PI}, {"pendulum.position z", -std::sin(0.5)}},
     {std::sqrt((2 * g * std::cos(0.5) / 0.5 + 2 * g * std::sin(0.5)) / 2.01)}},
    {"prismatic", {{"guide.displacement", -3 * g / 600}}, {std::sqrt(200.)}},
    {"screw", {{"thread.rotation", -0.05 * g / 0.1 * 180 / M_PI}, {"thread.displacement", -0.0005 * g / 0.1}}, {}},
    {"cylindrical", {{"sleeve.arm.position x", 0.2}, {"sleeve.arm.position y", 0}, {"sleeve.arm.position z", 0.3}}, {}},
    {"planar",
     {{"puck.displacement x", 0.3}, {"puck.displacement y", 0.2}, {"table.rotation", 0.25 * 180 / M_PI}},
     {std::sqrt(10.), std::sqrt(10.), std::sqrt(20.)}},
    {"universal",
     {{"arm.tip.position x", std::sin(40 * M_PI / 180)},
      {"arm.tip.position y", -std::sin(30 * M_PI / 180) * std::cos(40 * M_PI / 180)},
      {"arm.tip.position z", std::cos(30 * M_PI / 180) * std::cos(40 * M_PI / 180)}},
     {}},
    {"skew_universal",
     {{"arm.tip.position x", std::sin(40 * M_PI / 180) / M_SQRT2},
      {"arm.tip.position y",
       -std::sin(40 * M_PI / 180) / M_SQRT2 *std::cos(30 * M_PI / 180) -
         std::cos(40 * M_PI / 180) * std::sin(30 * M_PI / 180)},
      {"arm.tip.position z",
       -std::sin(40 * M_PI / 180) / M_SQRT2 *std::sin(30 * M_PI / 180) +
         std::cos(40 * M_PI / 180) * std::cos(30 * M_PI / 180)}},
     {}},
    {"constant_velocity",
     {{"second.rotation x", 40 * std::sin(35 * M_PI / 180)},
      {"second.rotation y", 0},
      {"second.rotation z", 40 * std::cos(35 * M_PI / 180)}},
     {}},
    {"springs_in_fixed_axes",
     {{"block.displacement z", -2 * g / 400}, {"mount.force 3", -2 * g}},
     {2, 2, 2, std::sqrt(50.), 10, std::sqrt(200.)}},
    {"in_line", {{"wire.displacement", -2 * g / 100}}, {2, 2, 2, std::sqrt(50.)}},
    {"in_plane",
     {{"table.displacement 1", 0.03}, {"table.displacement 2", 0.02}, {"table.force 3", 2 * g}},
     {2, 2, 2, std::sqrt(50.), 10}},
    {"point_on_curve",
     {{"bead.position x", 2 / (8 * g + 20)}, {"wire.force 1", -2 + 20 * 2 / (8 * g + 20)}, {"wire.force 3", 2 * g}},
     {2, 2, 2, std::sqrt((8 * g + 20) / (2 * (1 + 16 * std::pow(2 / (8 * g + 20), 2))))}},
    {"sliding_point",
     {{"slider.displacement", 0.1 + 2 * g * 0.6 / 20}, {"slider.force", 2 * g}, {"slider.force 1", -2 * g * 0.6}},
     {2, 2, 2, std::sqrt(10.)}},
    {"sliding_sleeve",
     {{"slider.displacement", 0.1 + 2 * g * 0.6 / 20},
      {"slider.force 3", 2 * g * 0.8},
      {"slider.moment 2", -0.05 * 2 * g * 0.8}},
     {2, std::sqrt(10.)}},
    {"sliding_prismatic",
     {{"slider.rotation x", 0.6 * 180 / M_PI},
      {"slider.arm.position z", 0.3 * std::cos(0.6)},
      {"slider.arm.position x", 1}},
     {}},
    {"sliding_screw",
     {{"thread.displacement", 2 * g / 200}, {"nut.rotation z", -10 * 2 * g / 200 * 180 / M_PI}},
     {std::sqrt(50.)}},
    {"distributing",
     {{"bar.displacement x", 1e-3},
      {"plate.corner.displacement x", 1e-3},
      {"plate.corner.displacement y", 0.3 * 0.25e-3}},
     {}},
    {"buffer",
     {{"slider 1.displacement", 2020 * 1.2 * g / 224000},
      {"slider 2.displacement", 2200 * 1.2 * g / 224000},
      {"buffer.gap", -180 * 1.2 * g / 224000},
      {"buffer.force", 180 * 1.2 * g / 224}},
     {2, 2, 2, 2, 2, 2, std::sqrt(555 - std::sqrt(252025.)), std::sqrt(555 + std::sqrt(252025.))}},
    {"rigid", {{"clamp.force 3", 2 * g}, {"clamp.moment 2", -g}}, {}},
    {"distance", {{"slider.position x", std::sqrt(3.)}, {"crank.pin.position z", 1}}, {}},
    {"spring", {{"coil.length", 0.8 + 2 * g / 100}, {"coil.force", 2 * g}}, {std::sqrt(50.)}},
    {"gear", {{"shaft A.angular velocity x", 100}, {"shaft B.angular velocity y", 50}}, {}},
    {"flexible_joint",
     {{"engine.displacement z", -20 * 9.81 / 2e4}, {"mount.force 1", -20 * 9.81}},
     {20, 20, std::sqrt(500.), std::sqrt(500.), std::sqrt(1000.), 40}}};
} // namespace



TEST(Examples, GiveWhatTheySay)
{
  for (const auto &example : examples)
    {
      Scene scene("prm/examples/" + example.file + ".prm");
      scene.equilibrium();
      for (const auto &[probe, value] : example.probes)
        EXPECT_NEAR(scene.value(probe), value, 1e-8 * (1 + std::abs(value))) << example.file << ": " << probe;
      if (example.frequencies.empty())
        continue;
      const auto &modes = scene.modes();
      EXPECT_EQ(modes.size(), example.frequencies.size()) << example.file << " has modes that are none";
      for (unsigned int i = 0; i < std::min(modes.size(), example.frequencies.size()); ++i)
        EXPECT_NEAR(modes[i].frequency(), example.frequencies[i], 1e-8 * example.frequencies[i]) << example.file;
    }
}



// A pendulum in two directions, and a spin about the vertical without frequency.
TEST(Examples, Spherical)
{
  Scene        scene("prm/examples/spherical.prm");
  const double expected = std::sqrt(2 * g * 0.5 / (0.02 + 2 * 0.25));
  unsigned int n        = 0;
  for (const auto &mode : scene.modes())
    n += std::abs(mode.frequency() / expected - 1) < 1e-9;
  EXPECT_EQ(n, 2u);
}
