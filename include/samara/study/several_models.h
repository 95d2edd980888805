#ifndef samara_study_several_models_h
#define samara_study_several_models_h

#include <samara/study/options.h>

namespace samara
{
  /**
   * Run all models of @p options.several by @p program, each in a process of its own that is forked from this one: the
   * libraries are loaded once. What each of them tells is printed as a whole when it has ended. The results of
   * model.prm go into model in the folder of @p options, results/model by default; the other options hold for all of
   * them.
   *
   * @return the largest exit code of all
   * @throws InputError if two models would have the same folder
   * @throws Interrupted
   */
  int execute_all(const Options &options, const Program &program);
} // namespace samara

#endif
