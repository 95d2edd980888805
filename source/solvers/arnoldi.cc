#include <samara/solvers/arnoldi.h>

#include <samara/base/dense.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace samara
{
  Arnoldi::Arnoldi(const Operator &A, const unsigned int n, const unsigned int block_size)
    : A(A)
    , n(n)
    , block(block_size)
    , V(n, block_size)
    , H(0, 0)
    , E(block_size, 0)
    , generator(block_size)
  {
    fill_random(0);
  }



  // A vector with all eigenvectors in it and, after two applications, without those of the infinite eigenvalues; where
  // the basis holds all of these images already, any vector will do.
  void
  Arnoldi::fill_random(const unsigned int first)
  {
    std::uniform_real_distribution<double> number(-1., 1.);
    Eigen::VectorXd                        x(n), y(n), unused;
    for (unsigned int j = first; j < m + block; ++j)
      for (const unsigned int applications : {2, 0})
        {
          for (auto &x_i : x)
            x_i = number(generator);
          for (unsigned int i = 0; i < applications; ++i)
            {
              A(x.data(), y.data());
              x = y / std::max(y.norm(), std::numeric_limits<double>::min());
            }
          const double before = x.norm();
          orthogonalize(j, x, unused);
          V.col(j) = x / std::max(x.norm(), std::numeric_limits<double>::min());
          if (x.norm() > 1e-8 * before) // more than what orthogonalisation leaves of a vector in the space: a new one
            break;
        }
  }



  /**
   * Take from @p x what lies in the first columns of the basis, and say whether anything is left of it. Twice is enough
   * (Kahan; Parlett 1980).
   */
  bool
  Arnoldi::orthogonalize(const unsigned int column, Eigen::Ref<Eigen::VectorXd> x, Eigen::VectorXd &coefficients) const
  {
    const double before = x.norm();
    coefficients.setZero(column);
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        const Eigen::VectorXd c = V.leftCols(column).transpose() * x;
        x.noalias() -= V.leftCols(column) * c;
        coefficients += c;
      }
    return x.norm() > 1e-15 * before; // else the space is invariant
  }



  void
  Arnoldi::add_block()
  {
    const unsigned int next = m + block;
    if (V.cols() < static_cast<int>(next + block))
      V.conservativeResize(Eigen::NoChange, std::max<int>(next + block, 3 * V.cols() / 2));
    Eigen::MatrixXd larger            = Eigen::MatrixXd::Zero(next, next), images(n, block);
    larger.topLeftCorner(m, m)        = H;
    larger.bottomLeftCorner(block, m) = E;
    E                                 = Eigen::MatrixXd::Zero(block, next);
    Eigen::VectorXd c;
    for (unsigned int j = 0; j < block; ++j)
      A(V.col(m + j).data(), images.col(j).data());
    const unsigned int old = m;
    m                      = next;
    for (unsigned int j = 0; j < block; ++j)
      {
        const bool is_new      = orthogonalize(next + j, images.col(j), c);
        larger.col(old + j)    = c.head(next);
        E.col(old + j).head(j) = c.tail(j);
        E(j, old + j)          = is_new ? images.col(j).norm() : 0.;
        if (is_new)
          V.col(next + j) = images.col(j) / E(j, old + j);
        else
          {
            // the basis is invariant: go on elsewhere
            const unsigned int end = m;
            m                      = next + j + 1 - block;
            fill_random(next + j);
            m = end;
          }
      }
    H = larger;
  }



  void
  Arnoldi::expand(const unsigned int size)
  {
    while (m < size)
      add_block();
    solve_small();
  }



  void
  Arnoldi::solve_small()
  {
    const auto [nu, y] = general_eigen(H);
    std::vector<unsigned int> order(m);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&, &nu = nu](const unsigned int a, const unsigned int b) {
      return std::abs(nu(a)) > std::abs(nu(b));
    });
    values.clear();
    residuals.clear();
    small_vectors.resize(m, m);
    for (unsigned int i = 0; i < m; ++i)
      {
        values.push_back(nu(order[i]));
        small_vectors.col(i) = y.col(order[i]).normalized();
        residuals.push_back((E * small_vectors.col(i)).norm());
      }
  }



  Eigen::VectorXcd
  Arnoldi::vector(const unsigned int i) const
  {
    Eigen::VectorXcd x(n);
    x.real() = V.leftCols(m) * small_vectors.col(i).real();
    x.imag() = V.leftCols(m) * small_vectors.col(i).imag();
    return x;
  }



  double
  Arnoldi::largest_missed(const unsigned int steps)
  {
    const unsigned int first = m;
    if (first + steps + 2 * block > n)
      return 0;
    const Eigen::MatrixXd next = V.middleCols(m, block), old_E = E, old_H = H;
    fill_random(first);
    E.setZero();
    while (m < first + steps)
      add_block();
    const unsigned int     k      = m - first;
    const Eigen::VectorXcd values = general_eigenvalues(H.bottomRightCorner(k, k));
    m                      = first;
    H                      = old_H;
    E                      = old_E;
    V.middleCols(m, block) = next;
    return values.cwiseAbs().maxCoeff();
  }



  void
  Arnoldi::widen()
  {
    ++block;
    E.conservativeResize(block, Eigen::NoChange);
    E.bottomRows(1).setZero();
    V.conservativeResize(Eigen::NoChange, std::max<int>(V.cols(), m + block));
    fill_random(m + block - 1);
  }
} // namespace samara
