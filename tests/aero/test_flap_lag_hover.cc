// The instability of flap and lag of hingeless blades in hover.
//
// Reference: R. A. Ormiston, D. H. Hodges, Linear flap-lag dynamics of hingeless helicopter rotor blades in hover, J.
// American Helicopter Society 17 (2), 1972, 2-14: a rigid blade with springs at the centre of the rotor, small angles.
// Their equations without elastic coupling are derived anew here; what they found, that the blade is least stable where
// both frequencies are sqrt(4/3), follows from them.

#include <samara/base/dense.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>

#include "../scene.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

#include "growth.h"

using namespace samara;

namespace
{
  /**
   * Growth of the lag mode [1, Ω = 1] by the equations of small angles: with φ = 4λ/3 of the inflow λ, the flap angle
   * β₀ = γ/8 (θ − φ)/p² of the equilibrium and drag d,
   *
   *     β'' + γ/8 β' + p² β + [2β₀ − γ/8 (2θ − φ)] ζ' = 0
   *     ζ'' + γ/8 (2d/a + θφ) ζ' + ω² ζ − [2β₀ − γ/8 (θ − 2φ)] β' = 0
   */
  double
  growth_of_small_angles(const double theta, const double p, const double omega)
  {
    const double a = 2 * M_PI, lock = 5, solidity = 0.05, drag = 0.01;
    const double lambda = solidity * a / 16 * (std::sqrt(1 + 24 * theta / (solidity * a)) - 1), phi = 4. / 3 * lambda,
                 beta = lock / 8 * (theta - phi) / (p * p);
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 2) = A(1, 3) = 1;
    A(2, 0)           = -p * p;
    A(3, 1)           = -omega * omega;
    A(2, 2)           = -lock / 8;
    A(2, 3)           = -(2 * beta - lock / 8 * (2 * theta - phi));
    A(3, 2)           = 2 * beta - lock / 8 * (theta - 2 * phi);
    A(3, 3)           = -lock / 8 * (2 * drag / a + theta * phi);
    return general_eigenvalues(A).real().maxCoeff();
  }



  double
  growth_of_model(const double theta, const double p, const double omega)
  {
    Scene scene("prm/examples/aero/flap_lag_hover.prm",
                {"Constants/theta = " + std::to_string(theta),
                 "Constants/p = " + std::to_string(p),
                 "Constants/omega = " + std::to_string(omega)});
    scene.equilibrium();
    double largest = -1;
    for (const auto &mode : scene.modes())
      largest = std::max(largest, mode.lambda.real());
    return largest;
  }



  /** The collective pitch beyond which lag grows [rad], between 0.12 and 0.4. */
  template <typename Growth>
  double
  boundary(const Growth &growth, const double p, const double omega)
  {
    double low = 0.12, high = 0.4;
    if (growth(high, p, omega) < 0)
      return high;
    EXPECT_LT(growth(low, p, omega), 0);
    for (unsigned int i = 0; i < 10; ++i)
      {
        const double middle                         = 0.5 * (low + high);
        (growth(middle, p, omega) < 0 ? low : high) = middle;
      }
    return 0.5 * (low + high);
  }
} // namespace



// Damping of lag, which is a hundredth of that of flap, at a collective pitch of 0.1 and 0.2 rad.
TEST(FlapLagInHover, DampingOfSmallAngles)
{
  const double p = std::sqrt(4. / 3);
  for (const double omega : {0.7, 1.05, p, 1.25})
    for (const double theta : {0.1, 0.2})
      {
        const double expected = growth_of_small_angles(theta, p, omega);
        EXPECT_NEAR(growth_of_model(theta, p, omega), expected, 0.03 * std::abs(expected) + 4e-5)
          << "theta = " << theta << ", omega = " << omega;
      }
}



// The boundary of Ormiston and Hodges, with its lowest place where both frequencies are 2/√3.
TEST(FlapLagInHover, BoundaryOfOrmistonAndHodges)
{
  const double p             = std::sqrt(4. / 3);
  double       at_the_lowest = 0;
  for (const double omega : {p, 1.06, 1.25})
    {
      const double expected = boundary(growth_of_small_angles, p, omega), found = boundary(growth_of_model, p, omega);
      EXPECT_NEAR(found / expected, 1, 0.03) << "omega = " << omega << ": " << expected;
      if (at_the_lowest == 0)
        at_the_lowest = found;
      else
        EXPECT_GT(found, 1.1 * at_the_lowest);
    }
  EXPECT_NEAR(at_the_lowest, 0.190, 0.004);
  // with other frequencies of flap it is higher, too
  for (const double other : {1.08, 1.25})
    EXPECT_GT(boundary(growth_of_model, other, other), 1.01 * at_the_lowest);
}



// The same as a motion: after a small blow flap dies away, and lag decays and grows as the modes tell.
TEST(FlapLagInHover, InTime)
{
  const double p = std::sqrt(4. / 3);
  for (const double theta : {0.1, 0.3})
    {
      Scene scene("prm/examples/aero/flap_lag_hover.prm", {"Constants/theta = " + std::to_string(theta)});
      scene.equilibrium();
      State        state = scene.context.state;
      const Probe  lag   = scene.input.model.probe("lag.rotation");
      const double still = lag.value(state);
      for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
        state.y[6 * node + 5] += 1e-5;
      state.held = false;
      Projection(scene.system).velocities(state);
      constexpr double    h = 0.2;
      StageIntegrator     integrator(scene.system, Tableau(3, 1.), 1e-12, 50);
      std::vector<double> values;
      for (unsigned int i = 0; i < 400; ++i)
        {
          ASSERT_TRUE(integrator.step(state, h).converged);
          if (i >= 300)
            values.push_back(lag.value(state) - still);
        }
      const double expected = growth_of_model(theta, p, p);
      EXPECT_EQ(expected > 0, theta > 0.2);
      EXPECT_NEAR(aero_models::growth_of(values, h).real(), expected, 1e-4);
    }
}
