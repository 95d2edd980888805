// Parts that come with the program, or stand beside a model.

#include <samara/base/parameters.h>
#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/input/parts.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace samara
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string suffix = ".prm";

    constexpr unsigned int deepest_part = 20; ///< of parts in parts: more is a part in itself
  }                                           // namespace



  std::string
  word_of(const std::string &name)
  {
    std::string word;
    for (const char c : name)
      word += std::isalnum(static_cast<unsigned char>(c)) != 0 ?
                static_cast<char>(std::tolower(static_cast<unsigned char>(c))) :
                '_';
    return word;
  }



  std::string
  PartArgument::word() const
  {
    return word_of(name);
  }



  std::string
  PartArgument::documentation() const
  {
    return meaning + (choices.empty() ? "" : " One of: " + join(choices, ", ") + ".");
  }



  std::vector<PartArgument>
  arguments_of(const Outline &section, Complaints &complaints)
  {
    using dealii::Patterns::Selection;
    std::vector<PartArgument> all;
    for (const auto &entry : section.entries)
      complaints.add(entry.where, "<" + entry.name + "> stands outside of a named argument");
    for (const auto &said : section.sections)
      {
        PartArgument argument;
        argument.name  = said.name;
        argument.where = said.where;
        Parameters entries(said.name, "argument");
        entries.add(
          "Kind",
          argument.kind,
          "What it is.",
          Selection(
            "number|positive number|whole number|numbers|vector|yes or no|choice|text|file|place|function|law"));
        entries.add("Unit", argument.unit, "SI unit of a number without one.");
        entries.add("Default", argument.standard, "Value where none is given; none: there need not be one.");
        entries.add("Choices", argument.choices, "What may be chosen.");
        entries.add("Meaning", argument.meaning, "A sentence.");
        entries.parse(said, Quantities(), complaints);
        argument.is_required = said.entry("Default") == nullptr;
        argument.standard    = said.value("Default"); // "none" has a meaning here
        all.push_back(argument);
      }
    return all;
  }



  std::string
  folder_of_parts()
  {
    static const std::string folder = [] {
      std::error_code ignored;
      for (fs::path above = fs::read_symlink("/proc/self/exe", ignored).parent_path(); !above.empty();
           above          = above.parent_path())
        {
                   const fs::path here = above / "share" / "samara" / "parts";
                   if (fs::is_directory(here, ignored))
            return here.string();
          if (above == above.parent_path())
            break;
        }
      return std::string();
    }();
    return folder;
  }



  std::vector<std::string>
  shipped_parts()
  {
    std::vector<std::string> names;
    const std::string        folder = folder_of_parts();
    std::error_code          ignored;
    if (folder.empty())
      return names;
    for (const auto &entry : fs::recursive_directory_iterator(folder, ignored))
      if (entry.path().extension() == suffix)
        names.push_back(entry.path().lexically_relative(folder).replace_extension("").generic_string());
    std::sort(names.begin(), names.end());
    return names;
  }



  std::string
  file_of_part(const std::string &name, const std::string &asking_file)
  {
    std::error_code   ignored;
    const bool        has_suffix = name.size() > suffix.size() && name.substr(name.size() - suffix.size()) == suffix;
    const std::string file = has_suffix ? name : name + suffix, beside = file_beside(asking_file, file),
                      shipped = folder_of_parts() + "/" + file;
    if (fs::is_regular_file(beside, ignored))
      return beside;
    if (!folder_of_parts().empty() && fs::is_regular_file(shipped, ignored))
      return shipped;
    throw std::invalid_argument("there is no part <" + name + ">, neither in " + beside +
                                " nor among those of the program" + did_you_mean(name, shipped_parts()));
  }



  std::string
  head_of_file(const std::string &file)
  {
    std::istringstream lines(text_of_file(file));
    std::string        head;
    for (std::string line; std::getline(lines, line) && !line.empty() && line[0] == '#';)
      head += line.substr(std::min<std::size_t>(line.size(), line.compare(0, 2, "# ") == 0 ? 2 : 1)) + '\n';
    return head;
  }



  namespace
  {
    /** The content of a part, with that of the parts in it. */
    void
    expand_subsystems(Outline &around, const unsigned int depth, Complaints &complaints)
    {
      Outline *section = nullptr;
      for (auto &inner : around.sections)
        if (inner.name == "Subsystems")
          section = &inner;
      if (section == nullptr)
        return;
      for (auto &said : section->sections)
        {
          if (const auto *const part = said.entry("Part"); part != nullptr)
            try
              {
                if (depth >= deepest_part)
                  throw std::invalid_argument("parts stand in each other more than " + std::to_string(deepest_part) +
                                              " deep; is a part in itself?");
                const std::string file    = file_of_part(part->value, part->where.substr(0, part->where.rfind(':')));
                Outline           content = Outline::of_file(file, complaints);
                complaints.note_inclusion(file, part->where);
                for (const auto &entry : content.entries)
                  complaints.add(entry.where, "a part has subsections, and no entries outside of them");
                content.entries.clear();
                content.name      = said.name;
                content.where     = said.where;
                content.inherited = said.inherited;
                content.merge(said);
                said = std::move(content);
              }
            catch (const std::invalid_argument &problem)
              {
                complaints.add(part->where, problem.what());
              }
          expand_subsystems(said, depth + 1, complaints);
        }
    }
  } // namespace



  void
  expand_parts(Outline &model, Complaints &complaints)
  {
    expand_subsystems(model, 0, complaints);
  }
} // namespace samara
