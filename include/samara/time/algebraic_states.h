#ifndef samara_time_algebraic_states_h
#define samara_time_algebraic_states_h

#include <samara/model/algebraic_states.h>
#include <samara/model/system.h>
#include <samara/time/tableau.h>

namespace samara
{
  /**
   * Let algebraic states be those that belong to the motion of @p state, 0 = g, by Newton's method from what they are.
   * @throws NotConverged if there are none, or none is found
   */
  void find_algebraic_states(const System &system, State &state);

  /** Factors of values at the stages in that of their polynomial at the end of the step: algebraic states there are
   * those of the stages, carried on, whatever they were at the start. */
  Eigen::VectorXd values_at_end(const Tableau &tableau);
} // namespace samara

#endif
