#ifndef samara_output_file_h
#define samara_output_file_h

#include <cstdint>
#include <fstream>
#include <set>
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

  /** A file to write into: an empty one, or with @p append behind what it has. The folder must exist. */
  std::ofstream open_file(const std::string &file, bool append = false);

  /** Hand everything written to the operating system. */
  void flush(std::ofstream &stream, const std::string &file);

  /** Write @p content and hand it to the operating system: a killed program does not lose it. */
  void write_now(std::ofstream &stream, const std::string &content, const std::string &file);

  /** Wait until the disk itself has the file, which a power failure then does not take. */
  void wait_for_disk(const std::string &file);

  /**
   * Give the file this content. Who opens it meanwhile finds the old content or the new one, never a piece; that holds
   * through a power failure if we @p wait until the disk has it. The old content stays if this fails.
   */
  void replace_file(const std::string &file, const std::string &content, bool wait = false);

  /** Where to write a file piece by piece, and how to let it take the place of @p file then. @{ */
  std::string part_of(const std::string &file);
  void        replace_by_part(const std::string &file);
  /** @} */

  /** Cut off what stands behind the first @p size bytes. Once begun it is done, even if the program is killed. */
  void cut_file(const std::string &file, std::uintmax_t size);
  /** @} */

  /**
   * A folder of results belongs to one process at a time: two that write into it would mix their rows. The lock is one
   * of the operating system on the file .samara_lock in it, so that it ends with the process, however that ends.
   * Processes that are started by this one have no part in it. Where the file system knows no locks there is none.
   */
  class FolderLock
  {
  public:
    /** @throws CannotWrite naming the other process, if one writes into the folder, which must exist */
    explicit FolderLock(const std::string &folder);

    FolderLock(FolderLock &&other) noexcept;

    ~FolderLock();

  private:
    std::string file;
    int         handle = -1;

    void take_it();
  };

  /** @p text with an underscore for all that is no letter, digit, point or minus sign: a part of a file's name. */
  std::string file_name_of(const std::string &text);

  /** Parts of files' names of which no two are equal, though file_name_of() is: "a_b", "a_b_2". */
  class FileNames
  {
  public:
    /** That of the next text. Letters whose case alone differs are the same on some systems. */
    std::string next(const std::string &text);

  private:
    std::set<std::string> taken; ///< in small letters
  };

  /** A line of a CSV file with its end; fields with commas, quotes or line breaks are quoted. */
  std::string csv_line(const std::vector<std::string> &fields);

  /** @p number with this many significant digits, in every locale with a point; nan, inf. @{ */
  std::string number_to_field(double number, unsigned int digits);
  void        append_number(std::string &line, double number, unsigned int digits);
  /** @} */

  /** Significant digits of times and other numbers that are recorded while an analysis runs. */
  constexpr unsigned int digits_of_records = 15;

  /** Whether a number that was recorded, and lost digits then, is @p limit or less. */
  bool is_up_to(double recorded, double limit);
} // namespace samara

#endif
