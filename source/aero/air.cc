#include <samara/aero/air.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    prm.add("Gust",
            gust,
            "Velocity of the air in addition to the wind, inertial components, functions of the place x, y, z and of "
            "time t: 0, 0, 3 m/s * (1 - cos(2*pi*(x - 30 m/s * t)/(50 m))). Steps end at its corners [m/s].");
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
  {
    for (const auto &component : gust)
      {
        has_gust      = has_gust || !component.is_zero();
        gust_varies   = gust_varies || component.depends_on_place();
        gust_switches = gust_switches || component.switches_in_place();
      }
  }



  Matrix3
  Air::gradient(const Vector3 &x, const double time) const
  {
    Matrix3      result = Matrix3::Zero();
    const double height = (x(2) - ground) / reference_height;
    if (exponent != 0 && height > lowest)
      {
        const double slope = exponent * std::pow(height, exponent - 1) / reference_height;
        result.col(2)      = slope * Vector3(components[0](time), components[1](time), components[2](time));
      }
    for (unsigned int i = 0; i < 3 && gust_varies; ++i)
      result.row(i) += gust[i].gradient(x, time).transpose();
    return result;
  }



  double
  Air::next_corner(const double from, const double to) const
  {
    double first = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < 3; ++i)
      first = std::min({first, components[i].next_corner(from, to), gust[i].next_corner(from, to)});
    return first;
  }



  void
  Air::pieces(const Vector3 &x, const double time, std::vector<double> &result) const
  {
    for (const auto &component : gust)
      if (component.switches_in_place())
        component.pieces(x, time, result);
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
