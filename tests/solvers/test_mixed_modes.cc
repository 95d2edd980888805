// Modes with section forces as unknowns: no digit is lost between soft bending and stiff shear, at any size of the
// model.
//
// Reference: the same discrete problem, its double numbers taken as exact, in 40 decimal digits (straight_beam.h). With
// K = BᵀCB formed, 32 quartic elements and GA L²/EI = 1e10 were 2e-3 off, 1e14 all lost (ε GA L²/EI n²).

#include <samara/solvers/arnoldi.h>
#include <samara/solvers/eigen.h>
#include <samara/solvers/shift_invert.h>

#include <gtest/gtest.h>

#include "straight_beam.h"

using namespace samara;

namespace
{
  double
  guess(const double ratio, const double W)
  {
    return W > 0 ? 13.17 : ratio > 1e3 ? 3.516 : 3.437;
  }

  void
  expect_exact(const StraightBeam &beam, const double near, const std::string &name)
  {
    const LinearMotion motion = beam.motion();
    const Modes        modes  = find_modes(motion, 4, {});
    ASSERT_EQ(modes.found.size(), 4u) << name;
    const double exact = static_cast<double>(beam.exact_frequency(Exact(near)));
    EXPECT_NEAR(modes.found[0].frequency() / exact, 1., 2e-14) << name;
    EXPECT_LT(modes.found[0].error, 1e-12) << name;
    EXPECT_LT(std::abs(modes.found[0].damping_ratio()), 1e-13) << name;
  }

  std::string
  title_of(const unsigned int n, const unsigned int p, const double ratio, const double W)
  {
    std::ostringstream text;
    text << n << " elements, p = " << p << ", GA L^2/EI = " << ratio << ", W = " << W;
    return text.str();
  }
} // namespace



TEST(MixedModes, AtAnyRatioOfStiffnesses)
{
  const std::pair<unsigned int, unsigned int> meshes[] = {{8, 1}, {8, 3}, {32, 2}, {32, 4}};
  for (const auto &[n, p] : meshes)
    for (const double ratio : {1e2, 1e6, 1e10, 1e14})
      for (const double W : {0., 12.})
        expect_exact(StraightBeam(n, p, ratio, W), guess(ratio, W), title_of(n, p, ratio, W));
}



TEST(MixedModes, OnFineMeshes)
{
  for (const unsigned int p : {1, 4})
    for (const double ratio : {1e2, 1e14})
      expect_exact(StraightBeam(256, p, ratio, 12.), ratio > 1e3 ? 13.17 : 12.6, title_of(256, p, ratio, 12.));
}



TEST(MixedModes, AtAnySize)
{
  for (const double L : {1e-9, 1e-6, 1e-3, 1e3})
    for (const double W : {0., 12.})
      expect_exact(StraightBeam(8, 4, 2e4, W, L), guess(2e4, W) / (L * L), "L = " + std::to_string(std::log10(L)));
}



// The shift is a choice, not a part of the model.
TEST(MixedModes, WhateverTheShift)
{
  const StraightBeam beam(32, 3, 1e10);
  const LinearMotion motion = beam.motion();
  const double       exact  = static_cast<double>(beam.exact_frequency(Exact(3.516)));
  for (const double shift : {1e-6, 1e-3, 0.1, 1., 3., 30.})
    EXPECT_NEAR(find_modes(motion, 4, shift).found[0].frequency() / exact, 1., 1e-12) << "shift " << shift;
}



// What is said of an eigenvalue's error is its error: put one there.
TEST(MixedModes, ErrorsAreSeen)
{
  const StraightBeam beam(16, 3, 1e8, 12.);
  const LinearMotion motion = beam.motion();
  const Mode         mode   = find_modes(motion, 2, {}).found[0];
  ShiftInvert        op(motion);
  op.set(4., 13.);
  for (const double error : {1e-3, 1e-6, 1e-9})
    {
      const double estimate = op.judge(mode.lambda * (1 + error), mode.shape).error / mode.frequency();
      EXPECT_GT(estimate, 0.5 * error);
      EXPECT_LT(estimate, 2 * error);
    }
  // a wrong shape makes an error of second order in λ and of first order in the residual
  Mode bent = mode;
  for (int i = 0; i < bent.shape.size(); i += 2)
    bent.shape(i) *= 1.01;
  EXPECT_GT(op.judge(bent.lambda, bent.shape).error / mode.frequency(), 1e-2);
}



// Half of the beam a million times stiffer; the reference goes the same way as above.
TEST(MixedModes, StiffAndSoftPartsSideBySide)
{
  for (const double factor : {1e4, 1e8, 1e12})
    {
      StraightBeam beam(16, 3, 1e4);
      for (unsigned int i = 0; i < beam.rows.size() / 2; ++i)
        beam.rows[i].stiffness *= factor;
      // the outer half is a cantilever of half the length
      expect_exact(beam, 4 * 3.51, "factor " + std::to_string(factor));
    }
}



// An eigenvalue as often as it is there, though a block has two vectors.
TEST(Arnoldi, EqualEigenvalues)
{
  const unsigned int n = 400;
  for (const unsigned int copies : {1, 2, 3, 5, 8})
    {
      const auto value = [&](const unsigned int i) { return i < copies ? 3. : 2. / (1 + i); };
      Arnoldi    arnoldi(
        [&](const double *x, double *y) {
          for (unsigned int i = 0; i < n; ++i)
            y[i] = value(i) * x[i];
        },
        n,
        2);
      arnoldi.expand(30);
      unsigned int found = 0;
      for (unsigned int round = 0; round < 10; ++round)
        {
          found = std::count_if(arnoldi.values.begin(), arnoldi.values.end(), [](const auto &v) {
            return std::abs(v - 3.) < 1e-10;
          });
          if (arnoldi.largest_missed(12) < 2.9)
            break;
          arnoldi.widen();
          arnoldi.expand(arnoldi.size() + 20);
        }
      EXPECT_EQ(found, copies);
    }
}



// Two oscillators with the stiffness [k₁ c; −c k₂] flutter where c = (k₂ − k₁)/2. Near there λ changes by far more than
// its equations do, and neither the shape nor its conjugate is the left vector. The mode of equations that differ a
// little is judged by these: the error said is that of its λ.
TEST(MixedModes, ErrorsNearFlutter)
{
  const unsigned int n      = 4;
  const auto         motion = [=](const double c, const double k_1) {
    auto pattern = std::make_shared<Pattern>();
    pattern->column_start.push_back(0);
    for (unsigned int j = 0; j < n; ++j)
      {
        for (unsigned int i = 0; i < n; ++i)
          pattern->rows.push_back(i);
        pattern->column_start.push_back(n * (j + 1));
      }
    SparseMatrix M(pattern), Gamma(pattern), S(pattern);
    const double k[n] = {k_1, 9, 100, 121};
    for (unsigned int i = 0; i < n; ++i)
      {
        M.values[pattern->position(i, i)] = 1;
        S.values[pattern->position(i, i)] = k[i];
      }
    S.values[pattern->position(0, 1)] = c;
    S.values[pattern->position(1, 0)] = -c;
    return LinearMotion{M, Gamma, S, StrainRows(n), {}, n, std::vector<double>(n, 1.)};
  };
  for (const double distance : {1., 1e-2, 1e-4, 1e-6})
    {
      const double       c = 2.5 * (1 - distance), change = 1e-10;
      const LinearMotion exact = motion(c, 4.), wrong = motion(c, 4 + change);
      const auto         mode = find_modes(wrong, 2, {}).found.at(0);
      // λ² = −13/2 ± √((5/2)² − c²), and its derivative by k₁
      const double root = std::sqrt(6.25 - c * c), lower = std::sqrt(6.5 - root), gap = std::sqrt(6.5 + root) - lower,
                   error = change / (2 * lower) * (0.5 + 1.25 / root);
      ShiftInvert op(exact);
      op.set(1., 2.);
      const double estimate = op.judge(mode.lambda, mode.shape, gap).error;
      EXPECT_GT(estimate, 0.5 * error) << distance;
      EXPECT_LT(estimate, 20 * error) << distance;
    }
}
