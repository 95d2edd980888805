// Motions with redundant constraints and through singular positions: errors, gaps, counts and CPU times of one thread.
//
//   bench_redundant     Bricard's mechanism with six revolutes against the one with a cylindrical joint; parallelograms

#include <samara/base/threads.h>

#include "../redundant/run.h"

#include <cstdio>

#include "cpu_seconds.h"

using namespace samara;

namespace
{
  std::vector<std::string>
  settings(const std::string &s, const std::string &radius, const std::string &step)
  {
    return {"Dynamic/Stages = " + s, "Dynamic/Spectral radius = " + radius, "Dynamic/Step = " + step};
  }

  /** Outcome and print; the run and the least of three times. */
  Outcome
  timed(const std::string              &what,
        const std::string              &model,
        const std::string              &point,
        const std::vector<std::string> &overrides,
        const Outcome                  *reference)
  {
    Outcome run;
    double  least = 1e300;
    for (unsigned int k = 0; k < 3; ++k)
      {
        const double start = cpu_seconds();
        run                = run_motion(model, point, overrides);
        least              = std::min(least, cpu_seconds() - start);
      }
    std::printf(
      "%-44s d %3u error %8.1e gap %8.1e balance %8.1e steps %6u failed %3u iter. %5.2f factor. %6u %8.3f s\n",
      what.c_str(),
      run.n_redundant,
      reference != nullptr ? run.error(*reference) : 0.,
      run.gap,
      run.balance,
      run.n_steps,
      run.n_failed,
      double(run.n_iterations) / run.n_steps,
      run.n_factorizations,
      least);
    const auto at = run.log.find("  ", run.log.find("dynamic:"));
    if (at != std::string::npos)
      std::printf("%s", run.log.substr(at).c_str());
    std::fflush(stdout);
    return run;
  }

  std::vector<std::string>
  operator+(std::vector<std::string> a, const std::vector<std::string> &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }
} // namespace



int
main()
{
  set_threads(1);
  const std::string bricard = "prm/benchmarks/peers/bricard.prm", P3 = "bar 2.end";
  const Outcome     reference =
    timed("Bricard, cylindrical, s = 3, 0.0025", bricard, P3, settings("3", "1", "0.0025"), nullptr);
  for (const std::string s : {"1", "2", "3"})
    for (const std::string radius : {"0", "0.5", "1"})
      {
        for (const std::string step : {"0.05", "0.02", "0.01", "0.005", "0.0025", "0.001"})
          timed("Bricard, revolutes, s = " + s + ", rho = " + radius + ", " + step,
                bricard,
                P3,
                settings(s, radius, step) + std::vector<std::string>{"Joints/P5/Type = revolute"},
                &reference);
        timed("Bricard, revolutes, s = " + s + ", rho = " + radius + ", adaptive",
              bricard,
              P3,
              settings(s, radius, "0.01") +
                std::vector<std::string>{"Joints/P5/Type = revolute", "Dynamic/Step control = adaptive"},
              nullptr);
      }
  for (const std::string joint : {"cylindrical", "revolute"})
    timed("Bricard, " + joint + ", s = 3, 0.01",
          bricard,
          P3,
          settings("3", "0.5", "0.01") + std::vector<std::string>{"Joints/P5/Type = " + joint},
          &reference);
  for (const std::string joint : {"spherical", "revolute"})
    for (const std::string s : {"1", "2", "3"})
      for (const std::string radius : {"0", "0.5", "1"})
        timed("two parallelograms, " + joint + ", s = " + s + ", rho = " + radius,
              "prm/benchmarks/dynamics/four_bar.prm",
              "coupler 1",
              settings(s, radius, "0.01") +
                std::vector<std::string>{"Joints/B1/Type = " + joint, "Joints/B2/Type = " + joint},
              nullptr);
  for (const std::string s : {"2", "3"})
    for (const std::string radius : {"0.5", "1"})
      timed("forty parallelograms, s = " + s + ", rho = " + radius,
            "prm/benchmarks/peers/n_four_bar.prm",
            "crank 0.B",
            settings(s, radius, "0.01"),
            nullptr);
}
