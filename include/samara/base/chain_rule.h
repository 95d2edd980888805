#ifndef samara_base_chain_rule_h
#define samara_base_chain_rule_h

#include <samara/base/jet.h>

namespace samara
{
  /** f(x) from f, f', f'' at the value of x. Where f has no derivatives, neither has the result. */
  inline Jet
  chain(const Jet &x, const double f, const double df, const double ddf)
  {
    return {f, df * x.first, ddf * x.first * x.first + df * x.second};
  }
} // namespace samara

#endif
