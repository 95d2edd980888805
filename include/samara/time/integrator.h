#ifndef samara_time_integrator_h
#define samara_time_integrator_h

#include <samara/time/stage_stops.h>
#include <samara/time/step_error.h>
#include <samara/time/work_of_air.h>

#include <optional>
#include <string>

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
    WorkOfAir    air;                     ///< part of the work of loads, and where it went
    double       friction_loss    = 0;    ///< of dry friction, not negative
    double       work_of_drives   = 0;    ///< of constraints that depend on time; zero to round-off for all others
    double       work_defect      = 0;    ///< Σ|N| of stops: what their energy would change by without correction
    double       last_correction  = 0;    ///< size of the last Newton correction of velocities, relative
    bool         is_finite        = true; ///< what acts; if not, the worst unknown is where it is not
    int          unresolved_state = -1;   ///< of first order, that the step does not resolve; -1: none
    std::string  refusal;   ///< why a step that Newton's method found is not accepted; empty: it is, or was not found
    unsigned int worst = 0; ///< unknown with the largest force left; if converged, with the most work left
    int          worst_constraint =
      -1; ///< if converged, the multiplier with the largest force of those that act there; -1: none

    std::optional<System::Energy> energy; ///< at the end, where the integrator knows it

    std::vector<Touch>       touches; ///< stops that were touched or left in the step
    std::vector<TouchedStop> touched_stops;
    std::vector<double>      creep;      ///< of Layout::frictions: way of slips so slow that they should stick [m]
    StepDifference           difference; ///< what it says about its error; see wants_estimates
  };



  /** What users say of an integrator, for all kinds; each takes what it knows. */
  struct IntegratorSettings
  {
    double       spectral_radius  = 0.5;   ///< at infinite frequency
    double       newton_tolerance = 1e-10; ///< change of velocities, relative to the largest
    unsigned int max_iterations   = 50;    ///< with one factorisation
    double       tolerance        = 1e-4;  ///< relative, of positions, triads and velocities; of BDF
    unsigned int n_stages         = 3;     ///< of the family
  };



  /** What not every kind of integrator can do. */
  struct IntegratorAbilities
  {
    bool states       = false; ///< solves states of first order
    bool virtual_mass = false; ///< knows inertia that is no part of the bodies, as that of the air
    bool friction     = false; ///< dry friction
    bool is_family    = false; ///< Integrator::family(): steps of chosen size, rows left out, restarts to the last bit
  };



  /** What advances the state of a system in time, over the assembled system only. */
  class Integrator
  {
  public:
    virtual ~Integrator() = default;

    /** Of this kind; one that can do more has a member of its own by this name. */
    static constexpr IntegratorAbilities abilities{};

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

    /** What was more than plain steps, so far, for reports. */
    struct Remarks
    {
      unsigned int n_exact_steps        = 0; ///< repeated with the exact matrix of all stages
      unsigned int n_exchanges          = 0; ///< of redundant rows that are left out
      double       largest_gap_left_out = 0; ///< of such a row, as a length [m]
      unsigned int worst_left_out       = 0; ///< its multiplier
    };
    virtual Remarks
    remarks() const
    {
      return {};
    }
  };
} // namespace samara

#endif
