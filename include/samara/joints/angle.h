#ifndef samara_joints_angle_h
#define samara_joints_angle_h

#include <cmath>
#include <complex>

/**
 * @file
 * Angles that count turns. Two frames tell an angle but for whole turns; which turn it is follows from the angle
 * before (doc/theory/joints.md, "Angles").
 */

namespace samara
{
  /** The angle [rad] between −π and π with cosine and sine in the proportion of @p c and @p s. */
  inline double
  angle_of(const double c, const double s)
  {
    return std::atan2(s, c);
  }

  /** Continued along imaginary steps so small that their square is lost: for derivatives by complex steps. */
  inline std::complex<double>
  angle_of(const std::complex<double> &c, const std::complex<double> &s)
  {
    return {std::atan2(s.real(), c.real()),
            (c.real() * s.imag() - s.real() * c.imag()) / (c.real() * c.real() + s.real() * s.real())};
  }



  /** @p angle [rad] less the whole turns nearest to it: between −π and π. */
  inline double
  less_turns(const double angle)
  {
    return std::remainder(angle, 2 * M_PI);
  }

  inline std::complex<double>
  less_turns(const std::complex<double> &angle)
  {
    return {less_turns(angle.real()), angle.imag()};
  }



  /** The angle that two frames tell, in the turn nearest to @p near [rad]. */
  inline double
  in_turn_of(const double angle, const double near)
  {
    return near + less_turns(angle - near);
  }
} // namespace samara

#endif
