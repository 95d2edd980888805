/*
 * Problem:   the stress across the layers of a shell, σ₃₃
 * Reference: equilibrium: the cubic of a plate under pressure, −p to 0 in tubes and spheres, 3 M/(2 R h) of a curved
 *            strip, what inertia and weight take through the thickness
 */

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "models.h"

using namespace samara;

namespace
{
  /** σ₃₃ at a point of a picture of layers. */
  struct Across
  {
    Vector3 x;      ///< [m]
    double  height; ///< above the reference surface [m]
    double  stress; ///< [Pa]
  };

  std::vector<Across>
  across(const Scene &scene, const State &state)
  {
    const Drawing       drawing = scene.system.draw(state);
    const Field        *height = nullptr, *stress = nullptr;
    std::vector<Across> result;
    for (const auto &field : drawing.fields)
      if (field.name == "height")
        height = &field;
      else if (field.name == "stress 33")
        stress = &field;
    if (height == nullptr || stress == nullptr)
      return result;
    for (unsigned int i = 0; i < drawing.samples.size(); ++i)
      if (std::isfinite((*height)(i)))
        result.push_back({drawing.samples[i].x, (*height)(i), (*stress)(i)});
    return result;
  }

  /** The largest difference to a function of the height over the thickness, from -1 to 1, among points at @p where. */
  double
  difference(
    const std::vector<Across>                 &points,
    const double                               thickness,
    const std::function<double(double)>       &expected,
    const std::function<bool(const Vector3 &)> where = [](const Vector3 &) { return true; })
  {
    double       largest = 0;
    unsigned int n       = 0;
    for (const auto &point : points)
      if (where(point.x))
        {
          largest = std::max(largest, std::abs(point.stress - expected(2 * point.height / thickness)));
          ++n;
        }
    return n > 0 ? largest : HUGE_VAL;
  }

  // by s = 2 z/h from -1 to 1: the part of the shear force that acts below, the part of the mass of an even plate
  double
  of_shear(const double s)
  {
    return (2 + 3 * s - s * s * s) / 4;
  }
  double
  of_mass(const double s)
  {
    return (1 + s) / 2;
  }

  /** Four plies of one isotropic material, E = 1e6, with the heights between them. */
  const std::string four_plies = R"(
subsection Materials
 subsection m
  set Type = isotropic
  set E = 1e6
  set Poisson ratio = 0.3
  set Density = 2
 end
end
subsection Layups
 subsection four
  set Material = m
  set Angles = 0/0/0/0
  set Ply thickness = 0.005
 end
end
)";

  std::string
  pressure(const double p)
  {
    return " subsection p\n  set Type = pressure\n  set Body = s\n  set Pressure = " + std::to_string(p) + "\n end\n";
  }

  /** A shell of this layup that pictures show. */
  std::string
  layered(const std::string &patches,
          const std::string &elements,
          const std::string &joints,
          const std::string &loads,
          const std::string &entries = "",
          const std::string &layups  = four_plies,
          const unsigned int degree  = 3)
  {
    return layups + "subsection Bodies\n subsection s\n  set Type = shell\n  set Patches = " + patches +
           "\n  set Elements = " + elements + "\n  set Degree = " + std::to_string(degree) +
           "\n  set Layup = four\n  set Layers in pictures = true\n" + entries + " end\nend\nsubsection Joints\n" +
           joints + "end\nsubsection Loads\n" + loads + "end\n";
  }

  const std::string held_at_sides = support("x", "s.edge u0, s.edge u1", "displacement 2, displacement 3, rotation 1") +
                                    support("y", "s.edge v0, s.edge v1", "displacement 1, displacement 3, rotation 2");
} // namespace



// A pressure on a face, or a load per area, of either sign: −p on the face that is pressed, 0 on the other, and the
// cubic of a plate between them, everywhere: in corners, in warped cells, of all degrees, whatever side is the top.
TEST(StressAcross, OfPlatesUnderPressure)
{
  const double      p = 1e-3, h = 0.02;
  const std::string warped = warped_square(0.05), reversed = "v, u, 0";
  const auto        on_bottom = [&](const double s) { return -p * (1 - of_shear(s)); };
  const auto        on_top    = [&](const double s) { return -p * of_shear(s); };
  const auto        area_load = [](const std::string &f, const std::string &axes) {
    return " subsection a\n  set Type = area load\n  set Body = s\n  set Force = " + f + "\n  set Axes = " + axes +
           "\n end\n";
  };
  const auto miss = [&](const std::string &patches,
                        const std::string &loads,
                        const auto        &expected,
                        const unsigned int degree,
                        const double       offset = 0.) {
    Scene scene(layered(
      patches, "2, 2", held_at_sides, loads, "  set Offset = " + std::to_string(offset) + "\n", four_plies, degree));
    auto  points = across(scene, scene.equilibrium());
    for (auto &point : points)
      point.height -= offset;
    return difference(points, h, expected) / p;
  };
  EXPECT_LT(miss("u, v, 0", pressure(p), on_bottom, 3), 1e-3);
  EXPECT_LT(miss("u, v, 0", pressure(-p), on_top, 3), 1e-3);
  EXPECT_LT(miss(reversed, pressure(p), on_bottom, 3), 1e-3);
  EXPECT_LT(miss(warped, pressure(p), on_bottom, 2), 1e-3);
  EXPECT_LT(miss(warped, pressure(p), on_bottom, 3, 0.01), 1e-3);
  EXPECT_LT(miss(warped, area_load("2e-3, 0, -1e-3", "inertial"), on_top, 3), 1e-3);
  EXPECT_LT(miss(warped, area_load("2e-3, 0, 1e-3", "body"), on_bottom, 4), 1e-3);
  // pressed from both sides
  EXPECT_LT(miss(
              "u, v, 0", pressure(p) + area_load("0, 0, -1e-3", "body"), [&](double) { return -p; }, 3),
            1e-3);
}



// Weight and inertia are spread as the mass is.
TEST(StressAcross, OfWeightAndMotion)
{
  const double h = 0.02, p = 1e-3;
  // under its own weight, which the edges carry
  Scene        heavy(layered(
    "u, v, 0", "2, 2", held_at_sides, " subsection g\n  set Type = gravity\n  set Acceleration = 0, 0, -0.01\n end\n"));
  const double weight = 2 * h * 0.01;
  EXPECT_LT(difference(across(heavy, heavy.equilibrium()),
                       h,
                       [&](double s) { return weight * (of_mass(s) - of_shear(s)); }),
            1e-3 * weight);

  // pressed, and not yet bent: all of it accelerates as a whole
  const std::string free = layered("u, v, 0", "2, 2", "", pressure(p));
  Scene             pushed(free);
  EXPECT_LT(difference(across(pushed, pushed.system.reference()), h, [&](double s) { return -p * (1 - of_mass(s)); }),
            1e-6 * p);

  // bent, and let go: it starts as the pressure pushed, the other way
  Scene bent(layered(warped_square(0.03), "2, 2", held_at_sides, pressure(p)));
  State state  = bent.equilibrium();
  state.factor = 0;
  EXPECT_LT(difference(across(bent, state), h, [&](double s) { return -p * (of_mass(s) - of_shear(s)); }), 1e-3 * p);
}



// A tube and a sphere under pressure from inside: from −p to 0 in proportion to the height.
TEST(StressAcross, OfTubesAndSpheres)
{
  const double p = 1e-2, h = 0.02;
  const auto   inside = [&](const double s) { return -p * (1 - of_mass(s)); };
  Scene        tube(layered("cos(2*pi*u), sin(2*pi*u), 0.2*v",
                     "16, 1",
                     support("a", "s.edge v0", "displacement 3, rotation 1, rotation 2, rotation 3") +
                       support("b", "s.at 0 0", "displacement 2") + support("c", "s.at 0.25 0", "displacement 1"),
                     pressure(p),
                     "  set Axis 1 = 0, 0, 1\n"));
  EXPECT_LT(difference(across(tube, tube.equilibrium()), h, inside), 0.01 * p);

  ShellModel model;
  model.degree    = 4;
  model.E         = 1e6;
  model.thickness = h;
  model.entries   = "  set Layers in pictures = true\n";
  model.joints =
    support("a", "s.at 1 0 0", "displacement 1, displacement 2, displacement 3, rotation 1, rotation 2, rotation 3");
  model.loads      = pressure(p);
  std::string text = model.text();
  text.replace(text.find("  set Patches = "),
               text.find("  set Degree") - text.find("  set Patches = "),
               "  set Grid = hyper_sphere\n  set Grid arguments = 0, 0, 0 : 1\n  set Refinements = 1\n");
  Scene sphere(text);
  EXPECT_LT(difference(across(sphere, sphere.equilibrium()), h, inside), 0.02 * p);
}



// A strip that a moment has rolled up, or that was curved before: 3 M/(2 R h) in the middle.
TEST(StressAcross, OfCurvedStrips)
{
  const double      h = 0.02, D = 1e6 * h * h * h / 12, M = D * M_PI / 2; // bent to a quarter of a circle
  const std::string clamped =
    support("root", "s.edge u0", "displacement 1, displacement 2, displacement 3, rotation 1, rotation 2, rotation 3");
  const auto end = [](const double moment) {
    return " subsection end\n  set Type = line load\n  set Body = s\n  set Edge = edge u1\n  set Moment = 0, " +
           std::to_string(moment) + ", 0\n end\n";
  };
  std::string without_poisson = four_plies;
  without_poisson.replace(without_poisson.find("0.3"), 3, "0");
  {
    Scene        scene(layered("u, 0.1*v, 0", "6, 1", clamped, end(-M), "", without_poisson));
    const double curvature = M / D;
    EXPECT_LT(difference(across(scene, scene.equilibrium()),
                         h,
                         [&](double s) { return -1.5 * M * curvature / h * (1 - s * s); }),
              0.02 * M * curvature / h);
  }
  {
    // opened
    Scene      scene(layered("sin(u), 0.1*v, cos(u)", "6, 1", clamped, end(-1e-3), "", without_poisson));
    const auto points = across(scene, scene.equilibrium());
    EXPECT_LT(difference(points, h, [&](double s) { return 1.5e-3 / h * (1 - s * s); }), 0.02e-3 / h);
  }
}



namespace
{
  /** The square in cylindrical bending about y, [0/90/0] with E₁ = 25 E₂ of these lengths, stresses and pressures. */
  std::string
  cylindrical_bending(const std::string &patches,
                      const unsigned int n,
                      const double       p,
                      const std::string &axis_1 = "1, 0, 0",
                      const double       length = 1,
                      const double       size   = 1)
  {
    std::ostringstream layups;
    layups << "subsection Materials\n subsection m\n  set Type = orthotropic\n  set E1 = " << 25 * size
           << "\n  set E2 = " << size << "\n  set G12 = " << 0.5 * size << "\n  set G23 = " << 0.2 * size
           << "\n  set nu12 = 0.25\n  set nu23 = 0.25\n  set Density = 1\n end\nend\n"
           << "subsection Layups\n subsection four\n  set Material = m\n  set Angles = 0/90/0\n  set Ply thickness = "
           << 0.05 / 3 * length << "\n end\nend\n";
    std::ostringstream load;
    load << " subsection p\n  set Type = pressure\n  set Body = s\n  set Pressure = " << p * size << "\n end\n";
    const std::string elements = std::to_string(n) + ", " + std::to_string(n);
    return layered(patches,
                   elements,
                   support("w", "s.edge u0", "displacement 1, displacement 2, displacement 3, rotation 1") +
                     support("x", "s.edge u1", "displacement 2, displacement 3, rotation 1") +
                     support("y", "s.edge v0, s.edge v1", "displacement 2, rotation 1, rotation 3"),
                   load.str(),
                   "  set Axis 1 = " + axis_1 + "\n",
                   layups.str());
  }
} // namespace



// Plies in warped cells: Q₁,₁ = −p alone, and σ₁₃ of unit Q₁ is what a unit moment pulls below; towards order p − 1.
TEST(StressAcross, OfPliesUnderPressure)
{
  const double    h = 0.05, t = h / 3, p = 1e-9, stiff = 1 / (1 - 0.25 * 0.25 / 25);
  const double    inner = 2 * std::pow(t / 2, 3) / 3, outer = 2 * std::pow(h / 2, 3) / 3 - inner;
  Eigen::Matrix2d D;
  D << 25 * outer + inner, 0.25 * (outer + inner), 0.25 * (outer + inner), outer + 25 * inner;
  const Eigen::Vector2d k    = (stiff * D).inverse() * Eigen::Vector2d(1, 0); // of a unit moment
  const double          face = stiff * (25 * k(0) + 0.25 * k(1)), core = stiff * (k(0) + 0.25 * k(1));
  const auto            exact = [&](const double s) {
    // ∫∫ of σ₁₁ from the face: 1 − this of what is below
    const double z = std::abs(s) * h / 2, edge = h / 2, c = t / 2;
    double       above   = 0; // ∫ τ dz from |z| to the face
    const auto   outside = [&](const double x) {
      return face * (edge * edge * (edge - x) - (edge * edge * edge - x * x * x) / 3) / 2;
    };
    if (z >= c)
      above = outside(z);
    else
      above = outside(c) + face * (edge * edge - c * c) / 2 * (c - z) +
              core * (c * c * (c - z) - (c * c * c - z * z * z) / 3) / 2;
    return -p * (s > 0 ? above : 1 - above);
  };
  double error[2];
  for (const unsigned int i : {0, 1})
    {
      Scene scene(cylindrical_bending(warped_square(0.05), i == 0 ? 2 : 4, p));
      error[i] = difference(across(scene, scene.equilibrium()), h, exact) / p;
    }
  EXPECT_LT(error[0], 0.02);
  EXPECT_GT(error[0] / error[1], 2.5) << error[0] << " " << error[1];
  Scene scene(cylindrical_bending("u, v, 0", 2, p));
  EXPECT_LT(difference(across(scene, scene.equilibrium()), h, exact), 1e-4 * p);
}



// The same plate turned in space, or larger and stiffer, or with its other side up, has the same stresses.
TEST(StressAcross, IsThatOfTheShellWhereverItIs)
{
  const double  p    = 1e-9;
  const Vector3 e[3] = {Vector3(1, 2, -1).normalized(), Vector3(1, 0, 1).normalized(), Vector3(1, -1, -1).normalized()};
  const auto    quadrilateral = [&](const Vector3 &x, const Vector3 &y, const double length, const bool reversed) {
    const Vector3 a = Vector3::Zero(), b = length * (x + 0.1 * y), c = length * (y - 0.2 * x),
                  d = length * (1.1 * x + 1.2 * y);
    return reversed ? bilinear({a, c, b, d}) : bilinear({a, b, c, d});
  };
  const auto stresses = [](const std::string &model) {
    Scene scene(model);
    return across(scene, scene.equilibrium());
  };
  const auto held = [](std::string model) {
    // on all sides, whatever directions they have
    const auto from = model.find(" subsection w"), to = model.find("end\nsubsection Loads");
    return model.replace(from,
                         to - from,
                         support("all",
                                 "s.edge u0, s.edge u1, s.edge v0, s.edge v1",
                                 "displacement 1, displacement 2, displacement 3"));
  };
  const auto expected =
    stresses(held(cylindrical_bending(quadrilateral(Vector3::UnitX(), Vector3::UnitY(), 1, false), 2, p)));
  std::ostringstream axis;
  axis.precision(17);
  axis << e[0](0) << ", " << e[0](1) << ", " << e[0](2);
  const auto turned =
    stresses(held(cylindrical_bending(quadrilateral(e[0], e[2].cross(e[0]), 10, false), 2, p, axis.str(), 10, 1e6)));
  ASSERT_EQ(turned.size(), expected.size());
  for (unsigned int i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(turned[i].stress / 1e6, expected[i].stress, 1e-4 * p) << i;

  // the plies are the same from below; the angle of the fibres as well
  const auto reversed =
    stresses(held(cylindrical_bending(quadrilateral(Vector3::UnitX(), Vector3::UnitY(), 1, true), 2, -p)));
  // of all cells at a place the mean
  const auto mean = [](const std::vector<Across> &points, const Vector3 &x, const double height) {
    double       sum = 0;
    unsigned int n   = 0;
    for (const auto &point : points)
      if ((point.x - x).norm() < 1e-5 && std::abs(point.height - height) < 1e-9)
        {
          sum += point.stress;
          ++n;
        }
    return n > 0 ? sum / n : HUGE_VAL;
  };
  for (const auto &point : expected)
    EXPECT_NEAR(mean(reversed, point.x, -point.height), mean(expected, point.x, point.height), 1e-4 * p);
}



// Probes: at a node and over the surface; and the indices count it.
TEST(StressAcross, InProbesAndIndices)
{
  const double p      = 1e-3;
  std::string  strong = four_plies;
  strong.replace(
    strong.find("  set Density"),
    0,
    "  set Yield stress = 1000\n  set Tensile strength = 1, 1, 1\n  set Compressive strength = 1, 1, 0.01\n  set Shear strength = 1, 1, 1\n");
  Scene scene(layered("u, v, 0", "2, 2", "", pressure(p), "", strong));
  // the reference state: nothing but the pressure
  EXPECT_NEAR(scene.value("s.at 0.5 0.5.layer 1.stress 33"), -p, 1e-9 * p);
  EXPECT_NEAR(scene.value("s.at 0.5 0.5.layer 3.stress 33"), -p / 2, 1e-9 * p);
  EXPECT_NEAR(scene.value("s.at 0.5 0.5.stress 33"), -p, 1e-9 * p);
  EXPECT_NEAR(scene.value("s.layer 2.stress 33"), -0.75 * p, 1e-9 * p);
  EXPECT_NEAR(scene.value("s.layers.max stress index"), p / 0.01, 1e-9);
  EXPECT_NEAR(scene.value("s.layer 4.max stress index"), 0.25 * p / 0.01, 1e-9);
  EXPECT_NEAR(scene.value("s.layers.von Mises stress"), p, 1e-9 * p);

  // of degree one no derivative is known, nor a node inside
  std::string linear = layered("u, v, 0", "2, 2", "", pressure(p), "", four_plies, 1);
  for (const std::string type : {"shell", "MITC4 shell"})
    {
      std::string text = linear;
      text.replace(text.find("Type = shell"), 12, "Type = " + type);
      if (type != "shell")
        text.replace(text.find("  set Degree = 1\n"), 17, "");
      Scene coarse(text);
      EXPECT_TRUE(across(coarse, coarse.system.reference()).empty()) << type;
      try
        {
          coarse.value("s.layers.stress 33");
          ADD_FAILURE() << type;
        }
      catch (const std::invalid_argument &problem)
        {
          EXPECT_NE(std::string(problem.what()).find("degree 2"), std::string::npos) << problem.what();
        }
    }
}



// Around a point where axis 1 is normal to the surface the axes turn once: between nodes they vanish, and so do
// strains.
TEST(StressAcross, AxesThatTurnInACellAreRefused)
{
  const auto sphere = [](const std::string &axis) {
    std::string text = layered("", "", "", "", "  set Axis 1 = " + axis + "\n");
    text.replace(text.find("  set Patches = "),
                 text.find("  set Degree") - text.find("  set Patches = "),
                 "  set Grid = hyper_sphere\n  set Grid arguments = 0, 0, 0 : 1\n  set Refinements = 1\n");
    return complaint_of(text);
  };
  EXPECT_NE(sphere("0.3, 0.2, 1").find("turns too far about the normal"), std::string::npos) << sphere("0.3, 0.2, 1");
  EXPECT_NE(sphere("0, 0, 1").find("normal to the surface"), std::string::npos);
}
