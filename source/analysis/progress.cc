#include <samara/analysis/progress.h>
#include <samara/base/text.h>
#include <samara/report/report_page.h>

namespace samara
{
  namespace
  {
    /** Between two lines of a terminal, where each takes the place of the one before [s]. */
    constexpr double on_terminal = 0.5;

    /** Between two looks at the time. */
    constexpr std::chrono::milliseconds between_looks(50);
  } // namespace



  Progress::Progress(Log               &log,
                     const std::string &analysis,
                     const std::string &doing,
                     ReportPage *const  page,
                     const double       between_lines)
    : log(log)
    , page(page)
    , analysis(analysis)
    , between_lines(between_lines)
    , begin(Clock::now())
    , doing(doing)
    , thread([this]() { tell(); })
  {}



  Progress::~Progress()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      has_ended = true;
    }
    end.notify_one();
    thread.join();
  }



  void
  Progress::operator()(const std::string &now)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    doing = now;
  }



  TellProgress
  Progress::teller()
  {
    return [this](const std::string &now) { (*this)(now); };
  }



  void
  Progress::tell()
  {
    const auto   seconds  = [this]() { return std::chrono::duration<double>(Clock::now() - begin).count(); };
    const double between  = log.is_terminal() ? on_terminal : between_lines;
    double       next     = between;
    bool         has_told = false;
    for (std::unique_lock<std::mutex> lock(mutex); !end.wait_for(lock, between_looks, [this]() { return has_ended; });)
      {
        const bool is_line = seconds() >= next, is_page = page != nullptr && page->is_due();
        if (!is_line && !is_page)
          continue;
        const std::string text = analysis + ": " + doing + ", " + number_to_text("%.0f", seconds()) + " s";
        lock.unlock(); // a page takes its time
        if (is_line)
          log.progress("  " + text);
        has_told = has_told || is_line;
        next += is_line ? between : 0;
        try
          {
            if (is_page)
              page->watch(text);
          }
        catch (const std::exception &)
          {
            page = nullptr; // who writes results next says why that cannot be
          }
        lock.lock();
      }
    if (has_told && log.is_terminal())
      log.progress(""); // what comes next begins a line
  }
} // namespace samara
