#include <samara/analysis/mode_tracking.h>

#include <samara/base/dense.h>

#include <algorithm>
#include <tuple>

namespace samara
{
  namespace
  {
    Eigen::VectorXcd
    weighted(const SparseMatrix &M, const Eigen::VectorXcd &shape)
    {
      const unsigned int  n = shape.size();
      std::vector<double> re(M.pattern->size(), 0.), im = re, Mre = re, Mim = re;
      for (unsigned int i = 0; i < n; ++i)
        {
          re[i] = shape(i).real();
          im[i] = shape(i).imag();
        }
      M.multiply(re.data(), Mre.data());
      M.multiply(im.data(), Mim.data());
      Eigen::VectorXcd result(n);
      for (unsigned int i = 0; i < n; ++i)
        result(i) = {Mre[i], Mim[i]};
      return result;
    }
  } // namespace



  /** In each group of equal frequencies, replace the shapes by the projections of those branches that lie in it most.
   */
  void
  ModeTracking::turn_equal_modes(std::vector<Mode> &modes, const SparseMatrix &M) const
  {
    for (unsigned int first = 0, end = 1; first < modes.size(); first = end++)
      {
        // equal to what eigenvalues are known to at worst without a warning: their shapes are any basis
        while (end < modes.size() &&
               std::abs(modes[end].lambda - modes[first].lambda) <= 1e-6 * std::abs(modes[first].lambda))
          ++end;
        const unsigned int k = end - first;
        if (k < 2)
          continue;
        Eigen::MatrixXcd shapes(modes[first].shape.size(), k), M_shapes = shapes;
        for (unsigned int i = 0; i < k; ++i)
          {
            shapes.col(i)   = modes[first + i].shape;
            M_shapes.col(i) = weighted(M, modes[first + i].shape);
          }
        // coordinates in which the kinetic energy is the sum of squares
        const ComplexCholesky gram(shapes.adjoint() * M_shapes);
        if (!gram.is_positive())
          continue;
        // columns of no branch where there are none yet: shapes become orthogonal all the same, as otherwise a branch
        // that lies in the others would find nothing to go on with at the next speed
        Eigen::MatrixXcd in_group = Eigen::MatrixXcd::Zero(k, std::max<std::size_t>(1, previous.size()));
        for (unsigned int j = 0; j < previous.size(); ++j)
          {
            const double norm = std::sqrt(std::abs(previous[j].shape.dot(weighted(M, previous[j].shape))));
            in_group.col(j)   = gram.solve_lower(M_shapes.adjoint() * previous[j].shape) / std::max(norm, 1e-300);
          }
        // the largest projection first, then what is largest normal to it
        const Eigen::MatrixXcd turned = shapes * gram.solve_upper(pivoted_q(in_group));
        for (unsigned int i = 0; i < k; ++i)
          modes[first + i].shape = turned.col(i).normalized();
      }
  }



  namespace
  {
    double
    distance_from_the_real_axis(const Mode &mode, const double band)
    {
      const double omega = std::abs(mode.lambda.imag());
      return std::min(omega, std::abs(band - omega));
    }



    /** Both near 0, or both near the band, and nearer than @p reach together. */
    bool
    may_pass_the_real_axis(const Mode &before, const Mode &now, const double band, const double reach)
    {
      const auto near_zero = [&](const Mode &mode) { return std::abs(mode.lambda.imag()) <= 0.5 * band; };
      return near_zero(before) == near_zero(now) &&
             distance_from_the_real_axis(before, band) + distance_from_the_real_axis(now, band) <= reach;
    }
  } // namespace



  /** The assurance criterion of each mode (rows) with each branch, or with the other member of its pair. */
  Eigen::MatrixXd
  ModeTracking::criteria(const std::vector<Mode> &modes, const SparseMatrix &M, const bool conjugate) const
  {
    Eigen::VectorXd energies(previous.size());
    for (unsigned int j = 0; j < previous.size(); ++j)
      energies(j) = previous[j].shape.dot(weighted(M, previous[j].shape)).real();
    Eigen::MatrixXd result(modes.size(), previous.size());
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        const Eigen::VectorXcd M_shape = weighted(M, modes[i].shape);
        const double           norm    = modes[i].shape.dot(M_shape).real();
        for (unsigned int j = 0; j < previous.size(); ++j)
          result(i, j) =
            std::norm(conjugate ? previous[j].shape.conjugate().dot(M_shape) : previous[j].shape.dot(M_shape)) /
            std::max(1e-300, norm * energies(j));
      }
    return result;
  }



  /** Pair what is free with the largest criterion first, wherever @p may_be says so. */
  void
  ModeTracking::pair(const Eigen::MatrixXd                                 &mac,
                     const std::function<bool(unsigned int, unsigned int)> &may_be,
                     std::vector<unsigned int>                             &branches,
                     std::vector<bool>                                     &taken) const
  {
    std::vector<std::tuple<double, unsigned int, unsigned int>> pairs;
    for (unsigned int i = 0; i < mac.rows(); ++i)
      for (unsigned int j = 0; j < mac.cols(); ++j)
        if (mac(i, j) > 0.3 && may_be(i, j)) // of shapes that mix half and half it is 0.5
          pairs.emplace_back(mac(i, j), i, j);
    std::sort(pairs.rbegin(), pairs.rend());
    for (const auto &[size, i, j] : pairs)
      if (branches[i] == 0 && !taken[j])
        {
          branches[i] = j + 1;
          taken[j]    = true;
        }
  }



  std::vector<unsigned int>
  ModeTracking::follow(std::vector<Mode> &modes, const SparseMatrix &M, const double band)
  {
    std::vector<unsigned int> branches(modes.size(), 0);
    std::vector<bool>         taken(previous.size(), false);
    turn_equal_modes(modes, M);
    pair(
      criteria(modes, M, false), [](auto, auto) { return true; }, branches, taken);
    // What passes the real axis between two speeds goes on as the other member of its pair. But the conjugate of a
    // progressive wave is the regressive one, another mode: only what is nearer to the axis than others have moved
    // passes.
    double reach = 0;
    for (unsigned int i = 0; i < modes.size(); ++i)
      if (branches[i] > 0)
        reach = std::max(reach, std::abs(modes[i].lambda.imag() - previous[branches[i] - 1].lambda.imag()));
    pair(
      criteria(modes, M, true),
      [&](const unsigned int i, const unsigned int j) {
        return may_pass_the_real_axis(previous[j], modes[i], band, reach);
      },
      branches,
      taken);
    // shapes never seen before begin new branches
    for (unsigned int i = 0; i < modes.size(); ++i)
      if (branches[i] == 0)
        {
          previous.push_back(modes[i]);
          branches[i] = previous.size();
        }
      else
        previous[branches[i] - 1] = modes[i];
    return branches;
  }
} // namespace samara
