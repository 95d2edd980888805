#ifndef samara_output_file_h
#define samara_output_file_h

#include <fstream>
#include <string>
#include <vector>

namespace samara
{
  /**
   * @name Writing files without losing anything silently
   *
   * A C++ stream that cannot write keeps quiet: a full disk shows first when the buffer is flushed, and only to those
   * who ask. All files of Samara are written with these functions, which ask, and which throw a std::runtime_error with
   * the name of the file and the reason.
   * @{
   */

  /** Make the folder and those above it; nothing happens if it is there. */
  void make_folder(const std::string &folder);

  /** An empty file to write into. The folder must exist. */
  std::ofstream open_file(const std::string &file);

  /** Bring everything written to the disk. */
  void flush(std::ofstream &stream, const std::string &file);

  /** Give the file this content. Who opens it meanwhile finds the old content or the new one, never a piece. */
  void replace_file(const std::string &file, const std::string &content);
  /** @} */

  /** A line of a CSV file with its end; fields with commas, quotes or line breaks are quoted. */
  std::string csv_line(const std::vector<std::string> &fields);

  /** @p number with this many significant digits, in every locale with a point. */
  std::string number_to_field(double number, unsigned int digits);
} // namespace samara

#endif
