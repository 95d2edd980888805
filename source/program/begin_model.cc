// samara --new rotor

#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/input/parts.h>
#include <samara/output/file.h>
#include <samara/program/program.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace samara
{
  void
  begin_model(const std::string &kind, const std::string &file, Log &log)
  {
    namespace fs = std::filesystem;
    std::error_code          ignored;
    const fs::path           parts  = fs::canonical(folder_of_parts(), ignored);
    const fs::path           folder = parts.empty() ? fs::path() : parts.parent_path() / "new";
    std::vector<std::string> known;
    if (!folder.empty())
      for (const auto &entry : fs::directory_iterator(folder, ignored))
        known.push_back(entry.path().stem().string());
    std::sort(known.begin(), known.end());
    if (std::find(known.begin(), known.end(), kind) == known.end())
      throw InputError("there is no model of kind <" + kind + "> to begin with" + did_you_mean(kind, known));
    const std::string text = text_of_file((folder / (kind + ".prm")).string());
    if (file.empty())
      {
        std::cout << text;
        return;
      }
    if (fs::exists(file, ignored))
      throw InputError(file + " is there already: choose another name, nothing is written over");
    std::ofstream out = open_file(file);
    out << text;
    flush(out, file);
    log.line(file + " is written; run it: samara " + file);
  }
} // namespace samara
