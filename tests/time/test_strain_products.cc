/*
 * Problem:   a flying beam whose torsion tension stiffens: a strain that is no quadratic function of places and triads
 * Reference: the energy statement of the family, which holds to round-off all the same; order 2 s
 */

#include <gtest/gtest.h>

#include <cmath>

#include "systems.h"

using namespace samara;

namespace
{
  /** Bent, stretched and twisted, the ends against each other. */
  void
  bend_and_twist(const System &system, State &state)
  {
    systems::bend(system, state);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      state.y[6 * node + 3] += 6 * (system.model.nodes[node].x(0) - 1);
  }

  MovingSystem
  twisted_blade()
  {
    MovingSystem what = systems::flying_blade();
    what.kick         = bend_and_twist;
    return what;
  }
} // namespace



// With the rate of the strain as it is at the stages, 1e-3 of the energy is missing in steps of this size.
TEST(StrainProducts, EnergyStatement)
{
  const MovingSystem what = twisted_blade();
  const Scene        scene(what.text);
  const State        start = start_of(what, scene.system);
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.5, 0.})
      {
        SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
        const Record r = run(scene.system, start, Tableau(s, rho), what.h, 30);
        EXPECT_EQ(r.n_steps, 30u);
        EXPECT_LT(r.balance, 1e-12);
        EXPECT_EQ(r.dissipated > 0, rho < 1);
        EXPECT_GE(r.least_dissipated, 0);
      }
}



TEST(StrainProducts, Orders)
{
  const MovingSystem what = twisted_blade();
  const Scene        scene(what.text);
  const State        start = start_of(what, scene.system);
  const State        fine  = run(scene.system, start, Tableau(3, 1.), 0.001, 60).state;
  for (const unsigned int s : {1, 2, 3})
    {
      std::vector<double> errors;
      for (const unsigned int n : {6, 12})
        errors.push_back(distance(run(scene.system, start, Tableau(s, 1.), 0.06 / n, n).state.q, fine.q));
      EXPECT_GT(std::log2(errors[0] / errors[1]), 2 * s - 0.3) << "s = " << s;
    }
}
