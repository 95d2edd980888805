// What a step does to a linear oscillator, assembled from a body on a slide with a spring, over 20 values of hω.
//
// Reference: the stability function R(z) = 1 + z bᵀ (I − z a_α)⁻¹ 1 of the tableau, and the same in closed form,
// between the diagonal Padé approximation of exp(z) for ρ∞ = 1 and the one below the diagonal for ρ∞ = 0, in numerator
// and denominator linear in α. With a damper the same of the matrix of the system.

#include <samara/base/dense.h>

#include <gtest/gtest.h>

#include "systems.h"

using namespace samara;

namespace
{
  const double mass = 2, omega = 10;

  /** Small, as the iteration passes by rotations, and steps are as long as 200 s; round-off is 1e-12 of it. */
  const double amplitude = 1e-4;

  /** The slide is along no axis of the body, and the centre of mass is off the node. */
  std::string
  damped_oscillator(const std::string &damper)
  {
    using namespace systems;
    return model(
      rigid_body("a", "set Mass = 2\n set Centre of mass = 0.3, 0.1, 0.2\n set Inertia = 1, 2, 2.5\n"),
      joint("slide",
            "prismatic",
            "set Body A = ground\n set Body B = a.centre\n set Position = 0.4, 0.3, 0.2\n set Axis = 1, 2, 2\n" +
              motion("displacement", spring("200", damper))));
  }

  /** Displaced by x, with the velocity v. */
  State
  displaced_and_moving(const System &system, const double x, const double v)
  {
    const Vector3 axis  = Vector3(1, 2, 2) / 3.;
    State         state = system.reference();
    Eigen::Map<Vector3>(&state.q[12]) += x * axis;
    Eigen::Map<Vector3>(&state.y[6]) = v * axis;
    state.coordinates[0]             = x;
    state.rates[0]                   = v;
    system.stresses(state, state.stress);
    return state;
  }

  /** Of one step, from (x, v) to (x, v). */
  Eigen::Matrix2d
  map_of_a_step(const System &system, const Tableau &tableau, const double h)
  {
    Eigen::Matrix2d map;
    for (const int j : {0, 1})
      {
        StageIntegrator integrator(system, tableau, 1e-14);
        State           state = displaced_and_moving(system, j == 0 ? amplitude : 0., j == 1 ? amplitude : 0.);
        EXPECT_TRUE(integrator.step(state, h).converged);
        map.col(j) << state.coordinates[0] / amplitude, state.rates[0] / amplitude;
        // the body goes with it
        const State expected = displaced_and_moving(system, state.coordinates[0], state.rates[0]);
        EXPECT_LT(distance(state.q, expected.q), 1e-12);
      }
    return map;
  }

  /** 1 + z bᵀ (I − z a_α)⁻¹ 1 of a matrix z. */
  Eigen::Matrix2d
  stability_function(const Tableau &t, const Eigen::Matrix2d &z)
  {
    const int       n = 2 * t.s;
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n), ones(n, 2), b(2, n);
    for (unsigned int k = 0; k < t.s; ++k)
      {
        for (unsigned int l = 0; l < t.s; ++l)
          A.block<2, 2>(2 * k, 2 * l) -= t.a_alpha(k, l) * z;
        ones.middleRows<2>(2 * k) = Eigen::Matrix2d::Identity();
        b.middleCols<2>(2 * k)    = t.b(k) * z;
      }
    return Eigen::Matrix2d::Identity() + b * solution(A, ones);
  }

  std::complex<double>
  pade(const Tableau &t, const std::complex<double> z)
  {
    using Polynomials = std::array<std::complex<double>, 2>; // for α = 0 and 1
    Polynomials N, D;
    switch (t.s)
      {
        case 1:
          N = {1. + z / 2., 1.};
          D = {1. - z / 2., 1. - z};
          break;
        case 2:
          N = {1. + z / 2. + z * z / 12., 1. + z / 3.};
          D = {1. - z / 2. + z * z / 12., 1. - 2. * z / 3. + z * z / 6.};
          break;
        default:
          N = {1. + z / 2. + z * z / 10. + z * z * z / 120., 1. + 2. * z / 5. + z * z / 20.};
          D = {1. - z / 2. + z * z / 10. - z * z * z / 120., 1. - 3. * z / 5. + 3. * z * z / 20. - z * z * z / 60.};
      }
    return ((1 - t.alpha) * N[0] + t.alpha * N[1]) / ((1 - t.alpha) * D[0] + t.alpha * D[1]);
  }

  /** hω from 0.05 to 2e3. */
  std::vector<double>
  twenty_values()
  {
    std::vector<double> values;
    for (int i = 0; i < 20; ++i)
      values.push_back(0.05 * std::pow(4e4, i / 19.));
    return values;
  }
} // namespace



TEST(Amplification, IsThePadeFamily)
{
  const Scene scene(damped_oscillator("0"));
  for_all_members([&](const Tableau &tableau) {
    for (const double z : twenty_values())
      {
        SCOPED_TRACE("h omega = " + std::to_string(z));
        // w = ωx − iv has the rate iωw
        const Eigen::Matrix2d      map      = map_of_a_step(scene.system, tableau, z / omega);
        const std::complex<double> expected = pade(tableau, {0, z});
        EXPECT_NEAR(map(0, 0), expected.real(), 1e-10);
        EXPECT_NEAR(map(0, 1) * omega, expected.imag(), 1e-10);
        EXPECT_NEAR(map(1, 0) / omega, -expected.imag(), 1e-10);
        EXPECT_NEAR(map(1, 1), expected.real(), 1e-10);
        EXPECT_NEAR(std::sqrt(map.determinant()), std::abs(expected), 1e-10);

        Eigen::Matrix2d A;
        A << 0, 1, -omega * omega, 0;
        EXPECT_LT((map - stability_function(tableau, z / omega * A)).norm(), 1e-10 * omega);
      }
    // at infinite frequency
    EXPECT_NEAR(std::abs(pade(tableau, {0, 1e9})), (1 - tableau.alpha) / (1 + tableau.alpha), 1e-8);
  });
}



// Damping ratios of 0.2 and 2.
TEST(Amplification, OfADampedOscillator)
{
  for (const double c : {8., 80.})
    {
      const Scene     scene(damped_oscillator(std::to_string(c)));
      Eigen::Matrix2d A;
      A << 0, 1, -omega * omega, -c / mass;
      for_all_members([&](const Tableau &tableau) {
        for (const double z : twenty_values())
          {
            SCOPED_TRACE("h omega = " + std::to_string(z));
            const double h = z / omega;
            EXPECT_LT((map_of_a_step(scene.system, tableau, h) - stability_function(tableau, h * A)).norm(),
                      1e-10 * omega);
          }
      });
    }
}
