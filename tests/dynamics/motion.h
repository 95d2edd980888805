#ifndef samara_tests_dynamics_motion_h
#define samara_tests_dynamics_motion_h

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

namespace samara
{
  /** What a published reference says at one time: the values of some probes, and how sure it is of them. */
  struct ReferenceRow
  {
    double              t;
    std::vector<double> places;
    double              error; ///< of the reference, by its author
  };



  /** A dynamic analysis of one of prm/benchmarks/dynamics, with some probes at the end of each step. */
  class Motion
  {
  public:
    Motion(const std::string &model, const std::vector<std::string> &overrides, const std::vector<std::string> &probes)
    {
      Scene              scene("prm/benchmarks/dynamics/" + model + ".prm", overrides);
      std::vector<Probe> recorded;
      for (const auto &probe : probes)
        recorded.push_back(scene.input.model.probe(probe));
      auto &dynamics    = scene.analysis<DynamicAnalysis>();
      dynamics.observer = [&](const State &state) {
        times.push_back(state.time);
        values.emplace_back();
        for (const auto &probe : recorded)
          values.back().push_back(probe.value(state));
      };
      dynamics.start(scene.context);
      dynamics.run(scene.context);
      report = dynamics.report;
      budget = dynamics.budget;
      log    = scene.stream.str();
    }

    /** The probes at the end of the step that ends at @p time. */
    const std::vector<double> &
    at(const double time) const
    {
      for (unsigned int i = 0; i < times.size(); ++i)
        if (std::abs(times[i] - time) < 1e-9 * std::max(1e-3, time))
          return values[i];
      throw std::out_of_range("no step ends at " + std::to_string(time) + " s");
    }

    /** Largest difference of the probes to @p reference at a time. */
    double
    error(const double time, const std::vector<double> &reference) const
    {
      const auto &computed = at(time);
      double      error    = 0;
      for (unsigned int i = 0; i < reference.size(); ++i)
        error = std::max(error, std::abs(computed[i] - reference[i]));
      return error;
    }

    std::vector<double>              times;
    std::vector<std::vector<double>> values;
    DynamicAnalysis::Report          report;
    DynamicAnalysis::Budget          budget;
    std::string                      log;
  };



  inline std::string
  text_of(const double number)
  {
    std::ostringstream text;
    text.precision(17);
    text << number;
    return text.str();
  }

  /** The overrides that choose a member of the integrator family and a step. */
  inline std::vector<std::string>
  integrator(const unsigned int stages,
             const double       spectral_radius,
             const double       step,
             const std::string &tolerance = "1e-13")
  {
    return {"Dynamic/Stages = " + std::to_string(stages),
            "Dynamic/Spectral radius = " + text_of(spectral_radius),
            "Dynamic/Step = " + text_of(step),
            "Dynamic/Newton tolerance = " + tolerance};
  }

  /** A member of the family and a step at which its errors are in proportion to a power of the step. */
  struct Member
  {
    unsigned int stages;
    double       spectral_radius, step;

    /** 2s without dissipation, 2s − 1 with it. */
    double
    order() const
    {
      return 2. * stages - (spectral_radius < 1 ? 1 : 0);
    }

    /** That error(overrides) falls by two to the order if the step is halved, give or take @p leeway in the order. */
    template <typename Error>
    void
    expect_order(const Error &error, const double leeway = 0.3) const
    {
      const double one = error(integrator(stages, spectral_radius, step)),
                   two = error(integrator(stages, spectral_radius, step / 2));
      EXPECT_NEAR(std::log2(one / two), order(), leeway)
        << stages << " stages, spectral radius " << spectral_radius << ", errors " << one << ", " << two;
    }
  };
} // namespace samara

#endif
