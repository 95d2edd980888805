/*
 * Problem:   materials and layups as they are written in a model
 * Reference: Hooke's law in closed form; classical lamination of the same plies given by hand
 */

#include <samara/section/layup.h>

#include <samara/rotation/matrix6.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const std::string rest = R"(
subsection Sections
  subsection round
    set Type         = tube
    set E            = 1e6
    set Density      = 1000
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection beam
    set Type    = beam
    set Points  = 0, 0, 0; 1, 0, 0
    set Section = round
  end
end
)";

  const std::string materials_with_strengths = R"(
subsection Materials
  subsection steel
    set Type             = isotropic
    set E                = 210 GPa
    set Density          = 7800 kg/m^3
    set Tensile strength = 500 MPa
    set Yield stress     = 300 MPa
  end
  subsection carbon
    set Type                 = orthotropic
    set E1                   = 142 GPa
    set E2                   = 9.8 GPa
    set G12                  = 6 GPa
    set nu12                 = 0.3
    set nu23                 = 0.34
    set Density              = 1600
    set Tensile strength     = 2000 MPa, 50 MPa, 51 MPa
    set Compressive strength = 1200 MPa, 150 MPa, 152 MPa
    set Shear strength       = 70 MPa, 71 MPa, 72 MPa
  end
  subsection given
    set Type       = anisotropic
    set Compliance = 1, -0.2, 0, 0, 0, 0,  1, 0, 0, 0, 0.1,  1, 0, 0, 0,  2, 0, 0,  3, 0,  4
  end
end
)";



  std::string
  model_with_layup(const std::string &entries)
  {
    return materials_with_strengths + "subsection Layups\n  subsection skin\n" + entries + "  end\nend\n" + rest;
  }



  const Layup &
  layup_of(const Scene &scene)
  {
    return scene.input.model.find<Layup>("skin", "layup");
  }
} // namespace



TEST(Materials, AreReadWithUnitsAndDefaults)
{
  const Scene scene(materials_with_strengths + rest);
  const auto  find = [&](const std::string &name) {
    return scene.input.model.find<Material>(name, "material").properties();
  };
  const SectionMaterial steel = find("steel");
  EXPECT_NEAR(inverse6(steel.stiffness)(0, 0) * 210e9, 1, 1e-12);
  EXPECT_NEAR(steel.stiffness(4, 4) / (210e9 / 2.6), 1, 1e-12);
  EXPECT_EQ(steel.density, 7800);
  EXPECT_EQ(steel.strengths.tensile, Vector3(500e6, 500e6, 500e6));
  EXPECT_EQ(steel.strengths.compressive, Vector3::Zero());
  EXPECT_EQ(steel.strengths.yield, 300e6);

  const SectionMaterial carbon = find("carbon");
  const Matrix6         F      = inverse6(carbon.stiffness);
  const double          E2     = 9.8e9;
  Vector6               moduli;
  moduli << 142e9, E2, E2, E2 / 2 / 1.34, 6e9, 6e9;
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(F(i, i) * moduli(i), 1, 1e-12) << i;
  EXPECT_NEAR(F(0, 1) * 142e9, -0.3, 1e-12);
  EXPECT_NEAR(F(0, 2) * 142e9, -0.3, 1e-12);
  EXPECT_NEAR(F(1, 2) * E2, -0.34, 1e-12);
  EXPECT_EQ(carbon.strengths.compressive, Vector3(1200e6, 150e6, 152e6));
  EXPECT_EQ(carbon.strengths.shear, Vector3(70e6, 71e6, 72e6));

  const Matrix6 given = inverse6(find("given").stiffness);
  EXPECT_NEAR(given(0, 1), -0.2, 1e-12);
  EXPECT_NEAR(given(1, 5), 0.1, 1e-12);
  EXPECT_NEAR(given(5, 5), 4, 1e-12);
}



TEST(Materials, WithoutEnergyAreRefusedByName)
{
  const auto material = [](const std::string &entries) {
    return complaint_of("subsection Materials\n  subsection bad\n" + entries + "  end\nend\n" + rest);
  };
  const auto says = [](const std::string &text, const std::string &wanted) {
    EXPECT_NE(text.find(wanted), std::string::npos) << text;
  };
  says(material("    set Type = isotropic\n    set E = 1e9\n    set Poisson ratio = 0.5\n"), ":5:");
  says(material("    set Type = isotropic\n    set E = 1e9\n    set Poisson ratio = -1\n"), "energy");
  says(material("    set Type = isotropic\n"), "needs an <E>");
  const std::string ply = "    set Type = orthotropic\n    set E1 = 1e11\n    set G12 = 1e9\n    set E2 = 1e10\n";
  says(material(ply + "    set nu12 = 2.3\n"), "no positive energy");
  EXPECT_EQ(material(ply + "    set nu12 = 2.2\n"), "");
  says(material("    set Type = orthotropic\n    set E1 = 1e11\n    set G12 = 1e9\n"), "needs <E2>");
  says(material(ply + "    set Tensile strength = 1e6, 1e6\n"), "one number or three");
  says(material(ply + "    set Shear strength = 1e6, 0, 1e6\n"), "above zero");
  says(material("    set Type = anisotropic\n    set Stiffness = 1, 1, 1, 1, 1, -1\n"), "not positive definite");
  says(material("    set Type = anisotropic\n    set Stiffness = 1, 1, 1, 1, 1, 0\n"), "not positive definite");
  says(material("    set Type = anisotropic\n    set Compliance = 1, 1, 1, 1, 1, 0\n"), "no inverse");
  says(material("    set Type = anisotropic\n    set Stiffness = 1, 1, 1\n"), "36, 21 or 6");
  says(material("    set Type = anisotropic\n"), "either <Stiffness> or <Compliance>");
}



TEST(Layups, AreTheirPlies)
{
  const Scene scene(
    model_with_layup("    set Material = carbon\n    set Angles = [0/±45]s\n    set Ply thickness = 0.125 mm\n"));
  const auto  &skin        = layup_of(scene);
  const double sequence[6] = {0, 45, -45, -45, 45, 0};
  ASSERT_EQ(skin.plies().size(), 6u);
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(skin.plies()[i].angle, sequence[i] * M_PI / 180, 1e-15);
  EXPECT_NEAR(skin.thickness(), 0.75e-3, 1e-18);

  const Laminate      laminate(skin.laminae());
  const Matrix6      &C = scene.input.model.find<Material>("carbon", "material").properties().stiffness;
  std::vector<Lamina> plies;
  for (const double angle : sequence)
    plies.push_back({C, angle * M_PI / 180, 0.125e-3, 1600});
  EXPECT_LT((laminate.ABD - Laminate(plies).ABD).norm(), 1e-12 * laminate.ABD.norm());
  EXPECT_NEAR(laminate.mass, 0.75e-3 * 1600, 1e-12);
}



TEST(Layups, MixMaterials)
{
  const Scene scene(
    model_with_layup("    set Plies     = carbon, ±30, 0.2 mm; steel, 0, 1 mm\n    set Symmetric = true\n"));
  const auto &plies = layup_of(scene).plies();
  ASSERT_EQ(plies.size(), 6u);
  const char *const names[6]  = {"carbon", "carbon", "steel", "steel", "carbon", "carbon"};
  const double      angles[6] = {30, -30, 0, 0, -30, 30}, thicknesses[6] = {.2e-3, .2e-3, 1e-3, 1e-3, .2e-3, .2e-3};
  for (int i = 0; i < 6; ++i)
    {
      EXPECT_EQ(plies[i].material->name, names[i]);
      EXPECT_NEAR(plies[i].angle, angles[i] * M_PI / 180, 1e-15);
      EXPECT_NEAR(plies[i].thickness, thicknesses[i], 1e-18);
    }
}



TEST(Layups, SayWhatIsWrong)
{
  const auto says = [](const std::string &entries, const std::string &wanted) {
    const std::string text = complaint_of(model_with_layup(entries));
    EXPECT_NE(text.find(wanted), std::string::npos) << entries << text;
    EXPECT_NE(text.find(".prm:"), std::string::npos) << text;
  };
  says("", "either <Plies>");
  says("    set Plies = carbon, 0, 1 mm\n    set Angles = 0\n", "either <Plies>");
  says("    set Plies = carbon, 0\n", "material, angles, thickness");
  says("    set Plies = carbon, 0, 0\n", "thickness above zero");
  says("    set Plies = carbon, 0, 1 kg\n", "kg");
  says("    set Plies = carbom, 0, 1 mm\n", "carbon");
  says("    set Plies = carbon, [0/45, 1 mm\n", "] is missing");
  says("    set Material = carbon\n    set Angles = 0/x\n    set Ply thickness = 1 mm\n", "angle in degrees");
  says("    set Material = carbon\n    set Angles = 0\n", "<Ply thickness> must be given");
  says("    set Material = carbon\n    set Angles = 0\n    set Ply thickness = 0\n", "above zero");
}
