#include <samara/base/parameters.h>
#include <samara/base/pattern_in_words.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <unordered_map>

namespace samara
{
  namespace
  {
    using dealii::ExcMessage;

    /** What stands in the last brackets; "1" if nothing does. */
    std::string
    unit_of(const std::string &documentation)
    {
      const auto open  = documentation.rfind('[');
      const auto close = documentation.rfind(']');
      if (open == std::string::npos || close == std::string::npos || close < open)
        return "1";
      const std::string unit = trim(documentation.substr(open + 1, close - open - 1));
      return unit == "-" ? "1" : unit;
    }

    /** The value of an entry that is not given, although it stands there. */
    const std::string taken_back = "none";

    /** Whether all of some numbers are zero; false of any other text. */
    bool
    is_zero_vector(const std::string &text)
    {
      const auto parts = split_top_level(text, ',');
      return !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const std::string &part) {
        double number = 1;
        return text_to_number(trim(part), number) && number == 0;
      });
    }

    /** Whether an angle [rad] looks like one in degrees: beyond a quarter of a turn, and no multiple of 15 degrees,
     * which is meant: 3.14159. */
    bool
    looks_like_degrees(const double angle)
    {
      constexpr double largest = M_PI / 2, round_part = M_PI / 12, round_off = 1e-3;
      return std::isfinite(angle) && std::abs(angle) > largest * (1 + round_off) &&
             std::abs(std::remainder(angle, round_part)) > round_off;
    }

    /** The same of the values of a table, which end its rows; what rows begin with is no angle. */
    double
    angle_like_degrees_in_table(const std::string &rows)
    {
      for (std::string row : split_top_level(rows, ';'))
        {
          row                = trim(row);
          const auto before  = row.find_last_of(" ,\t");
          double     angle   = 0;
          const bool has_two = before != std::string::npos;
          if (has_two && text_to_number(row.substr(before + 1), angle) && looks_like_degrees(angle))
            return angle;
        }
      return 0;
    }

    /**
     * The first angle in a text, without unit and so in radians, that looks like one in degrees; 0 if there is none. Of
     * a function that names nothing but s or t it is what it begins with.
     */
    double
    angle_like_degrees(const std::string &text)
    {
      const std::string table = "table:";
      if (trim(text).compare(0, table.size(), table) == 0)
        return angle_like_degrees_in_table(trim(text).substr(table.size()));
      for (const auto &row : split_top_level(text, ';'))
        for (const auto &element : split_top_level(row, ','))
          {
            double angle = 0;
            if (!text_to_number(trim(element), angle))
              try
                {
                  angle              = 0; // not what a text with units begins with
                  const bool is_of_s = element.find('s') != std::string::npos;
                  if (element.find('(') == std::string::npos && element.find('"') == std::string::npos)
                    angle = ScalarFunction(trim(element), is_of_s ? "s" : "t")(0.);
                }
              catch (const std::invalid_argument &)
                {} // it has units, or names
            if (looks_like_degrees(angle))
              return angle;
          }
      return 0;
    }

    /** A bar would end the cell of a table. */
    std::string
    cell(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += (c == '|' ? "\\|" : std::string(1, c));
      return result;
    }
  } // namespace



  Parameters::Parameters(const std::string &name, const std::string &kind)
    : name(name)
    , kind(kind)
  {}



  const Parameters::Declaration &
  Parameters::declaration_of(const Wanted &wanted)
  {
    static std::mutex                                   mutex;
    static std::unordered_map<std::string, Declaration> all;

    const std::string key = wanted.name + '\n' + wanted.documentation + '\n' + wanted.identity +
                            (wanted.has_unit ? "\nunit\n" : "\n") + wanted.standard;
    const std::lock_guard<std::mutex> guard(mutex);
    if (const auto known = all.find(key); known != all.end())
      return known->second;
    Declaration result{wanted.name,
                       wanted.documentation,
                       wanted.has_unit ? unit_of(wanted.documentation) : "",
                       wanted.standard,
                       wanted.pattern(),
                       wanted.read,
                       wanted.place};
    AssertThrow(!wanted.has_unit || Quantities::is_si_unit(result.unit),
                ExcMessage("The documentation of the entry <" + result.name + "> declares [" + result.unit +
                           "], which is not an SI unit."));
    AssertThrow(result.pattern->match(result.standard),
                ExcMessage("The default <" + result.standard + "> of the entry <" + result.name +
                           "> is not accepted by its pattern."));
    return all.emplace(key, std::move(result)).first->second;
  }



  void
  Parameters::declare(void *const variable, const Wanted &wanted)
  {
    for (const auto &other : entries)
      AssertThrow(other.name() != wanted.name, ExcMessage("The entry <" + wanted.name + "> is added twice."));
    entries.push_back({&declaration_of(wanted), variable});
  }



  void
  Parameters::Entry::assign(const std::string &value)
  {
    if (!said)
      said = std::make_unique<Said>(Said{value, "", false});
    said->value = value;
  }



  void
  Parameters::take_unit(const std::string &wanted, const std::function<std::string(const Quantities &)> &unit)
  {
    units_when_read.emplace_back(existing(wanted).declaration, unit);
  }



  std::string
  Parameters::unit_when_read(const Entry &entry, const Quantities &quantities) const
  {
    for (const auto &[declaration, unit] : units_when_read)
      if (declaration == entry.declaration)
        return unit(quantities);
    return entry.declaration->unit;
  }



  void
  Parameters::add_file(const std::string &wanted, std::string &variable, const std::string &documentation)
  {
    static const std::function<std::unique_ptr<Pattern>()> pattern = [] { return Value<std::string>::pattern(); };
    // what is printed holds wherever it is read; of several files each, where there is none of the whole name
    const Read read = [](const std::string &text, const Quantities &, const Entry &self, const std::string &) {
      // "file:line"; "--set" has no folder
      const std::string        beside = self.said->where.substr(0, self.said->where.rfind(':'));
      std::error_code          ignored;
      std::vector<std::string> files(1, text), printed;
      if (text.empty() || !std::filesystem::exists(file_beside(beside, text), ignored))
        files = split_top_level(text, ',');
      for (auto &file : files)
        {
          file                = file_beside(beside, file);
          const auto absolute = std::filesystem::absolute(file, ignored);
          printed.push_back(ignored ? file : absolute.string());
        }
      *static_cast<std::string *>(self.variable) = join(files, ", ");
      return join(printed, ", ");
    };
    declare(variable, {wanted, documentation, false, "file", pattern, "", read});
  }



  void
  Parameters::turns(const std::string &wanted, const Turning turning)
  {
    existing(wanted).turning = turning;
  }



  void
  Parameters::be_placed(const Placement &placement)
  {
    for (auto &entry : entries)
      {
        const auto place = entry.declaration->place;
        if (place == nullptr || entry.turning == Turning::own_axes)
          continue;
        if (entry.turning == Turning::unknown)
          throw std::invalid_argument(description() + " cannot be turned: nobody knows how its <" + entry.name() +
                                      "> turns");
        if (entry.turning == Turning::given_position && !entry.is_read())
          continue;
        const std::string placed = place(entry, placement, entry.turning != Turning::direction);
        if (placed != entry.value())
          entry.assign(placed);
      }
    for (const auto &s : subsections)
      s->be_placed(placement);
  }



  Parameters &
  Parameters::subsection(const std::string &wanted)
  {
    for (const auto &s : subsections)
      if (s->step == wanted)
        return *s;
    auto nested  = std::make_unique<Parameters>(name.empty() ? wanted : name + "/" + wanted, kind);
    nested->step = wanted;
    subsections.push_back(std::move(nested));
    return *subsections.back();
  }



  void
  Parameters::ignore_subsection(const std::string &wanted)
  {
    ignored.push_back(wanted);
  }



  void
  Parameters::parse(const Outline &section, const Quantities &quantities, Complaints &complaints)
  {
    const auto *const type = section.entry("Type");
    parse(section, quantities, complaints, type != nullptr && type->inherited);
  }



  void
  Parameters::parse(const Outline    &section,
                    const Quantities &quantities,
                    Complaints       &all_complaints,
                    const bool        is_copy)
  {
    set_place(section.where);
    Complaints of_original;
    for (const auto &given : section.entries)
      {
        Complaints &complaints = is_copy && given.inherited ? of_original : all_complaints;
        const auto  mine =
          std::find_if(entries.begin(), entries.end(), [&](const Entry &e) { return e.name() == given.name; });
        if (mine != entries.end())
          read_entry(*mine, given, quantities, complaints);
        else if (given.name != "Type" && given.name != "Copy of" && given.name != "Active")
          complain_about_entry(given, complaints);
      }
    for (const auto &given : section.sections)
      {
        const auto mine =
          std::find_if(subsections.begin(), subsections.end(), [&](const auto &s) { return s->step == given.name; });
        if (mine != subsections.end())
          (*mine)->parse(given, quantities, all_complaints, is_copy);
        else if (is_copy && given.inherited)
          continue;
        else if (std::find(ignored.begin(), ignored.end(), given.name) == ignored.end())
          complain_about_subsection(given, all_complaints);
      }
    if (!of_original.empty())
      all_complaints.add("", ""); // a copy is as wrong as its original
  }



  void
  Parameters::read_entry(Entry                &entry,
                         const Outline::Entry &given,
                         const Quantities     &quantities,
                         Complaints           &complaints)
  {
    if (trim(given.value) == taken_back)
      {
        const auto choices = choices_of(*entry.declaration->pattern);
        if (std::find(choices.begin(), choices.end(), taken_back) == choices.end())
          return; // as if nothing had been said of it, by this file or one that is included
      }
    const bool was_zero = is_zero_vector(entry.value());
    entry.said          = std::make_unique<Said>(Said{entry.value(), given.where, true});
    try
      {
        // what is printed holds wherever it is read
        const bool is_number = !entry.declaration->unit.empty();
        // where nothing is chosen if nothing is said, a direction is needed
        const bool is_needed = entry.turning == Turning::direction && !was_zero;
        entry.said->value =
          entry.declaration->read(is_number ? with_tables_beside(given.value, given.where) : given.value,
                                  quantities,
                                  entry,
                                  unit_when_read(entry, quantities));
        if (is_needed && is_zero_vector(entry.value()))
          throw std::invalid_argument("a direction must not be zero");
        const std::string unit = unit_when_read(entry, quantities);
        if (is_number && (unit == "rad" || unit == "(rad)"))
          if (const double angle = angle_like_degrees(given.value); angle != 0)
            complaints.doubt(given.where,
                             "<" + entry.name() + "> has no unit, and is in radians: " + number_to_text("%.6g", angle) +
                               " rad are " + number_to_text("%.5g", angle * 180 / M_PI) + " degrees. Write <" +
                               number_to_text("%.6g", angle) + " deg>, or <" + number_to_text("%.6g", angle) +
                               " rad> if that is meant");
      }
    catch (const FollowUp &)
      {
        complaints.add("", "");
      }
    catch (const std::invalid_argument &e)
      {
        complaints.add(given.where,
                       "<" + entry.name() + ">" + (name.empty() ? "" : " of " + description()) + ": " + e.what());
      }
  }



  void
  Parameters::check_pattern(const std::string &users_text, const std::string &si_text, const Entry &entry)
  {
    const Declaration &declaration = *entry.declaration;
    if (declaration.pattern->match(si_text))
      return;
    const auto choices = choices_of(*declaration.pattern);
    if (!choices.empty())
      throw std::invalid_argument("<" + users_text + "> is not a choice" + did_you_mean(users_text, choices));
    const bool is_plain = declaration.unit.empty() || declaration.unit == "1";
    throw std::invalid_argument("<" + users_text + "> is not accepted: wanted is " + in_words(*declaration.pattern) +
                                (is_plain ? "" : ", in [" + declaration.unit + "]") + ".");
  }



  void
  Parameters::complain_about_entry(const Outline::Entry &given, Complaints &complaints) const
  {
    std::vector<std::string> names;
    for (const auto &e : entries)
      names.push_back(e.name());
    complaints.add(given.where,
                   "<" + given.name + "> is not a parameter " + (name.empty() ? "here" : "of " + description()) +
                     did_you_mean(given.name, names));
  }



  void
  Parameters::complain_about_subsection(const Outline &given, Complaints &complaints) const
  {
    std::vector<std::string> names = ignored;
    for (const auto &s : subsections)
      names.push_back(s->step);
    complaints.add(given.where,
                   "<" + given.name + "> is not a subsection " + (name.empty() ? "here" : "of " + description()) +
                     did_you_mean(given.name, names));
  }



  void
  Parameters::set_place(const std::string &where)
  {
    place = where;
    entries.shrink_to_fit(); // none is added any more, and there are as many tables as objects
    for (const auto &s : subsections)
      s->set_place(where);
  }



  bool
  Parameters::has(const std::string &wanted) const
  {
    return std::any_of(entries.begin(), entries.end(), [&](const Entry &e) { return e.name() == wanted; });
  }



  bool
  Parameters::is_set(const std::string &wanted) const
  {
    return existing(wanted).is_read();
  }



  std::string
  Parameters::where(const std::string &wanted) const
  {
    const auto &entry = existing(wanted);
    return entry.is_read() ? entry.said->where : place;
  }



  const std::string &
  Parameters::where() const
  {
    return place;
  }



  bool
  Parameters::require(const std::string &wanted, Complaints &complaints) const
  {
    const bool is_given = is_set(wanted) && !existing(wanted).value().empty();
    if (!is_given)
      complaints.add(where(wanted),
                     (name.empty() ? "" : description() + ": ") + "<" + wanted +
                       "> must be given: " + existing(wanted).declaration->documentation);
    return is_given;
  }



  void
  Parameters::print(std::ostream &out, const std::string &indent) const
  {
    for (const auto &e : entries)
      out << indent << (e.said ? "set " : "# set ") << e.name() << " = " << e.value() << '\n';
    for (const auto &s : subsections)
      {
        out << indent << "subsection " << s->step << '\n';
        s->print(out, indent + "  ");
        out << indent << "end\n";
      }
  }



  void
  Parameters::document(std::ostream &out) const
  {
    out << "| entry | default | unit | meaning |\n|---|---|---|---|\n";
    document_rows("", out);
  }



  void
  Parameters::document_rows(const std::string &prefix, std::ostream &out) const
  {
    for (const auto &e : entries)
      {
        const Declaration &declaration = *e.declaration;
        const auto         choices     = choices_of(*declaration.pattern);
        out << "| " << cell(prefix + e.name()) << " | " << cell(e.value()) << " | "
            << (declaration.unit == "1" ? "" : cell(declaration.unit)) << " | " << cell(declaration.documentation)
            << (choices.empty() ? "" : " One of: " + cell(join(choices, ", ")) + ".") << " |\n";
      }
    for (const auto &s : subsections)
      s->document_rows(prefix + s->step + " / ", out);
  }



  const Parameters::Entry &
  Parameters::existing(const std::string &wanted) const
  {
    const auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry &e) { return e.name() == wanted; });
    AssertThrow(entry != entries.end(), ExcMessage("There is no entry <" + wanted + "> in " + description() + "."));
    return *entry;
  }



  Parameters::Entry &
  Parameters::existing(const std::string &wanted)
  {
    return const_cast<Entry &>(static_cast<const Parameters &>(*this).existing(wanted));
  }



  std::string
  Parameters::description() const
  {
    return "<" + name + ">" + (kind.empty() ? "" : " (" + kind + ")");
  }

} // namespace samara
