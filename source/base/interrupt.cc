#include <samara/base/interrupt.h>

#include <csignal>

namespace samara
{
  namespace
  {
    volatile std::sig_atomic_t signal_seen = 0;

    void
    note(const int signal)
    {
      signal_seen = signal;
      std::signal(signal, SIG_DFL);
    }
  } // namespace



  InterruptGuard::InterruptGuard()
  {
    signal_seen = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
  }



  InterruptGuard::~InterruptGuard()
  {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
  }



  bool
  InterruptGuard::was_interrupted() const
  {
    return signal_seen != 0;
  }
} // namespace samara
