#ifndef samara_model_bends_h
#define samara_model_bends_h

#include <samara/model/state.h>

#include <string>
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
   * What items have whose constraints have bends, as where something slides across an end of an element: steps in time
   * end on both sides of them.
   */
  class HasBends
  {
  public:
    virtual ~HasBends() = default;

    virtual std::vector<Bend> bends() const = 0;
  };



  /**
   * What items have that hold something only as long as a coordinate is between two places [m], as what slides along a
   * beam: a step in time ends where it gets there, and the next one begins without what held it.
   */
  class CanLeave
  {
  public:
    virtual ~CanLeave() = default;

    struct Exits
    {
      unsigned int coordinate;
      double       lower, upper; ///< infinite where it cannot leave
      double       length;       ///< between its ends: places are exact to a small part of it
    };
    /** None if it never leaves: the two places are infinite. */
    virtual Exits exits() const                      = 0;
    virtual bool  has_left(const State &state) const = 0;

    /** Nothing holds it from here on. Its velocities and places stay as they are. */
    virtual void leave(State &state) const = 0;

    /** "<bead> has left <rod>", for reports. */
    virtual std::string text_of_leaving() const = 0;
  };
} // namespace samara

#endif
