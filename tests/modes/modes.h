#ifndef samara_tests_modes_modes_h
#define samara_tests_modes_modes_h

#include "../scene.h"

#include <algorithm>
#include <cmath>

namespace samara
{
  /** Where a function changes its sign between @p a and @p b: Illinois' false position, to 1e-9 of b. */
  template <typename Function>
  double
  root_of(const Function &f, double a, double b)
  {
    double fa = f(a), fb = f(b);
    if (fa * fb > 0)
      throw std::invalid_argument("no change of sign between " + std::to_string(a) + " and " + std::to_string(b));
    for (unsigned int i = 0; i < 60 && std::abs(b - a) > 1e-9 * std::abs(b); ++i)
      {
        const double c = b - fb * (b - a) / (fb - fa), fc = f(c);
        if (fc * fb < 0)
          {
            a  = b;
            fa = fb;
          }
        else
          fa /= 2;
        b  = c;
        fb = fc;
        if (fc == 0)
          break;
      }
    return b;
  }



  /** Of all modes of the model's equilibrium, in order [rad/s]. */
  inline std::vector<double>
  frequencies(Scene &scene)
  {
    scene.equilibrium();
    std::vector<double> result;
    for (const auto &mode : scene.modes())
      result.push_back(mode.frequency());
    std::sort(result.begin(), result.end());
    return result;
  }



  /** A model, its constants overridden: "P = 3". */
  inline Scene
  with_constants(const std::string &model, const std::vector<std::string> &constants)
  {
    std::vector<std::string> overrides;
    for (const auto &c : constants)
      overrides.push_back("Constants/" + c);
    return Scene(model, overrides);
  }



  inline std::string
  exact(const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
  }



  /** A shipped file with the part from the subsection @p from up to the subsection @p to replaced. */
  inline std::string
  with_part(const std::string &file, const std::string &from, const std::string &to, const std::string &text)
  {
    std::ifstream     in(std::string(SAMARA_SOURCE_DIR) + "/" + file);
    std::stringstream stream;
    stream << in.rdbuf();
    const std::string all   = stream.str();
    const auto        first = all.find("subsection " + from), last = all.find("subsection " + to);
    if (first == std::string::npos || last == std::string::npos)
      throw std::invalid_argument(file + " has no such subsections");
    return all.substr(0, first) + text + all.substr(last);
  }



  /** −λ² of the mode nearest to instability: falls to zero at a buckling load. For models without damping. */
  inline double
  smallest_square(const std::vector<Mode> &modes)
  {
    double smallest = 1e300;
    for (const auto &mode : modes)
      smallest = std::min(smallest, -(mode.lambda * mode.lambda).real());
    return smallest;
  }



  /** The load P between @p a and @p b at which the model with this constant buckles: its lowest frequency is zero. */
  inline double
  buckling_load(const std::string &model, const double a, const double b, const std::string &constant = "P")
  {
    return root_of(
      [&](const double P) {
        Scene scene = with_constants(model, {constant + " = " + exact(P)});
        scene.equilibrium();
        return smallest_square(scene.modes());
      },
      a,
      b);
  }



  /** Share of direction @p i of the nodes' axes in the displacements of a mode; 0 of all three for one that only
   * rotates. */
  inline double
  share(const System &system, const Mode &mode, const unsigned int i)
  {
    double part = 0, all = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const auto u = mode.shape.segment<3>(system.layout.of_node(node));
        part += std::norm(u(i));
        all += u.squaredNorm();
      }
    return all > 1e-6 * mode.shape.squaredNorm() ? part / all : 0.;
  }



  /** Whether it is the second of the two real modes ±ε to which round-off splits the double zero of a free motion. */
  inline bool
  is_second_of_zero(const Mode &mode)
  {
    return mode.lambda.imag() == 0 && mode.lambda.real() < 0 && mode.frequency() < 0.1;
  }



  /** Frequencies of the modes that move mostly in direction @p i of the nodes' axes. */
  inline std::vector<double>
  frequencies(Scene &scene, const unsigned int i)
  {
    std::vector<double> result;
    for (const auto &mode : scene.modes())
      if (!is_second_of_zero(mode) && share(scene.system, mode, i) > 0.5)
        result.push_back(mode.frequency());
    return result;
  }
} // namespace samara

#endif
