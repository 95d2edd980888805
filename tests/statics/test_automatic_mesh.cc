// Elements = automatic, error: meshes of mixed degrees that meet a wanted error of the strains in the energy norm.
//
// References: the clamped rope with bending layers, closed form in prm/benchmarks/automatic_mesh.prm; roll-up and modes
// as stated at the tests. Mixed degrees themselves: tangents by complex steps.

#include <samara/base/text.h>
#include <samara/cosserat/beam.h>
#include <samara/study/automatic_mesh.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const std::string rope = "prm/benchmarks/automatic_mesh.prm";

  using Texts = std::vector<std::string>;

  /** Overrides with the meshes that are found for a shipped model. */
  Texts
  found(const std::string &model, const Texts &overrides, std::vector<MeshPass> *passes = nullptr)
  {
    std::ostringstream stream;
    Log                log(stream);
    return find_meshes(Catalogue(), InputFile(std::string(SAMARA_SOURCE_DIR) + "/" + model), overrides, log, passes);
  }

  Texts
  with(const std::string &override, const Texts &others = {})
  {
    Texts all = others;
    all.push_back(override);
    return all;
  }

  /** Error of the bending moment of the rope in the energy norm, relative to the energy of the rope. */
  double
  error_of_rope(const Scene &scene)
  {
    const double       T = 100, F = 0.1, l = 0.02, a = 0.4, EI = T * l * l, EA = 1e10;
    const unsigned int n     = 2000;
    double             error = 0, energy = T * T / EA;
    for (unsigned int i = 0; i < n; ++i)
      {
        // dense where the layers are: halves of the points before and behind the force, quadratically
        const double t = (i + 0.5) / n, x = t * t, weight = 2 * t / n;
        const double moment = F * l * (std::exp(-x / l) - 0.5 * std::exp(-std::abs(x - a) / l));
        error += weight * std::pow(scene.value("rope.at " + number_to_text(x) + ".moment 3") - moment, 2) / EI;
        energy += weight * moment * moment / EI;
      }
    return std::sqrt(error / energy);
  }
} // namespace



TEST(AutomaticMesh, MeetsTheErrorOnBendingLayers)
{
  for (const double wanted : {1e-1, 1e-2, 1e-3, 1e-4})
    {
      std::vector<MeshPass> passes;
      Scene                 scene(rope, found(rope, {"Constants/error = " + number_to_text(wanted)}, &passes));
      scene.equilibrium();
      const double error = error_of_rope(scene), estimate = wanted * passes.back().estimate;
      EXPECT_LE(error, wanted);
      EXPECT_GT(error, wanted / 20) << "the mesh is finer than it need be";
      // the estimate is not a bound but the error itself, as the mesh becomes fine
      EXPECT_NEAR(estimate / error, 1., 0.2);
      EXPECT_EQ(scene.system.size(), passes.back().n_unknowns);
    }
}



// With uniform elements two (degree 4) and three times (2, 3) as many unknowns do not reach the error.
TEST(AutomaticMesh, NeedsFewerUnknownsThanUniformElements)
{
  const double wanted = 1e-3;
  Scene        automatic(rope, found(rope, {"Constants/error = " + number_to_text(wanted)}));
  automatic.equilibrium();
  EXPECT_LE(error_of_rope(automatic), wanted);
  for (const unsigned int p : {2, 3, 4})
    {
      const unsigned int n = (p == 4 ? 2 : 3) * automatic.system.size() / (6 * p);
      Scene uniform(rope, {"Bodies/rope/Elements = " + std::to_string(n), "Bodies/rope/Degree = " + std::to_string(p)});
      uniform.equilibrium();
      EXPECT_GT(error_of_rope(uniform), wanted) << "degree " << p;
    }
}



// A whole circle: the strain is constant, what is hard is the large rotation. End back at the clamp.
TEST(AutomaticMesh, RollUpComesBackToTheClamp)
{
  const std::string model = "prm/benchmarks/roll_up.prm";
  double            error[2];
  for (const unsigned int k : {0, 1})
    {
      Scene scene(model,
                  found(model, {std::string("Bodies/beam/Elements = automatic, ") + (k == 0 ? "1e-2" : "1e-4")}));
      scene.equilibrium();
      error[k] = std::hypot(scene.value("beam.end.position x"), scene.value("beam.end.position z"));
    }
  EXPECT_LT(error[0], 1e-2);
  EXPECT_LT(error[1], 1e-4);
}



// A curved reference line is resolved even where nothing strains; displacements are of higher order than strains.
TEST(AutomaticMesh, DeepArchMeetsTheErrorInItsDisplacements)
{
  const std::string model = "prm/benchmarks/deep_arch.prm";
  Scene             fine(model, {"Constants/P = 600", "Bodies/arch/Elements = 96"});
  Scene             scene(model, found(model, {"Constants/P = 600", "Bodies/arch/Elements = automatic, 1e-3"}));
  fine.equilibrium();
  scene.equilibrium();
  EXPECT_LT(scene.system.size(), fine.system.size() / 4);
  for (const std::string axis : {"x", "y"})
    EXPECT_NEAR(scene.value("arch.middle.displacement " + axis) / fine.value("arch.middle.displacement " + axis),
                1.,
                1e-3);
}



// Without loads the modes have to be resolved: 16 of them, frequencies with about the square of the error. Exact for
// bending: s r² ω⁴ − (1 + a²(r² + s)) ω² + a⁴ = 0.
TEST(AutomaticMesh, ResolvesModesWhereNothingLoads)
{
  const std::string model = "prm/benchmarks/timoshenko_beam.prm";
  Scene             scene(model, found(model, {"Bodies/beam/Elements = automatic, 3e-2"}));
  Scene             coarse(model, {"Bodies/beam/Elements = 4", "Bodies/beam/Degree = 2"});
  double            largest = 0, largest_of_coarse = 0;
  for (const unsigned int n : {1, 2, 3, 4})
    {
      const double r = 0.1, s = 2.6 * r * r * 6 / 5, a = n * M_PI, b = 1 + a * a * (r * r + s);
      const double omega   = std::sqrt((b - std::sqrt(b * b - 4 * s * r * r * std::pow(a, 4))) / (2 * s * r * r));
      const auto   nearest = [&](Scene &of) {
        double least = 1;
        for (const auto &mode : of.modes())
          least = std::min(least, std::abs(mode.frequency() / omega - 1));
        return least;
      };
      largest           = std::max(largest, nearest(scene));
      largest_of_coarse = std::max(largest_of_coarse, nearest(coarse));
    }
  EXPECT_LT(largest, 1e-3);
  EXPECT_GT(largest_of_coarse, 1e-3);
}



// Steps of stiffness and a load at an inner point, all where elements end: moments are linear between, degree 2 has
// them exactly, and jumps of the strains are no reason to refine.
TEST(AutomaticMesh, DoesNotRefineAtJumps)
{
  const std::string file = "automatic_mesh_" + std::to_string(getpid()) + ".prm";
  const std::string section =
    "    set Type = engineering constants\n    set EA = 1e6\n    set GA2 = 1e6\n    set GA3 = 1e6\n    set GJ = 1\n    set Mass = 1\n";
  std::ofstream(file)
    << "set Analyses = static\nsubsection Sections\n"
    << "  subsection thick\n"
    << section << "    set EI2 = 10\n    set EI3 = 10\n  end\n"
    << "  subsection thin\n"
    << section << "    set EI2 = 1\n    set EI3 = 1\n  end\nend\n"
    << "subsection Bodies\n"
    << "  subsection one\n    set Type = beam\n    set Points = 0, 0, 0; 1, 0, 0\n    set Section = thick\n"
    << "    set Frames = load at 0.3\n    set Elements = automatic, 1e-4\n  end\n"
    << "  subsection two\n    set Type = beam\n    set Points = 1, 0, 0; 1.5, 0, 0\n    set Section = thin\n"
    << "    set Elements = automatic, 1e-4\n  end\nend\n"
    << "subsection Joints\n"
    << "  subsection clamp\n    set Type = rigid\n    set Body A = ground\n    set Body B = one.start\n  end\n"
    << "  subsection weld\n    set Type = rigid\n    set Body A = one.end\n    set Body B = two.start\n  end\nend\n"
    << "subsection Loads\n"
    << "  subsection inner\n    set Type = point load\n    set At = one.load\n    set Force = 0, 0, 1e-3\n  end\n"
    << "  subsection tip\n    set Type = point load\n    set At = two.end\n    set Force = 0, 0, -1e-4\n  end\nend\n";
  std::ostringstream    stream;
  Log                   log(stream);
  std::vector<MeshPass> passes;
  find_meshes(Catalogue(), InputFile(file), {}, log, &passes);
  std::remove(file.c_str());
  EXPECT_EQ(passes.size(), 1u);
  EXPECT_EQ(passes[0].n_unknowns, 6 * 2 * 8u);
  EXPECT_LT(passes[0].estimate, 1e-2);
  EXPECT_NE(stream.str().find("mesh of <two>: 4 elements of degrees 2 2 2 2"), std::string::npos);
}



TEST(AutomaticMesh, LeavesOtherModelsAlone)
{
  const Texts overrides = {"Constants/P = 600"};
  EXPECT_EQ(found("prm/benchmarks/deep_arch.prm", overrides), overrides);
}



// A narrow load is integrated, wherever nodes are. The peak here is √π 1000 · 0.005 = 8.9 times as large as the load
// around it.
TEST(AutomaticMesh, SeesANarrowLoadBetweenTheNodesOfTheFirstMesh)
{
  const std::string model = "prm/benchmarks/uniform_load.prm";
  Scene             plain(model);
  std::string       body, load;
  for (const auto &c : plain.input.model.items)
    {
      body = c->kind == "beam" ? c->name : body;
      load = c->kind == "line load" ? c->name : load;
    }
  const std::string L          = number_to_text(plain.input.model.find<Beam>(body, "beam").length());
  const Texts       peak       = {"Loads/" + load + "/Variation = 1 + 1000*exp(-((s/" + L + " - 0.06)/0.005)^2)"};
  const auto        root_force = [&](const Texts &overrides) {
    Scene scene(model, overrides);
    scene.equilibrium();
    double sum = 0;
    for (const std::string axis : {"1", "2", "3"})
      sum += std::pow(scene.value(body + ".start.force " + axis), 2);
    return std::sqrt(sum);
  };
  const double around = root_force({"Bodies/" + body + "/Elements = 4"});
  const double seen   = root_force(found(model, with("Bodies/" + body + "/Elements = automatic, 1e-3", peak)));
  const double exact  = (1 + std::sqrt(M_PI) * 5) * around;
  EXPECT_NEAR(seen / exact, 1., 1e-6);
  EXPECT_NEAR(root_force(with("Bodies/" + body + "/Elements = 400", peak)) / exact, 1., 2e-2);
}



namespace
{
  Texts
  mixed()
  {
    return {"Bodies/arch/Mesh = 1 to 0.1, 3 to 0.2, 2 to 0.5, 5 to 0.7, 4 to 1"};
  }
} // namespace



TEST(MixedDegrees, TangentIsTheDerivativeOfTheResidual)
{
  Scene             scene("prm/benchmarks/deep_arch.prm", with("Bodies/arch/Damping = 0.1", mixed()));
  const ComplexStep check(scene.system);
  EXPECT_LT(check.error_of_tangent(), 2e-14);
  EXPECT_LT(check.error_of_damping(), 2e-14);
}



TEST(MixedDegrees, StoredStrainMatricesAreTheRatesOfTheStrains)
{
  Scene               scene("prm/benchmarks/deep_arch.prm", mixed());
  const System       &system = scene.system;
  State               state  = system.reference();
  std::vector<double> z(system.size());
  for (unsigned int i = 0; i < z.size(); ++i)
    z[i] = 0.1 * std::sin(i + 1.);
  system.update(state, z);
  for (unsigned int i = 6; i < state.y.size(); ++i)
    state.y[i] = std::cos(3. * i);
  for (const auto &item : system.model.items)
    if (const auto *const c = dynamic_cast<const Beam *>(item.get()))
      {
        std::vector<double> rates(c->n_strains()), stored(c->n_strains()), r(system.size() + 6, 0.),
          b(system.size() + 6, 0.);
        const auto B = c->linear_strains();
        c->strain_rates(state.point(), rates.data());
        B->renew(state.point());
        B->strains(state.y.data(), state.rates.data(), stored.data());
        for (unsigned int i = 0; i < rates.size(); ++i)
          EXPECT_NEAR(rates[i], stored[i], 1e-13);
        // and Bᵀσ is the residual of the stresses
        for (unsigned int i = 0; i < state.stress.size(); ++i)
          state.stress[i] = std::sin(5. * i);
        c->residual(state.point(), r.data());
        B->add_forces(state.stress.data() + c->first_strain, b.data());
        for (unsigned int i = 0; i < r.size(); ++i)
          EXPECT_NEAR(r[i], b[i], 1e-11);
      }
}



// All elements converge together: at half the size each, the error is that of the lowest degree.
TEST(MixedDegrees, ConvergeWithTheOrderOfTheLowest)
{
  Scene  fine("prm/benchmarks/deep_arch.prm", {"Constants/P = 600", "Bodies/arch/Elements = 96"});
  double error[2];
  fine.equilibrium();
  for (const unsigned int k : {0, 1})
    {
      const unsigned int n = 16 << k;
      Texts              mesh;
      for (unsigned int i = 0; i < n; ++i)
        mesh.push_back(std::to_string(2 + (i >> k) % 3) + " to " + number_to_text(double(i + 1) / n));
      Scene scene("prm/benchmarks/deep_arch.prm", {"Constants/P = 600", "Bodies/arch/Mesh = " + join(mesh, ", ")});
      scene.equilibrium();
      error[k] = std::abs(scene.value("arch.middle.displacement x") - fine.value("arch.middle.displacement x"));
    }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4., 0.6);
}



TEST(MixedDegrees, FaultyMeshesAreRefused)
{
  for (const std::string wrong : {"3 to 0.5",                   // does not reach the end
                                  "3 to 1.5",                   // beyond it
                                  "3 to 0.6, 2 to 0.4, 2 to 1", // backwards
                                  "7 to 1",                     // degree
                                  "2.5 to 1",
                                  "3 at 1",
                                  "3"})
    EXPECT_THROW(Scene("prm/benchmarks/deep_arch.prm", {"Bodies/arch/Mesh = " + wrong}), InputError) << wrong;
  // no element ends at the frame <load at 0.4>
  EXPECT_THROW(Scene(rope, {"Bodies/rope/Mesh = 3 to 0.5, 3 to 1"}), InputError);
  for (const std::string wrong : {"0", "automatic", "automatic, 0", "automatic, 2", "automatic, fine", "1.5"})
    EXPECT_THROW(Scene(rope, {"Bodies/rope/Elements = " + wrong}), InputError) << wrong;
}
