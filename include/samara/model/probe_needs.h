#ifndef samara_model_probe_needs_h
#define samara_model_probe_needs_h

#include <samara/model/item.h>

namespace samara
{
  /**
   * Functions of probes that look at places, triads and joint coordinates alone, or at these and velocities. What
   * they do not look at need not be computed for them. Any other function may look at all of a state.
   */
  struct OfPlaces
  {
    std::function<double(const State &)> value;

    double
    operator()(const State &state) const
    {
      return value(state);
    }
  };
  struct OfVelocities : OfPlaces
  {};



  /** What some probe looks at; forces are joint forces, section forces, accelerations and whatever is not known. */
  struct ProbeNeeds
  {
    bool velocities = false, forces = false;

    explicit ProbeNeeds(const std::vector<Probe> &probes)
    {
      for (const auto &probe : probes)
        if (probe.value.target<OfVelocities>() != nullptr)
          velocities = true;
        else if (probe.value.target<OfPlaces>() == nullptr)
          forces = true;
    }
  };
} // namespace samara

#endif
