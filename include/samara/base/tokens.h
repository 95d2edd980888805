#ifndef samara_base_tokens_h
#define samara_base_tokens_h

#include <string>
#include <vector>

namespace samara
{
  /** The smallest pieces of an expression. */
  struct Token
  {
    enum Kind
    {
      number,
      word,     ///< a unit, constant or variable; "%" is one, too
      function, ///< a word before parentheses
      symbol    ///< operators, parentheses, commas
    };

    Kind        kind;
    std::string text;
    bool        after_blank = false; ///< white space stands before it
  };

  /**
   * The tokens of @p text, with a "*" inserted where white space or nearness multiplies: "6 ft", "6ft", "(1 + x) ft".
   * Two numbers in a row are refused, for "1 000" was not meant to be zero. Throws std::invalid_argument.
   */
  std::vector<Token> tokens_of(const std::string &text);

  /** The names of all functions that may be used. */
  std::vector<std::string> function_names();
} // namespace samara

#endif
