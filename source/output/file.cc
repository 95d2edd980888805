#include <samara/base/errors.h>
#include <samara/output/file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace samara
{
  namespace
  {
    [[noreturn]] void
    fail(const std::string &file, const int error)
    {
      const std::string reason = error != 0 ? ": " + std::generic_category().message(error) : "";
      throw CannotWrite("cannot write " + file + reason + ".");
    }



    int
    error_of_waiting(const std::string &file)
    {
      const int handle = ::open(file.c_str(), O_RDONLY);
      if (handle < 0)
        return errno;
      // what cannot be waited for, such as a pipe, says EINVAL
      const int error = ::fsync(handle) != 0 && errno != EINVAL ? errno : 0;
      ::close(handle);
      return error;
    }
  } // namespace



  void
  make_folder(const std::string &folder)
  {
    std::error_code error, ignored;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder, ignored))
      fail(folder, error.value());
  }



  std::ofstream
  open_file(const std::string &file, const bool append)
  {
    errno = 0;
    std::ofstream stream(file, append ? std::ios::binary | std::ios::app : std::ios::binary);
    if (!stream)
      fail(file, errno);
    return stream;
  }



  void
  flush(std::ofstream &stream, const std::string &file)
  {
    write_now(stream, "", file);
  }



  void
  write_now(std::ofstream &stream, const std::string &content, const std::string &file)
  {
    errno = 0;
    stream << content << std::flush;
    if (!stream)
      fail(file, errno);
  }



  void
  wait_for_disk(const std::string &file)
  {
    if (const int error = error_of_waiting(file))
      fail(file, error);
  }



  void
  replace_file(const std::string &file, const std::string &content, const bool wait)
  {
    const std::string part   = part_of(file);
    std::ofstream     stream = open_file(part);

    errno = 0;
    stream << content << std::flush;
    stream.close();
    const bool failed = !stream;
    const int  error  = failed ? errno : wait ? error_of_waiting(part) : 0;
    if (failed || error != 0)
      {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        fail(file, error);
      }
    replace_by_part(file);
  }



  std::string
  part_of(const std::string &file)
  {
    return file + ".part";
  }



  void
  replace_by_part(const std::string &file)
  {
    std::error_code error, ignored;
    std::filesystem::rename(part_of(file), file, error);
    if (!error)
      return;
    std::filesystem::remove(part_of(file), ignored);
    fail(file, error.value());
  }



  void
  cut_file(const std::string &file, const std::uintmax_t size)
  {
    std::error_code error;
    std::filesystem::resize_file(file, size, error);
    if (error)
      fail(file, error.value());
  }



  std::string
  csv_line(const std::vector<std::string> &fields)
  {
    std::string line;
    for (const std::string &field : fields)
      {
        if (&field != &fields.front())
          line += ',';
        if (field.find_first_of(",\"\n\r") == std::string::npos)
          {
            line += field;
            continue;
          }
        line += '"';
        for (const char c : field)
          line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
      }
    return line + '\n';
  }



  std::string
  number_to_field(const double number, const unsigned int digits)
  {
    std::string text;
    append_number(text, number, digits);
    return text;
  }



  void
  append_number(std::string &line, const double number, const unsigned int digits)
  {
    char       buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), number, std::chars_format::general, digits).ptr;
    line.append(buffer, end);
  }



  bool
  is_up_to(const double recorded, const double limit)
  {
    // at most half a unit of the last digit was lost
    const double lost = 0.5 * std::pow(10., 1. - digits_of_records);
    return recorded <= limit + 2 * lost * std::abs(limit);
  }
} // namespace samara
