#include <samara/model/strain_rows.h>

#include <algorithm>

namespace samara
{
  bool
  StrainRows::is_viscous() const
  {
    return std::any_of(viscosity.begin(), viscosity.end(), [](const double v) { return v != 0.; });
  }
} // namespace samara
