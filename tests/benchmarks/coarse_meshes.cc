// How long may an element be? The table of doc/theory/element.md: errors against the angles by which
// Beam::coarse_place() warns. Clamped rods bent by a moment into an arc, a hairpin by a dead force, and the deep arch
// near its limit load.

#include <samara/cosserat/beam.h>

#include "../scene.h"

#include <cstdio>

using namespace samara;

namespace
{
  struct Case
  {
    std::string              name, file, body, probe;
    std::vector<std::string> overrides;
    unsigned int             fine;
  };

  /** Solution of a mesh: the end, and the largest angles [deg] of an element, first in the middle of a path, too. */
  struct Found
  {
    bool    converged = true;
    Vector3 x;
    double  between_ends = 0, unresolved = 0;
    bool    warns = false;
  };

  Found
  solve(const Case &model, const unsigned int degree, const unsigned int elements)
  {
    auto overrides = model.overrides;
    overrides.push_back("Bodies/" + model.body + "/Degree = " + std::to_string(degree));
    overrides.push_back("Bodies/" + model.body + "/Elements = " + std::to_string(elements));
    Scene scene(model.file, overrides);
    Found found;
    try
      {
        scene.equilibrium();
      }
    catch (const NotConverged &)
      {
        found.converged = false;
      }
    const auto         &beam  = scene.input.model.find<Beam>(model.body, "body");
    const State        &state = scene.context.state;
    std::vector<double> e(beam.n_strains());
    beam.strains(state.point(), e.data());
    for (unsigned int i = 0; i < beam.n_elements(); ++i)
      {
        const auto turn    = beam.turn(i, state, e.data());
        found.between_ends = std::max(found.between_ends, turn.between_ends * 180 / M_PI);
        found.unresolved   = std::max(found.unresolved, turn.unresolved * 180 / M_PI);
      }
    found.warns = scene.stream.str().find("represents well") != std::string::npos;
    for (unsigned int i = 0; i < 3; ++i)
      found.x(i) = scene.value(model.probe + ".displacement " + "xyz"[i]);
    return found;
  }
} // namespace

int
main()
{
  const std::vector<Case> cases = {
    {"roll-up to a circle", "prm/benchmarks/roll_up.prm", "beam", "beam.end", {}, 64},
    {"elastica", "prm/benchmarks/elastica.prm", "beam", "beam.end", {}, 64},
    {"deep arch, 0.95 of the limit",
     "prm/benchmarks/deep_arch.prm",
     "arch",
     "arch.middle",
     {"Loads/crown force/Force = 0, -852.5, 0"},
     64},
    {"deep arch beyond it",
     "prm/benchmarks/deep_arch.prm",
     "arch",
     "arch.middle",
     {"Static/Path = arc length"},
     64}};
  for (const auto &model : cases)
    {
      const Found fine = solve(model, 4, model.fine);
      std::printf("\n%s (%.4f %.4f %.4f)\n\n| degree | elements | between ends | unresolved | error | warns |\n",
                  model.name.c_str(),
                  fine.x(0),
                  fine.x(1),
                  fine.x(2));
      std::printf("|---|---|---|---|---|---|\n");
      for (unsigned int degree = 1; degree <= 4; ++degree)
        for (const unsigned int elements : {2, 4, 6, 8, 10, 12, 16, 24, 32, 64})
          {
            const Found found = solve(model, degree, elements);
            std::printf("| %u | %u | %.0f | %.1f | %.1e%s | %s |\n",
                        degree,
                        elements,
                        found.between_ends,
                        found.unresolved,
                        (found.x - fine.x).norm() / fine.x.norm(),
                        found.converged ? "" : " not converged",
                        found.warns ? "yes" : "no");
          }
    }
}
