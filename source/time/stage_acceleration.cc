#include <samara/base/dense.h>
#include <samara/time/stage_acceleration.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    using Vector    = Eigen::Map<const Eigen::VectorXd>;
    using Direction = Eigen::Map<Eigen::VectorXd>;

    /** Directions of the differences that are shorter than this part of the longest are round-off. */
    constexpr double least_direction = 1e-12; // of squares

    /** A combination with larger factors goes far away from all that is known. */
    constexpr double largest_factor = 10;

    double
    product(const std::vector<double> &a, const std::vector<double> &b)
    {
      return Vector(a.data(), a.size()).dot(Vector(b.data(), b.size()));
    }
  } // namespace



  void
  StageAcceleration::begin()
  {
    differences.clear();
    last_image.clear();
  }



  void
  StageAcceleration::keep(const std::vector<Part> &parts)
  {
    before.clear();
    for (const Part &part : parts)
      if (part.counts)
        before.insert(before.end(), part.values, part.values + part.size);
  }



  void
  StageAcceleration::accelerate(const std::vector<Part> &parts, const std::vector<double> &weights)
  {
    image.clear();
    correction.clear();
    for (const Part &part : parts)
      {
        image.insert(image.end(), part.values, part.values + part.size);
        for (unsigned int i = 0; part.counts && i < part.size; ++i)
          {
            const std::size_t at = correction.size();
            correction.push_back(weights[at] * (part.values[i] - before[at]));
          }
      }
    if (!last_image.empty())
      add_difference();
    std::swap(last_image, image); // image holds what was before it
    std::swap(last_correction, correction);
    const Eigen::VectorXd factors = combination();
    if (factors.size() == 0)
      return;
    std::size_t first = 0;
    for (const Part &part : parts)
      {
        Direction values(part.values, part.size);
        for (unsigned int j = 0; j < factors.size(); ++j)
          values -= factors(j) * Vector(differences[j].image.data() + first, part.size);
        first += part.size;
      }
  }



  void
  StageAcceleration::add_difference()
  {
    Difference next;
    if (differences.size() == depth)
      {
        next = std::move(differences.front()); // its memory serves again
        differences.pop_front();
        products = products.bottomRightCorner(depth - 1, depth - 1).eval();
      }
    next.image.resize(image.size());
    next.correction.resize(correction.size());
    std::transform(image.begin(), image.end(), last_image.begin(), next.image.begin(), std::minus<>());
    std::transform(
      correction.begin(), correction.end(), last_correction.begin(), next.correction.begin(), std::minus<>());
    differences.push_back(std::move(next));
    const unsigned int n = differences.size();
    products.conservativeResize(n, n);
    for (unsigned int j = 0; j < n; ++j)
      products(n - 1, j) = products(j, n - 1) = product(differences[j].correction, differences.back().correction);
  }



  Eigen::VectorXd
  StageAcceleration::combination() const
  {
    // normal equations of columns of length one, without the directions that round-off makes
    const unsigned int n = differences.size();
    if (n == 0)
      return {};
    Eigen::VectorXd length(n), right(n);
    for (unsigned int j = 0; j < n; ++j)
      {
        length(j) = std::sqrt(products(j, j));
        if (!(length(j) > 0))
          return {};
        right(j) = product(differences[j].correction, last_correction) / length(j);
      }
    const Eigen::MatrixXd scaled = length.cwiseInverse().asDiagonal() * products * length.cwiseInverse().asDiagonal();
    const auto            eigen  = symmetric_eigen(scaled);
    Eigen::VectorXd       result = Eigen::VectorXd::Zero(n);
    for (unsigned int i = 0; i < n; ++i)
      if (eigen.values(i) > least_direction * eigen.values(n - 1))
        result += eigen.vectors.col(i) * (eigen.vectors.col(i).dot(right) / eigen.values(i));
    result = result.cwiseQuotient(length);
    return result.allFinite() && result.cwiseAbs().maxCoeff() < largest_factor ? result : Eigen::VectorXd();
  }
} // namespace samara
