#ifndef samara_study_automatic_shells_h
#define samara_study_automatic_shells_h

#include <samara/cosserat/shell.h>
#include <samara/model/model.h>

#include <map>
#include <string>
#include <vector>

namespace samara
{
  /** Strains of a whole model: of its equilibrium, if @p is_static the first of them, and of modes. */
  struct SolvedStrains
  {
    const Model                            &model;
    const std::vector<std::vector<double>> &strains;
    bool                                    is_static;
  };

  /** The meshes of shells with automatic elements while they are looked for; see automatic_mesh.h. */
  class ShellMeshes
  {
  public:
    explicit ShellMeshes(const Model &model);

    bool
    empty() const
    {
      return meshes.empty();
    }

    /** Entries that give these meshes, of degrees higher by so much. */
    void add_overrides(unsigned int higher, std::vector<std::string> &overrides) const;

    unsigned int n_cells() const;

    /**
     * Find the squares of the errors of the cells: of the equilibrium what the @p fine solution has and the @p coarse
     * one has not; of each mode what no combination of the coarse ones has. Both relative to the @p energies of the
     * solutions, from which those without energy are left out.
     *
     * Returns the sum over all cells, relative to the squares of what is wanted.
     */
    double measure(const SolvedStrains &fine, const SolvedStrains &coarse, const std::vector<double> &energies);

    /** Refine shells with a fair part of @p sum, measure()'s. */
    void refine(double sum);
    void refine_everywhere();

    /** "12 x 8 elements", by names of shells, and the wanted errors. */
    struct Told
    {
      std::string name, elements;
      double      wanted;
    };
    std::vector<Told> told() const;

  private:
    struct Mesh
    {
      double                        wanted;
      unsigned int                  degree, refinements, n_cells;
      std::vector<PatchMesh>        patches;
      std::vector<Shell::CellError> errors;
      Shell::Refined                finer; ///< where errors are
    };
    std::map<std::string, Mesh> meshes;

    double sum_of(const Mesh &mesh) const;
  };

  /** Twice the energy of strains in the shells of a model, given those of all of it. */
  double energy_of_shells(const Model &model, const std::vector<double> &strains);
} // namespace samara

#endif
