#include <samara/analysis/check.h>
#include <samara/base/text.h>
#include <samara/input.h>
#include <samara/output/file.h>
#include <samara/program.h>

#include <chrono>
#include <filesystem>
#include <fstream>

namespace samara
{
  namespace
  {
    void
    run_all(const Input &input, Context &context)
    {
      const auto run_once = [&]() {
        for (const auto &analysis : input.analyses)
          analysis->run(context);
      };
      if (context.restart)
        {
          // the state is in the checkpoint: what was done before it is not repeated
          for (const auto &analysis : input.analyses)
            if (analysis->can_restart())
              return analysis->run(context);
          throw InputError("--restart: there is no dynamic analysis among the <Analyses>");
        }
      for (const auto &analysis : input.analyses)
        analysis->start(context);
      if (context.sweep.empty())
        run_once();
      for (const double speed : context.sweep)
        {
          context.speeds = context.speeds_at(speed);
          context.log.line("speed " + short_text(speed) + " rad/s");
          run_once();
        }
      for (const auto &analysis : input.analyses)
        analysis->finish(context);
    }
  } // namespace



  void
  run(const Options &options, Log &log)
  {
    if (options.parameters || !options.help_about.empty())
      return print_reference(std::cout, options.help_about);
    if (options.model.empty())
      throw InputError("no input file is given; write samara model.prm, or samara --help");

    const auto   start = std::chrono::steady_clock::now();
    Input        input(Catalogue(), options.model, options.overrides);
    System       system(input.model);
    if (system.size() == 0)
      throw InputError(options.model +
                       ": every body is welded to the ground: nothing can move, and there is nothing to "
                       "compute. Leave out a rigid joint, or give it <Reaction = true>.");
    const auto   probes = input.make_probes();
    const auto   counts = check_model(system);
    if (options.check)
      log.line(counts.text(system, options.model));
    if (!counts.redundant.empty() && !input.drop_redundant)
      throw InputError(counts.complaint(options.model));
    system.drop(counts.redundant_multipliers);
    if (options.check)
      return;

    const std::string folder =
      options.output.empty() ? "results/" + std::filesystem::path(options.model).stem().string() : options.output;
    make_folder(folder);
    std::ofstream used = open_file(folder + "/used.prm");
    input.print(used);
    flush(used, folder + "/used.prm");

    log.line((input.title.empty() ? options.model : input.title) + ": " + std::to_string(system.size()) + " unknowns (" +
             std::to_string(system.layout.n_nodes - 1) + " nodes, " + std::to_string(system.layout.n_coordinates) +
             " joint coordinates, " + std::to_string(system.layout.n_multipliers) + " multipliers)");
    std::vector<double> speeds;
    for (const auto &rotation : input.model.rotations)
      speeds.push_back(rotation.speed);
    Context context{system, log, folder, probes, input.pictures, system.reference(), speeds, input.rotor_speeds};
    context.restart = options.restart;
    try
      {
        run_all(input, context);
      }
    catch (const NotConverged &problem)
      {
        if (counts.n_free_motions == 0)
          throw;
        throw NotConverged(problem.what() + ("\n  " + counts.free_motions_text()));
      }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    log.line("done in " + short_text(seconds) + " s; results are in " + folder);
  }
} // namespace samara
