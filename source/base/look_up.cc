#include <samara/base/chain_rule.h>
#include <samara/base/errors.h>
#include <samara/base/look_up.h>
#include <samara/base/number_in_file.h>
#include <samara/base/quantity.h>
#include <samara/base/text.h>
#include <samara/base/text_file.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** A line of a CSV file that is not empty, with its place for messages. */
    struct Row
    {
      std::string              where;
      std::vector<std::string> fields;
    };

    std::vector<Row>
    rows_of(const std::string &text, const std::string &name)
    {
      std::vector<Row>   rows;
      std::istringstream in(text);
      std::string        line;
      for (unsigned int number = 1; std::getline(in, line); ++number)
        if (line = trim(line.substr(0, line.find('#'))); !line.empty())
          rows.push_back({name + ":" + std::to_string(number), csv_fields(line)});
      return rows;
    }

    /** "pull [kN]": its name and its unit; no unit is "". */
    std::pair<std::string, std::string>
    name_and_unit(const std::string &column)
    {
      const auto bracket = column.rfind('[');
      if (bracket == std::string::npos || column.back() != ']')
        return {trim(column), ""};
      return {trim(column.substr(0, bracket)), trim(column.substr(bracket + 1, column.size() - bracket - 2))};
    }

    /** Which column is the value. */
    unsigned int
    column_of_value(const Row &head, const std::string &wanted, const unsigned int n_arguments)
    {
      if (wanted.empty())
        {
          if (head.fields.size() == n_arguments + 1)
            return n_arguments;
          throw std::invalid_argument(head.where + ": the table has " + std::to_string(head.fields.size()) +
                                      " columns; " + std::to_string(n_arguments + 1) +
                                      " are wanted, or the name of one behind that of the file, <file.csv: name>.");
        }
      std::vector<std::string> names;
      for (const auto &field : head.fields)
        names.push_back(name_and_unit(trim(field)).first);
      const auto found = std::find(names.begin(), names.end(), wanted);
      if (found == names.end())
        throw std::invalid_argument(head.where + ": there is no column <" + wanted + ">" + did_you_mean(wanted, names));
      if (std::find(found + 1, names.end(), wanted) != names.end())
        throw std::invalid_argument(head.where + ": there are two columns <" + wanted + ">.");
      if (found - names.begin() < n_arguments)
        throw std::invalid_argument(head.where + ": the column <" + wanted + "> is an argument, not a value.");
      return found - names.begin();
    }

    /** The index of the last of @p x that is not beyond @p at, but for the very last. */
    unsigned int
    interval_of(const std::vector<double> &x, const double at)
    {
      const unsigned int i = std::upper_bound(x.begin(), x.end(), at) - x.begin();
      return std::min<unsigned int>(std::max(i, 1u), x.size() - 1) - 1;
    }

    /** -1 below, 1 above, 0 within; not a number is within. */
    int
    side_of(const std::vector<double> &x, const double at)
    {
      return at < x.front() ? -1 : at > x.back() ? 1 : 0;
    }

    /** The number of the interval, and one more for each side beyond. */
    double
    piece_of(const std::vector<double> &x, const double at)
    {
      const int side = side_of(x, at);
      return side < 0 ? -1. : side > 0 ? double(x.size()) : interval_of(x, at);
    }

    /** Held at the ends. */
    Jet
    held(const Jet &x, const std::vector<double> &axis)
    {
      const int side = side_of(axis, x.value);
      return side == 0 ? x : Jet{side < 0 ? axis.front() : axis.back(), 0, 0};
    }

    /** The slope at an end of a cubic from the two intervals there: three points, but monotone. */
    double
    slope_at_end(const double h, const double next_h, const double d, const double next_d)
    {
      const double slope = ((2 * h + next_h) * d - h * next_d) / (h + next_h);
      if (slope * d <= 0)
        return 0;
      return d * next_d <= 0 && std::abs(slope) > 3 * std::abs(d) ? 3 * d : slope;
    }
  } // namespace



  std::shared_ptr<const LookUp>
  LookUp::of_file(const std::string &file_and_column, const unsigned int n_arguments, const bool cubic)
  {
    // each expression is read several times to find its units
    static std::mutex                                         mutex;
    static std::map<std::string, std::weak_ptr<const LookUp>> all;
    const std::string key = file_and_column + "\n" + std::to_string(n_arguments) + (cubic ? "\ncubic" : "");

    const std::lock_guard<std::mutex> guard(mutex);
    if (auto known = all[key].lock())
      return known;
    // names of columns have no slash, names of folders may have colons
    const auto        colon      = file_and_column.rfind(": ");
    const bool        has_column = colon != std::string::npos && file_and_column.find('/', colon) == std::string::npos;
    const std::string file       = trim(file_and_column.substr(0, has_column ? colon : std::string::npos)),
                      column     = has_column ? trim(file_and_column.substr(colon + 2)) : "";
    auto made                    = std::make_shared<const LookUp>(text_of_file(file), file, column, n_arguments, cubic);
    all[key]                     = made;
    return made;
  }



  LookUp::LookUp(const std::string &text,
                 const std::string &name,
                 const std::string &column,
                 const unsigned int n_arguments,
                 const bool         cubic)
    : axes(n_arguments)
    , units(n_arguments + 1, Dimension{{0, 0, 0, 0, 0}})
  {
    auto rows = rows_of(text, name);
    if (rows.empty())
      throw std::invalid_argument(name + ": the table is empty.");
    double     number  = 0;
    const Row  head    = rows[0];
    const bool is_head = std::none_of(head.fields.begin(), head.fields.end(), [&](const std::string &field) {
      return text_to_number(trim(field), number);
    });

    std::vector<unsigned int> columns = {0, 1, 2};
    columns.resize(n_arguments);
    columns.push_back(column_of_value(head, column, n_arguments));
    std::vector<double> factors(n_arguments + 1, 1.);
    if (is_head)
      for (unsigned int i = 0; i <= n_arguments; ++i)
        if (const std::string unit = name_and_unit(trim(head.fields[columns[i]])).second; !unit.empty())
          try
            {
              const Quantity quantity = Quantities::unit(unit);
              factors[i]              = quantity.si;
              units[i]                = quantity.dimension;
            }
          catch (const std::invalid_argument &problem)
            {
              throw std::invalid_argument(head.where + ": " + problem.what());
            }

    std::vector<std::vector<double>> numbers;
    for (auto row = rows.begin() + (is_head ? 1 : 0); row != rows.end(); ++row)
      {
        if (row->fields.size() != head.fields.size())
          throw std::invalid_argument(row->where + ": there are " + std::to_string(row->fields.size()) +
                                      " fields, and " + std::to_string(head.fields.size()) + " in the first line.");
        numbers.emplace_back();
        for (unsigned int i = 0; i <= n_arguments; ++i)
          {
            const std::string field = trim(row->fields[columns[i]]);
            if (const std::string fault = fault_of_number(field, number); !fault.empty())
              throw std::invalid_argument(row->where + ": <" + field + "> " + fault + ".");
            numbers.back().push_back(factors[i] * number);
          }
        if (n_arguments == 1 && numbers.size() > 1 && !(numbers.back()[0] > numbers[numbers.size() - 2][0]))
          throw std::invalid_argument(row->where + ": the numbers of the first column must increase.");
      }
    read_rows(numbers, name);
    if (cubic)
      find_slopes();
  }



  void
  LookUp::read_rows(const std::vector<std::vector<double>> &rows, const std::string &name)
  {
    for (unsigned int i = 0; i < axes.size(); ++i)
      {
        for (const auto &row : rows)
          axes[i].push_back(row[i]);
        std::sort(axes[i].begin(), axes[i].end());
        axes[i].erase(std::unique(axes[i].begin(), axes[i].end()), axes[i].end());
        if (axes[i].size() < 2)
          throw std::invalid_argument(name + ": the table has fewer than two " + (i == 0 ? "x" : "y") +
                                      "; a line needs two.");
      }
    std::size_t n = 1;
    for (const auto &axis : axes)
      n *= axis.size();
    values.assign(n, std::nan(""));
    for (const auto &row : rows)
      {
        std::size_t place = 0;
        for (unsigned int i = 0; i < axes.size(); ++i)
          place = place * axes[i].size() + (std::lower_bound(axes[i].begin(), axes[i].end(), row[i]) - axes[i].begin());
        if (!std::isnan(values[place]))
          throw std::invalid_argument(name + ": there are two rows for x = " + number_to_text(row[0]) +
                                      ", y = " + number_to_text(row[1]) + " in SI units.");
        values[place] = row.back();
      }
    const auto missing = std::find_if(values.begin(), values.end(), [](const double v) { return std::isnan(v); });
    if (missing != values.end())
      {
        const std::size_t place = missing - values.begin(), n_y = axes[1].size();
        throw std::invalid_argument(name + ": there is no row for x = " + number_to_text(axes[0][place / n_y]) +
                                    ", y = " + number_to_text(axes[1][place % n_y]) +
                                    " in SI units; all combinations of some x and some y are wanted.");
      }
  }



  void
  LookUp::find_slopes()
  {
    const auto         &x = axes[0];
    const unsigned int  n = x.size();
    std::vector<double> h(n - 1), d(n - 1);
    for (unsigned int i = 0; i + 1 < n; ++i)
      {
        h[i] = x[i + 1] - x[i];
        d[i] = (values[i + 1] - values[i]) / h[i];
      }
    slopes.assign(n, d[0]); // of two rows a line
    if (n == 2)
      return;
    for (unsigned int i = 1; i + 1 < n; ++i)
      {
        const double a = 2 * h[i] + h[i - 1], b = h[i] + 2 * h[i - 1];
        slopes[i] = d[i - 1] * d[i] <= 0 ? 0. : (a + b) / (a / d[i - 1] + b / d[i]);
      }
    slopes[0]     = slope_at_end(h[0], h[1], d[0], d[1]);
    slopes[n - 1] = slope_at_end(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  }



  Jet
  LookUp::operator()(const Jet *const arguments) const
  {
    return axes.size() == 1 ? of_one(arguments[0]) : of_two(arguments[0], arguments[1]);
  }



  Jet
  LookUp::of_one(const Jet &argument) const
  {
    const auto        &x  = axes[0];
    const Jet          at = held(argument, x);
    const unsigned int i  = interval_of(x, at.value);
    const double       h = x[i + 1] - x[i], u = at.value - x[i], slope = (values[i + 1] - values[i]) / h;
    if (slopes.empty())
      return chain(at, u < 0.5 * h ? values[i] + slope * u : values[i + 1] + slope * (at.value - x[i + 1]), slope, 0);
    // Hermite's cubic in powers of u
    const double c = (3 * slope - 2 * slopes[i] - slopes[i + 1]) / h,
                 d = (slopes[i] + slopes[i + 1] - 2 * slope) / (h * h);
    return chain(at,
                 values[i] + u * (slopes[i] + u * (c + u * d)),
                 slopes[i] + u * (2 * c + u * 3 * d),
                 2 * c + 6 * d * u);
  }



  Jet
  LookUp::of_two(const Jet &first, const Jet &second) const
  {
    const Jet          x = held(first, axes[0]), y = held(second, axes[1]);
    const unsigned int i = interval_of(axes[0], x.value), j = interval_of(axes[1], y.value), n = axes[1].size();
    const double       a = axes[0][i], b = axes[1][j], dx = axes[0][i + 1] - a, dy = axes[1][j + 1] - b,
                 v = values[i * n + j], v_x = values[(i + 1) * n + j], v_y = values[i * n + j + 1],
                 v_xy = values[(i + 1) * n + j + 1];
    // v + f_x u + f_y w + f_xy u w
    const double u = x.value - a, w = y.value - b, twist = (v_xy - v_x - v_y + v) / (dx * dy),
                 f_x = (v_x - v) / dx + twist * w, f_y = (v_y - v) / dy + twist * u;
    return {v + (v_x - v) / dx * u + f_y * w,
            f_x * x.first + f_y * y.first,
            f_x * x.second + f_y * y.second + 2 * twist * x.first * y.first};
  }



  double
  LookUp::piece(const Jet *const arguments) const
  {
    if (!slopes.empty())
      return side_of(axes[0], arguments[0].value);
    double number = 0;
    for (unsigned int i = 0; i < axes.size(); ++i)
      number = number * (axes[i].size() + 2) + 1 + piece_of(axes[i], arguments[i].value);
    return number;
  }



  std::vector<double>
  LookUp::corners(const unsigned int argument) const
  {
    const auto &x = axes[argument];
    return slopes.empty() ? x : std::vector<double>{x.front(), x.back()};
  }
} // namespace samara
