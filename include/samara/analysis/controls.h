#ifndef samara_analysis_controls_h
#define samara_analysis_controls_h

#include <samara/base/errors.h>
#include <samara/base/parameters.h>
#include <samara/base/text.h>
#include <samara/model/system.h>

#include <algorithm>

namespace samara
{
  /** Numbers of the states of first order that keep their values: those of kind control. */
  inline std::vector<unsigned int>
  states_of_controls(const System &system)
  {
    std::vector<unsigned int> result;
    const auto               &states = system.model.states;
    for (const auto &item : system.model.items)
      if (item->is_control())
        for (unsigned int i = 0; i < states.size(); ++i)
          if (states[i].name == item->name)
            result.push_back(i);
    return result;
  }

  /** Those of the names in the entry "Inputs", in their order; all of them without names. @throws InputError */
  inline std::vector<unsigned int>
  controls_by_name(const System &system, const std::vector<std::string> &wanted, const Parameters &parameters)
  {
    const auto controls = states_of_controls(system);
    if (wanted.empty())
      return controls;
    std::vector<std::string> names;
    for (const unsigned int i : controls)
      names.push_back(system.model.states[i].name);
    std::vector<unsigned int> result;
    for (const auto &name : wanted)
      {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
          throw InputError(parameters.where("Inputs") + ": <" + name + "> is no state of type <control>" +
                           did_you_mean(name, names));
        result.push_back(controls[found - names.begin()]);
      }
    return result;
  }
} // namespace samara

#endif
