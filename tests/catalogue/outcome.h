#ifndef samara_tests_catalogue_outcome_h
#define samara_tests_catalogue_outcome_h

#include <samara/base/errors.h>
#include <samara/program/program.h>

#include "../output/scratch_folder.h"

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace samara
{
  /** All that a run says and writes but for what it read, what it cost, and where its results are. */
  class Outcome
  {
  public:
    bool        refused = false; ///< as faulty input
    std::string text;

    /** @p files: others that the model names, by name. */
    Outcome(const std::string                        &model,
            const std::vector<std::string>           &overrides,
            const std::map<std::string, std::string> &files = {})
    {
      const ScratchFolder folder;
      for (const auto &[name, content] : files)
        std::ofstream(folder.path + "/" + name) << content;
      Options options;
      options.model     = folder.path + "/model.prm";
      options.output    = folder.path + "/results";
      options.overrides = overrides;
      // the page of the report holds used.prm, which no two runs that are compared here have in common
      const auto is_of_report = [](const std::string &text) { return text.find("Output/Report") == 0; };
      if (model.find("study") == std::string::npos &&
          std::none_of(overrides.begin(), overrides.end(), is_of_report))
        options.overrides.push_back("Output/Report = false");
      std::ofstream(options.model) << model;
      std::ostringstream said;
      Log                log(said);
      try
        {
          run(options, log);
        }
      catch (const InputError &error)
        {
          refused = true;
          said << error.what();
        }
      catch (const std::runtime_error &error)
        {
          said << error.what();
        }
      text = said.str();
      add_files(options.output);
      // the folder, and times
      text =
        std::regex_replace(text, std::regex(std::regex_replace(folder.path, std::regex("[.+]"), "\\$&")), "FOLDER");
      text = std::regex_replace(text, std::regex("[-+.e0-9]+ s(?=[ ,;])"), "TIME");
    }

  private:
    /** The file but for columns of what a run took. */
    static std::string
    table_of(const std::string &file)
    {
      std::istringstream       lines(content_of(file));
      std::vector<std::string> names;
      std::string              result;
      for (std::string line; std::getline(lines, line);)
        {
          std::istringstream cells(line);
          const bool         is_head = names.empty();
          unsigned int       i       = 0;
          for (std::string cell; std::getline(cells, cell, ','); ++i)
            {
              if (is_head)
                names.push_back(cell);
              const bool is_time = i < names.size() && names[i].find("time [s]") != std::string::npos;
              result += is_time ? "," : cell + ",";
            }
          result += "\n";
        }
      return result;
    }

    void
    add_files(const std::string &folder)
    {
      if (!std::filesystem::exists(folder))
        return;
      std::map<std::string, std::string> files;
      for (const auto &file : std::filesystem::recursive_directory_iterator(folder))
        {
          const std::string name = file.path().filename();
          if (!file.is_regular_file() || name == "used.prm" || name == "summary.csv")
            continue;
          const std::string extension = file.path().extension();
          files[file.path()]          = extension == ".csv" ? table_of(file.path()) :
                                        extension == ".h5" || extension == ".checkpoint" || extension == ".txt" || extension == ".html" ?
                                                              "" :
                                                              content_of(file.path());
        }
      for (const auto &[name, content] : files)
        text += name + ":\n" + content + "\n";
    }
  };
} // namespace samara

#endif
