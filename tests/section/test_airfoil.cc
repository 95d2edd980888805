/*
 * Problem:   sections of airfoils by skins, caps, webs, a weight in the nose and a trailing edge
 * Reference: closed forms. The area of a strip of constant thickness t along a curve of length L that turns by θ is t L
 * − t² θ/2; Bredt's torsion of a thin closed wall; the area of NACA's half thickness. Airfoils:
 * tests/reference/sections.
 */

#include <samara/base/text.h>
#include <samara/cosserat/airfoil_section.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/section_constants.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "stiffness.h"

using namespace samara;

namespace
{
  const std::string of_airfoils = R"(
subsection Materials
  subsection skin
    set Type          = isotropic
    set E             = 70e9
    set Poisson ratio = 0.3
    set Density       = 1
  end
  subsection weightless
    set Copy of = skin
    set Density = 0
  end
  subsection soft
    set Copy of = weightless
    set E       = 1e6
  end
  subsection filler
    set Copy of = skin
    set E       = 1e9
  end
  subsection ply
    set Type = orthotropic
    set E1   = 140e9
    set E2   = 10e9
    set G12  = 5e9
    set nu12 = 0.3
    set nu23 = 0.4
  end
end
subsection Layups
  subsection two
    set Plies = skin, 0, 0.5 mm; skin, 0, 1 mm
  end
  subsection cap
    set Plies = weightless, 0, 2 mm
  end
  subsection web
    set Plies = weightless, 0, 1 mm; weightless, 0, 2 mm
  end
  subsection three
    set Plies = skin, 0, 0.4 mm; weightless, 0, 0.6 mm; skin, 0, 1 mm
  end
  subsection heavy three
    set Plies = skin, 0, 0.4 mm; filler, 0, 0.6 mm; skin, 0, 1 mm
  end
  subsection six
    set Plies = skin, 0, 6 mm
  end
  subsection eight
    set Plies = skin, 0, 8 mm
  end
  subsection thick
    set Plies = skin, 0, 8 mm; weightless, 0, 4 mm
  end
  subsection helix
    set Plies = ply, 15, 2 mm
  end
end
)";

  std::string
  airfoil_model(const std::string &entries)
  {
    return of_airfoils + "subsection Sections\n  subsection s\n    set Type = airfoil\n    set Chord = 1 m\n" +
           entries +
           "  end\nend\nsubsection Bodies\n  subsection b\n    set Type = rigid body\n    set Mass = 1\n"
           "    set Inertia = 1, 1, 1\n  end\nend\n";
  }

  SectionValues
  values_of_airfoil(const std::string &entries)
  {
    const Scene scene(airfoil_model(entries));
    return scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero());
  }

  AirfoilOutline
  naca_outline(const std::string &digits, const bool sharp)
  {
    return AirfoilOutline(naca_points(digits, sharp), 1, 0.25);
  }

  /** t L − t² θ/2 from a to b. */
  double
  strip_area(const AirfoilOutline &outline, const double a, const double b, const double t)
  {
    const unsigned int n = 20000;
    double             L = 0, turn = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double s0 = a + (b - a) * i / n, s1 = a + (b - a) * (i + 1) / n;
        const auto   n0 = outline.inwards(s0), n1 = outline.inwards(s1);
        L += outline.place(s0).distance(outline.place(s1));
        turn += std::atan2(n0[0] * n1[1] - n0[1] * n1[0], n0 * n1);
      }
    return t * L - t * t / 2 * turn;
  }

  std::string
  reference_airfoil(const std::string &name)
  {
    return "    set Coordinates = " SAMARA_SOURCE_DIR "/tests/reference/sections/airfoil_" + name + ".csv\n";
  }

  std::vector<dealii::Point<2>>
  points_of_reference(const std::string &name)
  {
    return read_airfoil(SAMARA_SOURCE_DIR "/tests/reference/sections/airfoil_" + name + ".csv");
  }
} // namespace



TEST(Airfoil, OutlineIsThatOfNACA)
{
  const auto outline = naca_outline("0012", true);
  EXPECT_EQ(outline.trailing_edge(), 0);
  EXPECT_NEAR(naca_outline("0012", false).trailing_edge(), 0.00252, 1e-12);
  double area = 0;
  for (unsigned int i = 0; i < 40000; ++i)
    {
      const auto a = outline.place(outline.length() * i / 40000), b = outline.place(outline.length() * (i + 1) / 40000);
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  EXPECT_NEAR(area, 1.2 * (0.2969 * 2 / 3 - 0.1260 / 2 - 0.3516 / 3 + 0.2843 / 4 - 0.1036 / 5), 1e-8)
    << "counter-clockwise, with the nose at +2";
  for (const double x : {0.003, 0.1, 0.47, 0.9})
    EXPECT_NEAR(outline.place(outline.at(true, x))[1],
                0.6 *
                  (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x),
                2e-8);
  EXPECT_NEAR(1 / outline.curvature(outline.nose()), 1.1019 * 0.0144, 1e-4) << "radius of the nose";
}



TEST(Airfoil, SkinHasTheAreaOfAStrip)
{
  for (const bool sharp : {false, true})
    for (const std::string digits : {"0012", "2418"})
      {
        const auto outline = naca_outline(digits, sharp);
        const auto v       = values_of_airfoil(
          "    set NACA = " + digits + "\n    set NACA trailing edge = " + (sharp ? "sharp" : "blunt") +
          "\n    set Layup = two\n    set Trailing edge material = weightless\n"
                "    set Spar caps = both, 0.15, 0.5, cap\n    set Webs = 0.15, web; 0.5, web\n"
                "    set Trailing edge from = 0.9\n");
        EXPECT_NEAR(v.inertia(0, 0) / strip_area(outline, outline.at(false, 0.9), outline.at(true, 0.9), 0.0015),
                    1,
                    1e-5)
          << digits;
      }
}



TEST(Airfoil, WebsStandUnderTheirCaps)
{
  // a web of 3 mm from skin to skin, and caps that reach over it
  const auto   outline = naca_outline("0012", true);
  const double h       = 2 * outline.place(outline.at(true, 0.3))[1] - 2 * 0.0015;
  const auto   mass    = [](const std::string &more) {
    return values_of_airfoil("    set NACA = 0012\n    set NACA trailing edge = sharp\n    set Material = weightless\n"
                                  "    set Thickness = 1.5 mm\n" +
                             more)
      .inertia(0, 0);
  };
  EXPECT_EQ(mass(""), 0);
  const Scene scene(
    airfoil_model("    set NACA = 0012\n    set NACA trailing edge = sharp\n"
                  "    set Material = weightless\n    set Thickness = 1.5 mm\n    set Webs = 0.3, two\n"));
  EXPECT_NEAR(scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero()).inertia(0, 0), 0.0015 * h, 1e-8);
}



TEST(Airfoil, WeightFillsTheNose)
{
  const auto   outline = naca_outline("2418", false);
  const auto   v = values_of_airfoil("    set NACA = 2418\n    set Material = weightless\n    set Thickness = 2 mm\n"
                                     "    set Nose material = skin\n    set Nose to = 0.06\n");
  const double t = 0.002;
  // between the inner face and the line that closes it
  const unsigned int            n = 40000;
  std::vector<dealii::Point<2>> ring;
  for (unsigned int i = 0; i <= n; ++i)
    {
      const double           s = outline.at(false, 0.08) + (outline.at(true, 0.08) - outline.at(false, 0.08)) * i / n;
      const dealii::Point<2> x(outline.place(s) + t * outline.inwards(s));
      if (outline.x_of(x) <= 0.06)
        ring.push_back(x);
    }
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    {
      const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  EXPECT_NEAR(v.inertia(0, 0) / area, 1, 1e-4);
}



// Another mesher and another program of sections, numpy and dense, p = 4: skin of 0.6 %, webs of 0.8 % at 25 and 55 %,
// a soft trailing edge from 93 %. Its webs are thinner at the inner face by the lean of the normals.
TEST(Airfoil, AgreesWithAnotherMesher)
{
  const auto v = values_of_airfoil("    set NACA = 0012\n    set Layup = six\n    set Webs = 0.25, eight; 0.55, eight\n"
                                   "    set Trailing edge material = filler\n    set Trailing edge from = 0.93\n"
                                   "    set Origin = 0\n    set Elements = 16\n    set Degree = 4\n");
  const SectionConstants c(inverse6(v.stiffness), v.inertia);
  EXPECT_NEAR(v.stiffness(0, 0) / 9.020678e8, 1, 3e-4);
  EXPECT_NEAR(v.stiffness(4, 4) / 1.560446e6, 1, 3e-4);
  EXPECT_NEAR(v.stiffness(5, 5) / 2.452722e8, 1, 3e-4);
  EXPECT_NEAR(c.GJ / 1.850989e6, 1, 4e-3);
  EXPECT_NEAR(-c.shear_centre(0), 0.33194, 1e-3);
}



// A thin closed skin twists as Bredt says; what couples in a symmetric airfoil vanishes.
TEST(Airfoil, TwistsAsBredtSays)
{
  const double t = 5e-4;
  const auto v = values_of_airfoil("    set NACA = 0012\n    set NACA trailing edge = sharp\n    set Material = skin\n"
                                   "    set Thickness = 0.5 mm\n    set Elements = 20\n    set Degree = 2\n");
  const auto outline = naca_outline("0012", true);
  const double area = 1.2 * (0.2969 * 2 / 3 - 0.1260 / 2 - 0.3516 / 3 + 0.2843 / 4 - 0.1036 / 5), L = outline.length(),
               middle = area - L * t / 2, GJ = 70e9 / 2.6 * 4 * middle * middle * t / (L - M_PI * t);
  const SectionConstants c(inverse6(v.stiffness), v.inertia);
  EXPECT_NEAR(c.GJ / GJ, 1, 0.01);
  EXPECT_NEAR(c.shear_centre(1), 0, 1e-9);
  EXPECT_NEAR(c.tension_centre(1), 0, 1e-9);
  EXPECT_NEAR(v.stiffness(0, 0) / 70e9 / v.inertia(0, 0), 1, 1e-9);
}



// Plies turn as in a box: tension twists both the same way. Nothing changes when the airfoil is drawn the other way
// round.
TEST(Airfoil, PliesTurnAsInABox)
{
  const auto  airfoil = values_of_airfoil("    set NACA = 0012\n    set Layup = helix\n    set Elements = 4\n"
                                          "    set Degree = 2\n    set Trailing edge material = soft\n");
  const Scene box(of_airfoils +
                  "subsection Sections\n  subsection s\n    set Type = box\n    set Width 2 = 1\n"
                  "    set Width 3 = 0.1\n    set Layup = helix\n    set Elements = 4\n    set Degree = 2\n"
                  "  end\nend\nsubsection Bodies\n  subsection b\n    set Type = rigid body\n"
                  "    set Mass = 1\n    set Inertia = 1, 1, 1\n  end\nend\n");
  const auto  of_box = box.input.model.find<Section>("s", "section").at(0, Vector3::Zero());
  EXPECT_GT(std::abs(of_box.stiffness(0, 3)), 0.01 * std::sqrt(of_box.stiffness(0, 0) * of_box.stiffness(3, 3)));
  EXPECT_GT(of_box.stiffness(0, 3) * airfoil.stiffness(0, 3), 0);

  const auto written = [](const bool reversed) {
    const auto  points = naca_points("0012", false);
    std::string text   = "NACA 0012\n";
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const auto &p = points[reversed ? points.size() - 1 - i : i];
        text += number_to_text(p[0]) + " " + number_to_text(p[1]) + "\n";
      }
    const std::string file = ::testing::TempDir() + (reversed ? "reversed.dat" : "selig.dat");
    std::ofstream(file) << text;
    return "    set Coordinates = " + file +
           "\n    set Layup = helix\n    set Elements = 4\n    set Degree = 2\n"
           "    set Trailing edge material = soft\n";
  };
  EXPECT_LT(difference(values_of_airfoil(written(false)).stiffness, airfoil.stiffness), 1e-9);
  EXPECT_LT(difference(values_of_airfoil(written(true)).stiffness, airfoil.stiffness), 1e-9);
}



namespace
{
  /** x/c of the place on the side below which, at the depth @p t, x/c is @p x: there a web of this face ends. */
  double
  above_web(const AirfoilOutline &outline, const bool upper, const double x, const double t)
  {
    double a = x - 0.05, b = x + 0.05;
    while (b - a > 1e-12)
      {
        const double middle = (a + b) / 2, s = outline.at(upper, middle);
        (outline.x_of(dealii::Point<2>(outline.place(s) + t * outline.inwards(s))) < x ? a : b) = middle;
      }
    return a;
  }

  /** The end of a web there. */
  dealii::Point<2>
  inner_face(const AirfoilOutline &outline, const bool upper, const double x, const double t)
  {
    const double s = outline.at(upper, above_web(outline, upper, x, t));
    return dealii::Point<2>(outline.place(s) + t * outline.inwards(s));
  }

  /** The area between the depths @p from and @p to from x/c = @p a, or the nose, to b on one side. The nose of a
   * cambered airfoil lies in front of x/c = 0, by 7 mm of its outline for NACA 2418. */
  double
  area_of_ply(const AirfoilOutline &outline,
              const bool            upper,
              const double          a,
              const double          b,
              const double          from,
              const double          to)
  {
    const double s = a > 0 ? outline.at(upper, a) : outline.nose(), e = outline.at(upper, b);
    return strip_area(outline, std::min(s, e), std::max(s, e), to) -
           strip_area(outline, std::min(s, e), std::max(s, e), from);
  }

  /** Skins, caps and webs of airfoils, where their trailing edge may begin, and the area of what has weight of them. */
  struct AirfoilParts
  {
    std::string                                   entries, trailing_from;
    std::function<double(const AirfoilOutline &)> area;
  };

  const std::vector<AirfoilParts> parts_of_airfoils = {
    {"    set Layup = two\n",
     "0.9",
     [](const AirfoilOutline &o) { return strip_area(o, o.at(false, 0.9), o.at(true, 0.9), 0.0015); }},
    {"    set Layup = two\n    set Skins = both, 0.1, 1, thick\n",
     "0.8",
     [](const AirfoilOutline &o) {
       return strip_area(o, o.at(false, 0.1), o.at(true, 0.1), 0.0015) + area_of_ply(o, true, 0.1, 0.8, 0, 0.008) +
              area_of_ply(o, false, 0.1, 0.8, 0, 0.008);
     }},
    {"    set Layup = two\n    set Skins = upper, 0.3, 0.7, thick; both, 0.75, 0.9, web\n"
     "    set Spar caps = both, 0.2, 0.45, thick; lower, 0.31, 0.39, cap\n"
     "    set Webs = 0.2, web; 0.44, 0.46, two; 0.6, two\n",
     "0.9",
     [](const AirfoilOutline &o) {
       // caps of 12 mm, 8 mm of them with weight, reach over the web of 3 mm at 0.2
       const double skins = area_of_ply(o, false, 0, 0.75, 0, 0.0015) + area_of_ply(o, true, 0, 0.3, 0, 0.0015) +
                            area_of_ply(o, true, 0.3, 0.7, 0, 0.008) + area_of_ply(o, true, 0.7, 0.75, 0, 0.0015);
       const double caps = area_of_ply(o, false, above_web(o, false, 0.1985, 0.0135), 0.45, 0.0015, 0.0095) +
                           area_of_ply(o, true, above_web(o, true, 0.1985, 0.0135), 0.3, 0.0015, 0.0095) +
                           area_of_ply(o, true, 0.3, 0.45, 0.012, 0.020);
       return skins + caps +
              0.0015 * (inner_face(o, false, 0.44, 0.0135).distance(inner_face(o, true, 0.46, 0.012)) +
                        inner_face(o, false, 0.6, 0.0015).distance(inner_face(o, true, 0.6, 0.012)));
     }}};
} // namespace



// Public airfoils, sharp and blunt, with thin and thick skins, caps that end anywhere and webs: all have valid meshes,
// whose cells do not overlap: the area of the plies is that of strips along the outline.
TEST(Airfoil, PublicAirfoilsHaveMeshes)
{
  using Points                                               = std::vector<dealii::Point<2>>;
  const std::vector<std::pair<std::string, Points>> outlines = {
    {"    set NACA = 0012\n    set NACA trailing edge = sharp\n", naca_points("0012", true)},
    {"    set NACA = 2418\n", naca_points("2418", false)},
    {reference_airfoil("s809"), points_of_reference("s809")},
    {reference_airfoil("du_97_w_300"), points_of_reference("du_97_w_300")},
    {reference_airfoil("ffa_w3_241"), points_of_reference("ffa_w3_241")}};
  std::string misses;
  for (const auto &[outline, points] : outlines)
    for (const auto &parts : parts_of_airfoils)
      {
        const std::string entries =
          outline + parts.entries + "    set Degree = 2\n    set Trailing edge material = soft\n";
        EXPECT_GT(cholesky_upper(values_of_airfoil(entries + "    set Elements = 6\n").stiffness).diagonal().minCoeff(), 0)
          << entries;
        // fine, as the points of an outline are nearer to one another than long elements see
        const double area =
          values_of_airfoil(entries + "    set Elements = 16\n    set Trailing edge from = " + parts.trailing_from +
                            "\n")
            .inertia(0, 0);
        const double miss = area / parts.area(AirfoilOutline(points, 1, 0.25)) - 1;
        misses += number_to_text("%.1e", miss) + " ";
        EXPECT_NEAR(miss, 0, 1e-4) << entries;
      }
  RecordProperty("misses of areas", misses);
}



// NACA 0012 has a nose of radius 1.58 % of the chord: a skin that is 99 % as thick has its area.
TEST(Airfoil, SkinsMayBeNearlyAsThickAsTheNoseIsRound)
{
  const std::string    entries = "    set NACA = 0012\n    set Material = skin\n    set Trailing edge material = soft\n"
                                 "    set Trailing edge from = 0.7\n    set Degree = 2\n    set Elements = 16\n"
                                 "    set Thickness = ";
  const AirfoilOutline outline = naca_outline("0012", false);
  const double         area    = values_of_airfoil(entries + "0.0156\n").inertia(0, 0);
  EXPECT_NEAR(area / strip_area(outline, outline.at(false, 0.7), outline.at(true, 0.7), 0.0156), 1, 1e-4);
}



// Between inner faces that slope against each other a web that leans has parallel faces: its area is its thickness
// times the length of its middle.
TEST(Airfoil, LeaningWebsHaveTheirThickness)
{
  const AirfoilOutline outline(points_of_reference("du_97_w_300"), 1, 0.25);
  for (const auto &[low, high] : {std::make_pair(0.6, 0.6), std::make_pair(0.5, 0.7), std::make_pair(0.7, 0.5)})
    {
      const double mass =
        values_of_airfoil(
          reference_airfoil("du_97_w_300") +
          "    set Material = weightless\n    set Thickness = 2 mm\n    set Degree = 1\n    set Webs = " +
          number_to_text(low) + ", " + number_to_text(high) + ", six\n")
          .inertia(0, 0);
      const double length = inner_face(outline, false, low, 0.002).distance(inner_face(outline, true, high, 0.002));
      EXPECT_NEAR(mass / (0.006 * length), 1, 1e-4) << low << ' ' << high;
    }
}



namespace
{
  /** The area within the inner faces: behind the middle of where the block of the trailing edge begins there is none.
   */
  double
  hollow_area(const AirfoilOutline &outline, const double trailing_from, const double lower, const double upper)
  {
    constexpr unsigned int        n = 40000;
    const double                  a = outline.at(false, trailing_from), b = outline.at(true, trailing_from);
    std::vector<dealii::Point<2>> ring;
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double s = a + (b - a) * i / n;
        ring.push_back(dealii::Point<2>(outline.place(s) + (s > outline.nose() ? upper : lower) * outline.inwards(s)));
      }
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
      {
        const auto &x = ring[i], &y = ring[(i + 1) % ring.size()];
        area += 0.5 * (x[0] * y[1] - x[1] * y[0]);
      }
    return area;
  }

  double
  whole_area(const AirfoilOutline &outline)
  {
    return hollow_area(outline, 1, 0, 0);
  }
} // namespace



// Skins of several plies that differ on both sides, an adhesive between them in the trailing edge: all areas together
// are that within the outline less the hollow. In a blunt edge each ply keeps the part of the height that it has in
// front.
TEST(Airfoil, DifferentSkinsMeetInTheTrailingEdge)
{
  const std::vector<std::pair<std::string, AirfoilOutline>> outlines = {
    {"    set NACA = 0012\n    set NACA trailing edge = sharp\n", naca_outline("0012", true)},
    {"    set NACA = 2418\n", naca_outline("2418", false)},
    {reference_airfoil("s809"), AirfoilOutline(points_of_reference("s809"), 1, 0.25)},
    {reference_airfoil("ffa_w3_241"), AirfoilOutline(points_of_reference("ffa_w3_241"), 1, 0.25)}};
  for (const auto &[text, outline] : outlines)
    {
      const auto mass = [&, text = text](const std::string &skin, const std::string &upper, const std::string &glue) {
        return values_of_airfoil(text + "    set Layup = " + skin + "\n    set Skins = upper, 0, 1, " + upper +
                                 "\n    set Trailing edge material = " + glue +
                                 "\n    set Trailing edge from = 0.85\n    set Trailing edge skins = true\n"
                                 "    set Elements = 16\n    set Degree = 2\n")
          .inertia(0, 0);
      };
      // two: 1.5 mm, three: 0.4, 0.6 and 1 mm, of which the second has no weight
      const double all = mass("two", "heavy three", "filler"), whole = whole_area(outline);
      EXPECT_NEAR(all / (whole - hollow_area(outline, 0.85, 0.0015, 0.002)), 1, 1e-4) << text;
      const double a = outline.at(false, 0.85), b = outline.at(true, 0.85),
                   block  = whole - hollow_area(outline, 0.85, 0, 0),
                   height = outline.place(a).distance(outline.place(b)),
                   lower  = strip_area(outline, a, outline.nose(), 0.0015),
                   upper  = strip_area(outline, outline.nose(), b, 0.0004) +
                           strip_area(outline, outline.nose(), b, 0.002) -
                           strip_area(outline, outline.nose(), b, 0.001),
                   behind = mass("two", "three", "weightless") - lower - upper, part = (0.0015 + 0.0014) / height;
      if (outline.trailing_edge() > 0)
        EXPECT_NEAR(behind / (part * block), 1, 0.03) << text;
      else
        {
          EXPECT_GT(behind, 0.97 * part * block) << text;
          EXPECT_LT(behind, 1.03 * (2 * part - part * part) * block) << text;
        }
    }
}



// Skins that run on into the trailing edge taper with it. Of a blunt block they have the part that they have of its
// height where it begins; of a sharp one a little more, as they meet in the tip. Fibres of both sides go on turning the
// same way: the coupling of tension and torsion is nearly that with a short block, and not that without what is behind.
TEST(Airfoil, SkinsRunOnIntoTheTrailingEdge)
{
  for (const std::string edge : {"blunt", "sharp"})
    {
      const auto values =
        [&](const std::string &layup, const std::string &from, const std::string &material, const bool on) {
          return values_of_airfoil("    set NACA = 0012\n    set NACA trailing edge = " + edge +
                                   "\n    set Layup = " + layup + "\n    set Trailing edge from = " + from +
                                   "\n    set Trailing edge material = " + material +
                                   "\n    set Trailing edge skins = " + (on ? "true" : "false") +
                                   "\n    set Elements = 8\n    set Degree = 2\n");
        };
      const auto mass = [&](const std::string &material, const bool on) {
        return values("two", "0.8", material, on).inertia(0, 0);
      };
      const double whole = mass("filler", false), front = mass("soft", false);
      EXPECT_NEAR(mass("filler", true), whole, 1e-12 * whole);
      const auto   outline = naca_outline("0012", edge == "sharp");
      const double height  = outline.place(outline.at(false, 0.8)).distance(outline.place(outline.at(true, 0.8))),
                   part = 2 * 0.0015 / height, found = (mass("soft", true) - front) / (whole - front);
      EXPECT_GT(found, 0.97 * part) << edge;
      EXPECT_LT(found, 1.03 * (edge == "sharp" ? 2 * part - part * part : part)) << edge;
      const double whole_skin = values("helix", "0.96", "soft", true).stiffness(0, 3),
                   run_on     = values("helix", "0.7", "soft", true).stiffness(0, 3),
                   cut        = values("helix", "0.7", "soft", false).stiffness(0, 3);
      EXPECT_NEAR(run_on / whole_skin, 1, 0.08) << edge;
      EXPECT_LT(cut / whole_skin, 0.85) << edge;
    }
}



// A side with a kink of 38° at 0.6: a web whose face is there is refused with place and picture, one beside it is
// meshed.
TEST(Airfoil, WebAtAKink)
{
  const std::string file = ::testing::TempDir() + "kinked.dat";
  std::ofstream     out(file);
  out << "kinked\n";
  for (int i = 0; i <= 20; ++i)
    out << 1 - 0.02 * i << ' ' << 0.01 * i << '\n'; // straight from the sharp edge to (0.6, 0.2)
  for (int i = 1; i <= 60; ++i)
    {
      const double x = 0.6 * std::pow(1 - i / 60., 2);
      out << x << ' ' << 0.2066 * std::sqrt(x) + (0.2 - 0.2066 * std::sqrt(0.6)) / 0.6 * x << '\n';
    }
  for (int i = 1; i <= 60; ++i)
    {
      const double x = std::pow(i / 60., 2);
      out << x << ' ' << -0.1 * (std::sqrt(x) - x) << '\n';
    }
  out.close();
  const auto old = std::filesystem::current_path();
  std::filesystem::current_path(::testing::TempDir());
  const auto with_web = [&](const std::string &web) {
    return "    set Coordinates = " + file +
           "\n    set Material = weightless\n    set Thickness = 2 mm\n    set Degree = 2\n    set Webs = " + web +
           "\n";
  };
  const AirfoilOutline outline(read_airfoil(file), 1, 0.25);
  ASSERT_EQ(outline.kinks().size(), 1u);
  EXPECT_NEAR(outline.x_of(outline.place(outline.kinks()[0])), 0.6, 1e-6);
  for (const std::string at : {"0.6", "0.5995"})
    {
      std::filesystem::remove("section_s.svg");
      const std::string text = complaint_of(airfoil_model(with_web(at + ", two")));
      for (const std::string wanted : {"<s>", "at x/c = ", "section_s.svg"})
        EXPECT_NE(text.find(wanted), std::string::npos) << at << ": " << text;
      EXPECT_GT(std::filesystem::file_size("section_s.svg"), 1000u);
    }
  for (const double x : {0.59, 0.61})
    {
      const double h = inner_face(outline, true, x, 0.002).distance(inner_face(outline, false, x, 0.002));
      EXPECT_NEAR(values_of_airfoil(with_web(std::to_string(x) + ", two")).inertia(0, 0) / (0.0015 * h), 1, 1e-3) << x;
    }
  std::filesystem::current_path(old);
}



TEST(Airfoil, SaysWhatIsWrong)
{
  const auto old = std::filesystem::current_path();
  std::filesystem::current_path(::testing::TempDir());
  const auto says = [](const std::string &entries, const std::string &wanted) {
    const std::string text = complaint_of(airfoil_model(entries));
    EXPECT_NE(text.find(wanted), std::string::npos) << entries << text;
    EXPECT_NE(text.find(".prm:"), std::string::npos) << text;
  };
  const std::string naca = "    set NACA = 0012\n    set Material = skin\n";
  std::filesystem::remove("section_s.svg");
  says(naca + "    set Thickness = 60 mm\n", "behind x/c = 0.3");
  EXPECT_GT(std::filesystem::file_size("section_s.svg"), 1000u);
  says(naca + "    set Thickness = 60 mm\n", "section_s.svg");
  says(naca, "<Thickness>");
  says(naca + "    set Thickness = 1 mm\n    set Spar caps = both, 0.3, 0.5, cab\n", "did you mean <cap>");
  says(naca + "    set Thickness = 1 mm\n    set Spar caps = both, 0.5, 0.3, cap\n", "from < to");
  says(naca + "    set Thickness = 1 mm\n    set Spar caps = uper, 0.3, 0.5, cap\n", "upper");
  says(naca + "    set Thickness = 1 mm\n    set Spar caps = both, 30, 50, cap\n", "fractions of the chord");
  says(naca + "    set Thickness = 1 mm\n    set Webs = 0.3, web; 0.302, web\n", "overlap");
  says(naca + "    set Thickness = 5 mm\n    set Webs = 0.995, web\n", "block of the trailing edge begins");
  says(naca + "    set Thickness = 5 mm\n    set Skins = both, 0.995, 1, cap\n", "block of the trailing edge begins");
  says(naca + "    set Thickness = 1 mm\n    set Skins = both, 0.5, 0.95, cap\n    set Trailing edge from = 0.9\n"
              "    set Trailing edge skins = true\n",
       "ends at x/c = 0.95 of the lower side, in the block of the trailing edge, which begins at x/c = 0.9");
  says(naca +
         "    set Thickness = 10 mm\n    set Spar caps = both, 0.3, 0.5, thick; both, 0.3, 0.5, thick; both, 0.3, 0.5, "
         "thick; both, 0.3, 0.5, thick\n",
       "overlap");
  says(naca + "    set Thickness = 1 mm\n    set Webs = 0.3, 0.5, web; 0.5, 0.3, web\n", "web 1 and web 2 cross");
  says(naca + "    set Thickness = 1 mm\n    set Spar caps = lower, 0.3, 0.48, thick\n    set Webs = 0.5, 0.1, web\n",
       "web 1 runs into the skin");
  says("    set NACA = 12\n    set Material = skin\n    set Thickness = 1 mm\n", "four-digit");
  says("    set NACA = 0012\n    set Layup = two\n", "<Trailing edge material>");
  says("    set Material = skin\n    set Thickness = 1 mm\n", "<Coordinates>");
  says(naca + "    set Thickness = 1 mm\n    set Nose to = 0.1\n", "<Nose material>");
  std::filesystem::current_path(old);

  const auto file = [](const std::string &text) {
    const std::string name = ::testing::TempDir() + "airfoil.dat";
    std::ofstream(name) << text;
    return "    set Coordinates = " + name + "\n    set Material = skin\n    set Thickness = 1 mm\n";
  };
  says(file("title\n1 0\n0.5 0.1\n0.5 x\n"), "airfoil.dat:4");
  says(file("title\n100 0\n50 10\n"), "fractions of its chord");
  says(file("title\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n"), "eight points");
  says(file("1 0\n0.8 0.1\n0.5 0.1\n0.05 0.06\n0 0\n0.05 -0.06\n0.5 0.11\n0.8 -0.05\n1 0\n"), "cross");
}
