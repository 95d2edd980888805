#ifndef samara_solvers_steady_motion_h
#define samara_solvers_steady_motion_h

#include <samara/model/system.h>
#include <samara/solvers/linear.h>

namespace samara
{
  /**
   * Give all nodes of @p state the steady rigid motion that the model's rotations make, at @p speeds [rad/s], one a
   * rotation.
   *
   * A rotation of the whole model is a rotation about its axis. A rotation at a joint is the motion with the joint
   * turning at its speed that obeys all constraints and strains nothing, or least: the minimum of ½ yᵀ K y, K the material
   * stiffness in the present configuration. Gears, couplings and shafts pass it on as they do in reality; what nothing
   * drives stays at rest.
   */
  void set_steady_motion(const System &system, State &state, const std::vector<double> &speeds);

  /**
   * The steady motion of all nodes as one vector: velocity times 1 s and spin at the nodes' reference places, so that it
   * does not depend on the configuration; and a state's motion from such a vector.
   * @{
   */
  Eigen::VectorXd steady_motion_vector(const System &system, const State &state);
  void            set_steady_motion_vector(const System &system, State &state, const Eigen::VectorXd &motion);
  /** @} */

  /** Whether all nodes that can move take part in one rigid rotation. */
  bool turns_as_a_whole(const System &system, const State &state);
} // namespace samara

#endif
