#ifndef samara_time_integrator_h
#define samara_time_integrator_h

#include <samara/time/stage_stops.h>
#include <samara/time/step_error.h>

#include <optional>

namespace samara
{
  struct Tableau;

  /** What a step did. Energies in J over the step. */
  struct StepResult
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       dissipated = 0; ///< numerically, D ≥ 0
    double       indicator  = 0; ///< D/α, also for α = 0: how much there would be to dissipate; see wants_estimates
    double       work_of_loads = 0, viscous_loss = 0;
    double       work_of_drives  = 0; ///< of constraints that depend on time; zero to round-off for all others
    double       work_defect     = 0; ///< Σ|N| of stops: what their energy would change by without correction
    double       last_correction = 0; ///< size of the last Newton correction of velocities, relative
    bool         is_finite        = true; ///< what acts; if not, the worst unknown is where it is not
    int          unresolved_state = -1;   ///< of first order, that the step does not resolve; -1: none
    unsigned int worst           = 0; ///< unknown with the largest force left; if converged, with the most work left
    int          worst_constraint =
      -1; ///< if converged, the multiplier with the largest force of those that act there; -1: none

    std::optional<System::Energy> energy; ///< at the end, where the integrator knows it

    std::vector<Touch>       touches; ///< stops that were touched or left in the step
    std::vector<TouchedStop> touched_stops;
    StepDifference           difference; ///< what it says about its error; see wants_estimates
  };



  /** What advances the state of a system in time, over the assembled system only. */
  class Integrator
  {
  public:
    virtual ~Integrator() = default;

    /** Advance @p state by @p h; it is unchanged if the result says not converged. */
    virtual StepResult step(State &state, double h) = 0;

    /** To be called when the state has been changed from outside. */
    virtual void
    forget_history()
    {}

    /** To be called when the last step is not accepted: the next one begins where it began. */
    virtual void
    step_back()
    {}

    /** The relation of dissipated energy to accuracy by which steps are controlled; none: steps are fixed. */
    virtual const Tableau *
    family() const
    {
      return nullptr;
    }

    /**
     * Whether steps are judged: then StepResult::difference is found, and velocities at the start are made to obey the
     * constraints for the indicator.
     */
    bool wants_estimates = false;

    unsigned int n_steps = 0, n_iterations = 0, n_factorizations = 0; ///< for reports
  };
} // namespace samara

#endif
