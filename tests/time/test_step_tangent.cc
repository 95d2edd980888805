/*
 * Problem:   the tangent of a step, ∂x_{n+1}/∂x_n
 * Reference: central differences of sixth order of converged steps
 */

#include <samara/base/dense.h>
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
    for (const double epsilon : {1e-2, 1e-3, 3e-4, 1e-4})
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
        const Eigen::MatrixXd stages = FullLu(J).solve(right);
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



// What keeps the energy of nonlinear springs is a part of the step, and of its tangent.
TEST(StepTangent, OfNonlinearSprings)
{
  const std::string hardening = "set Spring force = 50*slide.displacement + 2000*slide.displacement^3",
                    sinking   = "set Damper = 3\n set Spring force = 3*sinh(4*slide.displacement) + "
                                "20*tanh(slide.displacement/0.05)";
  for (const auto &spring : {hardening, sinking})
    {
      const Scene scene(on_a_slide("", spring));
      State       start = scene.system.reference();
      scene.system.add_initial_velocities(start);
      Projection(scene.system).velocities(start);
      for (const Tableau &tableau : {Tableau(1, 1.), Tableau(2, 0.5), Tableau(3, 0.)})
        compare(scene.system, start, tableau, 0.03, 1e-10);
    }
}



namespace
{
  /**
   * A step of m ẏ = −g(u) with g = k₁u + k₂u² + k₃u³ on the tableau, with the rule that keeps the energy, and its
   * tangent in dense matrices: rows u_end, y_end, by u and y at the start. Written for this spring alone, in complex
   * numbers.
   */
  struct DenseSpringStep
  {
    using Complex = std::complex<double>;
    const double  m, k_1, k_2, k_3, h;
    const Tableau tableau;

    /** The residuals of the stages with the velocities @p y; the end. */
    Eigen::VectorXcd
    residual(const Complex u, const Complex y_start, const Eigen::VectorXcd &y, Eigen::Vector2cd &end) const
    {
      const auto             g     = [&](const Complex d) { return d * (k_1 + d * (k_2 + d * k_3)); };
      const auto             U     = [&](const Complex d) { return d * d * (k_1 / 2 + d * (k_2 / 3 + d * k_3 / 4.)); };
      const auto             s     = tableau.s;
      const Eigen::VectorXcd x     = Eigen::VectorXcd::Constant(s, u) + h * (tableau.a * y);
      const Complex          u_end = u + h * (tableau.b.transpose() * y)(0);
      Complex                squares = 0, power = (U(u_end) - U(u)) / h; // F_m Σ b ḋ = (U_f − U_i)/h
      Eigen::VectorXcd       forces(s);
      for (unsigned int k = 0; k < s; ++k)
        {
          forces(k) = g(x(k));
          power -= tableau.b(k) * forces(k) * y(k);
          squares += tableau.b(k) * y(k) * y(k);
        }
      const Eigen::VectorXcd change = y - Eigen::VectorXcd::Constant(s, y_start);
      end << u_end, y_start + (tableau.b.transpose() * (tableau.w * change))(0);
      return m / h * (tableau.w * change) + forces + power / squares * y;
    }

    Eigen::Matrix2d
    tangent(const double u, const double y_start) const
    {
      constexpr double epsilon = 1e-30;
      const auto       s       = tableau.s;
      Eigen::VectorXcd y       = Eigen::VectorXcd::Constant(s, y_start);
      Eigen::Vector2cd end;
      Eigen::MatrixXd  J(s, s), right(s, 2), of_end(2, s), direct(2, 2);
      for (unsigned int iteration = 0; iteration < 12; ++iteration)
        {
          const Eigen::VectorXd r = residual(u, y_start, y, end).real();
          for (unsigned int j = 0; j < s; ++j)
            {
              Eigen::VectorXcd z = y;
              z(j) += Complex(0, epsilon);
              J.col(j)      = residual(u, y_start, z, end).imag() / epsilon;
              of_end.col(j) = end.imag() / epsilon;
            }
          y -= FullLu(J).solve(r).cast<Complex>().eval();
        }
      for (unsigned int j = 0; j < 2; ++j)
        {
          right.col(j) =
            residual(Complex(u, j == 0 ? epsilon : 0), Complex(y_start, j == 1 ? epsilon : 0), y, end).imag() / epsilon;
          direct.col(j) = end.imag() / epsilon;
        }
      return direct - of_end * FullLu(J).solve(right);
    }
  };
} // namespace



// Against the step written out for one mass in dense matrices, 2 kg on 50 x + 2000 x³ pulled by 30 N: swinging, and so
// near its equilibrium x₀ that no force changes by what double precision shows. There τ ḋ is 0/0 but for round-off.
TEST(StepTangent, OfANonlinearSpringIsThatOfTheTableau)
{
  const double  m = 2, h = 0.03, pull = 30;
  const Scene   scene(on_a_slide("",
                               "set Spring force = 50*slide.displacement + 2000*slide.displacement^3\n set Force = " +
                                 std::to_string(pull)));
  const System &system  = scene.system;
  const int     place[] = {system.layout.of_node(1) + 2, system.layout.of_coordinate(0)};
  double        x_0     = 0.2;
  for (unsigned int i = 0; i < 30; ++i)
    x_0 -= (50 * x_0 + 2000 * x_0 * x_0 * x_0 - pull) / (50 + 6000 * x_0 * x_0);
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.5, 0.})
      for (const double speed : {1., 1e-12})
        {
          SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho) + ", " + std::to_string(speed) +
                       " m/s");
          const DenseSpringStep dense{m, 50 + 6000 * x_0 * x_0, 6000 * x_0, 2000, h, Tableau(s, rho)};
          StageIntegrator       integrator(system, dense.tableau, tolerance);
          State                 start = system.reference();
          start.q[12 + 2] = start.coordinates[0] = x_0;
          start.y[6 + 2] = start.rates[0] = speed;
          State end                       = start;
          ASSERT_TRUE(integrator.step(end, h).converged);
          const auto            tangent  = integrator.linearize(start);
          const int             v        = tangent->first_velocity();
          const Eigen::Matrix2d expected = dense.tangent(0, speed);
          for (unsigned int j = 0; j < 2; ++j)
            {
              std::vector<double> x(tangent->size(), 0.);
              for (const int i : place)
                (j == 0 ? x[i] : x[v + i]) = 1;
              tangent->apply(x.data());
              for (const int i : place)
                {
                  EXPECT_NEAR(x[i], expected(0, j), 1e-11 * expected.row(0).cwiseAbs().maxCoeff());
                  EXPECT_NEAR(x[v + i], expected(1, j), 1e-11 * expected.row(1).cwiseAbs().maxCoeff());
                }
            }
        }
}
