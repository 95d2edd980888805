/*
 * Problem:   free plates, which have a layer along their edges in which the shear strain has a curl, as thick as the
 *            plate over √10: a square of thickness 0.2, and a strip 4 × 0.2 × 0.04 in torsion
 * Reference: Mindlin's plate by Rayleigh and Ritz (tests/reference/shells/mindlin_free_plate.csv); the strip by
 *            Saint-Venant's torsion of the rectangle
 * Expected:  order 2p where elements are as small as the layer; the strip to 5e-4, of which Saint-Venant knows nothing
 *            at its ends
 */

#include "../reference.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  double
  frequency_of_free_plate(const unsigned int row)
  {
    return std::stod(reference_rows("shells/mindlin_free_plate.csv").at(row).at("omega"));
  }

  /** Relative error of the first twist of the square: a quarter, on whose two inner sides nothing deflects. */
  double
  error_of_first_twist(const unsigned int degree, const unsigned int elements_of_quarter)
  {
    ShellModel model;
    model.patches   = "0.5*u, 0.5*v, 0";
    model.degree    = degree;
    model.elements  = std::to_string(elements_of_quarter) + ", " + std::to_string(elements_of_quarter);
    model.thickness = 0.2;
    model.joints    = support("x", "s.edge u0", "displacement 1, displacement 2, displacement 3, rotation 1") +
                   support("y", "s.edge v0", "displacement 1, displacement 2, displacement 3, rotation 2");
    model.top = "set Analyses = modal\nsubsection Modal\n set Modes = 1\nend\n";
    Scene scene(model.text());
    return std::abs(scene.modes().at(0).frequency() / frequency_of_free_plate(0) - 1);
  }
} // namespace



// Orders found: 3.6 and 3.9, 5.4, 6.9, for degree 2, 3, 4.
TEST(FreeEdges, PlateOfMindlinToOrderOfTwiceTheDegree)
{
  struct Meshes
  {
    unsigned int degree, coarse, fine;
    double       least_order, largest_error;
  };
  for (const Meshes &m : {Meshes{2, 8, 16, 3.7, 5.5e-6}, Meshes{3, 4, 8, 5.2, 6e-7}, Meshes{4, 4, 8, 6.5, 6e-9}})
    {
      const double coarse = error_of_first_twist(m.degree, m.coarse), fine = error_of_first_twist(m.degree, m.fine);
      EXPECT_GT(std::log2(coarse / fine), m.least_order) << m.degree << ": " << coarse << ' ' << fine;
      EXPECT_LT(fine, m.largest_error) << m.degree;
    }
}



TEST(FreeEdges, WholePlateWithNothingHeld)
{
  ShellModel model;
  model.patches   = "u, v, 0";
  model.degree    = 4;
  model.elements  = "4, 4";
  model.thickness = 0.2;
  model.top       = "set Analyses = modal\nsubsection Modal\n set Modes = 9\nend\n";
  Scene       scene(model.text());
  const auto &modes = scene.modes();
  ASSERT_EQ(modes.size(), 9u);
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_TRUE(modes[i].is_free()) << i;
  for (unsigned int i = 6; i < 9; ++i)
    EXPECT_NEAR(modes[i].frequency() / frequency_of_free_plate(i - 6), 1, 5e-5) << i;
}



// GJ of the rectangle: J = b h³/3 (1 − 0.630 h/b) for b = 5 h, so ω = π/l √(GJ/(ρ I_p)).
TEST(FreeEdges, StripInTorsion)
{
  ShellModel model;
  model.patches   = "4*u, 0.2*v - 0.1, 0";
  model.degree    = 4;
  model.elements  = "8, 4";
  model.thickness = 0.04;
  model.E         = 2.6;
  model.top       = "set Analyses = modal\nsubsection Modal\n set Modes = 16\nend\n";
  Scene        scene(model.text());
  const double b = 0.2, h = 0.04, J = b * h * h * h / 3 * (1 - 0.630249 * h / b), polar = b * h * (b * b + h * h) / 12,
               omega = M_PI / 4 * std::sqrt(J / polar);
  EXPECT_NEAR(omega, 0.28799, 1e-5); // of what the test is about
  double nearest = 1;                // of the relative differences; bending is elsewhere
  for (const auto &mode : scene.modes())
    nearest = std::min(nearest, std::abs(mode.frequency() / omega - 1));
  EXPECT_LT(nearest, 5e-4);
}
