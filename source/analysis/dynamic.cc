#include <samara/analysis/dynamic_parts.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/report/report_page.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  bool
  DynamicAnalysis::is_end(const double time) const
  {
    // times are sums of steps, with their round-off
    return !(time < end_time - 1e-12 * (end_time - start_time));
  }



  void
  DynamicAnalysis::record(const Context &context, const State &state, Projection &projection, Output &output)
  {
    const double round_off  = 1e-9 * (end_time - start_time);
    const bool   is_picture = output.pictures != nullptr && state.time >= output.next_picture - round_off,
               is_next      = context.page != nullptr && state.time >= output.next_on_page - round_off;
    if (is_next)
      output.next_on_page += (end_time - start_time) / context.page->settings.n_pictures;
    const bool is_on_page = (is_next && context.page->wants("dynamic")) || (context.page != nullptr && context.page->draws() && is_end(state.time));
    if (output.energies != nullptr)
      {
        std::vector<double> row = {state.time, budget.kinetic, budget.strain, budget.potential, budget.loads};
        if (output.has_air)
          row.push_back(budget.air.on_model);
        row.insert(row.end(), {budget.drives, budget.viscous, budget.friction, budget.dissipated, budget.balance()});
        if (output.has_air)
          row.insert(row.end(), {budget.air.induced, budget.air.profile});
        output.energies->add(row);
      }
    // every few rows: it costs the strains of the beams
    if (n_recorded++ % 16 == 0 || is_end(state.time))
      {
        meshes.check(context, state, "dynamic, t = " + short_text(state.time) + " s");
        air.add(context.system, state);
      }
    if (context.probes.empty() && !is_picture && !is_on_page && !observer)
      return;
    const State &reported = output.report(context, state, projection, is_picture || is_on_page || observer);
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
    if (is_picture || is_on_page)
      show(context, reported, is_picture, is_on_page, output);
  }



  void
  DynamicAnalysis::show(const Context &context,
                        const State   &state,
                        const bool     is_picture,
                        const bool     is_on_page,
                        Output        &output) const
  {
    std::optional<Drawing> whole;
    if (is_picture)
      whole = context.system.draw(state);
    const auto draw = [&](const Drawing::Content content) { return context.system.draw(state, content); };
    if (is_on_page)
      context.page->add("dynamic", state.time, whole ? ReportPage::of(*whole) : draw, is_end(state.time));
    if (is_picture)
      {
        output.pictures->add(std::move(*whole), state.time);
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
    budget.loads += step.work_of_loads - step.air.on_model + potential - budget.potential;
    budget.air.add(1, step.air);
    budget.drives += step.work_of_drives;
    budget.viscous += step.viscous_loss;
    budget.friction += step.friction_loss;
    budget.dissipated += step.dissipated;
    budget.kinetic   = energy.kinetic;
    budget.strain    = energy.strain;
    budget.potential = potential;
  }



  std::unique_ptr<Integrator>
  DynamicAnalysis::make_integrator(const System &system, const double tolerance) const
  {
    try
      {
        const IntegratorSettings settings{spectral_radius, tolerance, max_iterations, this->tolerance, n_stages};
        return integrators->make(integrator, system, settings);
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
    if (const std::string creep = contacts.creep_summary(context.system.layout); !creep.empty())
      context.log.line(creep);
    if (report.n_exact_steps > 0)
      context.log.line(
        "  " + std::to_string(report.n_exact_steps) + " steps were repeated with the exact matrix of all stages: " +
        (!context.system.layout.contact_groups.empty() ? "so it is where contacts in groups begin or end" :
         context.system.layout.frictions.empty()       ? "is the mechanism near a singular position?" :
                                                         "so it is where something begins to stick or to slip"));
    if (report.n_exchanges > 0)
      context.log.line("  redundant constraints: other rows were chosen to be left out " +
                       std::to_string(report.n_exchanges) + " times");
    // of exact geometry gaps of rows left out are round-off, 1e-9 of the size (doc/theory/redundant.md): more is told
    if (report.largest_gap_left_out > 1e-8 * model_length(context.system.model))
      context.log.warning("dynamic",
                          "constraints that are redundant but for rounded places or axes are violated by up to " +
                            number_to_text("%.1e", report.largest_gap_left_out) + " m, most: " + report.worst_left_out);
  }



  void
  DynamicAnalysis::collect(const Context &context, const Integrator &integrator)
  {
    const auto remarks = integrator.remarks();
    report.n_exact_steps += remarks.n_exact_steps;
    report.n_exchanges += remarks.n_exchanges;
    if (remarks.largest_gap_left_out <= report.largest_gap_left_out)
      return;
    report.largest_gap_left_out = remarks.largest_gap_left_out;
    report.worst_left_out       = context.system.layout.name_of_multiplier(remarks.worst_left_out);
  }
} // namespace samara
