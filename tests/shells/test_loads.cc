// Loads on shells against resultants and closed forms, and supports.

#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  /** Force and moment about the origin of all loads on a shell, in its reference configuration. */
  Vector6
  resultant(const Scene &scene)
  {
    const System       &system = scene.system;
    const State         state  = system.reference();
    std::vector<double> r(system.size() + 6, 0.);
    system.add_loads(state.point(), r.data());
    Vector6 sum = Vector6::Zero();
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> f(&r[6 * (node - 1)]);
        const Vector3                   force = -state.triad(node) * f.head<3>();
        sum.head<3>() += force;
        sum.tail<3>() += cross(state.position(node), force) - state.triad(node) * f.tail<3>();
      }
    return sum;
  }

  /** Half of a cylinder of radius 2 and length 3 about x, in two patches. */
  ShellModel
  half_cylinder(const std::string &loads)
  {
    ShellModel model;
    model.patches  = "3*u, 2*sin(pi/2*v), 2*cos(pi/2*v); 3*u, 2*cos(pi/2*v), -2*sin(pi/2*v)";
    model.elements = "2, 3";
    model.loads    = loads;
    return model;
  }
} // namespace



TEST(LoadsOnShells, HaveTheRightResultants)
{
  const auto load = [](const std::string &entries) { return " subsection f\n" + entries + " end\n"; };
  // force 1, 2, 3 Pa on the area 6 π, whose centre is at (1.5, 4/π, 0)
  const Vector3 f = 6 * M_PI * Vector3(1, 2, 3);
  Vector6       expected;
  expected << f, cross(Vector3(1.5, 4 / M_PI, 0), f);
  const Vector6 dead =
    resultant(Scene(half_cylinder(load("  set Type = area load\n  set Body = s\n  set Force = 1, 2, 3\n")).text()));
  EXPECT_LT((dead - expected).norm(), 1e-5 * expected.norm());

  // a pressure of 5 Pa along the normal g₁ × g₂, which is outwards, on the projected area 3 × 4: along y
  expected << 0, 60, 0, 0, 0, 90;
  const Vector6 pressure =
    resultant(Scene(half_cylinder(load("  set Type = pressure\n  set Body = s\n  set Pressure = 5\n")).text()));
  EXPECT_LT((pressure - expected).norm(), 1e-6 * expected.norm());
  const Vector6 follower = resultant(Scene(
    half_cylinder(load("  set Type = area load\n  set Body = s\n  set Force = 0, 0, 5\n  set Axes = body\n")).text()));
  EXPECT_LT((follower - expected).norm(), 1e-5 * expected.norm());

  // along the edge at x = 3, a quarter of a circle: s z per length
  const Vector6 edge = resultant(
    Scene(half_cylinder(load("  set Type = line load\n  set Body = s\n  set Edge = edge u1\n  set Force = 0, 0, 7\n"
                             "  set Variation = s\n"))
            .text()));
  EXPECT_NEAR(edge(2), 7 * M_PI * M_PI / 2, 1e-4);
  EXPECT_NEAR(edge(4), -3 * 7 * M_PI * M_PI / 2, 3e-4);
}



TEST(LoadsOnShells, PressureStretchesATube)
{
  // a closed ring of a tube of radius 1, free at both ends: hoop force p R, radius grows by p R²/(E h)
  ShellModel model;
  model.patches   = "cos(2*pi*u), sin(2*pi*u), 0.2*v";
  model.elements  = "16, 1";
  model.E         = 1e5;
  model.thickness = 0.01;
  model.joints    = support("a", "s.edge v0", "displacement 3, rotation 1, rotation 2, rotation 3") +
                 support("b", "s.at 0 0", "displacement 2") + support("c", "s.at 0.25 0", "displacement 1");
  model.loads = " subsection p\n  set Type = pressure\n  set Body = s\n  set Pressure = 1\n end\n";
  Scene scene(model.text());
  scene.equilibrium();
  // g₁ × g₂ is outwards; at (1, 0, 0) axis 1 is y, the hoop direction
  EXPECT_NEAR(scene.value("s.at 0 0.displacement x"), 1e-3 / (1 - 1e-3), 1e-6);
  EXPECT_NEAR(scene.value("s.at 0 0.force 11"), 1 + 1e-3, 5e-3);
  EXPECT_NEAR(scene.value("s.at 0 0.force 22"), 0, 5e-3);
}



TEST(LoadsOnShells, SupportsGiveReactions)
{
  ShellModel model;
  model.patches  = "u, v, 0";
  model.elements = "2, 2";
  model.E        = 1e6;
  model.joints   = support("a", "s.edge u0, s.edge u1", "displacement 1, displacement 2, displacement 3") +
                 support("b", "s.edge v0", "displacement 3");
  model.loads = " subsection f\n  set Type = area load\n  set Body = s\n  set Force = 0, 0, -0.01\n end\n";
  Scene scene(model.text());
  scene.equilibrium();
  EXPECT_NEAR(scene.value("a.force 3") + scene.value("b.force 3"), 0.01, 1e-11);
  EXPECT_NEAR(scene.value("a.force 1"), 0., 1e-9);
  // corners are held by the first support; nothing is said twice
  ModelCheck check;
  find_redundant(scene.system, check);
  EXPECT_TRUE(check.redundant_multipliers.empty());
}



TEST(LoadsOnShells, RigidEdgeTakesAMoment)
{
  // a strip of ν = 0 rolled up by a moment at its end: a circle of curvature M/EI
  ShellModel model;
  model.patches         = "10*u, v, 0";
  model.elements        = "5, 1";
  model.E               = 1.2e6;
  model.nu              = 0;
  model.thickness       = 0.1;
  model.entries         = "  set Rigid edges = root at edge u0, tip at edge u1\n";
  model.joints          = " subsection clamp\n  set Type = rigid\n  set Body A = ground\n  set Body B = s.root\n end\n";
  const double       EI = 1.2e6 * 1e-3 / 12, angle = 0.5 * M_PI;
  std::ostringstream moment;
  moment.precision(17);
  moment << -EI * angle / 10;
  model.loads = " subsection m\n  set Type = point load\n  set At = s.tip\n  set Moment = 0, " + moment.str() +
                ", 0\n  set Axes = body\n end\n";
  model.top = "subsection Static\n set Load steps = 4\nend\n";
  Scene scene(model.text());
  scene.equilibrium();
  EXPECT_NEAR(scene.value("s.tip.position x"), 10 * std::sin(angle) / angle, 1e-3);
  EXPECT_NEAR(scene.value("s.tip.position z"), 10 * (1 - std::cos(angle)) / angle, 1e-3);
  EXPECT_NEAR(scene.value("s.at 0.4 0.moment 11"), -EI * angle / 10, 1e-3 * EI); // a positive one bends d₃ towards d₁
}
