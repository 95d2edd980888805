#ifndef samara_analysis_controls_h
#define samara_analysis_controls_h

#include <samara/model/system.h>

namespace samara
{
  /** Numbers of the states of first order that keep their values: those of kind control. */
  inline std::vector<unsigned int>
  states_of_controls(const System &system)
  {
    std::vector<unsigned int> result;
    const auto               &states = system.model.states;
    for (const auto &item : system.model.items)
      if (item->kind == "control")
        for (unsigned int i = 0; i < states.size(); ++i)
          if (states[i].name == item->name)
            result.push_back(i);
    return result;
  }
} // namespace samara

#endif
