#ifndef samara_base_process_h
#define samara_base_process_h

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace samara
{
  /**
   * A part of this program that runs beside it, in a process of its own: what happens to it does not happen to us. It is
   * forked, so that the libraries, whose loading takes longer than many a run, are loaded once for all. It has a process
   * group of its own: Ctrl-C on the terminal reaches only us, who then decide about it. It does not outlive us, nor the
   * object.
   */
  class Process
  {
  public:
    /**
     * Do @p work, which returns an exit code; what it prints goes to two files. Throws a std::runtime_error if the system
     * refuses; an exit code 126 says that the files cannot be opened, 127 that the work threw an exception.
     */
    Process(const std::function<int()> &work, const std::string &output, const std::string &errors);

    Process(const Process &)            = delete;
    Process &operator=(const Process &) = delete;

    /** Kills it if it still runs. */
    ~Process();

    /** Whether it has ended; does not wait. */
    bool has_ended();

    /** Send a signal, SIGTERM or SIGKILL, to it and to what it has started. */
    void send(int signal) const;

    /** Since it was started [s]. */
    double seconds() const;

    /** @name Once it has ended @{ */

    /** What it returned; −1 if a signal ended it. */
    int exit_code() const;

    /** The signal that ended it; 0: none. */
    int signal() const;

    /** Time of all processors that it took, its own and that of the system on its behalf [s]. */
    double cpu_seconds() const;
    /** @} */

  private:
    pid_t                                 pid    = -1;
    int                                   status = 0;
    bool                                  ended  = false;
    double                                cpu    = 0;
    std::chrono::steady_clock::time_point start;
  };

  /** Ask all to end, and wait some seconds for what they write; what has not ended then is killed with its Process. */
  void end_all(const std::vector<Process *> &processes);
} // namespace samara

#endif
