#include <samara/solvers/panel_factors.h>
#include <samara/solvers/registers.h>

#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    using Complex = std::complex<double>;

    inline double
    square(const double a)
    {
      return a * a;
    }
    /** Of the magnitude; std::norm looks for infinities, too. */
    inline double
    square(const Complex &a)
    {
      return a.real() * a.real() + a.imag() * a.imag();
    }

    inline double
    inverse(const double a)
    {
      return 1 / a;
    }
    inline Complex
    inverse(const Complex &a)
    {
      const double f = 1 / square(a);
      return {a.real() * f, -a.imag() * f};
    }

    inline double
    largest_part(const double a)
    {
      return a;
    }
    inline double
    largest_part(const Complex &a)
    {
      return std::max(a.real(), a.imag());
    }



    /** A column of w numbers in registers. */
    template <int w, typename Number>
    using Column = Registers<w * parts<Number>>;

    template <int w, typename Number>
    inline Column<w, Number>
    load(const Number *from)
    {
      return Column<w, Number>::load(doubles(from));
    }
    template <int n, typename Number>
    inline void
    store(const Registers<n> &column, Number *to)
    {
      column.store(doubles(to));
    }

    template <int k, int n>
    inline double
    element(const Registers<n> &column, const double *)
    {
      return column.template get<k>();
    }
    template <int k, int n>
    inline Complex
    element(const Registers<n> &column, const Complex *)
    {
      return {column.template get<2 * k>(), column.template get<2 * k + 1>()};
    }

    template <int n>
    inline void
    subtract_product(Registers<n> &x, const double *a, const double factor)
    {
      x.subtract_product(a, factor);
    }
    template <int n>
    inline void
    subtract_product(Registers<n> &x, const Complex *a, const Complex &factor)
    {
      x.subtract_product(doubles(a), factor.real());
      Registers<n> by_imaginary = Registers<n>::zero();
      by_imaginary.subtract_product(doubles(a), factor.imag());
      x.add(by_imaginary.turned());
    }

    /** Numbers that the rows of columns are multiplied by. */
    template <typename Number, int w>
    struct RowFactors
    {
      explicit RowFactors(const double *factors)
        : factors(factors)
      {}

      void
      apply(Registers<w> &x) const
      {
        x.multiply(factors);
      }

    private:
      const double *factors;
    };

    template <int w>
    struct RowFactors<Complex, w>
    {
      explicit RowFactors(const Complex *factors)
      {
        for (int i = 0; i < w; ++i)
          {
            real[2 * i] = real[2 * i + 1] = factors[i].real();
            imag[2 * i] = imag[2 * i + 1] = factors[i].imag();
          }
      }

      void
      apply(Registers<2 * w> &x) const
      {
        Registers<2 *w> turned = x.turned();
        turned.multiply(imag);
        x.multiply(real);
        x.add(turned);
      }

    private:
      double real[2 * w], imag[2 * w];
    };



    /** Forward substitution of one column by columns @p k to before @p end of a unit triangle; zeros above. */
    template <int k, int end, int w, typename Number>
    inline void
    substitute(Column<w, Number> &x, const Number *triangle)
    {
      if constexpr (k < end)
        {
          subtract_product(x, triangle + k * w, element<k>(x, triangle));
          substitute<k + 1, end, w>(x, triangle);
        }
    }

    /**
     * Eliminate a square @p block from its column @p c on.
     * @param multipliers receives the unit lower triangle, zeros above it
     * @return the row without a pivot, or -1
     */
    template <int c, int w, typename Number>
    inline int
    eliminate(Number *block, Number *multipliers, Number *inverse_pivots)
    {
      if constexpr (c < w)
        {
          Number *const column = block + c * w;
          auto          x      = load<w>(column);
          substitute<0, c, w>(x, multipliers);
          store(x, column);
          if (column[c] == Number())
            return c;
          inverse_pivots[c] = inverse(column[c]);
          for (int i = 0; i < w; ++i)
            multipliers[c * w + i] = i <= c ? Number() : product(column[i], inverse_pivots[c]);
          return eliminate<c + 1, w>(block, multipliers, inverse_pivots);
        }
      else
        return -1;
    }



    /** Sum of columns times x. A sum waits for itself at each addition: several in turn do not. */
    template <int w, typename Number>
    inline Column<w, Number>
    sum_of_columns(const Number *values, const int *columns, const int n, const Number *x)
    {
      using Sum            = ColumnSum<Number, w>;
      constexpr int n_sums = Sum::n_registers <= 2 ? 4 : Sum::n_registers <= 4 ? 2 : 1;
      Sum           sums[n_sums];
      int           k = 0;
      for (; k + n_sums <= n; k += n_sums)
#pragma GCC unroll 4
        for (int s = 0; s < n_sums; ++s)
          sums[s].add(values + (k + s) * w, x[columns[k + s]]);
      for (; k < n; ++k)
        sums[0].add(values + k * w, x[columns[k]]);
#pragma GCC unroll 4
      for (int s = 1; s < n_sums; ++s)
        sums[0].add(sums[s]);
      return sums[0].result();
    }



    /** Call a function with the width as a constant. */
    template <typename Function>
    inline void
    with_width(const int width, const Function &function)
    {
      static_assert(PanelStructure::max_width == 8);
      switch (width)
        {
          case 1:
            return function(std::integral_constant<int, 1>());
          case 2:
            return function(std::integral_constant<int, 2>());
          case 3:
            return function(std::integral_constant<int, 3>());
          case 4:
            return function(std::integral_constant<int, 4>());
          case 5:
            return function(std::integral_constant<int, 5>());
          case 6:
            return function(std::integral_constant<int, 6>());
          case 7:
            return function(std::integral_constant<int, 7>());
          default:
            return function(std::integral_constant<int, 8>());
        }
    }
  } // namespace



  template <typename Number>
  void
  PanelFactors<Number>::set_pivots(const Pattern &pattern, Pivots pivots)
  {
    // what there was, and the lists, go before values come: of large models each is among the largest things in memory
    lower = upper = rows = {};
    structure            = PanelStructure(pattern, pivots, parts<Number>);
    row_order            = std::move(pivots.row_order);
    column_order         = std::move(pivots.column_order);
    pivots               = {};
    lower.resize(structure.n_lower_values);
    upper.resize(structure.n_upper_values);
    inverse_pivots.resize(pattern.size());
    x.resize(pattern.size());
  }



  template <typename Number>
  int
  PanelFactors<Number>::factorize(const Number *values)
  {
    smallest_pivot    = std::numeric_limits<double>::infinity();
    largest_pivot     = 0;
    n_negative_pivots = 0;
    int largest_width = 0;
    for (const auto &panel : structure.panels)
      largest_width = std::max(largest_width, panel.width);
    rows.assign(largest_width * row_order.size(), Number());
    for (const auto &panel : structure.panels)
      {
        int lost = -1;
        with_width(panel.width, [&](const auto w) { lost = factorize_panel<w>(panel, values); });
        if (lost >= 0)
          return column_order[panel.first + lost];
      }
    rcond = std::isfinite(largest_pivot) ? std::sqrt(smallest_pivot / largest_pivot) : 0;
    // of a large model they are in the way of the next matrices
    constexpr std::size_t worth_freeing = 1 << 17;
    if (rows.size() > worth_freeing)
      rows = std::vector<Number>();
    return -1;
  }



  template <typename Number>
  template <int w>
  int
  PanelFactors<Number>::factorize_panel(const Panel &panel, const Number *values)
  {
    // pointers: compilers must expect that a vector's own members change with its elements
    Number *const columns = rows.data();
    for (int k = panel.runs_begin; k < panel.runs_end; ++k)
      {
        const auto run = structure.runs[k];
        for (int i = 0; i < run.length; ++i)
          columns[run.place + i] = values[run.entry + i];
      }

    auto       largest = Column<w, Number>::zero();
    const auto compare = [&](const int column) { largest.raise_to_magnitude(doubles(columns + column * w)); };
    for (int k = panel.lower_begin; k < panel.lower_end; ++k)
      compare(structure.lower_columns[k]);
    for (int k = 0; k < w; ++k)
      compare(panel.first + k);
    for (int k = panel.upper_begin; k < panel.upper_end; ++k)
      compare(structure.upper_columns[k]);
    Number row_sizes[w];
    store(largest, row_sizes);

    for (int k = panel.sources_begin; k < panel.sources_end; ++k)
      subtract_rows<w>(structure.panels[structure.sources[k]]);

    Number    multipliers[w * w];
    const int lost = eliminate<0, w>(columns + panel.first * w, multipliers, &inverse_pivots[panel.first]);
    if (lost >= 0)
      return lost;
    judge_pivots<w>(panel, row_sizes);
    store_lower<w>(panel);
    store_upper<w>(panel, multipliers);
    std::fill_n(columns + panel.first * w, w * w, Number());
    return -1;
  }



  template <typename Number>
  template <int w>
  void
  PanelFactors<Number>::subtract_rows(const Panel &source)
  {
    // Columns that the panel does not have are zero and stay so: all are treated alike.
    Number *const    all         = rows.data();
    Number *const    multipliers = all + source.first * w;
    const int        n           = source.upper_end - source.upper_begin;
    const int *const columns     = structure.upper_columns.data() + source.upper_begin;
    const Number    *u           = upper.data() + source.upper_values;
    const Number    *inside      = u + n * source.width;
    for (int i = 0; i < source.width; ++i)
      for (int j = i + 1; j < source.width; ++j, ++inside)
        {
          auto column = load<w>(multipliers + j * w);
          subtract_product(column, multipliers + i * w, *inside);
          store(column, multipliers + j * w);
        }

    const auto subtract = [&](const ColumnSum<Number, w> &sum, const int column) {
      Number *const at = all + column * w;
      auto          x  = load<w>(at);
      x.subtract(sum.result());
      store(x, at);
    };
    int k = 0;
    if constexpr (ColumnSum<Number, w>::n_registers <= 4)
      for (; k + 2 <= n; k += 2, u += 2 * source.width)
        {
          ColumnSum<Number, w> first, second;
          for (int i = 0; i < source.width; ++i)
            {
              first.add(multipliers + i * w, u[i]);
              second.add(multipliers + i * w, u[source.width + i]);
            }
          subtract(first, columns[k]);
          subtract(second, columns[k + 1]);
        }
    for (; k < n; ++k, u += source.width)
      {
        ColumnSum<Number, w> sum;
        for (int i = 0; i < source.width; ++i)
          sum.add(multipliers + i * w, u[i]);
        subtract(sum, columns[k]);
      }
  }



  template <typename Number>
  template <int w>
  void
  PanelFactors<Number>::judge_pivots(const Panel &panel, const Number *row_sizes)
  {
    const Number *const block = &rows[panel.first * w];
    for (int i = 0; i < w; ++i)
      {
        const Number &pivot = block[i * w + i];
        const double  size  = square(pivot / largest_part(row_sizes[i]));
        smallest_pivot      = std::min(smallest_pivot, size);
        // what is not a number is kept
        largest_pivot = largest_pivot >= size ? largest_pivot : size + (largest_pivot - largest_pivot);
        if constexpr (std::is_same_v<Number, double>)
          n_negative_pivots += pivot < 0;
      }
  }



  template <typename Number>
  template <int w>
  void
  PanelFactors<Number>::store_lower(const Panel &panel)
  {
    const RowFactors<Number, w> inverse(&inverse_pivots[panel.first]);
    Number                     *l       = lower.data() + panel.lower_values;
    Number *const               all     = rows.data();
    const int *const            columns = structure.lower_columns.data();
    for (int k = panel.lower_begin; k < panel.lower_end; ++k, l += w)
      {
        Number *const column = all + columns[k] * w;
        auto          x      = load<w>(column);
        inverse.apply(x);
        store(x, l);
        store(Column<w, Number>::zero(), column);
      }
    const Number *const block = all + panel.first * w;
    for (int i = 0; i < w; ++i)
      for (int j = 0; j < i; ++j)
        *l++ = product(block[j * w + i], inverse_pivots[panel.first + i]);
  }



  template <typename Number>
  template <int w>
  void
  PanelFactors<Number>::store_upper(const Panel &panel, const Number *multipliers)
  {
    const RowFactors<Number, w> inverse(&inverse_pivots[panel.first]);
    Number                     *u       = upper.data() + panel.upper_values;
    Number *const               all     = rows.data();
    const int *const            columns = structure.upper_columns.data();
    for (int k = panel.upper_begin; k < panel.upper_end; ++k, u += w)
      {
        Number *const column = all + columns[k] * w;
        auto          x      = load<w>(column);
        substitute<0, w - 1, w>(x, multipliers);
        inverse.apply(x);
        store(x, u);
        store(Column<w, Number>::zero(), column);
      }
    const Number *const block = all + panel.first * w;
    for (int i = 0; i < w; ++i)
      for (int j = i + 1; j < w; ++j)
        *u++ = product(block[j * w + i], inverse_pivots[panel.first + i]);
  }



  template <typename Number>
  void
  PanelFactors<Number>::solve(Number *b) const
  {
    for (auto panel = structure.panels.begin(); panel != structure.panels.end(); ++panel)
      with_width(panel->width, [&](const auto w) { solve_lower<w>(*panel, b); });
    for (auto panel = structure.panels.rbegin(); panel != structure.panels.rend(); ++panel)
      with_width(panel->width, [&](const auto w) { solve_upper<w>(*panel, b); });
  }



  template <typename Number>
  template <int w>
  void
  PanelFactors<Number>::solve_lower(const Panel &panel, const Number *b) const
  {
    const int     n = panel.lower_end - panel.lower_begin;
    const Number *l = lower.data() + panel.lower_values;
    Number        y[w];
    store(sum_of_columns<w>(l, structure.lower_columns.data() + panel.lower_begin, n, x.data()), y);
    l += n * w;
#pragma GCC unroll 8
    for (int i = 0; i < w; ++i)
      {
        const int row   = panel.first + i;
        Number    value = product(b[row_order[row]], inverse_pivots[row]) - y[i];
#pragma GCC unroll 8
        for (int j = 0; j < i; ++j)
          value -= product(*l++, y[j]);
        x[row] = y[i] = value;
      }
  }



  template <typename Number>
  template <int w>
  void
  PanelFactors<Number>::solve_upper(const Panel &panel, Number *b) const
  {
    const int     n = panel.upper_end - panel.upper_begin;
    const Number *u = upper.data() + panel.upper_values;
    Number        y[w];
    store(sum_of_columns<w>(u, structure.upper_columns.data() + panel.upper_begin, n, x.data()), y);
    u += n * w + panel.n_inside();
#pragma GCC unroll 8
    for (int i = w - 1; i >= 0; --i)
      {
        const int row   = panel.first + i;
        Number    value = x[row] - y[i];
#pragma GCC unroll 8
        for (int j = w - 1; j > i; --j)
          value -= product(*--u, y[j]);
        x[row] = y[i]        = value;
        b[column_order[row]] = value;
      }
  }



  template class PanelFactors<double>;
  template class PanelFactors<std::complex<double>>;
} // namespace samara
