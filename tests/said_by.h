#ifndef samara_tests_said_by_h
#define samara_tests_said_by_h

#include <string>

namespace samara
{
  /** What an exception of a kind says that @p action ends with; "" without one. */
  template <typename Exception, typename Action>
  std::string
  said_by(const Action &action)
  {
    try
      {
        action();
      }
    catch (const Exception &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace samara

#endif
