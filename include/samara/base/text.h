#ifndef samara_base_text_h
#define samara_base_text_h

#include <string>
#include <vector>

namespace samara
{
  /** @p text without white space at its ends. */
  std::string trim(const std::string &text);

  /**
   * The trimmed pieces of @p text between separators that stand outside all parentheses; "" has no pieces. Parentheses
   * protect, so that "atan2(1, 2), 3" are two numbers.
   */
  std::vector<std::string> split_top_level(const std::string &text, char separator);

  /** The pieces with @p separator between them. */
  std::string join(const std::vector<std::string> &pieces, const std::string &separator);

  /** How many letters must be inserted, removed or replaced to turn @p a into @p b. */
  unsigned int edit_distance(const std::string &a, const std::string &b);

  /**
   * The end of a complaint about a @p wrong name: "; did you mean <X>?" with the nearest candidate; if none is near,
   * "; known: a, b, c." provided that they are few; and otherwise ".". Upper and lower case are not told apart. What
   * other programs call it, "pin" for a revolute joint, is known.
   */
  std::string did_you_mean(const std::string &wrong, const std::vector<std::string> &candidates);

  /**
   * @p text for people: bytes that are no printable UTF-8 are escaped, "\\x1b", but for line feeds; a line of more than
   * some hundred letters is cut in its middle, for what was said stands at its beginning and what is wrong at its end.
   */
  std::string readable(const std::string &text);

  /** The name of a file that is written in another one, and relative to its folder. */
  std::string file_beside(const std::string &file, const std::string &name);

  /** Whether did_you_mean() still looks for names: of ten thousand mistakes only the first hundreds need advice. */
  bool may_suggest();

  /** A number as printf() writes it with this @p pattern, "%.3g". */
  std::string number_to_text(const char *pattern, double number);

  /** The shortest text that reads as exactly this number. */
  std::string number_to_text(double number);

  /**
   * Read @p text as one plain number, all of it, with an optional sign. Returns whether it is one. The point is a point
   * in every locale.
   */
  bool text_to_number(const std::string &text, double &number);

  /** Split "name at 0.3" into its name and what stands behind the last " at "; returns whether both are there. */
  bool split_at(const std::string &text, std::string &name, std::string &place);
} // namespace samara

#endif
