#include <samara/model/virtual_mass.h>
#include <samara/time/integrators.h>

#include <algorithm>
#include <stdexcept>

namespace samara
{
  namespace
  {
    bool
    has_virtual_mass(const System &system)
    {
      const auto of_nodes = virtual_mass(system.model);
      return std::any_of(of_nodes.begin(), of_nodes.end(), [](const Matrix6 &of_node) { return !of_node.isZero(0.); });
    }
  } // namespace



  std::string
  Integrators::that_know(bool IntegratorAbilities::*ability) const
  {
    std::vector<std::string> able;
    for (const auto &name : kinds.kinds())
      if (kinds.make(name)->abilities.*ability)
        able.push_back("<" + name + ">");
    return able.empty() ? "none does" : join(able, ", ") + (able.size() == 1 ? " does" : " do");
  }



  std::unique_ptr<Integrator>
  Integrators::make(const std::string &name, const System &system, const IntegratorSettings &settings) const
  {
    const auto kind = kinds.make(name);
    if (!kind->abilities.states && system.layout.n_states > 0)
      throw std::invalid_argument("the integrator <" + name + "> knows no states of first order; " +
                                  that_know(&IntegratorAbilities::states));
    if (!kind->abilities.virtual_mass && has_virtual_mass(system))
      throw std::invalid_argument("the integrator <" + name + "> knows no virtual mass of the air; " +
                                  that_know(&IntegratorAbilities::virtual_mass));
    if (!kind->abilities.is_family && !system.layout.contact_groups.empty())
      throw std::invalid_argument("the integrator <" + name + "> knows no contacts in groups; " +
                                  that_know(&IntegratorAbilities::is_family));
    if (!kind->abilities.friction && !system.layout.frictions.empty())
      throw std::invalid_argument("the integrator <" + name + "> knows no dry friction; " +
                                  that_know(&IntegratorAbilities::friction));
    return kind->make(system, settings);
  }



  IntegratorAbilities
  Integrators::abilities_of(const std::string &name) const
  {
    return kinds.make(name)->abilities;
  }



  std::string
  Integrators::what_they_are() const
  {
    std::vector<std::string> sentences;
    for (const auto &name : kinds.kinds())
      sentences.push_back(name + ": " + kinds.what_it_is(name));
    return join(sentences, "; ");
  }
} // namespace samara
