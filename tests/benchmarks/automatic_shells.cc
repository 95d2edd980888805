// Shells with elements that are found, and with uniform ones: what was wanted, estimated, and what the error of the
// strains in the energy norm is, against a mesh of four times as many elements and two degrees more. Prints comma
// separated values; drawn by contrib/figures automatic_shells.

#include "../shells/strain_error.h"

#include <cstdio>

using namespace samara;

namespace
{
  struct Problem
  {
    std::string name, model, shell;
    Words       entries;
    double      finest; ///< the smallest error that is asked for
  };

  unsigned int
  unknowns_of(const std::string &model, const Words &overrides)
  {
    return Scene(model, overrides).system.size();
  }
} // namespace



int
main()
{
  const std::vector<Problem> problems = {
    {"roof", "prm/benchmarks/shells/scordelis_lo_roof.prm", "roof", {}, 3e-3},
    {"tank", "prm/benchmarks/shells/clamped_tank.prm", "tank", {}, 3e-3},
    {"plate", "prm/verification/plate.prm", "plate", {"Bodies/plate/Degree = 3", "Constants/thickness = 1e-2"}, 3e-3},
    {"hemisphere",
     "prm/examples/shells/pinched_hemisphere.prm",
     "shell",
     {"Constants/P = 0.01", "Static/Load steps = 1"},
     3e-2}};
  std::printf("problem,mesh,wanted,estimated,measured,unknowns\n");
  for (const auto &problem : problems)
    {
      const std::string elements = "Bodies/" + problem.shell + "/Elements = ";
      const auto tell = [&](const std::string &mesh, const double wanted, const double estimate, const Words &all) {
        std::printf("%s,%s,%g,%.3g,%.3g,%u\n",
                    problem.name.c_str(),
                    mesh.c_str(),
                    wanted,
                    estimate,
                    error_of(problem.model, all, problem.shell),
                    unknowns_of(problem.model, all));
        std::fflush(stdout);
      };
      for (double wanted = 0.1; wanted > 0.99 * problem.finest; wanted *= std::sqrt(0.1))
        {
          Words all = problem.entries;
          all.push_back(elements + "automatic, " + number_to_text(wanted) + " from 2, 2");
          const FoundMesh found(problem.model, all);
          tell("automatic", wanted, wanted * found.passes.back().estimate, found.overrides);
        }
      for (const unsigned int n : {2, 4, 8})
        {
          Words             all  = problem.entries;
          const std::string both = std::to_string(n) + ", " + std::to_string(n);
          all.push_back(elements + "automatic, 0.999 from " + both);
          const double estimate = FoundMesh(problem.model, all).passes.front().estimate * 0.999;
          all.back()            = elements + both;
          tell("uniform", 0, estimate, all);
        }
    }
}
