#ifndef samara_program_h
#define samara_program_h

#include <samara/base/log.h>

#include <functional>
#include <string>
#include <vector>

namespace samara
{
  /** What the command line asks for. */
  struct Options
  {
    std::string              model, output, help_about;
    std::vector<std::string> overrides;
    std::vector<std::string> several; ///< models, where there are more than one: see execute_all()
    bool                     check = false, parameters = false, quiet = false, restart = false;
    unsigned int             jobs = 1; ///< members of a study, or models, that run side by side
  };

  /** Run, check or explain; returns on success. @throws InputError, NotConverged */
  void run(const Options &options, Log &log);

  /** run() with one thread until the model says more; failures are told on std::cerr. Returns the exit code. */
  int execute(const Options &options);

  /** execute(), or what stands for it in a test. */
  using Program = std::function<int(const Options &)>;

  /** Reference of all kinds and their entries as Markdown; of one kind if its name is given. @throws InputError */
  void print_reference(std::ostream &out, const std::string &about = "");
} // namespace samara

#endif
