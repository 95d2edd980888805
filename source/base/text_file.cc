#include <samara/base/text_file.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace samara
{
  namespace
  {
    constexpr std::size_t largest_size = std::size_t(256) << 20; ///< of a file that a person or a program has written

    std::string
    kind_of(const std::filesystem::file_type type)
    {
      using Type = std::filesystem::file_type;
      return type == Type::directory ? "a folder" :
             type == Type::fifo      ? "a pipe" :
             type == Type::socket    ? "a socket" :
                                       "a device";
    }



    std::string
    bytes_of_file(const std::string &name)
    {
      std::error_code error;
      const auto      status = std::filesystem::status(name, error);
      if (error || !std::filesystem::exists(status))
        throw std::invalid_argument("cannot open the file <" + name + ">" +
                                    (error && error.value() != ENOENT ? ": " + error.message() : "") + ".");
      if (!std::filesystem::is_regular_file(status))
        throw std::invalid_argument("cannot open the file <" + name + ">: it is " + kind_of(status.type()) +
                                    "; write the text into a file.");
      const std::string too_large = "the file <" + name + "> is larger than 256 MiB.";
      const auto        size      = std::filesystem::file_size(name, error);
      if (!error && size > largest_size)
        throw std::invalid_argument(too_large);
      errno = 0;
      std::ifstream in(name, std::ios::binary);
      if (!in)
        throw std::invalid_argument("cannot open the file <" + name + ">" +
                                    (errno != 0 ? ": " + std::generic_category().message(errno) : "") + ".");
      // what the system makes up while it is read has no size
      std::string text;
      char        block[1 << 16];
      while (in.read(block, sizeof block), in.gcount() > 0)
        {
          text.append(block, in.gcount());
          if (text.size() > largest_size)
            throw std::invalid_argument(too_large);
        }
      if (in.bad())
        throw std::invalid_argument("cannot read the file <" + name + ">.");
      return text;
    }
  } // namespace



  std::string
  text_of_file(const std::string &name)
  {
    std::string text   = bytes_of_file(name);
    const auto  starts = [&](const std::string &mark) { return text.compare(0, mark.size(), mark) == 0; };
    const auto  zero   = text.find('\0');
    if (starts("\xff\xfe") || starts("\xfe\xff") ||
        (zero < 2 && text.size() > 3 && text.find('\0', zero + 2) == zero + 2))
      throw std::invalid_argument(name + ":1: this file is written in UTF-16; save it as UTF-8.");
    if (zero != std::string::npos)
      throw std::invalid_argument(name + ":" + std::to_string(1 + std::count(text.begin(), text.begin() + zero, '\n')) +
                                  ": there is a zero byte; this is no text file.");
    if (starts("\xef\xbb\xbf"))
      text.erase(0, 3);
    if (text.find('\n') == std::string::npos)
      std::replace(text.begin(), text.end(), '\r', '\n');
    return text;
  }



  std::vector<std::string>
  csv_fields(const std::string &line)
  {
    std::vector<std::string> fields(1);
    bool                     quoted = false;
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        fields.emplace_back();
      else if (c != '\r')
        fields.back() += c;
    return fields;
  }
} // namespace samara
