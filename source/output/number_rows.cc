#include <samara/output/number_rows.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Read the fields of @p line; false if they are not a number each, or not as many as @p row is long. */
    bool
    read_numbers(const std::string &line, std::vector<double> &row)
    {
      const char *at = line.data(), *const end = at + line.size();
      for (unsigned int c = 0; c < row.size(); ++c)
        {
          if (c > 0 && (at == end || *at++ != ','))
            return false;
          const auto result = std::from_chars(at, end, row[c]);
          if (result.ec == std::errc::invalid_argument)
            return false;
          // the largest numbers are beyond the range once they are rounded to the digits in the file
          if (result.ec == std::errc::result_out_of_range)
            row[c] = std::copysign(HUGE_VAL, *at == '-' ? -1. : 1.);
          at = result.ptr;
        }
      return at == end;
    }
  } // namespace



  NumberRows::NumberRows(const std::string &file, const std::string &header, const unsigned int n_columns)
    : file(file)
    , n_columns(n_columns)
    , in(file, std::ios::binary)
    , bytes(header.size())
  {
    if (!in)
      throw std::runtime_error(file + " cannot be read");
    std::string found(header.size(), '\0');
    if (!in.read(found.data(), found.size()) || found != header)
      throw std::runtime_error(file + " has other columns");
  }



  bool
  NumberRows::next(std::vector<double> &row)
  {
    if (!std::getline(in, line) || in.eof())
      return false;
    bytes += line.size() + 1;
    ++rows;
    row.resize(n_columns);
    if (!read_numbers(line, row))
      throw std::runtime_error(file + ": row " + std::to_string(rows) + " is not " + std::to_string(n_columns) +
                               " numbers");
    return true;
  }
} // namespace samara
