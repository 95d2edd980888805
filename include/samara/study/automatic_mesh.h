#ifndef samara_study_automatic_mesh_h
#define samara_study_automatic_mesh_h

#include <samara/base/log.h>
#include <samara/input/input.h>

#include <string>
#include <vector>

namespace samara
{
  /** What was found at one pass of find_meshes(). */
  struct MeshPass
  {
    unsigned int n_unknowns = 0; ///< of the model with the meshes of this pass
    double       estimate   = 0; ///< error relative to what is wanted
  };

  /**
   * Find meshes for all beams and shells whose elements are automatic, and return the overrides with them added:
   * "Bodies/blade/Mesh = 2 to 0.25, 4 to 1", "Bodies/roof/Mesh = 0.5 0.75 1 by 0.5 1", or "Bodies/cap/Refinements = 3".
   *
   * In each pass the model is solved with the meshes as they are, and with degrees one higher. The difference of the
   * strains, in the energy norm, is the error of the first solution, if the second one is much better; the Legendre
   * coefficients that both do not have are added as a geometric series. Elements with more than a quarter of the
   * largest square are refined: the degree grows by one, up to 4, where the coefficients fall by more than a factor 2
   * from one to the next, for this is what bisection gains for the same number of unknowns; otherwise the element is
   * bisected. Reference triads are resolved to the same number.
   *
   * Shells keep their degree. The difference of the two solutions is the error of a cell; what of it has the highest
   * degrees along each coordinate says which cut would take it away. Cuts go through strips of cells, across all
   * patches that meet, where the error per cell is a tenth of the largest or more: cells stay conforming, and boundary
   * layers are resolved where they are. What has no coordinates, grids and files, has all cells cut into four. Of a
   * mode the error is what no combination of the modes of the mesh itself has.
   *
   * What is solved is the static equilibrium at the full loads, and about it the modes if the input asks for them;
   * without loads the modes alone, each relative to its own energy. For beams only the finer solution is taken of
   * modes, and what its highest coefficient adds.
   *
   * Without such bodies the overrides are returned as they are, and nothing is solved. @throws NotConverged, InputError
   */
  std::vector<std::string> find_meshes(const Catalogue         &catalogue,
                                       const InputFile         &file,
                                       std::vector<std::string> overrides,
                                       Log                     &log,
                                       std::vector<MeshPass>   *passes = nullptr);
} // namespace samara

#endif
