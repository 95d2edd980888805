#include <samara/base/text.h>
#include <samara/input/input.h>
#include <samara/study/study.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    constexpr std::size_t most_members = 10'000;
  }



  void
  StudyMethod::add_parameters(Parameters &prm)
  {
    prm.add("Overrides",
            overrides,
            "What this one has different from the model: Dynamic/Stages = 3; Dynamic/Step = 1e-3.");
    prm.add("Vary",
            vary,
            "The entry that goes through the values, as after --set; several with ; between them go together. Default: "
            "that of the study.");
    prm.add("Values",
            values,
            "Its values with commas between them, towards the finest; lists of several entries with ; between them.");
    prm.add("Model", model, "Another model than that of the study; relative to this file.");
  }



  bool
  Study::is_study(const Outline &outline)
  {
    return outline.value("Analyses") == "study";
  }



  void
  Study::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Quantity",
            quantity_text,
            "What is compared: static: PROBE, dynamic: PROBE, energy: COLUMN of the budget, modal: frequency 1.");
    prm.add("Norm",
            norm,
            "Of a quantity that is recorded over time or load: its final value, the largest, or the root of the mean "
            "square.",
            Selection("final|largest|RMS"));
    prm.add("Error", error_kind, "Relative to the reference, or absolute.", Selection("relative|absolute"));
    prm.add(
      "Reference",
      reference,
      "What it is compared with: a number; file.csv, or file.csv: COLUMN, relative to this file; or finest: the last "
      "value of the first method, or of the last level, or the run of the next entry.");
    prm.add("Reference overrides",
            reference_overrides,
            "A run beside the members that they are compared with: what it has different from the model.");
    prm.add("Overrides", overrides, "What all members have different from the model, with ; between them.");
    prm.add("Vary", vary, "The entry that goes through the values, where a method does not name its own.");
    prm.add("Values", values, "Its values, where a method has none of its own.");
    prm.add(
      "Tolerance",
      tolerance,
      "The error that is good enough: the study says which level meets it at the least cost, and what it costs on "
      "each; 0: it does not [1].",
      Double(0));
    prm.add("Cost",
            cost,
            "What a member costs: time of the processor, or a number that no machine changes.",
            Selection("time|unknowns|steps|iterations"));
    prm.add("Time limit", time_limit, "After which a member is given up; 0: never [s].", Double(0));
  }



  Study::Study(const std::string &name, InputFile input)
    : file(name)
    , settings("Study", "study")
  {
    const Outline &outline    = input.outline;
    Complaints    &complaints = input.complaints;
    if (outline.is_broken)
      complaints.throw_if_any();
    const Quantities quantities;
    std::string      analyses;
    root.add("Title", title, "One line that says what the study is.");
    root.add("Model", model, "The input file that is studied; relative to this file.");
    root.add("Analyses", analyses, "study");
    for (const auto *const name : {"Study", "Methods", "Levels"})
      root.ignore_subsection(name);
    root.parse(outline, quantities, complaints);
    add_parameters(settings);
    if (const auto *const section = outline.section("Study"))
      settings.parse(*section, quantities, complaints);
    else
      complaints.add(root.where("Analyses"), "a study needs a subsection <Study> with a <Quantity>");
    if (outline.section("Study") != nullptr && settings.require("Quantity", complaints))
      try
        {
          quantity = StudyQuantity(quantity_text);
        }
      catch (const std::invalid_argument &problem)
        {
          complaints.add(settings.where("Quantity"), std::string("<Quantity>: ") + problem.what());
        }
    read_methods(outline, complaints);
    for (unsigned int i = 0; i < methods.size(); ++i)
      make_members(*methods[i], i, complaints);
    add_reference(complaints);
    if (members.size() > most_members)
      complaints.add(settings.where("Values"),
                     "these are " + std::to_string(members.size()) + " members; a study has at most " +
                       std::to_string(most_members));
    complaints.throw_if_any();
    name_folders();
    check_members(complaints);
    complaints.throw_if_any();
  }



  void
  Study::read_methods(const Outline &outline, Complaints &complaints)
  {
    for (const std::string group : {"Methods", "Levels"})
      if (const auto *const section = outline.section(group))
        {
          for (const auto &entry : section->entries)
            complaints.add(entry.where, "<" + entry.name + "> stands outside of a named subsection of <" + group + ">");
          for (const auto &object : section->sections)
            {
              auto method        = std::make_unique<StudyMethod>();
              method->name       = object.name;
              method->where      = object.where;
              method->parameters = Parameters(object.name, group == "Levels" ? "level" : "method");
              method->add_parameters(method->parameters);
              method->parameters.parse(object, Quantities(), complaints);
              methods.push_back(std::move(method));
            }
          is_ladder = is_ladder || group == "Levels";
        }
    if (methods.empty())
      {
        methods.push_back(std::make_unique<StudyMethod>());
        methods[0]->name = "model";
        methods[0]->add_parameters(methods[0]->parameters);
      }
    if (is_ladder && tolerance == 0)
      complaints.add(settings.where("Tolerance"), "a study of <Levels> needs a <Tolerance> that a level can meet");
  }
} // namespace samara
