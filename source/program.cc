#include <samara/analysis/check.h>
#include <samara/analysis/dynamic.h>
#include <samara/analysis/static.h>
#include <samara/automatic_mesh.h>
#include <samara/base/text.h>
#include <samara/input.h>
#include <samara/output/file.h>
#include <samara/output/table.h>
#include <samara/program.h>
#include <samara/study.h>

#include <chrono>
#include <cmath>
#include <ctime>
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



    std::string
    folder_of_results(const Options &options)
    {
      return options.output.empty() ? "results/" + std::filesystem::path(options.model).stem().string() :
                                      options.output;
    }



    /** What the run took, for programs to read: steps and iterations of the motion, or else of the equilibrium. */
    void
    write_summary(const Input &input, const Context &context, const double seconds, const double processor_seconds)
    {
      double steps = std::nan(""), iterations = std::nan(""), factorizations = std::nan("");
      for (const auto &analysis : input.analyses)
        if (const auto *const dynamic = dynamic_cast<DynamicAnalysis *>(analysis.get()))
          {
            steps          = dynamic->report.n_steps;
            iterations     = dynamic->report.n_iterations;
            factorizations = dynamic->report.n_factorizations;
          }
        else if (const auto *const statics = dynamic_cast<StaticAnalysis *>(analysis.get()))
          {
            steps      = statics->n_steps;
            iterations = statics->n_iterations;
          }
      Table table({"unknowns", "time [s]", "processor time [s]", "steps", "iterations", "factorizations"});
      table.add_row({context.system.size(), seconds, processor_seconds, steps, iterations, factorizations});
      table.write(context.folder + "/summary.csv");
    }



    /** Whether the file is a parameter study; it is done then. */
    bool
    run_study(const Options &options, Log &log)
    {
      Complaints complaints;
      Outline    outline = Outline::of_file(options.model, complaints);
      if (!Study::is_study(outline))
        return false; // mistakes are for those who read models
      for (const auto &override : options.overrides)
        outline.set(override, complaints);
      complaints.throw_if_any();
      Study study(options.model, outline);
      if (options.check)
        log.line(options.model + ": no mistakes found\n  members           " + std::to_string(study.members.size()));
      else
        study.run(folder_of_results(options), options.jobs, options.program, log);
      return true;
    }
  } // namespace



  void
  run(const Options &options, Log &log)
  {
    if (options.parameters || !options.help_about.empty())
      return print_reference(std::cout, options.help_about);
    if (options.model.empty())
      throw InputError("no input file is given; write samara model.prm, or samara --help");
    if (run_study(options, log))
      return;

    const auto start           = std::chrono::steady_clock::now();
    const auto processor_start = std::clock();
    // a mere check solves nothing, and sees the first mesh of automatic elements
    const auto   overrides =
      options.check ? options.overrides : find_meshes(Catalogue(), options.model, options.overrides, log);
    Input        input(Catalogue(), options.model, overrides);
    System     system(input.model);
    if (system.size() == 0)
      throw InputError(options.model +
                       ": every body is welded to the ground: nothing can move, and there is nothing to "
                       "compute. Leave out a rigid joint, or give it <Reaction = true>.");
    const auto probes = input.make_probes();
    const auto counts = check_model(system);
    if (options.check)
      log.line(counts.text(system, options.model));
    if (!counts.redundant.empty() && !input.drop_redundant)
      throw InputError(counts.complaint(options.model));
    system.drop(counts.redundant_multipliers);
    if (options.check)
      return;

    const std::string folder = folder_of_results(options);
    make_folder(folder);
    std::ofstream used = open_file(folder + "/used.prm");
    input.print(used);
    flush(used, folder + "/used.prm");

    log.line((input.title.empty() ? options.model : input.title) + ": " + std::to_string(system.size()) +
             " unknowns (" + std::to_string(system.layout.n_nodes - 1) + " nodes, " +
             std::to_string(system.layout.n_coordinates) + " joint coordinates, " +
             std::to_string(system.layout.n_multipliers) + " multipliers)");
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
    write_summary(input, context, seconds, double(std::clock() - processor_start) / CLOCKS_PER_SEC);
    log.line("done in " + short_text(seconds) + " s; results are in " + folder);
  }
} // namespace samara
