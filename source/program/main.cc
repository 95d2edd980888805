#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/program/program.h>
#include <samara/solvers/blas_kernels.h>

#include <deal.II/base/utilities.h>

#include <CLI/CLI.hpp>
#include <dlfcn.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <iostream>

#ifndef SAMARA_VERSION
#  define SAMARA_VERSION "unknown"
#endif

// GCC says so by a name, Clang by a feature
#ifdef __SANITIZE_ADDRESS__
#  define SAMARA_HAS_ADDRESS_SANITIZER
#elif defined(__has_feature)
#  if __has_feature(address_sanitizer)
#    define SAMARA_HAS_ADDRESS_SANITIZER
#  endif
#endif

namespace
{
  /**
   * More memory than the machine has is refused, with a message, instead of bringing the machine down. The address
   * sanitizer reserves more than there is and cannot be limited.
   */
  void
  limit_memory()
  {
#ifndef SAMARA_HAS_ADDRESS_SANITIZER
    rlimit       limit = {};
    const rlim_t all   = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGE_SIZE));
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= all)
      return;
    limit.rlim_cur = all;
    setrlimit(RLIMIT_AS, &limit);
#endif
  }



  /**
   * The copy of libdeal.ii that starts quickly (cmake/quick_start.py) serves as long as the system's library is that of
   * which it was made; its size and time tell. Else the program starts again with the system's libraries.
   */
  void
  start_again_if_libraries_changed([[maybe_unused]] char **argv)
  {
#ifdef SAMARA_DEAL_II
    static volatile const std::int64_t size_then = SAMARA_DEAL_II_SIZE; // volatile: a test changes it in the file
    const std::string                  system    = SAMARA_DEAL_II;
    Dl_info           loaded = {};
    struct stat       now    = {};
    if (dladdr(reinterpret_cast<void *>(&dealii::Utilities::System::get_hostname), &loaded) == 0 ||
        system == loaded.dli_fname || stat(system.c_str(), &now) != 0 ||
        (now.st_size == size_then && now.st_mtime == SAMARA_DEAL_II_SECONDS))
      return;
    // this folder stands before that of the copy; started so, the path of what is loaded is the system's
    const std::string folder = system.substr(0, system.rfind('/'));
    const char       *others = getenv("LD_LIBRARY_PATH");
    if (others != nullptr && std::string(others).rfind(folder, 0) == 0)
      return;
    setenv("LD_LIBRARY_PATH", (others != nullptr ? folder + ":" + others : folder).c_str(), 1);
    execv("/proc/self/exe", argv);
#endif
  }



  /** Memory of large arrays goes back when they are gone, whichever thread had them; small models do not notice. */
  void
  return_memory()
  {
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
  }
} // namespace



int
main(int argc, char **argv)
{
  start_again_if_libraries_changed(argv);
  samara::Options          options;
  std::vector<std::string> models;
  CLI::App                 app{"Samara: flexible multibody dynamics. Usage: samara model.prm"};
  app.set_help_flag();
  app.add_option("model", models, "Input file; of several each runs in a process of its own");
  app.add_option("--set", options.overrides, "Override an entry: \"Bodies/shaft 1/Degree = 4\"")
    ->allow_extra_args(false);
  app.add_option("--output",
                 options.output,
                 "Folder of the results; default results/<name of the model>; of several models: of their folders");
  app.add_flag("--check", options.check, "Read and assemble the model, say what it is, and stop");
  app.add_flag("--restart", options.restart, "Go on from the checkpoint in the folder of the results");
  app.add_option("-j,--jobs", options.jobs, "Of a study or of several models: how many run side by side")
    ->check(CLI::Range(1, 1024));
  app.add_flag("--report", options.report, "Write report.html of a folder of results anew; of several folders one page of all");
  app.add_flag("--watch", options.watch, "Write report.html again and again while the model runs; a browser follows it");
  app.add_flag("--parameters", options.parameters, "Print every kind with its entries, as Markdown");
  app.add_flag("--kinds", options.kinds, "All kinds of bodies, joints, ..., analyses and parts, on one screen");
  app.add_option("--part", options.part, "The arguments of a part that models name: --part rotor/hub");
  app.add_option("--new", options.begun, "A model to begin with, rotor, wing, mechanism, shaft or shell, into FILE");
  app.add_flag("--quiet", options.quiet, "Print warnings and errors only");
  auto *const help =
    app.add_option("--help",
                   options.help_about,
                   "This text, or the entries of a kind or of a subsection: --help beam, --help Study; --help everything");
  help->expected(0, 1);
  auto *const version = app.add_flag("--version", "Print the version");
  try
    {
      app.parse(argc, argv);
    }
  catch (const CLI::ParseError &error)
    {
      std::cerr << "samara: " << samara::readable(error.what()) << "; see samara --help\n";
      return samara::input_error;
    }
  if (help->count() > 0 && options.help_about.empty())
    return std::cout << app.help(), samara::success;
  if (version->count() > 0)
    return std::cout << "samara " << SAMARA_VERSION << '\n', samara::success;

  limit_memory();
  return_memory();
  samara::use_kernels_of_processor();
  std::signal(SIGXFSZ, SIG_IGN); // a file that grows too large is one that cannot be written, with a message
  if (!models.empty())
    options.model = models[0];
  if (models.size() < 2)
    return samara::execute(options);
  options.several = std::move(models);
  return samara::execute(options);
}
