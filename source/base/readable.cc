// Text that somebody else has written, made fit to be shown.

#include <samara/base/text.h>

#include <algorithm>
#include <cstdio>

namespace samara
{
  namespace
  {
    constexpr std::size_t most_letters = 400, letters_of_head = 240, letters_of_tail = 140; ///< of a line in a message

    /** How many bytes from @p i on are one printable character of UTF-8; 0 if none. */
    std::size_t
    printable_length(const std::string &text, const std::size_t i)
    {
      const auto byte = [&](const std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
      const auto first = byte(i);
      if (first < 0x80)
        return first >= 0x20 && first != 0x7f ? 1 : 0;
      const std::size_t length = first >= 0xf0 && first < 0xf5 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
      if (first >= 0xf5)
        return 0;
      for (std::size_t k = 1; k < length; ++k)
        if ((byte(i + k) & 0xc0) != 0x80)
          return 0;
      return first == 0xc2 && byte(i + 1) < 0xa0 ? 0 : length; // more control characters
    }

    /** One line, with what is not printable escaped; characters of several bytes are never cut. */
    std::string
    readable_line(const std::string &line)
    {
      std::vector<std::string> characters;
      for (std::size_t i = 0; i < line.size();)
        {
          const auto length = printable_length(line, i);
          char       escaped[8];
          std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned char>(line[i]));
          characters.push_back(length > 0 ? line.substr(i, length) : line[i] == '\t' ? " " : escaped);
          i += std::max<std::size_t>(1, length);
          if (characters.size() == most_letters && line.size() - i > 8 * most_letters)
            i = line.size() - 8 * letters_of_tail; // of a very long line the middle is not looked at
        }
      std::string result;
      for (std::size_t i = 0; i < characters.size(); ++i)
        if (characters.size() <= most_letters || i < letters_of_head || i + letters_of_tail >= characters.size())
          result += characters[i];
        else if (i == letters_of_head)
          result += " ... ";
      return result;
    }
  } // namespace



  std::string
  readable(const std::string &text)
  {
    std::string result;
    for (std::size_t begin = 0; begin <= text.size();)
      {
        const auto end = std::min(text.find('\n', begin), text.size());
        result += (begin == 0 ? "" : "\n") + readable_line(text.substr(begin, end - begin));
        begin = end + 1;
      }
    return result;
  }
} // namespace samara
