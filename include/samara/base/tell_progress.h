#ifndef samara_base_tell_progress_h
#define samara_base_tell_progress_h

#include <functional>
#include <string>

namespace samara
{
  /**
   * Who works for long says now and then what it is doing and how far it is: "basis of 40 vectors for 10 modes".
   * Whoever likes listens; nobody need.
   */
  using TellProgress = std::function<void(const std::string &doing)>;
} // namespace samara

#endif
