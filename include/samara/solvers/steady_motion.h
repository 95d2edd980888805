#ifndef samara_solvers_steady_motion_h
#define samara_solvers_steady_motion_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * What is known of a motion that set_steady_motion() has found. It is steady, for ever, if it strains nothing and if
   * nothing turns or slides along a line that moves: then all twists in the bodies' own axes stay as they are.
   */
  struct SteadyMotion
  {
    double      strain = 0; ///< the largest strain rate, over that of as large velocities without order
    std::string strained;   ///< what is strained most, if anything is

    std::vector<std::string> moving;        ///< relative motions along or about lines that move
    std::vector<std::string> shared;        ///< rates that nothing tells apart: bearings one inside the other
    unsigned int             n_at_rest = 0; ///< rigid motions that nothing relates to a drive or the ground: at rest

    bool
    is_steady() const
    {
      return strained.empty() && moving.empty();
    }
  };

  /**
   * Give all nodes of @p state the steady rigid motion that the model's rotations make, at @p speeds [rad/s], one a
   * rotation.
   *
   * A rotation of the whole model is a rotation about its axis. Rotations at joints are the motion in which, in this
   * order: constraints are obeyed and the joints turn at their speeds; nothing is strained, or least; nothing moves
   * against anything else, above all not about axes that move; what carries the drives is at rest; all is at rest. So
   * hinged blades turn with their hub, and what hangs on a bearing does not. (doc/theory/steady_rotation.md)
   *
   * @throws InputError if the speeds contradict each other, with the names of the constraints.
   */
  SteadyMotion set_steady_motion(const System &system, State &state, const std::vector<double> &speeds);

  /**
   * Where a steady motion has taken @p from after the time @p t [s]: each node, and the ground, goes on with its twist of
   * State::y, constant in its own axes, and joint coordinates with their rates. Stresses and multipliers stay.
   */
  State moved_on(const System &system, const State &from, double t);

  /** The lowest and the highest rate of a relative motion [rad/s or m/s] in a while. */
  struct RateRange
  {
    std::string name;
    double      lowest, highest;
  };

  /**
   * Go on from @p state with the motion of its moment, which nothing strains, until the fastest drive has turned once:
   * how the rates change on the way. Runge and Kutta's method of order four in 24 steps, for reports.
   */
  std::vector<RateRange> rates_of_one_turn(const System &system, const State &state, const std::vector<double> &speeds);

  /**
   * In words why a motion is not steady, with the rates that vary and by how much; empty if it is steady.
   */
  std::string why_not_steady(const System              &system,
                             const State               &state,
                             const std::vector<double> &speeds,
                             const SteadyMotion        &motion);

  /**
   * The steady motion of all nodes as one vector: velocity times 1 s and spin at the nodes' reference places, so that
   * it does not depend on the configuration; and a state's motion from such a vector.
   * @{
   */
  Eigen::VectorXd steady_motion_vector(const System &system, const State &state);
  void            set_steady_motion_vector(const System &system, State &state, const Eigen::VectorXd &motion);
  /** @} */

  /** Whether all nodes that can move take part in one rigid rotation. */
  bool turns_as_a_whole(const System &system, const State &state);
} // namespace samara

#endif
