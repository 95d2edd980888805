// Times of motions: median of five, CPU time of one thread, without output. Reports, asserts nothing.
//
//   bench_dynamics [swept | transmission | sizes]     all of them if none is named

#include <samara/analysis/dynamic.h>
#include <samara/base/threads.h>

#include "../scene.h"
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "cpu_seconds.h"

using namespace samara;

namespace
{
  /** Run a scene's dynamic analysis from its equilibrium, if it asks for one; the median time of @p n_runs. */
  void
  time_motion(const std::string              &what,
              const std::string              &file,
              const std::vector<std::string> &overrides,
              const unsigned int              n_runs = 5)
  {
    std::vector<double>     times;
    DynamicAnalysis::Report report;
    unsigned int            n_unknowns = 0;
    for (unsigned int k = 0; k < n_runs; ++k)
      {
        Scene scene(file, overrides);
        scene.context.pictures = false;
        if (std::any_of(scene.input.analyses.begin(), scene.input.analyses.end(), [](const auto &a) {
              return dynamic_cast<StaticAnalysis *>(a.get()) != nullptr;
            }))
          scene.equilibrium();
        auto        &dynamic = scene.analysis<DynamicAnalysis>();
        const double start   = cpu_seconds();
        dynamic.run(scene.context);
        times.push_back(cpu_seconds() - start);
        report     = dynamic.report;
        n_unknowns = scene.system.size();
      }
    std::sort(times.begin(), times.end());
    const double time = times[times.size() / 2], n = report.n_steps;
    std::printf("%-46s %7u %7u %6.2f %8u %8.3f %9.1f\n",
                what.c_str(),
                n_unknowns,
                report.n_steps,
                report.n_iterations / n,
                report.n_factorizations,
                time,
                1e6 * time / n);
    std::fflush(stdout);
  }

  const std::string flying_beam = R"(
set Analyses = dynamic
subsection Sections
  subsection s
    set Type = rectangle
    set E = 70e9
    set Density = 2700
    set Width 2 = 0.02
    set Width 3 = 0.03
  end
end
subsection Bodies
  subsection rod
    set Type = beam
    set Points = 0, 0, 0; 10, 0, 0
    set Elements = 10
    set Degree = 3
    set Section = s
    set Velocity = 0, -10, 1
    set Angular velocity = 0.3, 0, 2
  end
end
subsection Loads
  subsection push
    set Type = point load
    set At = rod.start
    set Force = 0, 5, 10
  end
end
subsection Dynamic
  set End time = 0.2
  set Step = 0.01
  set Stages = 2
end
)";
} // namespace



int
main(const int n_arguments, char **arguments)
{
  set_threads(1);
  const auto is_wanted = [&](const char *name) {
    bool any = false;
    for (int i = 1; i < n_arguments; ++i)
      {
        if (std::strcmp(arguments[i], name) == 0)
          return true;
        any = any || std::strcmp(arguments[i], "swept") == 0 || std::strcmp(arguments[i], "transmission") == 0 ||
              std::strcmp(arguments[i], "sizes") == 0;
      }
    return !any;
  };
  std::printf("%-46s %7s %7s %6s %8s %8s %9s\n", "", "unknown", "steps", "iter.", "factor.", "s", "us/step");
  if (is_wanted("swept"))
    for (const std::string s : {"1", "2", "3"})
      time_motion("swept-tip beam, 24 segments, s = " + s + (s == "1" ? ", goal 0.40 s" : ""),
                  "prm/benchmarks/swept_tip_dynamics.prm",
                  {"Dynamic/Stages = " + s, "Dynamic/Spectral radius = 1"});
  if (is_wanted("transmission"))
    time_motion("tail rotor transmission, goal 3 s",
                "prm/rotorcraft/tail_rotor_transmission.prm",
                {"Analyses = static, dynamic"});
  if (is_wanted("sizes"))
    for (const std::string elements : {"50", "500", "5000"})
      time_motion("flying beam of " + elements + " cubic elements",
                  flying_beam,
                  {"Bodies/rod/Elements = " + elements},
                  elements == "5000" ? 1 : 3);
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory %ld MB\n", usage.ru_maxrss / 1024);
}
