#ifndef samara_analysis_start_of_motion_h
#define samara_analysis_start_of_motion_h

#include <samara/analysis/analysis.h>

namespace samara
{
  /** What analyses of motion in time say about where it begins. */
  struct StartOfMotion
  {
    std::string where;             ///< the subsection of the analysis, for messages
    double      time      = 0;     ///< [s]
    bool        is_family = true;  ///< of integrators: rows of redundant constraints may be left out
    bool        refuses   = false; ///< velocities that constraints do not allow, in place of making them allowed
  };

  /**
   * The state from which a motion begins: that of the context, an equilibrium at rest or in steady rotation or the
   * reference configuration, with the velocities of the steady rotations and of the bodies, made to obey the
   * constraints. The ground is at rest, steady rotations no longer hold their joints. A motion that an analysis has left,
   * as trim does, goes on as it is.
   *
   * @throws InputError if constraints are violated, the model turns with its ground, or the motion that goes on has come
   * to another time
   */
  State start_of_motion(const Context &context, const StartOfMotion &how);

  /** The motion that a dynamic analysis has left, at its time; where there is none, the start of one. */
  State motion_or_start(const Context &context, const StartOfMotion &how);
} // namespace samara

#endif
