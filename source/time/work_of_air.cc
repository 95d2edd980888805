#include <samara/time/work_of_air.h>

namespace samara
{
  AirOfSystem::AirOfSystem(const System &system)
    : system(system)
  {
    for (unsigned int i = 0; i < system.n_loads(); ++i)
      if (const auto *const item = dynamic_cast<const LoadOfAir *>(&system.item_of_load(i)))
        {
          loads.push_back(i);
          items.push_back(item);
        }
  }



  WorkOfAir
  AirOfSystem::powers(const Point<double> &point) const
  {
    WorkOfAir result;
    if (is_empty())
      return result;
    force.assign(system.size() + 6, 0.);
    for (unsigned int i = 0; i < loads.size(); ++i)
      {
        system.add_load(loads[i], point, force.data());
        const AirPower power = items[i]->air_power(point);
        result.induced += power.induced;
        result.profile += power.profile;
      }
    for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
      result.on_model -= force[i] * point.y[6 + i];
    return result;
  }
} // namespace samara
