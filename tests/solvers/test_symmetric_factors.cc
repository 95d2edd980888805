/*
 * Problem:   L D Lᵀ by supernodes, of matrices that are symmetric, nearly so, and not
 * Reference: known solutions; signs of eigenvalues by dense matrices
 */

#include <samara/base/dense.h>
#include <samara/solvers/diagonal_order.h>
#include <samara/solvers/symmetric_factors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

using namespace samara;

namespace
{
  /** Blocks of three unknowns on a square grid, each coupled with its eight neighbours, and multipliers behind. */
  struct SymmetricGrid
  {
    std::shared_ptr<Pattern> pattern = std::make_shared<Pattern>();
    int                      n_moving;
    std::vector<bool>        is_late;
    SparseMatrix             A;

    SymmetricGrid(const int side, const int n_multipliers)
      : n_moving(3 * side * side)
      , A(fill(side, n_multipliers))
    {}

    SparseMatrix
    fill(const int side, const int n_multipliers)
    {
      const int                  n = n_moving + n_multipliers;
      std::vector<std::set<int>> couplings(n);
      for (int a = 0; a < side * side; ++a)
        for (int b = 0; b < side * side; ++b)
          if (std::abs(a % side - b % side) <= 1 && std::abs(a / side - b / side) <= 1)
            for (int i = 0; i < 9; ++i)
              couplings[3 * a + i % 3].insert(3 * b + i / 3);
      for (int m = 0; m < n_multipliers; ++m)
        for (const int u : {(31 * m) % n_moving, (31 * m + 7) % n_moving, n_moving + m})
          {
            couplings[n_moving + m].insert(u);
            couplings[u].insert(n_moving + m);
          }
      pattern->column_start = {0};
      for (const auto &column : couplings)
        {
          pattern->rows.insert(pattern->rows.end(), column.begin(), column.end());
          pattern->column_start.push_back(pattern->rows.size());
        }
      is_late.assign(n, false);
      std::fill(is_late.begin() + n_moving, is_late.end(), true);
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> number(-1., 1.);
      SparseMatrix                           result(pattern);
      for (int j = 0; j < n; ++j)
        for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
          {
            const int i = pattern->rows[k];
            if (i == j)
              result.values[k] = j < n_moving ? 12. : 0.;
            else if (i > j)
              result.values[k] = result.values[pattern->position(j, i)] = number(generator);
          }
      return result;
    }

    /** Make a share of the entries of moving unknowns unsymmetric, by so much. */
    void
    skew(const int every, const double size)
    {
      for (int j = 0; j < n_moving; j += every)
        for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
          if (const int i = pattern->rows[k]; i < n_moving && i / 3 == j / 3)
            A.values[k] += size * (i - j);
    }

    double
    error_of(const SymmetricFactors &factors) const
    {
      std::vector<double> x(pattern->size()), b(pattern->size());
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = 1 + i % 5;
      A.multiply(x.data(), b.data());
      factors.solve(b.data());
      double error = 0;
      for (unsigned int i = 0; i < x.size(); ++i)
        error = std::max(error, std::abs(b[i] - x[i]));
      return error;
    }
  };

  SymmetricFactors
  factors_of(const SymmetricGrid &grid)
  {
    SymmetricFactors factors;
    factors.set_order(DiagonalOrder(*grid.pattern, grid.is_late).supernodes());
    return factors;
  }
} // namespace



// With multipliers as many pivots are negative as there are of them: inertia is that of the eigenvalues (Sylvester).
TEST(SymmetricFactors, SolveAndCountSigns)
{
  for (const int n_multipliers : {0, 25})
    {
      const SymmetricGrid grid(12, n_multipliers);
      SymmetricFactors    factors = factors_of(grid);
      for (int twice = 0; twice < 2; ++twice)
        {
          ASSERT_TRUE(factors.split(*grid.pattern, grid.A.values.data()));
          EXPECT_TRUE(factors.is_symmetric());
          ASSERT_EQ(factors.factorize(*grid.pattern, grid.A.values.data()), -1);
          EXPECT_LT(grid.error_of(factors), 1e-10);
        }
      EXPECT_EQ(factors.n_negative_pivots, (symmetric_eigenvalues(grid.A.dense()).array() < 0).count());
      EXPECT_EQ(factors.n_negative_pivots, n_multipliers);
      EXPECT_GT(factors.reciprocal_condition(), 1e-6);
    }
}



// The columns of a supernode and its rows hold every entry of the factors, and each unknown is eliminated once.
TEST(SymmetricFactors, SupernodesHoldAllEntries)
{
  const SymmetricGrid grid(8, 10);
  const Supernodes    all = DiagonalOrder(*grid.pattern, grid.is_late).supernodes();
  const int           n   = grid.pattern->size();
  EXPECT_EQ(std::set<int>(all.order.begin(), all.order.end()).size(), unsigned(n));
  ASSERT_EQ(all.first.back(), n);
  std::vector<int> place(n);
  for (int i = 0; i < n; ++i)
    place[all.order[i]] = i;
  Eigen::MatrixXd dense = grid.A.dense(), F(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      F(place[i], place[j]) = dense(i, j);
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < n; ++i)
      F.row(i).tail(n - k - 1) -= F(i, k) / F(k, k) * F.row(k).tail(n - k - 1);
  for (int s = 0; s < all.size(); ++s)
    {
      const std::set<int> rows(all.rows_of(s), all.rows_of(s) + all.n_rows(s));
      EXPECT_EQ(static_cast<int>(rows.size()), all.n_rows(s));
      EXPECT_TRUE(std::is_sorted(all.rows_of(s), all.rows_of(s) + all.n_rows(s)));
      for (int j = all.first[s]; j < all.first[s + 1]; ++j)
        for (int i = j; i < n; ++i)
          EXPECT_TRUE(rows.count(i) == 1 || std::abs(F(j, i)) < 1e-12) << i << " " << j;
    }
  // some zeros are stored, and by far not all: those below the diagonal are n²/2
  EXPECT_LT(all.value_start.back(), 0.5 * n * n);
  for (int i = grid.n_moving; i < n; ++i)
    for (int k = grid.pattern->column_start[i]; k < grid.pattern->column_start[i + 1]; ++k)
      EXPECT_LE(place[grid.pattern->rows[k]], place[i]) << "a multiplier before what it acts on";
}



// Passes with what is not symmetric: each takes the error down by its size over the stiffness.
TEST(SymmetricFactors, WhatIsLittleAndUnsymmetricIsMadeGood)
{
  SymmetricGrid grid(12, 25);
  grid.skew(9, 1e-3);
  SymmetricFactors factors = factors_of(grid);
  ASSERT_TRUE(factors.split(*grid.pattern, grid.A.values.data()));
  EXPECT_FALSE(factors.is_symmetric());
  ASSERT_EQ(factors.factorize(*grid.pattern, grid.A.values.data()), -1);
  double before = 1;
  for (factors.n_passes = 0; factors.n_passes <= 2; ++factors.n_passes)
    {
      const double error = grid.error_of(factors);
      EXPECT_LT(error, 0.05 * before);
      EXPECT_GT(error, 1e-13) << "there would be nothing to make good";
      before = error;
    }
  factors.n_passes = 5;
  EXPECT_LT(grid.error_of(factors), 1e-11);
}



TEST(SymmetricFactors, RefuseWhatIsNotSymmetricAtAll)
{
  SymmetricGrid grid(12, 0);
  grid.skew(1, 1e-3);
  SymmetricFactors factors = factors_of(grid);
  EXPECT_FALSE(factors.split(*grid.pattern, grid.A.values.data()));
  SymmetricGrid broken(12, 0);
  broken.A.values[broken.pattern->position(0, 1)] = std::nan("");
  EXPECT_FALSE(factors.split(*broken.pattern, broken.A.values.data()));
}



// An unknown without stiffness has a pivot of zero, and is told by its number.
TEST(SymmetricFactors, WhatHasNoPivotIsNamed)
{
  SymmetricGrid grid(12, 0);
  const int     gone = 3 * 50 + 1;
  for (int j = 0; j < grid.pattern->size(); ++j)
    for (int k = grid.pattern->column_start[j]; k < grid.pattern->column_start[j + 1]; ++k)
      if (j == gone || grid.pattern->rows[k] == gone)
        grid.A.values[k] = 0;
  SymmetricFactors factors = factors_of(grid);
  ASSERT_TRUE(factors.split(*grid.pattern, grid.A.values.data()));
  EXPECT_EQ(factors.factorize(*grid.pattern, grid.A.values.data()), gone);
}
