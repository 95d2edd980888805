#ifndef samara_base_interrupt_h
#define samara_base_interrupt_h

#include <stdexcept>

namespace samara
{
  /** The user has stopped the run (Ctrl-C, SIGTERM); what was computed is written. */
  class Interrupted : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };



  /**
   * While one lives, SIGINT and SIGTERM do not end the program but are only noted; a second one ends it at once. One
   * may live within the life of another.
   */
  class InterruptGuard
  {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard &)            = delete;
    InterruptGuard &operator=(const InterruptGuard &) = delete;

    bool was_interrupted() const;
  };

  /** In a process that was just forked: as if no guard lived and no signal had come. */
  void forget_interrupts();

  /** To be called now and then by what takes long and has nothing to write. @throws Interrupted */
  void throw_if_interrupted();
} // namespace samara

#endif
