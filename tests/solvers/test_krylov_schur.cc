/*
 * Problem:   eigenvalues of largest size of operators that are known by their products
 * Reference: matrices made from their eigenvalues; dense eigenvalues
 */

#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/solvers/eigen_system.h>
#include <samara/solvers/krylov_schur.h>

#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  using Eigen::MatrixXd;

  MatrixXd
  random_matrix(const unsigned int n, const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1., 1.);
    return MatrixXd::NullaryExpr(n, n, [&]() { return number(generator); });
  }

  /** X D X⁻¹ with pairs r exp(±iφ) in blocks of D, then real values. */
  MatrixXd
  with_values(const std::vector<std::complex<double>> &pairs, const std::vector<double> &reals)
  {
    const unsigned int n = 2 * pairs.size() + reals.size();
    MatrixXd           D = MatrixXd::Zero(n, n);
    for (unsigned int i = 0; i < pairs.size(); ++i)
      D.block<2, 2>(2 * i, 2 * i) << pairs[i].real(), pairs[i].imag(), -pairs[i].imag(), pairs[i].real();
    for (unsigned int i = 0; i < reals.size(); ++i)
      D(2 * pairs.size() + i, 2 * pairs.size() + i) = reals[i];
    const MatrixXd X = MatrixXd::Identity(n, n) + 0.5 / std::sqrt(n) * random_matrix(n, 3);
    return X * D * inverse(X);
  }

  EigenPairs
  of(const MatrixXd &A, const unsigned int wanted, const ArnoldiSettings &settings = {})
  {
    const EigenPairs pairs = arnoldi(
      A.rows(),
      [&](const double *x, double *y) {
        Eigen::Map<Eigen::VectorXd>(y, A.rows()) = A * Eigen::Map<const Eigen::VectorXd>(x, A.rows());
      },
      wanted,
      settings);
    for (unsigned int i = 0; i < pairs.values.size(); ++i)
      {
        const Eigen::VectorXcd x = pairs.vectors.col(i);
        EXPECT_NEAR(x.norm(), 1, 1e-12);
        EXPECT_LE((A * x - pairs.values[i] * x).norm(), 10 * settings.tolerance * std::abs(pairs.values[0])) << i;
      }
    return pairs;
  }

  std::vector<double>
  descending(const unsigned int n, const double from, const double factor)
  {
    std::vector<double> values = {from};
    while (values.size() < n)
      values.push_back(values.back() * factor);
    return values;
  }
} // namespace



// Close to each other, so that a basis of 60 vectors is filled again and again.
TEST(KrylovSchur, PairsAndRealValuesWithRestarts)
{
  const std::vector<std::complex<double>> pairs = {{0.6, 0.8}, {-0.97, 0.1}, {0.1, 0.96}};
  const MatrixXd                          A     = with_values(pairs, descending(394, 0.95, 0.995));
  const EigenPairs                        found = of(A, 8);
  EXPECT_GT(found.n_products, 120u);
  ASSERT_GE(found.values.size(), 8u);
  for (unsigned int i = 0; i < 3; ++i)
    for (const double side : {1., -1.})
      {
        const std::complex<double> wanted(pairs[i].real(), side * pairs[i].imag());
        double                     nearest = 1;
        for (const auto &value : found.values)
          nearest = std::min(nearest, std::abs(value - wanted));
        EXPECT_LT(nearest, 1e-9) << i;
      }
  EXPECT_NEAR(std::abs(found.values[6]), 0.95, 1e-9);
  EXPECT_NEAR(std::abs(found.values[7]), 0.95 * 0.995, 1e-9);
}



// One start vector holds one direction of an eigenspace; the look from another start finds the others.
TEST(KrylovSchur, ValuesThatAreThereSeveralTimes)
{
  std::vector<double> reals = descending(147, 0.8, 0.97);
  reals.insert(reals.end(), {1., 1., 1.});
  const EigenPairs found = of(with_values({}, reals), 4);
  ASSERT_GE(found.values.size(), 4u);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_LT(std::abs(found.values[i] - 1.), 1e-8) << i;
  EXPECT_NEAR(found.values[3].real(), 0.8, 1e-9);

  const EigenPairs pairs = of(with_values({{0.6, 0.8}, {0.6, 0.8}}, descending(96, 0.9, 0.97)), 4);
  ASSERT_EQ(pairs.values.size(), 4u);
  for (const auto &value : pairs.values)
    EXPECT_NEAR(std::abs(value), 1, 1e-8);
}



// What is told is |A x − λ x|, also of what had converged before the last start; a loose tolerance shows it.
TEST(KrylovSchur, ResidualsAreTrue)
{
  const MatrixXd A = with_values({{0.6, 0.8}, {-0.97, 0.1}}, descending(196, 0.98, 0.995));
  for (const double tolerance : {0.1, 1e-2, 1e-4, 1e-8})
    {
      SCOPED_TRACE(tolerance);
      ArnoldiSettings settings;
      settings.tolerance     = tolerance;
      settings.largest_basis = 20;
      const EigenPairs pairs = arnoldi(
        A.rows(),
        [&](const double *x, double *y) {
          Eigen::Map<Eigen::VectorXd>(y, A.rows()) = A * Eigen::Map<const Eigen::VectorXd>(x, A.rows());
        },
        5,
        settings);
      double largest = 0;
      for (unsigned int i = 0; i < pairs.values.size(); ++i)
        {
          const Eigen::VectorXcd x        = pairs.vectors.col(i);
          const double           true_one = (A * x - pairs.values[i] * x).norm();
          EXPECT_NEAR(pairs.residuals[i], true_one, 1e-6 * true_one + 1e-13) << i;
          EXPECT_LE(true_one, tolerance * std::abs(pairs.values[i]) * (1 + 1e-9)) << i;
          largest = std::max(largest, true_one);
        }
      EXPECT_GT(largest, 1e-4 * tolerance); // loose ones show
    }
}



TEST(EigenSystem, DefectiveValuesMoveByTheRootOfAChange)
{
  MatrixXd A = MatrixXd::Zero(3, 3);
  A << 1, 1, 0, 0, 1, 0, 0, 0, 0.5;
  Eigen::VectorXcd values(2);
  values << 1., 0.5;
  const Eigen::VectorXd changes = changes_of_values(A, values, 1e-12);
  EXPECT_GT(changes(0), 1e-7);
  EXPECT_LT(changes(0), 1e-5);
  EXPECT_LT(changes(1), 1e-11);
}



TEST(KrylovSchur, SmallOnesAreSolvedWhole)
{
  for (const unsigned int n : {1, 2, 3, 7})
    {
      const MatrixXd   A     = random_matrix(n, n);
      const EigenPairs found = of(A, n);
      ASSERT_EQ(found.values.size(), n);
      std::complex<double> sum = 0;
      for (const auto &value : found.values)
        sum += value;
      EXPECT_NEAR(sum.real(), A.trace(), 1e-12);
      EXPECT_NEAR(sum.imag(), 0, 1e-12);
    }
  // nilpotent, and nothing at all
  const EigenPairs none = of(MatrixXd::Zero(5, 5), 2);
  EXPECT_EQ(std::abs(none.values[0]), 0.);
}



TEST(KrylovSchur, ARandomMatrixHasItsDenseEigenvalues)
{
  const MatrixXd      A = random_matrix(120, 9);
  std::vector<double> sizes;
  for (const auto &value : general_eigenvalues(A))
    sizes.push_back(std::abs(value));
  std::sort(sizes.rbegin(), sizes.rend());
  const EigenPairs found = of(A, 6);
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_NEAR(std::abs(found.values[i]), sizes[i], 1e-8);
}



TEST(KrylovSchur, RefusesWhatCannotBe)
{
  const MatrixXd A = random_matrix(4, 1);
  EXPECT_THROW(of(A, 5), std::invalid_argument);
  EXPECT_THROW(of(A, 0), std::invalid_argument);
  ArnoldiSettings few;
  few.most_products = 70;
  EXPECT_THROW(of(random_matrix(400, 2), 6, few), NotConverged);
  MatrixXd wrong = A;
  wrong(2, 1)    = std::nan("");
  EXPECT_THROW(of(wrong, 1), NotConverged);
}



// It is looked at after every product: five values that stand above the others need no basis that is full. The look from
// another start ends where what is beside them is smaller, by more than its residual.
TEST(KrylovSchur, EndsBeforeTheBasisIsFull)
{
  const MatrixXd  A = with_values({{0.6, 0.8}, {-0.7, 0.6}}, descending(296, 0.85, 0.6));
  ArnoldiSettings settings;
  settings.tolerance     = 1e-9;
  const EigenPairs found = of(A, 5, settings);
  ASSERT_EQ(found.values.size(), 5u);
  EXPECT_NEAR(std::abs(found.values[4]), 0.85, 1e-8);
  EXPECT_LT(found.n_products, 45u);

  settings.tolerance = 1e-5;
  EXPECT_LT(of(A, 2, settings).n_products, 30u);
}
