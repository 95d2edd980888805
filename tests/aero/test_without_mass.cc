// Uniform inflow without apparent mass: an algebraic state, H. Glauert's momentum theory at once.
//
// References: T = 2ρA V_T ν with V_T² = μ² + (λ_f + ν)²; orders of the family; the limit of small masses, which is of
// first order in them; derivatives against differences.

#include <samara/analysis/linear_system.h>
#include <samara/base/dense.h>
#include <samara/model/doubts.h>
#include <samara/time/increment.h>
#include <samara/time/period_map.h>
#include <samara/time/projection.h>

#include "../orders.h"
#include "../scene.h"
#include "../time/systems.h"
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** A blade on a hub that is driven at 30 rad/s; on a hinge @p hinge with @p motion, in the inflow <flow>. */
  std::string
  one_bladed_rotor(const std::string &inflow,
                   const std::string &wind   = "12, 0, -1",
                   const std::string &hinge  = "0, -1, 0",
                   const std::string &motion = "set Spring = 50",
                   const std::string &twist  = "8 deg - 1 deg*s")
  {
    return blade_on_driven_hub("hinge", hinge, motion) + airfoils() +
           subsection("Aerodynamics",
                      air(wind) +
                        subsection("flow",
                                   "    set Type = " + inflow +
                                     "\n    set Hub = ground\n    set Axis = 0, 0, 1\n    set Radius = 3\n")) +
           subsection("Surfaces",
                      subsection("blade",
                                 "    set Body = blade\n    set Line = 0.5, 0, 0; 3, 0, 0\n"
                                 "    set Leading edge = 0, 1, 0\n    set Chord = 0.2\n    set Airfoils = plain\n"
                                 "    set Unsteady = quasi-steady\n    set Inflow = flow\n    set Twist = " +
                                   twist + "\n"));
  }

  const std::string at_once = "uniform inflow\n    set Apparent mass = 0";

  std::string
  with_mass(const double M)
  {
    return "uniform inflow\n    set Apparent mass = " + number_to_text(M);
  }

  State
  start_of(const Scene &scene)
  {
    State state = scene.system.reference();
    scene.system.add_initial_velocities(state);
    Projection(scene.system).velocities(state);
    state.held = false;
    return state;
  }

  double
  value_of(const Scene &scene, const std::string &probe, const State &state)
  {
    return scene.input.model.probe(probe).value(state);
  }

  /** T − 2ρA V_T ν in parts of the larger; @p mu and @p lambda_f of the wind. */
  double
  miss_of_glauert(const Scene &scene, const State &state, const double mu, const double lambda_f)
  {
    const double thrust = value_of(scene, "flow.thrust", state), nu = value_of(scene, "flow.mean", state),
                 momentum = 2 * 1.225 * M_PI * 9 * std::hypot(mu, lambda_f + nu) * nu;
    return std::abs(thrust - momentum) / std::max({std::abs(thrust), std::abs(momentum), 1e-3});
  }

  /** What the hub feels at the end of @p n steps in the time @p T. */
  std::vector<double>
  hub_loads_after(const Scene &scene, const Tableau &tableau, const double T, const unsigned int n)
  {
    Record record = run(scene.system, start_of(scene), tableau, T / n, n);
    EXPECT_EQ(record.n_steps, n);
    Projection(scene.system).velocities(record.state);
    std::vector<double> values;
    for (const std::string quantity : {"force x", "force z", "moment x", "moment y", "moment z"})
      values.push_back(value_of(scene, "blade." + quantity, record.state));
    values.push_back(100 * value_of(scene, "flow.mean", record.state));
    return values;
  }
} // namespace



// At the start, from which nothing is known, and at the end of every step, with any number of stages and any damping;
// also where pitch takes the thrust through zero and the flow of hover with it.
TEST(InflowWithoutMass, IsGlauertsAtEveryStep)
{
  struct Case
  {
    Scene  scene;
    double mu, lambda_f;
    bool   turns_round;
  };
  Case cases[] = {
    {Scene(one_bladed_rotor(at_once)), 12, 1, false},
    {Scene(one_bladed_rotor(at_once, "0, 0, 0", "1, 0, 0", "set Prescribed = 0.1*sin(60*t)", "0.2 deg")), 0, 0, true}};
  for (const auto &[scene, mu, lambda_f, turns_round] : cases)
    for (const auto &[s, rho] : {std::pair<unsigned int, double>{1, 1.}, {1, 0.}, {2, 1.}, {2, 0.}, {3, 1.}, {3, 0.5}})
      {
        SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + number_to_text(rho));
        StageIntegrator integrator(scene.system, Tableau(s, rho), 1e-11);
        State           state = start_of(scene);
        EXPECT_LT(miss_of_glauert(scene, state, mu, lambda_f), 1e-10);
        double least = 1e300, most = -1e300;
        for (unsigned int i = 0; i < 16; ++i)
          {
            ASSERT_TRUE(integrator.step(state, 0.01).converged);
            State reported = state;
            Projection(scene.system).report(reported);
            EXPECT_LT(miss_of_glauert(scene, reported, mu, lambda_f), 1e-10) << i;
            least = std::min(least, value_of(scene, "flow.mean", reported));
            most  = std::max(most, value_of(scene, "flow.mean", reported));
          }
        EXPECT_GT(most, 0.5);
        EXPECT_EQ(least < -0.5, turns_round);
      }
}



TEST(InflowWithoutMass, OrdersOfHubLoads)
{
  const Scene  scene(one_bladed_rotor(at_once));
  const double T     = 0.12;
  const auto   exact = hub_loads_after(scene, Tableau(3, 1.), T, 96);
  expect_orders(orders_in_flight, exact, 0.5, [&](const Tableau &tableau, const unsigned int n) {
    return hub_loads_after(scene, tableau, T, n);
  });
}



// Small masses come as near to it as they are small.
TEST(InflowWithoutMass, IsTheLimitOfSmallMasses)
{
  const auto loads = [](const std::string &inflow) {
    return hub_loads_after(Scene(one_bladed_rotor(inflow)), Tableau(3, 0.), 0.06, 32);
  };
  const auto   exact = loads(at_once);
  const double large = distance(loads(with_mass(1e-3)), exact), small = distance(loads(with_mass(1e-4)), exact);
  EXPECT_NEAR(std::log10(large / small), 1, 0.1);
  EXPECT_GT(large, 1e-4);
}



// Hover does not depend on the mass; its modes and the matrices of its linear system are those of a mass that is next
// to nothing, without the mode that is the flow's own.
TEST(InflowWithoutMass, HoverAndItsModes)
{
  const auto hover = [](const std::string &inflow) {
    std::string text = one_bladed_rotor(inflow, "0, 0, 0");
    const auto  at   = text.find("    subsection rotation\n      set Prescribed");
    text.erase(at, text.find("  end\n  subsection hinge") - at);
    return text +
           "subsection Loads\n  subsection turning\n    set Type = steady rotation\n    set Joint = shaft\n"
           "    set Speed = 30\n  end\n  subsection push\n    set Type = point load\n    set At = blade.centre\n"
           "    set Force = 0, 0, u*(1 N)\n  end\nend\nsubsection States\n  subsection u\n    set Type = control\n"
           "  end\nend\n";
  };
  Scene none(hover(at_once)), some(hover(with_mass(1e-8))), disk(hover("uniform inflow"));
  for (Scene *const scene : {&none, &some, &disk})
    scene->equilibrium();
  EXPECT_LT(miss_of_glauert(none, none.context.state, 0, 0), 1e-9);
  EXPECT_NEAR(none.value("flow.thrust"), disk.value("flow.thrust"), 1e-8 * disk.value("flow.thrust"));
  const auto without = none.modes(), with = some.modes(), late = disk.modes();
  ASSERT_EQ(with.size(), without.size() + 1); // its own has a rate of 1/M
  double furthest = 0;
  for (unsigned int i = 0; i < without.size(); ++i)
    {
      EXPECT_LT(std::abs(without[i].lambda), 1e3);
      EXPECT_NEAR(std::abs(without[i].lambda - with[i].lambda), 0, 1e-5) << without[i].lambda;
      double nearest = 1e300;
      for (const auto &mode : late)
        nearest = std::min(nearest, std::abs(without[i].lambda - mode.lambda));
      furthest = std::max(furthest, nearest);
    }
  EXPECT_GT(furthest, 0.1); // and the time constant matters

  none.analysis<LinearSystemAnalysis>().run(none.context);
  const auto &space = none.analysis<LinearSystemAnalysis>().space;
  ASSERT_EQ(space.A.rows(), 4); // angles of shaft and hinge, and their rates
  const Eigen::VectorXcd poles = general_eigenvalues(space.A);
  for (const auto &mode : without)
    EXPECT_NEAR((poles.array() - mode.lambda).abs().minCoeff(), 0, 1e-5) << mode.lambda;
}



// Multipliers: the start of the flow is forgotten within a step, and the derivative of a period is that of where it
// ends.
TEST(InflowWithoutMass, ForgetsItsStart)
{
  const Scene scene(one_bladed_rotor(at_once));
  for (const auto &[s, rho] : {std::pair<unsigned int, double>{1, 1.}, {2, 1.}, {3, 0.5}})
    {
      PeriodMap          map(scene.system, {2 * M_PI / 30, 12, s, rho});
      const State        start = start_of(scene);
      const unsigned int z     = scene.system.layout.of_state(0);
      map.linearize(start);
      std::vector<double> x(map.size(), 0.);
      x[z] = 1;
      map.apply(x.data());
      for (const double of_end : x)
        EXPECT_NEAR(of_end, 0, 1e-12);

      // the hinge turns and the flow follows
      const auto  scales = scales_of_increment(scene.system, 1.);
      const State ahead  = start;
      std::fill(x.begin(), x.end(), 0.);
      x[scene.system.layout.of_coordinate(1)] = 1; // not alone: nodes go with it
      const auto &blade                       = scene.input.model.frame("blade.centre");
      Eigen::Map<Vector6>(&x[scene.system.layout.of_node(blade.node)]) << 0, 0, 1.4, 0, -1, 0;
      auto apart = x;
      map.apply(x.data());
      const double eps   = 1e-4;
      const State  a     = map.march(moved(scene.system, ahead, apart.data(), eps)),
                  b      = map.march(moved(scene.system, ahead, apart.data(), -eps));
      const double slope = (a.states[0] - b.states[0]) / (2 * eps);
      EXPECT_GT(std::abs(slope), 1e-3);
      EXPECT_NEAR(x[z], slope, 1e-5 * std::abs(slope) + 1e-7) << s;
    }
}



// In a descent that becomes steeper the flow goes on as that of hover, with Glauert's equation, beyond vortex rings,
// where a windmill's is another solution: both are told of.
TEST(InflowWithoutMass, TellsThatItIsStillThatOfHover)
{
  const Scene scene(one_bladed_rotor(at_once, "0, 0, 20*t"));
  const auto *inflow = dynamic_cast<const Doubtful *>(&scene.input.model.find<Item>("flow", "inflow"));
  ASSERT_NE(inflow, nullptr);
  StageIntegrator          integrator(scene.system, Tableau(2, 0.5), 1e-11);
  State                    state = start_of(scene);
  std::vector<std::string> told;
  for (unsigned int i = 0; i < 40; ++i)
    {
      ASSERT_TRUE(integrator.step(state, 0.02).converged);
      State reported = state;
      Projection(scene.system).report(reported);
      EXPECT_LT(miss_of_glauert(scene, reported, 0, -20 * state.time), 1e-10) << i;
      EXPECT_GT(value_of(scene, "flow.mean", reported), 20 * state.time);
      for (const auto &doubt : inflow->doubts(reported))
        if (told.empty() || told.back() != doubt.about)
          told.push_back(doubt.about);
    }
  EXPECT_EQ(told, std::vector<std::string>({"vortex rings", "flow of hover"}));
}
