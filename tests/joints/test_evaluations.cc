// What joints evaluate in parts must be what they evaluate as a whole: constraints alone, their rates, and the strains
// of one configuration for many uses, against residual and tangent. (Those agree with complex steps, tests/model.)

#include <samara/time/stage_rotation.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  /** Kinds of joints with the motions that they leave free, and what else they need. */
  const std::vector<std::array<std::string, 3>> joints = {
    {{"revolute", "rotation", "set Axis = 1, 2, -1"}},
    {{"prismatic", "displacement", "set Axis = 1, 2, -1"}},
    {{"screw", "rotation", "set Axis = 1, 2, -1\nset Pitch = 0.3"}},
    {{"cylindrical", "displacement", "set Axis = 1, 2, -1"}},
    {{"planar", "displacement 2", "set Axis = 1, 2, -1"}},
    {{"universal", "rotation 2", "set Axis = 1, 0, 0\nset Second axis = 0, 1, 0"}},
    {{"spherical", "", ""}},
    {{"rigid", "", "set Reaction = true"}},
    {{"spring", "length", "set Position = 1, 0.4, 0.2"}},
    {{"distance", "", "set Position = 1, 0.4, 0.2"}},
    {{"flexible joint", "", "set Axis = 1, 2, -1\nset Stiffness = 1, 2, 3\nset Rotational damping = 3, 2, 1"}},
    {{"rolling ball", "", "set Axis = 1, 2, -1\nset Radius = 0.4"}},
    {{"knife edge", "", "set Axis = 1, 2, -1"}}};

  /** Two bodies, not on their joint, that has all that a free motion can have. */
  std::string
  two_bodies_and_motion(const std::array<std::string, 3> &joint)
  {
    const std::string all_of_it = " set Spring = 2\n set Damper = 0.3\n set Rest = 0.2\n set Prescribed = 0.1 + 0.2*t\n"
                                  " set Lower stop = 2\n set Upper stop = 3\n set Stop stiffness = 1.5\n"
                                  " set Stop damping = 0.4\n";
    return "subsection Bodies\n subsection a\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1, 1\n"
           " set Position = 0.3, -0.2, 0.1\n set Rotation = 0.4, 0.2, -0.7\n end\n"
           " subsection b\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1, 1\n set Position = 2, 1, 1\n"
           " set Rotation = -0.1, 0.5, 0.3\n set Frames = end at 1 0.9 0.6\n end\nend\n"
           "subsection Joints\n subsection j\n set Body A = a\n set Body B = b.end\n set Type = " +
           joint[0] + "\n" + joint[2] + "\n" +
           (joint[1].empty() ? "" : "subsection " + joint[1] + "\n" + all_of_it + " end\n") + " end\nend\n";
  }

  /** Anywhere, triads deformed, with velocities; the lower stop touched. */
  State
  some_state(const System &system)
  {
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> number(-0.3, 0.3);
    State                                  state = system.reference();
    for (auto *const values : {&state.q, &state.coordinates, &state.y, &state.rates, &state.multipliers, &state.stress})
      for (unsigned int i = values == &state.q ? 12 : values == &state.y ? 6 : 0; i < values->size(); ++i)
        (*values)[i] += number(random);
    state.time   = 0.4;
    state.factor = 0.8;
    return state;
  }

  Eigen::VectorXd
  velocities_of(const System &system, const State &state)
  {
    const Layout   &layout = system.layout;
    Eigen::VectorXd z      = Eigen::VectorXd::Zero(system.size());
    std::copy(state.y.begin() + 6, state.y.end(), z.data());
    std::copy(state.rates.begin(), state.rates.end(), z.data() + layout.of_coordinate(0));
    return z;
  }
} // namespace



TEST(JointEvaluations, ConstraintsAreRowsOfTheResidual)
{
  for (const auto &joint : joints)
    {
      const Scene         scene(two_bodies_and_motion(joint));
      const Layout       &layout = scene.system.layout;
      const State         state  = some_state(scene.system);
      std::vector<double> all(scene.system.size() + 6, 0.), alone = all;
      scene.system.add_terms(state.point(), all.data());
      scene.system.add_gaps(state.point(), alone.data());
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        EXPECT_EQ(alone[layout.of_multiplier(i)], all[layout.of_multiplier(i)]) << joint[0] << ", row " << i;
    }
}



TEST(JointEvaluations, ConstraintRatesAreRowsOfTheTangent)
{
  for (const auto &joint : joints)
    {
      const Scene         scene(two_bodies_and_motion(joint));
      const Layout       &layout = scene.system.layout;
      const State         state  = some_state(scene.system);
      SparseMatrix        K(layout.pattern);
      std::vector<double> rates(layout.n_multipliers, 0.), time_rates = rates;
      scene.system.add_tangent(state.point(), K);
      scene.system.constraint_rates(state.point(), rates.data());
      scene.system.constraint_time_rates(state.point(), time_rates.data());
      const Eigen::VectorXd expected = K.dense() * velocities_of(scene.system, state);
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        EXPECT_NEAR(rates[i] - time_rates[i], expected(layout.of_multiplier(i)), 2e-15) << joint[0] << ", row " << i;
    }
}



// In the axes of nodes, and in the reciprocal ones of steps that turn; equal to the last bit but for how sums are
// fused.
TEST(JointEvaluations, ForcesAndRatesAtOnceAreResidualAndRates)
{
  for (const auto &joint : joints)
    for (const bool turns : {false, true})
      {
        SCOPED_TRACE(joint[0] + (turns ? ", turning" : ""));
        const Scene         scene(two_bodies_and_motion(joint));
        const System       &system = scene.system;
        const Layout       &layout = system.layout;
        const State         state  = some_state(system);
        Point<double>       point  = state.point();
        std::vector<double> reciprocal;
        if (turns)
          {
            StageRotation::set_reciprocal(state.q.data(), layout.n_nodes, reciprocal);
            point.reciprocal = reciprocal.data();
          }
        std::vector<double> all(system.size() + 6, 0.), at_once = all, rates(layout.n_multipliers, 0.),
                                                        rates_at_once = rates;
        std::vector<double> strain_rates(layout.n_strains), strain_rates_at_once = strain_rates;
        system.add_bonds(point, all.data());
        system.constraint_rates(point, rates.data());
        system.strain_rates(point, strain_rates.data());
        system.add_bonds_and_rates(point, at_once.data(), strain_rates_at_once.data(), rates_at_once.data());
        for (int i = 0; i < layout.of_multiplier(0); ++i)
          EXPECT_NEAR(at_once[i], all[i], 1e-15) << "row " << i;
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          EXPECT_NEAR(rates_at_once[i], rates[i], 1e-15) << "row " << i;
        for (unsigned int i = 0; i < layout.n_strains; ++i)
          EXPECT_NEAR(strain_rates_at_once[i], strain_rates[i], 1e-15) << "strain " << i;
      }
}



TEST(JointEvaluations, LinearStrainsAreStrainRatesAndTheirForces)
{
  for (const auto &joint : joints)
    {
      const Scene        scene(two_bodies_and_motion(joint));
      const System      &system    = scene.system;
      const unsigned int n_strains = system.layout.n_strains;
      State              state     = some_state(system);
      if (n_strains == 0)
        continue;
      std::fill(state.multipliers.begin(), state.multipliers.end(), 0.);
      const auto B = system.linear_strains();
      B->renew(state.point());
      std::vector<double> strains(n_strains), rates(n_strains), forces(scene.system.size() + 6, 0.);
      B->strains(state.y.data(), state.rates.data(), strains.data());
      system.strain_rates(state.point(), rates.data());
      B->add_forces(state.stress.data(), forces.data());
      double       power  = 0;
      unsigned int n_zero = 0;
      for (unsigned int i = 0; i < n_strains; ++i)
        {
          EXPECT_NEAR(strains[i], rates[i], 1e-15) << joint[0];
          n_zero += rates[i] == 0.;
          power += state.stress[i] * rates[i];
        }
      EXPECT_EQ(n_zero, joint[1].empty() ? 0u : 1u) << joint[0] << ": the upper stop is not touched";
      EXPECT_NEAR(Eigen::Map<Eigen::VectorXd>(forces.data(), scene.system.size())
                    .head(scene.system.layout.of_multiplier(0))
                    .dot(velocities_of(scene.system, state).head(scene.system.layout.of_multiplier(0))),
                  power,
                  1e-15)
        << joint[0];
    }
}



// Items have the numbers of one layout: a second one of the same model would change them under the first.
TEST(JointEvaluations, BelongToOneLayout)
{
  Scene scene(two_bodies_and_motion(joints[0]));
  EXPECT_THROW(Layout(scene.input.model), std::logic_error);
  EXPECT_THROW(System(scene.input.model), std::logic_error);
}
