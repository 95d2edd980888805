#include <samara/time/rival_alpha.h>
#include <samara/time/rival_bdf.h>
#include <samara/time/rival_energy_decaying.h>
#include <samara/model/virtual_mass.h>
#include <samara/time/rivals.h>

#include <stdexcept>

namespace samara
{
  const std::vector<std::string> &
  rival_names()
  {
    static const std::vector<std::string> names = {
      "generalised alpha", "trapezoidal", "energy decaying", "BDF index 2", "BDF index 1"};
    return names;
  }



  std::unique_ptr<Integrator>
  make_rival(const std::string &name, const System &system, const RivalSettings &settings)
  {
    if (system.layout.n_states > 0)
      throw std::invalid_argument("the integrator <" + name + "> knows no states of first order; <family> does");
    for (const auto &of_node : virtual_mass(system.model))
      if (!of_node.isZero(0.))
        throw std::invalid_argument("the integrator <" + name + "> knows no virtual mass of the air; <family> does");
    if (name == "generalised alpha")
      return std::make_unique<GeneralisedAlpha>(system,
                                                GeneralisedAlpha::of_spectral_radius(settings.spectral_radius),
                                                true,
                                                settings);
    if (name == "trapezoidal")
      return std::make_unique<GeneralisedAlpha>(system, GeneralisedAlpha::trapezoidal(), false, settings);
    if (name == "energy decaying")
      return std::make_unique<EnergyDecaying>(system, settings);
    if (name == "BDF index 2")
      return std::make_unique<Bdf>(system, Bdf::Form::stabilised_index_2, settings);
    if (name == "BDF index 1")
      return std::make_unique<Bdf>(system, Bdf::Form::index_1, settings);
    throw std::invalid_argument("there is no integrator <" + name + ">");
  }
} // namespace samara
