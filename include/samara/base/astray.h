#ifndef samara_base_astray_h
#define samara_base_astray_h

#include <samara/base/errors.h>

namespace samara
{
  /**
   * Equations have no value at an iterate of Newton's method, as an inflow whose states belong to no flow: what() says
   * why. It has gone astray, and a shorter step may not.
   */
  class Astray : public NotConverged
  {
  public:
    using NotConverged::NotConverged;
  };
} // namespace samara

#endif
