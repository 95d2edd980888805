/*
 * Problem:   airfoils with skins thicker than their nose is round: the inner face has a corner there
 * Reference: the points nearer to NACA's outline than the skin is thick, by its equation; the section of a blade with
 * MH-104 of Chen, Yu & Capellaro, analysed by PreVABS and VABS: tests/reference/sections/mh_104_blade.csv
 */

#include <samara/rotation/matrix6.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "stiffness.h"

using namespace samara;

namespace
{
  /** As published: five materials, five layups, webs whose rear faces are at 20 and 50 % of the chord. Plies turn here
   * the other way round the section. */
  const std::string mh_104 = R"(
subsection Materials
  subsection UD
    set Type    = orthotropic
    set E1      = 37 GPa
    set E2      = 9 GPa
    set E3      = 9 GPa
    set G12     = 4 GPa
    set G13     = 4 GPa
    set G23     = 4 GPa
    set nu12    = 0.28
    set nu13    = 0.28
    set nu23    = 0.28
    set Density = 1860 kg/m^3
  end
  subsection DB
    set Type    = orthotropic
    set E1      = 10.3 GPa
    set E2      = 10.3 GPa
    set E3      = 10.3 GPa
    set G12     = 8 GPa
    set G13     = 8 GPa
    set G23     = 8 GPa
    set nu12    = 0.3
    set nu13    = 0.3
    set nu23    = 0.3
    set Density = 1830 kg/m^3
  end
  subsection gelcoat
    set Type    = orthotropic
    set E1      = 10 Pa
    set E2      = 10 Pa
    set E3      = 10 Pa
    set G12     = 1 Pa
    set G13     = 1 Pa
    set G23     = 1 Pa
    set nu12    = 0.3
    set nu13    = 0.3
    set nu23    = 0.3
    set Density = 1830 kg/m^3
  end
  subsection nexus
    set Copy of = DB
    set Density = 1664 kg/m^3
  end
  subsection balsa
    set Type    = orthotropic
    set E1      = 10 MPa
    set E2      = 10 MPa
    set E3      = 10 MPa
    set G12     = 0.2 MPa
    set G13     = 0.2 MPa
    set G23     = 0.2 MPa
    set nu12    = 0.3
    set nu13    = 0.3
    set nu23    = 0.3
    set Density = 128 kg/m^3
  end
end
subsection Layups
  subsection nose
    set Plies = gelcoat, 0, 0.381 mm; nexus, 0, 0.51 mm; DB, -20, 18*0.53 mm
  end
  subsection front
    set Plies = gelcoat, 0, 0.381 mm; nexus, 0, 0.51 mm; DB, -20, 33*0.53 mm
  end
  subsection cap
    set Plies = gelcoat, 0, 0.381 mm; nexus, 0, 0.51 mm; DB, -20, 17*0.53 mm; UD, -30, 38*0.53 mm; balsa, 0, 3.125 mm; UD, -30, 37*0.53 mm; DB, -20, 16*0.53 mm
  end
  subsection tail
    set Plies = gelcoat, 0, 0.381 mm; nexus, 0, 0.51 mm; DB, -20, 17*0.53 mm; balsa, 0, 3.125 mm; DB, 0, 16*0.53 mm
  end
  subsection web
    set Plies = UD, 0, 38*0.53 mm; balsa, 0, 3.125 mm; UD, 0, 38*0.53 mm
  end
end
subsection Sections
  subsection blade
    set Type        = airfoil
    set Coordinates = )" SAMARA_SOURCE_DIR "/" R"(tests/reference/sections/airfoil_mh_104.csv
    set Chord       = 1.9 m
    set Origin      = 0.25
    set Layup       = nose
    set Skins       = upper, 0.00405394, 0.11473993, front; lower, 0.00682453, 0.12695671, front; upper, 0.11473993, 0.53661595, cap; lower, 0.12695671, 0.5429521, cap; upper, 0.53661595, 1, tail; lower, 0.5429521, 1, tail
    set Webs        = 0.1886, web; 0.4886, web
    set Trailing edge material = DB
    set Elements    = 40
    set Degree      = 2
  end
end
)";

  const std::string skins_of_noses = R"(
subsection Materials
  subsection skin
    set Type          = isotropic
    set E             = 70e9
    set Poisson ratio = 0.3
    set Density       = 1
  end
  subsection soft
    set Copy of = skin
    set E       = 1e6
    set Density = 0
  end
end
subsection Layups
  subsection thin
    set Plies = skin, 0, 2 mm
  end
  subsection two
    set Plies = skin, 0, 5 mm; skin, 0, 15 mm
  end
end
)";

  /** NACA 0012 of chord 1, whose mass is the area of its skin up to x/c = 0.7. */
  std::string
  naca_nose(const std::string &entries)
  {
    return skins_of_noses + "subsection Sections\n  subsection s\n    set Type = airfoil\n    set Chord = 1 m\n" +
           "    set NACA = 0012\n    set Trailing edge material = soft\n    set Trailing edge from = 0.7\n" +
           "    set Degree = 2\n    set Elements = 16\n" + entries + "  end\nend\n";
  }

  const std::string a_body = "subsection Bodies\n  subsection b\n    set Type = rigid body\n    set Mass = 1\n"
                             "    set Inertia = 1, 1, 1\n  end\nend\n";

  SectionValues
  values_of_nose(const std::string &model, const std::string &name)
  {
    const Scene scene(model + a_body);
    return scene.input.model.find<Section>(name, "section").at(0, Vector3::Zero());
  }

  /** A point of the upper side of NACA 0012 at x = r², and the one @p depth below it along the normal. */
  std::array<dealii::Point<2>, 2>
  naca_points_at(const double r, const double depth)
  {
    const double x = r * r, y = 0.6 * (0.2969 * r - x * (0.1260 + x * (0.3516 - x * (0.2843 - x * 0.1015)))),
                 dy = 0.6 * (0.2969 - 2 * r * (0.1260 + x * (2 * 0.3516 - x * (3 * 0.2843 - x * 4 * 0.1015)))),
                 dx = 2 * r, length = std::hypot(dx, dy);
    return {{{x, y}, {x + depth * dy / length, y - depth * dx / length}}};
  }

  /** The area between the outline and what lies deeper than @p depth, to x = 0.7, both sides. */
  double
  area_of_skin(const double depth)
  {
    // inner faces of both sides meet on the chord
    double front = 0, back = std::sqrt(0.5);
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double r                                      = 0.5 * (front + back);
        (naca_points_at(r, depth)[1][1] < 0 ? front : back) = r;
      }
    const unsigned int            n = 20000;
    std::vector<dealii::Point<2>> ring;
    for (unsigned int i = 0; i <= n; ++i)
      ring.push_back(naca_points_at(std::sqrt(0.7) * i / n, depth)[0]);
    for (unsigned int i = 0; i <= n; ++i)
      ring.push_back(naca_points_at(std::sqrt(0.7) + (back - std::sqrt(0.7)) * i / n, depth)[1]);
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
      {
        const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
        twice += a[0] * b[1] - a[1] * b[0];
      }
    return std::abs(twice); // two halves
  }
} // namespace



// The radius of the nose is 1.58 % of the chord. The inner face of a thicker skin has a corner on the chord.
TEST(AirfoilNoses, SkinsThickerThanTheNoseIsRoundHaveTheirArea)
{
  for (const double thickness : {0.01585, 0.016, 0.017, 0.02, 0.025, 0.03})
    {
      const SectionValues values =
        values_of_nose(naca_nose("    set Material = skin\n    set Thickness = " + std::to_string(thickness) + "\n"),
                       "s");
      EXPECT_NEAR(values.inertia(0, 0) / area_of_skin(thickness), 1, 2e-4) << thickness;
      EXPECT_GT(cholesky_upper(values.stiffness).diagonal().minCoeff(), 0);
      // symmetric: no coupling of flap with lag, nor of extension with flap
      EXPECT_NEAR(
        difference(values.stiffness,
                   Matrix6(values.stiffness.cwiseProduct(
                     (values.stiffness.array().abs() > 1e-7 * values.stiffness.maxCoeff()).matrix().cast<double>()))),
        0,
        1e-4)
        << thickness;
    }
}



// The nose of MH-104 has a radius of 10.3 mm where it is tightest, and a skin of 10.431 mm. Of the trailing edge, where
// PreVABS lets skins overlap, the shear stiffness along 3 and what couples with it take note.
TEST(AirfoilNoses, BladeWithMH104IsThatOfPreVABS)
{
  const SectionValues values   = values_of_nose(mh_104, "blade");
  const auto          table    = reference_rows("sections/mh_104_blade.csv");
  const char *const   names[6] = {"F1", "F2", "F3", "M1", "M2", "M3"};
  // axes 1 and 2 there are opposite: a half turn about 3
  const double turned[6] = {1, 1, -1, 1, 1, -1};
  Matrix6      published;
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int j = 0; j < 6; ++j)
      published(i, j) = turned[i] * turned[j] * std::stod(table[i].at(names[j]));
  const Vector6 size   = published.diagonal().cwiseSqrt();
  const Matrix6 misses = ((values.stiffness - published).array() / (size * size.transpose()).array()).matrix();
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int j = 0; j < 6; ++j)
      EXPECT_NEAR(misses(i, j), 0, i == 2 || j == 2 ? 0.1 : 0.02) << names[i] << ' ' << names[j];
}



TEST(AirfoilNoses, SaysWhichPlyReachesTheRadiusAndWhatWouldDo)
{
  const auto old = std::filesystem::current_path();
  std::filesystem::current_path(::testing::TempDir());
  const auto says = [](const std::string &entries, const std::vector<std::string> &wanted) {
    const std::string text = complaint_of(naca_nose(entries) + a_body);
    for (const std::string &piece : wanted)
      EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
  };
  // a skin that ends before its inner face meets itself
  says("    set Layup = thin\n    set Skins = both, 0, 0.003, two\n",
       {"the skin is 0.02 m thick at x/c = ",
        "is within ply 2 of 2",
        "Let it be thinner, or one skin without webs from x/c = "});
  says("    set Material = skin\n    set Thickness = 62 mm\n", {"the skins overlap"});
  std::filesystem::current_path(old);
}
