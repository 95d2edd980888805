/*
 * Problem:   equilibrium of a large model under small loads: 100 cantilevers, 22 000 unknowns
 * Reference: F L³/(3 EI) + F L/GA, to the square of the slope; the same with the factors made anew
 */

#include <samara/solvers/newton.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  std::string
  many_cantilevers(const unsigned int n, const double force)
  {
    std::string bodies, joints, loads;
    for (unsigned int i = 0; i < n; ++i)
      {
        const std::string number = std::to_string(i), name = "rod " + number, y = std::to_string(0.1 * i);
        bodies += "subsection " + name + "\n set Type = beam\n set Points = 0, " + y + ", 0; 1, " + y +
                  ", 0\n set Section = s\n set Elements = 12\n set Degree = 3\nend\n";
        joints += "subsection clamp " + number + "\n set Type = rigid\n set Body A = ground\n set Body B = " + name +
                  ".start\nend\n";
        loads += "subsection load " + number + "\n set Type = point load\n set At = " + name +
                 ".end\n set Force = 0, 0, " + std::to_string(force) + "\nend\n";
      }
    return "subsection Sections\nsubsection s\n set Type = engineering constants\n set EA = 1e6\n set GA2 = 1e5\n"
           " set GA3 = 1e5\n set GJ = 100\n set EI2 = 100\n set EI3 = 100\n set Mass = 1\nend\nend\nsubsection Bodies\n" +
           bodies + "end\nsubsection Joints\n" + joints + "end\nsubsection Loads\n" + loads + "end\n";
  }
} // namespace



// A factorisation of a large shell costs more than all else: where corrections are small it is kept.
TEST(KeptFactors, UnderASmallLoad)
{
  const double force = 1;
  const Scene  scene(many_cantilevers(100, force));
  ASSERT_GT(scene.system.size(), 20000u);
  const auto solver = make_solver(scene.system.layout.pattern);
  Newton     newton(scene.system, *solver);
  State      state  = scene.system.reference();
  const auto result = newton.solve(state);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_LE(solver->n_factorizations, 2u);
  EXPECT_GE(result.iterations, 3u);
  const double deflection = force / 300 + force / 1e5;
  EXPECT_NEAR(scene.input.model.probe("rod 50.end.displacement z").value(state), deflection, 3e-5 * deflection);

  // it is an equilibrium: with new factors there is nothing left to correct
  const auto again = newton.solve(state);
  EXPECT_TRUE(again.converged);
  EXPECT_LE(again.iterations, 2u);
}



// A large load bends by much, and the factors of the start would take too many iterations.
TEST(KeptFactors, NotUnderALargeLoad)
{
  const Scene scene(many_cantilevers(100, 50));
  const auto  solver = make_solver(scene.system.layout.pattern);
  Newton      newton(scene.system, *solver);
  State       state  = scene.system.reference();
  const auto  result = newton.solve(state);
  ASSERT_TRUE(result.converged) << result.reason;
  EXPECT_GE(solver->n_factorizations, 2u);
  EXPECT_LE(result.iterations, 15u);
}



// Pivots of a matrix that had gone astray, as that of a step without a solution, are none for the one of the next.
TEST(KeptFactors, NotTheirPivotsAfterAStrayMatrix)
{
  auto pattern          = std::make_shared<Pattern>();
  pattern->column_start = {0, 2, 4};
  pattern->rows         = {0, 1, 0, 1};
  const auto   solver   = make_solver(pattern, Library::klu);
  SparseMatrix stray(pattern), A(pattern);
  stray.values = {1, 1, 0, 1e-60, 0}; // by columns
  A.values     = {1e-15, 1, 1, 1, 0};
  solver->factorize(stray);
  solver->factorize(A);
  double b[] = {1, 2}; // of the solution (1, 1), but for 1e-15
  solver->solve(b);
  EXPECT_NEAR(b[0], 1, 1e-14);
  EXPECT_NEAR(b[1], 1, 1e-14);
}
