#include <samara/base/function_of_time.h>
#include <samara/base/number_in_file.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace samara
{
  namespace
  {
    using Table = std::vector<std::pair<double, double>>;

    /** "x1 y1; x2 y2", with white space or a comma between x and y. */
    Table
    table_of(const std::string &text)
    {
      Table table;
      for (std::string row : split_top_level(text, ';'))
        {
          std::replace(row.begin(), row.end(), ',', ' ');
          row              = trim(row);
          const auto blank = row.find_first_of(" \t");
          double     x = 0, y = 0;
          if (blank == std::string::npos || !fault_of_number(row.substr(0, blank), x).empty() ||
              !fault_of_number(trim(row.substr(blank)), y).empty())
            throw std::invalid_argument("<" + row + "> in a table is not two numbers.");
          const auto n = table.size();
          if (n > 0 && (x < table[n - 1].first || (n > 1 && x == table[n - 2].first)))
            throw std::invalid_argument(
              "<" + row + ">: the first numbers in a table must increase; two that are the same make a jump.");
          table.emplace_back(x, y);
        }
      if (table.empty())
        throw std::invalid_argument("the table is empty.");
      return table;
    }
  } // namespace



  const std::string ScalarFunction::table_prefix = "table:";



  struct ScalarFunction::Parts
  {
    std::string source, variable;
    Formula     formula;
    Table       table; ///< empty if the formula counts

    Jet table_value(double x) const;

    Jet
    at(const double x) const
    {
      return table.empty() ? formula(x) : table_value(x);
    }

    bool
    is_constant() const
    {
      return table.empty() ?
               formula.is_constant() :
               std::all_of(table.begin(), table.end(), [&](const auto &row) { return row.second == table[0].second; });
    }
  };



  ScalarFunction::ScalarFunction(const double constant)
    : at_zero(constant)
  {}



  ScalarFunction::ScalarFunction(const std::string &text, const std::string &variable)
  {
    const std::string source = trim(text);
    if (source.compare(0, table_prefix.size(), table_prefix) == 0)
      parts = std::make_shared<const Parts>(
        Parts{source, variable, Formula(0.), table_of(source.substr(table_prefix.size()))});
    else
      parts = std::make_shared<const Parts>(Parts{source, variable, Formula(source, variable), {}});
    constant = parts->is_constant();
    at_zero  = evaluate(0).value;
  }



  ScalarFunction::ScalarFunction(const Formula &formula)
    : parts(std::make_shared<const Parts>(Parts{"", "", formula, {}}))
    , constant(formula.is_constant())
    , at_zero(formula(0).value)
  {}



  double
  ScalarFunction::derivative(const double x) const
  {
    return evaluate(x).first;
  }



  double
  ScalarFunction::second_derivative(const double x) const
  {
    return evaluate(x).second;
  }



  double
  ScalarFunction::next_corner(const double from, const double to) const
  {
    const auto   round_off = [](const double x) { return 1e-12 * std::max(1., std::abs(x)); };
    const double none = std::numeric_limits<double>::infinity(), begin = from + round_off(from);
    const double end = std::isfinite(to) ? to - round_off(to) : to;
    if (begin > end || is_constant())
      return none;
    const Table &table = parts->table;
    if (table.empty())
      return parts->formula.next_corner(begin, end);
    const auto corner = std::lower_bound(table.begin(), table.end(), begin, [](const auto &row, const double x) {
      return row.first < x;
    });
    return corner != table.end() && corner->first <= end ? corner->first : none;
  }



  bool
  ScalarFunction::is_zero() const
  {
    return constant && at_zero == 0;
  }



  std::string
  ScalarFunction::text() const
  {
    return parts ? parts->source : number_to_text(at_zero);
  }



  namespace
  {
    /** The pieces @p first to @p last of a table with n rows: 0 before it, n behind it. As many comparisons as a tree
     * has. */
    std::string
    pieces_of_table(const Table &table, const std::string &x, const std::size_t first, const std::size_t last)
    {
      if (first < last)
        {
          const std::size_t middle = (first + last) / 2;
          return "(" + x + " < " + number_to_text(table[middle].first) + " ? " +
                 pieces_of_table(table, x, first, middle) + " : " + pieces_of_table(table, x, middle + 1, last) + ")";
        }
      if (first == 0 || first == table.size())
        return "(" + number_to_text((first == 0 ? table.front() : table.back()).second) + ")";
      const auto  &left = table[first - 1], &right = table[first];
      const double width = right.first - left.first, slope = width > 0 ? (right.second - left.second) / width : 0.;
      return "(" + number_to_text(left.second) + " + (" + number_to_text(slope) + ")*(" + x + " - (" +
             number_to_text(left.first) + ")))";
    }
  } // namespace



  std::string
  ScalarFunction::formula_text() const
  {
    return !parts || parts->table.empty() ? text() :
                                            pieces_of_table(parts->table, parts->variable, 0, parts->table.size());
  }



  Jet
  ScalarFunction::evaluate(const double x) const
  {
    return parts ? parts->at(x) : Jet{at_zero, 0, 0};
  }



  Jet
  ScalarFunction::Parts::table_value(const double x) const
  {
    const auto right =
      std::upper_bound(table.begin(), table.end(), x, [](const double x, const auto &row) { return x < row.first; });
    if (right == table.begin())
      return {table.front().second, 0, 0};
    if (right == table.end())
      return {table.back().second, 0, 0};
    const auto   left  = right - 1;
    const double slope = (right->second - left->second) / (right->first - left->first);
    return {left->second + slope * (x - left->first), slope, 0};
  }
} // namespace samara
