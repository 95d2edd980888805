#ifndef samara_cosserat_imported_mesh_h
#define samara_cosserat_imported_mesh_h

#include <samara/rotation/rotation.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace samara
{
  /**
   * Quadrilaterals of a file, as they are given, and triangles, whose last two corners are one. Cells hang together by
   * the vertices that the file gives them: two vertices at one place are a slit.
   */
  struct ImportedMesh
  {
    std::vector<Vector3>                     vertices;       ///< [m]
    std::vector<std::array<unsigned int, 4>> quadrilaterals; ///< corners around each

    /**
     * Of cells of second order, by their numbers: the vertices in the middles of their sides, the one between the first
     * two corners first, and the one in the middle of the cell where the file has it.
     */
    std::map<unsigned int, std::vector<unsigned int>> middles;

    /** Cells by the names that the file gives to surfaces (Gmsh) or sets of elements (Abaqus), ELSET. */
    std::map<std::string, std::vector<unsigned int>> regions;

    /** Sides of quadrilaterals by the names that the file gives to curves or sets of nodes. */
    std::map<std::string, std::vector<std::array<unsigned int, 2>>> lines;
    std::map<std::string, std::vector<unsigned int>>                sets; ///< of several vertices, by name

    /** Vertices by the names that the file gives to points (Gmsh), and sets of a single node (Abaqus). */
    std::map<std::string, std::vector<unsigned int>> points;

    /** "the points <a>, no curves, and the surfaces <b>, <c>", or that the file names nothing. */
    std::string groups() const;

    /** Vertices of cells that lie where another one with a smaller number does, to a millionth of the shortest side. */
    unsigned int n_coincident() const;

    /** Let vertices at one place be one, the first of them, and return how many are left out so. */
    unsigned int merge();

    /**
     * Merge them if @p wanted. Returns "in slit.msh 3 nodes lie at the places of others and are kept apart, as at a
     * slit; <Merge = true> joins them", or that they are joined; "" if there are none.
     */
    std::string take_coincident(bool wanted, const std::string &file);
  };

  /**
   * Reads a mesh of Gmsh (.msh, formats 2.2 and 4.1, text) or Abaqus (.inp: *NODE, *ELEMENT, *NSET, *ELSET). Names of
   * points, curves and surfaces are those of their physical groups, or the numbers of these.
   *
   * @param of_section whether triangles, and elements of second order (quadrilaterals of 8 and 9 nodes, triangles of 6),
   * are read, too; without it there are straight quadrilaterals only
   * @throws std::invalid_argument, naming the line, for what is not understood, and for other elements
   */
  ImportedMesh read_mesh_file(const std::string &file, bool of_section = false);
} // namespace samara

#endif
