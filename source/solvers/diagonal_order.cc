#include <samara/solvers/diagonal_order.h>

#include <deal.II/base/exceptions.h>

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>

namespace samara
{
  namespace
  {
    /** Groups of unknowns with the same neighbours, and the graph of the groups. */
    struct Groups
    {
      std::vector<int>  of_unknown;
      std::vector<int>  members, member_start;
      std::vector<int>  neighbours, neighbour_start; ///< others than the group itself, ascending
      std::vector<bool> is_late;

      int
      size() const
      {
        return member_start.size() - 1;
      }
      int
      weight(const int group) const
      {
        return member_start[group + 1] - member_start[group];
      }
    };



    Groups
    groups_of(const Pattern &pattern, const std::vector<bool> &is_late)
    {
      const int  n = pattern.size();
      Groups     groups;
      const auto has_same_column = [&](const int i, const int j) {
        const auto begin = [&](const int c) { return pattern.rows.begin() + pattern.column_start[c]; };
        return std::equal(begin(i), begin(i + 1), begin(j), begin(j + 1)) && is_late[i] == is_late[j];
      };
      // unknowns of a node follow each other: only neighbours in number are compared
      groups.of_unknown.resize(n);
      for (int j = 0; j < n; ++j)
        {
          if (j == 0 || !has_same_column(j - 1, j))
            {
              groups.member_start.push_back(j);
              groups.is_late.push_back(is_late[j]);
            }
          groups.of_unknown[j] = groups.member_start.size() - 1;
        }
      groups.member_start.push_back(n);
      groups.members.resize(n);
      std::iota(groups.members.begin(), groups.members.end(), 0);
      groups.neighbour_start = {0};
      for (int group = 0; group < groups.size(); ++group)
        {
          const int j    = groups.member_start[group];
          int       last = -1;
          for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
            if (const int other = groups.of_unknown[pattern.rows[k]]; other != group && other != last)
              groups.neighbours.push_back(last = other);
          groups.neighbour_start.push_back(groups.neighbours.size());
        }
      return groups;
    }



    /** The groups in an order that fills little. */
    std::vector<int>
    fill_reducing_order(const Groups &groups)
    {
      const int        n     = groups.size();
      std::vector<int> start = {0}, rows;
      for (int j = 0; j < n; ++j)
        {
          rows.push_back(j);
          for (int k = groups.neighbour_start[j]; k < groups.neighbour_start[j + 1]; ++k)
            if (groups.neighbours[k] > j)
              rows.push_back(groups.neighbours[k]);
          start.push_back(rows.size());
        }
      cholmod_common common;
      cholmod_start(&common);
      common.supernodal = CHOLMOD_SIMPLICIAL;
      common.print      = 0;
      cholmod_sparse matrix{};
      matrix.nrow = matrix.ncol = n;
      matrix.nzmax              = rows.size();
      matrix.p                  = start.data();
      matrix.i                  = rows.data();
      matrix.stype              = -1; // its lower half
      matrix.itype              = CHOLMOD_INT;
      matrix.xtype              = CHOLMOD_PATTERN;
      matrix.sorted = matrix.packed = true;
      cholmod_factor  *factor       = cholmod_analyze(&matrix, &common);
      std::vector<int> order;
      if (factor != nullptr)
        order.assign(static_cast<int *>(factor->Perm), static_cast<int *>(factor->Perm) + n);
      cholmod_free_factor(&factor, &common);
      cholmod_finish(&common);
      if (order.empty() && n > 0)
        throw std::bad_alloc();
      return order;
    }



    /** Groups that are late go behind all of their neighbours. */
    std::vector<int>
    postponed(const Groups &groups, const std::vector<int> &order)
    {
      const int        n = groups.size();
      std::vector<int> rank(n);
      for (int i = 0; i < n; ++i)
        rank[order[i]] = 2 * i;
      std::vector<int> key = rank;
      for (int group = 0; group < n; ++group)
        if (groups.is_late[group])
          for (int k = groups.neighbour_start[group]; k < groups.neighbour_start[group + 1]; ++k)
            if (!groups.is_late[groups.neighbours[k]])
              key[group] = std::max(key[group], rank[groups.neighbours[k]] + 1);
      std::vector<int> result = order;
      std::stable_sort(result.begin(), result.end(), [&](const int a, const int b) { return key[a] < key[b]; });
      return result;
    }
  } // namespace



  DiagonalOrder::DiagonalOrder(const Pattern &pattern, const std::vector<bool> &is_late)
  {
    AssertDimension(is_late.size(), pattern.size());
    const Groups           groups = groups_of(pattern, is_late);
    const std::vector<int> order  = postponed(groups, fill_reducing_order(groups));
    const int              n      = groups.size();
    std::vector<int>       place(n);
    member_start = {0};
    for (int i = 0; i < n; ++i)
      {
        place[order[i]] = i;
        members.insert(members.end(),
                       groups.members.begin() + groups.member_start[order[i]],
                       groups.members.begin() + groups.member_start[order[i] + 1]);
        member_start.push_back(members.size());
      }

    // rows of L: the ways from the neighbours up the elimination tree, which they make on their way
    std::vector<int> parent(n, -1), mark(n, -1), below(n, 0);
    row_start = {0};
    for (int i = 0; i < n; ++i)
      {
        mark[i] = i;
        for (int k = groups.neighbour_start[order[i]]; k < groups.neighbour_start[order[i] + 1]; ++k)
          for (int j = place[groups.neighbours[k]]; j < i && mark[j] != i; j = parent[j])
            {
              mark[j] = i;
              rows.push_back(j);
              below[j] += member_start[i + 1] - member_start[i];
              if (parent[j] < 0)
                parent[j] = i;
            }
        std::sort(rows.begin() + row_start.back(), rows.end());
        row_start.push_back(rows.size());
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0, left = below[i] + member_start[i + 1] - member_start[i] - 1;
           member_start[i] + j < member_start[i + 1];
           ++j, --left)
        {
          n_entries += 2. * left + 1;
          n_operations += double(left) * (left + 1);
        }
  }



  Pivots
  DiagonalOrder::pivots() const
  {
    const int n = members.size(), n_groups = member_start.size() - 1;
    Pivots    result;
    result.row_order = result.column_order = members;
    // rows of U are columns of L
    std::vector<int> column_start(n_groups + 1, 0), columns(rows.size());
    for (const int row : rows)
      ++column_start[row + 1];
    std::partial_sum(column_start.begin(), column_start.end(), column_start.begin());
    std::vector<int> next(column_start.begin(), column_start.end() - 1);
    for (int i = 0; i < n_groups; ++i)
      for (int k = row_start[i]; k < row_start[i + 1]; ++k)
        columns[next[rows[k]]++] = i;

    const auto add_group = [&](const int group, std::vector<int> &to) {
      for (int i = member_start[group]; i < member_start[group + 1]; ++i)
        to.push_back(i);
    };
    result.lower.start.reserve(n + 1);
    result.upper.start.reserve(n + 1);
    result.lower.columns.reserve(n_entries / 2);
    result.upper.columns.reserve(n_entries / 2);
    result.lower.start = result.upper.start = {0};
    for (int group = 0; group < n_groups; ++group)
      for (int i = member_start[group]; i < member_start[group + 1]; ++i)
        {
          for (int k = row_start[group]; k < row_start[group + 1]; ++k)
            add_group(rows[k], result.lower.columns);
          for (int j = member_start[group]; j < i; ++j)
            result.lower.columns.push_back(j);
          for (int j = i + 1; j < member_start[group + 1]; ++j)
            result.upper.columns.push_back(j);
          for (int k = column_start[group]; k < column_start[group + 1]; ++k)
            add_group(columns[k], result.upper.columns);
          result.lower.start.push_back(result.lower.columns.size());
          result.upper.start.push_back(result.upper.columns.size());
        }
    return result;
  }



  bool
  is_structure_symmetric(const Pattern &pattern)
  {
    // entries of the transposed matrix come in the same order, column by column
    std::vector<int> next = pattern.column_start;
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        {
          const int i = pattern.rows[k];
          if (next[i] == pattern.column_start[i + 1] || pattern.rows[next[i]] != j)
            return false;
          ++next[i];
        }
    return true;
  }
} // namespace samara
