// What inflows leave out: the ground, tips and roots; and where momentum theory is in doubt.

#include <samara/aero/inflow.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** The four-bladed rotor of 3 m radius in air, with airfoils that have no drag. */
  std::string
  without_drag(const std::string &inflow, const std::string &wind = "0, 0, 0")
  {
    std::string       text  = four_bladed_rotor(inflow, "rotor.centre", wind);
    const std::string plate = "  subsection plate\n    set Type = analytic\n  end\n";
    text.replace(text.find("subsection Airfoils\n"), 20, "subsection Airfoils\n" + plate);
    for (std::size_t at = 0; (at = text.find("Airfoils = plain", at)) != std::string::npos;)
      text.replace(at, 16, "Airfoils = plate");
    return text;
  }

  const std::string near_ground = "\n    set Ground effect = Cheeseman-Bennett";
} // namespace



// At constant power T/T∞ = 1/(1 − (R/4Z)²): I. C. Cheeseman & W. E. Bennett, A.R.C. R.&M. 3021 (1955).
TEST(GroundEffect, ThrustAtConstantPower)
{
  const double R = 3, area = M_PI * R * R;
  for (const double Z : {1.5, 2., 3., 6., 30.})
    {
      Scene scene(without_drag("uniform inflow" + near_ground, "0, 0, 0\n    set Ground = " + number_to_text(-Z)));
      scene.equilibrium();
      const double T = scene.value("flow.thrust"), P = scene.value("flow.power");
      // without ground P = T√(T/(2ρA))
      const double free = std::pow(P * std::sqrt(2 * 1.225 * area), 2. / 3);
      EXPECT_NEAR(T / free, 1 / (1 - std::pow(R / (4 * Z), 2)), 1e-8) << Z;
      EXPECT_NEAR(scene.value("blade 1.at 2.inflow") * T, P, 1e-8 * P);
    }
}



TEST(GroundEffect, FactorOfSpeedAndHeight)
{
  DiskCorrections c;
  c.has_ground  = true;
  c.least_speed = 1e-6;
  const auto at = [&](const double mu, const double mean, const double Z) {
    DiskCorrections::Flow<double> flow;
    flow << 0.6 * mu, 0.8 * mu, 1., mean, Z;
    return c.ground_factor(flow, 2.);
  };
  EXPECT_NEAR(at(6, 2, 3), std::pow(1 - std::pow(2. / 12, 2) / (1 + 9), 1.5), 1e-12);
  EXPECT_NEAR(at(0, 2, 1e3), 1., 1e-6);
  EXPECT_EQ(at(0, 0, 1), 1.);
  // value and slope go on below half a radius; nothing turns up below the ground
  const double h = 1e-6;
  EXPECT_NEAR(at(0, 2, 1 - h), at(0, 2, 1 + h), 1e-5);
  EXPECT_NEAR((at(0, 2, 1) - at(0, 2, 1 - h)) / h, (at(0, 2, 1 + h) - at(0, 2, 1)) / h, 1e-5);
  EXPECT_NEAR(at(0, 2, 0), 0.125, 1e-12);
  EXPECT_EQ(at(0, 2, -5), at(0, 2, 0));
}



// Lift coefficients are Prandtl's factor times those of the airfoil, with the mean angle of the flow.
TEST(TipLoss, FactorOfLift)
{
  const double R = 3, r0 = 0.5, Omega = 30;
  Scene        scene(without_drag("uniform inflow\n    set Tip loss = Prandtl\n    set Root = 0.5"));
  scene.equilibrium();
  Scene plain(without_drag("uniform inflow"));
  plain.equilibrium();
  EXPECT_LT(scene.value("flow.thrust"), 0.98 * plain.value("flow.thrust"));
  const double w = scene.value("flow.mean");
  // the stations: four Gauss points from 0.6 to 3 m
  for (const double x : {-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053})
    {
      const double r = 1.8 + 1.2 * x, sine_2 = w * w / (w * w + Omega * Omega * r * r),
                   s = std::pow(sine_2 * sine_2 + std::pow(0.02, 4), 0.25);
      const auto F   = [](const double f) { return 2 / M_PI * std::acos(std::exp(-f)); };
      // without drag the force is lift: its direction is across the flow
      const std::string at    = "blade 1.at " + number_to_text(r - 0.6) + ".";
      const double      alpha = scene.value(at + "angle of attack") * M_PI / 180;
      EXPECT_NEAR(scene.value(at + "lift coefficient"),
                  F(2 * (R - r) / (r * s)) * F(2 * (r - r0) / (r0 * s)) * M_PI * std::sin(2 * alpha),
                  1e-9)
        << r;
    }
  // of very many blades there is none
  Scene many(without_drag("uniform inflow\n    set Tip loss = Prandtl\n    set Blades = 100"));
  many.equilibrium();
  EXPECT_NEAR(many.value("flow.thrust") / plain.value("flow.thrust"), 1., 1e-3);
}



TEST(TipLoss, DerivativesInPrescribedInflow)
{
  const std::string flow = "  subsection flow\n    set Type = prescribed inflow\n    set Hub = hub.off\n"
                           "    set Axis = 0.1, -0.2, 1\n    set Radius = 3.5\n    set Velocity = 2 + t, 0.5, -1\n"
                           "    set Tip loss = Prandtl\n    set Root = 0.05\n    set Blades = 3\n  end\n";
  const Scene       scene(blade(air("20, 5, -3", "    set Shear exponent = 0.2\n    set Ground = -7\n") + flow,
                          "    set Chord = 0.4\n    set Airfoils = full\n    set Unsteady = dynamic stall\n    set "
                                "Range = 0.3, 2.9\n    set Inflow = flow\n"));
  const ComplexStep step(scene.system, false, false, true);
  EXPECT_LT(step.error_of_tangent(), 1e-12);
  EXPECT_LT(step.error_of_damping(), 1e-12);
}



// What is said where momentum theory, or the ground's factor, does not hold.
TEST(MomentumInflow, DoubtsAreTold)
{
  const auto said = [](const std::string &inflow, const std::string &wind) {
    Scene scene(without_drag(inflow, wind));
    scene.equilibrium();
    return scene.stream.str();
  };
  const std::string rings = "vortex rings", low = "less than half a radius", leans = "leans by";
  EXPECT_EQ(said("uniform inflow", "0, 0, 0").find(rings), std::string::npos);
  EXPECT_EQ(said("uniform inflow", "0, 0, -5").find(rings), std::string::npos);
  EXPECT_EQ(said("uniform inflow", "0, 0, 0.5").find(rings), std::string::npos);
  EXPECT_NE(said("uniform inflow", "0, 0, 4").find(rings), std::string::npos);
  EXPECT_EQ(said("uniform inflow", "40, 0, 4").find(rings), std::string::npos);
  EXPECT_EQ(said("uniform inflow" + near_ground, "0, 0, 0\n    set Ground = -1.6").find(low), std::string::npos);
  EXPECT_NE(said("uniform inflow" + near_ground, "0, 0, 0\n    set Ground = -1.4").find(low), std::string::npos);
  EXPECT_NE(
    complaint_of(without_drag("uniform inflow" + near_ground, "0, 0, 0\n    set Ground = 1")).find("above the ground"),
    std::string::npos);
  EXPECT_NE(complaint_of(without_drag("uniform inflow\n    set Root = 1")).find("Prandtl"), std::string::npos);
  EXPECT_NE(complaint_of(without_drag("uniform inflow\n    set Tip loss = Prandtl\n    set Root = 3")).find("Radius"),
            std::string::npos);
}
