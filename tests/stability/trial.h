#ifndef samara_tests_stability_trial_h
#define samara_tests_stability_trial_h


#include "../dynamics/motion.h"
#include "../rivals.h"
#include "../time/systems.h"

namespace samara
{
  /** A Motion of one of prm/benchmarks/stability (or of another folder beside it), by any integrator, that may come to
   * nothing. */
  struct Trial
  {
    std::unique_ptr<Motion> motion; ///< none if there was no end
    std::string             failure;

    Trial(const std::string              &model,
          const std::vector<std::string> &overrides,
          const std::vector<std::string> &probes = {})
    {
      try
        {
          motion = std::make_unique<Motion>("../" + model, overrides, probes);
        }
      catch (const std::exception &problem)
        {
          failure = problem.what();
        }
    }

    double
    energy() const
    {
      return motion->budget.kinetic + motion->budget.strain + motion->budget.potential;
    }

    /** What is left of the energy of the start. */
    double
    left() const
    {
      return energy() / motion->budget.start;
    }
  };



  /** Overrides, with more behind them. */
  inline std::vector<std::string>
  operator+(std::vector<std::string> overrides, const std::vector<std::string> &more)
  {
    overrides.insert(overrides.end(), more.begin(), more.end());
    return overrides;
  }



  inline std::vector<std::string>
  family(const unsigned int stages, const double spectral_radius)
  {
    return {"Dynamic/Stages = " + std::to_string(stages), "Dynamic/Spectral radius = " + text_of(spectral_radius)};
  }



  inline std::vector<std::string>
  rival(const std::string &name, const double spectral_radius = 1)
  {
    return {"Dynamic/Integrator = " + name, "Dynamic/Spectral radius = " + text_of(spectral_radius)};
  }
} // namespace samara

#endif
