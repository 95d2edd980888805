/*
 * Problem:   modes of shells without damping, by the second-order form: half the unknowns
 * Reference: Kirchhoff's simply supported square plate, whose frequencies come in pairs; the first-order form
 */

#include <samara/solvers/undamped.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  std::string
  undamped_plate(const std::string &entries, const std::string &behind = "")
  {
    return "set Analyses = modal\nsubsection Bodies\n subsection plate\n set Type = shell\n set Elements = 6, 6\n"
           " set E = 70e9\n set Poisson ratio = 0.3\n set Density = 2700\n" +
           entries + " end\nend\n" + behind + "subsection Modal\n set Modes = 8\nend\n";
  }

  const std::string simply_supported =
    "subsection Joints\n subsection sides\n set Type = support\n set Fixed = displacement 1, displacement 2, displacement 3"
    "\n set Along = plate.edge u0, plate.edge u1, plate.edge v0, plate.edge v1\n end\nend\n";

  struct UndampedMotion
  {
    Scene         scene;
    Linearization motion;
    ShiftInvert   op;

    UndampedMotion(const std::string &text, const double shift, const std::vector<Vector3> &spins = {})
      : scene(text)
      , motion(scene.system, scene.context.state, spins)
      , op(motion)
    {
      op.set(shift, shift);
    }
  };

  /** The first-order form: KLU's factors are not symmetric. */
  std::vector<Mode>
  modes_of_first_order(const LinearMotion &motion)
  {
    use_library(Library::klu);
    const auto modes = find_modes(motion, 8, {});
    use_library(Library::automatic);
    return modes.found;
  }

  void
  expect_modes_of_first_order(const std::string &text, const double shift)
  {
    constexpr double error = 1e-8; // round-off, as K11 + K22 has 1e-8 of the stiffness of other curvatures

    const UndampedMotion plate(text, shift);
    ASSERT_TRUE(plate.op.is_undamped());
    const auto modes = find_modes(plate.motion, 8, {}).found, others = modes_of_first_order(plate.motion);
    ASSERT_EQ(modes.size(), others.size());
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        EXPECT_NEAR(modes[i].frequency(), others[i].frequency(), 1e-9 * others[i].frequency()) << i;
        EXPECT_LT(modes[i].error, error) << i;
        EXPECT_EQ(modes[i].is_free(), others[i].is_free()) << i;
      }
  }
} // namespace



// ω = π² (m² + n²) √(D/ρh): 2, 5, 5, 8, 10, 10, 13, 13. Of h = 1e-3 shear and rotary inertia take 1e-5; of membranes
// and drilling nothing is so low.
TEST(UndampedModes, OfASquarePlateComeInPairs)
{
  const double         D = 70e9 * 1e-9 / (12 * 0.91), unit = M_PI * M_PI * std::sqrt(D / 2.7);
  const UndampedMotion plate(undamped_plate(" set Patches = u, v, 0\n set Thickness = 1e-3\n", simply_supported), unit);
  ASSERT_TRUE(plate.op.is_undamped());
  const auto modes = undamped_modes(plate.op, 7); // half of the last pair: the other half comes along
  ASSERT_TRUE(modes);
  ASSERT_EQ(modes->size(), 8u);
  const double expected[] = {2, 5, 5, 8, 10, 10, 13, 13};
  for (unsigned int i = 0; i < 8; ++i)
    EXPECT_NEAR(std::sqrt((*modes)[i].square), expected[i] * unit, 3e-3 * expected[i] * unit) << i;
  EXPECT_EQ(plate.op.mixed().n_squares_below(std::pow(7 * unit, 2)), 3u);
  EXPECT_EQ(plate.op.mixed().n_squares_below(std::pow(9 * unit, 2)), 4u);
  EXPECT_EQ(plate.op.mixed().n_squares_below(std::pow(11 * unit, 2)), 6u);
}



// A curved one that is thin, where BᵀCB loses digits; one that flies.
TEST(UndampedModes, AreThoseOfTheFirstOrderForm)
{
  expect_modes_of_first_order(undamped_plate(" set Patches = u, v, 0.1*u*(1-u)\n set Thickness = 1e-4\n",
                                             simply_supported),
                              1.);
  expect_modes_of_first_order(undamped_plate(" set Patches = u, 0.9*v, 0.1*u*(1-u)\n set Thickness = 1e-2\n"), 10.);
}



// What is damped, or turns, or is small goes the other way.
TEST(UndampedModes, AreLeftToTheFirstOrderFormOtherwise)
{
  const std::string geometry = " set Patches = u, v, 0\n set Thickness = 1e-2\n";
  EXPECT_FALSE(
    UndampedMotion(undamped_plate(geometry + " set Damping = 1e-4\n", simply_supported), 10.).op.is_undamped());
  const UndampedMotion still(undamped_plate(geometry), 10.);
  EXPECT_TRUE(still.op.is_undamped());
  const std::vector<Vector3> spins(still.scene.system.layout.n_nodes, Vector3(0, 0, 3));
  EXPECT_FALSE(UndampedMotion(undamped_plate(geometry), 10., spins).op.is_undamped());
}



// Several right-hand sides at once are solved as one by one.
TEST(UndampedModes, ColumnsAreSolvedAsOneByOne)
{
  const UndampedMotion  plate(undamped_plate(" set Patches = u, v, 0.1*u*v\n set Thickness = 1e-2\n", simply_supported),
                             10.);
  const unsigned int    n        = plate.op.mixed().size();
  const Eigen::MatrixXd b        = Eigen::MatrixXd::Random(n, 3);
  Eigen::MatrixXd       together = b, alone = b, image(n, 3);
  plate.op.mixed().solve(together.data(), 3);
  for (unsigned int c = 0; c < 3; ++c)
    plate.op.mixed().solve(alone.col(c).data());
  EXPECT_LT((together - alone).norm(), 1e-8 * alone.norm());
  plate.op.mixed().multiply(together.data(), image.data(), 3);
  EXPECT_LT((image - b).norm(), 1e-6 * b.norm());
}
