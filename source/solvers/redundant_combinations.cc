// The combinations X of redundant rows: GᵀX = 0, X = 1 on the rows left out.

#include <samara/base/dense.h>
#include <samara/solvers/part_without.h>
#include <samara/solvers/redundant_rows.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** What entries of combinations, and rows beside them, may miss: much less than all that is decided by them. */
    constexpr double negligible = 1e-7;
  } // namespace



  void
  RedundantRows::factorize(const std::vector<unsigned int> &left_out)
  {
    if (!solver || left_out != left_out_of_pattern)
      {
        // a saddle-point matrix with a diagonal first block
        PartOfPattern part  = part_without(system.layout, *K.pattern, left_out, [this](const int i, const int j) {
          return (i < n) != (j < n);
        });
        pattern             = part.pattern;
        kept                = std::move(part.kept);
        saddle              = std::make_unique<SparseMatrix>(pattern);
        solver              = make_solver(pattern);
        left_out_of_pattern = left_out;
      }
    std::vector<double> factor(n + m, 0.);
    for (int i = 0; i < n; ++i)
      factor[i] = 1 / unit[i];
    for (int i = 0; i < m; ++i)
      factor[n + i] = scale[i];
    for (const auto i : left_out)
      factor[n + i] = 0;
    for (int j = 0; j < n + m; ++j)
      for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
        {
          const int i       = pattern->rows[k];
          saddle->values[k] = i != j ? K.values[kept[k]] * factor[i] * factor[j] : i < n || factor[i] == 0. ? 1. : 0.;
        }
    solver->factorize(*saddle);
  }



  std::vector<std::vector<int>>
  RedundantRows::columns_apart() const
  {
    std::vector<std::vector<int>>  groups;
    std::vector<std::vector<bool>> is_taken;
    for (unsigned int j = 0; j < rows_of.size(); ++j)
      {
        unsigned int group = 0;
        while (group < groups.size() &&
               std::any_of(rows_of[j].begin(), rows_of[j].end(), [&](const int i) { return is_taken[group][i]; }))
          ++group;
        if (group == groups.size())
          {
            groups.emplace_back();
            is_taken.emplace_back(m, false);
          }
        groups[group].push_back(j);
        for (const int i : rows_of[j])
          is_taken[group][i] = true;
      }
    return groups;
  }



  void
  RedundantRows::add_row(const int i, const double factor, double *sum) const
  {
    const int column = n + i;
    for (int k = K.pattern->column_start[column]; k < K.pattern->column_start[column + 1]; ++k)
      if (const int row = K.pattern->rows[k]; row < n)
        sum[row] += factor * K.values[k] * scale[i] / unit[row];
  }



  void
  RedundantRows::find_combination(const std::vector<unsigned int> &left_out, const int j)
  {
    // [I Gᵀ; G 0] (u, X) = (−row left out, 0): G of the rows kept; u is what of the row is not in their span
    std::vector<double> b(n + m, 0.);
    add_row(left_out[j], -1, b.data());
    solver->solve(b.data());
    X.col(j)          = Eigen::Map<const Eigen::VectorXd>(b.data() + n, m);
    X(left_out[j], j) = 1;
    independence[j]   = Eigen::Map<const Eigen::VectorXd>(b.data(), n).norm();
    find_rows_of(j);
  }



  void
  RedundantRows::find_rows_of(const int j)
  {
    rows_of[j].clear();
    is_full[j] = true;
    for (int i = 0; i < m; ++i)
      if (!(std::abs(X(i, j)) <= negligible))
        rows_of[j].push_back(i);
  }



  RedundantRows::Entries
  RedundantRows::entries() const
  {
    Entries result{rows_of, {}};
    for (unsigned int j = 0; j < rows_of.size(); ++j)
      {
        result.values.emplace_back();
        for (const int i : rows_of[j])
          result.values[j].push_back(X(i, j));
      }
    return result;
  }



  RedundantRows::Entry
  RedundantRows::largest_entry() const
  {
    Entry largest;
    for (unsigned int j = 0; j < rows_of.size(); ++j)
      for (const int i : rows_of[j])
        // what is no number is larger than all
        if (const double size = std::abs(X(i, j)); size > largest.size || std::isnan(size))
          largest = {size, i, static_cast<int>(j)};
    return largest;
  }



  void
  RedundantRows::find_combinations(const std::vector<unsigned int> &left_out)
  {
    const int  d        = left_out.size();
    const bool is_known = left_out == left_out_of_X;
    left_out_of_X       = left_out;
    independence.assign(d, 0.);
    if (is_known)
      for (const auto &group : columns_apart())
        find_together(left_out, group);
    else
      {
        X = Eigen::MatrixXd::Zero(m, d);
        rows_of.assign(d, {});
        is_full.assign(d, false);
        for (int j = 0; j < d; ++j)
          find_combination(left_out, j);
      }
    ++n_checks;
  }



  void
  RedundantRows::find_together(const std::vector<unsigned int> &left_out, const std::vector<int> &group)
  {
    if (group.size() == 1)
      return find_combination(left_out, group[0]);
    // with weights that are all different, so that what is not in the span of others does not cancel
    const auto          weight = [](const int j) { return 1 + 0.5 * std::sin(1. + 2.3 * j); };
    std::vector<double> b(n + m, 0.);
    for (const int j : group)
      add_row(left_out[j], -weight(j), b.data());
    solver->solve(b.data());
    std::vector<double> u(n);
    const double        together = Eigen::Map<const Eigen::VectorXd>(b.data(), n).norm();
    for (const int j : group)
      {
        if (is_full[j])
          X.col(j).setZero();
        is_full[j] = false;
        for (const int i : rows_of[j])
          X(i, j) = b[n + i] / weight(j);
        X(left_out[j], j) = 1;
        // is it one by itself?
        std::fill(u.begin(), u.end(), 0.);
        for (const int i : rows_of[j])
          add_row(i, X(i, j), u.data());
        independence[j] = Eigen::Map<const Eigen::VectorXd>(u.data(), n).norm();
        if (independence[j] > negligible || together > negligible)
          find_combination(left_out, j);
      }
  }



  Eigen::MatrixXd
  RedundantRows::combinations(const State &state)
  {
    assemble(state);
    factorize(state.left_out);
    find_combinations(state.left_out);
    Eigen::MatrixXd of_rows = X;
    for (int i = 0; i < m; ++i)
      of_rows.row(i) *= scale[i];
    return of_rows;
  }



  void
  RedundantRows::make_least(State &state)
  {
    if (state.left_out.empty())
      return;
    assemble(state);
    factorize(state.left_out);
    find_combinations(state.left_out);
    Eigen::VectorXd lambda(m);
    for (int i = 0; i < m; ++i)
      lambda(i) = scale[i] > 0 ? state.multipliers[i] / scale[i] : 0.;
    const Eigen::VectorXd least = X * SymmetricSolve(X.transpose() * X).solve(X.transpose() * lambda);
    for (int i = 0; i < m; ++i)
      state.multipliers[i] -= scale[i] * least(i);
  }
} // namespace samara
