// What holds of one shell by itself: rigid motions, patch tests, frequencies and thin limit, and what is refused.

#include <samara/cosserat/shell.h>

#include <samara/base/dense.h>

#include "../reference.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  Eigen::MatrixXd
  stiffness(const Scene &scene)
  {
    SparseMatrix K(scene.system.layout.pattern);
    scene.system.tangent(scene.system.reference(), K);
    return K.dense();
  }

  /** The patch of MacNeal and Harder (1985): five quadrilaterals in a rectangle of 0.24 by 0.12. */
  std::string
  five_quadrilaterals()
  {
    const Vector3 outer[4] = {{0, 0, 0}, {.24, 0, 0}, {.24, .12, 0}, {0, .12, 0}},
                  inner[4] = {{.04, .02, 0}, {.18, .03, 0}, {.16, .08, 0}, {.08, .08, 0}};
    std::string all        = bilinear({{inner[0], inner[1], inner[3], inner[2]}});
    for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int j = (i + 1) % 4;
        all += "; " + bilinear({{outer[i], outer[j], inner[i], inner[j]}});
      }
    return all;
  }

  /** Forces at inner nodes of a linear displacement, relative to the largest force. */
  double
  force_inside(const std::string                                             &patches,
               const unsigned int                                             degree,
               const std::function<Vector6(const Vector3 &, const double &)> &displacement,
               const std::function<bool(const Vector3 &)>                    &is_inside)
  {
    ShellModel model;
    model.patches   = patches;
    model.elements  = "1, 1";
    model.degree    = degree;
    model.E         = 1e6;
    model.nu        = 0.25;
    model.thickness = 1e-3;
    const Scene     scene(model.text());
    const auto     &nodes = scene.input.model.nodes;
    Eigen::VectorXd z(scene.system.size());
    for (unsigned int i = 1; i < nodes.size(); ++i)
      {
        const Vector6 inertial = displacement(nodes[i].x, model.thickness);
        z.segment<6>(6 * (i - 1)) << nodes[i].D.transpose() * inertial.head<3>(),
          nodes[i].D.transpose() * inertial.tail<3>();
      }
    const Eigen::VectorXd f       = stiffness(scene) * z;
    double                largest = 0;
    for (unsigned int i = 1; i < nodes.size(); ++i)
      if (is_inside(nodes[i].x))
        largest = std::max(largest, f.segment<6>(6 * (i - 1)).cwiseAbs().maxCoeff());
    return largest / f.cwiseAbs().maxCoeff();
  }

  bool
  inside_rectangle(const Vector3 &x)
  {
    return x(0) > 1e-9 && x(0) < .24 - 1e-9 && x(1) > 1e-9 && x(1) < .12 - 1e-9;
  }
} // namespace



TEST(Shell, HasSixZeroModesOnAWarpedMesh)
{
  for (const unsigned int p : {1, 2, 3, 4})
    for (const bool curved : {false, true})
      {
        ShellModel model;
        model.degree    = p;
        model.elements  = "2, 2";
        model.thickness = 0.05;
        model.patches   = p == 1 ? (curved ? "cos(u), sin(u), 0.3*u + v" : "u + 0.3*v, v, 0.2*u") :
                          curved ? "(2 + 0.1*u*v)*sin(u + 0.1*sin(3*v)), v + 0.15*u*u, 2*cos(u)" :
                                   warped_square(0.05);
        const Eigen::VectorXd values = symmetric_eigenvalues(stiffness(Scene(model.text())));
        EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-13 * values.maxCoeff()) << "p = " << p;
        EXPECT_GT(values(6), 1e-8 * values.maxCoeff()) << "p = " << p;
      }
}



TEST(Shell, PassesThePatchTests)
{
  const auto membrane = [](const Vector3 &x, const double) {
    Vector6 z = Vector6::Zero();
    z(0)      = 1e-3 * (x(0) + x(1) / 2);
    z(1)      = 1e-3 * (x(1) + x(0) / 2);
    return z;
  };
  const auto bending = [](const Vector3 &x, const double) {
    Vector6 z = Vector6::Zero();
    z(2)      = 1e-3 * (x(0) * x(0) + x(0) * x(1) + x(1) * x(1)) / 2;
    z(3)      = 1e-3 * (x(0) / 2 + x(1));  // w,y
    z(4)      = -1e-3 * (x(0) + x(1) / 2); // −w,x
    return z;
  };
  for (const unsigned int p : {2, 3, 4})
    {
      EXPECT_LT(force_inside(five_quadrilaterals(), p, membrane, inside_rectangle), 1e-12) << "p = " << p;
      EXPECT_LT(force_inside(five_quadrilaterals(), p, bending, inside_rectangle), 4e-8) << "p = " << p;
    }
}



namespace
{
  /** Relative errors of the frequencies (1, 1), (1, 2), (2, 2) of a plate on hard simple supports. */
  std::vector<double>
  errors_of_frequencies(const unsigned int degree, const unsigned int n, const std::string &patches = "u, v, 0")
  {
    ShellModel model;
    model.patches  = patches;
    model.degree   = degree;
    model.elements = std::to_string(n) + ", " + std::to_string(n);
    model.joints = support("x", "s.edge u0, s.edge u1", "displacement 1, displacement 2, displacement 3, rotation 1") +
                   support("y", "s.edge v0, s.edge v1", "displacement 1, displacement 2, displacement 3, rotation 2");
    model.top = "subsection Modal\n set Modes = 4\nend\n";
    Scene       scene(model.text());
    const auto &modes = scene.modes();
    const auto  rows  = reference_rows("shells/mindlin_plate_frequencies.csv");
    const auto  error = [&](const unsigned int mode, const unsigned int row) {
      return std::abs(modes.at(mode).frequency() / std::stod(rows.at(row).at("omega")) - 1);
    };
    return {error(0, 0), error(1, 1), error(3, 2)};
  }
} // namespace



// Errors of the three modes on two regular meshes: orders found 3.5 to 4.0, 5.9 to 7.2, 7.5 to 11.6 for degree 2, 3, 4.
// Errors below 1e-9 have round-off.
TEST(Shell, FrequenciesHaveTheOrderOfTwiceTheDegree)
{
  const std::vector<std::array<unsigned int, 3>> meshes = {{{2, 4, 8}}, {{3, 3, 6}}, {{4, 2, 4}}};
  for (const auto &[p, n, fine] : meshes)
    {
      const auto a = errors_of_frequencies(p, n), b = errors_of_frequencies(p, fine);
      for (unsigned int i = 0; i < 3; ++i)
        {
          if (b[i] > 1e-9)
            {
              EXPECT_GT(std::log2(a[i] / b[i]), 2 * p - 0.6) << "p = " << p << ", mode " << i;
            }
        }
    }
}



TEST(Shell, HasTheFrequenciesOfMindlinsPlate)
{
  // degree, elements a side, errors found; the prototype's are 6e-5, 3e-3, 7e-4 and 5e-6, 2e-4, 7e-5 for degree 2
  const auto coarse = errors_of_frequencies(2, 4), fine = errors_of_frequencies(2, 8);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_GT(std::log2(coarse[i] / fine[i]), 3.3) << coarse[i] << ' ' << fine[i];
  EXPECT_LT(fine[1], 3e-4);
  const auto cubic = errors_of_frequencies(3, 4);
  EXPECT_LT(cubic[0], 1e-7);
  EXPECT_LT(cubic[1], 1e-4);
  EXPECT_LT(cubic[2], 1e-5);
  const auto quartic = errors_of_frequencies(4, 2);
  EXPECT_LT(quartic[0], 3e-7);
  EXPECT_LT(quartic[1], 2e-4);
  EXPECT_LT(quartic[2], 6e-4);
  for (const double error : errors_of_frequencies(4, 3, warped_square(0.03)))
    EXPECT_LT(error, 3e-3);
}



namespace
{
  /** u (h/0.04)³ of the pinched hemisphere with a hole under a small load. */
  double
  hemisphere_deflection(const unsigned int degree, const unsigned int n, const double thickness)
  {
    ShellModel model;
    model.patches   = hemisphere;
    model.degree    = degree;
    model.elements  = std::to_string(n) + ", " + std::to_string(n);
    model.E         = 6.825e7;
    model.thickness = thickness;
    model.entries   = "  set Frames = A at 10 0 0, B at 0 10 0\n";
    model.joints    = support("y", "s.edge u0", "displacement 2, rotation 1, rotation 3") +
                   support("x", "s.edge u1", "displacement 1, rotation 2, rotation 3") +
                   support("z", "s.A", "displacement 3");
    const double       scale = std::pow(thickness / 0.04, 3), force = 1e-4 * scale;
    std::ostringstream f;
    f << force;
    model.loads = " subsection a\n  set Type = point load\n  set At = s.A\n  set Force = " + f.str() +
                  ", 0, 0\n end\n subsection b\n  set Type = point load\n  set At = s.B\n  set Force = 0, -" + f.str() +
                  ", 0\n end\n";
    Scene scene(model.text());
    scene.equilibrium();
    return 0.5 * (scene.value("s.A.displacement x") - scene.value("s.B.displacement y")) / 1e-4;
  }
} // namespace



TEST(Shell, DoesNotLockInTheThinLimit)
{
  EXPECT_NEAR(hemisphere_deflection(3, 8, 1e-3), 0.0903, 1e-4); // h/R = 1e-4; the limit is .0909
  EXPECT_NEAR(hemisphere_deflection(3, 8, 0.04), 0.0935, 1e-4);
  EXPECT_NEAR(hemisphere_deflection(4, 6, 1e-3), 0.0907, 1e-4);
}



TEST(Shell, SaysWhatIsWrong)
{
  const auto complaint = [](const std::string &patches, const std::string &entries = "", const unsigned int p = 2) {
    ShellModel model;
    model.patches  = patches;
    model.elements = "2, 2";
    model.degree   = p;
    model.entries  = entries;
    return complaint_of(model.text());
  };
  const auto expect = [](const std::string &complaint, const std::string &part) {
    EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
  };
  EXPECT_EQ(complaint("u, v, 0"), "");
  expect(complaint("u, v*u, 0"), "two nodes at one place");
  expect(complaint("u, v, 1/(u-0.5)"), "not finite");
  expect(complaint("(u-0.4)^2, v, 0"), "not convex");
  expect(complaint("u + u*v, v, 0", "", 1), "no parallelogram");
  ShellModel moebius;
  moebius.patches  = "(2+(v-.5)*cos(pi*u))*cos(2*pi*u), (2+(v-.5)*cos(pi*u))*sin(2*pi*u), (v-.5)*sin(pi*u)";
  moebius.elements = "8, 2";
  expect(complaint_of(moebius.text()), "one side only");
  expect(complaint("u, v, 0; 1+u, 2*v, 0"), "without sharing a node");
  EXPECT_EQ(complaint("u, v, 0; 1+u, 2*v, 0", "  set Merge = false\n"), "");
  expect(complaint("u, v, 0", "  set Frames = a at 0.3 0.3\n"), "the nearest is at");
  expect(complaint("u, v, 0", "  set Frames = a at 0.5\n"), "<at u v> or <at x y z>");
  expect(complaint("u, v, 0", "  set Rigid edges = root at edge u2\n"), "no edge <edge u2>");
  expect(complaint("u, v, 0", "  set Axis 1 = 0, 0, 1\n"), "normal to the surface");
  expect(complaint("u, v, 0", "  set Grid = hyper_sphere\n"), "either <Patches>, or a <Grid>");
}



TEST(Shell, TakesALayup)
{
  // a strip of one ply along x, clamped: what the same strip of isotropic material with E₁ and ν = 0 does
  ShellModel model;
  model.patches  = "u, 0.1*v, 0";
  model.elements = "2, 1";
  model.joints   = support("root", "s.edge u0", "all");
  model.loads    = " subsection f\n  set Type = line load\n  set Body = s\n  set Edge = edge u1\n"
                   "  set Force = 0, 0, 0.01\n end\n";
  model.E        = 1e7;
  model.nu       = 0;
  const auto tip = [](const std::string &text) {
    Scene scene(text);
    scene.equilibrium();
    return scene.value("s.at 1 0.displacement z");
  };
  const double      isotropic = tip(model.text());
  const std::string materials = "subsection Materials\n subsection m\n  set Type = orthotropic\n  set E1 = 1e7\n"
                                "  set E2 = 1e6\n  set nu12 = 0\n  set G12 = 5e6\n end\nend\n"
                                "subsection Layups\n subsection l\n  set Plies = m, ANGLE, 0.01\n end\nend\n";
  const auto        laminated = [&](const std::string &angle, const std::string &axis) {
    std::string text = model.text();
    for (const std::string entry : {"E", "Poisson ratio", "Thickness", "Density"})
      {
        const auto at = text.find("  set " + entry + " =");
        text.erase(at, text.find('\n', at) + 1 - at);
      }
    text.insert(text.find("  set Degree"), "  set Layup = l\n  set Axis 1 = " + axis + "\n");
    std::string all = materials;
    all.replace(all.find("ANGLE"), 5, angle);
    return tip(all + text);
  };
  EXPECT_NEAR(laminated("0", "1, 0, 0"), isotropic, 1e-6 * isotropic);
  EXPECT_NEAR(laminated("-90", "0, 1, 0"), isotropic, 1e-6 * isotropic);
  EXPECT_NEAR(laminated("90", "1, 0, 0"), 10 * isotropic, 0.02 * isotropic);
  model.entries = "  set Layup = l\n";
  EXPECT_NE(complaint_of(materials + model.text()).find("has a <Layup>"), std::string::npos);
}



namespace
{
  std::string
  free_steel_shell(const std::string &geometry)
  {
    return "set Analyses = modal\nsubsection Bodies\n subsection shell\n set Type = shell\n set E = 2e11\n"
           " set Poisson ratio = 0.3\n set Density = 7800\n set Thickness = 0.05\n" +
           geometry + " end\nend\nsubsection Modal\n set Modes = 11\nend\n";
  }
} // namespace



// Curved shells that nothing holds have six free motions and no others near zero; the next five of a sphere have one
// frequency, but for a little bending, ρω²R²(1−ν²)/E = ½ (A − √(A² − 4 (1−ν²)(λ − 2))), A = λ + 1 + 3ν, λ = 6 (Baker,
// JASA 33, 1961: membrane).
TEST(Shell, HasSixFreeMotionsOnCurvedMeshes)
{
  const double A = 6 + 1 + 0.9, square = 0.5 * (A - std::sqrt(A * A - 4 * 0.91 * 4)),
               omega = std::sqrt(square * 2e11 / 7800 / 0.91);
  Scene sphere(free_steel_shell(" set Grid = hyper_sphere\n set Grid arguments = 0, 0, 0 : 1\n set Refinements = 1\n"));
  const auto modes = sphere.modes();
  ASSERT_EQ(modes.size(), 11u);
  for (unsigned int i = 0; i < modes.size(); ++i)
    if (i < 6)
      EXPECT_TRUE(modes[i].is_free()) << i;
    else
      EXPECT_NEAR(modes[i].frequency(), omega, 3e-3 * omega) << i;

  for (const std::string cap : {"cos(pi/2*u), sin(pi/2*u), v", "cos(pi/2*u)*cos(v), sin(pi/2*u)*cos(v), sin(v)"})
    {
      Scene      scene(free_steel_shell(" set Patches = " + cap + "\n set Elements = 3, 3\n"));
      const auto found = scene.modes();
      for (unsigned int i = 0; i < found.size(); ++i)
        EXPECT_EQ(found[i].is_free(), i < 6) << cap << ": " << i;
      EXPECT_GT(found.at(6).frequency(), 100) << cap;
    }
}
