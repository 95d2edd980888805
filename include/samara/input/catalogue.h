#ifndef samara_input_catalogue_h
#define samara_input_catalogue_h

#include <samara/analysis/analysis.h>
#include <samara/base/registry.h>
#include <samara/model/item.h>
#include <samara/time/integrators.h>

namespace samara
{
  /** Items of one subsection of the input file ("Bodies") with all kinds that can be named there. */
  struct Group
  {
    std::string    subsection, noun;
    Registry<Item> kinds;
    std::string    usual_kind = ""; ///< of items that do not say their type; empty: they must
  };

  /** Every kind of everything that can be named in a .prm file, in the order in which a model is built. */
  struct Catalogue
  {
    Catalogue();

    std::vector<Group> groups;

    /** Shared with the analyses, which know what is added later, too. */
    std::shared_ptr<Integrators> integrators;
    Registry<Analysis>           analyses;
  };
} // namespace samara

#endif
