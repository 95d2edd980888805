/*
 * Problem:   small deflections of shells, the usual obstacle course
 * Reference: tests/reference/shells/linear_benchmarks.csv: MacNeal & Harder (1985) and others; the plates are Navier's
 *            and other series.
 * Expected:  1 % with a few elements of degree 3, that is to what the list is certain. A force at a point of a shell
 *            flexible in shear has no limit: the pinched cylinder and the plates under a point load are compared at the
 *            meshes that are named. Loads are small parts of those of the list, for the shells are not linear.
 */

#include "../reference.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  /** The value of the row whose name begins like this. */
  double
  linear_benchmark(const std::string &name)
  {
    for (const auto &row : reference_rows("shells/linear_benchmarks.csv"))
      if (row.at("problem").find(name) == 0)
        return std::stod(row.at("value"));
    throw std::invalid_argument("no row " + name);
  }

  std::string
  number(const double x)
  {
    std::ostringstream out;
    out.precision(17);
    out << x;
    return out.str();
  }

  std::string
  three(const Vector3 &f)
  {
    return number(f(0)) + ", " + number(f(1)) + ", " + number(f(2));
  }

  std::string
  along_edge(const std::string &edge, const Vector3 &force, const Vector3 &moment = Vector3::Zero())
  {
    return " subsection f\n  set Type = line load\n  set Body = s\n  set Edge = " + edge +
           "\n  set Force = " + three(force) + "\n  set Moment = " + three(moment) + "\n end\n";
  }

  std::string
  at_point(const std::string &place, const Vector3 &force)
  {
    return " subsection f\n  set Type = point load\n  set At = s." + place + "\n  set Force = " + three(force) +
           "\n end\n";
  }

  std::string
  over_area(const Vector3 &force)
  {
    return " subsection f\n  set Type = area load\n  set Body = s\n  set Force = " + three(force) + "\n end\n";
  }

  const std::string plane_x = "displacement 1, rotation 2, rotation 3",
                    plane_y = "displacement 2, rotation 1, rotation 3",
                    plane_z = "displacement 3, rotation 1, rotation 2";

  /** Deflection over the load of this part of the full one, relative to the list's @p name. */
  double
  relative_deflection(const ShellModel &model, const std::string &probe, const double part, const std::string &name)
  {
    Scene scene(model.text());
    scene.equilibrium();
    const double value = scene.value(probe) / part / linear_benchmark(name);
    testing::Test::RecordProperty(name + ", elements " + model.elements, number(value));
    return value;
  }

  ShellModel
  shell_of(const std::string &patches, const std::string &elements, const double E, const double nu, const double h)
  {
    ShellModel model;
    model.patches   = patches;
    model.elements  = elements;
    model.E         = E;
    model.nu        = nu;
    model.thickness = h;
    return model;
  }
} // namespace



TEST(LinearShells, ScordelisLoRoof)
{
  // a quarter, against the value of shells flexible in shear; the list has 0.3024, too
  ShellModel model = shell_of("25*u, 25*sin(2*pi/9*v), 25*cos(2*pi/9*v)", "4, 4", 4.32e8, 0, 0.25);
  model.joints     = support("x", "s.edge u0", plane_x) + support("y", "s.edge v0", plane_y) +
                 support("wall", "s.edge u1", "displacement 2, displacement 3");
  const double part = 1e-4;
  model.loads       = over_area({0, 0, -90 * part});
  const std::string probe =
    "s.at 0 " + number(25 * std::sin(2 * M_PI / 9)) + " " + number(25 * std::cos(2 * M_PI / 9)) + ".displacement z";
  EXPECT_NEAR(-relative_deflection(model, probe, part, "Scordelis-Lo roof (refined"), 1, 5e-3);
}



// An eighth. The force at one node makes the deflection grow with each mesh, like the logarithm of the size of an
// element; the list has the series of a shell stiff in shear.
TEST(LinearShells, PinchedCylinder)
{
  std::vector<double> values;
  for (const std::string elements : {"8, 8", "12, 12"})
    {
      ShellModel model = shell_of("300*u, 300*sin(pi/2*v), 300*cos(pi/2*v)", elements, 3e6, 0.3, 3);
      model.joints     = support("x", "s.edge u0", plane_x) + support("y", "s.edge v0", plane_y) +
                     support("z", "s.edge v1", plane_z) +
                     support("wall", "s.edge u1", "displacement 2, displacement 3");
      model.loads = at_point("at 0 0 300", {0, 0, -0.25});
      values.push_back(-relative_deflection(model, "s.at 0 0 300.displacement z", 1, "Pinched cylinder"));
      EXPECT_NEAR(values.back(), 1, 0.012);
    }
  EXPECT_GT(values[1], values[0] + 1e-3) << "there is no limit";
}



TEST(LinearShells, TwistedBeam)
{
  for (const bool thin : {false, true})
    {
      ShellModel model  = shell_of("12*u, 1.1*(v-0.5)*cos(pi/2*u), 1.1*(v-0.5)*sin(pi/2*u)",
                                  thin ? "10, 1" : "6, 1",
                                  29e6,
                                  0.22,
                                  thin ? 0.0032 : 0.32);
      model.joints      = support("root", "s.edge u0", "all");
      const double part = thin ? 1e-3 : 1e-2, force = part * (thin ? 1e-6 : 1), bound = thin ? 1e-2 : 3e-3;
      model.loads = along_edge("edge u1", {0, 0, force / 1.1});
      EXPECT_NEAR(relative_deflection(model,
                                      "s.at 12 0 0.55.displacement z",
                                      part,
                                      thin ? "Twisted beam thin t=0.0032 dirZ" : "Twisted beam out"),
                  1,
                  bound);
      model.loads = along_edge("edge u1", {0, force / 1.1, 0});
      EXPECT_NEAR(relative_deflection(model,
                                      "s.at 12 0 0.55.displacement y",
                                      part,
                                      thin ? "Twisted beam thin t=0.0032 dirY" : "Twisted beam other"),
                  1,
                  bound);
    }
}



// Two arcs, of 60° and of 150° the other way, under a force across at the end; the list has a solid.
TEST(LinearShells, RaaschHook)
{
  ShellModel model  = shell_of("14*(1-cos(pi/3*u)), 14*sin(pi/3*u), 20*v; -16+46*cos(pi/3*(2.5*u-1)), "
                               "51.96152422706632+46*sin(pi/3*(2.5*u-1)), 20*v",
                              "2, 2; 4, 2",
                              3300,
                              0.35,
                              2);
  model.joints      = support("root", "s.edge u0", "all");
  const double part = 1e-3;
  model.loads       = along_edge("patch 2 edge u1", {0, 0, part / 20});
  EXPECT_NEAR(relative_deflection(model, "s.at -16 97.96152422706632 10.displacement z", part, "Raasch hook"), 1, 0.03);
}



TEST(LinearShells, SquarePlates)
{
  // a quarter of a plate of side 2 and thickness 1/1000 of it, whose shear is 1e-5 of the deflection
  const double h = 2e-3, D = 1e9 * h * h * h / 12 / 0.91, part = 1e-6;
  for (const bool clamped : {false, true})
    {
      ShellModel model = shell_of("u, v, 0", "4, 4", 1e9, 0.3, h);
      model.joints     = support("x", "s.edge u0", plane_x) + support("y", "s.edge v0", plane_y) +
                     (clamped ? support("wall", "s.edge u1, s.edge v1", "all") :
                                support("wall x", "s.edge u1", "displacement 3, rotation 1") +
                                  support("wall y", "s.edge v1", "displacement 3, rotation 2"));
      model.loads = over_area({0, 0, part * D / 16});
      EXPECT_NEAR(relative_deflection(model,
                                      "s.at 0 0 0.displacement z",
                                      part,
                                      clamped ? "Square plate clamped UDL" : "Square plate SS UDL"),
                  1,
                  1e-3);
      model.loads = at_point("at 0 0 0", {0, 0, part * D / 4 / 4});
      EXPECT_NEAR(relative_deflection(model,
                                      "s.at 0 0 0.displacement z",
                                      part,
                                      clamped ? "Square plate clamped central" : "Square plate SS central"),
                  1,
                  1e-2);
    }
}



// Straight and curved cantilevers of one row of elements, and Cook's membrane, whose corners limit the order. The clamp
// holds the contraction across, which the values of beams do not know.
TEST(LinearShells, CantileversAndMembrane)
{
  const double part     = 1e-3;
  ShellModel   straight = shell_of("6*u, 0.2*(v-0.5), 0", "6, 1", 1e7, 0.3, 0.1);
  straight.joints       = support("root", "s.edge u0", "all");
  const auto along = [&](ShellModel model, const Vector3 &force, const std::string &probe, const std::string &name) {
    model.loads = along_edge("edge u1", part * force / 0.2);
    return relative_deflection(model, probe, part, name);
  };
  EXPECT_NEAR(
    along(straight, {1, 0, 0}, "s.at 6 0.1 0.displacement x", "Straight cantilever (MacNeal-Harder) extension"),
    1,
    5e-3);
  EXPECT_NEAR(along(straight, {0, 1, 0}, "s.at 6 0.1 0.displacement y", "Straight cantilever in-plane"), 1, 0.015);
  EXPECT_NEAR(along(straight, {0, 0, 1}, "s.at 6 0.1 0.displacement z", "Straight cantilever out-of-plane"), 1, 5e-3);

  ShellModel curved = shell_of("(4.12+0.2*v)*cos(pi/2*u), (4.12+0.2*v)*sin(pi/2*u), 0", "6, 1", 1e7, 0.25, 0.1);
  curved.joints     = support("root", "s.edge u0", "all");
  EXPECT_NEAR(along(curved, {0, 1, 0}, "s.at 0 4.12 0.displacement y", "Curved beam (90deg"), 1, 0.02);
  EXPECT_NEAR(along(curved, {0, 0, 1}, "s.at 0 4.12 0.displacement z", "Curved beam out"), 1, 0.05);

  ShellModel cook = shell_of(bilinear({{{0, 0, 0}, {48, 44, 0}, {0, 44, 0}, {48, 60, 0}}}), "4, 4", 1, 1. / 3, 1);
  cook.joints     = support("root", "s.edge u0", "all");
  cook.loads      = along_edge("edge u1", {0, 1e-6 / 16, 0});
  EXPECT_NEAR(relative_deflection(cook, "s.at 48 52 0.displacement y", 1e-6, "Cook membrane"), 1, 0.01);
}
