// Rotors in their air against the clock, doc/applications/rotor_real_time.md: time of the processor over the time that
// is followed, the least of three runs.
//
//   bench_real_time [n]     n runs of each, 3 if it is not said

#include <samara/analysis/dynamic.h>
#include <samara/analysis/static.h>

#include "../scene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace samara;

namespace
{
  struct Case
  {
    const char *name, *model, *end, *step;
    double      goal; ///< of the processor over real time
  };

  const Case cases[] = {
    {"SA 330, four elastic blades, 33 states of inflow", "prm/rotorcraft/puma_real_time.prm", "4*T", "T/60", 1.},
    {"NREL 5 MW, annular momentum, shear", "prm/rotorcraft/nrel_5mw_shear.prm", "3*2*pi/Omega", "2*pi/Omega/60", 0.2}};

  void
  print(const Case &rotor, const unsigned int n_runs)
  {
    double least = 1e300, iterations = 0, time = 0;
    for (unsigned int i = 0; i < n_runs; ++i)
      {
        Scene      scene(rotor.model,
                    {"Dynamic/Stages = 3",
                          "Dynamic/Newton tolerance = 1e-6",
                          "Dynamic/Pictures = 0",
                          std::string("Dynamic/Step = ") + rotor.step,
                          std::string("Dynamic/End time = ") + rotor.end});
        const bool from_equilibrium =
          std::any_of(scene.input.analyses.begin(), scene.input.analyses.end(), [](auto &a) {
            return dynamic_cast<StaticAnalysis *>(a.get()) != nullptr;
          });
        if (from_equilibrium)
          scene.equilibrium();
        auto &dynamic = scene.analysis<DynamicAnalysis>();
        dynamic.run(scene.context);
        const auto &report = dynamic.report;
        time               = scene.context.state.time;
        least              = std::min(least, report.processor_seconds / time);
        iterations         = double(report.n_iterations) / report.n_steps;
      }
    std::printf("| %s | %.3g | %.2f | %.3g | %g |\n", rotor.name, time, iterations, least, rotor.goal);
  }
} // namespace

int
main(int argc, char **argv)
{
  const unsigned int n_runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
  std::printf(
    "60 steps a turn, three stages; processor over real time, the least of %u runs\n\n"
    "| rotor | time followed [s] | iterations a step | processor over real time | goal |\n|---|---|---|---|---|\n",
    n_runs);
  for (const Case &rotor : cases)
    print(rotor, n_runs);
}
