#include <samara/base/text.h>
#include <samara/base/threads.h>
#include <samara/cosserat/section.h>
#include <samara/input.h>
#include <samara/section/layup.h>
#include <samara/solvers/linear.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace samara
{
  std::string
  subsection_of_analysis(const std::string &kind)
  {
    std::string name = kind;
    name[0]          = std::toupper(name[0]);
    return name;
  }



  void
  Input::add_parameters(Parameters &prm)
  {
    prm.add("Title", title, "One line that says what the model is.");
    prm.add("Analyses", analysis_names, "What to do, in this order; each starts from the state before: static, modal, dynamic, section.");
    prm.add("Rotor speeds",
            rotor_speeds,
            "Speeds of the first steady rotation for which all analyses are done; others in proportion [rad/s].");
    prm.add("Redundant constraints",
            redundant,
            "No effect any more: redundant constraints need no entry. Models of earlier versions say refuse or drop.",
            dealii::Patterns::Selection("|refuse|drop"));
    prm.add("Linear solver",
            linear_solver,
            "Library that factorises matrices. Automatic: KLU for beams and mechanisms, where it is the fastest; for what "
            "fills more LU with pivots on the diagonal, or MUMPS where these are not accurate.",
            dealii::Patterns::Selection("automatic|KLU|UMFPACK|MUMPS"));
    prm.add("Threads",
            threads,
            "Most threads for loops over elements, used where a body has so many that it helps; 0: one a processor.",
            dealii::Patterns::Integer(0, 1024));
    Parameters &output = prm.subsection("Output");
    output.add("Probes", probes, "Numbers to record: body.point.displacement y, joint.rotation, ...");
    output.add("Pictures", pictures, "Whether to write files for ParaView.");
  }



  namespace
  {
    /**
     * An override may change the kind of an object, a beam into a rigid body: what the file says of it and the new kind
     * does not know is forgotten; what an override says of it is not.
     */
    void
    adapt_to_kinds(const Catalogue &catalogue, Outline &outline)
    {
      const std::string of_override = "--set";
      for (auto &section : outline.sections)
        if (section.name == "Subsystems")
          for (auto &subsystem : section.sections)
            adapt_to_kinds(catalogue, subsystem);
      for (auto &section : outline.sections)
        for (const auto &group : catalogue.groups)
          if (group.subsection == section.name)
            for (auto &object : section.sections)
              {
                const auto *const type = object.entry("Type");
                if (type == nullptr || type->where != of_override || !group.kinds.contains(type->value))
                  continue;
                const auto is_unknown = [&](const Outline &alone, const std::string &name, const std::string &what) {
                  Parameters parameters(object.name);
                  const auto item = group.kinds.make(type->value);
                  item->add_parameters(parameters);
                  Complaints found;
                  parameters.parse(alone, Quantities(), found);
                  return !found.empty() && found.all()[0].find("<" + name + "> is not a " + what + " ") == 0;
                };
                const auto entry_is_unknown = [&](Outline::Entry entry) {
                  if (entry.name == "Type" || entry.where == of_override)
                    return false;
                  entry.where = "";
                  Outline alone;
                  alone.entries = {entry};
                  return is_unknown(alone, entry.name, "parameter");
                };
                const auto section_is_unknown = [&](Outline part) {
                  part.where = "";
                  part.entries.clear();
                  part.sections.clear();
                  Outline alone;
                  alone.sections = {part};
                  return is_unknown(alone, part.name, "subsection");
                };
                auto &entries  = object.entries;
                auto &sections = object.sections;
                entries.erase(std::remove_if(entries.begin(), entries.end(), entry_is_unknown), entries.end());
                sections.erase(std::remove_if(sections.begin(), sections.end(), section_is_unknown), sections.end());
              }
    }



    /** Only an angle that is an unknown counts its turns. */
    void
    use_probed_angles(Model &model, const std::vector<std::string> &probes)
    {
      std::multimap<std::string, std::string> paths;
      for (const auto &probe : probes)
        if (const auto dot = probe.find('.'); dot != std::string::npos)
          paths.emplace(trim(probe.substr(0, dot)), trim(probe.substr(dot + 1)));
      for (unsigned int i = 0; i < model.items.size() && !paths.empty(); ++i)
        {
          Item &c                    = *model.items[i];
          const auto [first, beyond] = paths.equal_range(c.name);
          if (first == beyond || c.is_faulty)
            continue;
          for (const auto &motion : c.rotation_names())
            if (std::any_of(first, beyond, [&](const auto &path) {
                  return path.second == motion || path.second == motion + " rate";
                }))
              c.use_coordinate(model, motion);
        }
    }
  } // namespace



  namespace
  {
    /** Settings of which the file does not speak, so that overrides find them. */
    void
    add_settings(const Catalogue &catalogue, Outline &outline)
    {
      std::vector<std::string> settings = {"Output"};
      for (const auto &kind : catalogue.analyses.kinds())
        settings.push_back(subsection_of_analysis(kind));
      if (outline.section("Subsystems") != nullptr) // overrides change objects of subsystems by their full names
        for (const auto &group : catalogue.groups)
          settings.push_back(group.subsection);
      for (const auto &name : settings)
        if (outline.section(name) == nullptr)
          {
            outline.sections.emplace_back();
            outline.sections.back().name  = name;
            outline.sections.back().where = outline.where;
          }
    }
  } // namespace



  Input::Input(const Catalogue &catalogue, const std::string &file, const std::vector<std::string> &overrides)
    : Input(catalogue, InputFile(file), overrides)
  {}



  Input::Input(const Catalogue &catalogue, InputFile file, const std::vector<std::string> &overrides)
  {
    Outline    &outline    = file.outline;
    Complaints &complaints = file.complaints;
    if (outline.is_broken) // what else is wrong there may be right
      complaints.throw_if_any();
    add_settings(catalogue, outline);
    for (const auto &override : overrides)
      outline.set(override, complaints);
    adapt_to_kinds(catalogue, outline);

    Quantities quantities;
    if (const auto *constants = outline.section("Constants"))
      for (const auto &entry : constants->entries)
        quantities.add_constant(entry.name, entry.value, entry.where, complaints);

    add_parameters(root);
    root.ignore_subsection("Constants");
    for (const auto &group : catalogue.groups)
      root.ignore_subsection(group.subsection);
    for (const auto &kind : catalogue.analyses.kinds())
      root.ignore_subsection(subsection_of_analysis(kind));
    root.ignore_subsection("Subsystems");
    Subsystems subsystems(catalogue, outline, quantities, complaints);
    root.parse(outline, quantities, complaints);
    add_probes_of(subsystems);
    says_redundant = !redundant.empty();
    use_library(library_by_name(linear_solver));
    set_threads(threads);

    for (const auto &group : catalogue.groups)
      for (const auto &scope : subsystems.scopes())
        read_objects(group, scope, subsystems, complaints);
    read_analyses(catalogue, outline, quantities, complaints);
    initialize_objects();
    use_probed_angles(model, probes);
    outlines.clear();
    const auto turns = [](const auto &c) { return c->kind == "steady rotation"; };
    if (!rotor_speeds.empty() && model.unmade.empty() && std::none_of(model.items.begin(), model.items.end(), turns))
      model.complaints.add(root.where("Rotor speeds"),
                           "<Rotor speeds> need a load of type <steady rotation> that says what turns");
    complaints.add_all(model.complaints.all());
    Assert(!complaints.empty() || model.complaints.count() == 0,
           dealii::ExcMessage("something follows from a mistake about which there is no complaint"));
    if (!complaints.empty())
      find_more_mistakes(complaints);
    subsystems.without_twins(complaints).throw_if_any();
    if (model.nodes.size() == 1 && !has_sections_alone())
      throw InputError((outline.section("Bodies") != nullptr ? outline.section("Bodies")->where : outline.where) +
                       ": the model has no body; add one to subsection <Bodies>.");
  }



  namespace
  {
    /**
     * Complain about names that are not known, as initialize() would, for an object that has other mistakes and is not
     * initialized.
     */
    void
    check_references(const Outline &object, Model &model)
    {
      const std::set<std::string> points = {"Body A", "Body B", "At", "Point A", "Point B"},
                                  joints = {"Joint", "Joint A", "Joint B"};
      for (const auto &entry : object.entries)
        try
          {
            if (entry.inherited || entry.value.empty())
              continue;
            if (points.count(entry.name) > 0)
              model.frame(entry.value);
            else if (entry.name == "Body")
              model.find<Body>(entry.value, "body");
            else if (entry.name == "Section")
              model.find<Section>(entry.value, "section");
            else if (entry.name == "Material")
              model.find<Material>(entry.value, "material");
            else if (entry.name == "Layup")
              model.find<Layup>(entry.value, "layup");
            else if (joints.count(entry.name) > 0)
              model.find<Item>(trim(entry.value.substr(0, entry.value.find('.'))), "joint");
          }
        catch (const std::invalid_argument &problem)
          {
            model.complaints.add(entry.where, problem.what());
          }
    }
  } // namespace



  void
  Input::initialize_objects()
  {
    // in the order of the catalogue, so that what is referred to comes before what refers to it
    for (unsigned int i = 0; i < model.items.size(); ++i)
      {
        Item      &item   = *model.items[i];
        const auto before = model.complaints.count();
        model.scope       = scope_of(item.name);
        if (item.is_faulty)
          check_references(*outlines[i], model);
        else
          item.initialize(model);
        item.is_faulty = item.is_faulty || model.complaints.count() != before;
      }
    for (const auto &item : model.items)
      if (!item->is_faulty)
        {
          const auto before = model.complaints.count();
          model.scope       = scope_of(item->name);
          try
            {
              item->find_signals(model);
            }
          catch (const FollowUp &)
            {
              item->is_faulty = true;
            }
          item->is_faulty = item->is_faulty || model.complaints.count() != before;
        }
    model.scope.clear();
  }



  void
  Input::find_more_mistakes(Complaints &complaints)
  {
    const auto is_right     = [](const auto &c) { return !c->is_faulty; };
    const auto first_faulty = std::stable_partition(model.items.begin(), model.items.end(), is_right);
    const std::vector<std::unique_ptr<Item>> faulty(std::make_move_iterator(first_faulty),
                                                    std::make_move_iterator(model.items.end()));
    model.items.erase(first_faulty, model.items.end());
    try
      {
        const Layout layout(model);
      }
    catch (const InputError &error)
      {
        complaints.add_all(error.complaints);
      }
    find_probes(complaints);
  }



  void
  Input::add_probes_of(const Subsystems &subsystems)
  {
    for (const auto &[path, where] : subsystems.probes)
      {
        probes.push_back(path);
        places_of_probes[path] = where;
      }
    if (!subsystems.probes.empty())
      root.subsection("Output").assign("Probes", probes);
  }



  void
  Input::read_objects(const Group             &group,
                      const Subsystems::Scope &scope,
                      Subsystems              &subsystems,
                      Complaints              &complaints)
  {
    const Outline *const section = scope.outline->section(group.subsection);
    if (section == nullptr)
      return;
    for (const auto &entry : section->entries)
      complaints.add(entry.where, "<" + entry.name + "> stands outside of a named " + group.noun);
    for (const auto &said : section->sections)
      if (!scope.prefix.empty() || !subsystems.changes_another(group, said))
        read_object(group, scope, subsystems, subsystems.object(scope, group, said), complaints);
  }



  void
  Input::read_object(const Group             &group,
                     const Subsystems::Scope &scope,
                     const Subsystems        &subsystems,
                     const Outline           &object,
                     Complaints              &complaints)
  {
    const auto *const type = object.entry("Type");
    const std::string kind = type == nullptr ? group.usual_kind : type->value, name = scope.prefix + object.name;
    if ((kind.empty() && object.entry("Copy of") != nullptr) || subsystems.changes_nothing(group, object))
      {
        // there is a complaint about the original, or that there is none; or that there is nothing to change
        model.unmade.insert(name);
        return;
      }
    if (!group.kinds.contains(kind))
      {
        model.unmade.insert(name);
        complaints.add(type != nullptr ? type->where : object.where,
                       kind.empty() ?
                         group.noun + " <" + name + "> has no <Type>" + did_you_mean("", group.kinds.kinds()) :
                         "there is no " + group.noun + " of type <" + kind + ">" +
                           did_you_mean(kind, group.kinds.kinds()));
        return;
      }
    if (object.name.find('.') != std::string::npos)
      complaints.add(object.where, "a name must not contain a dot: it separates a body from its points");
    if (!scope.prefix.empty() && object.name.find(subsystem_separator) != std::string::npos)
      complaints.add(object.where, "a name in a subsystem must not contain a colon: it separates a subsystem from its parts");
    auto item        = group.kinds.make(kind);
    item->name       = name;
    item->kind       = kind;
    item->parameters = Parameters(name, kind);
    item->add_parameters(item->parameters);
    const auto before = complaints.count();
    item->parameters.parse(object, scope.quantities, complaints);
    if (!scope.prefix.empty() && item->acts_on_whole_model())
      complaints.add(object.where,
                     kind + " <" + name + "> acts on the whole model: it stands there, and not in a subsystem");
    if (complaints.count() == before && !scope.placement.is_identity())
      try
        {
          item->be_placed(scope.placement);
        }
      catch (const std::invalid_argument &problem)
        {
          complaints.add(object.where, problem.what());
        }
    item->is_faulty = complaints.count() != before;
    model.items.push_back(std::move(item));
    subsections.push_back(group.subsection);
    outlines.push_back(&object);
  }



  void
  Input::read_analyses(const Catalogue  &catalogue,
                       const Outline    &outline,
                       const Quantities &quantities,
                       Complaints       &complaints)
  {
    // subsections of analyses that are not asked for are checked all the same
    std::map<std::string, std::unique_ptr<Analysis>> all;
    for (const auto &kind : catalogue.analyses.kinds())
      {
        const std::string name     = subsection_of_analysis(kind);
        auto             &analysis = all[kind] = catalogue.analyses.make(kind);
        analysis->parameters                   = Parameters(name, "analysis");
        analysis->add_parameters(analysis->parameters);
        const auto before = complaints.count();
        if (const auto *section = outline.section(name))
          analysis->parameters.parse(*section, quantities, complaints);
        const bool is_asked_for = std::find(analysis_names.begin(), analysis_names.end(), kind) != analysis_names.end();
        if (is_asked_for && complaints.count() == before)
          analysis->check(rotor_speeds, complaints);
      }
    for (const auto &kind : analysis_names)
      if (!catalogue.analyses.contains(kind))
        {
          auto known = catalogue.analyses.kinds();
          known.push_back("study");
          complaints.add(root.where("Analyses"),
                         kind == "study" ? "a <study> stands alone: it names its model, which says what is analysed" :
                                           "there is no analysis <" + kind + ">" + did_you_mean(kind, known));
        }
      else if (all[kind] == nullptr)
        complaints.add(root.where("Analyses"), "the analysis <" + kind + "> is asked for twice");
      else
        analyses.push_back(std::move(all[kind]));
  }



  std::unique_ptr<System>
  Input::assemble()
  {
    try
      {
        return std::make_unique<System>(model);
      }
    catch (const InputError &error)
      {
        Complaints complaints;
        complaints.add_all(error.complaints);
        find_probes(complaints);
        complaints.throw_if_any();
        throw;
      }
  }



  std::vector<Probe>
  Input::make_probes() const
  {
    Complaints complaints;
    auto       result = find_probes(complaints);
    complaints.throw_if_any();
    return result;
  }



  std::vector<Probe>
  Input::find_probes(Complaints &complaints) const
  {
    std::vector<Probe> result;
    for (const auto &path : probes)
      try
        {
          result.push_back(model.probe(path));
        }
      catch (const std::invalid_argument &problem)
        {
          const auto of_subsystem = places_of_probes.find(path);
          complaints.add(of_subsystem != places_of_probes.end() ?
                           of_subsystem->second :
                           const_cast<Parameters &>(root).subsection("Output").where("Probes"),
                         problem.what());
        }
    return result;
  }



  std::string
  Input::used() const
  {
    std::ostringstream text;
    print(text);
    for (const auto &c : model.items)
      if (const auto *const table = dynamic_cast<const TableSection *>(c.get()))
        {
          // as entries, a line each
          text << "subsection Sections\n  subsection " << table->name << '\n';
          unsigned int i = 0;
          for (const auto &line : table->lines_of_file())
            text << "    set line " << ++i << " of the file = " << line << '\n';
          text << "  end\nend\n";
        }
    return text.str();
  }



  void
  Input::print(std::ostream &out) const
  {
    root.print(out);
    for (unsigned int i = 0; i < subsections.size(); ++i)
      {
        const Item &object = *model.items[i];
        if (i == 0 || subsections[i] != subsections[i - 1])
          out << "subsection " << subsections[i] << '\n';
        out << "  subsection " << object.name << "\n    set Type = " << object.kind << '\n';
        object.parameters.print(out, "    ");
        out << "  end\n";
        if (i + 1 == subsections.size() || subsections[i] != subsections[i + 1])
          out << "end\n";
      }
    for (unsigned int i = 0; i < analysis_names.size(); ++i)
      {
        out << "subsection " << subsection_of_analysis(analysis_names[i]) << '\n';
        analyses[i]->parameters.print(out, "  ");
        out << "end\n";
      }
  }
} // namespace samara
