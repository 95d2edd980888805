#ifndef samara_analysis_progress_h
#define samara_analysis_progress_h

#include <samara/base/log.h>
#include <samara/base/tell_progress.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace samara
{
  class ReportPage;

  /**
   * While one lives, the log has a line every ten seconds that says what an analysis is doing, and how far it is; a
   * terminal one that changes more often, and the page of a watched run has it in its head:
   *
   *     modal: basis of 40 vectors for 10 modes, 20 s
   *
   * A thread of its own does that, since to factorise a large matrix may take longer. Meanwhile nobody else writes to
   * the log, or adds to the page if that is told, too: end it before.
   */
  class Progress
  {
  public:
    /** @p analysis: what stands in front, "modal"; @p doing: what begins; @p page: null, or that of the context; @p
     * between_lines: of a log that is no terminal [s]. */
    Progress(Log               &log,
             const std::string &analysis,
             const std::string &doing,
             ReportPage        *page,
             double             between_lines = 10);
    ~Progress();
    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    /** What is being done from now on. */
    void operator()(const std::string &doing);

    /** The same for who knows nothing of analyses; not to be called when this is gone. */
    TellProgress teller();

  private:
    using Clock = std::chrono::steady_clock;

    Log                    &log;
    ReportPage             *page;
    const std::string       analysis;
    const double            between_lines;
    const Clock::time_point begin;
    std::mutex              mutex; ///< of the two below
    std::string             doing;
    bool                    has_ended = false;
    std::condition_variable end;
    std::thread             thread; ///< last, so that it finds all others

    void tell();
  };
} // namespace samara

#endif
