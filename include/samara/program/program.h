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

  /**
   * Reference of all kinds and their entries as Markdown; of one kind, subsection, analysis or part if its name is
   * given.
   * @throws InputError with the nearest name
   */
  void print_reference(std::ostream &out, const std::string &about = "");

  /** The names of all kinds, without their entries. */
  void print_kinds(std::ostream &out);

  /** What a part is, with its sketch, and its arguments. @throws InputError */
  void print_part(std::ostream &out, const std::string &name);

  /**
   * Write a commented model of this kind, "rotor", that runs; to the standard output without a @p file. A file that is
   * there is not written over. @throws InputError
   */
  void begin_model(const std::string &kind, const std::string &file, Log &log);
} // namespace samara

#endif
