#include <samara/solvers/anderson.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace samara
{
  namespace
  {
    /** Directions of the differences, of length one, that leave less than this square beside the others are round-off.
     */
    constexpr double least_square = 1e-12;

    /** A combination with larger factors goes far away from all that is known. */
    constexpr double largest_factor = 10;
  } // namespace



  void
  Anderson::begin()
  {
    n_differences = oldest = 0;
    last_image.resize(0);
  }



  void
  Anderson::keep(const std::vector<Part> &parts)
  {
    before.clear();
    for (const Part &part : parts)
      if (part.counts)
        before.insert(before.end(), part.values, part.values + part.size);
  }



  void
  Anderson::accelerate(const std::vector<Part> &parts, const std::vector<double> &weights)
  {
    std::size_t size = 0;
    for (const Part &part : parts)
      size += part.size;
    image.resize(size);
    correction.resize(before.size());
    std::size_t at = 0, counted = 0;
    for (const Part &part : parts)
      {
        std::copy_n(part.values, part.size, image.data() + at);
        at += part.size;
        for (unsigned int i = 0; part.counts && i < part.size; ++i, ++counted)
          correction(counted) = weights[counted] * (part.values[i] - before[counted]);
      }
    if (last_image.size() > 0)
      add_difference();
    std::swap(last_image, image);
    std::swap(last_correction, correction);
    const Factors factors = combination();
    if (factors.size() == 0)
      return;
    at = 0;
    for (const Part &part : parts)
      {
        // one after the other: of a product of so few columns Eigen fuses what is aligned alone, and where a vector
        // stands in memory would change its last digit
        Eigen::Map<Eigen::VectorXd> values(part.values, part.size);
        for (unsigned int j = 0; j < factors.size(); ++j)
          values -= factors(j) * images.col(j).segment(at, part.size);
        at += part.size;
      }
  }



  Eigen::VectorXd
  Anderson::next(Eigen::VectorXd x, Eigen::VectorXd g)
  {
    const unsigned int n = x.size();
    ones.assign(n, 1.);
    keep({{x.data(), n, true}});
    accelerate({{g.data(), n, true}}, ones);
    return g;
  }



  void
  Anderson::add_difference()
  {
    // in place of the oldest one: the order of the columns does not matter
    images.resize(image.size(), depth);
    corrections.resize(correction.size(), depth);
    const unsigned int column = oldest;
    oldest                    = (oldest + 1) % depth;
    n_differences             = std::min(n_differences + 1, depth);
    images.col(column)        = image - last_image;
    corrections.col(column)   = correction - last_correction;
    products.col(column).head(n_differences).noalias() =
      corrections.leftCols(n_differences).transpose() * corrections.col(column);
    products.row(column) = products.col(column).transpose();
  }



  Anderson::Factors
  Anderson::combination() const
  {
    // normal equations of columns of length one
    const unsigned int n = n_differences;
    if (n == 0)
      return {};
    const Factors length = products.diagonal().head(n).cwiseSqrt();
    if (!(length.minCoeff() > 0))
      return {};
    const Factors inverse = length.cwiseInverse();
    const Gram    scaled  = inverse.asDiagonal() * products.topLeftCorner(n, n) * inverse.asDiagonal();
    const Factors right   = inverse.cwiseProduct(corrections.leftCols(n).transpose() * last_correction);
    const Factors result  = inverse.cwiseProduct(solve(scaled, right));
    return result.allFinite() && result.cwiseAbs().maxCoeff() < largest_factor ? result : Factors();
  }



  Anderson::Factors
  Anderson::solve(Gram A, Factors b)
  {
    // symmetric elimination with the largest pivot first; what is left when none is large depends on the others
    const int              n = b.size();
    std::array<int, depth> order{};
    int                    rank = 0;
    for (int i = 0; i < n; ++i)
      order[i] = i;
    for (; rank < n; ++rank)
      {
        int pivot = rank;
        A.diagonal().tail(n - rank).maxCoeff(&pivot);
        pivot += rank;
        if (!(A(pivot, pivot) > least_square))
          break;
        A.row(rank).swap(A.row(pivot));
        A.col(rank).swap(A.col(pivot));
        std::swap(b(rank), b(pivot));
        std::swap(order[rank], order[pivot]);
        for (int i = rank + 1; i < n; ++i)
          {
            const double factor = A(i, rank) / A(rank, rank);
            for (int j = rank + 1; j < n; ++j)
              A(i, j) -= factor * A(rank, j);
            b(i) -= factor * b(rank);
          }
      }
    Factors result = Factors::Zero(n);
    for (int i = rank - 1; i >= 0; --i)
      {
        double value = b(i);
        for (int j = i + 1; j < rank; ++j)
          value -= A(i, j) * result(order[j]);
        result(order[i]) = value / A(i, i);
      }
    return result;
  }
} // namespace samara
