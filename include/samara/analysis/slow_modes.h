#ifndef samara_analysis_slow_modes_h
#define samara_analysis_slow_modes_h

#include <samara/analysis/floquet_modes.h>

namespace samara
{
  /** Which modes are slow, and how long they are looked for. */
  struct SlowModes
  {
    double       highest      = 0;    ///< |λ| of the linearised motion up to which its modes are followed [rad/s]
    double       tolerance    = 1e-9; ///< of residuals and changes, relative to each multiplier
    unsigned int most_columns = 600;
  };

  /**
   * Multipliers of the slow modes of a periodic motion: those that continue the modes of the motion linearised at the
   * start of the period with |λ| up to @p which.highest (doc/theory/floquet.md).
   *
   * The largest multipliers of stiff models are what the steps do not resolve, and what matters is not among them. Here
   * a space is made of the slow modes at the start, the map is projected on it, and as long as a Ritz vector that is
   * slow, or lies mostly in these modes, has a residual, the space grows by that. All modes with |λ| up to @p
   * which.highest are given, and those that continue one at the start and are a little faster. A mode has come to the
   * tolerance when neither its residual nor the change of its multiplier since the space has grown last is above that.
   *
   * @throws NotConverged if nothing is slow, if one with |λ| up to @p which.highest does not come to the tolerance, or
   * if modes are fewer than at the start, but for those that decay to round-off over the section
   */
  FloquetModes slow_floquet_modes(SectionMap &map, const SlowModes &which);
} // namespace samara

#endif
