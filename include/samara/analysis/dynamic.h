#ifndef samara_analysis_dynamic_h
#define samara_analysis_dynamic_h

#include <samara/analysis/analysis.h>
#include <samara/analysis/contacts.h>
#include <samara/analysis/line_of_air.h>
#include <samara/output/checkpoint.h>
#include <samara/output/history.h>
#include <samara/output/pictures.h>
#include <samara/time/integrators.h>
#include <samara/time/projection.h>
#include <samara/time/stepper.h>

#include <memory>

namespace samara
{
  /**
   * Motion in time from the context's state: an equilibrium that a static analysis has found, at rest or in steady
   * rotation, or the reference configuration; velocities given by the bodies are added and made to obey the constraints
   * (the paper, sections 3 and 4.2; doc/theory/integrators.md).
   *
   * Writes dynamic.csv (.h5) with the probes, dynamic_energy.csv with the energy budget, dynamic_steps.csv with the
   * steps, dynamic_stops.csv with the contacts of stops, dynamic.pvd with the moving model, and dynamic.checkpoint from
   * which a run is continued (--restart).
   *
   * Every steps_between_fresh_starts() steps of the integrator family everything that remembers (factors, pivots,
   * extrapolation) is made anew from what a checkpoint holds. Checkpoints are those moments, so that a run that is
   * continued has the numbers of one that was not interrupted, to the last bit.
   */
  class DynamicAnalysis : public Analysis
  {
  public:
    /** @p integrators: those that its entry <Integrator> can name. */
    explicit DynamicAnalysis(const std::shared_ptr<const Integrators> &integrators);

    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void run(Context &context) override;

    bool
    can_restart() const override
    {
      return true;
    }

    bool
    is_of_one_speed() const override
    {
      return true;
    }

    std::optional<Effort>
    effort() const override
    {
      return Effort{double(report.n_steps), double(report.n_iterations), double(report.n_factorizations)};
    }

    /** What the run took. */
    struct Report
    {
      unsigned int n_steps = 0, n_iterations = 0, n_factorizations = 0, n_rejected = 0, n_failed = 0, n_touches = 0;
      double       seconds = 0, processor_seconds = 0; ///< by the clock; of the processor, all threads [s]

      unsigned int n_exact_steps = 0, n_exchanges = 0; ///< see StageIntegrator
      double       largest_gap_left_out = 0;           ///< of constraints that are left out [m]
      std::string  worst_left_out;                     ///< the name of that constraint

      /** @name The energy account, relative to the largest energy that moved (DynamicAnalysis::judge()) @{ */
      double      largest_balance = 0; ///< of the energy that does not close
      double      largest_gap     = 0; ///< the same [J]
      double      largest_miss    = 0; ///< of a single step [J], which is this one:
      double      worst_time      = 0; ///< [s]
      std::string worst_place;         ///< where Newton's method left most work in it
      bool        does_close = true;   ///< within what the Newton tolerance explains
      /** @} */

      /** @name States of first order that steps do not resolve @{ */
      unsigned int n_unresolved     = 0; ///< steps that do not
      double       first_unresolved = 0; ///< time of the first one [s]
      std::string  unresolved_state;     ///< which it was there
      /** @} */

      /** @name What a step is, at most @{ */
      double turn           = 0; ///< of a body [rad]
      double indicator      = 0; ///< D/α [J]
      double work_defect    = 0; ///< of the stops [J]
      double largest_energy = 0; ///< of what moved [J]
      double error          = 0; ///< what the errors of adaptive steps add up to [m]
      double length         = 0; ///< that it is a part of [m]
      /** @} */
    };
    Report   report;
    Contacts contacts; ///< of stops; those of the integrator family

    /** Energies since the start [J]. */
    struct Budget
    {
      double    kinetic = 0, strain = 0, potential = 0;
      double    loads = 0, drives = 0, viscous = 0, friction = 0, dissipated = 0; ///< loads: but those of the air
      WorkOfAir air;
      double    start = 0; ///< kinetic + strain + potential energy at the start

      /** What does not close; round-off. */
      double
      balance() const
      {
        return kinetic + strain + potential - start - loads - air.on_model - drives + viscous + friction + dissipated;
      }
    };
    Budget budget;

    /** Steps from one fresh start to the next; by the number of unknowns if fresh_every is 0. */
    unsigned int steps_between_fresh_starts(const System &system) const;
    unsigned int fresh_every = 0;

    /** To be called with the reported state at each output; for tests and studies. */
    std::function<void(const State &)> observer;

    // entries
    double start_time = 0, end_time = 1, step = 1e-3, tolerance = 1e-4, smallest_step = 1e-10, largest_step = 0,
           tolerance_holds_for = 0, length = 0, spectral_radius = 0.5, newton_tolerance = 1e-10,
           seconds_between_checkpoints = 60;
    unsigned int n_stages = 3, output_every = 1, n_pictures = 100, max_iterations = 50;
    std::string  control = "fixed", inconsistent = "project", integrator = "family", energy_balance = "refuse";
    bool         second_estimate = false;

  private:
    void add_step_parameters(Parameters &prm);
    void add_integrator_parameters(Parameters &prm);

    struct Output;
    class Run;
    const std::shared_ptr<const Integrators> integrators;

    double energy_floor     = 0; ///< of a motion by a millionth of the model in the run [J]
    double n_judged         = 0; ///< steps so far
    double first_strain     = 0; ///< energy at the start [J]
    double round_off_of_sum = 0; ///< of the terms of the balance, at most in any step [J]

    void set_energy_floor(const System &system);
    /** Judge the account of a step: what it misses, relative to the energies that moved so far. */
    void judge(const Context &context, const Advance &advance, double time, double balance_before);
    /** What a step is, in radians and as an error; nothing for integrators that do not tell. */
    std::string resolution(const Integrator &integrator) const;
    /** "a <Step> of about 1e-3 s would do", for an error of this order that shall be @p excess times smaller. */
    std::string finer(double excess, double order) const;
    /** Warn of energy that the integrator has taken, and of stops within steps, beyond 1e-3 of the largest energy. */
    void tell_losses(const Context &context) const;
    /** Warn where fixed steps were mostly too long to have a solution. */
    void tell_halved_steps(const Context &context) const;
    /** Say what does not hold. @throws NotConverged if the energy account does not close, unless told otherwise. */
    void conclude(const Context &context) const;
    struct Machinery;
    double        n_rows     = 0; ///< steps on the grid since the start; of each of <Output every> a row is written
    unsigned long n_grid     = 0; ///< steps of the grid that are done
    unsigned int  n_recorded = 0;
    CoarseMeshes  meshes;
    LineOfAir     air;

    std::unique_ptr<Integrator> make_integrator(const System &system, double tolerance) const;
    /** Up to round-off of the whole time. */
    bool is_end(double time) const;
    /** Whether it is the family of this program. */
    bool      is_family() const;
    Machinery make_machinery(const System &system) const;
    Machinery make_machinery(const System &system, const Checkpoint &memory, bool with_steps) const;

    /** @name Restarts (dynamic_restart.cc) @{ */
    Checkpoint remember(const Context &context, const State &state, const Machinery &machinery, const Output &output);
    /** @throws InputError if there is no checkpoint, or one of another model */
    Checkpoint restore(const Context &context, bool &with_steps);
    /** Numbers by their names in a checkpoint, to be saved and restored. */
    std::vector<std::pair<std::string, double *>> remembered_numbers();
    /** @} */
    void record(const Context &context, const State &state, Projection &projection, Output &output);
    /** Into a picture, and onto the page of the report. */
    void show(const Context &context, const State &state, bool is_picture, bool is_on_page, Output &output) const;
    void account(const Context &context, const State &state, const StepResult &step);
    double
    half_steps(const Context &context, const State &start, const State &end, double h, Integrator &integrator) const;
    /** Into the report what an integrator that ends here has counted. */
    void collect(const Context &context, const Integrator &integrator);
    void summarize(const Context &context, const Integrator &integrator) const;
  };
} // namespace samara

#endif
