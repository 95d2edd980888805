// Factors in panels of rows with KLU's pivots: solutions are those of dense elimination and of klu_solve, to round-off,
// for nodes of six unknowns with constraints and for matrices without any order, real and complex, with the same pivots
// kept for other values and with new ones.

#include <samara/base/dense.h>
#include <samara/solvers/factorization.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/panels.h>

#include <gtest/gtest.h>
#include <klu.h>

#include <random>
#include <set>

using namespace samara;

namespace
{
  using Complex = std::complex<double>;
  template <typename Number>
  using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
  template <typename Number>
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

  std::mt19937 generator;

  double
  random(const double, const double low = -1)
  {
    return std::uniform_real_distribution<double>(low, 1)(generator);
  }
  Complex
  random(const Complex &)
  {
    return {random(0.), random(0.)};
  }
  int
  random_index(const int n)
  {
    return std::uniform_int_distribution<int>(0, n - 1)(generator);
  }

  Pattern
  pattern_of(const std::vector<std::set<int>> &columns)
  {
    Pattern pattern;
    pattern.column_start = {0};
    for (const auto &rows : columns)
      {
        pattern.rows.insert(pattern.rows.end(), rows.begin(), rows.end());
        pattern.column_start.push_back(pattern.rows.size());
      }
    return pattern;
  }

  /** A chain of elements of four nodes, and constraints between nodes behind the first three. Multipliers come last. */
  Pattern
  chain(const int n_elements, const int n_constraints)
  {
    const int                  n_free = 6 * (3 * n_elements + 1);
    std::vector<std::set<int>> columns(n_free + n_constraints);
    for (int e = 0; e < n_elements; ++e)
      for (int i = 18 * e; i < 18 * e + 24; ++i)
        for (int j = 18 * e; j < 18 * e + 24; ++j)
          columns[j].insert(i);
    for (int c = n_free; c < n_free + n_constraints; ++c)
      {
        // one unknown of its own keeps it independent of the others
        columns[c].insert(c - n_free);
        columns[c - n_free].insert(c);
        for (const int node : {3 + random_index(n_free / 6 - 3), 3 + random_index(n_free / 6 - 3)})
          for (int i = 6 * node; i < 6 * node + 3; ++i)
            {
              columns[c].insert(i);
              columns[i].insert(c);
            }
      }
    return pattern_of(columns);
  }

  Pattern
  scattered(const int n, const int n_in_column)
  {
    std::vector<std::set<int>> columns(n);
    for (int j = 0; j < n; ++j)
      {
        columns[j].insert(j);
        for (int k = 0; k < n_in_column; ++k)
          columns[j].insert(random_index(n));
      }
    return pattern_of(columns);
  }

  /** Not symmetric, rows in different units. Large entries are those where columns are rows plus @p shift, if there. */
  template <typename Number>
  std::vector<Number>
  random_values(const Pattern &pattern, const int shift = 0, const int n_free = -1)
  {
    const int           n = pattern.size();
    std::vector<Number> values(pattern.n_nonzeros());
    std::vector<double> units(n);
    for (auto &unit : units)
      unit = std::pow(10., 3 * random(0.));
    for (int j = 0; j < n; ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        {
          const int i = pattern.rows[k];
          values[k]   = units[i] * (random(Number()) + (j == (i + shift) % n || std::abs(i - j) == n_free ? 30. : 0.));
        }
    return values;
  }

  template <typename Number>
  Matrix<Number>
  dense(const Pattern &pattern, const std::vector<Number> &values)
  {
    Matrix<Number> A = Matrix<Number>::Zero(pattern.size(), pattern.size());
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        A(pattern.rows[k], j) = values[k];
    return A;
  }

  template <typename Number>
  Vector<Number>
  solution_of_klu(Pattern pattern, std::vector<Number> values, Vector<Number> b)
  {
    constexpr bool is_real = std::is_same_v<Number, double>;
    klu_common     common;
    klu_defaults(&common);
    int *const start = pattern.column_start.data(), *const rows = pattern.rows.data();
    double *const a = reinterpret_cast<double *>(values.data()), *const x = reinterpret_cast<double *>(b.data());
    klu_symbolic *symbolic = klu_analyze(b.size(), start, rows, &common);
    klu_numeric  *numeric  = (is_real ? klu_factor : klu_z_factor)(start, rows, a, symbolic, &common);
    (is_real ? klu_solve : klu_z_solve)(symbolic, numeric, b.size(), 1, x, &common);
    (is_real ? klu_free_numeric : klu_z_free_numeric)(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
    return b;
  }

  /** Largest difference from dense elimination and from KLU, relative to the largest unknown. */
  template <typename Number>
  double
  error(const Pattern &pattern, const std::vector<Number> &values, Factorization<Number> &factorization)
  {
    Vector<Number> b(pattern.size());
    for (auto &value : b)
      value = random(Number());
    Vector<Number> x = b;
    factorization.factorize(values.data());
    factorization.solve(x.data());
    // pivots of dense elimination are compared within columns: rows of one size
    Matrix<Number>        A         = dense(pattern, values);
    const Eigen::VectorXd row_sizes = A.cwiseAbs().rowwise().maxCoeff();
    const Vector<Number>  reference =
      LuFactors<Number>(row_sizes.cwiseInverse().asDiagonal() * A).solve(row_sizes.cwiseInverse().asDiagonal() * b);
    return std::max((x - reference).cwiseAbs().maxCoeff(),
                    (x - solution_of_klu(pattern, values, b)).cwiseAbs().maxCoeff()) /
           reference.cwiseAbs().maxCoeff();
  }

  template <typename Number>
  void
  test(const Pattern &pattern, const std::string &what, const int n_free = -1)
  {
    const auto factorization = klu_factorization<Number>(pattern);
    auto       values        = random_values<Number>(pattern, 0, n_free);
    EXPECT_LT(error(pattern, values, *factorization), 1e-12) << what;
    for (int repetition = 0; repetition < 3; ++repetition)
      {
        for (auto &value : values)
          value *= 1 + 0.1 * random(0.);
        EXPECT_LT(error(pattern, values, *factorization), 1e-12) << what << ", other values";
      }
  }

  void
  test_both(const Pattern &pattern, const std::string &what, const int n_free = -1)
  {
    test<double>(pattern, what, n_free);
    test<Complex>(pattern, what + ", complex", n_free);
  }
} // namespace



TEST(Panels, ChainsWithConstraints)
{
  for (const int n_elements : {1, 2, 5, 16})
    for (const int n_constraints : {0, 1, 6, 17})
      test_both(chain(n_elements, n_constraints),
                std::to_string(n_elements) + " elements, " + std::to_string(n_constraints) + " constraints",
                6 * (3 * n_elements + 1));
}



TEST(Panels, MatricesWithoutOrder)
{
  for (const int n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 17, 40, 150, 400})
    for (const int n_in_column : {0, 2, n})
      test_both(scattered(n, n_in_column),
                std::to_string(n) + " rows, " + std::to_string(n_in_column) + " in a column");
}



template <typename Number>
void
test_new_pivots(const Pattern &pattern)
{
  // all entries are there; first diagonals are large, then entries beside them, and diagonals nearly zero
  const auto factorization = klu_factorization<Number>(pattern);
  for (const int shift : {0, 1, 0, 2})
    {
      auto values = random_values<Number>(pattern, shift);
      for (int j = 0; j < pattern.size(); ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          if (shift > 0 && pattern.rows[k] == j)
            values[k] *= 1e-9;
      EXPECT_LT(error(pattern, values, *factorization), 1e-12) << "shift " << shift;
    }
}

TEST(Panels, NewPivots)
{
  for (const int n : {5, 30, 120})
    {
      test_new_pivots<double>(scattered(n, 20 * n));
      test_new_pivots<Complex>(scattered(n, 20 * n));
    }
}



TEST(Panels, APivotThatBecomesZero)
{
  const Pattern pattern       = scattered(2, 20);
  const auto    factorization = klu_factorization<double>(pattern);
  ASSERT_EQ(pattern.n_nonzeros(), 4);
  for (const auto &values : {std::vector<double>{1, 1, 1, 0}, {0, 1, 1, 0}, {0, 1, 1, 2}})
    {
      EXPECT_LT(error(pattern, values, *factorization), 1e-15);
      EXPECT_EQ(factorization->determinant_sign(), -1);
    }
  EXPECT_THROW(factorization->factorize(std::vector<double>{1, 1, 1, 1}.data()), SingularMatrix);
  EXPECT_LT(error(pattern, {3, 1, 1, 2}, *factorization), 1e-15);
  EXPECT_EQ(factorization->determinant_sign(), 1);
}



TEST(Panels, WhatIsNoNumberLeavesNoTrace)
{
  const Pattern pattern       = chain(4, 6);
  const auto    factorization = klu_factorization<double>(pattern);
  const auto    values        = random_values<double>(pattern);
  EXPECT_LT(error(pattern, values, *factorization), 1e-12);
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const int place : {0, 50, pattern.n_nonzeros() - 1})
      {
        auto other   = values;
        other[place] = wrong;
        try
          {
            factorization->factorize(other.data());
            EXPECT_EQ(factorization->reciprocal_condition(), 0);
          }
        catch (const SingularMatrix &)
          {}
        EXPECT_LT(error(pattern, values, *factorization), 1e-12);
      }
}



TEST(Panels, RowsOfTheSameColumnsAreOnePanel)
{
  // two groups of rows, both coupled with a third one, not with each other
  Pivots     pivots;
  const auto fill = [](RowLists &lists, const bool is_lower) {
    lists.start = {0};
    for (int i = 0; i < 24; ++i)
      {
        for (int j = is_lower ? 0 : i + 1; j < (is_lower ? i : 24); ++j)
          if (i / 8 == j / 8 || i / 8 == 2 || j / 8 == 2)
            lists.columns.push_back(j);
        lists.start.push_back(lists.columns.size());
      }
  };
  fill(pivots.lower, true);
  fill(pivots.upper, false);
  Pattern pattern;
  for (int i = 0; i < 24; ++i)
    {
      pattern.column_start.push_back(i);
      pattern.rows.push_back(i);
      pivots.row_order.push_back(i);
      pivots.column_order.push_back(i);
    }
  pattern.column_start.push_back(24);
  const PanelStructure structure(pattern, pivots, 1);
  ASSERT_EQ(structure.panels.size(), 3u);
  for (int i = 0; i < 3; ++i)
    {
      EXPECT_EQ(structure.panels[i].first, 8 * i);
      EXPECT_EQ(structure.panels[i].width, 8);
      EXPECT_EQ(structure.panels[i].sources_end - structure.panels[i].sources_begin, i == 2 ? 2 : 0);
    }
  // no zeros beside the entries
  EXPECT_EQ(structure.n_lower_values, pivots.lower.columns.size());
  EXPECT_EQ(structure.n_upper_values, pivots.upper.columns.size());
}
