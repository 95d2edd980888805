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

  /** Of motions, increments of all unknowns: yᵀ M x of a node. With y = x̄ twice the amplitude of its kinetic energy. */
  std::complex<double>
  product_of_node(const System &system, const Eigen::VectorXcd &y, const Eigen::VectorXcd &x, unsigned int node);

  /**
   * What parts of a mode are weighed with: @p y is its left vector, or x̄ where there is none. yᵀMx of a part is how
   * much the eigenvalue changes with the mass of the part. Without air and dampers this is its kinetic energy. With
   * air, lift of a twisting blade moves it in flap, and its energy is there; but flap does not twist it, and the left
   * vector has none. Products are multiplied by what makes their sum real and positive.
   *
   * Source: participation factors, Pérez-Arriaga, Verghese & Schweppe, IEEE Trans. PAS-101 (1982) 3117-3125.
   */
  struct Weighing
  {
    /** x̄ unless the left vector is @p known, and sees the mass that moves: not of states that force what moves. */
    Weighing(const System &system, const Eigen::VectorXcd &x, const Eigen::VectorXcd &known);

    Eigen::VectorXcd     y;
    std::complex<double> phase = 1;

    double
    part(const std::complex<double> &product) const
    {
      return (phase * product).real();
    }
  };

  /** Of motions from the axis outwards: how often signs change, and one; what is below a tenth of the largest has none.
   */
  unsigned int parts_of_alternating_sign(const std::vector<std::complex<double>> &motion);

  /** @} */
} // namespace samara

#endif
