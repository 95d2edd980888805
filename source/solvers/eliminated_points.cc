#include <samara/solvers/eliminated_points.h>

#include <samara/base/dense.h>

#include <algorithm>

namespace samara
{
  EliminatedPoints::EliminatedPoints(const unsigned int first_stress, const unsigned int size)
    : first_stress(first_stress)
    , size(size)
  {}



  namespace
  {
    /** All six unknowns of each node: the same for all points of an element, whatever happens to be zero. */
    std::vector<int>
    unknowns_of_rows(const SparseRows &B, const unsigned int first, const unsigned int n)
    {
      std::vector<int> nodes;
      for (unsigned int k = B.start[first]; k < B.start[first + n]; ++k)
        if (const int node = B.columns[k] / 6; nodes.empty() || node != nodes.back())
          nodes.push_back(node);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      std::vector<int> all;
      for (const int node : nodes)
        for (int i = 0; i < 6; ++i)
          all.push_back(6 * node + i);
      return all;
    }
  } // namespace



  void
  EliminatedPoints::add(const SparseRows      &B,
                        const unsigned int     first_row,
                        const Eigen::MatrixXd &T,
                        const Eigen::MatrixXd &F,
                        const unsigned int     first)
  {
    const auto unknowns = unknowns_of_rows(B, first_row, T.rows());
    const bool follows =
      !groups.empty() && groups.back().unknowns == unknowns && groups.back().first + groups.back().n_stresses == first;
    if (!follows)
      {
        const std::size_t size_before = groups.empty() ? 0 : groups.back().values.size();
        groups.push_back({first, 0, unknowns, {}, {}, {}});
        groups.back().values.reserve(size_before);
      }
    Group &g = groups.back();
    g.values.resize(g.values.size() + T.cols() * unknowns.size(), 0.);
    double *const rows = g.values.data() + g.n_stresses * unknowns.size();
    g.n_stresses += T.cols();
    for (int i = 0; i < T.rows(); ++i)
      for (int r = 0; r < T.cols(); ++r)
        if (const double t = T(i, r); t != 0.)
          {
            auto at = unknowns.begin(); // columns mostly ascend
            for (unsigned int k = B.start[first_row + i]; k < B.start[first_row + i + 1]; ++k)
              {
                const int column = B.columns[k];
                if (at == unknowns.end() || *at > column)
                  at = unknowns.begin();
                if (*at < column)
                  at = std::lower_bound(at, unknowns.end(), column);
                rows[r * unknowns.size() + (at - unknowns.begin())] += t * B.values[k];
                ++at;
              }
          }
    g.F.push_back(F);
    g.stiffness.push_back(SymmetricSolve(F).solve(Eigen::MatrixXd::Identity(F.rows(), F.cols())));
  }



  /** x = blockdiag(blocks) x. */
  void
  EliminatedPoints::times(const std::vector<Eigen::MatrixXd> &blocks, Eigen::MatrixXd &x)
  {
    int row = 0;
    for (const auto &block : blocks)
      {
        x.middleRows(row, block.rows()) = (block * x.middleRows(row, block.rows())).eval();
        row += block.rows();
      }
  }



  Eigen::MatrixXd
  EliminatedPoints::local(const Group &g, const double *x, const unsigned int n_columns, const std::size_t size)
  {
    Eigen::MatrixXd result(g.unknowns.size(), n_columns);
    for (unsigned int c = 0; c < n_columns; ++c)
      for (unsigned int i = 0; i < g.unknowns.size(); ++i)
        result(i, c) = x[g.unknowns[i] + c * size];
    return result;
  }



  void
  EliminatedPoints::add_local(const Group &g, const Eigen::MatrixXd &local, double *y, const std::size_t size)
  {
    for (int c = 0; c < local.cols(); ++c)
      for (unsigned int i = 0; i < g.unknowns.size(); ++i)
        y[g.unknowns[i] + c * size] += local(i, c);
  }



  void
  EliminatedPoints::add_stiffness(SparseMatrix &A) const
  {
    const Pattern  &pattern = *A.pattern;
    Eigen::MatrixXd K, CB;
    for (const Group &g : groups)
      {
        CB = g.B();
        times(g.stiffness, CB);
        K.noalias() = g.B().transpose() * CB;
        for (unsigned int j = 0; j < g.unknowns.size(); ++j)
          {
            int k = pattern.column_start[g.unknowns[j]];
            for (unsigned int i = 0; i < g.unknowns.size(); ++i)
              {
                while (pattern.rows[k] < g.unknowns[i])
                  ++k;
                A.values[k] += i < j ? K(i, j) : K(j, i); // symmetric, however the products are rounded
              }
          }
      }
  }



  void
  EliminatedPoints::condense(double *b, const unsigned int n_columns) const
  {
    for (const Group &g : groups)
      {
        Eigen::MatrixXd s = stresses(g, b, n_columns);
        if (s.isZero(0.))
          continue;
        times(g.stiffness, s);
        add_local(g, g.B().transpose() * s, b, size);
      }
  }



  void
  EliminatedPoints::expand(double *b, const unsigned int n_columns) const
  {
    for (const Group &g : groups)
      {
        Block           e = stresses(g, b, n_columns);
        Eigen::MatrixXd s = g.B() * local(g, b, n_columns, size) - e;
        times(g.stiffness, s);
        e = s;
      }
  }



  void
  EliminatedPoints::refine(double *x, double *b, const unsigned int n_columns) const
  {
    Eigen::MatrixXd strain, s, left, correction;
    for (const Group &g : groups)
      {
        Block e          = stresses(g, b, n_columns);
        strain.noalias() = g.B() * local(g, x, n_columns, size);
        s                = strain - e;
        times(g.stiffness, s);
        stresses(g, x, n_columns) = s;
        left                      = s;
        times(g.F, left);
        left += e - strain;
        e          = left;
        correction = left;
        times(g.stiffness, correction);
        add_local(g, g.B().transpose() * (correction - s), b, size);
      }
  }



  void
  EliminatedPoints::add_product(const double *x, double *y, const unsigned int n_columns) const
  {
    for (const Group &g : groups)
      {
        const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> s(x + first_stress + g.first,
                                                                           g.n_stresses,
                                                                           n_columns,
                                                                           Eigen::OuterStride<>(size));
        Eigen::MatrixXd                                                  Fs = s;
        times(g.F, Fs);
        stresses(g, y, n_columns) += g.B() * local(g, x, n_columns, size) - Fs;
        add_local(g, g.B().transpose() * s, y, size);
      }
  }
} // namespace samara
