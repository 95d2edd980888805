#ifndef samara_tests_input_said_h
#define samara_tests_input_said_h

// What a file says, to be compared with what another one says: as used.prm writes it, and as the forces of its system.

#include "../scene.h"

#include <cmath>

namespace samara
{
  /** The text of used.prm. */
  inline std::string
  used(const Scene &scene)
  {
    std::ostringstream text;
    scene.input.print(text);
    return text.str();
  }



  /** The residual of a state that is far from all equilibria. */
  inline std::vector<double>
  residual(const System &system)
  {
    State               state = system.reference();
    std::vector<double> z(system.size()), stress, r;
    for (unsigned int i = 0; i < z.size(); ++i)
      z[i] = 0.1 * std::sin(i + 1.);
    system.update(state, z);
    state.time   = 0.3;
    state.factor = 0.7;
    system.stresses(state, stress);
    system.residual(state, stress, r);
    return r;
  }
} // namespace samara

#endif
