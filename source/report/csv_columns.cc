#include <samara/report/csv_columns.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace samara
{
  namespace
  {
    /** The field that begins at @p at, which is set behind its comma or line break; whether the row ends with it. */
    bool
    next_field(const std::string &text, std::size_t &at, std::string &field)
    {
      field.clear();
      if (at < text.size() && text[at] == '"')
        {
          for (++at; at < text.size(); ++at)
            if (text[at] != '"')
              field += text[at];
            else if (at + 1 < text.size() && text[at + 1] == '"')
              field += text[at++];
            else
              break;
          ++at;
        }
      else
        {
          const std::size_t end = text.find_first_of(",\n", at);
          field.assign(text, at, end - at);
          at = end;
        }
      const bool is_last = at >= text.size() || text[at] == '\n';
      if (!field.empty() && field.back() == '\r')
        field.pop_back();
      ++at;
      return is_last;
    }



    /** A number, or not a number for an empty field or "nan"; whether it is one of these. */
    bool
    number_in(const std::string &field, double &number)
    {
      number = std::nan("");
      if (field.empty())
        return true;
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
      return error == std::errc() && end == field.data() + field.size();
    }



    /** "t [s]" is t in s. */
    CsvColumns::Column
    column_of(const std::string &head)
    {
      CsvColumns::Column column;
      column.name             = head;
      const std::size_t begin = head.rfind(" [");
      if (begin != std::string::npos && head.back() == ']')
        {
          column.name = head.substr(0, begin);
          column.unit = head.substr(begin + 2, head.size() - begin - 3);
        }
      return column;
    }
  } // namespace



  CsvColumns
  CsvColumns::read(const std::string &file)
  {
    CsvColumns        table;
    std::ifstream     in(file, std::ios::binary);
    std::stringstream stream;
    stream << in.rdbuf();
    std::string text = stream.str();
    text.resize(text.rfind('\n') + 1);
    std::size_t at = 0;
    std::string field;
    if (text.empty())
      return table;
    for (bool is_last = false; !is_last;)
      {
        is_last = next_field(text, at, field);
        table.columns.push_back(column_of(field));
      }
    while (at < text.size())
      {
        for (std::size_t c = 0, is_last = 0; !is_last; ++c)
          {
            is_last = next_field(text, at, field);
            if (c >= table.columns.size())
              continue;
            Column &column = table.columns[c];
            double  number;
            if (!number_in(field, number) && !column.is_text)
              {
                column.is_text = true;
                for (const double x : column.numbers)
                  {
                    std::ostringstream word;
                    if (!std::isnan(x))
                      word << x;
                    column.words.push_back(word.str());
                  }
              }
            column.numbers.push_back(number);
            if (column.is_text)
              column.words.push_back(field);
          }
        ++table.n_rows;
        for (Column &column : table.columns) // a row that is too short
          {
            column.numbers.resize(table.n_rows, std::nan(""));
            if (column.is_text)
              column.words.resize(table.n_rows);
          }
      }
    return table;
  }



  std::vector<std::size_t>
  CsvColumns::kept(const std::size_t most_numbers) const
  {
    std::vector<std::size_t> all;
    if (n_rows * columns.size() <= most_numbers || n_rows < 3)
      {
        for (std::size_t i = 0; i < n_rows; ++i)
          all.push_back(i);
        return all;
      }
    const std::size_t n_columns = columns.size(),
                      n_pieces  = std::max<std::size_t>(1, most_numbers / (2 * n_columns * n_columns));
    std::set<std::size_t> rows  = {0, n_rows - 1};
    for (std::size_t p = 0; p < n_pieces; ++p)
      {
        const std::size_t begin = n_rows * p / n_pieces, end = n_rows * (p + 1) / n_pieces;
        for (const Column &column : columns)
          if (!column.is_text && begin < end)
            {
              // what is no number is neither the least nor the largest; one of them keeps the gap
              std::size_t least = begin, largest = begin, gap = end;
              for (std::size_t i = begin; i < end; ++i)
                {
                  if (const double x = column.numbers[i]; !(x >= column.numbers[least]))
                    least = std::isnan(x) ? least : i;
                  if (const double x = column.numbers[i]; !(x <= column.numbers[largest]))
                    largest = std::isnan(x) ? largest : i;
                  if (gap == end && std::isnan(column.numbers[i]))
                    gap = i;
                }
              if (gap != end)
                rows.insert(gap);
              rows.insert(least);
              rows.insert(largest);
            }
      }
    return {rows.begin(), rows.end()};
  }
} // namespace samara
