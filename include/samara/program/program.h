#ifndef samara_program_program_h
#define samara_program_program_h

#include <samara/base/log.h>
#include <samara/study/options.h>

#include <ostream>
#include <string>

namespace samara
{
  /** Run, check or explain; returns on success. @throws InputError, NotConverged */
  void run(const Options &options, Log &log);

  /** run() with one thread until the model says more; failures are told on std::cerr. Returns the exit code. */
  int execute(const Options &options);

  /** Reference of all kinds and their entries as Markdown; of one kind if its name is given. @throws InputError */
  void print_reference(std::ostream &out, const std::string &about = "");
} // namespace samara

#endif
