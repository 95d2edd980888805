#ifndef samara_base_pattern_in_words_h
#define samara_base_pattern_in_words_h

#include <deal.II/base/patterns.h>

#include <string>
#include <vector>

namespace samara
{
  /** The words of a selection; none if the pattern is something else. */
  std::vector<std::string> choices_of(const dealii::Patterns::PatternBase &pattern);

  /** What is accepted, for people: "a number of at least 0". */
  std::string in_words(const dealii::Patterns::PatternBase &pattern);
} // namespace samara

#endif
