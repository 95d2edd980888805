#ifndef samara_time_stepper_h
#define samara_time_stepper_h

#include <samara/model/bends.h>
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

    std::vector<std::string> left; ///< what was let go where the step ended, or began, see CanLeave
  };



  /**
   * Goes from step to step: of fixed or chosen size, cut short where something prescribed has a corner or a law of the
   * state switches, halved where Newton's method finds no solution. Where something leaves what held it, as a bead the
   * end of a rod, the length of the step is an unknown: it ends there. Nothing is lost by a step that is rejected.
   * Steps of fixed size that crawl, two thousand in a tenth of the time of one, end the run: speeds grow without bounds
   * where no motion goes on, or a law switches for ever.
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

    std::vector<Bend>   bends;                ///< of all items
    std::vector<double> pieces, pieces_after; ///< of laws that switch
    double              across = 0;           ///< length of the step that goes across a switch; 0: none is near [s]

    /** A fixed step that was too long to have a solution: each time it fails again it is left for twice as long. */
    struct TooLong
    {
      double       length = 0; ///< that failed last [s]; 0: none
      unsigned int pause  = 0; ///< steps that are made before it is tried again
      unsigned int left   = 0; ///< of these

      void failed(double h);
      /** Whether a step of @p h may be tried after one that succeeded. */
      bool may_try(double h);
      void succeeded(double h);
    };
    TooLong too_long;
    /** What happens in a short time, counted: when it was first, and how often since. */
    struct Count
    {
      double       start = 0; ///< [s]
      unsigned int n     = 0;

      /** One more at @p time; those a @p window [s] ago and more are forgotten. Returns how many. */
      unsigned int add(double time, double window);
    };
    Count steps;    ///< of the fixed size, or halves of it, within a tenth of one
    Count switches; ///< of laws, within a step

    /** @throws NotConverged if very many steps together do not come as far as a tenth of a full one. */
    void require_progress(const State &before);
    /** "; the largest reaction, 3e9 N, is at joint a (prescribed rotation), then joint b" of a state, and what to try.
     */
    std::string about_reactions(const State &state) const;

    double corner(double from, double to) const;
    /** What the controller compares with, from the state at the start of the run. */
    void start_control(const State &state);
    /** Time at which the next step ends at the latest: the next corner, if it is near. */
    double limit_of_step(double time, double end) const;
    /** The part of a step of @p h before a bend, by the rates, so that it need not be made in vain. */
    double part_before_bends(const State &state, double h);
    /** Whether the step is accurate enough; if not, @p h is the one to be tried. Sets the next step. @p tried: before
     * it was cut short. */
    bool is_accepted(double tried, double &h, Advance &result);
    /** @throws NotConverged if laws switch again and again, and time does not go on. */
    void count_switch(double time);
    /** Shorten a step that goes into a bend or across it, so that it ends where the bend begins, or
     * where it ends; left as it is if that is not found. */
    void stop_at_bends(const State &state, double &h, Advance &result);
    /** How much of a step of which a coordinate goes @p from ... @p to may be made for a bend; 1 if all of it. */
    static double part_until(const Bend &bend, double from, double to);
    /** Of the step, by the coordinates before and after it. */
    double part_until_bends(const std::vector<double> &from, const std::vector<double> &to) const;
    /**
     * @name Exits (stepper_leaving.cc)
     * @{
     */
    struct Exit
    {
      const CanLeave *item;
      CanLeave::Exits places;

      /** How far the state is beyond, in lengths; negative before, and of what has left already. */
      double beyond(const State &state) const;
    };
    std::vector<Exit>         exits;
    std::vector<unsigned int> going;    ///< numbers of those that are at their exit where the trial ends
    double                    lost = 0; ///< kinetic energy of velocities that the constraints before did not allow [J]

    void   find_exits();
    double farthest_beyond(const State &state) const;
    /** Shorten a step that goes beyond an exit so that it ends there. False if something is at its exit where the step
     * begins: that is let go from the state, and the step is to be made again. */
    bool stop_at_exits(State &state, double &h, Advance &result);
    /** Let them go, with velocities that the constraints before allow. */
    void let_go(std::vector<unsigned int> those, State &state, Advance &result);
    /** @} */

    /** Shorten a step within which a law switches, so that it ends before. */
    void stop_before_switch(const State &state, double &h, Advance &result);
    /** The trial after a step of @p h. */
    bool   has_solution(const State &state, double h, Advance &result);
    bool   attempt(const State &state, double &h, Advance &result);
    double energy_of_change(const State &state) const;
  };
} // namespace samara

#endif
