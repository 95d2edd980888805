#ifndef samara_analysis_linearization_h
#define samara_analysis_linearization_h

#include <samara/model/system.h>
#include <samara/solvers/mixed_matrix.h>

#include <string>

namespace samara
{
  /**
   * The small motions of a system about a state, in axes that turn with the nodes. With @p fixed_axes the increments of
   * turning nodes are seen in axes that stand still, which makes parts turning against others comparable: the matrices
   * are those of the moment, and constant if what turns is axisymmetric.
   */
  struct Linearization : LinearMotion
  {
    Linearization(const System &system, const State &state, bool fixed_axes);
  };



  /** How far a state is from the equilibrium of its loads and inertia forces, by one step of the mixed Newton iteration. */
  struct Imbalance
  {
    double      step   = 0; ///< displacement relative to the size of the model, or rotation
    double      stress = 0; ///< share of the strain energy that the state's stress lacks [1]
    std::string worst;      ///< what lacks most of it, if anything does

    /** Whether the state would move away, or modes about it would miss stresses. Reactions are found on the way. */
    bool
    is_large() const
    {
      return step > 1e-5 || stress > 1e-4;
    }
  };

  /**
   * Give the state the stresses and multipliers that balance its loads, and say how far it was from that. Stresses from
   * strains have errors of ε times the stiffness, which is no less than what bends a slender beam.
   */
  Imbalance balance_stresses(const System &system, State &state);

  /**
   * The same for a state with stresses that other multipliers may balance: how far it is from an equilibrium, whatever
   * its multipliers. Places are taken as they are, though they may disobey constraints. Drives keep their moments if the
   * state is not held.
   */
  Imbalance imbalance_at_any_reactions(const System &system, const State &state);
} // namespace samara

#endif
