// A point that slides along a line of a shell: the deflection under a load that is moved, momenta and energy of a plate
// and a bead in flight, and what is refused.

#include <samara/analysis/dynamic.h>

#include "../momentum.h"
#include <gtest/gtest.h>

#include "shell_rail.h"

using namespace samara;



// A simply supported square plate: the load is carried by a bead that is moved along the middle, and shear lets the
// plate bend a little more than the series says.
TEST(SlidingOnShells, LoadOnASupportedPlate)
{
  const double x = 0.37, w = deflection_of_square_plate(0.005, x, 0.5);
  ShellRail    plate;
  plate.shell        = " set Thickness = 0.005\n";
  plate.bead         = " set Position = 0.25, 0.5, 0\n";
  plate.displacement = " set Prescribed = 0.12\n";
  plate.support_and_load();
  Scene scene(plate.text());
  scene.equilibrium();
  EXPECT_NEAR(scene.value("bead.position x"), x, 1e-6);
  EXPECT_NEAR(scene.value("slide.arc length"), x, 1e-9);
  EXPECT_NEAR(-scene.value("bead.position z"), w, 0.03 * w);
}



// A soft plate in flight that nobody holds, and a bead that slides along it across three ends of elements and leaves
// it.
TEST(SlidingOnShells, MomentaOfAPlateInFlight)
{
  ShellRail plate;
  plate.shell  = " set Thickness = 0.05\n set Density = 20\n set Angular velocity = 0, 0, 1\n";
  plate.bead   = " set Position = 0.3, 0.5, 0\n set Velocity = 1.5, 0.3, 0.2\n";
  plate.slider = " set At the ends = leave\n";
  plate.mesh   = " set Elements = 4, 2\n set Degree = 2\n";
  plate.rest   = motion_of_rail(0.6, 0.02, 2);
  Scene scene(plate.text());
  auto &analysis = scene.analysis<DynamicAnalysis>();
  analysis.start(scene.context);
  std::vector<Vector6> momenta;
  analysis.observer = [&](const State &state) { momenta.push_back(momentum_of(scene.system, state)); };
  analysis.run(scene.context);
  for (const Vector6 &p : momenta)
    EXPECT_LT((p - momenta.front()).norm(), 1e-5 * momenta.front().norm()); // of the scheme, which turns with the nodes
  EXPECT_EQ(scene.value("slide.attached"), 0);
  EXPECT_LT(analysis.report.largest_balance, 1e-9);
}



TEST(SlidingOnShells, IsRefused)
{
  ShellRail plate;
  plate.shell = " set Thickness = 0.05\n";
  plate.bead  = " set Position = 0.3, 0.5, 0\n";
  EXPECT_EQ(plate.refusal(), "");
  plate.line = "line v 0.4"; // inside of cells: a curve, but not where the bead is
  EXPECT_NE(plate.refusal().find("0.1 m away"), std::string::npos) << plate.refusal();
  plate.line = "line w 0.5";
  EXPECT_NE(plate.refusal().find("is written <line u 0.5>"), std::string::npos);
  plate.line = "edge u2";
  EXPECT_NE(plate.refusal().find("has no edge <edge u2>"), std::string::npos);
  plate.line = "line v 0.5";
  plate.kind = "sleeve";
  EXPECT_NE(plate.refusal().find("only a <sliding point> goes"), std::string::npos);
  plate.kind = "point";
  plate.line = "edge u0";
  EXPECT_NE(plate.refusal().find("m away"), std::string::npos);
}
