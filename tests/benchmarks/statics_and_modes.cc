// Times of what statics and modes are made of: median of five, CPU time of one thread. Reports, asserts nothing.

#include <samara/base/threads.h>
#include <samara/solvers/newton.h>

#include "../scene.h"
#include <sys/resource.h>

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "cpu_seconds.h"

using namespace samara;

namespace
{
  /** Median of five of the time of one call, each measured over @p repetitions. */
  template <typename Work>
  double
  median_time(const unsigned int repetitions, const Work &work)
  {
    std::vector<double> times;
    for (unsigned int k = 0; k < 5; ++k)
      {
        const double start = cpu_seconds();
        for (unsigned int i = 0; i < repetitions; ++i)
          work();
        times.push_back((cpu_seconds() - start) / repetitions);
      }
    std::sort(times.begin(), times.end());
    return times[2];
  }

  void
  report(const std::string &what, const double value, const std::string &unit, const std::string &goal = "")
  {
    std::cout << std::left << std::setw(62) << what << std::right << std::setw(10) << std::setprecision(4) << value
              << ' ' << unit << (goal.empty() ? "" : "   (goal " + goal + ")") << '\n';
  }

  void
  time_assembly_and_solution()
  {
    Scene               scene("prm/benchmarks/roll_up.prm", {"Bodies/beam/Elements = 200"});
    const System       &system   = scene.system;
    const unsigned int  n_points = 200 * 3;
    State               state    = scene.equilibrium();
    SparseMatrix        K(system.layout.pattern);
    std::vector<double> stress, r;
    const auto          residual = [&]() {
      system.stresses(state, stress);
      system.residual(state, stress, r);
    };
    const double t_r = median_time(50, residual), t_K = median_time(50, [&]() { system.tangent(state, K); });
    std::cout << "beam of 200 cubic elements, " << system.size() << " unknowns\n";
    report("  strain, stress and residual per quadrature point", 1e6 * t_r / n_points, "us");
    report("  tangent with assembly per quadrature point", 1e6 * t_K / n_points, "us");
    report("  together", 1e6 * (t_r + t_K) / n_points, "us", "<= 1 us");
    const auto solver = make_solver(system.layout.pattern);
    solver->factorize(K);
    report("  refactorisation (KLU)", 1e3 * median_time(20, [&]() { solver->factorize(K); }), "ms");
    std::vector<double> b(r);
    report("  solution", 1e3 * median_time(20, [&]() { solver->solve(b.data()); }), "ms");
  }

  void
  time_roll_up()
  {
    std::cout << "static roll-up to a full circle\n";
    for (const std::string elements : {"4", "8", "16"})
      {
        Scene        scene("prm/benchmarks/roll_up.prm", {"Bodies/beam/Elements = " + elements});
        const State  start = scene.context.state;
        const double t     = median_time(5, [&]() {
          scene.context.state          = start;
          scene.context.is_equilibrium = false;
          scene.equilibrium();
        });
        const auto  &a     = scene.analysis<StaticAnalysis>();
        const double error = std::hypot(scene.value("beam.end.position x"), scene.value("beam.end.position z"));
        report("  " + elements + " cubic elements: " + std::to_string(a.n_steps) + " step, " +
                 std::to_string(a.n_iterations) + " iterations",
               1e3 * t,
               "ms");
        report("    error of the tip / L", error, "");
      }
  }

  void
  time_swept_tip()
  {
    std::cout << "swept-tip beam at 750 rpm (a peer: 4.7 ms for the steady state, 18.5 ms for 20 eigenvalues)\n";
    Scene        scene("prm/benchmarks/swept_tip_beam.prm");
    const State  start = scene.context.state;
    const double t_s   = median_time(20, [&]() {
      scene.context.state          = start;
      scene.context.is_equilibrium = false;
      scene.equilibrium();
    });
    const double t_m   = median_time(5, [&]() { scene.modes(); });
    report("  steady state, " + std::to_string(scene.system.size()) + " unknowns, " +
             std::to_string(scene.analysis<StaticAnalysis>().n_iterations) + " iterations",
           1e3 * t_s,
           "ms",
           "<= 2 ms");
    report("  20 modes (40 eigenvalues)", 1e3 * t_m, "ms", "<= 8 ms");
    const auto modes = scene.modes();
    Scene      fine("prm/benchmarks/swept_tip_beam.prm", {"Bodies/beam/Elements = 40", "Bodies/beam/Degree = 4"});
    fine.equilibrium();
    const auto exact = fine.modes();
    double     error = 0;
    for (unsigned int i = 0; i < 10; ++i)
      error = std::max(error, std::abs(modes[i].frequency() / exact[i].frequency() - 1));
    report("  largest error of the first 10 frequencies against 40 quartic elements", error, "");
  }
} // namespace



int
main()
{
  set_threads(1);
  time_assembly_and_solution();
  time_roll_up();
  time_swept_tip();
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  report("peak memory", usage.ru_maxrss / 1024., "MB", "<= 150 MB");
}
