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



// An oscillator with a lag is linear: the step itself and its tangent are those of the tableau, in dense matrices.
//
//     m ẏ = −k e − c y − f z,     ż = (x − z)/T;     y, z and e on a_α, x on a
TEST(StepTangent, OfAnOscillatorWithALagIsThatOfTheTableau)
{
  const double  m = 2, k = 50, c = 3, f = 20, T = 0.15, h = 0.07;
  const Scene   scene(on_a_slide("subsection lag\n set Rate = (slide.displacement - lag)/(0.15 s)\n"
                                 " set Initial = 0.4\n end\n",
                               "set Spring = 50\n set Damper = 3\n set Force = -20 N*lag"));
  const System &system  = scene.system;
  const Layout &layout  = system.layout;
  const int     place[] = {layout.of_node(1) + 2, layout.of_coordinate(0)}, lag = layout.of_state(0);
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.5, 0.})
      {
        SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
        const Tableau         tableau(s, rho);
        const Eigen::MatrixXd one  = Eigen::MatrixXd::Identity(s, s);
        const Eigen::VectorXd ones = Eigen::VectorXd::Ones(s), w_b = tableau.w.transpose() * tableau.b;
        Eigen::MatrixXd       J(2 * s, 2 * s), right(2 * s, 3); // of x, y, z at the start
        J << m / h * tableau.w + k * h * tableau.a_alpha + c * one, f * one, -h / T * tableau.a,
          tableau.w / h + one / T;
        right << -k * ones, m / h * tableau.w * ones, 0 * ones, ones / T, 0 * ones, tableau.w * ones / h;
        const Eigen::MatrixXd stages = J.fullPivLu().solve(right);
        Eigen::Matrix3d       map    = Eigen::Matrix3d::Identity();
        map.row(0) += h * tableau.b.transpose() * stages.topRows(s);
        map.row(1) *= 1 - w_b.sum();
        map.row(1) += w_b.transpose() * stages.topRows(s);
        map.row(2) *= 1 - w_b.sum();
        map.row(2) += w_b.transpose() * stages.bottomRows(s);

        StageIntegrator integrator(system, tableau, tolerance);
        State           start = system.reference();
        system.add_initial_velocities(start);
        Projection(system).velocities(start);
        State end = start;
        ASSERT_TRUE(integrator.step(end, h).converged);
        const Eigen::Vector3d expected = map * Eigen::Vector3d(0, 1, 0.4);
        EXPECT_NEAR(end.coordinates[0], expected(0), 1e-13);
        EXPECT_NEAR(end.y[6 + 2], expected(1), 1e-12);
        EXPECT_NEAR(end.states[0], expected(2), 1e-13);

        const auto tangent = integrator.linearize(start);
        const int  v       = tangent->first_velocity();
        for (unsigned int j = 0; j < 3; ++j)
          {
            std::vector<double> x(tangent->size(), 0.);
            for (const int i : place)
              (j == 0 ? x[i] : x[v + i]) = j < 2;
            x[lag] = j == 2;
            tangent->apply(x.data());
            for (const int i : place)
              {
                EXPECT_NEAR(x[i], map(0, j), 1e-12);
                EXPECT_NEAR(x[v + i], map(1, j), 1e-12 * map.row(1).cwiseAbs().maxCoeff());
              }
            EXPECT_NEAR(x[lag], map(2, j), 1e-12);
          }
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
