// What a subsystem is given, and what of it is there: arguments, constants, texts, objects that are left out.

#include <samara/base/fault_of_text.h>
#include <samara/base/text.h>
#include <samara/input/subsystems.h>
#include <samara/model/model.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace samara
{
  namespace
  {
    /** Constants of a part: for its own text, and for what the model changes in it. */
    struct BothReaders
    {
      Quantities &own, &scope;
      Complaints &complaints;

      void
      set(const std::string &name, const std::string &text, const std::string &where, const Quantities &reader)
      {
        scope.add_constant(name, text, where, reader, complaints);
        own.add_constant(name, text, where, reader, complaints);
      }

      void
      set_text(const std::string &name, const std::string &text)
      {
        own.texts[name] = scope.texts[name] = text;
      }

      void
      set_number(const std::string &name, const double number, const std::string &unit, const std::string &where)
      {
        set(name, "(" + number_to_text(number) + ")" + (unit == "1" ? "" : " " + unit), where, Quantities());
      }
    };



    const std::string nothing = "none";

    double
    number_of(const PartArgument &argument, const std::string &text, const Quantities &reader)
    {
      const double number = Value<double>::read(text, argument.unit, reader);
      if (argument.kind == "positive number" && !(number > 0))
        throw std::invalid_argument("<" + text + "> is not positive");
      if (argument.kind == "whole number" && number != std::round(number))
        throw std::invalid_argument("<" + text + "> is not a whole number");
      return number;
    }



    std::string
    with_absolute_name(const std::string &where, const std::string &name)
    {
      std::error_code   ignored;
      const std::string beside   = file_beside(where.substr(0, where.rfind(':')), name);
      const auto        absolute = std::filesystem::absolute(beside, ignored);
      return ignored ? beside : absolute.string();
    }



    /** So that it may stand in an expression; but not a table, which stands alone. */
    std::string
    in_parentheses(const std::string &text)
    {
      return text.rfind(ScalarFunction::table_prefix, 0) == 0 ? text : "(" + text + ")";
    }



    const std::string same_else = " else "; ///< in "of On else flow": what it is if that has no such thing
    const std::string same_as   = "of ";    ///< begins the default "of On": what the part that is named there was given



    /** What an argument of a kind without a place in other subsystems means inside of the part. */
    void
    give_value(const PartArgument &argument,
               const std::string  &text,
               const std::string  &where,
               const Quantities   &reader,
               BothReaders        &readers)
    {
      const std::string word = argument.word();
      if (argument.kind == "yes or no")
        readers.set_number(word, Value<bool>::read(text, "1", reader) ? 1 : 0, "1", where);
      else if (argument.kind == "choice")
        {
          const auto &choices = argument.choices;
          if (std::find(choices.begin(), choices.end(), text) == choices.end())
            throw std::invalid_argument("<" + text + "> is not a choice" + did_you_mean(text, choices));
          for (const auto &choice : choices)
            readers.set_number(word + "_is_" + word_of(choice), choice == text ? 1 : 0, "1", where);
          readers.set_text(word, text);
        }
      else if (argument.kind == "vector")
        {
          const auto        vector = Value<Eigen::Vector3d>::read(text, argument.unit, reader);
          const std::string axes   = "xyz";
          readers.set_text(word, Value<Eigen::Vector3d>::write(vector));
          for (unsigned int i = 0; i < 3; ++i)
            readers.set_number(word + "_" + axes[i], vector[i], argument.unit, where);
        }
      else if (argument.kind == "numbers")
        readers.set_text(
          word, Value<std::vector<double>>::write(Value<std::vector<double>>::read(text, argument.unit, reader)));
      else if (argument.kind == "function")
        readers.set_text(word,
                         in_parentheses(reader.expression(with_tables_beside(text, where), argument.unit, {"s"})));
      else if (argument.kind == "file")
        readers.set_text(word, with_absolute_name(where, text));
      else if (argument.kind == "text")
        readers.set_text(word, text);
      else
        {
          const double number = number_of(argument, text, reader);
          readers.set_number(word, number, argument.unit, where);
        }
    }
  } // namespace



  void
  Subsystems::give_arguments(Scope             &scope,
                             const Outline     &said,
                             const Reading     &reading,
                             const unsigned int k,
                             const unsigned int n,
                             Complaints        &complaints)
  {
    // the text of a part does not depend on the constants of who uses it
    scope.own = std::make_shared<Quantities>();
    scope.own->begin_subsystem();
    scope.own_file = said.section("Arguments")->where;
    scope.own_file = scope.own_file.substr(0, scope.own_file.rfind(':'));
    BothReaders readers{*scope.own, scope.quantities, complaints};
    readers.set_number("copy", k + 1, "1", said.where);
    readers.set_number("copies", n, "1", said.where);
    readers.set_text("here", scope.prefix);
    bool any_is_wrong = false;
    for (std::size_t i = 0; i < reading.wanted.size(); ++i)
      if (const PartArgument &argument = reading.wanted[i]; reading.parameters.has(argument.name))
        try
          {
            give_argument(scope, said, reading, i, complaints);
          }
        catch (const std::invalid_argument &problem)
          {
            // a default may be made of arguments that are wrong
            const bool follows     = any_is_wrong && !reading.parameters.is_set(argument.name) && !argument.is_required;
            const std::string what = follows ? "" : problem.what();
            complaints.add(reading.parameters.where(argument.name),
                           what.empty() ? "" : "<" + argument.name + "> of <" + said.name + ">: " + what);
            any_is_wrong = true;
          }
  }



  void
  Subsystems::give_argument(Scope            &scope,
                            const Outline    &said,
                            const Reading    &reading,
                            const std::size_t i,
                            Complaints       &complaints)
  {
    const PartArgument &argument = reading.wanted[i];
    const std::string   where = reading.parameters.where(argument.name), word = argument.word();
    const bool          is_given = reading.parameters.is_set(argument.name);
    // who says none of a choice chooses that; of anything else there is none then, whatever the default
    const auto *const said_of_it = said.entry(argument.name);
    const bool        is_chosen  = std::count(argument.choices.begin(), argument.choices.end(), nothing) > 0;
    const bool        is_refused = said_of_it != nullptr && trim(said_of_it->value) == nothing;
    const std::string text       = is_refused ? nothing : is_given ? reading.given[i] : argument.standard;
    const bool        is_there   = text == nothing ? is_chosen : is_given || !argument.is_required;
    const std::string place      = is_given ? where : argument.where;
    BothReaders       readers{*scope.own, scope.quantities, complaints};
    readers.set_number("has_" + word, is_there ? 1 : 0, "1", where);
    if (!is_there && argument.is_required)
      throw std::invalid_argument("it must be given: " + argument.documentation());
    if (argument.kind == "law")
      {
        scope.laws.push_back({word, is_there ? text : "0", argument.unit, place, is_given});
        readers.set_text(word, "${" + word + "}"); // until laws are read
      }
    else if (!is_there)
      {
        if (argument.kind.find("number") != std::string::npos && argument.kind != "numbers")
          readers.set_number(word, 0, argument.unit, where);
        readers.set_text(word, nothing); // an entry that is this is not given
      }
    else if (argument.kind == "place")
      give_place(scope, argument, text);
    else if (!is_given && text.rfind(same_as, 0) == 0)
      give_same(scope, argument, text.substr(same_as.size()), complaints);
    else
      give_value(argument,
                 is_given ? text : scope.own->with_texts(text),
                 place,
                 is_given ? scope.around->quantities : *scope.own,
                 readers);
  }



  void
  Subsystems::give_same(Scope              &scope,
                        const PartArgument &argument,
                        const std::string  &default_text,
                        Complaints         &complaints) const
  {
    const auto        otherwise = default_text.find(same_else);
    const std::string place = default_text.substr(0, otherwise), word = argument.word(),
                      prefix = scope.own->texts[word_of(place) + "_scope"];
    BothReaders readers{*scope.own, scope.quantities, complaints};
    const auto  other = std::find_if(all.begin(), all.end(), [&](const Scope &s) { return s.prefix == prefix; });
    if (other != all.end() && other->is_faulty)
      throw FollowUp();
    if (!prefix.empty() && other != all.end() && other->own)
      {
        const Quantities &there = *other->own;
        if (const auto text = there.texts.find(word); text != there.texts.end() && text->second != "none")
          return readers.set_text(word, text->second);
        const auto words = there.known_words();
        if (std::find(words.begin(), words.end(), word) != words.end() && there.texts.count(word) == 0)
          return readers.set_number(word, there.number(word, argument.unit), argument.unit, argument.where);
        if (there.texts.count(word) > 0 && argument.kind == "text")
          return readers.set_text(word, "none");
      }
    if (otherwise == std::string::npos)
      throw std::invalid_argument("it must be given, as <" + place + "> does not tell it: " + argument.documentation());
    give_value(argument, default_text.substr(otherwise + same_else.size()), argument.where, *scope.own, readers);
  }



  void
  Subsystems::give_place(Scope &scope, const PartArgument &argument, const std::string &text) const
  {
    const auto        dot  = text.find('.');
    const std::string name = trim(text.substr(0, dot)), rest = dot == std::string::npos ? "" : text.substr(dot);
    std::string       full = text, prefix;
    for (const Scope *s = scope.around; s != nullptr && full == text; s = s->around)
      {
        if (const auto mount = mounts.find(s->prefix + name); mount != mounts.end())
          {
            full   = subsystem_separator + mount->second + rest;
            prefix = s->prefix + name + subsystem_separator;
            break;
          }
        const auto colon = name.rfind(subsystem_separator);
        const auto inner = colon == std::string::npos ? "" : name.substr(0, colon + 1);
        for (const auto &other : all)
          if (const Outline *const bodies = other.outline->section("Bodies");
              other.prefix == s->prefix + inner && bodies != nullptr &&
              bodies->section(colon == std::string::npos ? name : name.substr(colon + 1)) != nullptr)
            {
              full   = subsystem_separator + s->prefix + text;
              prefix = other.prefix;
            }
      }
    Complaints  none;
    BothReaders readers{*scope.own, scope.quantities, none};
    readers.set_text(argument.word(), full);
    readers.set_text(argument.word() + "_scope", prefix);
  }



  void
  Subsystems::read_constants(Scope                          &scope,
                             const std::vector<std::string> &arguments,
                             const std::string              &where,
                             Complaints                     &complaints) const
  {
    std::map<std::string, std::string> given;
    for (const auto &argument : arguments)
      {
        const auto equal = argument.find('=');
        if (equal == std::string::npos || trim(argument.substr(equal + 1)).empty())
          complaints.add(where, "an argument is written <name = value>, not <" + argument + ">");
        else if (!given.emplace(trim(argument.substr(0, equal)), trim(argument.substr(equal + 1))).second)
          complaints.add(where, "the argument <" + trim(argument.substr(0, equal)) + "> is given twice");
      }
    Quantities &own = scope.own ? *scope.own : scope.quantities;
    BothReaders readers{own, scope.quantities, complaints};
    const auto  set =
      [&](const std::string &name, const std::string &text, const std::string &place, const Quantities &reader) {
        if (scope.own)
          readers.set(name, text, place, reader);
        else
          scope.quantities.add_constant(name, text, place, reader, complaints);
      };
    std::vector<std::string> names;
    if (const Outline *const constants = scope.outline->section("Constants"); constants != nullptr)
      for (const auto &entry : constants->entries)
        {
          names.push_back(entry.name);
          const bool is_own = entry.where.substr(0, entry.where.rfind(':')) == scope.own_file;
          if (const auto argument = given.find(entry.name); argument != given.end())
            {
              set(entry.name, argument->second, where, scope.around->quantities);
              given.erase(argument);
            }
          else
            set(entry.name, entry.value, entry.where, is_own ? own : scope.quantities);
        }
    if (const Outline *const functions = scope.outline->section("Functions"); functions != nullptr)
      for (const auto &entry : functions->entries)
        {
          scope.quantities.add_function(entry.name, entry.value, entry.where, complaints);
          if (scope.own)
            own.add_function(entry.name, entry.value, entry.where, complaints);
        }
    for (const auto &[name, value] : given)
      complaints.add(where,
                     "subsystem <" + scope.outline->name + "> has no constant <" + name +
                       "> in its subsection <Constants>" + did_you_mean(name, names));
  }



  void
  Subsystems::read_laws(Complaints &complaints)
  {
    // those around come first, of which a part in a part may hand its own on
    for (auto &scope : all)
      for (const auto &argument : scope.laws)
        try
          {
            const Quantities &reader              = argument.is_given ? scope.around->quantities : scope.quantities;
            const std::string text                = reader.with_texts(argument.text);
            const Law         law                 = reader.law(with_tables_beside(text, argument.where), argument.unit);
            scope.quantities.texts[argument.word] = in_parentheses(law.text());
          }
        catch (const std::invalid_argument &problem)
          {
            // a default matters where the part uses it
            scope.quantities.texts[argument.word] = argument.is_given ? "0" : fault_of_text + problem.what();
            if (argument.is_given)
              complaints.add(argument.where, problem.what());
          }
  }



  namespace
  {
    /** Not those that are read with other texts, or that say what texts are. */
    bool
    has_texts_of_its_own(const Outline &section)
    {
      return section.name != "Subsystems" && section.name != "Arguments" && section.name != "Constants" &&
             section.name != "Functions";
    }

    bool
    has_text(const Outline &outline)
    {
      return std::any_of(outline.entries.begin(),
                         outline.entries.end(),
                         [](const auto &entry) { return entry.value.find("${") != std::string::npos; }) ||
             std::any_of(outline.sections.begin(), outline.sections.end(), [](const Outline &inner) {
               return has_texts_of_its_own(inner) && has_text(inner);
             });
    }
  } // namespace



  void
  Subsystems::put_texts(Outline &outline, const Quantities &quantities, Complaints &complaints)
  {
    constexpr unsigned int deepest_text = 8; // of texts in texts
    for (auto &entry : outline.entries)
      if (entry.value.find("${") != std::string::npos)
        try
          {
            std::string before;
            for (unsigned int depth = 0; depth < deepest_text && before != entry.value; ++depth)
              {
                before      = entry.value;
                entry.value = quantities.with_texts(before);
              }
          }
        catch (const std::invalid_argument &problem)
          {
            complaints.add(entry.where, problem.what());
          }
    for (auto &inner : outline.sections)
      if (has_texts_of_its_own(inner))
        put_texts(inner, quantities, complaints);
  }



  bool
  Subsystems::is_active(const Scope &scope, const Group &group, const Outline &said, Complaints &complaints)
  {
    const Outline::Entry *entry   = said.entry("Active");
    const Outline *const  section = all.front().outline->section(group.subsection);
    const Outline *const  change =
      scope.prefix.empty() || section == nullptr ? nullptr : section->section(scope.prefix + said.name);
    if (change != nullptr && change->entry("Active") != nullptr)
      entry = change->entry("Active");
    if (entry == nullptr)
      return true;
    try
      {
        if (Value<bool>::read(entry->value, "1", scope.quantities))
          return true;
        inactive[scope.prefix + said.name] = entry->where;
        return false;
      }
    catch (const std::invalid_argument &problem)
      {
        const std::string what = problem.what();
        complaints.add(entry->where, what.empty() ? "" : "<Active> of <" + scope.prefix + said.name + ">: " + what);
        return true;
      }
  }



  void
  Subsystems::rewrite(Complaints &complaints)
  {
    for (auto &scope : all)
      {
        if (scope.is_faulty)
          {
            for (const auto &group : catalogue.groups)
              if (const Outline *const section = scope.outline->section(group.subsection))
                for (const auto &said : section->sections)
                  unmade.insert(scope.prefix + said.name);
            rewritten.emplace_back();
            rewritten.back().name = scope.outline->name;
            scope.outline         = &rewritten.back();
            continue;
          }
        const bool any_text = has_text(*scope.outline);
        if (any_text)
          {
            rewritten.push_back(*scope.outline);
            put_texts(rewritten.back(), scope.quantities, complaints);
            scope.outline = &rewritten.back();
          }
        std::map<std::string, std::set<std::string>> left_out;
        for (const auto &group : catalogue.groups)
          if (const Outline *const section = scope.outline->section(group.subsection))
            for (const auto &said : section->sections)
              if (!is_active(scope, group, said, complaints))
                left_out[group.subsection].insert(said.name);
        if (left_out.empty())
          continue;
        if (!any_text)
          {
            rewritten.push_back(*scope.outline);
            scope.outline = &rewritten.back();
          }
        for (auto &section : rewritten.back().sections)
          if (const auto found = left_out.find(section.name); found != left_out.end())
            section.sections.erase(std::remove_if(section.sections.begin(),
                                                  section.sections.end(),
                                                  [&](const Outline &said) {
                                                    return found->second.count(said.name) > 0;
                                                  }),
                                   section.sections.end());
      }
  }
} // namespace samara
