#ifndef samara_time_increment_h
#define samara_time_increment_h

#include <samara/model/system.h>

#include <vector>

namespace samara
{
  /**
   * Increments x = (ζ, δc, δz, δy, δċ) of a state, as StepTangent and PeriodMap have them: twists ζ that move nodes, in
   * their own frames [m, rad], joint coordinates, states of first order, changes of the nodal twists and of the rates
   * of coordinates.
   */

  /** Numbers in an increment. */
  inline unsigned int
  size_of_increment(const Layout &layout)
  {
    return layout.of_multiplier(0) + layout.n_kinematic();
  }

  /**
   * @p state with @p factor times the increment @p x: nodes go along the screws ζ, all else is added. Stresses become
   * those of the new configuration, multipliers and time stay.
   */
  State moved(const System &system, const State &state, const double *x, double factor = 1);

  /**
   * The increment that leads from one state to another, so that moved(from, x) = to; rotations by less than half a
   * turn. With @p whole_turns, angles of joints that differ by whole turns are the same.
   */
  std::vector<double> increment(const System &system, const State &from, const State &to, bool whole_turns = false);

  /**
   * What number counts as one of each kind, so that increments can be measured: the length of the model, one radian,
   * the scales of states; and for velocities these over @p time [s].
   */
  std::vector<double> scales_of_increment(const System &system, double time);
} // namespace samara

#endif
