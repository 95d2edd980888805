#include <samara/analysis/draw_shape.h>
#include <samara/analysis/near_redundancy.h>
#include <samara/base/interrupt.h>
#include <samara/base/refused_pictures.h>
#include <samara/base/text.h>
#include <samara/base/threads.h>
#include <samara/cosserat/section.h>
#include <samara/input/input.h>
#include <samara/input/mechanism_graph.h>
#include <samara/input/single_nodes.h>
#include <samara/model/remarks.h>
#include <samara/output/file.h>
#include <samara/output/table.h>
#include <samara/program/program.h>
#include <samara/recovery/section_report.h>
#include <samara/report/report_page.h>
#include <samara/report/write_report.h>
#include <samara/solvers/blas_kernels.h>
#include <samara/study/automatic_mesh.h>
#include <samara/study/several_models.h>
#include <samara/study/study.h>
#include <samara/study/trim_variants.h>
#include <samara/study/verification_studies.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <new>

namespace samara
{
  namespace
  {
    /** The first @p n analyses at each speed of the sweep. */
    template <typename Run>
    void
    run_sweep(const Input &input, const unsigned int n, Context &context, const Run &run_one)
    {
      const auto first = input.analyses.begin(), end = first + n;
      std::for_each(first, end, [&](const auto &analysis) { analysis->start(context); });
      for (const double speed : context.sweep)
        {
          context.speeds = context.speeds_at(speed);
          context.log.line("speed " + short_text(speed) + " rad/s");
          std::for_each(first, end, [&](const auto &analysis) { run_one(*analysis); });
        }
      std::for_each(first, end, [&](const auto &analysis) { analysis->finish(context); });
    }



    std::vector<double>
    own_speeds(const Model &model)
    {
      std::vector<double> speeds;
      for (const auto &rotation : model.rotations)
        speeds.push_back(rotation.speed);
      return speeds;
    }



    /** Speeds of the model, no sweep, nothing found yet. */
    void
    return_to_own_speed(Context &context)
    {
      context.speeds = own_speeds(context.system.model);
      context.sweep.clear();
      context.state          = context.system.reference();
      context.is_equilibrium = false;
    }



    /** Analyses one by one; behind a sweep of those that can be swept, see n_swept(). */
    void
    run_all(const Input &input, Context &context)
    {
      for (const auto &analysis : input.analyses)
        if (auto *const sections = dynamic_cast<SectionReport *>(analysis.get()))
          sections->watch(input.model, input.analyses);

      // what an analysis refuses stands in its subsection, unless it says where
      const auto run_one = [&](Analysis &analysis) {
        throw_if_interrupted();
        try
          {
            analysis.run(context);
          }
        catch (const InputError &error)
          {
            throw InputError(with_place(error.complaints, analysis.parameters.where()));
          }
      };
      auto next = input.analyses.begin();
      if (context.restart)
        {
          // the state is in the checkpoint: what was done before it is not repeated, and its results are there
          next = std::find_if(next, input.analyses.end(), [](const auto &analysis) { return analysis->can_restart(); });
          if (next == input.analyses.end())
            throw InputError(input.where("Analyses") +
                             ": --restart: there is no dynamic analysis among the <Analyses>");
          context.sweep.clear();
          run_one(**next++);
          context.restart = false;
        }
      if (!context.sweep.empty())
        {
          const unsigned int n           = n_swept(input.analyses);
          const bool         is_all      = n == input.analyses.size();
          const bool         is_pictured = context.pictures;
          context.pictures               = is_pictured && is_all; // else those at the model's own speed come later
          run_sweep(input, n, context, run_one);
          if (is_all)
            return;
          context.pictures = is_pictured;
          return_to_own_speed(context);
          context.log.line("at the model's own speed, " + short_text(context.speeds[0]) + " rad/s");
        }
      std::for_each(next, input.analyses.end(), [&](const auto &analysis) { analysis->start(context); });
      for (; next != input.analyses.end(); ++next)
        {
          run_one(**next);
          (*next)->finish(context); // a run that is killed later keeps the results of this one
        }
    }



    /** results/<name of the model>; a name of nothing but dots would be another folder than that. */
    std::string
    folder_of_results(const Options &options)
    {
      if (!options.output.empty())
        return options.output;
      const std::string name = std::filesystem::path(options.model).stem().string();
      return "results/" + (name.find_first_not_of('.') == std::string::npos ? "model" : name);
    }



    /**
     * Before anything is computed: a folder that cannot be made, or not be written to, or into which another process
     * writes, is a wrong argument. It is this process's own as long as the result is there.
     */
    [[nodiscard]] FolderLock
    prepare_folder(const std::string &folder)
    {
      try
        {
          make_folder(folder);
          FolderLock        lock(folder);
          const std::string attempt = folder + "/.samara_can_write";
          open_file(attempt);
          std::error_code ignored;
          std::filesystem::remove(attempt, ignored);
          return lock;
        }
      catch (const CannotWrite &problem)
        {
          throw InputError(std::string("samara: ") + problem.what() + " Choose another folder by --output.");
        }
    }



    /** What the run took, for programs to read: steps and iterations of the last analysis that counts any. */
    void
    write_summary(const Input &input, const Context &context, const double seconds, const double processor_seconds)
    {
      Analysis::Effort effort = {std::nan(""), std::nan(""), std::nan("")};
      for (const auto &analysis : input.analyses)
        effort = analysis->effort().value_or(effort);
      Table table({"unknowns", "time [s]", "processor time [s]", "steps", "iterations", "factorizations"});
      using Cell = Table::Cell;
      table.add_row({context.system.size(),
                     seconds,
                     processor_seconds,
                     Cell::optional(effort.steps),
                     Cell::optional(effort.iterations),
                     Cell::optional(effort.factorizations)});
      table.write(context.folder + "/summary.csv");
    }



    /** The page of a folder whose results are complete: of a study, of sections. */
    void
    write_page(const std::string &folder, const Log &log)
    {
      keep_earlier_data(folder, false);
      replace_file(folder + "/run.log", log.text());
      write_report({folder}, folder + "/report.html");
    }



    void
    run_study(const Options &options, InputFile file, Log &log)
    {
      for (const auto &override : options.overrides)
        file.outline.set(override, file.complaints);
      Study study(options.model, std::move(file));
      if (options.check)
        return log.line(options.model + ": no mistakes found\n  members           " +
                        std::to_string(study.members.size()));
      const std::string folder = folder_of_results(options);
      const FolderLock  lock   = prepare_folder(folder);
      study.run(folder, options.jobs, execute, log);
      write_page(folder, log);
    }



    void
    write_used(const Input &input, const std::string &folder)
    {
      std::ofstream used = open_file(folder + "/used.prm");
      input.print(used);
      flush(used, folder + "/used.prm");
    }



    /** What items are to tell before anything is computed. */
    void
    tell_remarks(const Options &options, const Model &model, Log &log)
    {
      for (const auto &item : model.items)
        if (const auto *const teller = dynamic_cast<const HasRemarks *>(item.get()))
          for (const auto &remark : teller->remarks())
            {
              if (remark.level == Remark::warning)
                log.warning(item->parameters.where(), remark.text);
              else if (remark.level == Remark::line || options.check)
                log.line(remark.text);
            }
    }



    /** The page of the report, or none. @p system: null if there is nothing that moves. */
    std::unique_ptr<ReportPage>
    make_page(const Options      &options,
              const Input        &input,
              const System *const system,
              const std::string  &folder,
              const Log          &log)
    {
      keep_earlier_data(folder, options.restart && input.report);
      if (!input.report)
        return nullptr;
      ReportPage::Settings settings;
      settings.folder                  = folder;
      settings.n_pictures              = input.report_pictures;
      settings.fields                  = input.report_fields;
      settings.watch                   = input.watch || options.watch;
      settings.goes_on                 = options.restart;
      constexpr std::size_t most_items = 3000; // a hundred corners each are all that a page has
      settings.is_too_large            = input.model.items.size() > most_items;
      Drawing reference;
      try
        {
          if (system != nullptr && !settings.is_too_large)
            reference = system->draw(system->reference());
        }
      catch (const NotConverged &)
        {
          // the air at rest may have no flow; then the first picture stands for the undeformed model
        }
      auto page = std::make_unique<ReportPage>(settings, input.model, std::move(reference), log);
      page->begin();
      page->watch("the model is read");
      return page;
    }



    /** A model without bodies: nothing moves, and there is nothing to assemble. */
    void
    run_without_bodies(const Options &options, const Input &input, Log &log)
    {
      input.make_probes();
      tell_remarks(options, input.model, log);
      if (options.check)
        return log.line(
          options.model + ": no mistakes found\n  sections          " +
          std::to_string(std::count_if(input.model.items.begin(), input.model.items.end(), [](const auto &item) {
            return dynamic_cast<const Section *>(item.get()) != nullptr;
          })));
      const std::string folder = folder_of_results(options);
      const FolderLock  lock   = prepare_folder(folder);
      write_used(input, folder);
      const auto page = make_page(options, input, nullptr, folder, log);
      for (const auto &analysis : input.analyses)
        {
          if (auto *const sections = dynamic_cast<SectionReport *>(analysis.get()))
            sections->page = page.get();
          analysis->run_without_bodies(input.model, folder, input.pictures, log);
        }
      log.line("results are in " + folder);
      if (page != nullptr)
        page->write("done", "");
    }



    /** Whether a beam or a shell may have a mesh that is to be found; then a model is made of the file for each
     * attempt. */
    bool
    has_automatic_meshes(const Outline &outline, const std::vector<std::string> &overrides)
    {
      const auto is_automatic = [](const std::string &value) { return value.find("automatic") != std::string::npos; };
      const auto any_of       = [&](const std::string &name, const auto &holds) {
        const auto *const section = outline.section(name);
        return section != nullptr && std::any_of(section->sections.begin(), section->sections.end(), holds);
      };
      return std::any_of(overrides.begin(), overrides.end(), is_automatic) ||
             any_of("Bodies", [&](const Outline &body) { return is_automatic(body.value("Elements")); }) ||
             any_of("Subsystems", [&](const Outline &inner) { return has_automatic_meshes(inner, {}); });
    }



    /** Something must be able to move. */
    void
    check_size(const Input &input, const System &system)
    {
      if (system.size() > 0)
        return;
      const auto &all  = input.model.items;
      const auto  weld = std::find_if(all.begin(), all.end(), [](const auto &c) { return c->kind == "rigid"; });
      throw InputError((weld == all.end() ? input.where("Title") : (*weld)->parameters.where()) +
                       ": every body is welded to the ground: nothing can move, and there is nothing to compute. Leave "
                       "out a rigid joint, or give it <Reaction = true>.");
    }


    /** What is wrong with the model as a whole is refused, what is doubtful is told. */
    ModelCheck
    checked(const Input &input, const System &system, Log &log)
    {
      ModelCheck counts = check_model(system);
      if (!counts.contradictions.empty())
        throw InputError(with_place({counts.complaint()}, input.where("Title")));
      if (const std::string of_laws = counts.complaint_about_laws(system); !of_laws.empty())
        throw InputError(with_place({of_laws}, input.where("Title")));
      if (const std::string near = nearly_redundant_text(system, counts.redundant_multipliers); !near.empty())
        log.warning("", near);
      for (const auto &text : loads_at_single_nodes(input.model))
        log.warning("", text);
      return counts;
    }



    /** Motions that nothing holds, as pictures of modes. */
    void
    draw_free(const System      &system,
              const ModelCheck  &counts,
              const std::string &folder,
              Log               &log,
              ReportPage *const  page = nullptr)
    {
      constexpr unsigned int most = 8;
      if (const std::string text = draw_free_motions(system, counts, folder, most, page); !text.empty())
        log.line(text);
    }



    /** What a check finds; with a folder for results, the mechanism as a graph and as a drawing, too. */
    void
    tell_check(const Options &options, const System &system, const ModelCheck &counts, Log &log)
    {
      const MechanismGraph graph(system);
      log.line(counts.text(system, options.model) + "\n" + graph.text());
      if (options.output.empty())
        return;
      const FolderLock lock = prepare_folder(options.output);
      for (const auto &[name, text] :
           {std::make_pair("mechanism.dot", graph.dot()), std::make_pair("mechanism.svg", graph.svg())})
        {
          const std::string file = options.output + "/" + name;
          std::ofstream     out  = open_file(file);
          out << text;
          flush(out, file);
        }
      log.line("mechanism.dot and mechanism.svg are in " + options.output);
      draw_free(system, counts, options.output, log);
    }



    /** Unknowns from which on it matters how fast matrices are multiplied. */
    constexpr unsigned int large_model = 20000;



    /** How large it is, and what may surprise. */
    void
    tell(const Options &options, const Input &input, const System &system, const ModelCheck &counts, Log &log)
    {
      const Layout &layout = system.layout;
      log.line((input.title.empty() ? options.model : input.title) + ": " + std::to_string(system.size()) +
               " unknowns (" + std::to_string(layout.n_nodes - 1) + " nodes, " + std::to_string(layout.n_coordinates) +
               " joint coordinates, " +
               (layout.n_states > 0 ? std::to_string(layout.n_states) + " states of first order, " : "") +
               std::to_string(layout.n_multipliers) + " multipliers)");
      if (const NewKernels &kernels = use_kernels_of_processor(); system.size() > large_model && !kernels.now.empty())
        log.line("OpenBLAS does not know this processor: kernels " + kernels.now + " instead of " + kernels.before +
                 " (OPENBLAS_CORETYPE chooses others)");
      if (input.says_redundant)
        log.warning("", "<Redundant constraints> has no effect any more: redundant constraints need no entry");
      if (!counts.redundant_multipliers.empty())
        log.line(counts.redundancy_text());
      if (counts.n_free_motions > 0 && input.has_analysis("static"))
        log.line(counts.free_motions_text());
      if (input.has_analysis("dynamic") || input.has_analysis("modal"))
        if (const std::string text = counts.massless_text(); !text.empty())
          log.warning("", text);
    }



    /** The analyses; also after an interrupt they finish what they write. */
    void
    analyse(const Input &input, const ModelCheck &counts, Context &context)
    {
      try
        {
          run_all(input, context);
        }
      catch (const Interrupted &)
        {
          for (const auto &analysis : input.analyses)
            analysis->finish(context);
          throw;
        }
      catch (const NotConverged &problem)
        {
          // motions go on where nothing holds them; only an equilibrium wants them held
          std::string text = problem.what();
          if (const Layout &layout = context.system.layout;
              text.find("static analysis") == 0 && (!layout.contact_groups.empty() || !layout.stops.empty()))
            text +=
              "\n  What only a contact or a stop holds has no stiffness before that is pressed: draw it pressed in by a "
              "little (<Overlap = allowed> of groups), hold it by a weak spring, or let a damped motion come to rest";
          if (text.find("static analysis") == 0 && !counts.redundant.empty())
            text += "\n  " + counts.redundancy_text() +
                    "\n  Constraints that agree as drawn may lock what moves on, as three parallel revolutes a plate that "
                    "tilts: give a joint of the loop more freedom then (spherical or cylindrical instead of revolute)";
          if (counts.n_free_motions == 0 || text.find("static analysis") != 0 ||
              text.find("finite") != std::string::npos)
            throw NotConverged(text);
          throw NotConverged(text + "\n  " + counts.free_motions_text());
        }
    }
    /** What was found until a run failed is shown, too, with the reason. */
    void
    show_failure(ReportPage *const page, const std::string &state, const std::exception &problem)
    {
      if (page == nullptr)
        return;
      try
        {
          page->write(state, readable(problem.what()));
        }
      catch (const std::exception &)
        {
          // what went wrong first is told
        }
    }



    void
    analyse_and_show(const Input &input, const ModelCheck &counts, Context &context)
    {
      try
        {
          analyse(input, counts, context);
        }
      catch (const Interrupted &stop)
        {
          show_failure(context.page, "stopped", stop);
          throw;
        }
      catch (const std::exception &problem)
        {
          show_failure(context.page, "failed", problem);
          throw;
        }
    }



    /** samara --report FOLDER ...: of one its page anew, of several one page in the first. */
    void
    report_results(const Options &options, Log &log)
    {
      std::vector<std::string> folders = options.several;
      if (folders.empty())
        folders = {options.model};
      std::string names;
      for (const auto &folder : folders)
        {
          if (!std::filesystem::is_directory(folder))
            throw InputError("samara: --report wants folders of results, and " + folder + " is none");
          if (&folder != &folders.front())
            names += "_" + file_name_of(std::filesystem::weakly_canonical(folder).filename().string());
        }
      const std::string file = folders[0] + (names.empty() ? "/report.html" : "/report_with" + names + ".html");
      write_report(folders, file);
      log.line("Report: " + file);
    }
    /** What is written and told when all analyses are done; it has taken from @p start to now. */
    void
    conclude(const Options                               &options,
             const Input                                 &input,
             const Context                               &context,
             const std::chrono::steady_clock::time_point &start,
             const std::clock_t                           processor_start)
    {
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      write_summary(input, context, seconds, double(std::clock() - processor_start) / CLOCKS_PER_SEC);
      run_verification_studies(options, input, context.folder, run, context.log);
      if (const std::string text = context.page != nullptr ? context.page->cost_of_watching() : ""; !text.empty())
        context.log.line(text);
      context.log.line("done in " + short_text(seconds) + " s; results are in " + context.folder);
      if (context.page != nullptr)
        context.page->write("done", "");
    }
  } // namespace



  namespace
  {
    /** Where no model is to be run, but something to be told; whether that is so. */
    bool
    explains(const Options &options, Log &log)
    {
      if (options.parameters || !options.help_about.empty())
        print_reference(std::cout, options.help_about);
      else if (options.kinds)
        print_kinds(std::cout);
      else if (!options.part.empty())
        print_part(std::cout, options.part);
      else if (!options.begun.empty())
        begin_model(options.begun, options.model, log);
      else
        return false;
      return true;
    }
  } // namespace



  void
  run(const Options &options, Log &log)
  {
    if (explains(options, log))
      return;
    if (options.model.empty())
      throw InputError("no input file is given; write samara model.prm, or samara --help");
    if (options.report)
      return report_results(options, log);
    const auto start           = std::chrono::steady_clock::now();
    const auto processor_start = std::clock();
    InputFile  file(options.model);
    folder_of_refused_pictures() = folder_of_results(options);
    if (Study::is_study(file.outline))
      return run_study(options, std::move(file), log);

    // a mere check solves nothing, and sees the first mesh of automatic elements
    const bool is_automatic = !options.check && has_automatic_meshes(file.outline, options.overrides);
    const auto overrides    = is_automatic ? find_meshes(Catalogue(), file, options.overrides, log) : options.overrides;
    Input      input(Catalogue(), std::move(file), overrides);
    input.use_settings();
    for (const auto &doubt : input.doubts)
      log.warning("", doubt);
    let_trim_continue(input, options.model, overrides);
    if (input.is_without_bodies())
      return run_without_bodies(options, input, log);
    const auto owner  = input.assemble();
    System    &system = *owner;
    check_size(input, system);
    auto       probes = input.make_probes();
    ModelCheck counts = checked(input, system, log);
    tell_remarks(options, input.model, log);
    if (input.assembled)
      log.line(input.assembled->text());
    if (options.check)
      {
        run_verification_studies(options, input, "", run, log);
        return tell_check(options, system, counts, log);
      }
    system.drop(counts.redundant_multipliers);
    const bool least_norm = counts.mark(probes);

    // from here to the last file: who interrupts gets whole files, and a folder that is free
    const InterruptGuard guard;
    const std::string    folder = folder_of_results(options);
    const FolderLock     lock   = prepare_folder(folder);
    write_used(input, folder);
    if (input.assembled)
      input.assembled->write(folder + "/assembly.csv");
    tell(options, input, system, counts, log);
    const auto page = make_page(options, input, &system, folder, log);
    if (input.pictures && input.has_analysis("static") && !options.restart)
      draw_free(system, counts, folder, log, page.get());
    counts.shapes = {}; // as long as the model is large, each of them
    Context context{
      system, log, folder, probes, input.pictures, system.reference(), own_speeds(input.model), input.rotor_speeds};
    context.restart    = options.restart;
    context.least_norm = least_norm;
    context.used       = input.used();
    context.page       = page.get();
    analyse_and_show(input, counts, context);
    conclude(options, input, context, start, processor_start);
  }



  int
  execute(const Options &options)
  {
    try
      {
        if (!options.several.empty() && !options.report)
          return execute_all(options, execute);
        // no MPI, which would want to start a daemon and complains where it cannot
        set_threads(1);
        Log log(std::cout, options.quiet);
        run(options, log);
        return success;
      }
    catch (const InputError &error)
      {
        std::cerr << readable(error.what()) << '\n';
        return input_error;
      }
    catch (const NotConverged &error)
      {
        std::cerr << readable(error.what()) << '\n';
        return not_converged;
      }
    catch (const Interrupted &stop)
      {
        std::cerr << readable(stop.what()) << '\n';
        return interrupted;
      }
    catch (const CannotWrite &error)
      {
        std::cerr << "samara: " << readable(error.what()) << '\n';
        return internal_error;
      }
    catch (const std::bad_alloc &)
      {
        std::cerr << "samara: there is not enough memory for this model\n";
        return internal_error;
      }
    catch (const std::exception &error)
      {
        std::cerr << "samara: internal error: " << readable(error.what()) << '\n';
        return internal_error;
      }
  }
} // namespace samara
