// Forward flight of a rotor with flapping blades and inflow: orders of convergence, energy, axes of the inflow.

#include <samara/analysis/dynamic.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>

#include "../orders.h"
#include "../output/scratch_folder.h"
#include "../scene.h"
#include "../time/systems.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** Two blades on flap hinges, lags, inflow of Pitt and Peters, a wind of 12 m/s along x; turning at 30 rad/s. */
  std::string
  two_bladed_rotor(const std::string &hub, const std::string &entries)
  {
    std::string bodies = turning_hub("hub"), joints = driven_shaft("hub"), surfaces;
    for (const std::string sign : {"", "-"})
      {
        const std::string name = sign.empty() ? "blade 1" : "blade 2";
        bodies += "  subsection " + name +
                  "\n    set Type = rigid body\n    set Mass = 3\n    set Inertia = 0.01, 1.5, 1.5\n"
                  "    set Position = " +
                  sign + "1.6, 0, 0\n    set Angular velocity = 0, 0, 30\n    set Velocity = 0, " + sign +
                  "48, 0\n  end\n";
        joints += "  subsection flap " + name +
                  "\n    set Type = revolute\n    set Body A = hub.centre\n    set Body B = " + name +
                  ".centre\n    set Position = " + sign + "0.2, 0, 0\n    set Axis = 0, " + (sign.empty() ? "-" : "") +
                  "1, 0\n"
                  "    subsection rotation\n      set Spring = 50\n    end\n  end\n";
        surfaces += subsection(name,
                               "    set Body = " + name + "\n    set Line = " + sign + "0.5, 0, 0; " + sign +
                                 "3, 0, 0\n"
                                 "    set Leading edge = 0, " +
                                 sign +
                                 "1, 0\n    set Chord = 0.2\n    set Twist = 8 deg - 1 deg*s\n"
                                 "    set Airfoils = plain\n    set Inflow = flow\n" +
                                 entries);
      }
    return subsection("Bodies", bodies) + subsection("Joints", joints) + airfoils() +
           subsection("Aerodynamics",
                      air("12, 0, -1") +
                        subsection("flow",
                                   "    set Type = Pitt-Peters inflow\n    set Hub = " + hub +
                                     "\n    set Axis = 0, 0, 1\n    set Radius = 3\n    set Initial = 5\n")) +
           subsection("Surfaces", surfaces);
  }

  Record
  flown(const Scene &scene, const Tableau &tableau, const double T, const unsigned int n)
  {
    State state = scene.system.reference();
    scene.system.add_initial_velocities(state);
    Projection(scene.system).velocities(state);
    state.held    = false;
    Record record = run(scene.system, state, tableau, T / n, n);
    EXPECT_EQ(record.n_steps, n);
    Projection(scene.system).velocities(record.state);
    return record;
  }

  /** Hub loads in fixed axes. */
  std::vector<double>
  hub_loads(const Scene &scene, const State &state)
  {
    std::vector<double> values;
    for (const std::string blade : {"blade 1", "blade 2"})
      for (const std::string quantity : {"force x", "force z", "moment x", "moment y", "moment z"})
        values.push_back(scene.input.model.probe(blade + "." + quantity).value(state));
    return values;
  }
} // namespace



TEST(ForwardFlight, OrdersOfHubLoads)
{
  const Scene  scene(two_bladed_rotor("ground", ""));
  const double T     = 0.12; // 0.6 of a turn
  const auto   exact = hub_loads(scene, flown(scene, Tableau(3, 1.), T, 96).state);
  expect_orders(orders_in_flight, exact, 0.45, [&](const Tableau &tableau, const unsigned int n) {
    return hub_loads(scene, flown(scene, tableau, T, n).state);
  });
}



TEST(ForwardFlight, EnergyStatement)
{
  const Scene scene(two_bladed_rotor("hub.centre", "    set Virtual mass = true\n"));
  for (const double rho : {1., 0.})
    for (const unsigned int s : {2, 3})
      {
        const Record record = flown(scene, Tableau(s, rho), 0.06, 12);
        EXPECT_LT(record.balance, 1e-12);
        EXPECT_GE(record.least_dissipated, -1e-12 * record.energy);
        EXPECT_GT(std::abs(record.work_of_loads), 1.);
      }
}



namespace
{
  /** Of the blades together: powers of the air, induced and profile power [W]. */
  std::array<double, 3>
  powers_of_air(const Scene &scene, Projection &projection, State state)
  {
    projection.velocities(state);
    std::array<double, 3> sum = {{0, 0, 0}};
    for (const std::string blade : {"blade 1", "blade 2"})
      for (unsigned int i = 0; i < 3; ++i)
        sum[i] += scene.input.model.probe(blade + (i == 0 ? ".power" :
                                                   i == 1 ? ".induced power" :
                                                            ".profile power"))
                    .value(state);
    return sum;
  }

  /** What n steps say of the work of the air. */
  std::array<double, 3>
  work_of_air(const Scene &scene, const Tableau &tableau, const double T, const unsigned int n)
  {
    StageIntegrator integrator(scene.system, tableau, 1e-12);
    State           state = start_of({"", "", 0, T}, scene.system);
    WorkOfAir       work;
    double          of_loads = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const StepResult result = integrator.step(state, T / n);
        EXPECT_TRUE(result.converged);
        work.add(1, result.air);
        of_loads += result.work_of_loads;
      }
    EXPECT_NEAR(work.on_model, of_loads, 1e-11 * std::abs(of_loads)); // nothing else acts
    return {{work.on_model, work.induced, work.profile}};
  }
} // namespace



// The work of the air that steps account for is the integral of what the probes say, to the order of the scheme; so are
// induced and profile work.
TEST(ForwardFlight, WorkOfAirIsTheIntegralOfItsPower)
{
  const Scene           scene(two_bladed_rotor("ground", ""));
  const double          T       = 0.12;
  const unsigned int    n       = 384;
  const double          boole[] = {14, 32, 12, 32};
  StageIntegrator       fine(scene.system, Tableau(3, 1.), 1e-13);
  Projection            projection(scene.system);
  State                 state    = start_of({"", "", 0, T}, scene.system);
  std::array<double, 3> integral = {{0, 0, 0}};
  for (unsigned int i = 0; i <= n; ++i)
    {
      const auto power = powers_of_air(scene, projection, state);
      for (unsigned int j = 0; j < 3; ++j)
        integral[j] += T / n * 4 / 90 * (i == 0 || i == n ? 7 : boole[i % 4]) * power[j];
      if (i < n)
        {
          ASSERT_TRUE(fine.step(state, T / n).converged);
        }
    }
  EXPECT_LT(integral[0], 0); // it brakes
  EXPECT_GT(integral[1], 0);
  EXPECT_GT(integral[2], 0);
  for (const auto &[s, rho, order] : {std::tuple(1u, 1., 2.), {2u, 1., 4.}, {2u, 0., 3.}})
    {
      SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
      const auto coarse = work_of_air(scene, Tableau(s, rho), T, 48), half = work_of_air(scene, Tableau(s, rho), T, 96);
      for (unsigned int j = 0; j < 3; ++j)
        {
          const double one = std::abs(coarse[j] - integral[j]), two = std::abs(half[j] - integral[j]);
          EXPECT_LT(two, std::max(1e-7 * std::abs(integral[j]), one * std::pow(2, 0.5 - order)))
            << j << ": " << one << ", " << two << " of " << integral[j];
          EXPECT_LT(two, 1e-2 * std::abs(integral[j]));
        }
    }
}



// In the budget the air stands by itself: what else acts here is the weight, whose work is what its potential loses.
TEST(ForwardFlight, BudgetTellsTheWorkOfAir)
{
  const ScratchFolder scratch;
  Scene               scene(two_bladed_rotor("ground", "") +
              "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n"
                            "set Analyses = dynamic\nsubsection Dynamic\n set End time = 0.06\n set Step = 0.0025\nend\n");
  scene.context.folder = scratch.path;
  auto &dynamic        = scene.analysis<DynamicAnalysis>();
  dynamic.start(scene.context);
  dynamic.run(scene.context);
  const auto  &budget  = dynamic.budget;
  const double largest = std::abs(budget.kinetic);
  EXPECT_LT(std::abs(budget.balance()), 1e-12 * largest);
  EXPECT_LT(std::abs(budget.loads), 1e-12 * largest);
  EXPECT_LT(budget.air.on_model, -1.);
  EXPECT_GT(budget.air.induced, 1.);
  EXPECT_GT(budget.air.profile, 1.);
  const std::string table = content_of(scratch.path + "/dynamic_energy.csv");
  EXPECT_EQ(
    table.substr(0, table.find('\n')),
    "t [s],kinetic [J],strain [J],potential [J],work of loads [J],work of air [J],work of drives [J],"
    "damper loss [J],friction loss [J],numerical dissipation [J],balance [J],induced work [J],profile work [J]");
  std::istringstream  last(table.substr(table.rfind('\n', table.size() - 2) + 1));
  std::vector<double> row;
  for (std::string number; std::getline(last, number, ',');)
    row.push_back(std::stod(number));
  ASSERT_EQ(row.size(), 13u);
  const double start = budget.start,
               sum   = row[1] + row[2] + row[3] - start - row[4] - row[5] - row[6] + row[7] + row[8] + row[9];
  EXPECT_NEAR(sum, row[10], 1e-9 * largest); // figures of the table
  EXPECT_NEAR(row[5], budget.air.on_model, 1e-6);
  EXPECT_NEAR(row[11], budget.air.induced, 1e-6);
}



// The axes of the inflow may turn with the hub or not: the air is the same.
TEST(ForwardFlight, InflowInTurningAxes)
{
  const Scene fixed(two_bladed_rotor("ground", "")), turning(two_bladed_rotor("hub.centre", ""));
  const auto  a = flown(fixed, Tableau(3, 1.), 0.1, 30), b = flown(turning, Tableau(3, 1.), 0.1, 30);
  const auto  loads = hub_loads(fixed, a.state), same = hub_loads(turning, b.state);
  EXPECT_LT(distance(loads, same), 1e-8);
  // the gradients are seen in other axes
  EXPECT_GT(std::abs(fixed.input.model.probe("flow.state 2").value(a.state) -
                     turning.input.model.probe("flow.state 2").value(b.state)),
            0.01);
}
