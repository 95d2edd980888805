#ifndef samara_analysis_period_of_rotors_h
#define samara_analysis_period_of_rotors_h

#include <samara/analysis/analysis.h>

namespace samara
{
  /** The time of a turn of the steady rotations, where all have one speed [s]; 0 where they have several, or there are
   * none. */
  double period_of_rotors(const Context &context);

  /**
   * Let a @p period of which nothing is said be that of the rotors.
   * @throws InputError at the entry if they do not tell it
   */
  void find_period(double &period, const Parameters &parameters, const Context &context);
} // namespace samara

#endif
