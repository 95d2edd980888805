// A body on a hinge with a soft spring, pulled by a dead force: k θ = A sin(φ − θ). Of its many equilibria, the one
// that the growing load leads to is the only root between zero and φ, however many load steps there are.

#include <samara/analysis/static.h>
#include <samara/base/text.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace samara;

namespace
{
  /** A body a metre from a hinge about z, on which a force of @p A N acts that is turned by @p phi from the arm. */
  std::string
  hinged_body(const std::string &rotation, const double A, const double phi, const unsigned int n_steps)
  {
    return "set Analyses = static\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n"
           " set Inertia = .1, .1, .1\n set Position = 1, 0, 0\n end\nend\n"
           "subsection Joints\n subsection h\n set Type = revolute\n set Body A = ground\n set Body B = b\n"
           " set Position = 0, 0, 0\n set Axis = 0, 0, 1\n subsection rotation\n " +
           rotation +
           "\n end\n end\nend\nsubsection Loads\n subsection l\n set Type = point load\n set At = b\n"
           " set Force = " +
           number_to_text(A * std::cos(phi)) + ", " + number_to_text(A * std::sin(phi)) +
           ", 0\n end\nend\nsubsection Static\n set Load steps = " + std::to_string(n_steps) + "\nend\n";
  }

  /** k θ − A sin(φ − θ) is negative at zero, positive at φ, and convex between. */
  double
  exact(const double k, const double A, const double phi)
  {
    double low = 0, high = phi;
    while (high - low > 1e-14)
      {
        const double middle                                    = 0.5 * (low + high);
        (k * middle < A * std::sin(phi - middle) ? low : high) = middle;
      }
    return low;
  }
} // namespace



// Successful load steps double, so that a fine start alone does not keep them small. Forces nearly against the arm give
// a path that turns by half a turn within a small part of the load, next to others that go the other way.
TEST(SoftHinge, LoadStepsDoNotJump)
{
  for (const auto &[k, A, phi] : {std::array<double, 3>{0.31013, 17.7, 3.08},
                                  {0.317, 9.26, 3.13996},
                                  {2.879, 25.4, 3.1402},
                                  {0.1016, 11.9, 3.027},
                                  {0.0022, 13.742, 3.13792},
                                  {0.0033, 10.2476, 3.1386},
                                  {0.0011079, 17.8267, 3.1401227}})
    for (const unsigned int n : {1, 4, 64, 256})
      {
        Scene scene(hinged_body("set Spring = " + number_to_text(k), A, phi, n));
        EXPECT_NEAR(scene.equilibrium().coordinates[0], exact(k, A, phi), 1e-8)
          << "phi " << phi << ", " << n << " steps";
      }
}



// What is prescribed cannot go astray: a turn in one step. Rows in the axes of the body want a few steps for many turns.
TEST(SoftHinge, PrescribedTurnsNeedNoSteps)
{
  for (const auto &[turn, n_steps] : {std::pair(1.5, 1u), {6., 1u}, {20., 4u}})
    {
      Scene scene(hinged_body("set Prescribed = " + number_to_text(turn), 1, 1, 1));
      EXPECT_NEAR(scene.equilibrium().coordinates[0], turn, 1e-9);
      EXPECT_LE(scene.analysis<StaticAnalysis>().n_steps, n_steps) << turn;
    }
}



// A spring that is unstressed far away acts at once: a jump at the start is none from a path to another.
TEST(SoftHinge, SpringsWoundAtTheStart)
{
  Scene scene(hinged_body("set Spring = 10\n set Rest = 2.5", 1e-9, 1, 1));
  EXPECT_NEAR(scene.equilibrium().coordinates[0], 2.5, 1e-8);
}
