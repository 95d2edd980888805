#ifndef samara_tests_states_started_h
#define samara_tests_states_started_h

#include <samara/time/stepper.h>

#include "../scene.h"
#include "../time/systems.h"

namespace samara
{
  /** The reference configuration with the velocities that the file gives it, ready to move. */
  inline State
  started(const System &system)
  {
    State state = system.reference();
    system.add_initial_velocities(state);
    Projection(system).velocities(state);
    state.held = false;
    return state;
  }
} // namespace samara

#endif
