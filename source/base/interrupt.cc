#include <samara/base/interrupt.h>

#include <csignal>

namespace samara
{
  namespace
  {
    volatile std::sig_atomic_t signal_seen = 0;
    unsigned int               n_guards    = 0;

    void
    note(const int signal)
    {
      signal_seen = signal;
      std::signal(signal, SIG_DFL);
    }
  } // namespace



  InterruptGuard::InterruptGuard()
  {
    if (n_guards++ > 0)
      return;
    signal_seen = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
  }



  InterruptGuard::~InterruptGuard()
  {
    if (--n_guards > 0)
      return;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }



  bool
  InterruptGuard::was_interrupted() const
  {
    return signal_seen != 0;
  }



  void
  forget_interrupts()
  {
    n_guards    = 0;
    signal_seen = 0;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }



  void
  throw_if_interrupted()
  {
    if (n_guards > 0 && signal_seen != 0)
      throw Interrupted("interrupted; what was computed up to there is written");
  }
} // namespace samara
