#ifndef samara_time_stage_stops_h
#define samara_time_stage_stops_h

#include <samara/model/system.h>
#include <samara/time/tableau.h>

#include <array>

namespace samara
{
  /** The forces of a stop in the stages of a step, and what they do in it. Nothing if it is nowhere touched. */
  struct StopForces
  {
    std::array<double, 3>                force{}; ///< f_k against growing gaps, in the stages [N] or [N m]
    std::array<std::array<double, 3>, 3> slope{}; ///< ∂f_k/∂ġ_l
    bool                                 is_touched = false;
    double work_defect = 0; ///< N [J]: the work of U'(g) in the stages misses U_f − U_i by it
    double loss        = 0; ///< of the damper [J], not negative
    double elastic     = 0; ///< work of f − d on the spring [J]
    double depth       = 0; ///< the largest gap in the stages and at both ends
  };

  /** Gaps of a contact at the start, in the stages and at the end of a step. */
  struct StepGaps
  {
    std::array<double, 3> stage{};
    double                start = 0, end = 0;
    double change   = 0;     ///< h Σ b ġ; end − start but for what of the gap's curvature is not integrated
    double most     = 0;     ///< the largest of all
    bool   by_rates = false; ///< the stages are g_i + h Σ a ġ, as of a coordinate

    /** Of a coordinate, from its rates in the stages. */
    StepGaps(const Tableau &t, double start, const double *rates, double h);
    /** Of gaps that are known. */
    StepGaps(const Tableau &t, double start, const double *stages, double end, const double *rates, double h);

    bool
    is_touched() const
    {
      return most > 0;
    }
    bool is_touched_all_the_time(const Tableau &t) const;
  };

  /** As stop_forces(), for gaps that are known; the work on the spring is the mean slope times h Σ b ġ. */
  StopForces
  contact_forces(const ContactLaw &law, const Tableau &tableau, const StepGaps &gaps, const double *rates, double h);



  /**
   * A stop in all stages at once, each by the sign of its own gap; nothing is located or switched
   * (doc/theory/joints.md):
   *
   *     f_k = U'(g_k) + τ ġ_k + d_k,     τ = Σ b_k (U'_m − U'(g_k)) ġ_k / Σ b_k ġ_k²
   *
   * with the mean slope U'_m = (U_f − U_i)/(g_f − g_i), in a form without cancellation. Then h Σ b (f − d) ġ = U_f −
   * U_i to round-off, whatever the rates are. N = h Σ b (U'_m − U'(g_k)) ġ_k tells how well the steps resolve the
   * contact.
   *
   * The damper is d_k = c ġ_k min(1, g_k⁺/|g_f − g_i|) + χ U'(g_k) ġ_k, cut so that the stop does not pull. The
   * fraction lets it begin in the course of a step: with a jump to c ġ at the touch, equations of stages may have no
   * solution.
   *
   * @param gap g_i at the start; @param rates ġ_k of the gap in the stages; @param h the step [s].
   */
  StopForces stop_forces(const Layout::Stop &stop, const Tableau &tableau, double gap, const double *rates, double h);



  /** A stop that is touched, or left, at some time [s]. */
  struct Touch
  {
    unsigned int stop; ///< number in Layout::stops
    double       time;
    bool         begins;
  };

  /** What a stop did in a step in which it was touched, for reports. */
  struct TouchedStop
  {
    unsigned int stop; ///< number in Layout::stops
    double       depth, loss;
    bool         is_touched_at_start;
  };



  /** Where the polynomial of the gap changes its sign in a step from time @p time on, for reports. */
  void add_touches(unsigned int        stop,
                   const Tableau      &tableau,
                   double              gap,
                   const double       *rates,
                   double              time,
                   double              h,
                   std::vector<Touch> &touches);
} // namespace samara

#endif
