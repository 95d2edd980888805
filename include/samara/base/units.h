#ifndef samara_base_units_h
#define samara_base_units_h

#include <array>
#include <string>
#include <vector>

namespace samara
{
  /** Exponents of m, kg, s, rad, K. */
  using Dimension = std::array<double, 5>;

  /** The place of the angle in a Dimension; it is the one that may come and go. */
  constexpr unsigned int angle_exponent = 3;



  /** A number in SI units and its dimension: a foot is 0.3048 and a length. */
  struct Quantity
  {
    double    si        = 1;
    Dimension dimension = {{0, 0, 0, 0, 0}};
  };



  struct Unit
  {
    std::string name;
    Quantity    quantity;
  };

  /** All units a number may have. `lb` is the mass. */
  const std::vector<Unit> &units();

  /** The constants everybody has: pi, e, g0, true, false. */
  const std::vector<Unit> &universal_constants();

  /** "a length [m]", "a number", or just "[kg/s^2]" for what has no name. */
  std::string describe(const Dimension &dimension);

  /** Whether two dimensions are the same except for the angle. */
  bool same_but_angle(const Dimension &a, const Dimension &b);
} // namespace samara

#endif
