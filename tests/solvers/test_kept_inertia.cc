/*
 * Problem:   positive eigenvalues of a matrix that has no factors of its own, by those of another one
 * Reference: eigenvalues of dense matrices; the stress at which a simply supported square buckles, 4 π² D/(b² h)
 */

#include <samara/base/dense.h>
#include <samara/solvers/diagonal_order.h>
#include <samara/solvers/kept_inertia.h>

#include "../scene.h"
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  /** [K Gᵀ; G 0] with K positive definite, and another one nearby; all entries of K are there. */
  struct SaddlePair
  {
    const int                n, m;
    std::shared_ptr<Pattern> pattern = std::make_shared<Pattern>();
    Eigen::MatrixXd          start;
    SymmetricFactors         factors;

    SaddlePair(const int n, const int m, std::mt19937 &generator)
      : n(n)
      , m(m)
      , start(Eigen::MatrixXd::Zero(n + m, n + m))
    {
      std::normal_distribution<double> number;
      const auto                       random = [&](const int r, const int c) -> Eigen::MatrixXd {
        return Eigen::MatrixXd::NullaryExpr(r, c, [&]() { return number(generator); });
      };
      const Eigen::MatrixXd B = random(n, n);
      // eigenvalues over four decades
      start.topLeftCorner(n, n) =
        B * Eigen::VectorXd::LinSpaced(n, -4, 0).array().exp().matrix().asDiagonal() * B.transpose();
      start.topLeftCorner(n, n).diagonal().array() += 1e-3;
      start.bottomLeftCorner(m, n) = random(m, n);
      start.topRightCorner(n, m)   = start.bottomLeftCorner(m, n).transpose();
      pattern->column_start        = {0};
      for (int j = 0; j < n + m; ++j)
        {
          for (int i = 0; i < n + m; ++i)
            if (i < n || j < n || i == j)
              pattern->rows.push_back(i);
          pattern->column_start.push_back(pattern->rows.size());
        }
      std::vector<bool> is_late(n + m, false);
      std::fill(is_late.begin() + n, is_late.end(), true);
      factors.set_order(DiagonalOrder(*pattern, is_late).supernodes());
      const SparseMatrix A = sparse(start);
      EXPECT_TRUE(factors.split(*pattern, A.values.data()));
      EXPECT_EQ(factors.factorize(*pattern, A.values.data()), -1);
      EXPECT_EQ(factors.n_negative_pivots, m);
    }

    SparseMatrix
    sparse(const Eigen::MatrixXd &dense) const
    {
      SparseMatrix A(pattern);
      for (int j = 0; j < n + m; ++j)
        for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
          A.values[k] = dense(pattern->rows[k], j);
      return A;
    }
  };

  int
  n_positive(const Eigen::MatrixXd &A)
  {
    return (symmetric_eigenvalues(0.5 * (A + A.transpose())).array() > 0).count();
  }

  /** A square held across along all edges and pushed by a share of its limit, which is not searched for. */
  std::string
  pushed_square(const double share)
  {
    // E = 12 (1 − ν²) MPa, h = 1 cm: D = 1 N m, so the limit is 4 π² N/m
    return R"(
set Analyses = static
subsection Static
  set Smallest step = 0.9
end
subsection Bodies
  subsection s
    set Type          = shell
    set Patches       = u, v, 0
    set Elements      = 8, 8
    set Degree        = 3
    set E             = 10.92e6
    set Poisson ratio = 0.3
    set Thickness     = 0.01
    set Density       = 1
  end
end
subsection Joints
  subsection across
    set Type  = support
    set Along = s.edge u0, s.edge u1, s.edge v0, s.edge v1
    set Fixed = displacement 3
  end
  subsection along
    set Type  = support
    set Along = s.edge u0
    set Fixed = displacement 1
  end
  subsection aside
    set Type  = support
    set Along = s.edge v0
    set Fixed = displacement 2
  end
end
subsection Loads
  subsection push
    set Type  = line load
    set Body  = s
    set Edge  = edge u1
    set Force = )" +
           std::to_string(-share * 4 * M_PI * M_PI) + ", 0, 0\n  end\nend\n";
  }
} // namespace



// Of random saddle matrices and random changes of K and G: what is shown is so. Small changes are always shown, and
// those at which an eigenvalue passes zero never.
TEST(KeptInertia, IsThatOfTheEigenvalues)
{
  std::mt19937                     generator(7);
  std::normal_distribution<double> number;
  unsigned int                     n_shown = 0, n_changed = 0;
  for (const int m : {0, 6})
    for (unsigned int model = 0; model < 6; ++model)
      {
        SaddlePair      pair(40, m, generator);
        Eigen::MatrixXd change = Eigen::MatrixXd::NullaryExpr(40 + m, 40 + m, [&]() { return number(generator); });
        change                 = (change + change.transpose()).eval();
        change.bottomRightCorner(m, m).setZero();
        for (double size = 1e-7; size < 1; size *= 3)
          {
            const Eigen::MatrixXd changed = pair.start + size * change;
            const KeptInertia     found   = n_positive_is_kept(pair.factors, pair.sparse(changed));
            const bool            is_kept = n_positive(changed) == pair.n;
            EXPECT_TRUE(is_kept || !found.is_shown) << m << " multipliers, model " << model << ", change " << size;
            EXPECT_TRUE(found.is_shown || size > 1e-5) << found.residual << " after " << found.iterations;
            n_shown += found.is_shown;
            n_changed += !is_kept;
          }
      }
  EXPECT_GT(n_shown, 40u);
  EXPECT_GT(n_changed, 20u);
}



// One direction alone loses its stiffness, which nothing excites: just before that it is shown, just behind it is not.
TEST(KeptInertia, SeesASingleDirection)
{
  std::mt19937 generator(11);
  for (const int m : {0, 6})
    for (unsigned int seed = 1; seed <= 20; ++seed)
      {
        SaddlePair pair(40, m, generator);
        // K − s k kᵀ / (zᵀKz), k = K z, G z = 0: the energy of z is 1 − s of what it was
        const Eigen::MatrixXd K = pair.start.topLeftCorner(40, 40), G = pair.start.bottomLeftCorner(m, 40);
        Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(40, [&](const auto i) { return std::sin(seed + 2. * i); });
        if (m > 0)
          z -= G.transpose() * SymmetricSolve(G * G.transpose()).solve(G * z);
        for (const double share : {0.98, 1.02})
          {
            Eigen::MatrixXd changed = pair.start;
            changed.topLeftCorner(40, 40) -= share / z.dot(K * z) * (K * z) * (K * z).transpose();
            const KeptInertia found = n_positive_is_kept(pair.factors, pair.sparse(changed), 1e-6, 10, seed);
            EXPECT_EQ(n_positive(changed) == 40, share < 1);
            EXPECT_EQ(found.is_shown, share < 1)
              << share << ", residual " << found.residual << " after " << found.iterations;
          }
      }
}



// What is not symmetric does not matter to its sign, and is not seen.
TEST(KeptInertia, IsThatOfTheSymmetricPart)
{
  std::mt19937    generator(3);
  SaddlePair      pair(40, 6, generator);
  Eigen::MatrixXd skew = Eigen::MatrixXd::Zero(46, 46);
  for (int i = 0; i < 39; ++i)
    skew(i, i + 1) = 5., skew(i + 1, i) = -5.;
  EXPECT_TRUE(n_positive_is_kept(pair.factors, pair.sparse(pair.start + skew)).is_shown);
  EXPECT_GT((pair.start + skew).determinant() * pair.start.determinant(), 0);
}



// A flat square under a load in its plane: what it bends by at its limit is not excited. The equilibrium below is shown
// to be stable without factors of its own, and the one beyond is refused.
TEST(KeptInertia, OfASquareBelowAndBeyondItsLimit)
{
  for (const double share : {0.3, 0.97, 1.03})
    {
      Scene scene(pushed_square(share));
      auto &statics       = scene.analysis<StaticAnalysis>();
      statics.large_model = 1000;
      if (share < 1)
        {
          scene.equilibrium();
          if (share < 0.5)
            {
              EXPECT_EQ(statics.n_shown, 1u);
            }
        }
      else
        {
          EXPECT_THROW(scene.equilibrium(), NotConverged);
        }
    }
}
