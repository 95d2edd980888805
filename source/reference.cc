#include <samara/base/text.h>
#include <samara/input.h>
#include <samara/program.h>

namespace samara
{
  namespace
  {
    template <typename Interface>
    void
    print_kinds(std::ostream &out, const Registry<Interface> &kinds, const std::string &about, unsigned int &n_printed)
    {
      for (const auto &kind : kinds.kinds())
        if (about.empty() || about == kind)
          {
            auto       object = kinds.make(kind);
            Parameters parameters(kind, kind);
            object->add_parameters(parameters);
            out << "### " << kind << "\n\n" << kinds.what_it_is(kind) << ".\n\n";
            parameters.document(out);
            out << '\n';
            ++n_printed;
          }
    }
  } // namespace



  void
  print_reference(std::ostream &out, const std::string &about)
  {
    const Catalogue catalogue;
    unsigned int    n_printed = 0;
    if (about.empty())
      {
        Input      *input = nullptr;
        (void)input;
      }
    for (const auto &group : catalogue.groups)
      {
        if (about.empty())
          out << "## " << group.subsection << "\n\nEach " << group.noun << " is a subsection of its name in `subsection "
              << group.subsection << "`, with `set Type = ...`:\n\n";
        print_kinds(out, group.kinds, about, n_printed);
      }
    if (about.empty())
      out << "## Analyses\n\nThe entries of an analysis are in a subsection of its name, `subsection Static`:\n\n";
    print_kinds(out, catalogue.analyses, about, n_printed);
    if (n_printed == 0)
      {
        std::vector<std::string> all = catalogue.analyses.kinds();
        for (const auto &group : catalogue.groups)
          for (const auto &kind : group.kinds.kinds())
            all.push_back(kind);
        throw InputError("there is no kind <" + about + ">" + did_you_mean(about, all));
      }
  }
} // namespace samara
