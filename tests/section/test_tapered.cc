/*
 * Problem:   beams that taper between stations of one kind, and what is told between stations that are not
 * Reference: bending and shear of a rectangle whose sides are linear, in closed form; sections of the places themselves
 */

#include <samara/cosserat/beam.h>
#include <samara/cosserat/section_stations.h>
#include <samara/recovery/section_report.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "stiffness.h"

using namespace samara;

namespace
{
  const std::string metal_of_tapered = R"(
subsection Materials
  subsection iso
    set Type = isotropic
    set E = 1e9
    set Poisson ratio = 0.3
    set Density = 1
    set Yield stress = 1e4
  end
end
)";

  /** A cantilever along x, 1 m long, of a table with these stations, with 1 N along z at its end. */
  std::string
  tapered_cantilever(const std::string &sections, const std::string &stations, const std::string &more = "")
  {
    return "set Analyses = static, section\n" + metal_of_tapered + "subsection Sections\n" + sections +
           "subsection bar\n set Type = table\n set Stations = " + stations +
           "\nend\nend\nsubsection Bodies\n subsection b\n set Type = beam\n set Points = 0, 0, 0; 1, 0, 0\n"
           " set Section = bar\n set Elements = 4\n" +
           more +
           " end\nend\nsubsection Joints\n subsection c\n set Type = rigid\n set Body A = ground\n"
           " set Body B = b.start\n end\nend\nsubsection Loads\n subsection f\n set Type = point load\n"
           " set At = b.end\n set Force = 0, 0, 1e-3\n end\nend\n";
  }

  /** Sides 0.2 t and 0.1 t. */
  std::string
  tapered_rectangle(const std::string &name, const double t, const std::string &material = " set Material = iso\n")
  {
    return "subsection " + name + "\n set Type = rectangle\n set Width 2 = " + std::to_string(0.2 * t) +
           "\n set Width 3 = " + std::to_string(0.1 * t) + "\n" + material + "end\n";
  }

  const std::string two_rectangles = tapered_rectangle("root", 1) + tapered_rectangle("tip", 0.5);
  const double      force_at_end   = 1e-3;

  /** Largest stress of a section with sides 0.2 t and 0.1 t, t = 1 − x/2, under force_at_end at the end. */
  double
  bending_stress(const double x)
  {
    const double t = 1 - x / 2;
    return 6 * force_at_end * (1 - x) / (0.2 * t * 0.01 * t * t);
  }
} // namespace



TEST(Tapered, StressesAreThoseOfTheShapeAtThePlace)
{
  Scene scene(tapered_cantilever(two_rectangles, "root at 0, tip at 1"));
  scene.equilibrium();
  double largest = 0;
  for (const double x : {0., 0.01, 0.25, 0.49, 0.5, 0.51, 0.75, 0.9})
    {
      const double found = std::abs(scene.value("b.at " + number_to_text(x) + ".stress 11"));
      EXPECT_NEAR(found / bending_stress(x), 1, 1e-6) << x;
      largest = std::max(largest, found);
    }
  // (1 − x)/(1 − x/2)³ is largest in the middle
  EXPECT_NEAR(largest / bending_stress(0.5), 1, 1e-6);
}



// EI = EI₀ t⁴, GA = GA₀ t²: w = force_at_end (2/3)/EI₀ + 2 force_at_end/GA₀.
TEST(Tapered, DeflectionIsThatOfTheShape)
{
  for (const std::string material :
       {" set Material = iso\n", " set E = 1e9\n set Poisson ratio = 0.3\n set Density = 1\n"})
    {
      Scene scene(tapered_cantilever(tapered_rectangle("root", 1, material) + tapered_rectangle("tip", 0.5, material),
                                     "root at 0, tip at 1"));
      const Matrix6 C = scene.input.model.find<Section>("root", "section").at(0, Vector3::Zero()).stiffness;
      scene.equilibrium();
      EXPECT_NEAR(C(4, 4) / (1e9 * 0.2 * 1e-3 / 12), 1, 1e-9);
      EXPECT_NEAR(scene.value("b.end.displacement z") / (force_at_end * (2. / 3 / C(4, 4) + 2 / C(2, 2))), 1, 1e-6)
        << material;
      const auto mass = scene.system.mass_properties(scene.system.reference());
      EXPECT_NEAR(mass.mass / (0.02 * 7. / 12), 1, 1e-6) << material; // ∫ t² dx
    }
}



// Shapes between stations are those that one would write there: with walls of other numbers of cells, rotated, twisted.
TEST(Tapered, SectionsBetweenAreThoseOfThePlace)
{
  const std::string walls = "subsection wall\n set Plies = iso, 0, 4 mm; iso, 0, 2 mm\nend\n";
  const auto        box   = [](const std::string &name, const double w) {
    return "subsection " + name +
           "\n set Type = box\n set Layup = wall\n set Degree = 4\n set Elements = 6\n set Width 2 = " +
           std::to_string(0.24 - 0.1 * w) + "\n set Width 3 = " + std::to_string(0.07 - 0.04 * w) +
           "\n set Position = " + std::to_string(0.02 * w) + ", 0\nend\n";
  };
  for (const double k : {0., 0.4})
    {
      std::string text =
        tapered_cantilever(box("root", 0) + box("tip", 1) + box("quarter", 0.25), "root at 0, tip at 1");
      text.insert(text.find("subsection Sections"), "subsection Layups\n" + walls + "end\n");
      const Scene scene(text);
      const auto &model = scene.input.model;
      const auto  there = model.find<Section>("bar", "section").at(0.25, Vector3(k, 0, 0)),
                 own    = model.find<Section>("quarter", "section").at(0, Vector3(k, 0, 0));
      // other cells than its own: what they leave of corners that point inwards
      EXPECT_LT(difference(there.stiffness, own.stiffness), 2e-3) << k;
      EXPECT_LT(difference(there.inertia, own.inertia), 1e-9) << k;
    }
}



// A rectangle and a rod are not of one kind: the mean by distance of what either has under the strains there.
TEST(Tapered, StationsOfTwoKindsAreWeighted)
{
  const std::string two = tapered_rectangle("root", 1) +
                          "subsection tip\n set Type = tube\n set Outer radius = 0.03\n set Material = iso\n"
                          " set Elements = 16\nend\n";
  Scene        scene(tapered_cantilever(two, "root at 0, tip at 1"));
  const double at_03 = std::abs([&]() {
    const Probe probe = scene.input.model.probe("b.at 0.3.stress 11");
    scene.equilibrium();
    return probe.value(scene.context.state);
  }());
  // curvature of the mean stiffness; E K z at the faces of either
  const double EI = 1e9 * (0.7 * 0.2 * 1e-3 / 12 + 0.3 * M_PI / 4 * std::pow(0.03, 4)), K = force_at_end * 0.7 / EI;
  EXPECT_NEAR(at_03 / (1e9 * K * (0.7 * 0.05 + 0.3 * 0.03)), 1, 5e-3);
  // and a word of it, with the section and what to do
  const std::string said = scene.stream.str();
  EXPECT_NE(said.find("<root> and <tip> are not of one kind"), std::string::npos) << said;
  // continuous where a station is met
  const auto at = [&](const double x) { return scene.value("b.at " + number_to_text(x) + ".stress 11"); };
  EXPECT_NEAR(at(1e-7) / at(0), 1, 1e-5);
}



// Of a jump both sides are looked at: the weaker one counts, wherever an element ends.
TEST(Tapered, LargestLooksAtBothSidesOfAJump)
{
  for (const bool thick_first : {true, false})
    {
      const std::string first = thick_first ? "root" : "tip", second = thick_first ? "tip" : "root";
      Scene             scene(
        tapered_cantilever(two_rectangles,
                           first + " at 0, " + first + " at 0.5, " + second + " at 0.5, " + second + " at 1"));
      scene.equilibrium();
      LargestStress largest(scene.input.model.find<Beam>("b", "beam"), "von Mises");
      largest.look(scene.context.state);
      ASSERT_TRUE(largest.found);
      const double x = thick_first ? 0.5 : 0, sigma = 6 * force_at_end * (1 - x) / (0.1 * 0.05 * 0.05);
      EXPECT_NEAR(largest.found->x, x, 1e-12);
      EXPECT_NEAR(largest.found->index / (sigma / 1e4), 1, 2e-2); // von Mises: shear is at the axis
    }
}
