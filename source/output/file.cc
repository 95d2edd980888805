#include <samara/output/file.h>

#include <cerrno>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <sstream>
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
      throw std::runtime_error("cannot write " + file + reason + ".");
    }
  } // namespace



  void
  make_folder(const std::string &folder)
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
      fail(folder, error.value());
  }



  std::ofstream
  open_file(const std::string &file)
  {
    errno = 0;
    std::ofstream stream(file, std::ios::binary);
    if (!stream)
      fail(file, errno);
    return stream;
  }



  void
  flush(std::ofstream &stream, const std::string &file)
  {
    errno = 0;
    stream.flush();
    if (!stream)
      fail(file, errno);
  }



  void
  replace_file(const std::string &file, const std::string &content)
  {
    const std::string part = file + ".part";

    std::ofstream stream = open_file(part);
    errno                = 0;
    stream << content << std::flush;
    stream.close();
    if (!stream)
      {
        const int       error = errno;
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        fail(file, error);
      }

    std::error_code error;
    std::filesystem::rename(part, file, error);
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
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::setprecision(digits) << number;
    return text.str();
  }
} // namespace samara
