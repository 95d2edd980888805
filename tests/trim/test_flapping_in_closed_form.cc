/*
 * Problem:   trim of a flapping rotor at small advance ratios
 * Reference: the first harmonics of flapping in closed form, for small angles, blades hinged at the axis that reach to
 *            it, linear lift and a uniform flow through the disk (Johnson, Helicopter Theory, 5.5)
 */

#include <samara/analysis/trim.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;



// With μ, the flow λ through the disk, γ = 8, σ a = 0.08 · 5.7 and a twist of −8°: thrust, coning, and the cyclics for
// which the disk does not tilt.
TEST(FlappingInClosedForm, AtSmallAdvanceRatios)
{
  for (const double mu : {0.05, 0.1})
    {
      SCOPED_TRACE(mu);
      Scene scene("prm/rotorcraft/flapping_rotor.prm",
                  {"Constants/mu = " + number_to_text("%.17g", mu),
                   "Constants/tilt = 2 deg",
                   "Constants/hinge = 1e-4*R",
                   "Aerodynamics/flow/Type = uniform inflow",
                   "Subsystems/blade/Surfaces/blade/Line = 1e-4*R, 0, 0; R, 0, 0",
                   "Subsystems/blade/Surfaces/blade/Stations = 5",
                   "Subsystems/blade/Surfaces/blade/Twist = -8 deg*(s/R - 0.75)",
                   "Trim/Steps = 24",
                   "Trim/Tolerance = 1e-7"});
      auto &trim = scene.analysis<TrimAnalysis>();
      trim.run(scene.context);
      const double theta_75 = trim.report.controls[0], theta_1c = trim.report.controls[1],
                   theta_1s = trim.report.controls[2];
      const double lambda = mu * std::tan(2 * M_PI / 180) + scene.value("flow.mean") / 300, twist = -8 * M_PI / 180,
                   theta_0 = theta_75 - 0.75 * twist, gamma = 8, sigma_a = 0.08 * 5.7;
      EXPECT_NEAR(sigma_a / 2 *
                    (theta_0 * (1 + 1.5 * mu * mu) / 3 + twist * (1 + mu * mu) / 4 + mu * theta_1s / 2 - lambda / 2),
                  0.0064,
                  0.02 * 0.0064);
      const double coning =
        gamma * (theta_0 * (1 + mu * mu) / 8 + twist * (1 + 5. / 6 * mu * mu) / 10 + mu * theta_1s / 6 - lambda / 6);
      EXPECT_NEAR(scene.value("blade 1:flap.rotation") * M_PI / 180, coning, 0.02 * coning);
      const double lateral      = 4. / 3 * mu * coning / (1 + mu * mu / 2),
                   longitudinal = -mu * (8 * theta_0 / 3 + 2 * twist - 2 * lambda) / (1 + 1.5 * mu * mu);
      EXPECT_NEAR(theta_1c, lateral, 0.02 * lateral);
      EXPECT_NEAR(theta_1s, longitudinal, 0.02 * std::abs(longitudinal));
    }
}
