#include <samara/base/errors.h>
#include <samara/base/finite.h>

namespace samara
{
  void
  throw_not_finite(const double number, const std::string &what)
  {
    throw NotConverged(what + " is not a finite number (" + (std::isnan(number) ? "nan" : "infinite") +
                       ").\n  Rows before it are written. Look for lengths, masses or stiffnesses that are far too "
                       "large or too small, or for a wrong unit.");
  }
} // namespace samara
