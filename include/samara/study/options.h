#ifndef samara_study_options_h
#define samara_study_options_h

#include <functional>
#include <string>
#include <vector>

namespace samara
{
  /** What the command line asks for. */
  struct Options
  {
    std::string              model, output, help_about;
    std::string              part; ///< of which the arguments are asked for
    std::string begun; ///< the kind of model that is begun; `model` is then the file, or empty: it is printed
    bool        kinds = false;
    std::vector<std::string> overrides;
    std::vector<std::string> several; ///< models, where there are more than one: see execute_all()
    bool                     check = false, parameters = false, quiet = false, restart = false;
    bool                     report = false; ///< the page of results that are there, or of several beside each other
    bool                     watch  = false; ///< the page while the model runs
    unsigned int             jobs = 1; ///< members of a study, or models, that run side by side
  };

  /** What runs one model and returns the exit code: execute() of program/program.h, or what stands for it in a test. */
  using Program = std::function<int(const Options &)>;
} // namespace samara

#endif
