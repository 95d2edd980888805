#ifndef samara_base_tokens_h
#define samara_base_tokens_h

#include <string>
#include <utility>
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
      string,   ///< the name of a file, with its quotes
      symbol    ///< operators, parentheses, commas
    };

    Kind        kind;
    std::string text;
    bool        after_blank = false; ///< white space stands before it
    bool        is_implied  = false; ///< a "*" that is not written
  };

  /**
   * The tokens of @p text, with a "*" inserted where white space or nearness multiplies: "6 ft", "6ft", "(1 + x) ft".
   * Two numbers in a row are refused, for "1 000" was not meant to be zero. Throws std::invalid_argument.
   */
  std::vector<Token> tokens_of(const std::string &text);

  /** The function that looks up in files. */
  extern const std::string table_function;

  /** table("file.csv", x, cubic) */
  struct TableCall
  {
    std::string                                      file;      ///< without quotes, with the column
    std::vector<std::pair<std::size_t, std::size_t>> arguments; ///< first token, and one behind the last
    bool                                             is_cubic = false;
    std::size_t                                      end      = 0; ///< one behind the closing parenthesis
  };

  /** The call whose name is the token @p at. Throws std::invalid_argument. */
  TableCall table_call(const std::vector<Token> &tokens, std::size_t at);

  /** @p text with the names of files in tables as they are seen from @p where, "file:line" or "--set": absolute. */
  std::string with_tables_beside(const std::string &text, const std::string &where);

  /** The names of all functions that may be used. */
  std::vector<std::string> function_names();
} // namespace samara

#endif
