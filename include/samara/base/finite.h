#ifndef samara_base_finite_h
#define samara_base_finite_h

#include <cmath>
#include <string>

namespace samara
{
  /** @throws NotConverged saying that @p what is @p number, which is not finite, and what to look for. */
  [[noreturn]] void throw_not_finite(double number, const std::string &what);

  /**
   * What is reported passes here: a number that is not finite ends the run. @p what is called for a name of it, only
   * then. @throws NotConverged
   */
  template <typename Name>
  void
  require_finite(const double number, const Name &what)
  {
    if (!std::isfinite(number))
      throw_not_finite(number, what());
  }
} // namespace samara

#endif
