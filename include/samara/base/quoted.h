#ifndef samara_base_quoted_h
#define samara_base_quoted_h

#include <cctype>
#include <string>

namespace samara
{
  /**
   * Where what is quoted from @p begin on ends: the place of the second quotation mark; npos if nothing is quoted
   * there. A mark within a word is one of its letters, as in the names of a body <3" pipe> or <a"b>: quotes stand
   * around words.
   */
  inline std::size_t
  end_of_quoted(const std::string &text, const std::size_t begin)
  {
    const auto is_of_word = [&](const std::size_t i) {
      return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
    };
    if (text[begin] != '"' || (begin > 0 && is_of_word(begin - 1)))
      return std::string::npos;
    const auto end = text.find('"', begin + 1);
    return end == std::string::npos || is_of_word(end + 1) ? std::string::npos : end;
  }
} // namespace samara

#endif
