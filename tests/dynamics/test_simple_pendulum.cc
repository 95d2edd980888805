// IFToMM benchmark A01: a point mass on a rod, let go from the horizontal.
//
// Reference: exact, sin(θ/2) = k cd(√(g/L) t, k) with k² = 1/2, tests/reference/multibody/A01_simple_pendulum.csv;
// tension 3 m g cos θ. Expected: order 2s, 2s − 1 with dissipation; ten digits after four swings; a few
// times the tolerance with adaptive steps.

#include "motion.h"

using namespace samara;

namespace
{
  constexpr double gravity = 9.81;

  /** x, y of the mass, by the arithmetic-geometric mean. */
  std::vector<double>
  place_of_the_mass(const double t)
  {
    std::vector<double> a = {1}, c = {std::sqrt(0.5)};
    for (double b = std::sqrt(0.5); c.back() > 1e-15;)
      {
        c.push_back((a.back() - b) / 2);
        const double mean = (a.back() + b) / 2;
        b                 = std::sqrt(a.back() * b);
        a.push_back(mean);
      }
    double phi = std::pow(2., a.size() - 1) * a.back() * std::sqrt(gravity) * t;
    for (unsigned int i = a.size() - 1; i > 0; --i)
      phi = (phi + std::asin(c[i] / a[i] * std::sin(phi))) / 2;
    const double half = std::sqrt(0.5) * std::cos(phi) / std::sqrt(1 - 0.5 * std::sin(phi) * std::sin(phi));
    return {-2 * half * std::sqrt(1 - half * half), -(1 - 2 * half * half)};
  }

  const std::vector<std::string> position = {"mass.position x", "mass.position y"};

  double
  largest_error(const Motion &motion)
  {
    double error = 0;
    for (const double t : motion.times)
      error = std::max(error, motion.error(t, place_of_the_mass(t)));
    return error;
  }
} // namespace



TEST(SimplePendulum, ReferenceIsThatOfTheTable)
{
  EXPECT_NEAR(place_of_the_mass(10)[0], -0.2750874625761, 1e-13);
  EXPECT_NEAR(place_of_the_mass(10)[1], -0.9614192050991, 1e-13);
  EXPECT_NEAR(place_of_the_mass(2.367841947576)[0], -1, 1e-11); // a period
}



TEST(SimplePendulum, ConvergesWithTheOrderOfTheScheme)
{
  for (const Member &member : {Member{1, 1, 0.005},
                               Member{1, 0.5, 0.0005},
                               Member{2, 1, 0.05},
                               Member{2, 0.5, 0.025},
                               Member{2, 0, 0.025},
                               Member{3, 1, 0.05},
                               Member{3, 0.2, 0.025},
                               Member{3, 0, 0.025}})
    member.expect_order([](std::vector<std::string> overrides) {
      overrides.push_back("Dynamic/End time = 3");
      return largest_error(Motion("simple_pendulum", overrides, position));
    });
}



TEST(SimplePendulum, TenDigitsAfterFourSwings)
{
  EXPECT_LT(largest_error(Motion("simple_pendulum", integrator(3, 1, 0.0125), position)), 1e-10);
}



TEST(SimplePendulum, TensionOfTheRod)
{
  const Motion motion("simple_pendulum",
                      integrator(3, 1, 0.0125),
                      {"mass.position x", "mass.position y", "hinge.force 1", "hinge.force 2"});
  for (unsigned int i = 0; i < motion.times.size(); ++i)
    {
      // towards the hinge; cos θ = −y
      const auto  r = place_of_the_mass(motion.times[i]);
      const auto &v = motion.values[i];
      EXPECT_NEAR(v[2], -3 * gravity * -r[1] * r[0], 1e-8) << motion.times[i];
      EXPECT_NEAR(v[3], -3 * gravity * -r[1] * r[1], 1e-8) << motion.times[i];
    }
}



TEST(SimplePendulum, EnergyIsKeptWithoutDissipationAndLostWithIt)
{
  const Motion kept("simple_pendulum", integrator(3, 1, 0.05), position),
    lost("simple_pendulum", integrator(2, 0, 0.05), position);
  EXPECT_LT(std::abs(kept.budget.kinetic + kept.budget.potential - kept.budget.start), 1e-8); // of 9.81 J
  EXPECT_GT(lost.budget.dissipated, 1e-4);
  EXPECT_NEAR(lost.budget.kinetic + lost.budget.potential + lost.budget.dissipated, lost.budget.start, 1e-8);
}



TEST(SimplePendulum, AdaptiveStepsMeetTheTolerance)
{
  // 2 m is the largest displacement
  for (const auto &[stages, radius] : {std::make_pair(2, 0.), {3, 0.5}, {3, 1.}})
    for (const double tolerance : {1e-5, 1e-7})
      {
        auto overrides = integrator(stages, radius, 0.05, "1e-12");
        overrides.push_back("Dynamic/Step control = adaptive");
        overrides.push_back("Dynamic/Tolerance = " + text_of(tolerance));
        const Motion motion("simple_pendulum", overrides, position);
        const double error = largest_error(motion) / 2;
        EXPECT_GT(error, 0.05 * tolerance) << stages << " stages, spectral radius " << radius;
        EXPECT_LT(error, 10 * tolerance) << stages << " stages, spectral radius " << radius;
        EXPECT_LT(motion.report.n_rejected + motion.report.n_failed, 0.3 * motion.report.n_steps);
      }
}
