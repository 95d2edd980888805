#include <samara/base/dense.h>
#include <samara/solvers/equilibrate.h>
#include <samara/solvers/from_eigen.h>
#include <samara/solvers/mixed_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace samara
{
  MixedMatrix::MixedMatrix(const LinearMotion &motion)
    : motion(motion)
    , n(motion.M.pattern->size())
  {}



  void
  MixedMatrix::factorize(const double shift)
  {
    const auto before = condensed ? condensed->pattern : nullptr;
    sigma             = shift;
    if (points.empty() || motion.strains.is_viscous()) // otherwise they know of no shift
      reduce_points();
    assemble();
    condensed.reset();
    if (!eliminated.empty())
      {
        condensed = std::make_unique<SparseMatrix>(*A);
        eliminated.add_stiffness(*condensed);
      }
    const SparseMatrix &unscaled = condensed ? *condensed : *A;
    scale                        = equilibrating_factors(unscaled, 6);
    if (!solver || unscaled.pattern != before) // the order of elimination is that of the pattern
      solver = make_solver(unscaled.pattern, library_in_use(), Ordering::columns);
    try
      {
        factorize_scaled(*solver, unscaled);
      }
    catch (const SingularMatrix &singular)
      {
        throw SingularMatrix(singular.unknown < static_cast<int>(n) ? singular.unknown : -1);
      }
  }



  void
  MixedMatrix::factorize_scaled(LinearSolver &by, const SparseMatrix &matrix) const
  {
    const Pattern &pattern = *matrix.pattern;
    SparseMatrix   scaled(matrix.pattern);
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        scaled.values[k] = matrix.values[k] * scale[j] * scale[pattern.rows[k]];
    by.factorize(scaled);
  }



  bool
  MixedMatrix::is_eliminated(const StrainRows::Point &p, const Point &reduced) const
  {
    return p.size > 6 && motion.B_dot.n_rows() == 0 && reduced.F.rows() > 0;
  }



  void
  MixedMatrix::reduce_points()
  {
    points.clear();
    rows       = {};
    n_stresses = 0;
    for (const auto &p : motion.strains.points)
      {
        points.push_back(reduced(p));
        points.back().first = n_stresses;
        n_stresses += points.back().T.cols();
      }
    eliminated = EliminatedPoints(n, size());
    place.resize(size());
    std::iota(place.begin(), place.begin() + n, 0);
    n_left = n;
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const auto &p             = motion.strains.points[g];
        const bool  is_eliminated = this->is_eliminated(p, points[g]);
        for (int i = 0; i < points[g].T.cols(); ++i)
          place[n + points[g].first + i] = is_eliminated ? -1 : static_cast<int>(n_left++);
        if (is_eliminated)
          eliminated.add(motion.strains.B, p.first_row, points[g].T, points[g].F, points[g].first);
        else
          add_rows(p, points[g]);
      }
  }



  namespace
  {
    /** Eigenvectors of a stiffness that is not zero, and its inverse in them. */
    Eigen::MatrixXd
    without_null_space(const Eigen::MatrixXd &C, Eigen::MatrixXd &inverse)
    {
      const HermitianEigen<double> eigen  = symmetric_eigen(C);
      const Eigen::VectorXd       &lambda = eigen.values;
      std::vector<int>             kept;
      for (int i = 0; i < lambda.size(); ++i)
        if (std::abs(lambda(i)) > 1e-12 * lambda.cwiseAbs().maxCoeff()) // scaled to a diagonal of about one before
          kept.push_back(i);
      inverse = lambda(kept).cwiseInverse().asDiagonal();
      return eigen.vectors(Eigen::all, kept);
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
    Point                             result;
    Eigen::MatrixXd                   V = Eigen::MatrixXd::Identity(m, m);
    const Cholesky                    cholesky(scaled);
    // the inverse keeps its digits; else combinations without stiffness are taken out
    if (cholesky.is_positive() && (cholesky.pivots().array() > 1e-6).all())
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



  /** S + σΓ + of_mass M */
  void
  MixedMatrix::add_shifted(const Pattern &pattern, std::vector<double> &values, const double of_mass) const
  {
    for (int k = 0; k < pattern.n_nonzeros(); ++k)
      values[k] = motion.S.values[k] + sigma * motion.gyroscopic.values[k] + of_mass * motion.M.values[k];
  }



  void
  MixedMatrix::assemble()
  {
    const auto    &shared = motion.M.pattern;
    const Pattern &p      = *shared;
    SparseMatrix   shifted(shared);
    add_shifted(p, shifted.values, sigma * sigma);
    if (!eliminated.empty() && rows.n_rows() == 0)
      {
        A = std::make_unique<SparseMatrix>(std::move(shifted));
        return;
      }
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < p.size(); ++j)
      for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
        if (shifted.values[k] != 0. || !eliminated.empty()) // the pattern of what is eliminated has to be there
          entries.emplace_back(p.rows[k], j, shifted.values[k]);
    assemble_rows(entries);
    Eigen::SparseMatrix<double> sum(n_left, n_left);
    sum.setFromTriplets(entries.begin(), entries.end());
    A = from_eigen(sum);
  }



  /** What belongs to stresses that are not eliminated. */
  void
  MixedMatrix::assemble_rows(std::vector<Eigen::Triplet<double>> &entries) const
  {
    const auto add = [&](const int row, const int column, const double value) {
      if (value != 0.)
        entries.emplace_back(row, column, value);
    };
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (unsigned int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        {
          add(n + i, rows.columns[k], rows.values[k]);
          add(rows.columns[k], n + i, rows.values[k]);
        }
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const Point &point = points[g];
        if (is_eliminated(motion.strains.points[g], point) || point.F.rows() == 0)
          continue;
        const int first = place[n + point.first];
        for (int i = 0; i < point.F.rows(); ++i)
          for (int j = 0; j < point.F.cols(); ++j)
            add(first + i, first + j, -point.F(i, j));
        if (motion.B_dot.n_rows() == 0)
          continue;
        for (int i = 0; i < point.viscous.rows(); ++i)
          for (int j = 0; j < point.viscous.cols(); ++j)
            {
              const unsigned int row = motion.strains.points[g].first_row + j;
              for (unsigned int k = motion.B_dot.start[row]; k < motion.B_dot.start[row + 1]; ++k)
                add(first + i, motion.B_dot.columns[k], point.viscous(i, j) * motion.B_dot.values[k]);
            }
      }
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
    std::vector<int> unknown(n_left);
    for (unsigned int i = 0; i < size(); ++i)
      if (place[i] >= 0)
        unknown[place[i]] = i;
    const Pattern &pattern = *A->pattern;
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        if (A->values[k] != 0.)
          f(unknown[pattern.rows[k]], unknown[j], A->values[k]);
    eliminated.for_entries(f);
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



  /** y += factor A x without what is eliminated. */
  void
  MixedMatrix::add_product_left(const double factor, const double *x, double *y, const unsigned int n_columns) const
  {
    const Pattern &pattern = *A->pattern;
    for (unsigned int c = 0; c < n_columns; ++c, x += size(), y += size())
      {
        left.resize(n_left);
        product.assign(n_left, 0.);
        for (unsigned int i = 0; i < size(); ++i)
          if (place[i] >= 0)
            left[place[i]] = x[i];
        for (int j = 0; j < pattern.size(); ++j)
          for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
            product[pattern.rows[k]] += A->values[k] * left[j];
        for (unsigned int i = 0; i < size(); ++i)
          if (place[i] >= 0)
            y[i] += factor * product[place[i]];
      }
  }



  void
  MixedMatrix::multiply(const double *x, double *y, const unsigned int n_columns) const
  {
    std::fill_n(y, std::size_t(size()) * n_columns, 0.);
    add_product_left(1., x, y, n_columns);
    eliminated.add_product(x, y, n_columns);
  }



  void
  MixedMatrix::solve_left(double *b, const unsigned int n_columns, const std::size_t length) const
  {
    n_solutions += n_columns;
    left.assign(std::size_t(n_left) * n_columns, 0.);
    for (unsigned int c = 0; c < n_columns; ++c)
      for (unsigned int i = 0; i < length; ++i)
        if (const int p = place[i]; p >= 0)
          left[p + std::size_t(c) * n_left] = b[i + c * length] * scale[p];
    solver->solve_columns(left.data(), n_columns, n_left);
    for (unsigned int c = 0; c < n_columns; ++c)
      for (unsigned int i = 0; i < length; ++i)
        if (const int p = place[i]; p >= 0)
          b[i + c * length] = left[p + std::size_t(c) * n_left] * scale[p];
  }



  void
  MixedMatrix::solve_condensed(double *b, const unsigned int n_columns) const
  {
    solve_left(b, n_columns, n);
  }



  void
  MixedMatrix::solve(double *b, const unsigned int n_columns) const
  {
    const std::size_t all = std::size_t(size()) * n_columns;
    solution.assign(b, b + all);
    eliminated.condense(solution.data(), n_columns);
    solve_left(solution.data(), n_columns, size());
    // what is left of the equations is solved for once more
    add_product_left(-1., solution.data(), b, n_columns);
    eliminated.refine(solution.data(), b, n_columns);
    solve_left(b, n_columns, size());
    eliminated.expand(b, n_columns);
    for (std::size_t i = 0; i < all; ++i)
      b[i] += solution[i];
  }



  bool
  MixedMatrix::has_inertia() const
  {
    return condensed && solver && solver->n_negative();
  }



  std::optional<unsigned int>
  MixedMatrix::n_squares_below(const double square) const
  {
    if (!has_inertia())
      return std::nullopt;
    SparseMatrix   moved = *condensed;
    const Pattern &p     = *motion.M.pattern;
    for (int j = 0; j < p.size(); ++j)
      for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
        if (motion.M.values[k] != 0.)
          moved.values[moved.pattern->position(p.rows[k], j)] -= (square + sigma * sigma) * motion.M.values[k];
    const auto other = make_solver(moved.pattern, library_in_use(), Ordering::columns);
    try
      {
        factorize_scaled(*other, moved);
      }
    catch (const SingularMatrix &)
      {
        return std::nullopt;
      }
    if (!other->n_negative() || *other->n_negative() < *solver->n_negative())
      return std::nullopt;
    return *other->n_negative() - *solver->n_negative();
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



  double
  MixedMatrix::work(const double *solution) const
  {
    double sum = 0;
    for (const Point &p : points)
      {
        const Eigen::Map<const Eigen::VectorXd> s(solution + n + p.first, p.F.rows());
        sum += s.cwiseAbs().dot((p.F * s).cwiseAbs());
      }
    return sum;
  }
} // namespace samara
