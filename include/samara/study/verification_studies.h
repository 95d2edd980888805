#ifndef samara_study_verification_studies_h
#define samara_study_verification_studies_h

#include <samara/input/input.h>
#include <samara/study/options.h>

namespace samara
{
  /**
   * Run the <Studies> of the verification analyses of an input by @p run, each into a folder of its own in @p folder,
   * and write report.md there: what was found of the elements, and the tables of all studies. A mere check sees only
   * whether they are studies. @throws InputError, NotConverged as the studies do
   */
  void run_verification_studies(const Options                                     &options,
                                const Input                                       &input,
                                const std::string                                 &folder,
                                const std::function<void(const Options &, Log &)> &run,
                                Log                                               &log);
} // namespace samara

#endif
