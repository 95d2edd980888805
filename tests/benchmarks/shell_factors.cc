// Factors of the stiffness of a shell, a curved plate of n × n elements of degree 3 held along two sides: the first
// factorisation, with the order of elimination, another one with the same pattern, a solution. CPU time of one thread.
//
//     bench_shell_factors [N] [automatic|KLU|MUMPS]

#include <samara/solvers/equilibrate.h>
#include <samara/solvers/linear.h>

#include "../scene.h"
#include <sys/resource.h>

#include <iostream>

#include "cpu_seconds.h"

using namespace samara;

int
main(const int argc, const char *const *argv)
{
  const std::string n = argc > 1 ? argv[1] : "30", library = argc > 2 ? argv[2] : "automatic";
  const Scene       scene("prm/benchmarks/shells/curved_plate.prm", {"Bodies/plate/Elements = " + n + ", " + n});
  SparseMatrix      K(scene.system.layout.pattern);
  scene.system.tangent(scene.system.reference(), K);
  equilibrate(K);
  const auto timed = [](const auto &work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
  };
  std::unique_ptr<LinearSolver> solver;
  std::vector<double>           b(scene.system.size(), 1.);
  const auto                    factorize = [&]() { solver->factorize(K); };
  const double                  first     = timed([&]() {
    solver = make_solver(scene.system.layout.pattern, library_by_name(library));
    factorize();
  });
  const double                  again     = std::min(timed(factorize), timed(factorize)),
               solution                   = timed([&]() { solver->solve(b.data()); });
  std::vector<double> r(b.size(), -1.);
  for (int j = 0; j < K.pattern->size(); ++j)
    for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1]; ++k)
      r[K.pattern->rows[k]] += K.values[k] * b[j];
  double residual = 0, largest = 0;
  for (std::size_t i = 0; i < r.size(); ++i)
    {
      residual = std::max(residual, std::abs(r[i]));
      largest  = std::max(largest, std::abs(b[i]));
    }
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  std::cout << library << ", " << b.size() << " unknowns: first " << first << " s, again " << again << " s, solution "
            << solution << " s, residual " << residual / (1 + largest) << ", memory of the process "
            << usage.ru_maxrss / 1024 << " MB\n";
  return 0;
}
