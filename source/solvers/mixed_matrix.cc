#include <samara/solvers/equilibrate.h>
#include <samara/solvers/from_eigen.h>
#include <samara/solvers/mixed_matrix.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Entries of a matrix in any order; those of one place are added. */
    class Triplets
    {
    public:
      void
      add(const int row, const int column, const double value)
      {
        if (value != 0.)
          entries.emplace_back(row, column, value);
      }

      std::unique_ptr<SparseMatrix>
      compress(const int n) const
      {
        Eigen::SparseMatrix<double> sum(n, n);
        sum.setFromTriplets(entries.begin(), entries.end());
        return from_eigen(sum);
      }

    private:
      std::vector<Eigen::Triplet<double>> entries;
    };
  } // namespace



  MixedMatrix::MixedMatrix(const LinearMotion &motion)
    : motion(motion)
    , n(motion.M.pattern->size())
  {}



  void
  MixedMatrix::factorize(const double shift)
  {
    sigma = shift;
    reduce_points();
    assemble();
    const auto          rest     = eliminate();
    const SparseMatrix &unscaled = rest ? *rest : *A;
    scale                        = equilibrating_factors(unscaled, 6);
    const Pattern &pattern       = *unscaled.pattern;
    SparseMatrix   scaled(unscaled.pattern);
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        scaled.values[k] = unscaled.values[k] * scale[j] * scale[pattern.rows[k]];
    solver = make_solver(unscaled.pattern, library_in_use(), Ordering::columns);
    try
      {
        solver->factorize(scaled);
      }
    catch (const SingularMatrix &singular)
      {
        throw SingularMatrix(singular.unknown < static_cast<int>(n) ? singular.unknown : -1);
      }
  }



  void
  MixedMatrix::reduce_points()
  {
    points.clear();
    rows = {};
    for (const auto &p : motion.strains.points)
      {
        points.push_back(reduced(p));
        add_rows(p, points.back());
      }
  }



  namespace
  {
    /** Eigenvectors of a stiffness that is not zero, and its inverse in them. */
    Eigen::MatrixXd
    without_null_space(const Eigen::MatrixXd &C, Eigen::MatrixXd &inverse)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(C);
      const Eigen::VectorXd                                lambda = eigen.eigenvalues();
      std::vector<int>                                     kept;
      for (int i = 0; i < lambda.size(); ++i)
        if (std::abs(lambda(i)) > 1e-12 * lambda.cwiseAbs().maxCoeff())
          kept.push_back(i);
      inverse = lambda(kept).cwiseInverse().asDiagonal();
      return eigen.eigenvectors()(Eigen::all, kept);
    }
  } // namespace



  MixedMatrix::Point
  MixedMatrix::reduced(const StrainRows::Point &p) const
  {
    const Eigen::MatrixXd C_d = p.weight * motion.strains.C_d(p), C = p.weight * motion.strains.C(p) + sigma * C_d;
    std::vector<int>      stiff;
    for (unsigned int i = 0; i < p.size; ++i)
      if (C(i, i) != 0.)
        stiff.push_back(i);
    // T = D, D² the diagonal of C: all that is left has the stiffness 1, but for couplings
    const unsigned int m = stiff.size();
    Eigen::VectorXd    d(m);
    Eigen::MatrixXd    scaled(m, m);
    for (unsigned int i = 0; i < m; ++i)
      d(i) = power_of_two(std::sqrt(std::abs(C(stiff[i], stiff[i]))));
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        scaled(i, j) = C(stiff[i], stiff[j]) / (d(i) * d(j));
    Point result;
    result.first                        = rows.n_rows();
    Eigen::MatrixXd                   V = Eigen::MatrixXd::Identity(m, m);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(scaled);
    if (cholesky.info() == Eigen::Success && (cholesky.matrixLLT().diagonal().array() > 1e-6).all())
      result.F = cholesky.solve(V);
    else
      V = without_null_space(scaled, result.F);
    result.T               = Eigen::MatrixXd::Zero(p.size, V.cols());
    Eigen::MatrixXd T_plus = Eigen::MatrixXd::Zero(V.cols(), p.size);
    for (unsigned int i = 0; i < m; ++i)
      {
        result.T.row(stiff[i]) = d(i) * V.row(i);
        T_plus.col(stiff[i])   = V.row(i).transpose() / d(i);
      }
    result.FT = result.F * T_plus;
    if (!C_d.isZero(0.))
      result.viscous = result.FT * C_d;
    return result;
  }



  void
  MixedMatrix::add_rows(const StrainRows::Point &p, const Point &reduced)
  {
    const SparseRows &B = motion.strains.B;
    for (int r = 0; r < reduced.T.cols(); ++r)
      {
        rows.begin_row();
        for (unsigned int i = 0; i < p.size; ++i)
          if (reduced.T(i, r) != 0.)
            for (unsigned int k = B.start[p.first_row + i]; k < B.start[p.first_row + i + 1]; ++k)
              rows.add_entry(B.columns[k], reduced.T(i, r) * B.values[k]);
      }
  }



  void
  MixedMatrix::assemble()
  {
    Triplets       sum;
    const Pattern &p = *motion.M.pattern;
    for (int j = 0; j < p.size(); ++j)
      for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
        sum.add(p.rows[k],
                j,
                motion.S.values[k] + sigma * motion.gyroscopic.values[k] + sigma * sigma * motion.M.values[k]);
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (unsigned int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        {
          sum.add(n + i, rows.columns[k], rows.values[k]);
          sum.add(rows.columns[k], n + i, rows.values[k]);
        }
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const Point &point = points[g];
        for (int i = 0; i < point.F.rows(); ++i)
          for (int j = 0; j < point.F.cols(); ++j)
            sum.add(n + point.first + i, n + point.first + j, -point.F(i, j));
        if (motion.B_dot.n_rows() == 0)
          continue;
        for (int i = 0; i < point.viscous.rows(); ++i)
          for (int j = 0; j < point.viscous.cols(); ++j)
            {
              const unsigned int row = motion.strains.points[g].first_row + j;
              for (unsigned int k = motion.B_dot.start[row]; k < motion.B_dot.start[row + 1]; ++k)
                sum.add(n + point.first + i, motion.B_dot.columns[k], point.viscous(i, j) * motion.B_dot.values[k]);
            }
      }
    A = sum.compress(size());
  }



  void
  MixedMatrix::add_viscous_part(const double *zeta, double *b) const
  {
    for (unsigned int g = 0; g < points.size(); ++g)
      for (int j = 0; j < points[g].viscous.cols(); ++j)
        {
          const double e = motion.strains.B.row_times(motion.strains.points[g].first_row + j, zeta);
          for (int i = 0; i < points[g].viscous.rows(); ++i)
            b[n + points[g].first + i] -= points[g].viscous(i, j) * e;
        }
  }



  void
  MixedMatrix::for_entries(const std::function<void(int, int, double)> &f) const
  {
    const Pattern &pattern = *A->pattern;
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        f(pattern.rows[k], j, A->values[k]);
  }



  void
  MixedMatrix::for_viscous_entries(const std::function<void(int, int, double)> &f) const
  {
    const SparseRows &B = motion.strains.B;
    for (unsigned int g = 0; g < points.size(); ++g)
      for (int j = 0; j < points[g].viscous.cols(); ++j)
        for (int i = 0; i < points[g].viscous.rows(); ++i)
          for (unsigned int row = motion.strains.points[g].first_row + j, k = B.start[row]; k < B.start[row + 1]; ++k)
            f(n + points[g].first + i, B.columns[k], points[g].viscous(i, j) * B.values[k]);
  }



  void
  MixedMatrix::add_strains_of(const double *q, double *b) const
  {
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const Point &p = points[g];
        Eigen::Map<Eigen::VectorXd>(b + n + p.first, p.FT.rows()) +=
          p.FT * Eigen::Map<const Eigen::VectorXd>(q + motion.strains.points[g].first_row, p.FT.cols());
      }
  }



  void
  MixedMatrix::multiply(const double *x, double *y) const
  {
    A->multiply(x, y);
  }



  bool
  MixedMatrix::is_eliminated(const unsigned int point) const
  {
    return motion.strains.points[point].size > 6 && motion.B_dot.n_rows() == 0 && points[point].F.rows() > 0;
  }



  namespace
  {
    /** Sums BᵀF⁻¹B of points that follow each other at the same nodes, those of an element. */
    class ElementSums
    {
    public:
      explicit ElementSums(std::vector<Eigen::Triplet<double>> &entries)
        : entries(entries)
      {}

      /** @p unknowns are sorted; @p B has a column for each. */
      void
      add(const std::vector<int> &unknowns, const Eigen::MatrixXd &B, const Eigen::MatrixXd &stiffness)
      {
        if (unknowns != columns)
          {
            flush();
            columns = unknowns;
            sum.setZero(columns.size(), columns.size());
          }
        sum.noalias() += B.transpose() * (stiffness * B);
      }

      void
      flush()
      {
        for (unsigned int j = 0; j < columns.size(); ++j)
          for (unsigned int i = 0; i < columns.size(); ++i)
            if (sum(i, j) != 0. || sum(j, i) != 0.) // a symmetric pattern, whatever rounds to zero
              entries.emplace_back(columns[i], columns[j], sum(i, j));
        columns.clear();
      }

    private:
      std::vector<Eigen::Triplet<double>> &entries;
      std::vector<int>                     columns;
      Eigen::MatrixXd                      sum;
    };
  } // namespace



  std::unique_ptr<SparseMatrix>
  MixedMatrix::eliminate()
  {
    place.assign(size(), 0);
    stiffness.assign(points.size(), {});
    for (unsigned int g = 0; g < points.size(); ++g)
      if (is_eliminated(g))
        {
          stiffness[g] = points[g].F.ldlt().solve(Eigen::MatrixXd::Identity(points[g].F.rows(), points[g].F.cols()));
          std::fill_n(place.begin() + n + points[g].first, points[g].F.rows(), -1);
        }
    n_left = 0;
    for (auto &p : place)
      p = p < 0 ? -1 : static_cast<int>(n_left++);
    if (n_left == size())
      return nullptr;

    std::vector<Eigen::Triplet<double>> entries;
    for_entries([&](const int i, const int j, const double value) {
      if (place[i] < 0 || place[j] < 0)
        return;
      entries.emplace_back(place[i], place[j], value);
      if (i != j && A->pattern->position(j, i) < 0)
        entries.emplace_back(place[j], place[i], 0.);
    });
    ElementSums      sums(entries);
    std::vector<int> unknowns;
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        if (stiffness[g].size() == 0)
          continue;
        // all six unknowns of each node: the same for all points of an element, whatever happens to be zero
        const unsigned int first = rows.start[points[g].first], last = rows.start[points[g].first + points[g].F.rows()];
        unknowns.clear();
        for (unsigned int k = first; k < last; ++k)
          unknowns.push_back(rows.columns[k] - rows.columns[k] % 6);
        std::sort(unknowns.begin(), unknowns.end());
        unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
        std::vector<int> all;
        for (const int node : unknowns)
          for (int i = 0; i < 6; ++i)
            all.push_back(node + i);
        Eigen::MatrixXd B = Eigen::MatrixXd::Zero(points[g].F.rows(), all.size());
        for (int i = 0; i < B.rows(); ++i)
          for (unsigned int k = rows.start[points[g].first + i]; k < rows.start[points[g].first + i + 1]; ++k)
            B(i, std::lower_bound(all.begin(), all.end(), static_cast<int>(rows.columns[k])) - all.begin()) +=
              rows.values[k];
        sums.add(all, B, stiffness[g]);
      }
    sums.flush();
    Eigen::SparseMatrix<double> sum(n_left, n_left);
    sum.setFromTriplets(entries.begin(), entries.end());
    return from_eigen(sum);
  }



  void
  MixedMatrix::condense(double *b) const
  {
    for (unsigned int g = 0; g < points.size(); ++g)
      if (stiffness[g].size() > 0)
        {
          const unsigned int    first = points[g].first;
          const Eigen::VectorXd s =
            stiffness[g] * Eigen::Map<const Eigen::VectorXd>(b + n + first, stiffness[g].rows());
          for (int i = 0; i < s.size(); ++i)
            for (unsigned int k = rows.start[first + i]; k < rows.start[first + i + 1]; ++k)
              b[rows.columns[k]] += rows.values[k] * s(i);
        }
  }



  void
  MixedMatrix::expand(double *b) const
  {
    for (unsigned int g = 0; g < points.size(); ++g)
      if (stiffness[g].size() > 0)
        {
          const unsigned int first = points[g].first;
          Eigen::VectorXd    strain(stiffness[g].rows());
          for (int i = 0; i < strain.size(); ++i)
            strain(i) = rows.row_times(first + i, b) - b[n + first + i];
          Eigen::Map<Eigen::VectorXd>(b + n + first, strain.size()) = stiffness[g] * strain;
        }
  }



  void
  MixedMatrix::solve_scaled(double *b) const
  {
    ++n_solutions;
    condense(b);
    left.resize(n_left);
    for (unsigned int i = 0; i < size(); ++i)
      if (place[i] >= 0)
        left[place[i]] = b[i] * scale[place[i]];
    solver->solve(left.data());
    for (unsigned int i = 0; i < size(); ++i)
      if (place[i] >= 0)
        b[i] = left[place[i]] * scale[place[i]];
    expand(b);
  }



  void
  MixedMatrix::solve(double *b) const
  {
    right_side.assign(b, b + size());
    solve_scaled(b);
    residual.resize(size());
    multiply(b, residual.data());
    for (unsigned int i = 0; i < size(); ++i)
      residual[i] = right_side[i] - residual[i];
    solve_scaled(residual.data());
    for (unsigned int i = 0; i < size(); ++i)
      b[i] += residual[i];
  }



  void
  MixedMatrix::stresses(const double *solution, double *q) const
  {
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const Point &p = points[g];
        Eigen::Map<Eigen::VectorXd>(q + motion.strains.points[g].first_row, p.T.rows()) =
          p.T * Eigen::Map<const Eigen::VectorXd>(solution + n + p.first, p.T.cols());
      }
  }
} // namespace samara
