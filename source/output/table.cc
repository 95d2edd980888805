#include <samara/base/finite.h>
#include <samara/output/file.h>
#include <samara/output/table.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    constexpr unsigned int digits_in_files = 12, digits_on_terminal = 6;

    std::string
    text_of(const Table::Cell &cell, const unsigned int digits)
    {
      return cell.is_number ? number_to_field(cell.number, digits) : cell.text;
    }

    /** Letters, not bytes: all but the first byte of a UTF-8 letter look like 10xxxxxx. */
    std::size_t
    width_of(const std::string &text)
    {
      return std::count_if(text.begin(), text.end(), [](const char c) { return (c & 0xC0) != 0x80; });
    }

    /** Numbers stand at the right of their column, words at the left. */
    std::string
    padded(const std::string &text, const std::size_t width, const bool to_the_right)
    {
      const std::string space(width - std::min(width, width_of(text)), ' ');
      return to_the_right ? space + text : text + space;
    }
  } // namespace



  Table::Table(const std::vector<std::string> &columns)
    : columns(columns)
  {}



  void
  Table::add_row(const std::initializer_list<Cell> cells)
  {
    append(cells);
  }



  void
  Table::append(std::vector<Cell> cells)
  {
    AssertThrow(cells.size() == columns.size(), dealii::ExcDimensionMismatch(cells.size(), columns.size()));
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (!cells[c].is_optional)
        require_finite(cells[c].number, [&]() {
          return columns[0] + " " + text_of(cells[0], digits_on_terminal) + ": <" + columns[c] + ">";
        });
    rows.push_back(std::move(cells));
  }



  void
  Table::write(const std::string &file) const
  {
    std::string content = csv_line(columns);
    for (const std::vector<Cell> &row : rows)
      {
        std::vector<std::string> fields;
        for (const Cell &cell : row)
          fields.push_back(text_of(cell, digits_in_files));
        content += csv_line(fields);
      }
    replace_file(file, content);
  }



  void
  Table::print(std::ostream &out) const
  {
    std::vector<std::string> lines(rows.size() + 1);
    for (unsigned int c = 0; c < columns.size(); ++c)
      {
        std::size_t width = width_of(columns[c]);
        bool        words = false;
        for (const std::vector<Cell> &row : rows)
          {
            width = std::max(width, width_of(text_of(row[c], digits_on_terminal)));
            words = words || !row[c].is_number;
          }

        const std::string gap = c == 0 ? "" : "  ";
        lines[0] += gap + padded(columns[c], width, !words);
        for (unsigned int r = 0; r < rows.size(); ++r)
          lines[r + 1] += gap + padded(text_of(rows[r][c], digits_on_terminal), width, !words);
      }

    for (std::string &line : lines)
      {
        line.erase(line.find_last_not_of(' ') + 1);
        out << line << '\n';
      }
  }
} // namespace samara
