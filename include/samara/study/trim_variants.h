#ifndef samara_study_trim_variants_h
#define samara_study_trim_variants_h

#include <samara/input/input.h>

namespace samara
{
  /** Let the trim of an input that was read from @p file with these overrides read it again with other constants. */
  void let_trim_continue(const Input &input, const std::string &file, const std::vector<std::string> &overrides);
} // namespace samara

#endif
