#ifndef samara_tests_shells_strain_error_h
#define samara_tests_shells_strain_error_h

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>
#include <samara/study/automatic_mesh.h>

#include "../scene.h"

namespace samara
{
  using Words = std::vector<std::string>;

  /** What is found for a shipped model, and what was estimated in each pass. */
  struct FoundMesh
  {
    Words                 overrides;
    std::vector<MeshPass> passes;

    FoundMesh(const std::string &model, const Words &entries)
    {
      std::ostringstream stream;
      Log                log(stream);
      overrides =
        find_meshes(Catalogue(), InputFile(std::string(SAMARA_SOURCE_DIR) + "/" + model), entries, log, &passes);
    }
  };

  inline const Shell &
  shell_of(const Scene &scene, const std::string &name)
  {
    return scene.input.model.find<Shell>(name, "shell");
  }

  /**
   * The error of the strains of a solved shell relative to those of a solution of each cell in four, two degrees
   * higher; in two along u where the solution is nearly that of a line @p along_u.
   */
  inline double
  error_of(const std::string &model, const Words &overrides, const std::string &name, const bool along_u = false)
  {
    Scene own(model, overrides);
    own.equilibrium();
    const Shell             &shell = shell_of(own, name);
    std::vector<std::string> halves;
    for (PatchMesh patch : shell.patch_meshes())
      {
        patch.u = patch.u.halved(std::vector<bool>(patch.u.n(), true));
        if (!along_u)
          patch.v = patch.v.halved(std::vector<bool>(patch.v.n(), true));
        halves.push_back(Value<PatchMesh>::write(patch));
      }
    Words finer = overrides;
    finer.push_back("Bodies/" + name + "/Mesh = " + join(halves, "; "));
    finer.push_back("Bodies/" + name + "/Degree = " + std::to_string(shell.degree_of_elements() + 2));
    Scene fine(model, finer);
    fine.equilibrium();
    const Shell &reference = shell_of(fine, name);
    const auto   samples   = [&](Scene &scene, const Shell &of) {
      std::vector<double> e;
      scene.system.strains(scene.context.state, e);
      return of.energy_samples(e.data() + of.first_strain, reference);
    };
    const Eigen::VectorXd exact = samples(fine, reference);
    return (samples(own, shell) - exact).norm() / exact.norm();
  }
} // namespace samara

#endif
