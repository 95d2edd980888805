/*
 * Problem:   Elements = automatic, error, of shells: meshes that meet a wanted error of the strains in the energy norm
 * Reference: the same model on the mesh that was found with every element cut into four and of two degrees more; the
 *            layer of a clamped tank in closed form. Order 2 p of the energy of the error.
 */

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>
#include <samara/study/automatic_mesh.h>

#include <gtest/gtest.h>

#include "models.h"
#include "strain_error.h"

using namespace samara;

namespace
{
  const std::string roof = "prm/benchmarks/shells/scordelis_lo_roof.prm",
                    tank = "prm/benchmarks/shells/clamped_tank.prm", plate = "prm/verification/plate.prm",
                    plate_modes = "prm/examples/shells/plate_modes.prm";
} // namespace



// Effectivity: the estimate over the error, with a margin of 1.5 for what the finer solution lacks.
TEST(AutomaticShells, MeetTheError)
{
  const double wanted = 5e-2;
  for (const auto &[model, name, entries] :
       {std::make_tuple(roof, std::string("roof"), Words()),
        std::make_tuple(plate, std::string("plate"), Words({"Bodies/plate/Degree = 3"}))})
    {
      Words all = entries;
      all.push_back("Bodies/" + name + "/Elements = automatic, " + number_to_text(wanted) + " from 2, 2");
      const FoundMesh found(model, all);
      const double    error = error_of(model, found.overrides, name), estimate = wanted * found.passes.back().estimate;
      EXPECT_LT(error, 1.1 * wanted) << model;
      EXPECT_GT(error, wanted / 20) << model << ": the mesh is finer than it need be";
      EXPECT_GT(estimate / error, 0.5) << model;
      EXPECT_LT(estimate / error, 2) << model;
      RecordProperty(name + " effectivity", std::to_string(estimate / error));
    }
}



// Of uniform meshes, the square falls like h^2p: the first mode of a plate, a product of sines.
TEST(AutomaticShells, TheEstimateHasTheOrderOfTheElements)
{
  const auto estimate = [](const unsigned int p, const unsigned int n) {
    const std::string both = std::to_string(n) + ", " + std::to_string(n);
    return FoundMesh(plate_modes,
                     {"Bodies/plate/Elements = automatic, 0.99 from " + both,
                      "Bodies/plate/Degree = " + std::to_string(p),
                      "Modal/Modes = 1"})
      .passes.front()
      .estimate;
  };
  EXPECT_NEAR(2 * std::log2(estimate(2, 2) / estimate(2, 4)), 4, 0.4);
  EXPECT_NEAR(2 * std::log(estimate(3, 2) / estimate(3, 3)) / std::log(1.5), 6, 0.4);
}



// Elements become small along the tank, at the clamp: nowhere else, and round it only as the circle wants it.
TEST(AutomaticShells, ResolveALayerWhereItIs)
{
  const FoundMesh found(tank, {"Constants/error = 3e-2"});
  Scene           scene(tank, found.overrides);
  scene.equilibrium();
  const PatchMesh mesh = shell_of(scene, "tank").patch_meshes()[0];
  EXPECT_LE(mesh.v.n(), 4u);
  EXPECT_LT(mesh.u.length(0), 0.07);
  EXPECT_GE(mesh.u.length(mesh.u.n() - 1), 0.25);
  // thin theory, to some h/R
  EXPECT_NEAR(std::abs(scene.value("tank.clamp.moment 11")) / (1e-5 / (2 * std::sqrt(3.))), 1, 0.1);
  const double error = error_of(tank, found.overrides, "tank", true), estimate = 3e-2 * found.passes.back().estimate;
  EXPECT_LT(error, 3.3e-2);
  EXPECT_GT(estimate / error, 0.5);
  EXPECT_LT(estimate / error, 2);
  // equal elements, two more of them, are worse
  const std::string n = std::to_string(mesh.u.n() + 2) + ", " + std::to_string(mesh.v.n());
  EXPECT_GT(error_of(tank, {"Bodies/tank/Elements = " + n}, "tank", true), 1.2 * error);
}



// Modes without loads, two of them with the same frequency: exact by Mindlin's theory.
TEST(AutomaticShells, ResolveModesWhereNothingLoads)
{
  const FoundMesh found(plate_modes, {"Bodies/plate/Elements = automatic, 1e-1 from 2, 2", "Modal/Modes = 4"});
  Scene           scene(plate_modes, found.overrides);
  const auto     &modes = scene.modes();
  ASSERT_GE(modes.size(), 4u);
  const double exact[] = {0.0597118208, 0.149198155, 0.149198155, 0.238587075};
  for (unsigned int k = 0; k < 4; ++k)
    EXPECT_NEAR(modes[k].frequency() / exact[k], 1, 3e-3) << k;
  EXPECT_LE(found.passes.back().estimate, 1);
  EXPECT_GT(found.passes.size(), 1u);
}



// Grids and cells of files have no coordinates: all of their cells are cut, on the surface they have.
TEST(AutomaticShells, CutAllCellsOfGridsAndFiles)
{
  ShellModel model;
  model.entries    = "  set Frames = corner at 1 1 0\n";
  model.joints     = support("clamp", "s.edge 0", "all");
  model.loads      = " subsection q\n  set Type = area load\n  set Body = s\n  set Force = 0, 0, 1e-9\n end\n";
  std::string text = model.text();
  const auto  with = [&](const std::string &instead) {
    std::string result = text;
    const auto  at = result.find("set Patches"), end = result.find("set Degree");
    return result.replace(at, end - at, instead);
  };
  const auto deflection = [](const std::string &of, const Words &overrides) {
    Scene scene(of, overrides);
    scene.equilibrium();
    return scene.value("s.corner.displacement z");
  };
  const std::string grid = with("set Grid = hyper_cube\n  set Grid arguments = 0 : 1 : true\n  "),
                    name = "square_" + std::to_string(getpid());
  std::ofstream(name + ".inp") << "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,1,1,0\n*NSET, NSET=0\n1, 3\n"
                               << "*ELEMENT, TYPE=S4\n1,1,2,4,3\n";
  const std::string file    = with("set Mesh file = " + name + ".inp\n  ");
  const double      of_grid = deflection(grid, {"Bodies/s/Refinements = 2"});
  EXPECT_NEAR(deflection(file, {"Bodies/s/Refinements = 2"}) / of_grid, 1, 1e-9);
  EXPECT_GT(std::abs(deflection(file, {"Bodies/s/Refinements = 0"}) / of_grid - 1), 1e-6);
  std::ofstream(name + ".prm") << grid;
  std::ostringstream    stream;
  Log                   log(stream);
  std::vector<MeshPass> passes;
  const Words           found =
    find_meshes(Catalogue(), InputFile(name + ".prm"), {"Bodies/s/Elements = automatic, 0.05"}, log, &passes);
  EXPECT_GE(passes.size(), 2u);
  EXPECT_LE(passes.back().estimate, 1);
  EXPECT_EQ(found.back(), "Bodies/s/Refinements = " + std::to_string(passes.size() - 1));
  std::remove((name + ".prm").c_str());
  std::remove((name + ".inp").c_str());
}



// Two patches that share a side, each with its own coordinates: what is cut across it is cut on both sides.
TEST(AutomaticShells, StripsGoThroughPatches)
{
  ShellModel model;
  model.patches  = "u, v, 0; 1 + v, 1 - u, 0"; // v of the second along u of the first
  model.elements = "automatic, 0.02 from 2, 2";
  model.joints   = support("clamp", "s.edge u0", "all");
  model.loads    = " subsection q\n  set Type = line load\n  set Body = s\n  set Edge = edge v1\n"
                   "  set Force = 0, 0, 1e-9\n end\n";
  Scene       scene(model.text());
  const auto &shell = shell_of(scene, "s");
  ASSERT_EQ(shell.patch_meshes().size(), 2u);
  // a cut of the first column of the first patch alone, and one of its first row, which is that of the last column of
  // the second
  std::vector<Shell::CellError> errors(8);
  errors[0].across[0] = 1;
  auto cut            = shell.refined(errors, 0.5).patches;
  EXPECT_EQ(Value<PatchMesh>::write(cut[0]), "0.25 0.5 1 by 0.5 1");
  EXPECT_EQ(Value<PatchMesh>::write(cut[1]), "0.5 1 by 0.5 1");
  errors[0]           = {};
  errors[0].across[1] = 1;
  cut                 = shell.refined(errors, 0.5).patches;
  EXPECT_EQ(Value<PatchMesh>::write(cut[0]), "0.5 1 by 0.25 0.5 1");
  EXPECT_EQ(Value<PatchMesh>::write(cut[1]), "0.5 0.75 1 by 0.5 1");
}



TEST(AutomaticShells, FaultyEntriesAreRefused)
{
  for (const std::string wrong : {"automatic",
                                  "automatic, 0",
                                  "automatic, 2",
                                  "automatic, fine",
                                  "automatic, 0.1 from 2",
                                  "0, 2",
                                  "2; 2, 2",
                                  "3"})
    EXPECT_THROW(Scene(plate, {"Bodies/plate/Elements = " + wrong}), InputError) << wrong;
  for (const std::string wrong : {"0.5 1",          // along u alone
                                  "0.5 by 0.5 1",   // does not reach the end
                                  "0.5 0.5 1 by 1", // an element without length
                                  "0.6 0.4 1 by 1", // backwards
                                  "half 1 by 1",
                                  "0.5 1 by 0.5 1; 1 by 1"}) // one patch
    EXPECT_THROW(Scene(plate, {"Bodies/plate/Mesh = " + wrong}), InputError) << wrong;
  EXPECT_THROW(Scene(plate, {"Bodies/plate/Elements = automatic, 0.1", "Bodies/plate/Degree = 6"}), InputError);
  EXPECT_THROW(
    Scene(plate,
          {"Bodies/plate/Elements = automatic, 0.1", "Bodies/plate/Type = MITC4 shell", "Bodies/plate/Degree = 1"}),
    InputError);
}
