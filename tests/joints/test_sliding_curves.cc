// A point that slides along a curve of a shell that is no side of its mesh: Huygens' isochronous cycloid, a helix on a
// cylinder, Navier's plate under a load on its diagonal, momenta and energy in flight, and what is refused.

#include <samara/analysis/dynamic.h>

#include "../momentum.h"
#include <gtest/gtest.h>

#include "shell_rail.h"

using namespace samara;

namespace
{
  /** x = 2 + a (φ + sin φ), z = −0.9 + a (1 − cos φ), a = ½ m, drawn on a rigid wall 4 m wide and 2 m high; the bead is
   * at φ = 1. */
  ShellRail
  cycloid()
  {
    ShellRail rail;
    rail.patches = "4*u, 0, 2*v - 1.5";
    rail.mesh    = " set Elements = 4, 2\n set Degree = 2\n";
    rail.shell   = " set Thickness = 0.01\n set Rigid = true\n set Frames = corner at 0 0\n"
                   " set Curves = cycloid at 0.5 + 0.125*((2*s-1)*2.6 + sin((2*s-1)*2.6)),"
                   " 0.3 + 0.25*(1 - cos((2*s-1)*2.6))\n";
    rail.line    = "cycloid";
    rail.bead    = " set Position = 2.920735492403948, 0, -0.67015115293407\n";
    rail.joints  = " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = plate.corner\n end\n";
    rail.rest    = "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n";
    return rail;
  }
} // namespace



// From its lowest point the arc length is 4 a sin(φ/2), and swings as cos √(g/(4 a)) t, however far. The bead crosses
// the sides of the cells, which the curve does not know.
TEST(SlidingCurves, Isochronous)
{
  const double a = 0.5, omega = std::sqrt(9.80665 / (4 * a)), first = 4 * a * std::sin(0.5),
               lowest = 4 * a * std::sin(1.3), end = 1.5;
  for (const unsigned int stages : {2u, 3u})
    {
      std::array<double, 2> errors{};
      for (unsigned int i = 0; i < 2; ++i)
        {
          ShellRail rail = cycloid();
          rail.rest += motion_of_rail(end, i == 0 ? 0.1 : 0.05, stages);
          Scene scene(rail.text());
          auto &analysis = scene.analysis<DynamicAnalysis>();
          EXPECT_NEAR(scene.value("slide.arc length"), lowest + first, 1e-7); // curve and length of polynomials
          analysis.run(scene.context);
          errors[i] = std::abs(scene.value("slide.arc length") - lowest - first * std::cos(omega * end));
          EXPECT_LT(analysis.report.largest_balance, 1e-8);
        }
      EXPECT_LT(errors[0], stages == 2 ? 2e-3 : 2e-5);
      EXPECT_LT(errors[1], errors[0] / (stages == 2 ? 8 : 25)); // orders 4 and 6
    }
}



// A helix of half a turn: it is as long as its diagonal when the cylinder is rolled out, and what slides is on it.
TEST(SlidingCurves, HelixOnACylinder)
{
  ShellRail rail;
  rail.patches = "cos(pi*u), sin(pi*u), v";
  rail.mesh    = " set Elements = 6, 3\n set Degree = 4\n";
  rail.shell   = " set Thickness = 0.01\n set Rigid edges = base at edge v0\n set Curves = helix at s, 0.1 + 0.8*s\n";
  rail.line    = "helix";
  rail.bead    = " set Position = 0, 1, 0.5\n";
  rail.displacement = " set Prescribed = 0.25*" + number_to_text(std::hypot(M_PI, 0.8)) + "\n";
  rail.joints       = " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = plate.base\n end\n" +
                ShellRail::held_attitude();
  Scene        scene(rail.text());
  const double length = std::hypot(M_PI, 0.8);
  EXPECT_NEAR(scene.value("slide.arc length"), 0.5 * length, 1e-6);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("slide.arc length"), 0.75 * length, 1e-6);
  EXPECT_NEAR(scene.value("bead.position x"), std::cos(0.75 * M_PI), 2e-6);
  EXPECT_NEAR(scene.value("bead.position y"), std::sin(0.75 * M_PI), 2e-6);
  EXPECT_NEAR(scene.value("bead.position z"), 0.7, 2e-6);
}



// A simply supported square plate: the load is moved to (x, x) along the straight line between two points with names.
TEST(SlidingCurves, LoadOnTheDiagonalOfAPlate)
{
  const double at = 0.41, w = deflection_of_square_plate(0.005, at, at);
  ShellRail    rail;
  rail.shell        = " set Thickness = 0.005\n set Frames = low at 0 0, high at 1 1\n";
  rail.line         = "from low to high";
  rail.bead         = " set Position = 0.3, 0.3, 0\n";
  rail.displacement = " set Prescribed = 0.11*sqrt(2)\n";
  rail.support_and_load();
  Scene scene(rail.text());
  scene.equilibrium();
  EXPECT_NEAR(scene.value("bead.position x"), at, 1e-6);
  EXPECT_NEAR(scene.value("bead.position y"), at, 1e-6);
  EXPECT_NEAR(-scene.value("bead.position z"), w, 0.03 * w);
}



// Between corners of cells the straight line is the line of the mesh, with the same numbers.
TEST(SlidingCurves, AlongSidesItIsTheLineOfTheMesh)
{
  std::array<double, 2> z{}, S{};
  for (unsigned int i = 0; i < 2; ++i)
    {
      ShellRail rail;
      rail.mesh  = " set Elements = 3, 2\n set Degree = 2\n";
      rail.shell = " set Thickness = 0.05\n set Density = 20\n set Angular velocity = 0, 0, 1\n";
      rail.line  = i == 0 ? "line v 0.5" : "from 0 0.5 to 1 0.5";
      rail.bead  = " set Position = 0.3, 0.5, 0\n set Velocity = 1.5, 0.3, 0.2\n";
      rail.rest  = motion_of_rail(0.08, 0.02, 2);
      Scene scene(rail.text());
      scene.analysis<DynamicAnalysis>().run(scene.context);
      z[i] = scene.value("bead.position z");
      S[i] = scene.value("slide.arc length");
    }
  EXPECT_NEAR(z[0], z[1], 1e-9);
  EXPECT_NEAR(S[0], S[1], 1e-9);
  EXPECT_GT(S[0], 0.35);
}



// A soft plate in flight, and a bead on an arch of it that crosses sides of cells and leaves at its end.
TEST(SlidingCurves, MomentaOfAPlateInFlight)
{
  ShellRail rail;
  rail.mesh   = " set Elements = 3, 2\n set Degree = 2\n";
  rail.shell  = " set Thickness = 0.05\n set Density = 20\n set Angular velocity = 0, 0, 1\n"
                " set Curves = arch at 0.1 + 0.8*s, 0.3 + 0.4*sin(pi*s)\n";
  rail.line   = "arch";
  rail.bead   = " set Position = 0.5, 0.7, 0\n set Velocity = 2, 0.3, 0.2\n";
  rail.slider = " set At the ends = leave\n";
  rail.rest   = motion_of_rail(0.4, 0.01, 2);
  Scene scene(rail.text());
  auto &analysis = scene.analysis<DynamicAnalysis>();
  analysis.start(scene.context);
  std::vector<Vector6> momenta;
  analysis.observer = [&](const State &state) { momenta.push_back(momentum_of(scene.system, state)); };
  analysis.run(scene.context);
  for (const Vector6 &p : momenta)
    EXPECT_LT((p - momenta.front()).norm(), 3e-6 * momenta.front().norm()); // of the scheme, 16 times that of 20 ms
  EXPECT_EQ(scene.value("slide.attached"), 0);
  EXPECT_LT(analysis.report.largest_balance, 1e-9);
}



// The shipped cycloid, drawn on a soft wall: half a period of the rigid one later both beads are mirrored, however far
// they swing, but for what the wall gives way.
TEST(SlidingCurves, Example)
{
  const double half = M_PI * std::sqrt(4 * 0.5 / 9.80665);
  Scene        scene("prm/examples/cycloid.prm",
              {"Dynamic/End time = " + number_to_text(half) + " s", "Dynamic/Step = 0.05 s"});
  const double near = scene.value("near.position x"), far = scene.value("far.position x");
  auto        &analysis = scene.analysis<DynamicAnalysis>();
  analysis.run(scene.context);
  EXPECT_NEAR(scene.value("near.position x"), 4 - near, 0.02);
  EXPECT_NEAR(scene.value("far.position x"), 4 - far, 0.02);
  EXPECT_LT(analysis.report.largest_balance, 1e-8);
}



// What slides along a curve may go along it and turn: four motions without frequency on a shell that is held.
TEST(SlidingCurves, MotionsAreCounted)
{
  for (const char *line : {"line v 0.5", "arch", "from 0.1 0.5 to 0.9 0.5"})
    {
      ShellRail rail;
      rail.mesh   = " set Elements = 2, 2\n set Degree = 2\n";
      rail.shell  = " set Thickness = 0.05\n set Density = 20\n set Rigid edges = root at edge u0\n"
                    " set Curves = arch at 0.1 + 0.8*s, 0.3 + 0.2*sin(pi*s)\n";
      rail.line   = line;
      rail.bead   = " set Position = 0.5, 0.5, 0\n";
      rail.joints = " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = plate.root\n end\n";
      rail.rest   = "set Analyses = modal\n";
      Scene        scene(rail.text());
      unsigned int n_free = 0;
      for (const auto &mode : scene.modes())
        n_free += mode.is_free();
      EXPECT_EQ(n_free, 4u) << line;
      EXPECT_EQ(check_model(scene.system).n_free_motions, 4u) << line;
    }
}



TEST(SlidingCurves, AreRefused)
{
  ShellRail rail;
  rail.bead         = " set Position = 0.3, 0.5, 0\n";
  const auto answer = [&](const std::string &curve, const std::string &line) {
    rail.shell = " set Thickness = 0.05\n" + (curve.empty() ? "" : " set Curves = " + curve + "\n");
    rail.line  = line;
    return rail.refusal();
  };
  const auto has = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(answer("a at s, 0.5; b at 0.3, s", "b"), "");
  EXPECT_EQ(answer("", "line u 0.3"), ""); // no sides of cells are there
  EXPECT_PRED2(has, answer("a at 2*s, 0.5", "a"), "leaves the patch");
  EXPECT_PRED2(has, answer("a at abs(s - 0.4), 0.5", "a"), "has a corner");
  EXPECT_PRED2(has, answer("a at 0.5, 0.2 + s*0", "a"), "stands still");
  EXPECT_PRED2(has, answer("a at sqrt(s - 0.5), 0.5", "a"), "no finite");
  EXPECT_PRED2(has, answer("a at s", "a"), "two functions of s");
  EXPECT_PRED2(has, answer("a of patch 2 at s, s", "a"), "there are 1");
  EXPECT_PRED2(has, answer("a at s, 0.5; a at s, 0.2", "a"), "already");
  EXPECT_PRED2(has, answer("a at s, 0.5 + 0.02*sin(400*s)", "a"), "bends too much");
  EXPECT_PRED2(has, answer("arch at s, 0.5", "arc"), "did you mean <arch>");
  EXPECT_PRED2(has, answer("", "from 0 0"), "is written <from a to b>");
  EXPECT_PRED2(has, answer("", "from 0 0 to tip"), "has no point <tip>");
  EXPECT_PRED2(has, answer("", "line u 1.5"), "leaves the patch");
  EXPECT_PRED2(has, answer("", "from 0 0 to 1 1"), "m away");
}
