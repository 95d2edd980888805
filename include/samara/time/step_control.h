#ifndef samara_time_step_control_h
#define samara_time_step_control_h

#include <samara/time/tableau.h>

#include <array>
#include <limits>

namespace samara
{
  /**
   * What a step of the integrator family does to a linear oscillator of frequency ω, as a function of Y = (ω h)²:
   *
   *     ζ(Y) = D/(α E) = κ Yˢ/(1 + d₁ Y + … + d_s Yˢ),     D = h² α/(2(2s−1)) |Σ b_k p_k F_k|²,  E at the start of the
   * step
   *
   *     s   κ         d₁             d₂                d₃
   *     1   1         (1 + α)²/4
   *     2   1/36      (3 + α²)/36    (1 + α)²/144
   *     3   1/3600    (5 + α²)/100   (2 + α²)/1200     (1 + α)²/14400
   *
   * ζ increases from 0 to 4/(1 + α)² without a maximum; for α = 0 it is the indicator without the factor α. Derivation
   * in doc/theory/step_control.md.
   */
  class DissipationRelation
  {
  public:
    explicit DissipationRelation(const Tableau &tableau);

    double value(double Y) const;

    /** The Y with ζ(Y) = @p zeta; 0 for zeta ≤ 0, infinite from the limit of ζ on. */
    double inverse(double zeta) const;

    /**
     * Relative error of the oscillator's state after one period, leading terms: loss of amplitude α ζ/2 a step, of
     * order 2s − 1, and shift of phase, of order 2s:
     *
     *     ε(Y) = π κ Y^(s−1/2) √(α² + φ² Y),     φ = ½ (1/(2s+1) + α²/(2s−1))
     */
    double period_error(double Y) const;

    /** The Y with ε(Y) = @p error > 0. */
    double inverse_period_error(double error) const;

  private:
    const unsigned int    s;
    const double          alpha;
    double                kappa;
    std::array<double, 3> d;
  };



  /**
   * Chooses the steps from the energy that the scheme dissipates, or would with α = 1, over a reference energy.
   *
   * A step is as long as one with which a linear oscillator has the relative error `tolerance` after a period. Errors
   * are then proportional to the tolerance and to the number of periods, for all s and ρ∞. With ζ measured,
   *
   *     ε(Y_t) = tolerance,     h_new = safety · h √(Y_t/Y(ζ)) within [least_ratio, largest_ratio] h,
   *
   * and a step is rejected if ζ > reject_factor · ζ(Y_t).
   *
   * Limits: one oscillator is taken for all. A mode that is not resolved is not noticed if it has less than about
   * ζ(Y_t) of the energy; nor is steady rotation, nor what loads do in between stages: that is what largest_step is
   * for.
   */
  class StepController
  {
  public:
    struct Settings
    {
      double       tolerance      = 1e-4; ///< relative error in a period
      double       smallest_step  = 1e-9; ///< s
      double       largest_step   = std::numeric_limits<double>::infinity();
      double       safety         = 0.9;
      double       least_ratio    = 0.3;
      double       largest_ratio  = 2;
      double       worth_a_change = 1.15; ///< factor below which a step stays as it is, and factorisations can be kept
      double       reject_factor  = 2;
      unsigned int patience       = 10; ///< steps without growth after a failure: long steps tend to fail again
    };

    struct Decision
    {
      bool   accept;
      double next_h; ///< of the next step, or of the same step again
    };

    /** @throws std::invalid_argument unless 0 < tolerance < 1, 0 < smallest ≤ largest step, and the factors fit. */
    StepController(const Tableau &tableau, const Settings &settings);

    /**
     * To be called with the energy at the start, and with that at the end of each step before decide(): strain energy
     * and kinetic energy of what is not steady rotation. The largest so far is the reference. Call it also with the
     * least energy that matters, 1e-10 of the whole kinetic energy say: otherwise a model at rest or in steady rotation
     * has its round-off resolved.
     */
    void update(double energy);

    /**
     * @param indicator   D/α = h²/(2(2s−1)) |Σ b_k p_k F_k|², which is there for α = 0, too.
     * @param work_defect Σ|N| of stops; it may be `tolerance` times the reference energy, and a step is rejected from
     *                    three times that. The shorter of both steps is taken.
     * @param h          the step that was made. After one cut short to meet a time, go on with the step proposed
     * before.
     *
     * A step in which an oscillation turns around has an indicator near zero: it alone makes the next one longer by a
     * fifth at most. The step after a rejection is not made longer, nor are `patience` steps after a failure. At the
     * smallest step everything is accepted.
     */
    Decision decide(double indicator, double work_defect, double h);

    /**
     * The step to try when the equations of a step @p h could not be solved: half of it.
     *
     * @throws NotConverged if h is the smallest step.
     */
    double after_failure(double h);

    /** All that later steps depend on, for restarts: reference energy, steps without growth, last ratio. @{ */
    std::array<double, 3> memory() const;
    void                  set_memory(const std::array<double, 3> &memory);
    /** @} */

    const DissipationRelation relation;
    const double              Y_target, zeta_target;

    double       E_ref        = 0;
    unsigned int n_rejections = 0, n_failures = 0;
    unsigned int n_forced = 0; ///< accepted only because the step was the smallest: there the tolerance is not met

  private:
    const Settings settings;
    unsigned int   hold = 0;                                       ///< for so many steps no growth
    double last_ratio   = std::numeric_limits<double>::infinity(); ///< of the step the last one asked for to itself
  };
} // namespace samara

#endif
