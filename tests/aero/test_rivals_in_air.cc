// Classical schemes beside the family with loads of the air: surfaces without states are loads as others are.
//
// References: the family with three stages at finer steps; orders of theory (doc/theory/rivals.md).

#include "../time/rival_trial.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** A blade on a flap hinge with a spring, on a hub driven at 30 rad/s, in a wind across; lift at once or with
   * @p unsteady. */
  MovingSystem
  blade_in_wind(const std::string &unsteady = "quasi-steady")
  {
    return {"blade in a wind",
            blade_on_driven_hub("flap", "0, -1, 0", "set Spring = 50") + airfoils() +
              subsection("Aerodynamics",
                         air("12, 0, -1") +
                           subsection("flow",
                                      "    set Type = prescribed inflow\n    set Hub = ground\n    set Axis = 0, 0, 1\n"
                                      "    set Radius = 3\n    set Velocity = 4, 0, 1\n")) +
              subsection("Surfaces",
                         subsection("lift",
                                    "    set Body = blade\n    set Line = 0.5, 0, 0; 3, 0, 0\n"
                                    "    set Leading edge = 0, 1, 0\n    set Chord = 0.2\n"
                                    "    set Twist = 8 deg - 1 deg*s\n    set Airfoils = plain\n    set Inflow = flow\n"
                                    "    set Unsteady = " +
                                      unsteady + "\n")),
            0.01,
            0.2};
  }
} // namespace



TEST(RivalsInAir, HaveTheirOrders)
{
  const Trial trial(blade_in_wind());
  for (const std::string &name : rival_names())
    {
      SCOPED_TRACE(name);
      if (name[0] == 'B')
        {
          // steps of its own, to a tolerance
          const Errors errors = trial.errors(name, settings(0.5, 1e-7), 8);
          EXPECT_LT(errors.q, 1e-4);
          EXPECT_LT(errors.y, 1e-2);
          continue;
        }
      // with constraints, as those of hinges, the energy decaying scheme is of first order (test_energy_decaying.cc)
      const bool   decays   = name == "energy decaying";
      const double expected = decays ? 1 : 2;
      const Errors one      = trial.errors(name, settings(decays ? 0 : 0.5), 64),
                   two      = trial.errors(name, settings(decays ? 0 : 0.5), 128);
      EXPECT_GT(order(one.q, two.q), expected - 0.2) << one.q << ", " << two.q;
      EXPECT_NEAR(order(one.y, two.y), expected, 0.2) << one.y << ", " << two.y;
      EXPECT_LT(two.q, 2e-2);
    }
}



// Their accounts tell the work of the air by quadrature of its power: here all that loads do.
TEST(RivalsInAir, TellTheWorkOfAir)
{
  const Trial  trial(blade_in_wind());
  const double T    = 0.05;
  const auto   work = [&](Integrator &integrator, const unsigned int n) {
    State     state = trial.start;
    WorkOfAir sum;
    for (unsigned int i = 0; i < n; ++i)
      {
        const StepResult result = integrator.step(state, T / n);
        EXPECT_TRUE(result.converged);
        EXPECT_NEAR(result.air.on_model, result.work_of_loads, 1e-9 * std::abs(result.work_of_loads));
        sum.add(1, result.air);
      }
    return sum;
  };
  StageIntegrator family(trial.scene.system, Tableau(3, 1.), 1e-12);
  const WorkOfAir exact = work(family, 50);
  for (const std::string &name : rival_names())
    {
      SCOPED_TRACE(name);
      const auto      rival = make_rival(name, trial.scene.system, settings(0.5, 1e-7));
      const WorkOfAir sum   = work(*rival, 100);
      EXPECT_NEAR(sum.on_model, exact.on_model, 1e-2 * std::abs(exact.on_model));
      EXPECT_NEAR(sum.induced, exact.induced, 1e-2 * std::abs(exact.induced));
      EXPECT_NEAR(sum.profile, exact.profile, 1e-2 * std::abs(exact.profile));
    }
}



TEST(RivalsInAir, SayThatTheyKnowNoLags)
{
  const Scene scene(blade_in_wind("two lags").text);
  for (const std::string &name : rival_names())
    try
      {
        make_rival(name, scene.system, settings(0.5));
        ADD_FAILURE() << name;
      }
    catch (const std::invalid_argument &problem)
      {
        EXPECT_NE(std::string(problem.what()).find("knows no states of first order"), std::string::npos);
      }
}
