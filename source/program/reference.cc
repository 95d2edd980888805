#include <samara/base/text.h>
#include <samara/base/tokens.h>
#include <samara/base/units.h>
#include <samara/input/input.h>
#include <samara/input/parts.h>
#include <samara/input/subsystems.h>
#include <samara/program/entry_tables.h>
#include <samara/program/program.h>
#include <samara/study/study.h>

#include <cctype>
#include <map>

namespace samara
{
  namespace
  {
    const char *const language = R"(# Input reference

Written by `samara --parameters`; `samara --help beam` prints one kind. What the words mean: [notation](notation.md).

## The language

    # a comment
    set Title = two words, or more          # entries
    subsection Bodies                       # subsections, which can be nested
      subsection shaft 1                    # names may have blanks, but no dots
        set Type   = beam
        set Points = 0, 0, 0; 6 ft, 0, 0    # a vector is a list with commas; several vectors are separated by ;
      end
      subsection shaft 2
        set Copy of = shaft 1               # all that is not set here is as in shaft 1, nested subsections too
        set Points  = 6 ft, 0, 0; \
                      12 ft, 0, 0           # a backslash continues a line
      end
    end
    include sections.prm                    # relative to the file that includes

In one file a subsection is opened once and an entry set once. Several files may open the same subsection; a file may set
again what a file included before has set. On the command line, `--set "Bodies/shaft 1/Degree = 4"` has the last word.

A body is called by its name, a point of it by `shaft 1.end`, a motion of a joint by `hinge.rotation`; `ground` is the
inertial frame. What nobody knows is refused, with the nearest word that is known; mistakes are reported together.

### Numbers

A number may have a unit, `6.0 ft`, and be an expression, `2*L + 3 in`, of the constants of the model:

    subsection Constants
      set L  = 6 m
      set EI = 2e4 N*m^2                    # later ones may use earlier ones
    end

- A number without a unit is in the SI unit of the tables below; zero is zero in every unit. Dimensions are checked.
- A blank multiplies, like `*`: `1/2 m` is half a metre. `(1, 2, 3) ft` is a vector in feet.
- An angle is a number, `rad` is 1. `deg`, `rev` and `rpm` convert. `Hz` is refused where rad/s are wanted: write `rev/s`.
- `lb` is a mass, and a force where only a force fits; `lbf` is always a force.
- A function of time is an expression of `t` in seconds, such as `10*(1 - cos(2*pi*t)) N` or `t < 1 ? 0 : 5`, or a table,
  linear between its points and constant beyond them: `table: 0 0; 1 5; 2 5`. Other functions are expressions of `s`.

)";



    void
    print_language(std::ostream &out)
    {
      out << language << "| dimension | units |\n|---|---|\n";
      std::vector<std::string>           dimensions;
      std::map<std::string, std::string> names;
      for (const auto &unit : units())
        {
          const std::string dimension = describe(unit.quantity.dimension);
          if (names[dimension].empty())
            dimensions.push_back(dimension);
          names[dimension] += (names[dimension].empty() ? "" : ", ") + unit.name;
        }
      for (const auto &dimension : dimensions)
        out << "| " << dimension << " | " << names[dimension] << " |\n";

      std::vector<std::string> constants;
      for (const auto &constant : universal_constants())
        constants.push_back(constant.name);
      out << "\nConstants: " << join(constants, ", ") << ". Functions: " << join(function_names(), ", ")
          << ". Operators: + - * / ^, < <= > >= == !=, && ||, and a ? b : c.\n\n";
    }



    /** A comment with a sketch as Markdown: what is indented keeps its lines. */
    std::string
    paragraphs_of(const std::string &head)
    {
      return head.empty() || head.back() != '\n' ? head + '\n' : head;
    }



    void
    print_model(std::ostream &out, const Catalogue &catalogue)
    {
      Input      input;
      Parameters parameters;
      input.add_parameters(parameters, catalogue);
      out << "## The model\n\nOutside of all named objects:\n\n";
      print_rows(out, rows_of(parameters));
      out << '\n';
    }



    /** Heading of a kind, and what it is. */
    template <typename Interface>
    void
    print_head(std::ostream &out, const Registry<Interface> &kinds, const std::string &kind)
    {
      std::string what = kinds.what_it_is(kind);
      what[0]          = std::toupper(what[0]);
      out << "### " << kind << "\n\n" << what << ".\n\n";
    }



    template <typename Interface>
    std::vector<EntryRow>
    rows_of_kind(const Registry<Interface> &kinds, const std::string &kind)
    {
      const auto object = kinds.make(kind);
      Parameters parameters(kind, kind);
      object->add_parameters(parameters);
      return rows_of(parameters);
    }



    template <typename Interface>
    void
    print_kind(std::ostream &out, const Registry<Interface> &kinds, const std::string &kind)
    {
      print_head(out, kinds, kind);
      print_rows(out, rows_of_kind(kinds, kind));
      out << '\n';
    }



    /** All kinds of a group; with @p once what several have stands before them, once. */
    template <typename Interface>
    void
    print_kinds_of(std::ostream &out, const Registry<Interface> &kinds, const std::string &noun, const bool once)
    {
      EntryTables tables(noun);
      for (const auto &kind : kinds.kinds())
        tables.add(kind, rows_of_kind(kinds, kind));
      if (once)
        tables.print_shared(out);
      for (const auto &kind : kinds.kinds())
        if (once)
          {
            print_head(out, kinds, kind);
            tables.print(out, kind);
          }
        else
          print_kind(out, kinds, kind);
    }



    void
    print_subsystems(std::ostream &out)
    {
      SubsystemEntries entries;
      Parameters       parameters;
      entries.add_parameters(parameters);
      out
        << "## Subsystems\n\nEach is a subsection with a name of its own in `subsection Subsystems`, with subsections "
           "`Constants`, `Sections`, `Bodies`, ... as a model has them, often from a file that is included there. Its "
           "objects are called `name:object`; see the [manual](manual.md#subsystems).\n\n";
      print_rows(out, rows_of(parameters));
      out << '\n';
    }



    void
    print_study(std::ostream &out)
    {
      Study       study;
      StudyMethod method;
      Parameters  settings, of_method;
      study.add_parameters(settings);
      method.add_parameters(of_method);
      out
        << "## Studies\n\nA file with `set Analyses = study` has no model of its own but names one, `set Model = FILE`, and "
           "`subsection Study`:\n\n";
      print_rows(out, rows_of(settings));
      out
        << "\nIn `subsection Methods`, or `subsection Levels` from the cheapest to the dearest, each is a subsection with a "
           "name of its own:\n\n";
      print_rows(out, rows_of(of_method));
      out << '\n';
    }



    /** The arguments of a part as entries. */
    std::vector<EntryRow>
    rows_of_part(const std::string &file)
    {
      Complaints            complaints;
      const auto            content = Outline::of_file(file, complaints);
      std::vector<EntryRow> rows;
      if (const Outline *const section = content.section("Arguments"); section != nullptr)
        for (const auto &argument : arguments_of(*section, complaints))
          rows.push_back({argument.name,
                          argument.is_required        ? required :
                          argument.standard == "none" ? "" :
                                                        argument.standard,
                          argument.unit == "1" ? "" : argument.unit,
                          without_unit(argument.documentation())});
      complaints.throw_if_any();
      return rows;
    }



    /** A part: its head, a sketch in it, and its arguments. */
    void
    print_arguments(std::ostream &out, const std::string &name, const std::string &file)
    {
      const auto rows = rows_of_part(file);
      out << "### " << name << "\n\n" << paragraphs_of(head_of_file(file)) << "\n";
      if (rows.empty())
        out << "It has no arguments.\n";
      else
        print_rows(out, rows);
      out << '\n';
    }



    void
    print_parts(std::ostream &out, const bool once)
    {
      out
        << "## Parts\n\n`set Part = rotor/hub` in a subsystem names one of these, or a file of your own; its arguments are "
           "entries beside it. See the [manual](manual.md#parts).\n\n";
      const auto  file = [](const std::string &name) { return folder_of_parts() + "/" + name + ".prm"; };
      EntryTables tables("part");
      for (const auto &name : shipped_parts())
        tables.add(name, rows_of_part(file(name)));
      if (once)
        tables.print_shared(out);
      for (const auto &name : shipped_parts())
        if (once)
          {
            out << "### " << name << "\n\n" << paragraphs_of(head_of_file(file(name))) << "\n";
            tables.print(out, name);
          }
        else
          print_arguments(out, name, file(name));
    }



    /** Subsections that are no named objects, and what is told of each. */
    const std::vector<std::pair<std::string, std::string>> settings = {
      {"Constants",
       "### Constants\n\n`set L = 6 m`: numbers with units that all entries may use; later ones may use earlier ones. A text in "
       "quotes, `set profile = \"naca0012.c81\"`, stands in place of `${profile}`. See `samara --help language`.\n"},
      {"Functions",
       "### Functions\n\n`set way = t < 0 ? 0 m : 3 mm/s*t`: functions of time with names, usable wherever `t` may stand. They "
       "may use constants and functions before them.\n"}};



    /** The entries of a subsection of the model that is no named object, "Output"; whether there is one. */
    bool
    print_subsection(std::ostream &out, const Catalogue &catalogue, const std::string &about)
    {
      for (const auto &[name, text] : settings)
        if (name == about)
          {
            out << text;
            return true;
          }
      if (about == "language")
        print_language(out);
      else if (about == "Subsystems")
        print_subsystems(out);
      else if (about == "Study" || about == "Methods" || about == "Levels")
        print_study(out);
      else if (about == "model")
        print_model(out, catalogue);
      else if (about == "Output" || about == "Assembly")
        {
          Input      input;
          Parameters parameters;
          input.add_parameters(parameters, catalogue);
          out << "### " << about << "\n\n";
          print_rows(out, rows_of(parameters.subsection(about)));
        }
      else
        return false;
      return true;
    }



    /** The name of a group, "Bodies", tells its kinds. */
    bool
    print_group(std::ostream &out, const Catalogue &catalogue, const std::string &about)
    {
      for (const auto &group : catalogue.groups)
        if (group.subsection == about)
          {
            out << "### " << about << "\n\nEach " << group.noun
                << " is a subsection with a name of its own. `set Type = ` one of:\n\n";
            for (const auto &kind : group.kinds.kinds())
              out << "- " << kind << ": " << group.kinds.what_it_is(kind) << '\n';
            out << "\n`samara --help KIND` tells the entries of one.\n";
            return true;
          }
      return false;
    }



    void
    print_everything(std::ostream &out, const Catalogue &catalogue, const bool once)
    {
      print_language(out);
      print_model(out, catalogue);
      for (const auto &group : catalogue.groups)
        {
          out << "## " << group.subsection << "\n\nEach " << group.noun << " is a subsection with a name of its own in "
              << "`subsection " << group.subsection << "`, with `set Type = ` one of the following.\n\n";
          print_kinds_of(out, group.kinds, group.noun, once);
        }
      print_subsystems(out);
      print_parts(out, once);
      out
        << "## Analyses\n\n`set Analyses = static, modal` says what to do, in this order. The entries of each stand in "
           "`subsection Static`, `subsection Modal`, ...\n\n";
      print_kinds_of(out, catalogue.analyses, "analysis", once);
      print_study(out);
    }
  } // namespace



  void
  print_reference(std::ostream &out, const std::string &about)
  {
    const Catalogue catalogue;
    if (about.empty() || about == "everything")
      return print_everything(out, catalogue, about.empty());

    if (catalogue.analyses.contains(about))
      return print_kind(out, catalogue.analyses, about);
    if (print_subsection(out, catalogue, about) || print_group(out, catalogue, about))
      return;
    std::vector<std::string> known = catalogue.analyses.kinds();
    for (const auto &kind : catalogue.analyses.kinds())
      {
        if (subsection_of_analysis(kind) == about)
          return print_kind(out, catalogue.analyses, kind);
        known.push_back(subsection_of_analysis(kind));
      }
    for (const auto &part : shipped_parts())
      {
        if (part == about)
          return print_part(out, part);
        known.push_back(part);
      }
    for (const std::string topic :
         {"language", "everything", "model", "Constants", "Functions", "Subsystems", "Output", "Assembly", "Study"})
      known.push_back(topic);
    for (const auto &group : catalogue.groups)
      {
        if (group.kinds.contains(about))
          return print_kind(out, group.kinds, about);
        known.push_back(group.subsection);
        for (const auto &kind : group.kinds.kinds())
          known.push_back(kind);
      }
    throw InputError("there is no kind <" + about + ">" + did_you_mean(about, known) + " All kinds: samara --kinds");
  }



  void
  print_kinds(std::ostream &out)
  {
    const Catalogue catalogue;
    const auto      line = [&](const std::string &head, const std::vector<std::string> &names) {
      constexpr std::size_t width = 100, indent = 14;
      std::string           text  = head + std::string(indent - std::min(indent, head.size()), ' ');
      std::size_t           begin = 0; // of the present line
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          const std::string word = names[i] + (i + 1 < names.size() ? ", " : "");
          if (text.size() - begin + word.size() > width)
            {
              text += '\n';
              begin = text.size();
              text += std::string(indent, ' ');
            }
          text += word;
        }
      out << text << '\n';
    };
    for (const auto &group : catalogue.groups)
      line(group.subsection, group.kinds.kinds());
    line("Analyses", catalogue.analyses.kinds());
    line("Integrators", catalogue.integrators->names());
    line("Parts", shipped_parts());
    line("Subsections", {"Constants", "Functions", "Subsystems", "Output", "Assembly", "Study"});
    out << "samara --help KIND tells the entries of one, samara --help Bodies what each is.\n";
  }



  void
  print_part(std::ostream &out, const std::string &name)
  {
    try
      {
        print_arguments(out, name, file_of_part(name, ""));
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(problem.what());
      }
  }
} // namespace samara
