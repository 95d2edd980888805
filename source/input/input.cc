#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/base/threads.h>
#include <samara/cosserat/table_section.h>
#include <samara/input/input.h>
#include <samara/input/named_files.h>
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
  Input::add_parameters(Parameters &prm, const Catalogue &catalogue)
  {
    prm.add("Title", title, "One line that says what the model is.");
    prm.add("Analyses",
            analysis_names,
            "What to do, in this order; each starts from the state before: " + join(catalogue.analyses.kinds(), ", ") +
              ".");
    prm.add(
      "Rotor speeds",
      rotor_speeds,
      "Speeds of the first steady rotation for which all analyses are done, or those before a dynamic one; others in "
      "proportion [rad/s].");
    prm.add("Redundant constraints",
            redundant,
            "No effect any more: redundant constraints need no entry. Models of earlier versions say refuse or drop.",
            dealii::Patterns::Selection("|refuse|drop"));
    prm.add(
      "Linear solver",
      linear_solver,
      "Library that factorises matrices. Automatic: KLU for beams and mechanisms, where it is the fastest; for what "
      "fills more LU with pivots on the diagonal, or MUMPS where these are not accurate.",
      dealii::Patterns::Selection("automatic|KLU|MUMPS"));
    prm.add("Threads",
            threads,
            "Most threads for loops over elements, used where a body has so many that it helps; 0: one a processor.",
            dealii::Patterns::Integer(0, 1024));
    assembly.add_parameters(prm.subsection("Assembly"));
    Parameters &output = prm.subsection("Output");
    output.add("Probes", probes, "Numbers to record: body.point.displacement y, joint.rotation, ...");
    output.add("Pictures", pictures, "Whether to write files for ParaView.");
    output.add("Report",
               report,
               "Whether to write report.html, one page for a browser with the drawing, the motion, the modes, all tables and "
               "the messages.");
    output.add("Report pictures",
               report_pictures,
               "How many pictures of a motion the page has, besides the one at the start; fewer of large models.",
               dealii::Patterns::Integer(1, 10000));
    output.add("Report fields",
               report_fields,
               "What of fields the page has: all components; sizes, of a vector one number, without arrows; automatic: all "
               "components, of large models sizes, and fewer fields where these are still too many.",
               dealii::Patterns::Selection("automatic|all|sizes"));
    output.add("Watch",
               watch,
               "Whether to write the page again and again while the model runs, so that a browser follows it; also --watch.");
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
      std::vector<std::string> settings = {"Output", "Assembly"};
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
    : Input(catalogue, std::move(file), overrides, Gaps::refused)
  {}



  Input::Input(const Catalogue &catalogue, InputFile file, const std::vector<std::string> &overrides, const Gaps gaps)
  {
    Outline    &outline    = file.outline;
    Complaints &complaints = file.complaints;
    if (outline.is_broken) // what else is wrong there may be right
      complaints.throw_if_any();
    add_settings(catalogue, outline);
    for (const auto &override : overrides)
      outline.set(override, complaints);
    expand_parts(outline, complaints);
    adapt_to_kinds(catalogue, outline);

    Quantities quantities;
    if (const auto *constants = outline.section("Constants"))
      for (const auto &entry : constants->entries)
        quantities.add_constant(entry.name, entry.value, entry.where, complaints);
    if (const auto *functions = outline.section("Functions"))
      for (const auto &entry : functions->entries)
        quantities.add_function(entry.name, entry.value, entry.where, complaints);
    Subsystems::put_texts(outline, quantities, complaints);

    add_parameters(root, catalogue);
    root.ignore_subsection("Constants");
    root.ignore_subsection("Functions");
    for (const auto &group : catalogue.groups)
      root.ignore_subsection(group.subsection);
    for (const auto &kind : catalogue.analyses.kinds())
      root.ignore_subsection(subsection_of_analysis(kind));
    root.ignore_subsection("Subsystems");
    Subsystems subsystems(catalogue, outline, quantities, complaints);
    root.parse(outline, quantities, complaints);
    add_probes_of(subsystems);
    model.inactive = subsystems.inactive;
    model.unmade.insert(subsystems.unmade.begin(), subsystems.unmade.end());
    model.mounts   = subsystems.mounts;
    says_redundant = !redundant.empty();

    for (const auto &group : catalogue.groups)
      for (const auto &scope : subsystems.scopes())
        read_objects(group, scope, subsystems, complaints);
    read_analyses(catalogue, outline, quantities, complaints);
    assemble_drawing(catalogue, file, gaps);
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
    doubts = complaints.doubts();
    if (model.nodes.size() == 1 && !is_without_bodies())
      throw InputError((outline.section("Bodies") != nullptr ? outline.section("Bodies")->where : outline.where) +
                       ": the model has no body; add one to subsection <Bodies>.");
  }



  void
  Input::use_settings() const
  {
    use_library(library_by_name(linear_solver));
    set_threads(threads);
  }



  void
  Input::read_analyses(const Catalogue  &catalogue,
                       const Outline    &outline,
                       const Quantities &quantities,
                       Complaints       &complaints)
  {
    // subsections of analyses that are not asked for are checked all the same
    std::map<std::string, std::unique_ptr<Analysis>> all;
    std::set<const Analysis *>                       faultless;
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
          faultless.insert(analysis.get());
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
    for (unsigned int i = 0; i < analyses.size(); ++i)
      if (faultless.count(analyses[i].get()) > 0)
        analyses[i]->check(i < n_swept(analyses) ? rotor_speeds : std::vector<double>(), complaints);
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



  std::shared_ptr<const std::string>
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
          for (const auto &line : table->lines_of_files())
            text << "    set line " << ++i << " of the file = " << line << '\n';
          text << "  end\nend\n";
        }
    // of all files that entries name, whether they are the same
    std::istringstream entries(text.str());
    for (std::string line; std::getline(entries, line);)
      if (const auto equal = line.find(" = ");
          equal != std::string::npos && line.find_first_of("/\"", equal) < line.npos)
        for (const auto &name : files_named_in(line.substr(equal + 3), ""))
          text << "set Contents of " << name << " = " << fingerprint_of(text_of_file(name)) << '\n';
    return std::make_shared<const std::string>(text.str());
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
