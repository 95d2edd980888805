#include <samara/report/csv_columns.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

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



    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

    /** A field of a number and nothing else, which nearly all are, read where it stands; otherwise nothing happens. */
    bool
    plain_number(const std::string &text, std::size_t &at, double &number, std::size_t &is_last)
    {
      const char *const begin = text.data() + at, *const end_of_text = text.data() + text.size();
      const auto [end, error] = std::from_chars(begin, end_of_text, number);
      if (error != std::errc() || end == end_of_text || (*end != ',' && *end != '\n'))
        {
          number = no_number;
          return false;
        }
      is_last = *end == '\n';
      at      = end + 1 - text.data();
      return true;
    }



    /** A number, or not a number for an empty field or "nan"; whether it is one of these. */
    bool
    number_in(const std::string &field, double &number)
    {
      number = no_number;
      if (field.empty())
        return true;
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
      return error == std::errc() && end == field.data() + field.size();
    }



    /** What were numbers until a word came are words, too. */
    void
    become_text(CsvColumns::Column &column)
    {
      column.is_text = true;
      for (const double x : column.numbers)
        {
          char       word[32];
          const auto end = std::to_chars(word, word + sizeof word, x).ptr;
          column.words.emplace_back(word, std::isnan(x) ? word : end);
        }
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
    CsvColumns table;
    table.go_on(file);
    return table;
  }



  void
  CsvColumns::go_on(const std::string &file)
  {
    constexpr std::size_t compared = 200; // bytes before those that are new: another file has others there
    std::ifstream         in(file, std::ios::binary);
    if (!in.seekg(0, std::ios::end))
      return;
    const std::size_t size = in.tellg(), before = n_bytes - last_bytes.size();
    std::string       text(size > before ? size - before : 0, '\0');
    in.seekg(before);
    in.read(text.data(), text.size());
    text.resize(in.gcount());
    if (text.compare(0, last_bytes.size(), last_bytes) != 0)
      {
        *this = CsvColumns();
        return go_on(file);
      }
    text.resize(text.rfind('\n') + 1); // of the first byte on, if there is no row
    if (text.size() <= last_bytes.size())
      return;
    n_bytes = before + text.size();
    add(text.substr(last_bytes.size()));
    last_bytes = text.substr(text.size() - std::min(compared, text.size()));
  }



  void
  CsvColumns::add(const std::string &text)
  {
    std::size_t at = 0;
    std::string field;
    for (bool is_last = !columns.empty(); !is_last;)
      {
        is_last = next_field(text, at, field);
        columns.push_back(column_of(field));
      }
    const std::size_t n_more = std::count(text.begin() + at, text.end(), '\n');
    for (Column &column : columns)
      column.numbers.reserve(std::max(column.numbers.size() + n_more, n_rows > 0 ? 2 * n_rows : 0));
    while (at < text.size())
      {
        for (std::size_t c = 0, is_last = 0; !is_last; ++c)
          {
            const std::size_t begin    = at;
            double            number   = no_number;
            const bool        is_plain = plain_number(text, at, number, is_last);
            if (!is_plain)
              is_last = next_field(text, at, field);
            if (c >= columns.size())
              continue;
            Column &column = columns[c];
            if (!is_plain && !number_in(field, number) && !column.is_text)
              become_text(column);
            column.numbers.push_back(number);
            if (column.is_text)
              column.words.push_back(is_plain ? text.substr(begin, at - 1 - begin) : field);
          }
        ++n_rows;
        for (Column &column : columns) // a row that is too short
          {
            column.numbers.resize(n_rows, no_number);
            if (column.is_text)
              column.words.resize(n_rows);
          }
      }
  }



  const CsvColumns &
  GrowingTables::read(const std::string &file)
  {
    constexpr std::size_t most_numbers = 20000000; // 160 MB; larger ones are read anew
    CsvColumns           &table        = tables[file];
    table.go_on(file);
    if (table.n_rows * table.columns.size() <= most_numbers)
      return table;
    const CsvColumns &large = tables[""] = std::move(table);
    tables.erase(file);
    return large;
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
