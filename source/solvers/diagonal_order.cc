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



    /**
     * From so much work an entry of the factors on, of groups, nested dissection may pay: of a cube of 500 balls, a
     * shell of 30 × 30 nodes. It takes about as long as factors of that size.
     */
    constexpr double worth_dissection = 50;



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
      std::vector<int> order;
      double           work   = 0;
      const auto       try_by = [&](const int ordering) {
        common.nmethods           = 1;
        common.method[0].ordering = ordering;
        cholmod_factor *factor    = cholmod_analyze(&matrix, &common);
        if (factor != nullptr && (order.empty() || common.fl < work))
          {
            order.assign(static_cast<int *>(factor->Perm), static_cast<int *>(factor->Perm) + n);
            work = common.fl;
          }
        cholmod_free_factor(&factor, &common);
      };
      try_by(CHOLMOD_AMD);
      if (work > worth_dissection * common.lnz)
        try_by(CHOLMOD_METIS);
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



    /**
     * The same elimination with each group behind all that it depends on and next to the last of these: the tree of the
     * groups each one acts on first, branch by branch. Factors are filled alike.
     */
    std::vector<int>
    branch_by_branch(const Groups &groups, const std::vector<int> &order)
    {
      const int        n = groups.size();
      std::vector<int> place(n), parent(n, -1), ancestor(n, -1);
      for (int i = 0; i < n; ++i)
        place[order[i]] = i;
      for (int i = 0; i < n; ++i)
        for (int k = groups.neighbour_start[order[i]]; k < groups.neighbour_start[order[i] + 1]; ++k)
          for (int j = place[groups.neighbours[k]], next; j >= 0 && j < i; j = next)
            {
              next        = ancestor[j]; // ways are shortened as they are gone
              ancestor[j] = i;
              if (next < 0)
                parent[j] = i;
            }
      // children of each, the last one first, as a stack turns them round
      std::vector<int> child(n, -1), sibling(n, -1), stack, result;
      for (int i = 0; i < n; ++i)
        if (parent[i] >= 0)
          {
            sibling[i]       = child[parent[i]];
            child[parent[i]] = i;
          }
      for (int root = 0; root < n; ++root)
        if (parent[root] < 0)
          for (stack.push_back(root); !stack.empty();)
            {
              const int i = stack.back();
              if (child[i] >= 0)
                {
                  stack.push_back(child[i]);
                  child[i] = sibling[child[i]];
                  continue;
                }
              result.push_back(order[i]);
              stack.pop_back();
            }
      return result;
    }
  } // namespace



  DiagonalOrder::DiagonalOrder(const Pattern &pattern, const std::vector<bool> &is_late)
  {
    AssertDimension(is_late.size(), pattern.size());
    const Groups           groups = groups_of(pattern, is_late);
    const std::vector<int> order  = branch_by_branch(groups, postponed(groups, fill_reducing_order(groups)));
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
    std::vector<int> mark(n, -1);
    parent.assign(n, -1);
    below.assign(n, 0);
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



  namespace
  {
    /** Consecutive groups, their unknowns, those behind them in their columns, and how many of these entries are zeros.
     */
    struct Supernode
    {
      int    first, end, n_columns, n_below;
      double n_zeros;
    };

    /** A supernode with the one behind it that it acts on first. */
    Supernode
    united(const Supernode &s, const Supernode &next)
    {
      return {s.first,
              next.end,
              s.n_columns + next.n_columns,
              next.n_below,
              s.n_zeros + next.n_zeros + double(s.n_columns) * (next.n_columns + next.n_below - s.n_below)};
    }

    /** Few columns are worth many zeros: products of larger matrices are faster. */
    bool
    is_worth_its_zeros(const Supernode &s)
    {
      const double n = s.n_columns, share = s.n_zeros / (0.5 * n * (n + 1) + n * s.n_below);
      return share < (n <= 24 ? 0.6 : n <= 64 ? 0.2 : n <= 160 ? 0.1 : 0.05);
    }
  } // namespace



  std::vector<int>
  DiagonalOrder::first_groups() const
  {
    const int              n = parent.size();
    std::vector<Supernode> exact, all; // the second from the last one on
    for (int g = 0; g < n; ++g)
      {
        const Supernode group = {g, g + 1, weight(g), below[g], 0};
        if (g > 0 && parent[g - 1] == g && below[g - 1] == below[g] + weight(g))
          exact.back() = united(exact.back(), group);
        else
          exact.push_back(group);
      }
    for (auto s = exact.rbegin(); s != exact.rend(); ++s)
      {
        all.push_back(*s);
        while (all.size() > 1)
          {
            const Supernode &last = all.back(), &next = all[all.size() - 2];
            const int        acts_on = parent[last.end - 1];
            if (acts_on < 0 || acts_on >= next.end)
              break;
            const Supernode both = united(last, next);
            if (!is_worth_its_zeros(both))
              break;
            all.pop_back();
            all.back() = both;
          }
      }
    std::vector<int> result;
    for (auto s = all.rbegin(); s != all.rend(); ++s)
      result.push_back(s->first);
    result.push_back(n);
    return result;
  }



  Supernodes
  DiagonalOrder::supernodes() const
  {
    const std::vector<int> first_group = first_groups();
    const int              n = parent.size(), n_supernodes = static_cast<int>(first_group.size()) - 1;
    // the supernode a group is the last one of
    std::vector<int>              ends_with(n, -1);
    std::vector<std::vector<int>> groups_below(n_supernodes);
    for (int s = 0; s < n_supernodes; ++s)
      ends_with[first_group[s + 1] - 1] = s;
    for (int i = 0; i < n; ++i)
      for (int k = row_start[i]; k < row_start[i + 1]; ++k)
        if (const int s = ends_with[rows[k]]; s >= 0)
          groups_below[s].push_back(i);

    Supernodes result;
    result.order = members;
    result.first.push_back(0);
    result.row_start = result.value_start = {0};
    for (int s = 0; s < n_supernodes; ++s)
      {
        result.first.push_back(member_start[first_group[s + 1]]);
        for (int i = result.first[s]; i < result.first[s + 1]; ++i)
          result.rows.push_back(i);
        for (const int group : groups_below[s])
          for (int i = member_start[group]; i < member_start[group + 1]; ++i)
            result.rows.push_back(i);
        result.row_start.push_back(result.rows.size());
        result.value_start.push_back(result.value_start.back() + std::size_t(result.n_rows(s)) * result.n_columns(s));
      }
    return result;
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
