#include <samara/solvers/panels.h>

#include <deal.II/base/exceptions.h>

#include <limits>

namespace samara
{
  namespace
  {
    /** A set of numbers that is emptied at no cost. */
    class Marks
    {
    public:
      explicit Marks(const int n)
        : stamps(n, 0)
      {}

      void
      clear()
      {
        ++stamp;
      }
      bool
      contains(const int i) const
      {
        return stamps[i] == stamp;
      }
      /** Whether it is new. */
      bool
      insert(const int i)
      {
        const bool is_new = !contains(i);
        stamps[i]         = stamp;
        return is_new;
      }

    private:
      std::vector<int> stamps;
      int              stamp = 0;
    };



    /** About the processor cycles of a panel in a solution; a wrong one costs some per cent only. */
    double
    cost(const int width, const int n_outside, const int parts)
    {
      const int n_doubles   = width * parts;
      const int n_registers = n_doubles / 4 + n_doubles % 4 / 2 + n_doubles % 2;
      return 20 + parts * parts * width * (width - 1) / 2 + parts * (1 + n_registers) * n_outside;
    }



    /** The width of the panel that begins at each row if one does, for the smallest sum of costs. */
    std::vector<int>
    best_widths(const int n, const Pivots &pivots, const int parts)
    {
      const auto         &lower = pivots.lower, &upper = pivots.upper;
      std::vector<double> cost_from(n + 1, 0.);
      std::vector<int>    widths(n);
      Marks               outside(n);
      for (int first = n - 1; first >= 0; --first)
        {
          cost_from[first] = std::numeric_limits<double>::max();
          outside.clear();
          int n_outside = 0;
          for (int row = first; row < std::min(n, first + PanelStructure::max_width); ++row)
            {
              // its own column was outside of the rows before
              n_outside -= outside.contains(row);
              for (int k = lower.start[row]; k < lower.start[row + 1] && lower.columns[k] < first; ++k)
                n_outside += outside.insert(lower.columns[k]);
              for (int k = upper.start[row]; k < upper.start[row + 1]; ++k)
                n_outside += outside.insert(upper.columns[k]);
              const int    width = row + 1 - first;
              const double total = cost(width, n_outside, parts) + cost_from[row + 1];
              if (total < cost_from[first])
                {
                  cost_from[first] = total;
                  widths[first]    = width;
                }
            }
        }
      return widths;
    }



    /** Append the columns from @p begin to before @p end that the rows of a panel have. */
    void
    unite(const RowLists   &lists,
          const Panel      &panel,
          const int         begin,
          const int         end,
          Marks            &found,
          std::vector<int> &columns)
    {
      const auto old_size = columns.size();
      found.clear();
      for (int k = lists.start[panel.first]; k < lists.start[panel.first + panel.width]; ++k)
        if (lists.columns[k] >= begin && lists.columns[k] < end && found.insert(lists.columns[k]))
          columns.push_back(lists.columns[k]);
      std::sort(columns.begin() + old_size, columns.end());
    }
  } // namespace



  PanelStructure::PanelStructure(const Pattern &pattern, const Pivots &pivots, const int parts)
    : panel_of(pattern.size())
  {
    const int n = pattern.size();
    AssertDimension(pivots.row_order.size(), n);
    AssertDimension(pivots.column_order.size(), n);
    AssertDimension(pivots.lower.start.size(), n + 1);
    AssertDimension(pivots.upper.start.size(), n + 1);
    const auto widths = best_widths(n, pivots, parts);
    Marks      found(n);
    for (int first = 0; first < n; first += widths[first])
      {
        Panel panel{};
        panel.first       = first;
        panel.width       = widths[first];
        panel.lower_begin = lower_columns.size();
        unite(pivots.lower, panel, 0, first, found, lower_columns);
        panel.lower_end   = lower_columns.size();
        panel.upper_begin = upper_columns.size();
        unite(pivots.upper, panel, first + panel.width, n, found, upper_columns);
        panel.upper_end = upper_columns.size();
        add(panel);
      }
    place_values();
    find_runs(pattern, pivots);
    panel_of = std::vector<int>();
    for (auto *const list : {&lower_columns, &upper_columns, &sources})
      list->shrink_to_fit();
    panels.shrink_to_fit();
  }



  void
  PanelStructure::add(Panel panel)
  {
    std::fill_n(panel_of.begin() + panel.first, panel.width, panels.size());
    panel.sources_begin = sources.size();
    for (int k = panel.lower_begin; k < panel.lower_end; ++k)
      if (k == panel.lower_begin || panel_of[lower_columns[k]] != sources.back())
        sources.push_back(panel_of[lower_columns[k]]);
    panel.sources_end = sources.size();
    panels.push_back(panel);
  }



  void
  PanelStructure::place_values()
  {
    // in the order in which solutions read them
    for (auto panel = panels.begin(); panel != panels.end(); ++panel)
      {
        panel->lower_values = n_lower_values;
        n_lower_values += panel->width * (panel->lower_end - panel->lower_begin) + panel->n_inside();
      }
    for (auto panel = panels.rbegin(); panel != panels.rend(); ++panel)
      {
        panel->upper_values = n_upper_values;
        n_upper_values += panel->width * (panel->upper_end - panel->upper_begin) + panel->n_inside();
      }
  }



  void
  PanelStructure::find_runs(const Pattern &pattern, const Pivots &pivots)
  {
    const int        n = pattern.size();
    std::vector<int> new_row(n), new_column(n), next(panels.size() + 1, 0);
    for (int i = 0; i < n; ++i)
      {
        new_row[pivots.row_order[i]]       = i;
        new_column[pivots.column_order[i]] = i;
      }
    const auto for_each = [&](const auto &f) {
      for (int j = 0; j < n; ++j)
        for (int k = pattern.column_start[j], length; k < pattern.column_start[j + 1]; k += length)
          {
            const int row = new_row[pattern.rows[k]], panel = panel_of[row];
            length = 1;
            while (k + length < pattern.column_start[j + 1] && new_row[pattern.rows[k + length]] == row + length &&
                   panel_of[row + length] == panel)
              ++length;
            f(panel, Run{k, new_column[j] * panels[panel].width + row - panels[panel].first, length});
          }
    };
    for_each([&](const int panel, const Run &) { ++next[panel + 1]; });
    for (unsigned int i = 0; i < panels.size(); ++i)
      {
        next[i + 1] += next[i];
        panels[i].runs_begin = next[i];
        panels[i].runs_end   = next[i + 1];
      }
    runs.resize(next.back());
    for_each([&](const int panel, const Run &run) { runs[next[panel]++] = run; });
  }
} // namespace samara
