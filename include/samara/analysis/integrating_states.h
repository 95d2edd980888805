#ifndef samara_analysis_integrating_states_h
#define samara_analysis_integrating_states_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * The states of first order that take part in combinations on which no rate of a state depends: integrals. In
   * equilibrium they have a value only if loads, or what is prescribed, depend on them. None of more than 500 states.
   */
  std::vector<std::string> integrating_states(const System &system, const State &state);
} // namespace samara

#endif
