// The shell of four nodes that is shipped as a prototype: patch tests on cells that are no parallelograms, thin plates.

#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  ShellModel
  warped_plate()
  {
    ShellModel model;
    model.patches   = warped_square(0.08);
    model.elements  = "4, 3";
    model.degree    = 1;
    model.E         = 2e3;
    model.thickness = 0.1;
    return model;
  }

  std::string
  as_mitc4(const ShellModel &model)
  {
    std::string text = model.text();
    text.replace(text.find("set Type = shell"), 16, "set Type = MITC4 shell");
    return text;
  }

  std::string
  pulled(const std::string &force)
  {
    return " subsection pull\n  set Type = line load\n  set Body = s\n  set Edge = edge u1\n  " + force + "\n end\n";
  }

  /** Deflection of the middle of a clamped square plate under a pressure, over that of a thin one. */
  double
  deflection(const std::string &kind, const unsigned int n, const double thickness)
  {
    ShellModel   model;
    const double q  = 1e-4 * std::pow(thickness, 3) * thickness; // small: statics are linear
    model.patches   = "u, v, 0";
    model.elements  = std::to_string(n) + ", " + std::to_string(n);
    model.degree    = kind == "shell" ? 2 : 1;
    model.thickness = thickness;
    model.joints    = support("rim", "s.edge u0, s.edge u1, s.edge v0, s.edge v1", "all");
    std::ostringstream load;
    load << " subsection q\n  set Type = area load\n  set Body = s\n  set Force = 0, 0, " << q << "\n end\n";
    model.loads      = load.str();
    model.entries    = "  set Frames = middle at 0.5 0.5\n";
    std::string text = model.text();
    text.replace(text.find("set Type = shell"), 16, "set Type = " + kind);
    Scene scene(text);
    scene.equilibrium();
    const double D = model.E * std::pow(thickness, 3) / (12 * (1 - model.nu * model.nu));
    return scene.value("s.middle.displacement z") / (0.00126531908 * q / D);
  }
} // namespace



// Constant strains on any cells: tension, and, without Poisson's ratio, bending and twist of an edge.
TEST(Mitc4, PatchTests)
{
  ShellModel tension = warped_plate();
  tension.joints = support("left", "s.edge u0", "displacement 1, displacement 3, rotation 1, rotation 2, rotation 3") +
                   support("corner", "s.at 0 0", "displacement 2");
  tension.loads = pulled("set Force = 1e-5, 0, 0");
  Scene pulled_plate(as_mitc4(tension));
  pulled_plate.equilibrium();
  const double strain = 1e-5 / (2e3 * 0.1);
  for (const std::string corner : {"1 0", "1 1"})
    EXPECT_NEAR(pulled_plate.value("s.at " + corner + ".displacement x"), strain, 1e-6 * strain) << corner;
  EXPECT_NEAR(pulled_plate.value("s.at 1 1.displacement y"), -0.3 * strain, 1e-6 * strain);

  ShellModel bending = warped_plate();
  bending.nu         = 0;
  bending.joints     = support("left", "s.edge u0", "all");
  bending.loads      = pulled("set Moment = 0, -1e-6, 0");
  Scene bent(as_mitc4(bending));
  bent.equilibrium();
  const double curvature = 1e-6 * 12 / (2e3 * 1e-3);
  for (const std::string corner : {"1 0", "1 1"})
    EXPECT_NEAR(bent.value("s.at " + corner + ".displacement z"), 0.5 * curvature, 1e-6 * curvature) << corner;
}



// Thin plates do not lock: with 16 x 16 elements within 1 % at any thickness; order 2 in the size of elements.
TEST(Mitc4, ThinPlatesDoNotLock)
{
  for (const double thickness : {1e-2, 1e-3, 1e-4})
    EXPECT_NEAR(deflection("MITC4 shell", 16, thickness), 1, 0.01) << thickness;
  const double exact  = deflection("shell", 12, 1e-3);
  const double coarse = std::abs(deflection("MITC4 shell", 4, 1e-3) / exact - 1),
               fine   = std::abs(deflection("MITC4 shell", 8, 1e-3) / exact - 1);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}



// The built-in shell of degree 1 refuses such cells, and says so.
TEST(Mitc4, TakesCellsThatTheBuiltInShellRefuses)
{
  EXPECT_THROW(Scene(warped_plate().text()), InputError);
  EXPECT_NO_THROW(Scene(as_mitc4(warped_plate())));
}
