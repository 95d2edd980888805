#ifndef samara_model_algebraic_states_h
#define samara_model_algebraic_states_h

#include <samara/model/model.h>

#include <vector>

namespace samara
{
  /**
   * The numbers of the states of first order without rates: 0 = g(q, y, z, t) in place of ż = g. They follow at once,
   * at every stage of a step; what they were before does not matter.
   */
  inline std::vector<unsigned int>
  algebraic_states(const Model &model)
  {
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < model.states.size(); ++i)
      if (model.states[i].is_algebraic)
        result.push_back(i);
    return result;
  }
} // namespace samara

#endif
