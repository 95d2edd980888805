#ifndef samara_model_bends_h
#define samara_model_bends_h

#include <vector>

namespace samara
{
  /** A range of a joint coordinate [m] or [rad] within which constraints that depend on it turn fast. */
  struct Bend
  {
    unsigned int coordinate;
    double       from, to;
  };



  /**
   * What items have whose constraints have bends, as where something slides across an end of an element: steps in time end
   * on both sides of them.
   */
  class HasBends
  {
  public:
    virtual ~HasBends() = default;

    virtual std::vector<Bend> bends() const = 0;
  };
} // namespace samara

#endif
