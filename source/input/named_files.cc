#include <samara/base/text.h>
#include <samara/input/named_files.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>

namespace samara
{
  std::vector<std::string>
  files_named_in(const std::string &value, const std::string &file)
  {
    std::vector<std::string> names = {trim(value)};
    for (auto open = value.find('"'); open != std::string::npos;)
      {
        const auto close = value.find('"', open + 1);
        if (close == std::string::npos)
          break;
        names.push_back(trim(value.substr(open + 1, close - open - 1)));
        open = value.find('"', close + 1);
      }
    std::vector<std::string> files;
    for (const auto &name : names)
      {
        std::error_code   ignored; // a name that no file can have is one of none
        const std::string whole = name.empty() ? "" : file_beside(file, name);
        if (std::filesystem::is_regular_file(whole, ignored))
          files.push_back(whole);
      }
    return files;
  }



  std::string
  fingerprint_of(const std::string &text)
  {
    std::uint64_t hash = 14695981039346656037ull;
    for (const unsigned char c : text)
      hash = (hash ^ c) * 1099511628211ull;
    char hexadecimal[17];
    std::snprintf(hexadecimal, sizeof hexadecimal, "%016llx", static_cast<unsigned long long>(hash));
    return hexadecimal;
  }
} // namespace samara
