#ifndef samara_tests_rivals_h
#define samara_tests_rivals_h

#include <samara/input/catalogue.h>

namespace samara
{
  /** Names of all integrators of the catalogue but those of the family. */
  inline std::vector<std::string>
  rival_names()
  {
    const auto               integrators = Catalogue().integrators;
    std::vector<std::string> names;
    for (const auto &name : integrators->names())
      if (!integrators->abilities_of(name).is_family)
        names.push_back(name);
    return names;
  }

  inline std::unique_ptr<Integrator>
  make_rival(const std::string &name, const System &system, const IntegratorSettings &settings)
  {
    return Catalogue().integrators->make(name, system, settings);
  }
} // namespace samara

#endif
