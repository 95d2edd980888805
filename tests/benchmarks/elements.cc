// What the elements of beams and shells cost at a point of integration, by their degree: strains, stresses and forces
// of an iteration, and the tangent matrix. Microseconds of the processor, the least of several runs; asserts nothing.

#include <samara/cosserat/beam.h>
#include <samara/cosserat/shell.h>

#include "../scene.h"

#include <algorithm>
#include <cstdio>

#include "cpu_seconds.h"

using namespace samara;

namespace
{
  std::string
  beam(const unsigned int degree)
  {
    return "set Analyses = static\nset Threads = 1\n"
           "subsection Sections\nsubsection s\nset Type = rectangle\nset E = 70e9\nset Density = 2700\n"
           "set Width 2 = 0.02\nset Width 3 = 0.03\nend\nend\n"
           "subsection Bodies\nsubsection body\nset Type = beam\nset Points = 0, 0, 0; 10, 0, 0\nset Degree = " +
           std::to_string(degree) + "\nset Section = s\nset Elements = " + std::to_string(400 / degree) +
           "\nend\nend\n";
  }

  std::string
  shell(const unsigned int degree)
  {
    const std::string n = std::to_string(24 / (degree + 1));
    return "set Analyses = static\nset Threads = 1\n"
           "subsection Bodies\nsubsection body\nset Type = shell\nset Patches = sin(u), v, cos(u)\nset Degree = " +
           std::to_string(degree) +
           "\nset E = 70e9\nset Poisson ratio = 0.3\nset Thickness = 0.01\nset Density = 2700\n" +
           "set Elements = " + n + ", " + n + "\nend\nend\n";
  }

  /** The least time of a call of @p f [s]. */
  template <typename Function>
  double
  least(const Function &f)
  {
    double result = 1e300;
    for (unsigned int run = 0; run < 40; ++run)
      {
        const double start = cpu_seconds();
        for (unsigned int i = 0; i < 5; ++i)
          f();
        result = std::min(result, (cpu_seconds() - start) / 5);
      }
    return result;
  }

  void
  measure(const char *kind, const unsigned int degree, const unsigned int strains_at_a_point, const std::string &model)
  {
    Scene               scene(model);
    const System       &system = scene.system;
    const unsigned int  points = system.layout.n_strains / strains_at_a_point;
    State               state  = system.reference();
    std::vector<double> z(system.size()), e(system.layout.n_strains), rates(e), stress(e), r(system.size() + 6);
    for (unsigned int i = 0; i < z.size(); ++i)
      z[i] = 1e-3 * std::sin(i + 1.);
    system.update(state, z);
    system.stresses(state, state.stress);
    SparseMatrix K(system.layout.pattern);
    const auto   point   = state.point();
    const double forces  = least([&] {
      system.strains(point, e.data());
      system.stresses(e.data(), rates.data(), stress.data());
      system.add_terms(point, r.data());
    });
    const double tangent = least([&] { system.add_tangent(point, K); });
    std::printf("%s,%u,%u,%.3f,%.3f\n", kind, degree, points, 1e6 * forces / points, 1e6 * tangent / points);
  }
} // namespace



int
main()
{
  std::printf("element,degree,points,strains stresses forces [us a point],tangent [us a point]\n");
  for (const unsigned int degree : {1, 2, 3, 4})
    measure("beam", degree, 6, beam(degree));
  for (const unsigned int degree : {1, 2, 3, 4})
    measure("shell", degree, 12, shell(degree));
}
