// The runs of a study: the overrides of each, their folders, and whether they can be run.

#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/input/input.h>
#include <samara/input/named_files.h>
#include <samara/study/study.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace samara
{
  namespace
  {
    constexpr std::size_t most_faults = 100;

    /** Whether @p piece begins a new override: has an "=" that is not one of ==, <=, >=, !=. */
    bool
    is_assignment(const std::string &piece)
    {
      for (auto i = piece.find('='); i != std::string::npos; i = piece.find('=', i + 1))
        if (i > 0 && std::string("=<>!").find(piece[i - 1]) == std::string::npos && piece[i + 1] != '=')
          return true;
      return false;
    }



    /** "A/b = 1; C/d = 0, 0; 1, 0" are two overrides: a list of vectors goes on behind its semicolon. */
    std::vector<std::string>
    overrides_of(const std::string &text)
    {
      std::vector<std::string> result;
      for (const auto &piece : split_top_level(text, ';'))
        if (piece.empty())
          continue;
        else if (result.empty() || is_assignment(piece))
          result.push_back(piece);
        else
          result.back() += "; " + piece;
      return result;
    }



    std::string
    last_step(const std::string &path)
    {
      const auto slash = path.rfind('/');
      return trim(slash == std::string::npos ? path : path.substr(slash + 1));
    }



    /** A name that every file system takes, and that is not another folder: no "..". */
    std::string
    file_name(const std::string &text)
    {
      constexpr std::size_t most_letters = 80;
      std::string           result;
      for (const char c : text.substr(0, most_letters))
        if (std::isalnum(static_cast<unsigned char>(c)) || (c == '.' && !result.empty()) || c == '-' || c == '+')
          result += c;
        else if (!result.empty() && result.back() != '_')
          result += '_';
      return result;
    }



    /** The number at the start of "5 ms"; nan if there is none. */
    double
    leading_number(const std::string &text)
    {
      char        *end    = nullptr;
      const double number = std::strtod(text.c_str(), &end);
      return end == text.c_str() || *end == '/' || *end == '*' ? std::nan("") : number;
    }



    /** Whether there is such a file; a name that no file can have is one of none. */
    bool
    is_file(const std::string &name)
    {
      std::error_code ignored;
      return std::filesystem::is_regular_file(name, ignored);
    }



    /** The contents of the files that an entry at @p where, "file:line", names. */
    std::string
    contents_of_files(const std::string &value, const std::string &where)
    {
      std::string text;
      for (const auto &file : files_named_in(value, where.substr(0, where.rfind(':'))))
        text += text_of_file(file);
      return text;
    }



    void
    flatten(const Outline &outline, std::string &text)
    {
      for (const auto &entry : outline.entries)
        text += entry.name + '=' + entry.value + '\n' + contents_of_files(entry.value, entry.where);
      for (const auto &section : outline.sections)
        {
          text += section.name + "{\n";
          flatten(section, text);
          text += "}\n";
        }
    }
  } // namespace



  void
  StudyMember::add_overrides(const std::vector<std::string> &texts, const std::string &where)
  {
    for (const auto &text : texts)
      overrides.push_back({text, where, where});
  }



  std::vector<std::string>
  StudyMember::override_texts() const
  {
    std::vector<std::string> texts;
    for (const auto &override : overrides)
      texts.push_back(override.text);
    return texts;
  }



  double
  StudyMember::refinement() const
  {
    return number > 0 ? number : result.unknowns;
  }



  void
  Study::make_members(const StudyMethod &method, const unsigned int index, Complaints &complaints)
  {
    StudyMember base;
    base.method                  = index;
    const std::string &own_model = method.model.empty() ? model : method.model;
    const auto        &model_at  = method.model.empty() ? root.where("Model") : method.parameters.where("Model");
    base.model                   = file_beside(file, own_model);
    if (own_model.empty())
      return complaints.add(root.where("Model"), "<Model> must be given: the input file that is studied");
    if (!is_file(base.model))
      return complaints.add(model_at, "<Model>: there is no file <" + base.model + ">");
    base.add_overrides(quantity.overrides(), settings.where("Quantity"));
    base.add_overrides(overrides_of(overrides), settings.where("Overrides"));
    base.add_overrides(overrides_of(method.overrides), method.parameters.where("Overrides"));

    const bool own_vary = !method.vary.empty(), own_values = !method.values.empty();
    const auto names = split_top_level(own_vary ? method.vary : vary, ';');
    const auto lists = split_top_level(own_values ? method.values : values, ';');
    if (std::count(names.begin(), names.end(), "") > 0)
      return complaints.add(own_vary ? method.parameters.where("Vary") : settings.where("Vary"),
                            "<Vary>: an entry is missing; is there a semicolon too many?");
    const auto vary_at   = own_vary ? method.parameters.where("Vary") : settings.where("Vary");
    const auto values_at = own_values ? method.parameters.where("Values") : settings.where("Values");
    if (names.empty() != lists.empty())
      return complaints.add(names.empty() ? values_at : vary_at, "<Vary> and <Values> belong together: one is missing");
    if (lists.size() > 1 && lists.size() != names.size())
      return complaints.add(values_at,
                            "<Values> has " + std::to_string(lists.size()) + " lists for " +
                              std::to_string(names.size()) + " entries of <Vary>; give one for all, or one for each");
    std::vector<std::vector<std::string>> columns;
    for (const auto &list : lists)
      {
        columns.push_back(split_top_level(list, ','));
        const auto &values_of_list = columns.back();
        if (values_of_list.empty() || std::count(values_of_list.begin(), values_of_list.end(), "") > 0)
          return complaints.add(values_at, "<Values>: <" + list + ">: a value is missing; is there a comma too many?");
        if (columns.back().size() != columns[0].size())
          return complaints.add(values_at, "<Values>: the lists have different numbers of values");
      }
    for (unsigned int k = 0; k < (columns.empty() ? 1 : columns[0].size()); ++k)
      {
        StudyMember member = base;
        for (unsigned int i = 0; i < names.size(); ++i)
          member.overrides.push_back({names[i] + " = " + columns[columns.size() > 1 ? i : 0][k], vary_at, values_at});
        if (!columns.empty())
          {
            member.value  = columns[0][k];
            member.number = leading_number(member.value);
            member.label  = last_step(names[0]) + " = " + member.value;
          }
        members.push_back(std::move(member));
      }
  }



  void
  Study::add_reference(Complaints &complaints)
  {
    const std::string where  = settings.where("Reference");
    double            number = 0;
    if (!reference_overrides.empty() && reference != "finest")
      complaints.add(settings.where("Reference overrides"),
                     "<Reference overrides> ask for a run to compare with, but <Reference> is <" + reference + ">");
    else if (reference == "finest" && !reference_overrides.empty())
      {
        if (model.empty())
          return complaints.add(settings.where("Reference overrides"),
                                "<Reference overrides> need a <Model> of the study");
        StudyMember member;
        member.method = methods.size();
        member.label  = "reference";
        member.model  = file_beside(file, model);
        member.add_overrides(quantity.overrides(), settings.where("Quantity"));
        member.add_overrides(overrides_of(overrides), settings.where("Overrides"));
        member.add_overrides(overrides_of(reference_overrides), settings.where("Reference overrides"));
        reference_member = members.size();
        members.push_back(std::move(member));
      }
    else if (reference == "finest")
      {
        // levels go from the coarsest to the finest, methods have no order
        for (unsigned int i = 0; i < members.size(); ++i)
          if (members[i].method == 0 || is_ladder)
            reference_member = i;
        if (members.size() == 1 && complaints.empty())
          complaints.add(where, "there is one member only, and nothing to compare it with; give a <Reference>");
      }
    else if (!text_to_number(reference, number))
      {
        const auto colon = reference.find(':');
        reference_file   = file_beside(file, trim(reference.substr(0, colon)));
        reference_column = colon == std::string::npos ? quantity.name : trim(reference.substr(colon + 1));
        try
          {
            if (!is_file(reference_file))
              throw std::runtime_error("<" + reference + "> is not a number, and there is no file <" + reference_file +
                                       ">; write a number, a file, or <finest>");
            if (!reference_column.empty()) // a quantity that could not be read has no name
              read_series(reference_file, reference_column);
          }
        catch (const std::runtime_error &problem)
          {
            complaints.add(where, std::string("<Reference>: ") + problem.what());
          }
      }
  }



  void
  Study::name_folders()
  {
    std::set<std::string> taken;
    for (auto &member : members)
      {
        const bool  is_extra = member.method == methods.size();
        std::string name     = is_extra ? "reference" : file_name(methods[member.method]->name);
        if (!member.value.empty())
          name += "_" + file_name(member.value);
        for (unsigned int i = 2; !taken.insert(name).second; ++i)
          name += "_" + std::to_string(i);
        member.folder = "members/" + name;
      }
  }



  const InputFile &
  Study::model_of(const StudyMember &member)
  {
    return files.try_emplace(member.model, member.model).first->second;
  }



  std::string
  Study::fingerprint_of(const StudyMember &member)
  {
    std::string text;
    flatten(model_of(member).outline, text);
    for (const auto &override : member.override_texts())
      text += override + '\n' + contents_of_files(override.substr(override.find('=') + 1), "");
    return samara::fingerprint_of(text);
  }



  std::vector<std::string>
  Study::faults_of(const StudyMember &member, const std::vector<std::string> &texts)
  {
    try
      {
        Input      input(Catalogue(), model_of(member), texts);
        const auto system = input.assemble();
        input.make_probes();
        if (texts.size() == member.overrides.size() && !input.has_analysis(quantity.analysis()))
          return {settings.where("Quantity") + ": <Quantity>: there is no " + quantity.analysis() +
                  " analysis among the <Analyses> of " + member.model};
      }
    catch (const InputError &error)
      {
        return error.complaints;
      }
    return {};
  }



  void
  Study::check_members(Complaints &complaints)
  {
    for (const auto &member : members)
      {
        if (complaints.count() > most_faults)
          break; // the others would say the same
        const auto texts = member.override_texts();
        for (const auto &fault : faults_of(member, texts))
          {
            const std::string sign = "--set: ";
            if (fault.compare(0, sign.size(), sign) != 0)
              {
                complaints.add("", fault);
                continue;
              }
            // whose fault it is shows when the overrides are given one after the other
            unsigned int guilty = 0;
            for (; guilty + 1 < texts.size(); ++guilty)
              {
                const auto faults = faults_of(member, {texts.begin(), texts.begin() + guilty + 1});
                if (std::find(faults.begin(), faults.end(), fault) != faults.end())
                  break;
              }
            const auto &override = member.overrides[guilty];
            bool        is_name  = false;
            for (const char *const sign_of_name :
                 {"is not a parameter", "is not a subsection", "there is no subsection"})
              is_name = is_name || fault.find(sign_of_name) != std::string::npos;
            complaints.add(is_name ? override.where : override.where_value, fault.substr(sign.size()));
          }
      }
    if (complaints.empty())
      for (auto &member : members)
        member.fingerprint = fingerprint_of(member);
  }
} // namespace samara
