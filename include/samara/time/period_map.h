#ifndef samara_time_period_map_h
#define samara_time_period_map_h

#include <samara/time/increment.h>
#include <samara/time/projection.h>
#include <samara/time/step_tangent.h>

#include <memory>
#include <vector>

namespace samara
{
  /** How a period is gone through. */
  struct PeriodSettings
  {
    double       period           = 0;  ///< [s]
    unsigned int n_steps          = 36; ///< a period
    unsigned int n_stages         = 3;  ///< of the integrator family
    double       spectral_radius  = 1;  ///< of the same, at infinite frequency
    double       newton_tolerance = 1e-12;
    unsigned int max_iterations   = 50;
    double       tangent_tolerance = 1e-13; ///< of the linear equations of each step, see StepTangent::tolerance
  };



  /**
   * The motion of a system over one period in steps of equal size, and the exact derivative of where it ends by where
   * it begins, applied to vectors: for Floquet's theory, and for Newton's method on periodicity
   * (doc/theory/floquet.md).
   *
   *     PeriodMap map(system, settings);
   *     const State end = map.linearize(start);     // the steps are kept
   *     map.apply(x);                               // x: an increment of the start (increment.h), becomes that of the
   * end
   *
   * The map is x(0) → Π x(T): at the end of the period, or of each of its sections, velocities are replaced by the
   * nearest that constraints allow (Projection::velocities()), which changes them by the integrator's own error.
   * Without it velocities against constraints would be kept for ever by a scheme that dissipates nothing, and be found
   * as multipliers of size one. Π is differentiated with everything else.
   *
   * Whoever starts from a state that is to be periodic should have made its velocities admissible, too: project().
   */
  class PeriodMap
  {
  public:
    /** @throws std::invalid_argument for a period or a number of steps that make no sense */
    PeriodMap(const System &system, const PeriodSettings &settings);

    const PeriodSettings settings;

    /** Solve linear equations of the steps that are kept to @p tolerance; linearize() takes that of the settings. */
    void set_tolerance(double tolerance);

    /** The state a period after @p start, whose time goes on. @throws NotConverged if a step has no solution. */
    State march(const State &start);

    /**
     * The same; steps and their tangents are kept for apply(), in place of those of a period before.
     * @throws NotConverged also where a step has no derivative, see StageIntegrator::linearize().
     */
    State linearize(const State &start);

    /** Numbers in an increment, and where in it velocities begin. @{ */
    unsigned int
    size() const
    {
      return size_of_increment(system.layout);
    }
    unsigned int
    first_velocity() const
    {
      return system.layout.of_multiplier(0);
    }
    /** @} */

    /** Replace an increment of the start by that of the end. @throws NotConverged as StepTangent::apply(). */
    void apply(double *x);

    /** Replace an increment before step @p i of those kept by that behind it, without Π at the end of the last one. */
    void apply_step(double *x, unsigned int i);

    /** The state a period after @p start, and the increment @p x of the start becomes that of the end; nothing is kept.
     */
    State carry(const State &start, double *x);

    /** Let @p x, an increment of a state, become that of the state with admissible velocities. */
    void project_increment(const State &state, double *x);

    /** Make velocities admissible; returns the change relative to the largest velocity. */
    double
    project(State &state)
    {
      return projection.velocities(state);
    }

    /** The states of the period that was linearised, n_steps + 1. */
    const std::vector<State> &
    states() const
    {
      return along;
    }

    /** Products with the matrix of stages in all applications so far. */
    unsigned int n_products() const;

    unsigned int n_applied    = 0; ///< steps through which increments were taken so far
    unsigned int n_iterations = 0; ///< of Newton's method, of all steps so far

    /** Of the integrators whose steps are kept. */
    unsigned int n_factorizations() const;

  private:
    const System                                 &system;
    Projection                                    projection;
    std::vector<std::unique_ptr<StageIntegrator>> integrators; ///< with factors of different parts of the period
    std::vector<std::unique_ptr<StepTangent>>     tangents;    ///< one a step
    std::vector<State>                            along;
    State                                         raw_end; ///< before velocities are projected

    double
    step_size() const
    {
      return settings.period / settings.n_steps;
    }
    std::unique_ptr<StageIntegrator> make_integrator() const;
    void                             step(StageIntegrator &integrator, State &state);
    /** Of velocities, then of states of first order: of algebraic ones. */
    std::vector<double>              correction_of_velocities(const State &state, const double *x, double factor);
  };
} // namespace samara

#endif
