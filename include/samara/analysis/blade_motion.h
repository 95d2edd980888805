#ifndef samara_analysis_blade_motion_h
#define samara_analysis_blade_motion_h

#include <samara/model/system.h>

#include <complex>
#include <vector>

namespace samara
{
  /** @name What names of modes are made of, see ModeNames and ContentOfModes @{ */

  /** Of the kinetic energy, from which on one family stands for all. */
  constexpr double clear_share_of_family = 0.6;

  /** Mass centre of a node with this inertia, in its axes; zero without mass [m]. */
  Vector3 centre_of_mass(const Matrix6 &inertia);

  /** Of a motion @p x, increments of all unknowns: zᴴ M z of a node. */
  double energy_of_node(const System &system, const Eigen::VectorXcd &x, unsigned int node);

  /** Of motions from the axis outwards: how often signs change, and one; what is below a tenth of the largest has none.
   */
  unsigned int parts_of_alternating_sign(const std::vector<std::complex<double>> &motion);

  /** @} */
} // namespace samara

#endif
