#ifndef samara_base_text_file_h
#define samara_base_text_file_h

#include <string>
#include <vector>

namespace samara
{
  /**
   * All that a text file says, read at once, without a byte order mark, and with a line feed at the end of each line.
   * What is no file is refused before it is opened, so that nobody waits for a pipe; so is a file of more than 256 MiB.
   * @throws std::invalid_argument naming the file and what is wrong with it
   */
  std::string text_of_file(const std::string &name);

  /** The fields of a line of a CSV file; what is in quotes may have commas. */
  std::vector<std::string> csv_fields(const std::string &line);
} // namespace samara

#endif
