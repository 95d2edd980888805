#ifndef samara_model_output_name_h
#define samara_model_output_name_h

#include <string>

namespace samara
{
  /** "pilot_2" into "pilot" and "2": an output of several. False if @p path has no number. */
  bool split_number(const std::string &path, std::string &name, std::string &number);
} // namespace samara

#endif
