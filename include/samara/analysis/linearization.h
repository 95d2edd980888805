#ifndef samara_analysis_linearization_h
#define samara_analysis_linearization_h

#include <samara/model/system.h>
#include <samara/solvers/mixed_matrix.h>

#include <string>

namespace samara
{
  /**
   * The small motions of a system about a state, in axes that turn with the nodes; or in axes that are theirs at the
   * moment of the state and turn at other @p spins [rad/s], one a node, in the inertial frame, parallel to the node's
   * own. Zero makes fixed axes. The matrices are those of the moment; MovingAxes tells where they are constant.
   *
   * Controls that are held are no motion: nothing depends on them, and their rows are 0 = δz. Free ones are columns by
   * which other rows depend on them, inputs of a linear system.
   */
  struct Linearization : LinearMotion
  {
    enum class Controls
    {
      held,
      free
    };

    Linearization(const System               &system,
                  const State                &state,
                  const std::vector<Vector3> &spins    = {},
                  Controls                    controls = Controls::held);

  private:
    void turn_axes(const System &system, const State &state, const std::vector<Vector3> &spins);
  };



  /** How far a state is from the equilibrium of its loads and inertia forces, by one step of the mixed Newton
   * iteration. */
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
   * The same for a state with stresses that other multipliers may balance: it is given these, and how far it is from an
   * equilibrium nevertheless. Places are taken as they are, though they may disobey constraints. Drives keep their
   * moments if the state is not held.
   */
  Imbalance balance_reactions(const System &system, State &state);
} // namespace samara

#endif
