#ifndef samara_model_load_of_air_h
#define samara_model_load_of_air_h

#include <samara/model/state.h>

namespace samara
{
  /** Two of the ways that the power goes which air takes from what moves in it [W]. */
  struct AirPower
  {
    double induced = 0, profile = 0;
  };



  /** An item all of whose loads are those of the air. */
  class LoadOfAir
  {
  public:
    virtual ~LoadOfAir() = default;

    virtual AirPower air_power(const Point<double> &point) const = 0;
  };
} // namespace samara

#endif
