/*
 * Problem:   the tangent of a step, ∂x_{n+1}/∂x_n
 * Reference: central differences of sixth order of converged steps
 */

#include <samara/time/increment.h>
#include <samara/time/step_tangent.h>

#include "../states/scenes.h"

#include <cmath>
#include <random>

#include "systems.h"

using namespace samara;

namespace
{
  constexpr double tolerance = 1e-14; ///< of Newton's method

  /** The derivative of a step along @p x, by steps from states up to 3 @p epsilon away; empty if one does not converge.
   */
  std::vector<double>
  by_differences(const System              &system,
                 const State               &start,
                 const State               &end,
                 const Tableau             &tableau,
                 const double               h,
                 const std::vector<double> &x,
                 const double               epsilon)
  {
    const double        weights[] = {0.75, -0.15, 1. / 60};
    std::vector<double> result(x.size(), 0.);
    for (int j = 1; j <= 3; ++j)
      for (const int side : {1, -1})
        {
          StageIntegrator integrator(system, tableau, tolerance);
          State           state = moved(system, start, x.data(), side * j * epsilon);
          if (!integrator.step(state, h).converged)
            return {}; // too far away
          const auto there = increment(system, end, state);
          for (unsigned int i = 0; i < x.size(); ++i)
            result[i] += side * weights[j - 1] / epsilon * there[i];
        }
    return result;
  }



  /** Positions and velocities apart: those of one are far larger than those of the other where steps are short. */
  double
  worst_distance(const System &system, const std::vector<double> &a, const std::vector<double> &b)
  {
    const auto part = [&](const std::vector<double> &x, const bool velocities) {
      const auto middle = x.begin() + system.layout.of_multiplier(0);
      return velocities ? std::vector<double>(middle, x.end()) : std::vector<double>(x.begin(), middle);
    };
    return std::max(distance(part(a, false), part(b, false)), distance(part(a, true), part(b, true)));
  }



  /** A random increment that the constraints allow, as a step leaves one. */
  std::vector<double>
  random_increment(StepTangent &tangent, const double h, const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1., 1.);
    std::vector<double>                    x(tangent.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = number(generator) * (i < tangent.first_velocity() ? h : 1.);
    tangent.apply(x.data());
    return x;
  }



  /** @p bound: of the distance from the best of some differences, whose own errors are larger in stiff systems. */
  void
  compare(const System &system, const State &begin, const Tableau &tableau, const double h, const double bound)
  {
    StageIntegrator integrator(system, tableau, tolerance);
    State           state = begin;
    for (unsigned int i = 0; i < 3; ++i)
      ASSERT_TRUE(integrator.step(state, h).converged);
    State start = state;
    ASSERT_TRUE(integrator.step(state, h).converged);
    const auto                before = integrator.linearize(start);
    const std::vector<double> x      = random_increment(*before, h, 7);

    start = state;
    ASSERT_TRUE(integrator.step(state, h).converged);
    const unsigned int  n_factorizations = integrator.n_factorizations;
    const auto          tangent          = integrator.linearize(start);
    std::vector<double> image            = x;
    tangent->apply(image.data());
    EXPECT_EQ(integrator.n_factorizations, n_factorizations);
    double smallest = 1;
    for (const double epsilon : {1e-2, 1e-3, 1e-4})
      if (const auto expected = by_differences(system, start, state, tableau, h, x, epsilon); !expected.empty())
        smallest = std::min(smallest, worst_distance(system, image, expected));
    EXPECT_LT(smallest, bound);
  }
} // namespace



TEST(StepTangent, IsThatOfConvergedStepsOfAllSystems)
{
  // differences of these are no better than some 1e-10 themselves
  const auto bound_of = [](const std::string &name) {
    const auto has = [&](const char *text) { return name.find(text) != name.npos; };
    return has("EA = 1e8") || has("universal") || has("crank") ? 3e-10 : 1e-10;
  };
  for_all_systems([&bound_of](const MovingSystem &what, const System &system, const State &start) {
    for (const Tableau &tableau : {Tableau(1, 1.), Tableau(2, 0.5), Tableau(3, 0.)})
      {
        SCOPED_TRACE("s = " + std::to_string(tableau.s));
        compare(system, start, tableau, what.h, bound_of(what.name));
      }
  });
}



TEST(StepTangent, OfTensionThatStiffensTorsion)
{
  MovingSystem what = systems::flying_blade();
  what.kick         = [](const System &system, State &state) {
    systems::bend(system, state);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      state.y[6 * node + 3] += 6 * (system.model.nodes[node].x(0) - 1);
  };
  const Scene scene(what.text);
  for (const Tableau &tableau : {Tableau(1, 1.), Tableau(2, 0.5), Tableau(3, 0.)})
    compare(scene.system, start_of(what, scene.system), tableau, what.h, 1e-9);
}



TEST(StepTangent, WithStatesOfFirstOrder)
{
  for (const auto &text : {oscillator_with_lag(), top_with_controls()})
    {
      const Scene scene(text);
      State       start = scene.system.reference();
      scene.system.add_initial_velocities(start);
      Projection(scene.system).velocities(start);
      for (const Tableau &tableau : {Tableau(1, 1.), Tableau(2, 0.5), Tableau(3, 0.)})
        compare(scene.system, start, tableau, 0.02, 1e-10);
    }
}



// What keeps the energy of nonlinear springs is no part of the tangent: better none than one without it.
TEST(StepTangent, RefusesNonlinearSprings)
{
  const Scene     scene(on_a_slide("", "set Spring force = 50*slide.displacement + 2000*slide.displacement^3"));
  StageIntegrator integrator(scene.system, Tableau(2, 0.5), 1e-12);
  State           state = scene.system.reference();
  scene.system.add_initial_velocities(state);
  const State start = state;
  ASSERT_TRUE(integrator.step(state, 0.01).converged);
  EXPECT_THROW(integrator.linearize(start), NotConverged);
}
