// A run of the dynamic analysis, from its start or a checkpoint to its end: steps, what is counted of them, and files.

#include <samara/analysis/dynamic_parts.h>
#include <samara/analysis/near_redundancy.h>
#include <samara/analysis/start_of_motion.h>
#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/text.h>
#include <samara/model/algebraic_states.h>
#include <samara/model/contact_group.h>
#include <samara/report/report_page.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <unordered_set>

namespace samara
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    double
    seconds_since(const Clock::time_point &t)
    {
      return std::chrono::duration<double>(Clock::now() - t).count();
    }



    /** Of all bodies [rad/s]. */
    double
    largest_spin(const State &state)
    {
      double square = 0;
      for (unsigned int i = 6; i < state.y.size(); i += 6)
        square = std::max(square, Eigen::Map<const Vector3>(&state.y[i + 3]).squaredNorm());
      return std::sqrt(square);
    }
  } // namespace



  namespace
  {
    /** Of states of first order that adaptive steps know nothing of. */
    void
    warn_of_states(const Context &context)
    {
      const Model                     &model = context.system.model;
      std::unordered_set<unsigned int> known;
      for (const CountedStates &group : counted_states(model))
        known.insert(group.states.begin(), group.states.end());
      for (const unsigned int i : algebraic_states(model)) // what they follow counts
        known.insert(i);
      const unsigned int others = model.states.size() - known.size();
      if (others == 0)
        return;
      unsigned int first = 0;
      while (known.count(first) > 0)
        ++first;
      context.log.warning(
        "dynamic",
        "adaptive steps are chosen by what moves, by states of the air and by states with a <Weight>, and so is the "
        "error that is told: " +
          (others == 1 ? "the state <" + model.states[first].name + "> does" :
                         std::to_string(others) + " other states of first order, <" + model.states[first].name +
                           "> among them, do") +
          " not count. Let the <Largest step> be small beside what they follow");
    }
  } // namespace



  /** What lasts as long as a run does; what it finds stands in the analysis. */
  class DynamicAnalysis::Run
  {
  public:
    /** Where it begins. @throws InputError */
    Run(DynamicAnalysis &analysis, Context &context);

    /** To the end. @throws NotConverged, Interrupted, CannotWrite; everything up to there is written. */
    void go();

  private:
    DynamicAnalysis        &analysis;
    Context                &context;
    const System           &system;
    const Clock::time_point clock_start     = Clock::now();
    const std::clock_t      processor_start = std::clock();
    const bool              is_adaptive;

    bool       with_steps = true; ///< of the checkpoint, if the run goes on from one
    Checkpoint last;              ///< to be written next, or written
    State      state;
    Machinery  machinery;
    Output     output;
    const bool can_be_exact; ///< when it is continued: the numbers are those of a run without a break

    const double      begin; ///< [s]
    Report            before_machinery;
    unsigned int      n_since_fresh = 0, n_factorizations = 0;
    bool              is_saved, is_ringing                = false; ///< whether that has been told
    Clock::time_point last_progress = clock_start, last_checkpoint = clock_start;
    State             before;                              ///< where the step began, for the second estimate
    double            first_kinetic = 0, first_strain = 0; ///< largest energies of the first tenth of the run [J]
    bool              has_told_growth = false;
    SingularPositions singular;

    State first_state();
    void  open_account();
    void  step();
    void  count(const Advance &advance, double from);
    void  warn_of_ringing();
    /** Say so, once, where energies have grown far beyond those of the first tenth of the run. */
    void   tell_growth();
    double second_estimate(double from);
    void   write_step(const Advance &advance, double from, double second);
    /** On the terminal, and on the page of the report while that is watched. */
    void        show_progress();
    std::string progress() const;
    void        begin_afresh();
    void        save();
    void        close();
    /** One that does not close: forces that have come up since the start have their round-off, too. */
    void        look_at_account_again();
    void        stop_if(bool is_interrupted);
  };



  DynamicAnalysis::Run::Run(DynamicAnalysis &analysis, Context &context)
    : analysis(analysis)
    , context(context)
    , system(context.system)
    , is_adaptive(analysis.control == "adaptive")
    , state(first_state())
    , machinery(context.restart ? analysis.make_machinery(system, last, with_steps) : analysis.make_machinery(system))
    , output(context, analysis, state.time, context.restart ? &last : nullptr)
    , can_be_exact(machinery.integrator->family() != nullptr)
    , begin(state.time)
    , is_saved(context.restart)
    , singular(system)
  {
    singular.look(state);
    open_account();
    before_machinery = analysis.report;
    n_factorizations = analysis.report.n_factorizations;
    if (context.restart)
      return;
    if (!context.folder.empty())
      std::filesystem::remove(checkpoint_file(context)); // of an earlier run
    analysis.record(context, state, *machinery.projection, output);
    last = analysis.remember(context, state, machinery, output);
    // a run that goes on from here has factors of its own: pivots that the first report chose round otherwise
    machinery.projection = std::make_unique<Projection>(system);
  }



  State
  DynamicAnalysis::Run::first_state()
  {
    if (context.restart)
      {
        last = analysis.restore(context, with_steps);
        return last.state;
      }
    return start_of_motion(
      context,
      {analysis.parameters.where(), analysis.start_time, analysis.is_family(), analysis.inconsistent == "refuse"});
  }



  void
  DynamicAnalysis::Run::open_account()
  {
    Budget    &budget = analysis.budget;
    const auto energy = system.energy(state);
    budget.kinetic    = energy.kinetic;
    budget.strain     = energy.strain;
    budget.potential  = system.potential_energy(state.point());
    if (!context.restart)
      {
        budget.start = budget.kinetic + budget.strain + budget.potential;
        analysis.set_energy_floor(system);
        analysis.round_off_of_sum = round_off_of_strain_energy(system, state);
      }
    else if (!can_be_exact)
      context.log.line("restart: the integrator <" + analysis.integrator +
                       "> begins afresh here; results are those of an uninterrupted run within its error");
  }



  void
  DynamicAnalysis::Run::go()
  {
    const InterruptGuard interrupt;
    try
      {
        while (!analysis.is_end(state.time))
          {
            stop_if(interrupt.was_interrupted());
            step();
            show_progress();
            begin_afresh();
            if (seconds_since(last_checkpoint) > analysis.seconds_between_checkpoints && (!is_saved || !can_be_exact))
              {
                save();
                is_saved        = true;
                last_checkpoint = Clock::now();
              }
          }
      }
    catch (const NotConverged &problem)
      {
        close();
        const std::string near = singular.near();
        throw NotConverged(
          std::string("dynamic analysis: ") + problem.what() +
          "\n  everything up to there is written; try a smaller <Step>, <Step control = adaptive>, more damping "
          "(<Spectral radius = 0>), or look whether the mechanism locks there" +
          (near.empty() ? "" : ": the position is next to a singular one, by " + near));
      }
    catch (const CannotWrite &problem)
      {
        std::string text = problem.what();
        text += " What was written until t = " + number_to_text("%.6g", state.time) + " s is kept";
        if (std::filesystem::exists(checkpoint_file(context)))
          text += "; make room, and samara --restart goes on from the last checkpoint";
        throw CannotWrite(text + ".");
      }
    close();
    look_at_account_again();
    analysis.collect(context, *machinery.integrator);
    analysis.summarize(context, *machinery.integrator);
    if (const std::string text = singular.text(); !text.empty())
      context.log.line(text);
    analysis.meshes.conclude(context, "dynamic");
    analysis.conclude(context);
  }



  void
  DynamicAnalysis::Run::look_at_account_again()
  {
    Report &report = analysis.report;
    if (report.does_close || !std::isfinite(analysis.budget.balance()))
      return;
    double &round_off = analysis.round_off_of_sum;
    round_off         = std::max(round_off, round_off_of_strain_energy(system, state));
    report.does_close = account_closes(
      report.largest_gap, report.largest_energy, analysis.n_judged, analysis.newton_tolerance, round_off);
  }



  void
  DynamicAnalysis::Run::stop_if(const bool is_interrupted)
  {
    if (!is_interrupted)
      return;
    close();
    throw Interrupted("interrupted at t = " + number_to_text("%.6g", state.time) +
                      " s; everything up to there is written, and samara --restart goes on");
  }



  void
  DynamicAnalysis::Run::step()
  {
    // fixed steps keep to their grid, whatever happens in between
    const double goal = is_adaptive ?
                          analysis.end_time :
                          std::min(analysis.end_time, analysis.start_time + (analysis.n_grid + 1) * analysis.step);
    if (analysis.second_estimate)
      before = state;
    const double  from    = state.time;
    const Advance advance = machinery.stepper->advance(state, goal);
    count(advance, from);
    tell_growth();
    for (const std::string &text : advance.left)
      context.log.line(text);
    singular.look(state);
    write_step(advance, from, second_estimate(from));
    // the step was cut short before its goal: it is no point of the grid of fixed steps
    if (!is_adaptive && state.time < goal - 1e-9 * analysis.step)
      return;
    ++analysis.n_grid;
    ++analysis.n_rows;
    if (std::lround(analysis.n_rows) % analysis.output_every == 0 || analysis.is_end(state.time))
      analysis.record(context, state, *machinery.projection, output);
  }



  void
  DynamicAnalysis::Run::tell_growth()
  {
    // what falls from rest has a hundred times the kinetic energy of its first tenth at the end
    constexpr double far_more_strain = 100, far_more_speed = 1000, first_part = 0.1;
    const Budget    &budget = analysis.budget;
    if (has_told_growth || context.restart)
      return;
    if (state.time < analysis.start_time + first_part * (analysis.end_time - analysis.start_time))
      {
        first_kinetic = std::max(first_kinetic, budget.kinetic);
        first_strain  = std::max(first_strain, budget.strain);
        return;
      }
    const bool is_strain = first_strain > 0 && budget.strain > far_more_strain * first_strain,
               is_speed  = first_kinetic > 0 && budget.kinetic > far_more_speed * first_kinetic;
    if (!is_strain && !is_speed)
      return;
    has_told_growth = true;
    context.log.line(
      "dynamic: the motion grows: at t = " + short_text(state.time) + " s its " +
      (is_strain ? "strain energy is " + short_text(far_more_strain) :
                   "kinetic energy is " + short_text(far_more_speed)) +
      " times the largest of the first tenth of the run. If nothing drives it so, it is unstable: flutter, "
      "friction or a law feeds it");
  }



  void
  DynamicAnalysis::Run::count(const Advance &advance, const double from)
  {
    const Budget &budget      = analysis.budget;
    const double  before_step = budget.balance();
    analysis.account(context, state, advance.step);
    if (!std::isfinite(budget.kinetic + budget.strain + budget.potential))
      require_finite_state(system, state);
    analysis.judge(context, advance, from, before_step);
    if (machinery.redundant)
      require_rows_left_out(*machinery.redundant, state);

    Report           &report     = analysis.report;
    const Integrator &integrator = *machinery.integrator;
    report.n_steps               = before_machinery.n_steps + integrator.n_steps;
    report.n_iterations          = before_machinery.n_iterations + integrator.n_iterations;
    report.n_factorizations      = before_machinery.n_factorizations + integrator.n_factorizations;
    report.n_rejected += advance.n_rejected;
    report.n_failed += advance.n_failed;
    report.n_touches += advance.step.touches.size();
    analysis.contacts.add(advance.step, from, state.time);
    if (machinery.stepper->controller)
      {
        report.error += machinery.stepper->estimate;
        report.length = machinery.stepper->controller->size;
      }
    report.turn = std::max(report.turn, advance.h * largest_spin(state));
    warn_of_ringing();
  }



  void
  DynamicAnalysis::Run::warn_of_ringing()
  {
    // what sticks has velocities that change their sign from step to step; Newton's method finds none, and steps are
    // halved
    constexpr unsigned int times_more = 20, not_at_once = 200, most_times_more = 100, most_at_once = 500;
    const Layout          &layout = system.layout;
    const double           asked = analysis.n_grid + 1, made = analysis.report.n_steps;
    const bool             is_end = made >= most_at_once + most_times_more * asked;
    if ((is_ringing && !is_end) || is_adaptive || analysis.spectral_radius < 1 ||
        made < not_at_once + times_more * asked ||
        (layout.frictions.empty() && std::none_of(layout.contact_groups.begin(),
                                                  layout.contact_groups.end(),
                                                  [](const ContactGroup *group) { return group->has_friction(); })))
      return;
    is_ringing = true;
    const std::string text =
      "t = " + number_to_text("%.6g", state.time) + " s: " + number_to_text("%.0f", made) +
      " steps were made instead of " + number_to_text("%.0f", asked) +
      ", halves and smaller parts of them: with <Spectral radius = 1> what sticks by dry friction "
      "vibrates about its creep, and needs steps much shorter than that. Take <Spectral radius = "
      "0.5>, a larger <Sticking speed>, or bristles";
    if (is_end)
      throw NotConverged(text + "; or a <Step> as short as these, if that is meant");
    context.log.warning("", text);
  }



  double
  DynamicAnalysis::Run::second_estimate(const double from)
  {
    if (!analysis.second_estimate)
      return std::nan("");
    machinery.halves->forget_history();
    return analysis.half_steps(context, before, state, state.time - from, *machinery.halves);
  }



  void
  DynamicAnalysis::Run::write_step(const Advance &advance, const double from, const double second)
  {
    const Report &report = analysis.report;
    if (output.steps != nullptr)
      output.steps->add({state.time,
                         state.time - from,
                         double(advance.step.iterations),
                         double(report.n_factorizations - n_factorizations),
                         double(advance.n_rejected + advance.n_failed),
                         report.length > 0 ? machinery.stepper->estimate / report.length : 0.,
                         second},
                        1);
    n_factorizations = report.n_factorizations;
  }



  void
  DynamicAnalysis::Run::show_progress()
  {
    // seconds: a line that is written over may change often, a file grows by lines
    if (context.page != nullptr && context.page->is_due())
      {
        output.flush(false);
        context.page->watch(progress());
      }
    if (!(seconds_since(last_progress) > (context.log.is_terminal() ? 0.3 : 10.)))
      return;
    context.log.progress(progress());
    last_progress = Clock::now();
  }



  std::string
  DynamicAnalysis::Run::progress() const
  {
    const Report &report  = analysis.report;
    const Budget &budget  = analysis.budget;
    const double  seconds = seconds_since(clock_start), done = state.time - begin;
    return "t " + number_to_text("%.6g", state.time) + " s of " + number_to_text("%g", analysis.end_time) + ", step " +
           number_to_text("%.3g", is_adaptive ? machinery.stepper->next_step : analysis.step) + " s, " +
           number_to_text("%.1f", double(report.n_iterations) / std::max(1u, report.n_steps)) +
           " iterations a step, energy " + number_to_text("%.6g", budget.kinetic + budget.strain + budget.potential) +
           " J, " + number_to_text("%.3g", done > 0 ? seconds / done : 0.) + " s a second, ETA " +
           number_to_text("%.0f", done > 0 ? seconds / done * (analysis.end_time - state.time) : 0.) + " s";
  }



  void
  DynamicAnalysis::Run::begin_afresh()
  {
    // not where the end changes rows, or adaptive steps before it: a run may be continued beyond
    const double ahead       = is_adaptive ? 4 * machinery.stepper->next_step : 1e-9 * analysis.step;
    const bool   is_near_end = state.time + ahead > analysis.end_time;
    if (++n_since_fresh < analysis.steps_between_fresh_starts(system) || !can_be_exact || is_near_end)
      return;
    analysis.collect(context, *machinery.integrator);
    last             = analysis.remember(context, state, machinery, output);
    machinery        = analysis.make_machinery(system, last, true);
    before_machinery = analysis.report;
    n_since_fresh    = 0;
    is_saved         = false;
  }



  void
  DynamicAnalysis::Run::save()
  {
    // a shorter run is done again sooner than a disk answers
    const bool wait = seconds_since(clock_start) > 1;
    output.flush(wait);
    if (!can_be_exact)
      last = analysis.remember(context, state, machinery, output);
    if (!context.folder.empty())
      write_checkpoint(checkpoint_file(context), last, wait);
  }



  void
  DynamicAnalysis::Run::close()
  {
    if (context.log.is_terminal())
      context.log.line("");
    analysis.air.tell(context, "dynamic");
    save();
    for (const auto &[name, table] : output.tables())
      if (table != nullptr)
        table->finish();
    if (!context.folder.empty() && !system.layout.stops.empty() && can_be_exact)
      analysis.contacts.write(context.folder + "/dynamic_stops.csv", system.layout);
    analysis.report.seconds           = seconds_since(clock_start);
    analysis.report.processor_seconds = double(std::clock() - processor_start) / CLOCKS_PER_SEC;
    context.state                     = state;
    context.is_equilibrium            = false;
  }



  void
  DynamicAnalysis::run(Context &context)
  {
    Complaints complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();
    if (control == "adaptive")
      warn_of_states(context);
    report     = {};
    budget     = {};
    contacts   = {};
    meshes     = {};
    air        = {};
    n_rows     = 0;
    n_judged   = 0;
    n_grid     = 0;
    n_recorded = 0;

    round_off_of_sum = 0;
    Run(*this, context).go();
  }
} // namespace samara
