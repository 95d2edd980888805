#include <samara/analysis/model_changes.h>
#include <samara/base/text.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace samara
{
  namespace
  {
    /** Values by their paths. */
    std::map<std::string, std::string>
    entries_of(const std::string &text)
    {
      std::map<std::string, std::string> entries;
      std::vector<std::string>           path;
      std::istringstream                 in(text);
      for (std::string line; std::getline(in, line);)
        {
          line                      = trim(line);
          const std::string section = "subsection ";
          if (line.compare(0, section.size(), section) == 0)
            path.push_back(line.substr(section.size()));
          else if (line == "end" && !path.empty())
            path.pop_back();
          else if (const auto set = line.find("set "), equal = line.find(" ="); set <= 2 && equal != std::string::npos)
            {
              // what stands at its default is printed as a comment, and is the same when it is set to that
              auto names = path;
              names.push_back(line.substr(set + 4, equal - set - 4));
              entries[join(names, "/")] = trim(line.substr(equal + 2));
            }
        }
      return entries;
    }

    bool
    is_harmless(const std::string &path)
    {
      static const std::set<std::string> paths = {"Title",
                                                  "Linear solver",
                                                  "Threads",
                                                  "Output/Probes", // the header of the CSV file tells
                                                  "Output/Pictures",
                                                  "Static/Tolerance",
                                                  "Static/Iterations"};
      static const std::set<std::string> fixed = {"Dynamic/Start time", "Dynamic/Inconsistent velocities"};
      return paths.count(path) == 1 || path.compare(0, 6, "Modal/") == 0 ||
             (path.compare(0, 8, "Dynamic/") == 0 && fixed.count(path) == 0);
    }

    std::string
    shortened(const std::string &value)
    {
      return value.empty() ? "nothing" : value.size() > 60 ? value.substr(0, 60) + "..." : value;
    }
  } // namespace



  bool
  ModelChanges::touches(const std::string &entry) const
  {
    const std::string begin = "Dynamic/" + entry + ":";
    return std::any_of(harmless.begin(), harmless.end(), [&](const auto &text) {
      return text.compare(0, begin.size(), begin) == 0;
    });
  }



  ModelChanges
  changes_of_model(const std::string &before, const std::string &now)
  {
    const auto            old_entries = entries_of(before), new_entries = entries_of(now);
    std::set<std::string> paths;
    for (const auto *const entries : {&old_entries, &new_entries})
      for (const auto &[path, value] : *entries)
        paths.insert(path);
    const auto value_of = [](const std::map<std::string, std::string> &entries, const std::string &path) {
      const auto entry = entries.find(path);
      return entry == entries.end() ? "" : entry->second;
    };
    ModelChanges changes;
    for (const auto &path : paths)
      if (const auto a = value_of(old_entries, path), b = value_of(new_entries, path); a != b)
        (is_harmless(path) ? changes.harmless : changes.refused)
          .push_back(path + ": " + shortened(a) + " before, " + shortened(b) + " now");
    return changes;
  }
} // namespace samara
