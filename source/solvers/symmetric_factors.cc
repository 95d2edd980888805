#include <samara/solvers/symmetric_factors.h>

#include <deal.II/lac/lapack_templates.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    using DenseBlock  = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    using ConstBlock  = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    using VectorBlock = Eigen::Map<Eigen::VectorXd>;

    constexpr int    of_block = 48, of_strip = 192; ///< columns that are eliminated, or changed, together
    constexpr double symmetric_enough = 1e-14;      ///< of the larger diagonal entry: as good as symmetric

    /** C = factor C + sign op(A) op(B) by BLAS; @p size: rows and columns of C, columns of op(A). */
    void
    multiply_by_blas(const char                                   *op_a,
                     const char                                   *op_b,
                     const std::array<dealii::types::blas_int, 3> &size,
                     const double                                  sign,
                     const double                                 *a,
                     const int                                     a_rows,
                     const double                                 *b,
                     const int                                     b_rows,
                     const double                                  factor,
                     double                                       *c,
                     const int                                     c_rows)
    {
      const dealii::types::blas_int stride[3] = {a_rows, b_rows, c_rows};
      dealii::gemm(
        op_a, op_b, &size[0], &size[1], &size[2], &sign, a, &stride[0], b, &stride[1], &factor, c, &stride[2]);
    }



    /** C = factor C + sign A B, or Aᵀ B, with m × n entries, k columns of A, or rows. */
    void
    add_product(const int     m,
                const int     n,
                const int     k,
                const double  sign,
                const double *a,
                const int     a_rows,
                const bool    is_transposed,
                const double *b,
                const int     b_rows,
                const double  factor,
                double       *c,
                const int     c_rows)
    {
      if (m <= 0 || n <= 0 || k <= 0)
        return;
      multiply_by_blas(is_transposed ? "T" : "N", "N", {m, n, k}, sign, a, a_rows, b, b_rows, factor, c, c_rows);
    }



    /** C = factor C + sign A Bᵀ, with m × n entries, k columns of A and B. */
    void
    add_product(const int     m,
                const int     n,
                const int     k,
                const double  sign,
                const double *a,
                const int     a_rows,
                const double *b,
                const int     b_rows,
                const double  factor,
                double       *c,
                const int     c_rows)
    {
      if (m <= 0 || n <= 0)
        return;
      multiply_by_blas("N", "T", {m, n, k}, sign, a, a_rows, b, b_rows, factor, c, c_rows);
    }
  } // namespace



  void
  SymmetricFactors::set_order(Supernodes new_structure)
  {
    structure = std::move(new_structure);
    place.resize(structure.order.size());
    for (unsigned int i = 0; i < place.size(); ++i)
      place[structure.order[i]] = i;
    local.assign(place.size(), 0);
    values.assign(structure.value_start.back(), 0.);
    pivots.assign(place.size(), 0.);
    most_rows = 0;
    for (int s = 0; s < structure.size(); ++s)
      most_rows = std::max(most_rows, structure.n_rows(s));
    work.resize(most_rows);
  }



  bool
  SymmetricFactors::split(const Pattern &pattern, const double *a)
  {
    skew.clear();
    const int           n = pattern.size();
    std::vector<double> diagonal(n, 0.);
    for (int j = 0; j < n; ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        diagonal[j] = std::max(diagonal[j], std::abs(a[k]));
    const std::size_t most = pattern.n_nonzeros() / 20 + 10;
    // entries of the transposed matrix come in the same order, column by column
    std::vector<int> next = pattern.column_start;
    for (int j = 0; j < n; ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        {
          const int    i          = pattern.rows[k];
          const double difference = a[k] - a[next[i]++];
          if (!(std::abs(difference) <= symmetric_enough * std::min(diagonal[i], diagonal[j])))
            {
              if (skew.size() == most || !std::isfinite(difference))
                return false;
              skew.push_back({i, j, 0.5 * difference});
            }
        }
    return true;
  }



  int
  SymmetricFactors::factorize(const Pattern &pattern, const double *a)
  {
    const int n_supernodes = structure.size();
    waiting.assign(n_supernodes, -1);
    next_waiting.assign(n_supernodes, -1);
    begin_waiting.assign(n_supernodes, 0);
    rcond = 0;
    std::vector<double> row_sizes(place.size(), 0.);
    for (int s = 0; s < n_supernodes; ++s)
      {
        assemble(s, pattern, a, row_sizes);
        const int end = structure.first[s + 1];
        for (int source = waiting[s], next; source >= 0; source = next)
          {
            next             = next_waiting[source];
            const int *rows  = structure.rows_of(source);
            const int  begin = begin_waiting[source];
            const int  last  = std::lower_bound(rows + begin, rows + structure.n_rows(source), end) - rows;
            subtract(s, source, begin, last);
            wait(source, last);
          }
        if (const int lost = eliminate(s); lost >= 0)
          return structure.order[structure.first[s] + lost];
        wait(s, structure.n_columns(s));
      }
    judge_pivots(row_sizes);
    return -1;
  }



  /** What is in the rows of a supernode from @p begin on is subtracted when the supernode of that row is made. */
  void
  SymmetricFactors::wait(const int source, const int begin)
  {
    if (begin == structure.n_rows(source))
      return;
    const int row = structure.rows_of(source)[begin];
    const int at  = std::upper_bound(structure.first.begin(), structure.first.end(), row) - structure.first.begin() - 1;
    begin_waiting[source] = begin;
    next_waiting[source]  = waiting[at];
    waiting[at]           = source;
  }



  void
  SymmetricFactors::assemble(const int s, const Pattern &pattern, const double *a, std::vector<double> &row_sizes)
  {
    const int  n_rows = structure.n_rows(s);
    const int *rows   = structure.rows_of(s);
    double    *L      = values.data() + structure.value_start[s];
    std::fill_n(L, std::size_t(n_rows) * structure.n_columns(s), 0.);
    for (int i = 0; i < n_rows; ++i)
      local[rows[i]] = i;
    for (int c = 0; c < structure.n_columns(s); ++c, L += n_rows)
      {
        const int j      = structure.order[structure.first[s] + c];
        auto      of_j   = skew.end();
        double    larger = 0;
        if (!skew.empty())
          of_j = std::lower_bound(skew.begin(), skew.end(), j, [](const Skew &e, const int column) {
            return e.column < column;
          });
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          {
            const int i     = pattern.rows[k];
            double    value = a[k];
            if (of_j != skew.end() && of_j->column == j && of_j->row == i)
              value -= (of_j++)->value;
            larger = std::max(larger, std::abs(value));
            if (place[i] >= structure.first[s] + c)
              L[local[place[i]]] = value;
          }
        row_sizes[structure.first[s] + c] = larger;
      }
  }



  void
  SymmetricFactors::subtract(const int s, const int source, const int begin, const int end)
  {
    const int     k = structure.n_columns(source), n_rows = structure.n_rows(source), height = structure.n_rows(s);
    const int    *rows = structure.rows_of(source);
    const double *L = values.data() + structure.value_start[source], *d = pivots.data() + structure.first[source];
    double       *to    = values.data() + structure.value_start[s];
    const int     width = end - begin;
    scaled.resize(std::max(scaled.size(), std::size_t(width) * k));
    for (int j = 0; j < k; ++j)
      for (int i = 0; i < width; ++i)
        scaled[i + std::size_t(j) * width] = d[j] * L[begin + i + std::size_t(j) * n_rows];
    for (int strip = begin; strip < end; strip += of_strip)
      {
        const int n = std::min(of_strip, end - strip), m = n_rows - strip;
        product.resize(std::max(product.size(), std::size_t(m) * n));
        add_product(m, n, k, 1., L + strip, n_rows, scaled.data() + strip - begin, width, 0., product.data(), m);
        for (int j = 0; j < n; ++j)
          {
            double *const       column = to + std::size_t(local[rows[strip + j]]) * height;
            const double *const from   = product.data() + std::size_t(j) * m;
            for (int i = j; i < m; ++i)
              column[local[rows[strip + i]]] -= from[i];
          }
      }
  }



  int
  SymmetricFactors::eliminate(const int s)
  {
    const int  n = structure.n_columns(s), height = structure.n_rows(s);
    double    *L = values.data() + structure.value_start[s], *d = pivots.data() + structure.first[s];
    const auto at = [&](const int i, const int j) -> double & { return L[i + std::size_t(j) * height]; };
    for (int first = 0; first < n; first += of_block)
      {
        const int w = std::min(of_block, n - first), behind = first + w, m = height - behind;
        for (int j = first; j < behind; ++j)
          {
            d[j] = at(j, j);
            if (!(std::abs(d[j]) > 0))
              return j;
            for (int k = j + 1; k < behind; ++k)
              {
                const double factor = at(k, j) / d[j];
                for (int i = k; i < behind; ++i)
                  at(i, k) -= factor * at(i, j);
              }
            for (int i = j + 1; i < behind; ++i)
              at(i, j) /= d[j];
          }
        if (m == 0)
          break;
        // X = B L⁻ᵀ, which is L D of the rows below
        DenseBlock       X(&at(behind, first), m, w, Eigen::OuterStride<>(height));
        const ConstBlock unit(&at(first, first), w, w, Eigen::OuterStride<>(height));
        unit.triangularView<Eigen::UnitLower>().transpose().solveInPlace<Eigen::OnTheRight>(X);
        const int left = n - behind;
        scaled.resize(std::max(scaled.size(), std::size_t(left) * w));
        for (int j = 0; j < w; ++j)
          {
            std::copy_n(&at(behind, first + j), left, scaled.begin() + std::size_t(j) * left);
            X.col(j) /= d[first + j];
          }
        for (int strip = 0; strip < left; strip += of_strip)
          add_product(m - strip,
                      std::min(of_strip, left - strip),
                      w,
                      -1.,
                      &at(behind + strip, first),
                      height,
                      scaled.data() + strip,
                      left,
                      1.,
                      &at(behind + strip, behind + strip),
                      height);
      }
    return -1;
  }



  void
  SymmetricFactors::judge_pivots(const std::vector<double> &row_sizes)
  {
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    n_negative_pivots = 0;
    for (unsigned int i = 0; i < pivots.size(); ++i)
      {
        const double size = std::abs(pivots[i]) / row_sizes[i];
        if (!std::isfinite(size))
          return;
        smallest = std::min(smallest, size);
        largest  = std::max(largest, size);
        n_negative_pivots += pivots[i] < 0;
      }
    rcond = pivots.empty() ? 1. : smallest / largest;
  }



  /** x ← L⁻¹ x */
  void
  SymmetricFactors::forward() const
  {
    for (int s = 0; s < structure.size(); ++s)
      {
        const int        n = structure.n_columns(s), height = structure.n_rows(s), m = height - n;
        const int       *below = structure.rows_of(s) + n;
        const double    *L     = values.data() + structure.value_start[s];
        const ConstBlock unit(L, n, n, Eigen::OuterStride<>(height)), rest(L + n, m, n, Eigen::OuterStride<>(height));
        VectorBlock      own(x.data() + structure.first[s], n), others(work.data(), m);
        unit.triangularView<Eigen::UnitLower>().solveInPlace(own);
        others.noalias() = rest * own;
        for (int i = 0; i < m; ++i)
          x[below[i]] -= others[i];
      }
  }



  /** x ← L⁻ᵀ x */
  void
  SymmetricFactors::backward() const
  {
    for (int s = structure.size() - 1; s >= 0; --s)
      {
        const int        n = structure.n_columns(s), height = structure.n_rows(s), m = height - n;
        const int       *below = structure.rows_of(s) + n;
        const double    *L     = values.data() + structure.value_start[s];
        const ConstBlock unit(L, n, n, Eigen::OuterStride<>(height)), rest(L + n, m, n, Eigen::OuterStride<>(height));
        VectorBlock      own(x.data() + structure.first[s], n), others(work.data(), m);
        for (int i = 0; i < m; ++i)
          others[i] = x[below[i]];
        own.noalias() -= rest.transpose() * others;
        unit.triangularView<Eigen::UnitLower>().transpose().solveInPlace(own);
      }
  }



  void
  SymmetricFactors::solve_symmetric(double *b) const
  {
    x.resize(place.size());
    for (unsigned int i = 0; i < place.size(); ++i)
      x[i] = b[structure.order[i]];
    forward();
    for (unsigned int i = 0; i < place.size(); ++i)
      x[i] /= pivots[i];
    backward();
    for (unsigned int i = 0; i < place.size(); ++i)
      b[structure.order[i]] = x[i];
  }



  void
  SymmetricFactors::forward_half(double *b) const
  {
    x.resize(place.size());
    for (unsigned int i = 0; i < place.size(); ++i)
      x[i] = b[structure.order[i]];
    forward();
    for (unsigned int i = 0; i < place.size(); ++i)
      b[structure.order[i]] = x[i] / std::sqrt(std::abs(pivots[i]));
  }



  void
  SymmetricFactors::backward_half(double *b) const
  {
    x.resize(place.size());
    for (unsigned int i = 0; i < place.size(); ++i)
      x[i] = b[structure.order[i]] / std::sqrt(std::abs(pivots[i]));
    backward();
    for (unsigned int i = 0; i < place.size(); ++i)
      b[structure.order[i]] = x[i];
  }



  void
  SymmetricFactors::forward_columns(const unsigned int n_columns) const
  {
    const std::size_t size = place.size();
    for (int s = 0; s < structure.size(); ++s)
      {
        const int        n = structure.n_columns(s), height = structure.n_rows(s), m = height - n;
        const int       *below = structure.rows_of(s) + n;
        const double    *L     = values.data() + structure.value_start[s];
        double          *own   = x.data() + structure.first[s];
        const ConstBlock unit(L, n, n, Eigen::OuterStride<>(height));
        DenseBlock       of_own(own, n, n_columns, Eigen::OuterStride<>(size));
        unit.triangularView<Eigen::UnitLower>().solveInPlace(of_own);
        add_product(m, n_columns, n, 1., L + n, height, false, own, size, 0., work.data(), m);
        for (unsigned int c = 0; c < n_columns; ++c)
          for (int i = 0; i < m; ++i)
            x[below[i] + c * size] -= work[i + std::size_t(c) * m];
      }
  }



  void
  SymmetricFactors::backward_columns(const unsigned int n_columns) const
  {
    const std::size_t size = place.size();
    for (int s = structure.size() - 1; s >= 0; --s)
      {
        const int        n = structure.n_columns(s), height = structure.n_rows(s), m = height - n;
        const int       *below = structure.rows_of(s) + n;
        const double    *L     = values.data() + structure.value_start[s];
        double          *own   = x.data() + structure.first[s];
        const ConstBlock unit(L, n, n, Eigen::OuterStride<>(height));
        DenseBlock       of_own(own, n, n_columns, Eigen::OuterStride<>(size));
        for (unsigned int c = 0; c < n_columns; ++c)
          for (int i = 0; i < m; ++i)
            work[i + std::size_t(c) * m] = x[below[i] + c * size];
        add_product(n, n_columns, m, -1., L + n, height, true, work.data(), m, 1., own, size);
        unit.triangularView<Eigen::UnitLower>().transpose().solveInPlace(of_own);
      }
  }



  void
  SymmetricFactors::solve_columns(double *b, const unsigned int n_columns, const std::size_t size) const
  {
    if (n_columns == 1 || (n_passes > 0 && !skew.empty()))
      {
        for (unsigned int c = 0; c < n_columns; ++c)
          solve(b + c * size);
        return;
      }
    const std::size_t n = place.size();
    x.resize(n * n_columns);
    work.resize(std::max<std::size_t>(work.size(), std::size_t(most_rows) * n_columns));
    for (unsigned int c = 0; c < n_columns; ++c)
      for (std::size_t i = 0; i < n; ++i)
        x[i + c * n] = b[structure.order[i] + c * size];
    forward_columns(n_columns);
    for (unsigned int c = 0; c < n_columns; ++c)
      for (std::size_t i = 0; i < n; ++i)
        x[i + c * n] /= pivots[i];
    backward_columns(n_columns);
    for (unsigned int c = 0; c < n_columns; ++c)
      for (std::size_t i = 0; i < n; ++i)
        b[structure.order[i] + c * size] = x[i + c * n];
  }



  void
  SymmetricFactors::solve(double *b) const
  {
    if (n_passes == 0 || skew.empty())
      return solve_symmetric(b);
    right_side.assign(b, b + place.size());
    solve_symmetric(b);
    std::vector<double> r;
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        r = right_side;
        for (const auto &e : skew)
          r[e.row] -= e.value * b[e.column];
        solve_symmetric(r.data());
        std::copy(r.begin(), r.end(), b);
      }
  }
} // namespace samara
