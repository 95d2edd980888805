#ifndef samara_base_number_in_file_h
#define samara_base_number_in_file_h

#include <samara/base/text.h>

#include <cmath>
#include <string>

namespace samara
{
  /** Larger numbers are refused [SI]: their squares, and products of a few of them, must be numbers, too. */
  constexpr double largest_number = 1e100;

  /**
   * What is wrong with @p text, in a file, as a @p number: "is not a number", or one with which nothing can be
   * computed;
   * "" if nothing is. Very small ones are not refused: other programs write them where zero is meant.
   */
  inline std::string
  fault_of_number(const std::string &text, double &number)
  {
    if (!text_to_number(text, number) || std::isnan(number))
      return "is not a number";
    return std::abs(number) > largest_number ? "is too large to compute with: sizes are up to 1e100 in SI units" : "";
  }
} // namespace samara

#endif
