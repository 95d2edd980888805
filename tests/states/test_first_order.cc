// States of first order: orders of the family, stiff lags, statics, and what they may not do.

#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>

#include "../rivals.h"
#include <gtest/gtest.h>

#include "scenes.h"
#include "started.h"

using namespace samara;

namespace
{
  /** Places, projected velocities and states after @p T. */
  struct End
  {
    std::vector<double> q, y, z;
  };

  End
  end_of(const System &system, const Tableau &tableau, const double T, const unsigned int n)
  {
    Record record = run(system, started(system), tableau, T / n, n);
    EXPECT_EQ(record.n_steps, n);
    Projection(system).velocities(record.state);
    return {record.state.q, record.state.y, record.state.states};
  }

  /** A bar of 2 kg on a hinge about y at its end, with states and the entries of the hinge's rotation. */
  std::string
  hinged_bar(const std::string &states, const std::string &rotation)
  {
    return "subsection States\n" + states + "end\nsubsection Bodies\n" +
           systems::rigid_body("bar", "set Mass = 2\n set Position = 0.5, 0, 0\n set Inertia = 0.1, 0.2, 0.3\n") +
           "end\nsubsection Joints\n" +
           systems::joint(
             "h",
             "revolute",
             "set Axis = 0, 1, 0\n set Body A = ground\n set Body B = bar.centre\n set Position = 0, 0, 0\n" +
               systems::motion("rotation", rotation)) +
           "end\n";
  }

  void
  expect_orders(const std::string &text,
                const double       T,
                const unsigned int n,
                const unsigned int s,
                const double       rho,
                const double       order)
  {
    SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
    const Scene   scene(text);
    const System &system = scene.system;
    const End     exact = end_of(system, Tableau(3, 1.), T, 16 * n), coarse = end_of(system, Tableau(s, rho), T, n),
              fine      = end_of(system, Tableau(s, rho), T, 2 * n);
    const auto observed = [&](std::vector<double> End::*part) {
      return std::log2(distance(coarse.*part, exact.*part) / distance(fine.*part, exact.*part));
    };
    EXPECT_NEAR(observed(&End::q), order, 0.4);
    EXPECT_NEAR(observed(&End::y), order, 0.4);
    EXPECT_NEAR(observed(&End::z), order, 0.4);
  }
} // namespace



// Nothing but a state moves: there is no energy to measure what is left by. ẋ = a (sin wt − x) in closed form.
TEST(FirstOrderStates, AloneWhereAllBodiesAreHeld)
{
  const double a = 20, w = 5, T = 0.5, square = a * a + w * w;
  const Scene  scene("subsection States\n subsection x\n set Rate = 20*(sin(5*t) - x)\n set Initial = 1\n end\nend\n"
                     "subsection Bodies\n" +
                    systems::rigid_body("b", "set Mass = 2\n set Inertia = 1, 1, 1\n") + "end\nsubsection Joints\n" +
                    systems::joint("held", "rigid", "set Body A = ground\n set Body B = b.centre\n") + "end\n");
  const double exact =
    std::exp(-a * T) * (1 + a * w / square) + (a * a * std::sin(w * T) - a * w * std::cos(w * T)) / square;
  for (const unsigned int s : {1, 2, 3})
    {
      const Record coarse = run(scene.system, started(scene.system), Tableau(s, 1.), T / 10, 10),
                   fine   = run(scene.system, started(scene.system), Tableau(s, 1.), T / 20, 20);
      ASSERT_EQ(fine.n_steps, 20u) << s;
      EXPECT_NEAR(std::log2((coarse.state.states[0] - exact) / (fine.state.states[0] - exact)), 2 * s, 0.3) << s;
    }
}



TEST(FirstOrderStates, OrdersOfAnOscillatorWithALag)
{
  expect_orders(oscillator_with_lag(), 1., 20, 1, 1., 2);
  expect_orders(oscillator_with_lag(), 1., 20, 2, 1., 4);
  expect_orders(oscillator_with_lag(), 1., 20, 2, 0., 3);
  expect_orders(oscillator_with_lag(), 1., 24, 3, 1., 6);
  expect_orders(oscillator_with_lag(), 1., 12, 3, 0., 5);
}



TEST(FirstOrderStates, OrdersOfATopWithControls)
{
  expect_orders(top_with_controls(), 0.6, 20, 2, 1., 4);
  expect_orders(top_with_controls(), 0.6, 20, 2, 0., 3);
  expect_orders(top_with_controls(), 0.6, 12, 3, 1., 6);
  expect_orders(top_with_controls(), 0.6, 12, 3, 0., 5);
}



// With hλ = 3e4 a lag forgets where it began if there is numerical dissipation; without any it never does.
TEST(FirstOrderStates, StiffLagsAreFollowedWithDissipation)
{
  const std::string text =
    "subsection States\n subsection lag\n set Rate = (sin(t) - lag)/(1e-6 s)\n set Initial = 1\n end\n"
    "end\n" +
    systems::pushed("0");
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.5, 0.})
      {
        const Scene  scene(text);
        const Record record = run(scene.system, started(scene.system), Tableau(s, rho), 0.03, 40);
        ASSERT_EQ(record.n_steps, 40u);
        const double miss = std::abs(record.state.states[0] - std::sin(1.2));
        if (rho < 1)
          {
            EXPECT_LT(miss, 0.02) << "s = " << s << ", rho = " << rho;
          }
        else
          {
            EXPECT_GT(miss, 0.2) << "s = " << s;
          }
      }
}



// Loads that depend on states and velocities do work; that and nothing else changes the energy.
TEST(FirstOrderStates, EnergyStatement)
{
  for (const auto &text : {oscillator_with_lag(), top_with_controls()})
    {
      const Scene scene(text);
      for_all_members([&](const Tableau &tableau) {
        const Record record = run(scene.system, started(scene.system), tableau, 0.02, 30);
        EXPECT_EQ(record.n_steps, 30u);
        EXPECT_LT(record.balance, 1e-13);
        EXPECT_GE(record.least_dissipated, -1e-14);
        EXPECT_NE(record.work_of_loads, 0.);
      });
    }
}



// A body on a hinge is held up by a controller with an integral: at rest the integral balances the weight.
TEST(FirstOrderStates, StaticsFindWhereRatesVanish)
{
  const std::string text = hinged_bar(R"(
  subsection integral
    set Rate = 0.3 - h.rotation
    set Unit = s
  end
)",
                                      R"(
      set Moment = 40 N m * (0.3 - h.rotation) - 2 N m s * h.rotation rate + 60 N m/s * integral
)") + "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n";
  Scene             scene(text);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("h.rotation"), 0.3 * 180 / M_PI, 1e-9);
  EXPECT_NEAR(scene.value("integral"), -2 * 9.80665 * 0.5 * std::cos(0.3) / 60, 1e-10);
}



// States count by what they are where that is more than their scale: a filter of 10⁵ N is no iteration gone astray.
TEST(FirstOrderStates, StaticsFindLargeOnes)
{
  const std::string text = hinged_bar(R"(
  subsection filter
    set Rate = (4e8*h.rotation/(1 deg) - filter)/0.05
    set Unit = N
  end
)",
                                      R"(
      set Spring = 1e4
)") + "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n";
  Scene             scene(text);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("filter"), 4e8 * scene.value("h.rotation"), 1e-9 * std::abs(scene.value("filter")));
  EXPECT_GT(std::abs(scene.value("filter")), 1e5);
}



TEST(FirstOrderStates, OtherIntegratorsSayThatTheyKnowNone)
{
  const Scene scene(oscillator_with_lag());
  for (const auto &name : rival_names())
    try
      {
        make_rival(name, scene.system, {});
        ADD_FAILURE() << name;
      }
    catch (const std::invalid_argument &problem)
      {
        EXPECT_NE(std::string(problem.what()).find("knows no states of first order"), std::string::npos);
      }
}



// A hinge that is driven by an autopilot with a lag: its angle is what the state says, its rate that of the state.
TEST(FirstOrderStates, DriveWhatIsPrescribed)
{
  const std::string text = hinged_bar(R"(
  subsection autopilot
    set Rate = (1 - autopilot)/(0.2 s)
  end
)",
                                      R"(
      set Prescribed = 0.1 rad * sin(20*t) + 0.3*autopilot
)");
  const Scene       scene(text);
  const System     &system = scene.system;
  const double      T = 0.4, lag = std::exp(-T / 0.2), angle = 0.1 * std::sin(20 * T) + 0.3 * (1 - lag),
               rate = 2 * std::cos(20 * T) + 0.3 * lag / 0.2;
  for_all_members([&](const Tableau &tableau) {
    const Record coarse = run(system, started(system), tableau, T / 20, 20),
                 fine   = run(system, started(system), tableau, T / 40, 40);
    ASSERT_EQ(fine.n_steps, 40u);
    EXPECT_LT(fine.gap, 1e-12);
    EXPECT_LT(fine.balance, 1e-12);
    const double error = std::abs(fine.state.coordinates[0] - angle);
    EXPECT_LT(error, tableau.s == 1 ? 5e-3 : 1e-5);
    if (tableau.alpha == 0 && tableau.s < 3)
      {
        EXPECT_NEAR(std::log2(std::abs(coarse.state.coordinates[0] - angle) / error), 2. * tableau.s, 0.3);
      }
    State projected = fine.state;
    Projection(system).velocities(projected);
    EXPECT_NEAR(projected.rates[0], rate, tableau.s == 1 ? 3e-2 : 1e-4);
  });
}



// A mass on a slide that a state drives has the reaction of its acceleration, not of its velocity.
TEST(FirstOrderStates, ReactionsOfWhatTheyDrive)
{
  const auto force = [](const bool by_state) {
    const Scene scene(on_a_slide("subsection v\n set Rate = -100*z\n set Initial = 10\n end\n"
                                 " subsection z\n set Rate = v\n end\n",
                                 std::string("set Prescribed = ") + (by_state ? "1 m*z" : "sin(10*t)")));
    Record      record = run(scene.system, started(scene.system), Tableau(3, 1.), 0.01, 100);
    Projection(scene.system).report(record.state);
    EXPECT_NEAR(record.state.accelerations[6 + 2], -100 * std::sin(10.), 1e-3);
    if (by_state)
      {
        EXPECT_NEAR(record.state.accelerations.back(), 10 * std::cos(10.), 1e-3); // ż
      }
    return scene.input.model.probe("slide.force 3").value(record.state);
  };
  EXPECT_NEAR(force(false), -200 * std::sin(10.), 1e-2);
  EXPECT_NEAR(force(true), force(false), 1e-3);
}



// The first guess of a step is the polynomial through the start and the stages of the one before: where the states are
// one, here z = t², it is the solution, and Newton's method has nothing to do, however nonlinear their rates are.
TEST(FirstOrderStates, ArePredicted)
{
  const Scene scene(on_a_slide("subsection z\n set Rate = 2*t - 30*(exp(z - t^2) - 1)\n end\n", "set Force = 3 N"));
  for (const auto &[s, rho] : {std::pair(2u, 1.), {3u, 1.}, {3u, 0.}})
    {
      SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
      unsigned int iterations[2] = {0, 0};
      for (const bool forgets : {false, true})
        {
          StageIntegrator integrator(scene.system, Tableau(s, rho), 1e-12);
          State           state = started(scene.system);
          for (unsigned int i = 0; i < 8; ++i)
            {
              if (forgets)
                integrator.forget_history();
              const StepResult result = integrator.step(state, i % 3 == 1 ? 0.07 : 0.1); // steps may change
              ASSERT_TRUE(result.converged);
              EXPECT_NEAR(state.states[0], state.time * state.time, 1e-11);
              if (i > 0)
                iterations[forgets] += result.iterations;
              if (i > 0 && !forgets)
                {
                  EXPECT_LE(result.iterations, 2u);
                }
            }
        }
      EXPECT_GE(iterations[true], 2 * iterations[false]);
    }
}
