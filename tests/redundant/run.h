#ifndef samara_tests_redundant_run_h
#define samara_tests_redundant_run_h

// Motions of models with redundant constraints and singular positions, and how well they obey all constraints.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <map>

namespace samara
{
  /** What a motion did, seen at its outputs. */
  struct Outcome
  {
    std::map<long, Vector3> places; ///< of the probed point, by time in ms
    double                  gap = 0, balance = 0;
    unsigned int            n_steps = 0, n_failed = 0, n_iterations = 0, n_factorizations = 0;
    unsigned int            n_redundant = 0;
    std::string             log;

    /** Largest distance to another motion at the times both have. */
    double
    error(const Outcome &reference) const
    {
      double       largest  = 0;
      unsigned int n_common = 0;
      for (const auto &[time, place] : places)
        if (const auto at = reference.places.find(time); at != reference.places.end())
          {
            largest = std::max(largest, (place - at->second).norm());
            ++n_common;
          }
      return n_common > 10 ? largest : 1e300;
    }
  };



  /** The largest violation of any constraint, left out or not; angles in rad. */
  inline double
  gap_of(const System &system, const State &state)
  {
    std::vector<double> r(system.size() + 6, 0.);
    system.add_gaps(state.point(), r.data());
    double gap = 0;
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      gap = std::max(gap, std::abs(r[system.layout.of_multiplier(i)]));
    return gap;
  }



  /** Outcome the dynamic analysis of a model and watch a point, "bar 3.end". */
  inline Outcome
  run_motion(const std::string &model, const std::string &point, const std::vector<std::string> &overrides)
  {
    Scene              scene(model, overrides);
    std::vector<Probe> probes;
    for (const std::string axis : {"x", "y", "z"})
      probes.push_back(scene.input.model.probe(point + ".position " + axis));
    auto   &dynamic = scene.analysis<DynamicAnalysis>();
    Outcome run;
    dynamic.observer = [&](const State &state) {
      run.gap         = std::max(run.gap, gap_of(scene.system, state));
      const long time = std::lround(1e3 * state.time);
      if (std::abs(1e3 * state.time - time) < 1e-6)
        run.places[time] = {probes[0].value(state), probes[1].value(state), probes[2].value(state)};
    };
    run.n_redundant = scene.context.state.left_out.size();
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    run.balance          = dynamic.report.largest_balance;
    run.n_steps          = dynamic.report.n_steps;
    run.n_failed         = dynamic.report.n_failed;
    run.n_iterations     = dynamic.report.n_iterations;
    run.n_factorizations = dynamic.report.n_factorizations;
    run.log              = scene.stream.str();
    return run;
  }
} // namespace samara

#endif
