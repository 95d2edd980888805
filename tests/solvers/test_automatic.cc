/*
 * Problem:   the choice of a linear solver by the pattern, and pivots on the diagonal
 * Reference: known solutions; the sign of a determinant by dense elimination; the accuracy of MUMPS
 */

#include <samara/solvers/diagonal_order.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/panel_factors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

using namespace samara;

namespace
{
  /** Nodes with 6 unknowns that are coupled as in square elements of degree 3, and multipliers behind them. */
  struct Grid
  {
    std::shared_ptr<Pattern>   pattern = std::make_shared<Pattern>();
    int                        n_nodes;
    std::vector<std::set<int>> couplings;

    Grid(const int n_elements, const int n_multipliers)
    {
      const int n = 3 * n_elements + 1;
      n_nodes     = n * n;
      couplings.resize(6 * n_nodes + n_multipliers);
      for (int y = 0; y < n_elements; ++y)
        for (int x = 0; x < n_elements; ++x)
          for (int a = 0; a < 16; ++a)
            for (int b = 0; b < 16; ++b)
              couple_nodes((3 * y + a / 4) * n + 3 * x + a % 4, (3 * y + b / 4) * n + 3 * x + b % 4);
      for (int i = 0; i < n_multipliers; ++i)
        {
          const int row = 6 * n_nodes + i, node = (37 * i) % n_nodes;
          couplings[row].insert(row);
          for (int d = 0; d < 6; ++d)
            {
              couplings[row].insert(6 * node + d);
              couplings[6 * node + d].insert(row);
            }
        }
      pattern->column_start = {0};
      for (const auto &column : couplings)
        {
          pattern->rows.insert(pattern->rows.end(), column.begin(), column.end());
          pattern->column_start.push_back(pattern->rows.size());
        }
    }

    void
    couple_nodes(const int a, const int b)
    {
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          couplings[6 * a + i].insert(6 * b + j);
    }

    /** Random, with a dominant diagonal @p stiffness of what moves and zeros on that of the multipliers. */
    SparseMatrix
    matrix(const double stiffness) const
    {
      std::mt19937                           generator(1);
      std::uniform_real_distribution<double> number(-1., 1.);
      SparseMatrix                           A(pattern);
      for (int j = 0; j < pattern->size(); ++j)
        for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
          {
            const int i = pattern->rows[k];
            A.values[k] = i != j ? number(generator) : j < 6 * n_nodes ? stiffness : 0.;
          }
      return A;
    }
  };



  double
  error_of(LinearSolver &solver, const SparseMatrix &A)
  {
    const int           n = A.pattern->size();
    std::vector<double> x(n), b(n);
    for (int i = 0; i < n; ++i)
      x[i] = 1 + i % 7;
    A.multiply(x.data(), b.data());
    solver.factorize(A);
    solver.solve(b.data());
    double error = 0;
    for (int i = 0; i < n; ++i)
      error = std::max(error, std::abs(b[i] - x[i]));
    return error;
  }
} // namespace



/** The entries that the order foretells are those of the factors: L U = A wherever, and nowhere is more than A. */
TEST(DiagonalOrder, FactorsHaveTheEntriesThatItForetells)
{
  const Grid         grid(3, 5);
  const SparseMatrix A = grid.matrix(30);
  const int          n = A.pattern->size();
  std::vector<bool>  is_late(n, false);
  for (int i = 6 * grid.n_nodes; i < n; ++i)
    is_late[i] = true;
  const DiagonalOrder order(*A.pattern, is_late);
  const Pivots        pivots = order.pivots();
  EXPECT_EQ(pivots.row_order, pivots.column_order);
  EXPECT_EQ(std::set<int>(pivots.row_order.begin(), pivots.row_order.end()).size(), unsigned(n));
  EXPECT_EQ(pivots.lower.columns.size() + pivots.upper.columns.size() + n, order.n_entries);

  // dense elimination in this order
  Eigen::MatrixXd        dense = A.dense(), F(n, n);
  const Eigen::MatrixXd &D     = dense;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      F(i, j) = D(pivots.row_order[i], pivots.row_order[j]);
  double operations = 0;
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < n; ++i)
      if (F(i, k) != 0.)
        {
          F(i, k) /= F(k, k);
          F.row(i).tail(n - k - 1) -= F(i, k) * F.row(k).tail(n - k - 1);
          operations += 1 + (F.row(k).tail(n - k - 1).array() != 0.).count();
        }
  EXPECT_NEAR(operations / order.n_operations, 1, 0.05) << "some zeros in groups are counted";
  for (int i = 0; i < n; ++i)
    {
      std::set<int> places(pivots.lower.columns.begin() + pivots.lower.start[i],
                           pivots.lower.columns.begin() + pivots.lower.start[i + 1]);
      places.insert(pivots.upper.columns.begin() + pivots.upper.start[i],
                    pivots.upper.columns.begin() + pivots.upper.start[i + 1]);
      for (int j = 0; j < n; ++j)
        {
          const bool is_foretold = j == i || places.count(j) == 1;
          EXPECT_TRUE(is_foretold || std::abs(F(i, j)) < 1e-10) << i << " " << j;
        }
    }
  // multipliers come when all they act on has gone
  std::vector<int> place(n);
  for (int i = 0; i < n; ++i)
    place[pivots.row_order[i]] = i;
  for (int i = 6 * grid.n_nodes; i < n; ++i)
    for (const int j : grid.couplings[i])
      EXPECT_LE(place[j], place[i]);
}



// What is as wide as long takes operations as n² in nested dissection (George, SIAM J. Numer. Anal. 10 (1973) 345), as
// n^2.3 by minimum degree.
TEST(DiagonalOrder, DissectsCubes)
{
  const auto operations = [](const int width) {
    const int                  n = width * width * width;
    std::vector<std::set<int>> neighbours(n);
    for (int j = 0; j < n; ++j)
      for (const int dz : {-1, 0, 1})
        for (const int dy : {-1, 0, 1})
          for (const int dx : {-1, 0, 1})
            {
              const int x = j % width + dx, y = j / width % width + dy, z = j / width / width + dz;
              if (std::min({x, y, z}) >= 0 && std::max({x, y, z}) < width)
                neighbours[j].insert((z * width + y) * width + x);
            }
    Pattern pattern;
    pattern.column_start = {0};
    for (const auto &column : neighbours)
      {
        pattern.rows.insert(pattern.rows.end(), column.begin(), column.end());
        pattern.column_start.push_back(pattern.rows.size());
      }
    return DiagonalOrder(pattern, std::vector<bool>(n, false)).n_operations;
  };
  EXPECT_LT(std::log(operations(14) / operations(8)) / std::log(std::pow(14. / 8, 3)), 2.17);
}



TEST(DiagonalOrder, KnowsAPatternThatIsNotSymmetric)
{
  const Grid grid(1, 1);
  EXPECT_TRUE(is_structure_symmetric(*grid.pattern));
  Pattern pattern = *grid.pattern;
  pattern.rows.pop_back();
  --pattern.column_start.back();
  EXPECT_TRUE(is_structure_symmetric(pattern)) << "a diagonal entry";
  pattern.rows.pop_back();
  --pattern.column_start.back();
  EXPECT_FALSE(is_structure_symmetric(pattern));
}



/** Large enough that the diagonal is tried: a stiffness, one with multipliers, and one whose diagonal is no pivot. */
TEST(AutomaticSolver, IsAsAccurateAsOneThatLooksForPivots)
{
  for (const int n_multipliers : {0, 40})
    for (const double stiffness : {100., 1e-9, -100.})
      {
        SCOPED_TRACE(std::to_string(n_multipliers) + " multipliers, diagonal " + std::to_string(stiffness));
        const Grid         grid(7, n_multipliers);
        const SparseMatrix A         = grid.matrix(stiffness);
        const auto         automatic = make_solver(A.pattern, Library::automatic);
        const auto         mumps     = make_solver(A.pattern, Library::mumps);
        EXPECT_LT(error_of(*automatic, A), 1e-9 + 100 * error_of(*mumps, A));
        EXPECT_EQ(automatic->determinant_sign(), mumps->determinant_sign());
        // and again, with other values on the same pattern
        const SparseMatrix other = grid.matrix(50);
        EXPECT_LT(error_of(*automatic, other), 1e-11);
      }
}



TEST(AutomaticSolver, OfComplexNumbers)
{
  const Grid                        grid(7, 10);
  const SparseMatrix                A = grid.matrix(60);
  std::vector<std::complex<double>> values(A.values.begin(), A.values.end()), x, b(A.pattern->size());
  for (unsigned int k = 0; k < values.size(); ++k)
    values[k] *= std::complex<double>(1, 0.1 * (k % 3));
  for (int i = 0; i < A.pattern->size(); ++i)
    x.emplace_back(i % 5, i % 3);
  for (int j = 0; j < A.pattern->size(); ++j)
    for (int k = A.pattern->column_start[j]; k < A.pattern->column_start[j + 1]; ++k)
      b[A.pattern->rows[k]] += values[k] * x[j];
  const auto solver = make_complex_solver(A.pattern, Library::automatic);
  solver->factorize(values);
  solver->solve(b.data());
  for (unsigned int i = 0; i < x.size(); ++i)
    ASSERT_LT(std::abs(b[i] - x[i]), 1e-11);
}



/** A row of zeros has no pivot anywhere; the unknown is named. */
TEST(AutomaticSolver, SingularMatricesAreNamed)
{
  const Grid   grid(7, 0);
  SparseMatrix A    = grid.matrix(100);
  const int    gone = 6 * 100 + 2;
  for (int j = 0; j < A.pattern->size(); ++j)
    for (int k = A.pattern->column_start[j]; k < A.pattern->column_start[j + 1]; ++k)
      if (A.pattern->rows[k] == gone || j == gone)
        A.values[k] = 0;
  const auto solver = make_solver(A.pattern, Library::automatic);
  EXPECT_THROW(solver->factorize(A), SingularMatrix);
  const SparseMatrix whole = grid.matrix(100);
  EXPECT_LT(error_of(*solver, whole), 1e-11);
}
