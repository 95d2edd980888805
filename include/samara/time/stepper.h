#ifndef samara_time_stepper_h
#define samara_time_stepper_h

#include <samara/time/integrator.h>
#include <samara/time/step_control.h>

#include <optional>

namespace samara
{
  /** What was done to get one step further. */
  struct Advance
  {
    StepResult   step;
    double       h          = 0;
    unsigned int n_rejected = 0, n_failed = 0; ///< attempts before it, too inaccurate or without a solution
  };



  /**
   * Goes from step to step: of fixed or chosen size, cut short where something prescribed has a corner or a law of the
   * state switches, halved where Newton's method finds no solution. Nothing is lost by a step that is rejected. Steps
   * of fixed size that crawl, two thousand in a tenth of the time of one, end the run: speeds grow without bounds where
   * no motion goes on, or a law switches for ever.
   */
  class Stepper
  {
  public:
    /** @p step: the fixed one, or the first one if there is a controller. */
    Stepper(const System &system, Integrator &integrator, double step, double smallest_step);
    Stepper(const System &system, Integrator &integrator, double step, const StepController::Settings &settings);

    /**
     * One step, not beyond @p end.
     * @throws NotConverged if the smallest step has no solution either; the state is then that of the last good step.
     */
    Advance advance(State &state, double end);

    /** All that later steps depend on besides the state, for restarts. */
    struct Memory
    {
      double              next_step; ///< to be tried next [s]
      std::vector<double> of_controller, of_error;
      std::vector<double> steady_twists;
      std::vector<double> window; ///< start [s] and number of the steps that are watched for progress; across [s];
                                  ///< switches that are counted
    };
    Memory memory() const;
    /** @p with_steps: go on with the step sequence; otherwise with the step that was given. */
    void set_memory(const Memory &memory, bool with_steps);

    /** The step to be tried next [s]. */
    double next_step;

    /** Local error of the last accepted step [m]. */
    double estimate = 0;

    std::optional<StepController> controller;
    std::optional<StepError>      error;

  private:
    const System       &system;
    Integrator         &integrator;
    const double        fixed_step, smallest_step;
    State               trial;
    std::vector<double> steady_twists; ///< of the start: kinetic energy counts without them

    std::vector<double> pieces, pieces_after; ///< of laws that switch
    double              across       = 0;     ///< length of the step that goes across a switch; 0: none is near [s]
    double              first_switch = 0;     ///< time of the first of the switches that are counted [s]
    unsigned int        n_switches   = 0;     ///< since, without as much as a step of the given size between them all

    double       window_start = 0; ///< of a tenth of the time that a full step takes [s]
    unsigned int n_in_window  = 0; ///< steps of the fixed size, or halves of it, since

    /** @throws NotConverged if very many steps together do not come as far as a tenth of a full one. */
    void require_progress(const State &before);
    /** "; the largest reaction, 3e9 N, is at joint a (prescribed rotation), then joint b" of a state, and what to try.
     */
    std::string about_reactions(const State &state) const;

    double corner(double from, double to) const;
    /** @throws NotConverged if laws switch again and again, and time does not go on. */
    void count_switch(double time);
    /** Shorten a step within which a law switches, so that it ends before. */
    void   stop_before_switch(const State &state, double &h, Advance &result);
    bool   attempt(const State &state, double &h, Advance &result);
    double energy_of_change(const State &state) const;
  };
} // namespace samara

#endif
