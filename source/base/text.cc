#include <samara/base/quoted.h>
#include <samara/base/text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numeric>

namespace samara
{
  std::string
  trim(const std::string &text)
  {
    const char *const blanks = " \t\r\n\v\f";
    const auto        first  = text.find_first_not_of(blanks);
    if (first == std::string::npos)
      return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }



  std::vector<std::string>
  split_top_level(const std::string &text, const char separator)
  {
    std::vector<std::string> pieces;
    if (trim(text).empty())
      return pieces;
    int         depth = 0;
    std::string piece;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        const char c = text[i];
        depth += (c == '(') - (c == ')');
        if (const auto end = end_of_quoted(text, i); end != std::string::npos)
          {
            piece += text.substr(i, end + 1 - i);
            i = end;
          }
        else if (c == separator && depth == 0)
          {
            pieces.push_back(trim(piece));
            piece.clear();
          }
        else
          piece += c;
      }
    pieces.push_back(trim(piece));
    return pieces;
  }



  std::string
  join(const std::vector<std::string> &pieces, const std::string &separator)
  {
    std::string all;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      all += (i == 0 ? "" : separator) + pieces[i];
    return all;
  }



  unsigned int
  edit_distance(const std::string &a, const std::string &b)
  {
    // row[j] is the distance between the first i letters of a and the first j letters of b
    std::vector<unsigned int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0u);
    for (std::size_t i = 1; i <= a.size(); ++i)
      {
        unsigned int diagonal = row[0]++;
        for (std::size_t j = 1; j <= b.size(); ++j)
          {
            const unsigned int above = row[j];
            const unsigned int swap  = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j]                   = std::min({above + 1, row[j - 1] + 1, swap});
            diagonal                 = above;
          }
      }
    return row.back();
  }



  std::string
  file_beside(const std::string &file, const std::string &name)
  {
    return (std::filesystem::path(file).parent_path() / name).lexically_normal().string();
  }



  std::string
  number_to_text(const char *const pattern, const double number)
  {
    char text[64];
    std::snprintf(text, sizeof text, pattern, number);
    return text;
  }



  std::string
  number_to_text(const double number)
  {
    // A bound or default "infinity" is written as the largest number, which every reader understands.
    const double largest = std::numeric_limits<double>::max();
    const double finite  = std::isinf(number) ? std::copysign(largest, number) : number;

    char       buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), finite).ptr;
    return std::string(buffer, end);
  }



  bool
  text_to_number(const std::string &text, double &number)
  {
    // from_chars() knows no '+', and would take "inf" and "nan"
    const bool        has_plus = !text.empty() && text[0] == '+';
    const char *const begin    = text.data() + (has_plus ? 1 : 0);
    const char *const end      = text.data() + text.size();
    const char *const digit    = (!has_plus && begin != end && *begin == '-') ? begin + 1 : begin;
    if (digit == end || (*digit != '.' && (*digit < '0' || *digit > '9')))
      return false;
    const auto result = std::from_chars(begin, end, number);
    return result.ec == std::errc() && result.ptr == end;
  }



  bool
  split_at(const std::string &text, std::string &name, std::string &place)
  {
    const auto at = text.rfind(" at ");
    if (at == std::string::npos)
      return false;
    name  = trim(text.substr(0, at));
    place = trim(text.substr(at + 4));
    return !name.empty() && !place.empty();
  }
} // namespace samara
