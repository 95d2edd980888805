#include <samara/aero/air.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace samara
{
  void
  Air::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    prm.add("Density", density, "Density of the air [kg/m^3].", Double(1e-300));
    prm.add("Speed of sound",
            speed_of_sound,
            "Speed of sound, of which the Mach number is a part [m/s].",
            Double(1e-300));
    prm.add("Wind", components, "Velocity of the air, inertial components, functions of time t [m/s].");
    prm.add("Shear exponent",
            exponent,
            "p of a wind that grows with the height as (z/z_ref)^p; 0: the same everywhere [1].");
    prm.add("Shear height",
            reference_height,
            "z_ref: height above the ground at which the wind is as given [m].",
            Double(1e-300));
    prm.add("Ground", ground, "Inertial coordinate z of the ground above which heights are measured [m].");
  }



  void
  Air::initialize(Model &)
  {}



  Vector3
  Air::gradient(const double z, const double time) const
  {
    const double height = (z - ground) / reference_height;
    if (exponent == 0 || height <= lowest)
      return Vector3::Zero();
    const double slope = exponent * std::pow(height, exponent - 1) / reference_height;
    return slope * Vector3(components[0](time), components[1](time), components[2](time));
  }



  double
  Air::next_corner(const double from, const double to) const
  {
    return std::min(
      {components[0].next_corner(from, to), components[1].next_corner(from, to), components[2].next_corner(from, to)});
  }



  const Air &
  Air::of(const Model &model, const std::string &name)
  {
    if (!name.empty())
      return model.find<Air>(name, "air");
    const Air *only = nullptr;
    for (const auto &item : model.items)
      if (const auto *const air = dynamic_cast<const Air *>(item.get()))
        {
          if (only != nullptr)
            throw std::invalid_argument("there are several airs, <" + only->name + "> and <" + air->name +
                                        ">: say which one it is with <Air>");
          only = air;
        }
    if (only == nullptr)
      throw std::invalid_argument("the model has no air: add an object of type <air> to subsection <Aerodynamics>");
    if (only->is_faulty)
      throw FollowUp();
    return *only;
  }
} // namespace samara
