#ifndef samara_tests_shells_models_h
#define samara_tests_shells_models_h

#include "../scene.h"

namespace samara
{
  /** A model of one shell of this name <s>, with further entries of it, joints, loads, and what stands at the top. */
  struct ShellModel
  {
    std::string  patches, elements = "4, 4", entries, joints, loads, top;
    unsigned int degree = 3;
    double       E = 1, nu = 0.3, thickness = 0.01, density = 1;

    std::string
    text() const
    {
      std::ostringstream out;
      out.precision(17);
      out << top << "\nsubsection Bodies\n subsection s\n  set Type = shell\n  set Patches = " << patches
          << "\n  set Elements = " << elements << "\n  set Degree = " << degree << "\n  set E = " << E
          << "\n  set Poisson ratio = " << nu << "\n  set Thickness = " << thickness << "\n  set Density = " << density
          << '\n'
          << entries << " end\nend\nsubsection Joints\n"
          << joints << "end\nsubsection Loads\n"
          << loads << "end\n";
      return out.str();
    }
  };

  inline std::string
  support(const std::string &name, const std::string &along, const std::string &fixed)
  {
    return " subsection " + name + "\n  set Type = support\n  set Along = " + along + "\n  set Fixed = " + fixed +
           "\n end\n";
  }

  /** A patch of straight lines between four corners, "x, y, z": (u, v) = (0, 0), (1, 0), (0, 1), (1, 1). */
  inline std::string
  bilinear(const std::array<Vector3, 4> &x)
  {
    std::ostringstream out;
    out.precision(17);
    for (unsigned int d = 0; d < 3; ++d)
      out << (d > 0 ? ", " : "") << x[0](d) << "*(1-u)*(1-v) + " << x[1](d) << "*u*(1-v) + " << x[2](d) << "*(1-u)*v + "
          << x[3](d) << "*u*v";
    return out.str();
  }

  /** A square of side one, its inside warped by so much. */
  inline std::string
  warped_square(const double warp)
  {
    const std::string w = std::to_string(warp);
    return "u + " + w + "*sin(pi*u)*sin(2*pi*v), v + " + w + "*sin(2*pi*u)*sin(pi*v), 0";
  }

  /** A quarter of a hemisphere of radius 10 with a hole of 18 degrees at the pole; u goes round, v from pole to
   * equator. */
  const std::string hemisphere =
    "10*sin(pi/10+0.4*pi*v)*cos(pi/2*u), 10*sin(pi/10+0.4*pi*v)*sin(pi/2*u), 10*cos(pi/10+0.4*pi*v)";
} // namespace samara

#endif
