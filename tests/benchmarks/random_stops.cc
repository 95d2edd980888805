// Random mechanisms, with stops or without, with the default settings: energies, losses, constraints, steps. Reports.
//
//   bench_random_stops [N [first seed [steps [free] [beams]]]]     N mechanisms; "free": without stops, "beams": with
// flexible bodies, too; "free beams": both
//
// The test Stops.RandomMechanisms has the first of them.

#include "../time/random_mechanisms.h"

#include <cstring>

using namespace samara;

int
main(const int n_arguments, const char *const *const arguments)
{
  const auto argument = [&](const int i, const unsigned int otherwise) {
    return n_arguments > i ? std::strtoul(arguments[i], nullptr, 10) : otherwise;
  };
  const unsigned int n = argument(1, 200), first = argument(2, 0), n_steps = argument(3, 50);
  const auto         has = [&](const char *const word) {
    return std::any_of(arguments, arguments + n_arguments, [&](const char *a) { return std::strcmp(a, word) == 0; });
  };
  unsigned int  n_finished = 0, n_good = 0, n_failed = 0, n_touches = 0, n_of_steps = 0, n_good_runs = 0;
  unsigned long n_iterations = 0, n_factorizations = 0;
  double        worst = 0, worst_gap = 0;
  for (unsigned int seed = first; seed < first + n; ++seed)
    {
      const RandomMechanism mechanism(seed, !has("free"), has("beams"));
      Course                c;
      try
        {
          c = course_of(mechanism, n_steps);
        }
      catch (const std::exception &problem)
        {
          c.problem = problem.what();
        }
      n_finished += c.is_finished;
      n_good += c.balance < 1e-9;
      n_good_runs += c.worst_step < 1e-10;
      n_failed += c.n_failed;
      n_touches += c.n_touches;
      n_of_steps += c.n_steps;
      n_iterations += c.n_iterations;
      n_factorizations += c.n_factorizations;
      worst     = std::max(worst, c.balance);
      worst_gap = std::max(worst_gap, c.gap);
      if (!c.is_finished || c.balance > 1e-9 || c.gap > 1e-8 || c.worst_step > 1e-10 || c.n_steps > 4 * n_steps ||
          c.least_loss < -1e-12)
        std::printf("%s: %s balance %.1e, worst step %.1e, drive %.1e, gap %.1e, %u steps, %u failed, %u touches, "
                    "least loss %.1e %s\n",
                    mechanism.name().c_str(),
                    c.is_finished ? "" : "NOT FINISHED,",
                    c.balance,
                    c.worst_step,
                    c.worst_drive,
                    c.gap,
                    c.n_steps,
                    c.n_failed,
                    c.n_touches,
                    c.least_loss,
                    c.problem.c_str());
      std::fflush(stdout);
    }
  std::printf("%u of %u finished, balance below 1e-9 in %u (worst %.1e), all steps below 1e-10 in %u, gap %.1e; "
              "%u steps, %u without solution, %u touches, %.2f iterations and %.2f factorizations a step\n",
              n_finished,
              n,
              n_good,
              worst,
              n_good_runs,
              worst_gap,
              n_of_steps,
              n_failed,
              n_touches,
              double(n_iterations) / n_of_steps,
              double(n_factorizations) / n_of_steps);
  return n_finished == n ? 0 : 1;
}
