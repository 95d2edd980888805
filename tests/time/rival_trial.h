#ifndef samara_tests_time_rival_trial_h
#define samara_tests_time_rival_trial_h


#include "../rivals.h"

#include <cmath>

#include "systems.h"

namespace samara
{
  inline MovingSystem
  system_named(const std::string &name)
  {
    for (const MovingSystem &what : moving_systems())
      if (what.name == name)
        return what;
    throw std::invalid_argument(name);
  }

  /** A mass on a spring, without any turning; 5 rad/s. */
  inline MovingSystem
  oscillator()
  {
    using namespace systems;
    return {"oscillator",
            model(rigid_body("mass",
                             "set Mass = 2\n set Inertia = 0.1, 0.1, 0.1\n set Position = 0, 0, 0\n" +
                               moving("1, 0, 0", "0, 0, 0")),
                  joint("guide",
                        "prismatic",
                        "set Body A = ground\n set Body B = mass.centre\n set Axis = 1, 0, 0\n" +
                          motion("displacement", spring("50", "0", "0.1")))),
            0.1,
            0.7};
  }

  inline IntegratorSettings
  settings(const double rho, const double tolerance = 1e-4)
  {
    IntegratorSettings s;
    s.spectral_radius  = rho;
    s.newton_tolerance = 1e-12;
    s.tolerance        = tolerance;
    return s;
  }

  /** Errors at the end; of velocities, multipliers and accelerations against what is reported of the reference. */
  struct Errors
  {
    double q, y, multipliers, accelerations;
  };

  /** A system with the answer at the end. */
  struct Trial
  {
    MovingSystem what;
    Scene        scene;
    State        start, answer;

    explicit Trial(const MovingSystem &system)
      : what(system)
      , scene(what.text)
      , start(start_of(what, scene.system))
      , answer(run(scene.system, start, Tableau(3, 1.), what.T / 128, 128).state)
    {
      Projection(scene.system).report(answer);
    }

    Errors
    errors(const std::string &rival, const IntegratorSettings &s, const unsigned int n) const
    {
      const auto   integrator = make_rival(rival, scene.system, s);
      const Record r          = run(scene.system, start, *integrator, what.T / n, n);
      EXPECT_EQ(r.n_steps, n) << rival << ", " << what.name;
      EXPECT_LT(r.skewness, 1e-13);
      EXPECT_LT(r.balance, 1e-12) << "the account closes";
      return {distance(r.state.q, answer.q),
              distance(r.state.y, answer.y),
              distance(r.state.multipliers, answer.multipliers),
              r.state.accelerations.empty() ? 0. : distance(r.state.accelerations, answer.accelerations)};
    }
  };

  inline double
  order(const double one, const double two)
  {
    return std::log2(one / two);
  }
} // namespace samara

#endif
