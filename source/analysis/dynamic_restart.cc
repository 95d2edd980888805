// What a run of the dynamic analysis remembers: its files, its checkpoints, and how it goes on from one.

#include <samara/analysis/dynamic_parts.h>
#include <samara/analysis/model_changes.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <cmath>

namespace samara
{
  std::string
  checkpoint_file(const Context &context)
  {
    return context.folder + "/dynamic.checkpoint";
  }



  DynamicAnalysis::Output::Output(const Context          &context,
                                  const DynamicAnalysis  &analysis,
                                  const double            start,
                                  const Checkpoint *const last)
    : next_picture(start)
    , next_on_page(start)
    , needs(context.probes)
    , has_air(!AirOfSystem(context.system).is_empty())
  {
    if (context.folder.empty())
      return;
    const std::optional<double> after  = last != nullptr ? std::optional<double>(start) : std::nullopt;
    const auto                  n_rows = [&](const std::string &table) {
      return last != nullptr ? std::optional<std::uint64_t>(last->numbers.at("rows of " + table)) : std::nullopt;
    };

    std::vector<std::pair<std::string, std::string>> columns = {{"t", "s"}};
    for (const auto &probe : context.probes)
      columns.emplace_back(probe.name, probe.unit);
    history = std::make_unique<History>(context.folder, "dynamic", columns, after, n_rows("dynamic"));
    columns = {{"t", "s"}, {"kinetic", "J"}, {"strain", "J"}, {"potential", "J"}, {"work of loads", "J"}};
    if (has_air)
      columns.emplace_back("work of air", "J");
    for (const auto name : {"work of drives", "damper loss", "friction loss", "numerical dissipation", "balance"})
      columns.emplace_back(name, "J");
    if (has_air) // where it went; no part of the balance
      for (const auto name : {"induced work", "profile work"})
        columns.emplace_back(name, "J");
    energies = std::make_unique<History>(context.folder, "dynamic_energy", columns, after, n_rows("dynamic_energy"));
    steps    = std::make_unique<History>(context.folder,
                                      "dynamic_steps",
                                      std::vector<std::pair<std::string, std::string>>{{"t", "s"},
                                                                                          {"step", "s"},
                                                                                          {"iterations", ""},
                                                                                          {"factorizations", ""},
                                                                                          {"rejections", ""},
                                                                                          {"estimate", ""},
                                                                                          {"second estimate", ""}},
                                      after,
                                      n_rows("dynamic_steps"));
    if (context.pictures && analysis.n_pictures > 0)
      pictures = std::make_unique<Pictures>(context.folder, "dynamic", after);
    if (last != nullptr && pictures != nullptr)
      {
        const double interval = (analysis.end_time - analysis.start_time) / analysis.n_pictures;
        next_picture =
          analysis.start_time + interval * (std::floor((start - analysis.start_time) / interval + 1e-9) + 1);
      }
  }



  unsigned int
  DynamicAnalysis::steps_between_fresh_starts(const System &system) const
  {
    // a fresh start costs about what some steps cost; where steps take long, less of them may be lost
    return fresh_every > 0 ? fresh_every : system.size() < 2000 ? 500 : 100;
  }



  std::vector<std::pair<std::string, double *>>
  DynamicAnalysis::remembered_numbers()
  {
    return {{"work of loads", &budget.loads},
            {"work of air", &budget.air.on_model},
            {"induced work", &budget.air.induced},
            {"profile work", &budget.air.profile},
            {"work of drives", &budget.drives},
            {"damper loss", &budget.viscous},
            {"friction loss", &budget.friction},
            {"numerical dissipation", &budget.dissipated},
            {"energy at start", &budget.start},
            {"energy floor", &energy_floor},
            {"strain energy at start", &first_strain},
            {"largest energy", &report.largest_energy},
            {"largest balance", &report.largest_balance},
            {"largest gap", &report.largest_gap},
            {"largest miss", &report.largest_miss},
            {"worst time", &report.worst_time},
            {"largest turn", &report.turn},
            {"largest indicator", &report.indicator},
            {"largest work defect", &report.work_defect},
            {"sum of errors", &report.error},
            {"judged steps", &n_judged},
            {"round-off of the balance", &round_off_of_sum},
            {"largest gap left out", &report.largest_gap_left_out},
            {"rows", &n_rows}};
  }



  Checkpoint
  DynamicAnalysis::remember(const Context   &context,
                            const State     &state,
                            const Machinery &machinery,
                            const Output    &output)
  {
    const Stepper::Memory memory = machinery.stepper->memory();
    Checkpoint            checkpoint;
    checkpoint.state  = state;
    checkpoint.step   = memory.next_step;
    checkpoint.model  = context.used;
    checkpoint.arrays = {{"step control", memory.of_controller},
                         {"step error", memory.of_error},
                         {"steady twists", memory.steady_twists},
                         {"progress", memory.window},
                         {"contacts", contacts.to_numbers()},
                         {"creep", contacts.creep}};
    for (const auto &[name, number] : remembered_numbers())
      checkpoint.numbers[name] = *number;
    checkpoint.numbers["steps of the grid"] = n_grid;
    for (const auto &[name, table] : output.tables())
      checkpoint.numbers["rows of " + std::string(name)] = table != nullptr ? table->size() : 0;
    const std::vector<std::pair<std::string, unsigned int>> counts = {{"steps", report.n_steps},
                                                                      {"iterations", report.n_iterations},
                                                                      {"factorizations", report.n_factorizations},
                                                                      {"rejected", report.n_rejected},
                                                                      {"failed", report.n_failed},
                                                                      {"touches", report.n_touches},
                                                                      {"exact steps", report.n_exact_steps},
                                                                      {"exchanges", report.n_exchanges}};
    for (const auto &[name, count] : counts)
      checkpoint.numbers["number of " + name] = count;
    return checkpoint;
  }



  Checkpoint
  DynamicAnalysis::restore(const Context &context, bool &with_steps)
  {
    const std::string  file       = checkpoint_file(context);
    const Checkpoint   checkpoint = read_checkpoint(file);
    const ModelChanges changes    = changes_of_model(*checkpoint.model, *context.used);
    const State        reference  = context.system.reference();
    const State       &state      = checkpoint.state;
    const bool         fits = state.q.size() == reference.q.size() && state.stress.size() == reference.stress.size() &&
                      state.coordinates.size() == reference.coordinates.size() &&
                      state.states.size() == reference.states.size() &&
                      state.multipliers.size() == reference.multipliers.size();
    if (!changes.refused.empty() || !fits)
      throw InputError(file +
                       ": this checkpoint belongs to another model; undo what was changed since, or run without "
                       "--restart" +
                       (changes.refused.empty() ? "" : ":\n    " + join(changes.refused, "\n    ")));
    if (!changes.harmless.empty())
      context.log.line("restart: changed since the checkpoint, and used from here on:\n  " +
                       join(changes.harmless, "\n  "));
    with_steps = !changes.touches("Step") && !changes.touches("Step control");

    for (const auto &[name, number] : remembered_numbers())
      *number = checkpoint.numbers.at(name);
    const auto count        = [&](const std::string &name) { return checkpoint.numbers.at("number of " + name); };
    report.n_steps          = count("steps");
    report.n_iterations     = count("iterations");
    report.n_factorizations = count("factorizations");
    report.n_rejected       = count("rejected");
    report.n_failed         = count("failed");
    report.n_touches        = count("touches");
    report.n_exact_steps    = count("exact steps");
    report.n_exchanges      = count("exchanges");
    report.worst_left_out   = "one before the restart";
    report.worst_place      = "a place before the restart";
    contacts.set_numbers(checkpoint.arrays.at("contacts"));
    contacts.creep = checkpoint.arrays.at("creep");
    n_grid =
      with_steps ? checkpoint.numbers.at("steps of the grid") : std::floor((state.time - start_time) / step + 1e-6);
    return checkpoint;
  }



  DynamicAnalysis::Machinery
  DynamicAnalysis::make_machinery(const System &system) const
  {
    Machinery machinery;
    machinery.integrator = make_integrator(system, newton_tolerance);
    machinery.projection = std::make_unique<Projection>(system);
    if (second_estimate)
      machinery.halves = make_integrator(system, newton_tolerance);
    if (machinery.integrator->family() == nullptr)
      machinery.redundant = std::make_unique<RedundantRows>(system);
    if (control == "adaptive")
      {
        StepController::Settings settings;
        settings.tolerance     = tolerance;
        settings.duration      = tolerance_holds_for > 0 ? tolerance_holds_for : end_time - start_time;
        settings.length        = length > 0 ? length : StepError::length_of(system.model);
        settings.end           = end_time;
        settings.smallest_step = smallest_step;
        settings.largest_step  = largest_step > 0 ? largest_step : 0.1 * (end_time - start_time);
        machinery.stepper =
          std::make_unique<Stepper>(system, *machinery.integrator, std::min(step, settings.largest_step), settings);
      }
    else
      machinery.stepper = std::make_unique<Stepper>(system, *machinery.integrator, step, smallest_step);
    return machinery;
  }



  DynamicAnalysis::Machinery
  DynamicAnalysis::make_machinery(const System &system, const Checkpoint &memory, const bool with_steps) const
  {
    Machinery machinery = make_machinery(system);
    machinery.stepper->set_memory({memory.step,
                                   memory.arrays.at("step control"),
                                   memory.arrays.at("step error"),
                                   memory.arrays.at("steady twists"),
                                   memory.arrays.at("progress")},
                                  with_steps);
    return machinery;
  }
} // namespace samara
