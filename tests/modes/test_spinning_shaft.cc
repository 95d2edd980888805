// Whirling of a simply supported shaft that spins in its bearings (prm/benchmarks/spinning_shaft.prm): rotary inertia,
// no shear (Rayleigh). In fixed axes (1 + b) ω² − 2 b Ω ω − ω0² = 0 with b = (n π k/L)², ω0 = (n π)², in units of
// sqrt(EI/(m L⁴)); the positive root whirls with the spin, the negative one against it. Axes that turn with the shaft
// see |ω − Ω|. What is left of shear is (n π)²/(2 GA) < 5e-7.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  const std::string spinning_shaft = "prm/benchmarks/spinning_shaft.prm";

  struct SpinningShaft
  {
    unsigned int n;
    double       k, Omega, forward, backward;
  };
  const SpinningShaft spinning_shafts[] = {
    {1, 0.025, 0, 9.839304169, -9.839304169},      {1, 0.025, 5, 9.870005345, -9.808698489},
    {1, 0.025, 9.8696, 9.899997629, -9.778982799}, {1, 0.025, 20, 9.962681834, -9.71745441},
    {1, 0.025, 40, 10.08758705, -9.597132202},     {1, 0.05, 0, 9.750050941, -9.750050941},
    {1, 0.05, 5, 9.871193614, -9.630394972},       {1, 0.05, 9.8696, 9.990605617, -9.515288362},
    {1, 0.05, 20, 10.24353507, -9.2803405},        {1, 0.05, 40, 10.76070635, -8.834317216},
    {2, 0.025, 0, 39.00020376, -39.00020376},      {2, 0.025, 5, 39.12078893, -38.87999029},
    {2, 0.025, 9.8696, 39.2385865, -38.76326925},  {2, 0.025, 20, 39.48477446, -38.52157989},
    {2, 0.025, 40, 39.97529061, -38.04890147},     {2, 0.05, 0, 37.66352433, -37.66352433},
    {2, 0.05, 5, 38.11535319, -37.21705157},       {2, 0.05, 9.8696, 38.56054566, -36.78737012},
    {2, 0.05, 20, 39.50295349, -35.90974699},      {2, 0.05, 40, 41.4277436, -34.24133061},
    {3, 0.025, 0, 86.4589061, -86.4589061},        {3, 0.025, 5, 86.72228879, -86.19632332},
    {3, 0.025, 9.8696, 86.97957135, -85.94135758}, {3, 0.025, 20, 87.51723614, -85.41337425},
    {3, 0.025, 40, 88.58836153, -84.38063775},     {3, 0.05, 0, 80.35166983, -80.35166983},
    {3, 0.05, 5, 81.26537472, -79.44823816},       {3, 0.05, 9.8696, 82.16512315, -78.57824095},
    {3, 0.05, 20, 84.06808931, -76.79954306},      {3, 0.05, 40, 87.94829966, -73.41120716}};

  struct Critical
  {
    unsigned int n;
    double       k, forward, backward;
  };
  const Critical criticals[] = {{1, 0.025, 9.900186298, 9.7795316},
                                {1, 0.05, 9.993666375, 9.52342465},
                                {2, 0.025, 39.9746655, 38.0936986},
                                {2, 0.05, 41.58379279, 34.67707596},
                                {3, 0.025, 91.39976369, 82.24143036},
                                {3, 0.05, 100.7096081, 68.8143341}};

  /** Frequencies with the sign of the whirl: positive if the shaft's middle line circles from y to z, with the spin. */
  std::vector<double>
  whirls(Scene &scene)
  {
    std::vector<double> result;
    for (const auto &mode : scene.modes())
      {
        double area = 0, size = 0;
        for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
          {
            const auto u = mode.shape.segment<3>(scene.system.layout.of_node(node));
            area += (std::conj(u(1)) * u(2)).imag();
            size += u.tail<2>().squaredNorm();
          }
        if (size < 1e-3) // it turns about its axis or stretches; shapes have unit norm
          continue;
        // Re[u exp(iωt)] circles from axis 2 to axis 3 if u₃ = −i u₂
        result.push_back(area < 0 ? mode.frequency() : -mode.frequency());
      }
    return result;
  }

  double
  nearest(const std::vector<double> &values, const double to)
  {
    double best = 1e300;
    for (const double v : values)
      best = std::abs(v - to) < std::abs(best - to) ? v : best;
    return best;
  }

  std::vector<double>
  whirls_of(const double k, const double Omega, const std::string &axes)
  {
    // one run has the whirls of all n
    static std::map<std::tuple<double, double, std::string>, std::vector<double>> known;
    auto &result = known[{k, Omega, axes}];
    if (!result.empty())
      return result;
    Scene scene(
      spinning_shaft,
      {"Constants/k = " + exact(k), "Constants/Omega = " + exact(Omega), "Modal/Axes = " + axes, "Modal/Modes = 16"});
    scene.equilibrium();
    return result = whirls(scene);
  }
} // namespace



TEST(SpinningShaft, WhirlInFixedAxes)
{
  for (const auto &row : spinning_shafts)
    {
      if (row.Omega == 0)
        continue; // modes of equal frequency without direction; see below
      const auto w = whirls_of(row.k, row.Omega, "fixed");
      for (const double expected : {row.forward, row.backward})
        EXPECT_NEAR(nearest(w, expected), expected, 2e-6 * std::abs(expected))
          << "n " << row.n << ", k " << row.k << ", Omega " << row.Omega;
    }
}



TEST(SpinningShaft, WhirlInTurningAxes)
{
  for (const auto &row : spinning_shafts)
    {
      if (row.Omega == 0)
        continue;
      const auto w = whirls_of(row.k, row.Omega, "turning");
      for (const double expected : {row.forward - row.Omega, row.backward - row.Omega})
        EXPECT_NEAR(nearest(w, expected), expected, 2e-6 * (std::abs(expected) + row.Omega))
          << "n " << row.n << ", k " << row.k << ", Omega " << row.Omega;
    }
}



TEST(SpinningShaft, PairsAtRest)
{
  for (const auto &row : spinning_shafts)
    if (row.Omega == 0)
      {
        Scene        scene(spinning_shaft, {"Constants/k = " + exact(row.k), "Constants/Omega = 0"});
        unsigned int n = 0;
        for (const auto &mode : scene.modes())
          n += std::abs(mode.frequency() / row.forward - 1) < 2e-6;
        EXPECT_EQ(n, 2u) << "n " << row.n << ", k " << row.k;
      }
}



// Turning at a critical speed, the shaft can stand still bent in its own axes: ω0/sqrt(1 − b) of forward whirl. At the
// backward one, ω0/sqrt(1 + 3 b), the frequency in fixed axes is Ω itself.
TEST(SpinningShaft, CriticalSpeeds)
{
  for (const auto &c : criticals)
    {
      const auto forward = whirls_of(c.k, c.forward, "fixed"), backward = whirls_of(c.k, c.backward, "fixed");
      EXPECT_NEAR(nearest(forward, c.forward), c.forward, 2e-6 * c.forward);
      EXPECT_NEAR(nearest(backward, -c.backward), -c.backward, 2e-6 * c.backward);
    }
}



// The speed before is no other motion: alone, modal goes through a sweep as it does behind statics.
TEST(SpinningShaft, SweepWithoutStatics)
{
  Scene  sweep(spinning_shaft);
  auto  &modal = sweep.analysis<ModalAnalysis>();
  for (const double Omega : {5., 20.})
    {
      sweep.context.speeds = {Omega};
      ASSERT_NO_THROW(modal.run(sweep.context)) << Omega;
      Scene alone(spinning_shaft);
      alone.context.speeds = {Omega};
      alone.analysis<ModalAnalysis>().run(alone.context);
      EXPECT_EQ(modal.modes.at(0).frequency(), alone.analysis<ModalAnalysis>().modes.at(0).frequency()) << Omega;
    }
  // what dynamics has left is one
  sweep.context.state.y.at(6 + 3) += 3;
  EXPECT_THROW(modal.run(sweep.context), InputError);
}
