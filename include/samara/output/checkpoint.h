#ifndef samara_output_checkpoint_h
#define samara_output_checkpoint_h

#include <samara/model/state.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /** All that a run needs to go on as if it had never been interrupted: to the last bit. */
  struct Checkpoint
  {
    State  state;
    double step = 0; ///< the next one [s]

    /** What else integrators and the like remember, each under its name. @{ */
    std::map<std::string, double>              numbers;
    std::map<std::string, std::vector<double>> arrays;
    /** @} */

    /** All entries of the model that the state belongs to; compared by those who read. */
    std::shared_ptr<const std::string> model = std::make_shared<const std::string>();
  };



  /**
   * Write a checkpoint in place of the one that may be there. Whatever happens to the process, the file is the
   * old one or the new one. Throws a std::runtime_error with the name of the file if it cannot be written; the old one
   * stays then, and nothing else. A power failure is survived with @p wait only, which waits for the disk.
   *
   * The file has a head of 512 bytes with a text that tells what it is, its format and a checksum, and behind it HDF5,
   * which HDF5's tools find there: state/q, state/time and so on; step; numbers/0, numbers/1, ..., arrays/0, ... with
   * the attribute `name`; and the letters of the model.
   */
  void write_checkpoint(const std::string &file, const Checkpoint &checkpoint, bool wait = true);

  /**
   * Read what write_checkpoint() wrote. Throws an InputError if the file is missing, is no checkpoint, is one of
   * another format, or has changed or lost a byte. Whether it fits the model is for the caller to see: the model's
   * entries and sizes.
   */
  Checkpoint read_checkpoint(const std::string &file);
} // namespace samara

#endif
