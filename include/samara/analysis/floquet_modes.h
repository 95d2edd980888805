#ifndef samara_analysis_floquet_modes_h
#define samara_analysis_floquet_modes_h

#include <samara/analysis/mode_content.h>
#include <samara/analysis/section_map.h>

namespace samara
{
  /** A mode of a periodic motion, x(t) = Re[p(t) exp(λ t)] with p of the period T. */
  struct FloquetMode
  {
    std::complex<double> multiplier;   ///< exp(λ T), over the whole period
    std::complex<double> of_section;   ///< over T/Q, Im ≥ 0
    std::complex<double> exponent;     ///< λ [1/s]; its imaginary part ≥ 0 is that of the largest Fourier part
    Eigen::VectorXcd     shape;        ///< increment at the start, as those of StepTangent, unit norm over its scales
    double               residual = 0; ///< |S v − σ v|/|σ|, or the same of what is computed in its place
    double               rate     = 0; ///< root mean square of velocities over that of displacements, by energy [rad/s]
    double               error    = 0; ///< of |multiplier|, relative, estimated: see estimate_errors()
    std::complex<double> scheme_error = 0; ///< of λ, what the steps change an undamped vibration of that rate by [1/s]

    ModeContent content; ///< what repeated parts do in it, empty without any

    /** Mean share of each body in the kinetic energy of the motion's shape over a period, largest first. */
    std::vector<std::pair<std::string, double>> shares;

    double
    growth() const
    {
      return exponent.real();
    }
    double
    frequency() const
    {
      return exponent.imag();
    }
  };



  struct FloquetModes
  {
    std::vector<FloquetMode> found;               ///< largest multipliers first; of a pair the one with Im σ ≥ 0
    unsigned int             n_columns   = 0;     ///< vectors that were taken through the section
    unsigned int             n_vanishing = 0;     ///< not among them: so small that they are lost in round-off
    bool                     is_all      = false; ///< nothing else moves

    /** @name Of slow_floquet_modes() @{ */
    unsigned int n_looked_for = 0; ///< slow modes of the linearised motion, of pairs one; 0: it was not asked
    unsigned int n_lost = 0; ///< of their dimensions those that decay to round-off over the section, and are not told
    /** @} */
  };



  /** Multipliers from all columns of the map, of the increments that constraints allow. */
  FloquetModes all_floquet_modes(SectionMap &map);

  /**
   * The @p wanted largest multipliers by Arnoldi's method, of pairs both counted, each to the relative @p tolerance.
   * @p tolerance_of_steps: of the linear equations of each step, see PeriodMap::set_tolerance().
   * @throws NotConverged
   */
  FloquetModes largest_floquet_modes(SectionMap &map, unsigned int wanted, double tolerance, double tolerance_of_steps);

  /** What is known of a mode when the eigenvalue @p value of the section and its vector, in scales, have been found. */
  FloquetMode
  mode_of(const SectionMap &map, std::complex<double> value, const Eigen::VectorXcd &scaled_shape, double residual);

  /**
   * Errors of multipliers from @p projected, the map of the section in the space of the modes that were found: as far
   * as they move when it changes by their residuals, by how far the gap of the motion leaves the orbit away, and by
   * what Newton's method and the equations of the linearised steps leave. Multipliers one of what has no damping are often there twice with one
   * shape, and move by the root of that.
   */
  void estimate_errors(const SectionMap      &map,
                       const Eigen::MatrixXd &projected,
                       double                 tolerance_of_steps,
                       FloquetModes          &modes);

  /** Largest first; those lost in round-off of a map of this @p size are taken away. */
  void put_in_order(FloquetModes &modes, double size);

  /** Exponents, unwrapped frequencies, shares and contents of the first @p n modes; @p parts: those that are repeated.
   */
  void describe(SectionMap &map, const RepeatedParts &parts, FloquetModes &modes, unsigned int n);
} // namespace samara

#endif
