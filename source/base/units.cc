#include <samara/base/text.h>
#include <samara/base/units.h>

#include <cmath>

namespace samara
{
  namespace
  {
    constexpr double pi     = 3.14159265358979323846;
    constexpr double g0     = 9.80665; // m/s^2, by definition
    constexpr double inch   = 0.0254;
    constexpr double foot   = 12 * inch;
    constexpr double pound  = 0.45359237; // kg
    constexpr double poundf = pound * g0; // N
    constexpr double psi    = poundf / (inch * inch);
    constexpr double knot   = 1852. / 3600.;

    // clang-format off
    //                             m  kg   s rad  K
    constexpr Dimension length   {{1, 0, 0, 0, 0}};
    constexpr Dimension mass     {{0, 1, 0, 0, 0}};
    constexpr Dimension time     {{0, 0, 1, 0, 0}};
    constexpr Dimension plane    {{0, 0, 0, 1, 0}};
    constexpr Dimension heat     {{0, 0, 0, 0, 1}};
    constexpr Dimension number   {{0, 0, 0, 0, 0}};
    constexpr Dimension speed    {{1, 0, -1, 0, 0}};
    constexpr Dimension gravity  {{1, 0, -2, 0, 0}};
    constexpr Dimension force    {{1, 1, -2, 0, 0}};
    constexpr Dimension pressure {{-1, 1, -2, 0, 0}};
    constexpr Dimension energy   {{2, 1, -2, 0, 0}};
    constexpr Dimension work_rate{{2, 1, -3, 0, 0}};
    constexpr Dimension frequency{{0, 0, -1, 0, 0}};
    constexpr Dimension spin     {{0, 0, -1, 1, 0}};
    constexpr Dimension density  {{-3, 1, 0, 0, 0}};
    constexpr Dimension inertia  {{2, 1, 0, 0, 0}};
    constexpr Dimension stiffness{{3, 1, -2, 0, 0}};
    constexpr Dimension area     {{2, 0, 0, 0, 0}};
    constexpr Dimension curvature{{-1, 0, 0, 0, 0}};
    constexpr Dimension line_mass{{-1, 1, 0, 0, 0}};
    constexpr Dimension line_load{{0, 1, -2, 0, 0}};
    // clang-format on

    struct Name
    {
      Dimension   dimension;
      const char *text;
    };

    /** What people call it. */
    const Name names[] = {{number, "a number"},
                          {length, "a length [m]"},
                          {mass, "a mass [kg]"},
                          {time, "a time [s]"},
                          {plane, "an angle [rad]"},
                          {heat, "a temperature [K]"},
                          {speed, "a speed [m/s]"},
                          {gravity, "an acceleration [m/s^2]"},
                          {force, "a force [N]"},
                          {pressure, "a pressure [Pa]"},
                          {energy, "a moment or energy [N*m]"},
                          {work_rate, "a power [W]"},
                          {frequency, "a frequency [1/s]"},
                          {spin, "an angular speed [rad/s]"},
                          {density, "a density [kg/m^3]"},
                          {inertia, "a moment of inertia [kg*m^2]"},
                          {stiffness, "a bending stiffness [N*m^2]"},
                          {area, "an area [m^2]"},
                          {curvature, "a curvature [1/m]"},
                          {line_mass, "a mass per length [kg/m]"},
                          {line_load, "a force per length [N/m]"}};

    std::string
    product_of_base_units(const Dimension &dimension)
    {
      const std::string        base[] = {"m", "kg", "s", "rad", "K"};
      std::vector<std::string> factors;
      for (unsigned int b = 0; b < dimension.size(); ++b)
        if (const double exponent = std::round(1e6 * dimension[b]) / 1e6; exponent == 1)
          factors.push_back(base[b]);
        else if (exponent != 0)
          factors.push_back(base[b] + "^" + number_to_text(exponent));
      return "[" + join(factors, "*") + "]";
    }
  } // namespace



  const std::vector<Unit> &
  units()
  {
    // clang-format off
    static const std::vector<Unit> all = {
      {"m", {1, length}},           {"mm", {1e-3, length}},      {"cm", {1e-2, length}},
      {"km", {1e3, length}},        {"in", {inch, length}},      {"ft", {foot, length}},
      {"kg", {1, mass}},            {"g", {1e-3, mass}},         {"t", {1e3, mass}},
      {"lb", {pound, mass}},        {"slug", {poundf / foot, mass}},
      {"s", {1, time}},             {"ms", {1e-3, time}},        {"min", {60, time}},
      {"h", {3600, time}},          {"K", {1, heat}},
      {"N", {1, force}},            {"kN", {1e3, force}},        {"MN", {1e6, force}},
      {"lbf", {poundf, force}},
      {"Pa", {1, pressure}},        {"kPa", {1e3, pressure}},    {"MPa", {1e6, pressure}},
      {"GPa", {1e9, pressure}},     {"psi", {psi, pressure}},    {"ksi", {1e3 * psi, pressure}},
      {"J", {1, energy}},           {"kJ", {1e3, energy}},
      {"W", {1, work_rate}},        {"kW", {1e3, work_rate}},    {"hp", {550 * foot * poundf, work_rate}},
      {"Hz", {1, frequency}},
      {"rad", {1, plane}},          {"deg", {pi / 180, plane}},  {"rev", {2 * pi, plane}},
      {"rpm", {2 * pi / 60, spin}}, {"kn", {knot, speed}},       {"knot", {knot, speed}},
      {"%", {1e-2, number}}};
    // clang-format on
    return all;
  }



  const std::vector<Unit> &
  universal_constants()
  {
    static const std::vector<Unit> all = {{"pi", {pi, number}},
                                          {"e", {2.71828182845904523536, number}},
                                          {"g0", {g0, gravity}},
                                          {"true", {1, number}},
                                          {"false", {0, number}}};
    return all;
  }



  std::string
  describe(const Dimension &dimension)
  {
    for (const auto &name : names)
      if (same_but_angle(name.dimension, dimension) &&
          std::abs(name.dimension[angle_exponent] - dimension[angle_exponent]) < 1e-6)
        return name.text;
    return product_of_base_units(dimension);
  }



  bool
  same_but_angle(const Dimension &a, const Dimension &b)
  {
    for (unsigned int i = 0; i < a.size(); ++i)
      if (i != angle_exponent && std::abs(a[i] - b[i]) > 1e-6)
        return false;
    return true;
  }
} // namespace samara
