// What a step and the model cost, by the number of unknowns and the library that factorises: a beam thrown freely, and
// a garland of rigid bodies that falls. Prints comma separated values; asserts nothing. Drawn by
// contrib/figures sizes.
//
//   bench_sizes                        all, the largest of 100 000 unknowns
//   bench_sizes beam 500 MUMPS         one: a beam of 500 elements, or a garland of 500 bodies

#include <samara/analysis/dynamic.h>
#include <samara/base/threads.h>
#include <samara/solvers/linear.h>

#include "../scene.h"
#include <sys/wait.h>

#include <cstdio>
#include <cstring>
#include <iostream>

#include "cpu_seconds.h"

using namespace samara;

namespace
{
  /** VmRSS: memory the process has; VmHWM: the most it has had [MB]. */
  double
  memory(const std::string &what)
  {
    std::ifstream status("/proc/self/status");
    std::string   word;
    while (status >> word)
      if (word == what + ":")
        {
          double kilobytes = 0;
          status >> kilobytes;
          return kilobytes / 1024;
        }
    return 0;
  }

  /** A rod of aluminium, 10 m long, of cubic elements. */
  std::string
  beam(const unsigned int n_elements)
  {
    return "set Analyses = dynamic\n"
           "subsection Sections\nsubsection s\nset Type = rectangle\nset E = 70e9\nset Density = 2700\n"
           "set Width 2 = 0.02\nset Width 3 = 0.03\nend\nend\n"
           "subsection Bodies\nsubsection rod\nset Type = beam\nset Points = 0, 0, 0; 10, 0, 0\nset Degree = 3\n"
           "set Section = s\nset Velocity = 0, -10, 1\nset Angular velocity = 0.3, 0, 2\nset Elements = " +
           std::to_string(n_elements) +
           "\nend\nend\n"
           "subsection Loads\nsubsection push\nset Type = point load\nset At = rod.start\nset Force = 0, 5, 10\nend\nend\n";
  }

  /**
   * Bodies of 1 kg in a zigzag, with ball joints between them, hung up at every tenth joint, that start to fall. (A
   * single long chain would measure round-off: the condition of its equations grows with the square of its length.)
   */
  std::string
  garland(const unsigned int n_bodies)
  {
    const auto ball = [](const std::string &a, const unsigned int b) {
      std::ostringstream text;
      text << "set Type = spherical\nset Body A = " << a << "\nset Body B = b" << b << "\nset Position = " << b
           << ", 0, " << 0.5 * (b % 2) << "\nend\n";
      return text.str();
    };
    std::ostringstream bodies, joints;
    for (unsigned int i = 0; i < n_bodies; ++i)
      {
        bodies << "subsection b" << i << "\nset Type = rigid body\nset Mass = 1\nset Inertia = 0.1, 0.1, 0.1\n"
               << "set Position = " << i << ".5, 0, 0.25\nend\n";
        if (i > 0)
          joints << "subsection j" << i << '\n' << ball("b" + std::to_string(i - 1), i);
        if (i % 10 == 0)
          joints << "subsection hook" << i << '\n' << ball("ground", i);
      }
    return "set Analyses = dynamic\nsubsection Bodies\n" + bodies.str() + "end\nsubsection Joints\n" + joints.str() +
           "end\nsubsection Loads\nsubsection weight\nset Type = gravity\nend\nend\n";
  }

  void
  measure(const std::string &model, const unsigned int n, const std::string &library)
  {
    // MPI, which MUMPS starts, is not part of the model
    auto single          = std::make_shared<Pattern>();
    single->column_start = {0, 1};
    single->rows         = {0};
    make_solver(single, library_by_name(library));
    const double before = memory("VmRSS"), start = cpu_seconds();
    Scene        scene((model == "beam" ? beam(n) : garland(n)) +
                  "subsection Dynamic\nset End time = 0.2\nset Step = 0.01\nset Stages = 2\nend\n",
                {"Linear solver = " + library, "Output/Pictures = false"});
    const double set_up  = cpu_seconds() - start;
    auto        &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.run(scene.context);
    const auto &report = dynamic.report;
    std::printf("%s,%u,%s,%u,%u,%.2f,%u,%.3g,%.4g,%.3g\n",
                model.c_str(),
                n,
                library.c_str(),
                scene.system.size(),
                report.n_steps,
                static_cast<double>(report.n_iterations) / report.n_steps,
                report.n_factorizations,
                set_up,
                1e3 * (cpu_seconds() - start - set_up) / report.n_steps,
                memory("VmHWM") - before);
    std::fflush(stdout);
  }
} // namespace



int
main(const int n_arguments, char **arguments)
{
  set_threads(1);
  std::printf("model,elements or bodies,library,unknowns,steps,iterations per step,factorisations,set up [s],"
              "step [ms],memory [MB]\n");
  std::fflush(stdout);
  if (n_arguments == 4)
    return measure(arguments[1], std::stoul(arguments[2]), arguments[3]), 0;
  // processes of their own: memory that one has had is not that of the next
  const std::vector<std::pair<std::string, std::vector<unsigned int>>> models = {
    {"beam", {5, 17, 50, 167, 500, 1667, 5000}}, {"garland", {10, 32, 100, 320, 1000, 3200, 10000}}};
  for (const auto &[model, sizes] : models)
    for (const std::string library : {"KLU", "MUMPS"})
      for (const unsigned int n : sizes)
        {
          if (fork() == 0)
            {
              try
                {
                  measure(model, n, library);
                }
              catch (const std::exception &error)
                {
                  std::cerr << error.what() << '\n';
                  std::exit(1);
                }
              std::exit(0);
            }
          wait(nullptr);
        }
}
