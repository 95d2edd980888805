// Rolling and skating: constraints on velocities alone. Closed forms of their motions, at the orders of the scheme, and
// what stays exact: energy, contact.

#include <gtest/gtest.h>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  const double g_on_slope = 9.81, radius = 0.3;

  /** A solid ball, J = 2/5 m R², on the plane through the origin normal to the axis 3, (−s, 0, c). */
  std::string
  ball_on_slope(const std::string &table,
                const std::string &joints,
                const std::string &on,
                const std::string &motion,
                double             slope)
  {
    std::ostringstream text;
    text.precision(17);
    const double s = std::sin(slope), c = std::cos(slope);
    text << model(
      table + rigid_body("ball", "set Mass = 5\n set Inertia = 0.18, 0.18, 0.18\n set Position = PLACE\n" + motion),
      joints + joint("floor",
                     "rolling ball",
                     "set Body A = " + on +
                       "\n set Body B = ball.centre\n set Radius = 0.3\n set Position = 0, 0, 0\n set Axis = AXIS\n"),
      gravity);
    std::string        result = text.str();
    std::ostringstream place, axis;
    place.precision(17);
    axis.precision(17);
    place << -radius * s << ", 1, " << radius * c;
    axis << -s << ", 0, " << c;
    result.replace(result.find("PLACE"), 5, place.str());
    result.replace(result.find("AXIS"), 4, axis.str());
    return result;
  }

  /** Errors of positions after T in n and 2n steps against a closed form: slope, and the finer one. */
  template <typename Error>
  void
  expect_orders(const System &system, const State &start, const double T, const Error &error)
  {
    for_all_members([&](const Tableau &tableau) {
      const unsigned int n = tableau.s == 1 ? (tableau.alpha > 0 ? 160 : 40) : tableau.s == 2 ? 40 : 12;
      const Record       a = run(system, start, tableau, T / n, n), b = run(system, start, tableau, 0.5 * T / n, 2 * n);
      EXPECT_EQ(a.n_steps + b.n_steps, 3 * n);
      const double coarse = error(a.state), fine = error(b.state);
      if (fine > 1e-12)
        {
          EXPECT_NEAR(std::log2(coarse / fine), tableau.alpha > 0 ? 2. * tableau.s - 1 : 2. * tableau.s, 0.15)
            << coarse << ", " << fine;
        }
      EXPECT_LT(fine, tableau.s == 1 ? 1e-1 : 1e-4);
      for (const Record &r : {a, b})
        {
          EXPECT_LT(r.balance, 1e-12);
          EXPECT_LT(r.gap, 1e-12);
        }
    });
  }
} // namespace



// 5/7 g sin of the slope; the floor holds it with 2/7 of its weight along the slope.
TEST(Nonholonomic, BallRollsDownAPlane)
{
  const double slope = 0.4;
  Scene        scene(ball_on_slope("", "", "ground", "", slope), {"Loads/weight/Acceleration = 0, 0, -9.81"});
  const State  start = start_of({"", "", 0, 0}, scene.system);
  const double T = 1, a = 5. / 7 * g_on_slope * std::sin(slope);
  const auto   error = [&](const State &end) {
    State state = end;
    Projection(scene.system).velocities(state);
    const Vector3 down(-std::cos(slope), 0, -std::sin(slope)), spin(0, -1, 0);
    return std::hypot((state.position(1) - start.position(1)).dot(down) - 0.5 * a * T * T,
                      radius * (state.triad(1) * Eigen::Map<const Vector3>(&state.y[9])).dot(spin) - a * T);
  };
  expect_orders(scene.system, start, T, error);

  scene.context.state = run(scene.system, start, Tableau(3, 1.), T / 64, 64).state;
  Projection(scene.system).report(scene.context.state);
  EXPECT_LT(error(scene.context.state), 1e-9);
  EXPECT_NEAR(std::hypot(scene.value("floor.force 1"), scene.value("floor.force 2")),
              2. / 7 * 5 * g_on_slope * std::sin(slope),
              1e-8);
  EXPECT_NEAR(scene.value("floor.force 3"), 5 * g_on_slope * std::cos(slope), 1e-8);
}



// On a turntable a ball goes round in a circle, v̇ = 2/7 Ω × v, wherever and however fast it starts.
TEST(Nonholonomic, BallOnATurntable)
{
  const std::string table = rigid_body("table", "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 0, 0, 0\n"),
                    drive = joint("drive",
                                  "revolute",
                                  "set Body A = ground\n set Body B = table.centre\n" +
                                    motion("rotation", " set Prescribed = 3*t\n"));
  // v = Ω × x + ω × R n at (0, 1): with ω = (1, 2, 4), v = (−3 + 0.6, −0.3)
  Scene         scene(ball_on_slope(table, drive, "table.centre", moving("-2.4, -0.3, 0", "1, 2, 4"), 0));
  const State   start = start_of({"", "", 0, 0}, scene.system);
  const double  T = 0.5, rate         = 2. / 7 * 3;
  const Vector3 v0(-2.4, -0.3, 0), x0 = start.position(2);
  EXPECT_LT((start.triad(2) * Eigen::Map<const Vector3>(&start.y[12]) - v0).norm(), 1e-13)
    << "they obey the constraints";
  // x0 + (sin φ v0 + (1 − cos φ) n × v0)/rate
  const Vector3 expected =
    x0 + (std::sin(rate * T) * v0 + (1 - std::cos(rate * T)) * Vector3::UnitZ().cross(v0)) / rate;
  expect_orders(scene.system, start, T, [&](const State &state) { return (state.position(2) - expected).norm(); });
}



// A skate with its centre of mass at the blade, on an inclined plane, set spinning on the spot: it does not slide down
// for ever but goes along a cycloid, x = a sin² ωt, y = a (ωt − ½ sin 2ωt) with a = g sin β/(2ω²). (Neimark & Fufaev
// 1972.)
TEST(Nonholonomic, KnifeEdgeOnAnInclinedPlane)
{
  const std::string ends = "set Body A = ground\n set Body B = skate.centre\n";
  const double      w = 3, pull = 4;
  const Scene       scene(model(rigid_body("skate",
                                     "set Mass = 3\n set Inertia = 1, 1, 0.5\n set Position = 0, 0, 0\n" +
                                       moving("0, 0, 0", "0, 0, 3")),
                          joint("ice", "planar", ends + " set Axis 1 = 1, 0, 0\n") +
                            joint("blade", "knife edge", ends + " set Axis = 0, 1, 0\n"),
                          "  subsection weight\n set Type = gravity\n set Acceleration = 4, 0, -9\n end\n"));
  const State       start = start_of({"", "", 0, 0}, scene.system);
  const double      T = 0.7, a = pull / (2 * w * w);
  const Vector3     expected(a * std::pow(std::sin(w * T), 2), a * (w * T - 0.5 * std::sin(2 * w * T)), 0);
  expect_orders(scene.system, start, T, [&](const State &state) { return (state.position(1) - expected).norm(); });
}



// The projected velocities do not slip, and those of the stages do not either.
TEST(Nonholonomic, NothingSlips)
{
  for (const MovingSystem &what : {rolling_ball(), sledge()})
    {
      SCOPED_TRACE(what.name);
      const Scene   scene(what.text);
      const System &system = scene.system;
      for_all_members([&](const Tableau &tableau) {
        State state = run(system, start_of(what, system), tableau, what.h, 10).state;
        Projection(system).velocities(state);
        std::vector<double> rates(system.layout.n_multipliers, 0.);
        system.constraint_rates(state.point(), rates.data());
        for (const unsigned int i : system.layout.nonholonomic)
          EXPECT_NEAR(rates[i], 0, 1e-12);
      });
    }
}
