#include <samara/base/text.h>
#include <samara/study/automatic_shells.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    const Shell *
    shell_of(const Model &model, const std::string &name)
    {
      for (const auto &item : model.items)
        if (const auto *const shell = dynamic_cast<const Shell *>(item.get()); shell != nullptr && shell->name == name)
          return shell;
      return nullptr;
    }



    /** What strains of the finer solution have and no combination of the coarse ones, all as columns. */
    Eigen::VectorXd
    remainder(const Eigen::VectorXd &fine, const Eigen::MatrixXd &coarse)
    {
      return fine - coarse * coarse.completeOrthogonalDecomposition().solve(fine);
    }
  } // namespace



  double
  energy_of_shells(const Model &model, const std::vector<double> &strains)
  {
    double sum = 0;
    for (const auto &item : model.items)
      if (const auto *const shell = dynamic_cast<const Shell *>(item.get());
          shell != nullptr && shell->n_elements() > 0)
        sum += 2 * shell->strain_energy(strains.data() + shell->first_strain);
    return sum;
  }



  ShellMeshes::ShellMeshes(const Model &model)
  {
    for (const auto &item : model.items)
      if (const auto *const shell = dynamic_cast<const Shell *>(item.get());
          shell != nullptr && shell->wanted_error() > 0)
        meshes[shell->name] = {shell->wanted_error(),
                               shell->degree_of_elements(),
                               shell->n_refinements(),
                               shell->n_elements(),
                               shell->patch_meshes(),
                               {},
                               {}};
  }



  void
  ShellMeshes::add_overrides(const unsigned int higher, std::vector<std::string> &overrides) const
  {
    for (const auto &[name, mesh] : meshes)
      {
        const std::string        entry = "Bodies/" + name + "/";
        std::vector<std::string> patches;
        for (const auto &patch : mesh.patches)
          patches.push_back(Value<PatchMesh>::write(patch));
        if (patches.empty())
          overrides.push_back(entry + "Refinements = " + std::to_string(mesh.refinements));
        else
          overrides.push_back(entry + "Mesh = " + join(patches, "; "));
        if (higher > 0)
          overrides.push_back(entry + "Degree = " + std::to_string(mesh.degree + higher));
      }
  }



  unsigned int
  ShellMeshes::n_cells() const
  {
    unsigned int sum = 0;
    for (const auto &mesh : meshes)
      sum += mesh.second.n_cells;
    return sum;
  }



  double
  ShellMeshes::sum_of(const Mesh &mesh) const
  {
    // the finer solution has an error, too: on the coarsest meshes the difference is two thirds of the whole
    constexpr double margin = 1.5;
    double           sum    = 0;
    for (const auto &cell : mesh.errors)
      sum += cell.error * std::pow(margin / mesh.wanted, 2);
    return sum;
  }



  double
  ShellMeshes::measure(const SolvedStrains &fine, const SolvedStrains &coarse, const std::vector<double> &energies)
  {
    // where errors per cell are at least this part of the largest; a cut takes away all but 4^-p of them
    constexpr double part = 0.1;
    double           sum  = 0;
    for (auto &[name, mesh] : meshes)
      {
        const Shell &of_fine = *shell_of(fine.model, name), &of_coarse = *shell_of(coarse.model, name);
        mesh.n_cells = of_fine.n_elements();
        mesh.errors.assign(mesh.n_cells, {});
        const auto samples = [&](const SolvedStrains &solved, const Shell &shell, const unsigned int k) {
          return shell.energy_samples(solved.strains[k].data() + shell.first_strain, of_fine);
        };
        Eigen::MatrixXd of_modes(of_fine.n_strains(), coarse.strains.size() - coarse.is_static);
        for (unsigned int k = 0; k < of_modes.cols(); ++k)
          of_modes.col(k) = samples(coarse, of_coarse, k + coarse.is_static);
        for (unsigned int k = 0; k < fine.strains.size(); ++k)
          {
            const bool is_equilibrium = k == 0 && fine.is_static;
            if (energies[k] == 0 || (!is_equilibrium && of_modes.cols() == 0))
              continue;
            const Eigen::VectorXd own = samples(fine, of_fine, k);
            const auto            of_cells =
              of_fine.errors_of_cells(is_equilibrium ? own - samples(coarse, of_coarse, 0) : remainder(own, of_modes));
            for (unsigned int i = 0; i < of_cells.size(); ++i)
              {
                mesh.errors[i].error += of_cells[i].error / energies[k];
                for (unsigned int d = 0; d < 2; ++d)
                  mesh.errors[i].across[d] += of_cells[i].across[d] / energies[k];
              }
          }
        mesh.finer = of_fine.refined(mesh.errors, part);
        sum += sum_of(mesh);
      }
    return sum;
  }



  void
  ShellMeshes::refine(const double sum)
  {
    for (auto &of_shell : meshes)
      if (Mesh &mesh = of_shell.second; sum_of(mesh) > 0.1 * sum)
        {
          mesh.patches     = mesh.finer.patches;
          mesh.refinements = mesh.finer.refinements;
        }
  }



  void
  ShellMeshes::refine_everywhere()
  {
    for (auto &of_shell : meshes)
      {
        Mesh &mesh = of_shell.second;
        for (auto &patch : mesh.patches)
          for (Division *const division : {&patch.u, &patch.v})
            *division = division->halved(std::vector<bool>(division->n(), true));
        mesh.refinements += mesh.patches.empty();
        mesh.n_cells *= 4;
      }
  }



  std::vector<ShellMeshes::Told>
  ShellMeshes::told() const
  {
    std::vector<Told> result;
    for (const auto &[name, mesh] : meshes)
      {
        std::vector<std::string> patches;
        for (const auto &patch : mesh.patches)
          patches.push_back(std::to_string(patch.u.n()) + " x " + std::to_string(patch.v.n()));
        result.push_back(
          {name, (patches.empty() ? std::to_string(mesh.n_cells) : join(patches, ", ")) + " elements", mesh.wanted});
      }
    return result;
  }
} // namespace samara
