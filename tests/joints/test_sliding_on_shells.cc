// A point that slides along a line of a shell: the deflection under a load that is moved, momenta and energy of a plate
// and a bead in flight, and what is refused.

#include <samara/analysis/dynamic.h>

#include "../momentum.h"
#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Plate
  {
    std::string plate, bead, line = "line v 0.5", kind = "point", slider, displacement, joints, rest;
    std::string mesh = " set Degree = 3\n set Elements = 4, 4\n";

    std::string
    text() const
    {
      return "subsection Bodies\n subsection plate\n set Type = shell\n set Patches = u, v, 0\n set E = 2e6\n"
             " set Poisson ratio = 0.3\n" +
             mesh + plate +
             " end\n subsection bead\n set Type = rigid body\n set Mass = 0.5\n set Inertia = 0.1, 0.1, 0.1\n" + bead +
             " end\nend\nsubsection Joints\n subsection slide\n set Type = sliding " + kind + "\n set Body A = plate." +
             line + "\n set Body B = bead\n" + slider + " subsection displacement\n" + displacement + " end\n end\n" +
             joints + "end\n" + rest;
    }
  };

  std::string
  refusal_of_plate(const Plate &plate)
  {
    try
      {
        Scene scene(plate.text());
      }
    catch (const std::exception &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



// A simply supported square plate: under a load P at (x, ½) it is w = 4P/(π⁴ D) ΣΣ sin²(mπx) sin²(nπ/2)/(m² + n²)² deep
// (Timoshenko & Woinowsky-Krieger), and by shear a little more; the load is carried there by a bead that is moved along
// the middle.
TEST(SlidingOnShells, LoadOnASupportedPlate)
{
  const double h = 0.005, D = 2e6 * h * h * h / (12 * (1 - 0.09)), P = 1e-6;
  Plate        plate;
  plate.plate        = " set Thickness = 0.005\n";
  plate.bead         = " set Position = 0.25, 0.5, 0\n";
  plate.displacement = " set Prescribed = 0.12\n";
  plate.joints       = " subsection x\n set Type = support\n set Along = plate.edge u0, plate.edge u1\n"
                       " set Fixed = displacement 1, displacement 2, displacement 3, rotation 1\n end\n"
                       " subsection y\n set Type = support\n set Along = plate.edge v0, plate.edge v1\n"
                       " set Fixed = displacement 1, displacement 2, displacement 3, rotation 2\n end\n"
                       " subsection attitude\n set Type = flexible joint\n set Body A = ground\n set Body B = bead\n"
                       " set Rotational stiffness = 1, 1, 1\n end\n";
  plate.rest = "subsection Loads\n subsection push\n set Type = point load\n set At = bead\n set Force = 0, 0, -1e-6\n"
               " end\nend\n";
  Scene scene(plate.text());
  scene.equilibrium();
  const double x   = 0.37;
  double       sum = 0;
  for (unsigned int m = 1; m < 200; ++m)
    for (unsigned int n = 1; n < 200; n += 2)
      sum += std::pow(std::sin(m * M_PI * x), 2) / std::pow(m * m + n * n, 2);
  EXPECT_NEAR(scene.value("bead.position x"), x, 1e-6);
  EXPECT_NEAR(scene.value("slide.arc length"), x, 1e-9);
  EXPECT_NEAR(-scene.value("bead.position z"),
              4 * P / (std::pow(M_PI, 4) * D) * sum,
              0.03 * 4 * P / (std::pow(M_PI, 4) * D) * sum);
}



// A soft plate in flight that nobody holds, and a bead that slides along it across three ends of elements and leaves
// it.
TEST(SlidingOnShells, MomentaOfAPlateInFlight)
{
  Plate plate;
  plate.plate  = " set Thickness = 0.05\n set Density = 20\n set Angular velocity = 0, 0, 1\n";
  plate.bead   = " set Position = 0.3, 0.5, 0\n set Velocity = 1.5, 0.3, 0.2\n";
  plate.slider = " set At the ends = leave\n";
  plate.mesh   = " set Elements = 4, 2\n set Degree = 2\n";
  plate.rest   = "set Analyses = dynamic\nsubsection Dynamic\n set End time = 0.6\n set Step = 0.02\n set Stages = 2\n"
                 " set Spectral radius = 1\n set Newton tolerance = 1e-12\n set Inconsistent velocities = project\nend\n";
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
  Plate plate;
  plate.plate = " set Thickness = 0.05\n";
  plate.bead  = " set Position = 0.3, 0.5, 0\n";
  EXPECT_EQ(refusal_of_plate(plate), "");
  plate.line = "line v 0.4"; // inside of cells: a curve, but not where the bead is
  EXPECT_NE(refusal_of_plate(plate).find("0.1 m away"), std::string::npos) << refusal_of_plate(plate);
  plate.line = "line w 0.5";
  EXPECT_NE(refusal_of_plate(plate).find("is written <line u 0.5>"), std::string::npos);
  plate.line = "edge u2";
  EXPECT_NE(refusal_of_plate(plate).find("has no edge <edge u2>"), std::string::npos);
  plate.line = "line v 0.5";
  plate.kind = "sleeve";
  EXPECT_NE(refusal_of_plate(plate).find("only a <sliding point> goes"), std::string::npos);
  plate.kind = "point";
  plate.line = "edge u0";
  EXPECT_NE(refusal_of_plate(plate).find("m away"), std::string::npos);
}
