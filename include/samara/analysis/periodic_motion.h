#ifndef samara_analysis_periodic_motion_h
#define samara_analysis_periodic_motion_h

#include <samara/analysis/analysis.h>
#include <samara/analysis/repeated_parts.h>
#include <samara/time/increment.h>
#include <samara/time/integrator.h>
#include <samara/time/period_map.h>

#include <cmath>
#include <memory>
#include <optional>

namespace samara
{
  /** The mean over a period of a probe, or one of its harmonics: 2/T ∫ y cos(n 2π t/T) dt. */
  struct PeriodAverage
  {
    enum Part
    {
      mean,
      cosine,
      sine
    };
    Part         part     = mean;
    unsigned int harmonic = 0;
    Probe        probe;

    /** What a value @p y of the probe at the phase 2π t/T counts. */
    double weighted(double y, double phase) const;
  };



  /**
   * Turns of a motion that may be periodic, all over the same time from t₀ to t₀ + T: n steps of equal size of the
   * integrator family. Averages are sums over the ends of steps, which for periodic functions converge faster than any
   * power of the step.
   *
   * Angles of joints count turns; of those that are prescribed to go on, whole turns are taken back before the next
   * period begins.
   *
   * With Q repeated parts (repeat()) a turn is a Q-th of the period, a section, behind which parts are renumbered:
   * where one comes, the next one was. Averages are those of the whole period still, in which each part does what the
   * others have done in the section. That parts are alike is not known here: who uses it compares with a whole period.
   */
  class PeriodicMotion
  {
  public:
    /** @p settings: of the integrator family. */
    PeriodicMotion(const Context                    &context,
                   double                            period,
                   unsigned int                      n_steps,
                   const IntegratorSettings         &settings,
                   const std::vector<PeriodAverage> &averages);

    const double       period;
    const unsigned int n_steps; ///< a period

    /** Turns become sections of as many repeated parts, whose axes must be aligned as built. */
    void repeat(const RepeatedParts &repeated);

    /** Q; 1 without repeated parts. */
    unsigned int
    n_sections() const
    {
      return parts ? parts->n() : 1;
    }
    unsigned int
    steps_of_turn() const
    {
      return n_steps / n_sections();
    }

    /**
     * What happens after each step of a turn: with the number of the step, values of the averages' probes there, and
     * behind them those of the Q - 1 other sections.
     */
    using Observer = std::function<void(State &state, unsigned int step, const std::vector<double> &values)>;

    /**
     * March one period from @p state, which is then its end, at the time t₀ + T. Returns the averages.
     * @throws NotConverged
     */
    std::vector<double> turn(State &state, const Observer &observer = {});

    /**
     * March one period from @p start, and keep the tangents of its steps for apply(), the equations of each solved to
     * @p tolerance. Counts as a turn.
     * @throws NotConverged where a step has no solution or no derivative
     */
    void linearize(const State &start, double tolerance = 1e-8);

    /**
     * An increment @p x of the start of the turn that was linearised becomes that of its end, velocities as they are
     * there. Returns what the averages change by: exact in the motion, central differences of the probes.
     * @throws NotConverged as StepTangent::apply()
     */
    std::vector<double> apply(double *x);

    /**
     * The same period again: from t + T to t, with whole turns of angles as at @p start taken back; or the same
     * section, renumbered.
     */
    void begin_again(const State &start, State &end) const;

    /** The state at the same instant of the section behind, where each part has come to the place of the next. */
    State in_next_section(const State &state) const;

    /** What is not periodic between @p start and @p end a turn later: the increment, without whole turns. */
    std::vector<double> gap(const State &start, const State &end) const;

    /** The largest entry of a gap in its scale, and which it is; the first that is not a number if there is one. */
    struct Largest
    {
      double       size;
      unsigned int entry;
    };
    Largest largest(const std::vector<double> &gap) const;

    /** What values as an observer gets them, of the probe of average @p k at a time, count: all sections together. */
    double weighted(unsigned int k, const std::vector<double> &values, double time) const;

    /** The probes of the averages, as they are reported, and what they change by where the increment of a state is @p
     * x. @{ */
    std::vector<double> values(const State &state, Projection &projection) const;
    std::vector<double> change_of_values(const State &state, const double *x, Projection &projection) const;
    /** @} */

    /** Of increments, velocities over T/2π: scales_of_increment(). */
    const std::vector<double> scales;

    /** What entry @p i of an increment is, for messages. */
    std::string name_of(unsigned int i) const;

    unsigned int n_turns   = 0; ///< that have been marched, or sections of them
    unsigned int n_applied = 0; ///< increments that were taken through a turn, or a section
    unsigned int n_marched = 0, n_iterations = 0, n_factorizations = 0; ///< steps, and what they took

  private:
    const System                    &system;
    const IntegratorSettings         settings;
    const std::vector<PeriodAverage> averages;
    bool                             needs_velocities = false, needs_forces = false;

    std::unique_ptr<PeriodMap>   map; ///< of the turn that was linearised
    std::optional<RepeatedParts> parts;

    /** values() and change_of_values() of all sections, one after another. @{ */
    std::vector<double> all_values(State state, Projection &projection) const;
    std::vector<double> all_changes(State state, const double *x, Projection &projection) const;
    /** @} */

    /** @p y at a time are added to @p sums of a turn, by the number of the step they are at the end of; 0: the start.
     */
    void add(std::vector<double> &sums, const std::vector<double> &y, double time, unsigned int step) const;
  };
} // namespace samara

#endif
