// Walls that share nodes at corners: a closed box.

#include <samara/cosserat/section.h>

#include "../reference.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  constexpr double length = 10, width = 1, height = 0.5;
  constexpr double small = 1e-3; ///< of a unit load: at that the twist has 1e-4 more of second order

  /** Four walls between the mid-lines' corners, closed about x; elements along, on webs and flanges. */
  ShellModel
  box(const unsigned int degree, const unsigned int along, const unsigned int web)
  {
    const double       corners[4][2] = {{-width / 2, -height / 2},
                                        {width / 2, -height / 2},
                                        {width / 2, height / 2},
                                        {-width / 2, height / 2}};
    ShellModel         model;
    std::ostringstream patches, elements;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const auto &a = corners[i], &b = corners[(i + 1) % 4];
        patches << (i > 0 ? "; " : "") << length << "*u, " << a[0] << " + v*(" << b[0] - a[0] << "), " << a[1]
                << " + v*(" << b[1] - a[1] << ")";
        elements << (i > 0 ? "; " : "") << along << ", " << (i % 2 == 1 ? web : 2 * web);
      }
    model.patches   = patches.str();
    model.elements  = elements.str();
    model.degree    = degree;
    model.E         = 1e7;
    model.thickness = 0.02;
    model.joints    = support("root", "s.edge u0, s.patch 2 edge u0, s.patch 3 edge u0, s.patch 4 edge u0", "all");
    return model;
  }

  /** A line load along the tip of wall @p i. */
  std::string
  at_tip(const unsigned int i, const Vector3 &force)
  {
    std::ostringstream out;
    out << " subsection wall " << i << "\n  set Type = line load\n  set Body = s\n  set Edge = "
        << (i > 0 ? "patch " + std::to_string(i + 1) + " " : "") << "edge u1\n  set Force = " << small * force(0)
        << ", " << small * force(1) << ", " << small * force(2) << "\n end\n";
    return out.str();
  }
} // namespace



// The reference is the same mesh in a program whose K₁₃ and K₂₃ have β A₆₆ h²/12 alone: what they have here, so that walls
// may be pulled, makes bending in the plane of walls of a single cell of degree 2 stiffer by 0.04 %.
TEST(ShellWalls, ClosedBoxTwistsAndBendsAsItsSection)
{
  const auto   row   = reference_rows("shells/thin_box_shell.csv").at(0);
  ShellModel   model = box(2, 16, 1);
  const double q     = 1 / (2 * width * height); // shear flow of a unit torque
  ShellModel   bent  = model;
  model.loads        = at_tip(0, {0, q, 0}) + at_tip(1, {0, 0, q}) + at_tip(2, {0, -q, 0}) + at_tip(3, {0, 0, -q});
  Scene twisted(model.text());
  twisted.equilibrium();
  const double G = 1e7 / 2.6, degrees = M_PI / 180;
  EXPECT_NEAR((twisted.value("s.at 7.5 0.5 0.25.rotation x") - twisted.value("s.at 5 0.5 0.25.rotation x")) * degrees /
                2.5 * G / small,
              std::stod(row.at("G_times_twist_rate")),
              2e-4 * std::stod(row.at("G_times_twist_rate")));

  bent.loads = at_tip(1, {0, 0, 1 / (2 * height)}) + at_tip(3, {0, 0, 1 / (2 * height)});
  Scene scene(bent.text());
  scene.equilibrium();
  // the mean over all nodes of the tip: with two elements of degree 2 on flanges, one on webs
  double       sum = 0;
  unsigned int n   = 0;
  for (unsigned int i = 0; i < 8; ++i)
    for (const double side : {-0.25, 0.25})
      if (i < 5)
        {
          sum +=
            scene.value("s.at 10 " + std::to_string(-0.5 + 0.25 * i) + " " + std::to_string(side) + ".displacement z");
          ++n;
        }
  for (const std::string y : {"-0.5", "0.5"})
    {
      sum += scene.value("s.at 10 " + y + " 0.displacement z");
      ++n;
    }
  EXPECT_NEAR(sum / n / small / std::stod(row.at("tip_deflection")), 1 - 4e-4, 2e-4);
}



// Cubic walls against the analysis of the section as a solid with its corners, which thin_box_shell.csv has: 1/J =
// 148.116, EI = 29200.0. The tip is compared with the list of shells: the clamp holds the warping, which lowers the
// deflection by 0.3 % below that of a beam, 1.16059e-2.
TEST(ShellWalls, CubicBoxHasTheStiffnessOfItsSection)
{
  const Scene section(
    "subsection Materials\n subsection m\n  set Type = isotropic\n  set E = 1e7\n"
    "  set Poisson ratio = 0.3\n  set Density = 1\n end\nend\n"
    "subsection Sections\n subsection s\n  set Type = box\n  set Width 2 = 1.02\n  set Width 3 = 0.52\n"
    "  set Thickness = 0.02\n  set Material = m\n  set Elements = 8\n end\nend\n"
    "subsection Bodies\n subsection b\n  set Type = rigid body\n  set Mass = 1\n"
    "  set Inertia = 1, 1, 1\n end\nend\n");
  const Matrix6 K = section.input.model.find<Section>("s", "section").at(0, Vector3::Zero()).stiffness;
  EXPECT_NEAR(K(4, 4), 29200.0, 0.1);
  const double G = 1e7 / 2.6, degrees = M_PI / 180;

  ShellModel   twisted = box(3, 16, 2), bent = twisted;
  const double q = 1 / (2 * width * height);
  twisted.loads  = at_tip(0, {0, q, 0}) + at_tip(1, {0, 0, q}) + at_tip(2, {0, -q, 0}) + at_tip(3, {0, 0, -q});
  bent.loads     = at_tip(1, {0, 0, 1 / (2 * height)}) + at_tip(3, {0, 0, 1 / (2 * height)});
  Scene turned(twisted.text());
  turned.equilibrium();
  const auto rotation = [&](const std::string &x) {
    return turned.value("s.at " + x + " 0.5 0.25.rotation x") * degrees / small;
  };
  EXPECT_NEAR((rotation("7.5") - rotation("5")) / 2.5 * G / 148.116, 1, 6e-4);

  Scene scene(bent.text());
  scene.equilibrium();
  // sections turn by ∫(10 − x) dx/EI from 5 to 7.5: from the displacements of corners, whose warping is the same
  const auto stretch = [&](const std::string &x) {
    return (scene.value("s.at " + x + " 0.5 -0.25.displacement x") -
            scene.value("s.at " + x + " 0.5 0.25.displacement x")) /
           height / small;
  };
  EXPECT_NEAR((stretch("7.5") - stretch("5")) * 29200.0 / 9.375, 1, 1e-3);
  const double tip = scene.value("s.at 10 0.5 0.25.displacement z") / small;
  EXPECT_NEAR(tip / std::stod(reference_rows("shells/thin_box_shell.csv").at(4).at("tip_deflection")), 1, 1e-4);
}
