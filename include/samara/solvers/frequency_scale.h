#ifndef samara_solvers_frequency_scale_h
#define samara_solvers_frequency_scale_h

#include <samara/solvers/shift_invert.h>

#include <optional>

namespace samara
{
  /**
   * A frequency from mass and stiffness alone, below those of the motion's elastic modes: √(K/M)/N² of the softest
   * unknown among N nodes, with shells √(K/M)/N, all strains of a point as soft as the softest. Without strains, from
   * geometric stiffness or gyroscopic terms.
   */
  double frequency_scale(const LinearMotion &motion);

  /**
   * Set the operator's unit of time to the lowest frequency that is not zero, and return it. The shift, where none is
   * given, becomes 0.3 of it; rough eigenvalues about a first shift tell it.
   * @throws SingularMatrix
   */
  double set_by_lowest_frequency(const LinearMotion &motion, ShiftInvert &op, std::optional<double> shift);
} // namespace samara

#endif
