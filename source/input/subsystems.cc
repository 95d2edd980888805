#include <samara/base/text.h>
#include <samara/input/subsystems.h>
#include <samara/model/model.h>
#include <samara/model/output_name.h>
#include <samara/rotation/rotation.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  SubsystemEntries::add_parameters(Parameters &prm)
  {
    prm.add("Position", position, "Where the origin of the subsystem is, in the axes of what is around it [m].");
    prm.add("Rotation", rotation, "How its axes are turned: three angles in the sequence below [rad].");
    prm.add("Rotation sequence", sequence, "Axes of the three rotations, each about the axis turned by those before.");
    prm.add(
      "Copies",
      copies,
      "How many there are, and how each is turned from the one before, about an axis of what is around: 4 about z; "
      "3 about 0 0 1 through 0.1 0 0 by 30 deg. Not given: one, as it is placed.");
    prm.add(
      "Part",
      part,
      "A file of parts whose content the subsystem has, rotor/hub: one in the folder of the model, or one that comes "
      "with the program. Its arguments are entries beside this one; samara --part rotor/hub tells them.");
    prm.add("Active", active, "Whether it is there: an expression of constants, n > 0; if not, all in it is left out.");
    prm.add("Arguments",
            arguments,
            "Values of constants of the subsystem, in place of its own: azimuth = 90 deg, length = 2*L.");
  }



  namespace
  {
    constexpr std::size_t  most_scopes = 10'000;
    constexpr unsigned int most_nested = 20;

    /** "4 about z through 1 0 0 by 30 deg" */
    struct CopiesAbout
    {
      unsigned int    n    = 1;
      Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), through = Eigen::Vector3d::Zero();
      double          angle = 0; ///< from one to the next [rad]

      CopiesAbout(const std::string &text, const Quantities &quantities)
      {
        if (text.empty())
          return;
        std::string rest = text;
        const auto  take = [&](const std::string &word) {
          const auto at = (" " + rest + " ").rfind(" " + word + " ");
          if (at == std::string::npos)
            return std::string();
          const std::string behind = trim(rest.substr(std::min(rest.size(), at + word.size())));
          rest                     = trim(rest.substr(0, at));
          if (behind.empty())
            throw std::invalid_argument("<" + text + ">: <" + word + "> says nothing");
          return behind;
        };
        const std::string by = take("by"), point = take("through"), about = take("about");
        const double      number = Value<double>::read(rest, "1", quantities);
        if (!(number >= 1 && number <= most_scopes) || number != std::floor(number))
          throw std::invalid_argument("<" + rest + "> copies: a whole number from 1 to " + std::to_string(most_scopes) +
                                      " is wanted, as in <4 about z>");
        n = static_cast<unsigned int>(number);
        if (about.empty())
          throw std::invalid_argument("<" + text + "> does not say about which axis copies are turned: <4 about z>");
        axis = about == "x" ? Eigen::Vector3d::UnitX() :
               about == "y" ? Eigen::Vector3d::UnitY() :
               about == "z" ? Eigen::Vector3d::UnitZ() :
                              vector(about, "1", quantities);
        if (axis.isZero(0.))
          throw std::invalid_argument("the axis of copies must not be zero");
        through = point.empty() ? through : vector(point, "m", quantities);
        angle   = by.empty() ? 2 * M_PI / n : Value<double>::read(by, "rad", quantities);
      }

      /** "x y z" or "x, y, z" */
      static Eigen::Vector3d
      vector(const std::string &text, const std::string &unit, const Quantities &quantities)
      {
        std::string with_commas = text;
        if (text.find(',') == std::string::npos)
          std::replace(with_commas.begin(), with_commas.end(), ' ', ',');
        return Value<Eigen::Vector3d>::read(with_commas, unit, quantities);
      }

      /** Of copy @p k, from 0, seen from what is around. */
      Placement
      placement(const unsigned int k) const
      {
        const Eigen::Matrix3d R = Placement::turn(axis, k * angle);
        return {R, through - R * through};
      }
    };



    /** The subsections of a subsystem that describe objects, and "Constants", ... */
    std::vector<std::string>
    known_subsections(const Catalogue &catalogue)
    {
      std::vector<std::string> names = {"Constants", "Functions", "Subsystems", "Output", "Arguments", "Part"};
      for (const auto &group : catalogue.groups)
        names.push_back(group.subsection);
      return names;
    }
  } // namespace



  Subsystems::Subsystems(const Catalogue  &catalogue,
                         const Outline    &model,
                         const Quantities &quantities,
                         Complaints       &complaints)
    : catalogue(catalogue)
  {
    all.push_back({"", &model, {}, quantities, nullptr, "", false});
    expand(all.front(), complaints);
    add_signals(complaints);
    read_laws(complaints);
    rewrite(complaints);
    for (const auto &scope : all)
      for (const auto &group : catalogue.groups)
        if (const auto *const section = scope.outline->section(group.subsection); section && !scope.prefix.empty())
          for (const auto &object : section->sections)
            objects.emplace(Key{group.subsection, scope.prefix + object.name}, &object);
    check_changes(complaints);
    for (const auto &scope : all)
      if (!scope.prefix.empty())
        add_probes(scope, complaints);
  }



  void
  Subsystems::expand(const Scope &around, Complaints &complaints)
  {
    const Outline *const section = around.outline->section("Subsystems");
    if (section == nullptr)
      return;
    for (const auto &entry : section->entries)
      complaints.add(entry.where, "<" + entry.name + "> stands outside of a named subsystem");
    for (const auto &said : section->sections)
      make_copies(around, said, complaints);
  }



  namespace
  {
    /** A copy of a subsystem has mistakes of its own where its arguments differ. */
    Outline
    with_own_mistakes(Outline said)
    {
      for (auto &entry : said.entries)
        entry.inherited = false;
      return said;
    }
  } // namespace



  void
  Subsystems::make_copies(const Scope &around, const Outline &said, Complaints &complaints)
  {
    if (said.name.find_first_of(".:") != std::string::npos)
      complaints.add(said.where,
                     "a subsystem's name must not contain a dot or a colon: they separate it from its parts");
    for (const Scope *outer = &around; outer != nullptr && !outer->prefix.empty(); outer = outer->around)
      if (outer->outline->name == said.name)
        return complaints.add(said.where, "<" + said.name + "> stands in a subsystem of the same name");
    if (std::count(around.prefix.begin(), around.prefix.end(), subsystem_separator) >= most_nested)
      return complaints.add(said.where,
                            "subsystems stand in each other more than " + std::to_string(most_nested) + " deep");
    Reading reading;
    read(reading, around, said, complaints);
    std::string where = "Active";
    try
      {
        if (!Value<bool>::read(reading.entries.active, "1", around.quantities))
          {
            inactive[around.prefix + said.name + subsystem_separator] = reading.parameters.where("Active");
            return;
          }
        where = "Copies";
        const CopiesAbout copies(reading.entries.copies, around.quantities);
        where          = "Rotation sequence";
        reading.placed = {Placement::without_round_off(
                            rotation_of_angles(reading.entries.rotation, reading.entries.sequence)),
                          reading.entries.position};
        find_first(reading, around, said);
        for (unsigned int k = 0; k < copies.n; ++k)
          if (!make_copy(reading, around, said, copies.placement(k), k, copies.n, complaints))
            return;
      }
    catch (const std::invalid_argument &problem)
      {
        complaints.add(reading.parameters.where(where), problem.what());
      }
  }



  void
  Subsystems::read(Reading &reading, const Scope &around, const Outline &said, Complaints &complaints) const
  {
    Parameters &parameters = reading.parameters;
    auto       &wanted     = reading.wanted;
    parameters = Parameters(around.prefix + said.name, said.entry("Part") != nullptr ? "part" : "subsystem");
    reading.entries.add_parameters(parameters);
    if (const Outline *const section = said.section("Arguments"); section != nullptr)
      wanted = arguments_of(*section, complaints);
    reading.given.resize(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (parameters.has(wanted[i].name))
        complaints.add(wanted[i].where, "<" + wanted[i].name + "> is an entry of all subsystems: choose another name");
      else
        parameters.add(wanted[i].name, reading.given[i], wanted[i].documentation());
    for (const auto &name : known_subsections(catalogue))
      parameters.ignore_subsection(name);
    reading.before = complaints.count();
    Outline own    = with_own_mistakes(said);
    own.sections.clear();
    put_texts(own, around.quantities, complaints);
    own.sections = said.sections;
    parameters.parse(own, around.quantities, complaints);
  }



  void
  Subsystems::find_first(Reading &reading, const Scope &around, const Outline &said) const
  {
    const std::string end      = reading.entries.copies.empty() ? ":" : " 1:";
    reading.first              = around.twin.empty() ? "" : around.twin + said.name + end;
    const auto *const original = said.entry("Copy of");
    for (const std::string ends : {":", " 1:"})
      if (reading.first.empty() && original != nullptr && prefixes.count(around.prefix + original->value + ends) > 0)
        reading.first = around.prefix + original->value + ends;
  }



  bool
  Subsystems::make_copy(Reading           &reading,
                        const Scope       &around,
                        const Outline     &said,
                        const Placement   &of_copy,
                        const unsigned int k,
                        const unsigned int n,
                        Complaints        &complaints)
  {
    const bool        has_copies = !reading.entries.copies.empty();
    const std::string name       = around.prefix + said.name,
                      prefix     = name + (has_copies ? " " + std::to_string(k + 1) : "") + subsystem_separator;
    if (!prefixes.insert(prefix).second)
      {
        complaints.add(said.where, "there is already a subsystem <" + prefix.substr(0, prefix.size() - 1) + ">");
        return false;
      }
    if (all.size() > most_scopes)
      {
        complaints.add(said.where, "there are more than " + std::to_string(most_scopes) + " subsystems");
        return false;
      }
    if (reading.first.empty() && k > 0)
      reading.first = name + " 1:";
    all.push_back({prefix,
                   &said,
                   around.placement.of(of_copy.of(reading.placed)),
                   around.quantities,
                   &around,
                   reading.first,
                   around.is_copy || said.entry("Copy of") != nullptr});
    Scope &scope = all.back();
    scope.quantities.begin_subsystem();
    if (const Outline *const part = said.section("Part"); part != nullptr && part->entry("Mount") != nullptr)
      mounts[prefix.substr(0, prefix.size() - 1)] = prefix + part->value("Mount");
    if (said.section("Arguments") != nullptr)
      {
        give_arguments(scope, said, reading, k, n, complaints);
        scope.is_faulty = complaints.count() != reading.before;
        if (scope.is_faulty)
          return true;
      }
    else if (has_copies)
      scope.quantities.add_constant("copy", std::to_string(k + 1), said.where, complaints);
    read_constants(scope, reading.entries.arguments, reading.parameters.where("Arguments"), complaints);
    expand(scope, complaints);
    return true;
  }



  namespace
  {
    /** What laws may name of an object of the subsection States, with units. */
    std::vector<std::pair<std::string, std::string>>
    signals_of_state(const Outline &state)
    {
      std::vector<std::pair<std::string, std::string>> signals;
      // several outputs have numbers; what goes in is looked up by a name that is no word
      const std::string unit      = state.value("Unit");
      const auto        n_outputs = split_top_level(state.value("C"), ';').size();
      for (std::size_t i = 1; i <= n_outputs && n_outputs > 1; ++i)
        signals.emplace_back(state.name + "_" + std::to_string(i), unit);
      if (n_outputs <= 1)
        signals.emplace_back(state.name, unit);
      signals.emplace_back(state.name + " input", state.value("Signal unit"));
      return signals;
    }
  } // namespace



  void
  Subsystems::add_signals(Complaints &complaints)
  {
    SignalNames names;
    const auto  for_each = [&](const Scope &scope, const auto &add_object, const auto &add_state) {
      for (const std::string group : {"Bodies", "Joints"})
        if (const auto *const section = scope.outline->section(group))
          for (const auto &object : section->sections)
            add_object(object.name);
      if (const auto *const section = scope.outline->section("States"))
        for (const auto &object : section->sections)
          add_state(object);
    };
    for (const auto &scope : all)
      for_each(
        scope,
        [&](const std::string &name) { names.add_object(scope.prefix + name); },
        [&](const Outline &state) {
          const bool        is_in_subsystem = state.name.find(subsystem_separator) != std::string::npos;
          const std::string fault           = is_in_subsystem ? "" : scope.quantities.fault_of_state(state.name);
          if (fault.empty())
            for (const auto &[name, unit] : signals_of_state(state))
              names.add_state(scope.prefix + name, unit);
          else
            complaints.add(state.where, "state <" + scope.prefix + state.name + ">: " + fault);
        });
    if (all.size() == 1)
      {
        all.front().quantities.signals = std::move(names);
        return;
      }
    const auto shared = std::make_shared<const SignalNames>(std::move(names));
    for (auto &scope : all)
      {
        scope.quantities.signals           = SignalNames(shared);
        scope.quantities.signals.placement = scope.placement;
        std::vector<const Scope *> outermost_first;
        for (const Scope *s = &scope; s != nullptr && !s->prefix.empty(); s = s->around)
          outermost_first.insert(outermost_first.begin(), s);
        for (const Scope *const s : outermost_first)
          for_each(
            *s,
            [&](const std::string &name) { scope.quantities.signals.add_short_object(name, s->prefix + name); },
            [&](const Outline &state) {
              if (s->quantities.fault_of_state(state.name).empty())
                for (const auto &[name, unit] : signals_of_state(state))
                  scope.quantities.signals.add_short_state(name, s->prefix + name);
            });
      }
  }



  void
  Subsystems::add_probes(const Scope &scope, Complaints &complaints)
  {
    const Outline *const output = scope.outline->section("Output");
    if (output == nullptr)
      return;
    std::vector<std::string> paths;
    Parameters               parameters(scope.prefix + "Output", "subsystem");
    parameters.add("Probes", paths, "Numbers to record.");
    parameters.parse(*output, scope.quantities, complaints);
    for (const auto &path : paths)
      {
        const std::string name = trim(path.substr(0, path.find('.')));
        // an output of several, "pilot_2", is named by its object
        std::string owner, number;
        const bool  is_output = path.find('.') == std::string::npos && split_number(name, owner, number);
        const auto  has       = [&](const std::string &object) {
          return std::any_of(catalogue.groups.begin(), catalogue.groups.end(), [&](const Group &group) {
            return objects.count({group.subsection, object}) > 0;
          });
        };
        std::string full = path;
        for (const Scope *s = &scope; !s->prefix.empty() && full == path; s = s->around)
          if (has(s->prefix + name) || (is_output && has(s->prefix + owner)))
            full = s->prefix + path;
        probes.emplace_back(full, parameters.where("Probes"));
      }
  }



  bool
  Subsystems::changes_another(const Group &group, const Outline &said) const
  {
    const auto end = said.name.find(subsystem_separator);
    if (objects.count({group.subsection, said.name}) > 0 || end == std::string::npos)
      return objects.count({group.subsection, said.name}) > 0;
    return inactive.count(said.name) > 0 || inactive.count(said.name.substr(0, end + 1)) > 0;
  }



  bool
  Subsystems::changes_nothing(const Group &group, const Outline &said) const
  {
    return said.name.find(subsystem_separator) != std::string::npos && said.entry("Type") == nullptr &&
           said.entry("Copy of") == nullptr && !changes_another(group, said);
  }



  const Outline &
  Subsystems::object(const Scope &scope, const Group &group, const Outline &said)
  {
    const Outline *const section = all.front().outline->section(group.subsection);
    const Outline *const change =
      scope.prefix.empty() || section == nullptr ? nullptr : section->section(scope.prefix + said.name);
    if (change == nullptr && !scope.is_copy)
      return said;
    changed.push_back(said);
    Outline &result = changed.back();
    // the subsystem is copied with all that is in it, which is read with other arguments
    const auto read_all = [](Outline &outline, const auto &self) -> void {
      for (auto &entry : outline.entries)
        entry.inherited = false;
      for (auto &inner : outline.sections)
        {
          inner.inherited = false;
          self(inner, self);
        }
    };
    if (scope.is_copy)
      read_all(result, read_all);
    if (change != nullptr)
      result.merge(*change);
    return result;
  }



  void
  Subsystems::check_changes(Complaints &complaints) const
  {
    for (const auto &group : catalogue.groups)
      if (const auto *const section = all.front().outline->section(group.subsection))
        for (const auto &said : section->sections)
          {
            if (!changes_nothing(group, said))
              continue;
            std::vector<std::string> names;
            for (const auto &[key, object] : objects)
              if (key.first == group.subsection)
                names.push_back(key.second);
            complaints.add(said.where,
                           "there is no " + group.noun + " <" + said.name + "> in a subsystem that this could change" +
                             did_you_mean(said.name, names));
          }
  }



  Complaints
  Subsystems::without_twins(const Complaints &complaints) const
  {
    std::set<std::string>    known;
    std::vector<std::string> kept;
    for (const auto &complaint : complaints.all())
      {
        std::string of_first = complaint;
        // the innermost come last, and have the longest names
        for (auto scope = all.rbegin(); scope != all.rend(); ++scope)
          if (!scope->twin.empty())
            for (std::size_t at = 0; (at = of_first.find(scope->prefix, at)) != std::string::npos;
                 at += scope->twin.size())
              of_first.replace(at, scope->prefix.size(), scope->twin);
        if (known.insert(of_first).second)
          kept.push_back(complaint);
      }
    Complaints result;
    result.add_all(kept);
    result.note_inclusions_of(complaints);
    return result;
  }

} // namespace samara
