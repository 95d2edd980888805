#include <samara/analysis/dynamic_parts.h>
#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/text.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>
#include <samara/time/rivals.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>

namespace samara
{
  namespace
  {
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



  void
  DynamicAnalysis::record(const Context &context, const State &state, Projection &projection, Output &output)
  {
    const bool is_picture =
      output.pictures != nullptr && state.time >= output.next_picture - 1e-9 * (end_time - start_time);
    if (output.energies != nullptr)
      output.energies->add({state.time,
                            budget.kinetic,
                            budget.strain,
                            budget.potential,
                            budget.loads,
                            budget.drives,
                            budget.viscous,
                            budget.dissipated,
                            budget.balance()});
    // every few rows: it costs the strains of the beams
    if (n_recorded++ % 16 == 0 || state.time >= end_time - 1e-12 * (end_time - start_time))
      meshes.check(context, state, "dynamic, t = " + short_text(state.time) + " s");
    if (context.probes.empty() && !is_picture && !observer)
      return;
    const State &reported = output.report(context, state, projection, is_picture || observer);
    if (observer)
      observer(reported);
    if (output.history != nullptr && !context.probes.empty())
      {
        std::vector<double> row;
        row.reserve(1 + context.probes.size());
        row.push_back(state.time);
        for (const auto &probe : context.probes)
          row.push_back(probe.value(reported));
        output.history->add(row);
      }
    if (is_picture)
      {
        output.pictures->add(context.system.draw(reported), state.time);
        output.next_picture += (end_time - start_time) / n_pictures;
      }
  }



  const State &
  DynamicAnalysis::Output::report(const Context &context,
                                  const State   &state,
                                  Projection    &projection,
                                  const bool     with_all)
  {
    const bool with_forces = with_all || needs.forces;
    if (!with_forces && !needs.velocities)
      return state;
    reported = state;
    try
      {
        projection.report(reported, with_forces);
        if (with_forces && context.least_norm && !reported.left_out.empty())
          {
            if (!redundant)
              redundant = std::make_unique<RedundantRows>(context.system);
            redundant->make_least(reported);
          }
      }
    catch (const SingularMatrix &problem)
      {
        if (!is_massless)
          context.log.warning(
            "",
            "t = " + short_text(state.time) + " s: accelerations are not determined" +
              (problem.unknown >= 0 ? " at " + context.system.layout.name_of(problem.unknown) : std::string()) +
              ", because it has no mass or constraints depend on each other in this position: velocities, "
              "accelerations and joint forces are those of the integrator, of lower order");
        is_massless = true;
      }
    return reported;
  }



  void
  DynamicAnalysis::account(const Context &context, const State &state, const StepResult &step)
  {
    // loads with a potential do the work that it loses
    const auto   energy    = step.energy ? *step.energy : context.system.energy(state);
    const double potential = context.system.potential_energy(state.point());
    budget.loads += step.work_of_loads + potential - budget.potential;
    budget.drives += step.work_of_drives;
    budget.viscous += step.viscous_loss;
    budget.dissipated += step.dissipated;
    budget.kinetic   = energy.kinetic;
    budget.strain    = energy.strain;
    budget.potential = potential;
  }



  std::unique_ptr<Integrator>
  DynamicAnalysis::make_integrator(const System &system, const double tolerance) const
  {
    if (integrator == "family")
      return std::make_unique<StageIntegrator>(system, Tableau(n_stages, spectral_radius), tolerance, max_iterations);
    try
      {
        return make_rival(integrator, system, {spectral_radius, tolerance, max_iterations, this->tolerance});
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(parameters.where("Integrator") + ": " + problem.what());
      }
  }



  double
  DynamicAnalysis::half_steps(const Context &context,
                              const State   &start,
                              const State   &end,
                              const double   h,
                              Integrator    &integrator) const
  {
    State twice = start;
    for (unsigned int i = 0; i < 2; ++i)
      if (!integrator.step(twice, h / 2).converged)
        return std::nan("");
    const double length = model_length(context.system.model);
    double       error  = 0;
    for (unsigned int node = 1; node < context.system.layout.n_nodes; ++node)
      error = std::max({error,
                        (twice.position(node) - end.position(node)).norm() / length,
                        (twice.triad(node) - end.triad(node)).norm() / std::sqrt(2.)});
    return error;
  }



  void
  DynamicAnalysis::run(Context &context)
  {
    using Clock                   = std::chrono::steady_clock;
    const auto    clock_start     = Clock::now();
    const auto    processor_start = std::clock();
    const System &system          = context.system;
    Complaints    complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();

    const bool is_adaptive = control == "adaptive";
    if (is_adaptive && system.layout.n_states > 0)
      context.log.warning(
        "dynamic",
        "adaptive steps are chosen by what moves, and so is the error that is told: states of first order do not "
        "count. Let the <Largest step> be small beside what they follow");
    report                 = {};
    budget                 = {};
    contacts               = {};
    n_rows = n_judged = round_off_of_sum = 0;
    n_grid                               = 0;
    n_recorded                           = 0;
    meshes                               = {};
    bool       with_steps                = true;
    Checkpoint last;
    State      state = context.state;
    if (context.restart)
      {
        last  = restore(context, with_steps);
        state = last.state;
      }
    else
      prepare(context, state);
    Machinery    machinery    = context.restart ? make_machinery(system, last, with_steps) : make_machinery(system);
    const bool   can_be_exact = machinery.integrator->family() != nullptr;
    const double begin        = state.time;
    const auto   energy       = system.energy(state);
    budget.kinetic            = energy.kinetic;
    budget.strain             = energy.strain;
    budget.potential          = system.potential_energy(state.point());
    if (!context.restart)
      budget.start = budget.kinetic + budget.strain + budget.potential;
    else if (!can_be_exact)
      context.log.line("restart: the integrator <" + integrator +
                       "> begins afresh here; results are those of an uninterrupted run within its error");

    if (!context.restart)
      set_energy_floor(system);
    InterruptGuard interrupt;
    Output         output(context, *this, begin, context.restart ? &last : nullptr);
    auto           last_progress = clock_start, last_checkpoint = clock_start;
    Report         before_machinery = report;
    if (!context.restart && !context.folder.empty())
      std::filesystem::remove(checkpoint_file(context)); // of an earlier run
    const auto seconds_since = [](const Clock::time_point &t) {
      return std::chrono::duration<double>(Clock::now() - t).count();
    };
    const auto show = [&]() {
      const double seconds = seconds_since(clock_start), done = state.time - begin;
      context.log.progress("t " + number_to_text("%.6g", state.time) + " s of " + number_to_text("%g", end_time) +
                           ", step " + number_to_text("%.3g", is_adaptive ? machinery.stepper->next_step : step) +
                           " s, " + number_to_text("%.1f", double(report.n_iterations) / std::max(1u, report.n_steps)) +
                           " iterations a step, energy " +
                           number_to_text("%.6g", budget.kinetic + budget.strain + budget.potential) + " J, " +
                           number_to_text("%.3g", done > 0 ? seconds / done : 0.) + " s a second, ETA " +
                           number_to_text("%.0f", done > 0 ? seconds / done * (end_time - state.time) : 0.) + " s");
    };
    const auto save = [&]() {
      // a shorter run is done again sooner than a disk answers
      const bool wait = seconds_since(clock_start) > 1;
      output.flush(wait);
      if (!can_be_exact)
        last = remember(context, state, machinery, output);
      if (!context.folder.empty())
        write_checkpoint(checkpoint_file(context), last, wait);
    };
    const auto close = [&]() {
      if (context.log.is_terminal())
        context.log.line("");
      save();
      for (const auto &[name, table] : output.tables())
        if (table != nullptr)
          table->finish();
      if (!context.folder.empty() && !system.layout.stops.empty() && can_be_exact)
        contacts.write(context.folder + "/dynamic_stops.csv", system.layout);
      report.seconds           = seconds_since(clock_start);
      report.processor_seconds = double(std::clock() - processor_start) / CLOCKS_PER_SEC;
      context.state            = state;
      context.is_equilibrium   = false;
    };

    if (!context.restart)
      {
        record(context, state, *machinery.projection, output);
        last = remember(context, state, machinery, output);
      }
    unsigned int n_since_fresh = 0, n_factorizations = report.n_factorizations;
    bool         is_saved = context.restart;
    State        before;
    try
      {
        while (state.time < end_time - 1e-12 * (end_time - start_time))
          {
            if (interrupt.was_interrupted())
              {
                close();
                throw Interrupted("interrupted at t = " + number_to_text("%.6g", state.time) +
                                  " s; everything up to there is written, and samara --restart goes on");
              }
            // fixed steps keep to their grid, whatever happens in between
            const double goal = is_adaptive ? end_time : std::min(end_time, start_time + (n_grid + 1) * step);
            if (second_estimate)
              before = state;
            const double  from        = state.time;
            const Advance advance     = machinery.stepper->advance(state, goal);
            const double  before_step = budget.balance();
            account(context, state, advance.step);
            if (!std::isfinite(budget.kinetic + budget.strain + budget.potential))
              require_finite_state(system, state);
            judge(context, advance, from, before_step);
            if (machinery.redundant)
              require_rows_left_out(*machinery.redundant, state);
            const Integrator &integrator = *machinery.integrator;
            report.n_steps               = before_machinery.n_steps + integrator.n_steps;
            report.n_iterations          = before_machinery.n_iterations + integrator.n_iterations;
            report.n_factorizations      = before_machinery.n_factorizations + integrator.n_factorizations;
            report.n_rejected += advance.n_rejected;
            report.n_failed += advance.n_failed;
            report.n_touches += advance.step.touches.size();
            contacts.add(advance.step, from, state.time);
            if (machinery.stepper->controller)
              {
                report.error += machinery.stepper->estimate;
                report.length = machinery.stepper->controller->size;
              }
            report.turn   = std::max(report.turn, advance.h * largest_spin(state));
            double second = std::nan("");
            if (second_estimate)
              {
                machinery.halves->forget_history();
                second = half_steps(context, before, state, state.time - from, *machinery.halves);
              }
            const bool is_on_grid = is_adaptive || state.time >= goal - 1e-9 * step;
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
            if (is_on_grid)
              {
                ++n_grid;
                ++n_rows;
                if (std::lround(n_rows) % output_every == 0 || state.time >= end_time - 1e-12 * (end_time - start_time))
                  record(context, state, *machinery.projection, output);
              }
            if (seconds_since(last_progress) > (context.log.is_terminal() ? 0.3 : 10.))
              {
                show();
                last_progress = Clock::now();
              }
            // not where the end changes rows, or adaptive steps before it: a run may be continued beyond
            const double ahead       = is_adaptive ? 4 * machinery.stepper->next_step : 1e-9 * step;
            const bool   is_near_end = state.time + ahead > end_time;
            if (++n_since_fresh >= steps_between_fresh_starts(system) && can_be_exact && !is_near_end)
              {
                collect(context, *machinery.integrator);
                last             = remember(context, state, machinery, output);
                machinery        = make_machinery(system, last, true);
                before_machinery = report;
                n_since_fresh    = 0;
                is_saved         = false;
              }
            if (seconds_since(last_checkpoint) > seconds_between_checkpoints && (!is_saved || !can_be_exact))
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
        throw NotConverged(
          std::string("dynamic analysis: ") + problem.what() +
          "\n  everything up to there is written; try a smaller <Step>, <Step control = adaptive>, more damping "
          "(<Spectral radius = 0>), or look whether the mechanism locks there");
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
    collect(context, *machinery.integrator);
    summarize(context, *machinery.integrator);
    conclude(context);
  }



  void
  DynamicAnalysis::summarize(const Context &context, const Integrator &integrator) const
  {
    const double steps = std::max(1u, report.n_steps);
    std::string  text  = "dynamic: " + std::to_string(report.n_steps) + " steps, " +
                       number_to_text("%.2f", report.n_iterations / steps) + " Newton iterations and " +
                       number_to_text("%.2f", report.n_factorizations / steps) + " factorizations a step";
    if (report.n_rejected + report.n_failed > 0)
      text += ", " + std::to_string(report.n_rejected) + " rejected, " + std::to_string(report.n_failed) +
              " without solution";
    if (report.n_touches > 0)
      text += ", " + std::to_string(report.n_touches) + " times a stop was touched or left";
    text += "; " + number_to_text("%.3g", report.seconds) + " s, " + number_to_text("%.3g", report.processor_seconds) +
            " s of the processor; the energy budget closes to " + number_to_text("%.1e", report.largest_balance) +
            (report.largest_energy > energy_floor ? " of the largest energy" : ": nothing moves") +
            resolution(integrator);
    context.log.line(text);
    if (!contacts.all().empty())
      context.log.line(contacts.summary(context.system.layout));
    if (report.n_exact_steps > 0)
      context.log.line(
        "  " + std::to_string(report.n_exact_steps) +
        " steps were repeated with the exact matrix of all stages: is the mechanism near a singular position?");
    if (report.n_exchanges > 0)
      context.log.line("  redundant constraints: other rows were chosen to be left out " +
                       std::to_string(report.n_exchanges) + " times");
    if (report.largest_gap_left_out > 1e-8 * model_length(context.system.model))
      context.log.warning("dynamic",
                          "constraints that are redundant but for rounded places or axes are violated by up to " +
                            number_to_text("%.1e", report.largest_gap_left_out) + " m, most: " + report.worst_left_out);
  }



  void
  DynamicAnalysis::collect(const Context &context, const Integrator &integrator)
  {
    const auto *const family = dynamic_cast<const StageIntegrator *>(&integrator);
    if (family == nullptr)
      return;
    report.n_exact_steps += family->n_exact_steps;
    report.n_exchanges += family->n_exchanges();
    if (family->largest_gap_left_out <= report.largest_gap_left_out)
      return;
    report.largest_gap_left_out = family->largest_gap_left_out;
    report.worst_left_out       = context.system.layout.multiplier_names[family->worst_left_out];
  }
} // namespace samara
