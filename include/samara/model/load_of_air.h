#ifndef samara_model_load_of_air_h
#define samara_model_load_of_air_h

#include <samara/model/state.h>

#include <string>

namespace samara
{
  /** Two of the ways that the power goes which air takes from what moves in it [W]. */
  struct AirPower
  {
    double induced = 0, profile = 0;
  };



  /** How the air meets what moves in it, seen over all stations of a model and, in a motion, over many moments. */
  struct FlowSeen
  {
    double       angle = 0, mach = 0;         ///< largest |angle of attack| [rad], Mach number
    std::string  where;                       ///< of that angle
    double       disk = 0, disk_stalled = 0;  ///< Σ r ds of what has an inflow, and beyond stall [m²]
    double       span = 0, span_stalled = 0;  ///< Σ ds of what has none [m]
    unsigned int stations = 0, backwards = 0; ///< and those that are met with more than 90 degrees
  };



  /** An item all of whose loads are those of the air. */
  class LoadOfAir
  {
  public:
    virtual ~LoadOfAir() = default;

    virtual AirPower air_power(const Point<double> &point) const = 0;

    /** Add what it meets in a state. */
    virtual void see_flow(const State &state, FlowSeen &seen) const = 0;
  };
} // namespace samara

#endif
