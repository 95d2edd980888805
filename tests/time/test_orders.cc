// Orders of convergence: 2s for ρ∞ = 1 and 2s − 1 otherwise, of places, and of projected velocities, reactions and
// section forces as they are reported; momentum and moment of momentum of what nothing acts on.
//
// Reference: the scheme itself with s = 3, ρ∞ = 1 and 128 steps, compared at four times. Of the orders from one step
// size to half of it, as far as round-off lets them be seen, the best is within 0.15, and none is
// much less than it should be: where the leading term is not yet all there is, orders may be higher, or lower by the
// next term. (With ρ∞ = 0.1 instead of ½ that is the case earlier.)

#include "../states/scenes.h"
#include <gtest/gtest.h>

#include "systems.h"

using namespace samara;

namespace
{
  /** Numbers of steps, each twice the one before. */
  std::vector<unsigned int>
  numbers_of_steps(const Tableau &tableau)
  {
    switch (tableau.s)
      {
        case 1:
          return tableau.alpha > 0 ? std::vector<unsigned int>{160, 320} : std::vector<unsigned int>{40, 80};
        case 2:
          return {20, 40, 80};
        default:
          return {4, 8, 16, 32};
      }
  }

  int
  order_of(const Tableau &tableau)
  {
    return tableau.alpha == 0 ? 2 * tableau.s : 2 * tableau.s - 1;
  }

  /** From each error to the next, as long as they are above the floor. */
  std::vector<double>
  orders(const std::vector<double> &errors, const double floor)
  {
    std::vector<double> result;
    for (unsigned int i = 1; i < errors.size() && errors[i] > floor; ++i)
      result.push_back(std::log2(errors[i - 1] / errors[i]));
    return result;
  }

  /** @p floor: of round-off. The last order whose errors are well above it counts, or, if there is none, the first, to 0.3: the
   * coarsest steps are not yet in the range where it holds exactly. None well above may be lower by one. */
  void
  expect_order(const std::vector<double> &errors, const double floor, const double expected)
  {
    const auto all = orders(errors, floor), sure = orders(errors, 6 * floor);
    ASSERT_FALSE(all.empty()) << errors[0] << ", " << errors[1];
    EXPECT_NEAR(sure.empty() ? all.front() : sure.back(), expected, 0.3) << errors[0] << ", " << errors[1];
    for (const double order : sure)
      EXPECT_GT(order, expected - 1);
  }

  /** What is reported: places, projected velocities, reactions, section forces, states of first order and their rates,
   * each at T/4, T/2, 3T/4 and T. */
  using Report = std::map<std::string, std::vector<double>>;

  Report
  reported(const System &system, const State &start, const Tableau &tableau, const unsigned int n, const double T)
  {
    StageIntegrator integrator(system, tableau, 1e-14);
    Projection      projection(system);
    State           state = start;
    Report          report;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Record r = run(system, state, integrator, T / n, n / 4, true);
        EXPECT_EQ(r.n_steps, n / 4);
        state     = r.state;
        State end = state;
        projection.report(end);
        for (const auto &[name, values] : {std::pair("places", end.q),
                                           {"velocities", end.y},
                                           {"reactions", end.multipliers},
                                           {"section forces", end.stress},
                                           {"states", end.states},
                                           {"rates of states", end.state_rates}})
          report[name].insert(report[name].end(), values.begin(), values.end());
      }
    return report;
  }
} // namespace



namespace
{
  /** @p later: with the sixth order, as the same error a little later is farther above round-off. */
  void
  expect_orders_of_reports(const System &system, const State &start, const double T, const double later)
  {
    const Report at_T     = reported(system, start, Tableau(3, 1.), 128, T),
                 at_later = reported(system, start, Tableau(3, 1.), 128, later);
    for (const unsigned int s : {1, 2, 3})
      for (const double rho : {1., 0.1, 0.})
        {
          const Tableau                              tableau(s, rho);
          const bool                                 is_later = order_of(tableau) == 6;
          const Report                              &exact    = is_later ? at_later : at_T;
          std::map<std::string, std::vector<double>> errors;
          for (const unsigned int n : numbers_of_steps(tableau))
            for (const auto &[name, values] : reported(system, start, tableau, n, is_later ? later : T))
              errors[name].push_back(distance(values, exact.at(name)));
          for (const auto &[name, e] : errors)
            {
              SCOPED_TRACE(name + ", s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
              const std::vector<double> &values = exact.at(name);
              // angles that springs measure, and so their moments, are told to 1e-12 only
              const double round_off = name == "places" ? 5e-14 : name == "section forces" ? 1e-12 : 5e-13;
              if (std::any_of(values.begin(), values.end(), [](const double x) { return x != 0; }))
                expect_order(e, round_off, order_of(tableau));
            }
        }
  }
} // namespace



TEST(Orders, OfWhatIsReported)
{
  for_all_systems([&](const MovingSystem &what, const System &system, const State &start) {
    if (what.T > 0)
      expect_orders_of_reports(system, start, what.T, what.name.find("crank") == 0 ? 1.5 * what.T : what.T);
  });
}



// Loads and reactions that depend on states of first order, and the states themselves.
TEST(Orders, OfWhatIsReportedWithStates)
{
  for (const auto &[text, T] : {std::pair(oscillator_with_lag(), 0.6), {top_with_controls(), 0.3}})
    {
      SCOPED_TRACE(text);
      const Scene scene(text);
      expect_orders_of_reports(scene.system, start_of({"", text, 0, T}, scene.system), T, T);
    }
}



// The momentum is exact for a single body. A pair of forces on bodies that turn differently is not quite one of
// opposite forces, as the triads of stages are not orthonormal (D_k D_kᵀ f instead of f): the error is O(h^2s) there,
// too.
TEST(Momentum, OfFreeSystems)
{
  unsigned int n_systems = 0, n_orders = 0;
  for_all_systems([&](const MovingSystem &what, const System &system, const State &start) {
    if (!what.is_free)
      return;
    ++n_systems;
    const Vector6 expected = momentum_of(system, start);
    for_all_members([&](const Tableau &tableau) {
      std::vector<double> linear, angular;
      for (const unsigned int n : numbers_of_steps(tableau))
        {
          const Vector6 p = momentum_of(system, run(system, start, tableau, what.T / n, n).state) - expected;
          linear.push_back(p.head<3>().norm() / expected.head<3>().norm());
          angular.push_back(p.tail<3>().norm() / expected.tail<3>().norm());
        }
      if (system.layout.n_nodes == 2 && tableau.alpha == 0)
        {
          EXPECT_LT(*std::max_element(linear.begin(), linear.end()), 1e-12);
        }
      for (const auto &errors : {linear, angular})
        for (const double order : orders(errors, 2e-12))
          {
            ++n_orders;
            EXPECT_GT(order, order_of(tableau) - 0.4);
          }
    });
  });
  EXPECT_GE(n_systems, 10u);
  EXPECT_GE(n_orders, 20 * n_systems);
}
