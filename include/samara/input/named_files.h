#ifndef samara_input_named_files_h
#define samara_input_named_files_h

#include <string>
#include <vector>

namespace samara
{
  /**
   * Files that an entry names, such as tables and meshes: all of its @p value is a name, or what is in quotes in it.
   * Names are relative to the folder of @p file, in which the entry stands; what is no file is left out.
   */
  std::vector<std::string> files_named_in(const std::string &value, const std::string &file);

  /** 64 bits of FNV-1a of a text, as 16 hexadecimal digits. */
  std::string fingerprint_of(const std::string &text);
} // namespace samara

#endif
