#ifndef samara_time_step_control_h
#define samara_time_step_control_h

#include <samara/time/tableau.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace samara
{
  /**
   * What a step of the integrator family does to a linear oscillator of frequency ω, as a function of Y = (ω h)²:
   *
   *     ζ(Y) = D/(α E) = κ Yˢ/(1 + d₁ Y + … + d_s Yˢ),     D = h² α/(2(2s−1)) |Σ b_k p_k F_k|²
   *
   * with the energy E at the start of the step, and
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

    /** κ, and φ. @{ */
    double
    leading() const
    {
      return kappa;
    }
    double phase() const;
    /** @} */

  private:
    const unsigned int    s;
    const double          alpha;
    double                kappa;
    std::array<double, 3> d;
  };



  /**
   * Chooses the steps so that errors of positions add up to the tolerance over the run (doc/theory/step_control.md).
   *
   * A step of length h may have the local error
   *
   *     e ≤ tolerance · length · h/duration,     length: the model's, or the largest displacement so far;
   *
   * half of it is aimed at, c = 2 e duration/(tolerance length h) = 1, by a controller with memory (H211b of Söderlind
   * 2003, b = 4), k the order of e/h:
   *
   *     ratio_n = (c_n c_{n−1})^{−1/4k} ratio_{n−1}^{−1/4},     after a rejection c^{−1/k}
   *     h ← h (1 + atan(ratio − 1))
   *
   * Errors of positions do not see small fast oscillations, which matter for velocities and forces. A guard does: the
   * energy that a step dissipates, or would dissipate with α = 1, over a reference energy tells how well the step
   * resolves an oscillator. Its relative error in a period is at most `guard`. The work defect of stops is at most
   * `tolerance` times the reference energy.
   *
   * A step without solution is tried again with half its length. Later steps are at most 0.8 times as long as the one
   * that failed, 0.6 times where that was as long as this limit allows; it grows by 5 % in each step. After a step of
   * more than 30 iterations it is 0.9 times its length: two of half the length cost no more.
   */
  class StepController
  {
  public:
    struct Settings
    {
      double tolerance      = 1e-4; ///< error of positions at the end over the length
      double duration       = 1;    ///< over which errors add up to the tolerance [s]
      double length         = 1;    ///< displacements count at least as this [m]
      double end            = std::numeric_limits<double>::infinity(); ///< of the run [s]
      double smallest_step  = 1e-9;                                    ///< s
      double largest_step   = std::numeric_limits<double>::infinity();
      double guard          = 0.1;  ///< relative error of an oscillation in a period
      double worth_a_change = 1.15; ///< growth below which a step stays as it is, and factorisations can be kept
    };

    /** What is known of a step. */
    struct Judged
    {
      double       error;          ///< local error of positions [m]
      double       indicator;      ///< D/α = h²/(2(2s−1)) |Σ b_k p_k F_k|², which is there for α = 0, too [J]
      double       work_defect;    ///< Σ|N| of stops [J]
      unsigned int iterations = 0; ///< of Newton's method
    };

    struct Decision
    {
      bool   accept;
      double next_h; ///< of the next step, or of the same step again
    };

    /** @throws std::invalid_argument unless 0 < tolerance < 1, 0 < smallest ≤ largest step, and the others are
     * positive. */
    StepController(const Tableau &tableau, const Settings &settings);

    /**
     * To be called with energy and largest displacement at the start, and with those at the end of each step before
     * decide(): strain energy and kinetic energy of what is not steady rotation. The largest so far are the references.
     * Call it also with the least energy that matters, 1e-10 of the whole kinetic energy say: otherwise a model at rest
     * or in steady rotation has its round-off resolved.
     */
    void update(double energy, double displacement);

    /**
     * @param h the step that was made. After one cut short to meet a time, go on with the step proposed before.
     *
     * At the smallest step everything is accepted.
     */
    Decision decide(const Judged &step, double h);

    /**
     * The step to try when the equations of a step @p h could not be solved: half of it.
     *
     * @throws NotConverged if h is the smallest step.
     */
    double after_failure(double h);

    /** What errors add up over [s]. */
    double
    duration() const
    {
      return settings.duration;
    }

    /** For how long an error at the given time matters [s]. */
    double
    remaining(const double time) const
    {
      return std::clamp(settings.end - time, 0., settings.duration);
    }

    /** Local error of the last step over what it may have. */
    double
    share() const
    {
      return last_share;
    }

    /** All that later steps depend on, for restarts. @{ */
    std::vector<double> memory() const;
    void                set_memory(const std::vector<double> &memory);
    /** @} */

    const DissipationRelation relation;
    const double              Y_guard, zeta_guard;

    double       E_ref = 0, size = 0;
    unsigned int n_rejections = 0, n_failures = 0;
    unsigned int n_forced = 0; ///< accepted only because the step was the smallest: there the tolerance is not met

  private:
    const Settings     settings;
    const unsigned int order;                      ///< of the error of a step over its length
    double             last_c = 0, last_ratio = 1; ///< of the last step if it was accepted; 0 otherwise
    double             last_share = 0;
    double             cap        = std::numeric_limits<double>::infinity(); ///< no longer steps, after a failure [s]

    double by_error(double error, double h, double &c) const;
  };
} // namespace samara

#endif
