#ifndef samara_analysis_steady_loads_h
#define samara_analysis_steady_loads_h

#include <samara/analysis/linearization.h>

#include <algorithm>

namespace samara
{
  /**
   * How the equilibrium of a state changes while its steady motion goes on: the other half of the proof that the motion
   * is steady. Weight across the axis bends a shaft or moves a hinged blade anew at each azimuth, weight along it does
   * not; the reactions of a rotor out of balance move a support that yields.
   */
  struct ChangingLoads
  {
    Imbalance imbalance; ///< of the state turned on, whatever its reactions and the moments of drives
    Imbalance drives;    ///< the same where drives keep their moments, if these do not hold the state

    /** @name The largest change of loads, seen in the axes of what they act on @{ */
    double      share     = 0; ///< of the largest load or inertia force of any node [1]
    double      force     = 0; ///< [N], or [N m]
    bool        is_moment = false;
    std::string load, body;
    /** @} */

    /** Whether an equilibrium of one azimuth is one of all, to the digits that statics gives. */
    bool
    are_steady() const
    {
      return std::max(imbalance.step, drives.step) <= 1e-7 && std::max(imbalance.stress, drives.stress) <= 1e-8;
    }

    /** Whether modes change with the azimuth: as much as makes a state no equilibrium for them. */
    bool
    change_modes() const
    {
      return imbalance.is_large() || drives.is_large();
    }

    /** In words, for a message: what changes and by how much. */
    std::string text() const;
  };

  /** Times in which what turns fastest, and what turns slowest, has turned by parts of a turn that are no simple ones
   * [s]. */
  std::vector<double> times_to_look(const State &state);

  /**
   * Let the steady motion of an equilibrium go on by a part of a turn, twice and more, and look at the loads and at the
   * equilibrium there: twists, strains and stresses stay, reactions may change, and so may the moments of drives if
   * the state is held. Functions of time keep their values.
   */
  ChangingLoads changing_loads(const System &system, const State &state);
} // namespace samara

#endif
