#ifndef samara_cosserat_shell_mesh_h
#define samara_cosserat_shell_mesh_h

#include <samara/base/surface_function.h>
#include <samara/cosserat/element_table.h>
#include <samara/cosserat/patch_mesh.h>
#include <samara/rotation/rotation.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace samara
{
  struct ImportedMesh;

  /** A patch as users write it: x, y, z [m] as functions of u and v from 0 to 1. */
  struct ShellPatch
  {
    std::array<SurfaceFunction, 3> position;
    PatchMesh                      mesh;
  };



  /**
   * Quadrilaterals of one degree in space, the order of their nodes that of ElementTable<2>. Cells that share a side
   * share its nodes; a side may belong to more than two (branches). Normals are g₁ × g₂; those of neighbours are on the
   * same side of the surface.
   */
  class ShellMesh
  {
  public:
    explicit ShellMesh(const ElementTable<2> &table)
      : table(table)
    {}

    struct Cell
    {
      std::vector<unsigned int> nodes;
      unsigned int              patch     = 0;
      bool                      exchanged = false; ///< whether its unit coordinates go along v and u, not u and v
    };

    /** Side 0, 1: the first unit coordinate is 0, 1; side 2, 3: the second is. */
    struct Side
    {
      unsigned int cell, side;
    };

    /** Whether cells of degree 1 may be other than parallelograms: where shear is taken at the sides. */
    bool takes_any_cell = false;

    std::vector<Vector3>                     nodes; ///< [m]
    std::vector<Cell>                        cells;
    std::map<std::string, std::vector<Side>> edges; ///< by name

    std::map<std::string, std::vector<unsigned int>> regions; ///< cells by name: "patch 1", "region skin"
    std::map<std::string, std::vector<unsigned int>> points;  ///< nodes by name: "point tip"

    /** Where a node has been made: patch and coordinates on it. */
    struct Origin
    {
      unsigned int patch;
      double       u, v;
      unsigned int node;
    };
    std::vector<Origin> origins;

    /** The cells of a patch that has coordinates: first + i + j n_u is the one in column i and row j. */
    struct PatchCells
    {
      unsigned int first;
      PatchMesh    mesh;

      unsigned int
      number(const unsigned int i, const unsigned int j) const
      {
        return first + i + j * mesh.u.n();
      }
    };
    std::vector<PatchCells> patch_cells;

    /**
     * Add a patch, the region "patch 1" and so on; its edges are "edge u0", "edge u1", "edge v0", "edge v1", behind
     * "patch 2 " for the second and so on.
     * @throws std::invalid_argument if a place is not finite.
     */
    void add_patch(const ShellPatch &patch);

    /**
     * Add a grid of deal.II's GridGenerator, "hyper_sphere" with the arguments "0, 0, 0 : 1", each cell refined so many
     * times into four, curved as its manifold says; edges are "edge 0" and so on by their boundary ids, regions "region
     * 0" and so on by ids of materials.
     * @throws std::invalid_argument with what deal.II says of function and arguments.
     */
    void add_grid(const std::string &function, const std::string &arguments, unsigned int refinements);
    void add_triangulation(const dealii::Triangulation<2, 3> &triangulation);

    /**
     * Add the cells of a file. If they are to be @p curved, sides are cubics between the tangent planes at their ends,
     * those of the averaged normals of the straight cells that differ by less than the angle @p crease [rad]; where
     * planes meet at a crease, sides follow the crease. Edges are "edge NAME" by the names of lines and of sets of
     * nodes: sides that belong to one cell, or, where a set has none of these, those inside; regions are "region NAME",
     * points "point NAME", empty if no cell has a corner there. Cells that are there twice, since they are in two
     * groups, are one. Each cell is cut into four so many times, on the surface that the cells of the file have.
     * @throws std::invalid_argument for named lines that are no sides.
     */
    void add_cells(const ImportedMesh &mesh, bool curved, double crease, unsigned int refinements);

    /** Nodes at one place, as near as 1e-6 of the size of all, become one. @throws if a cell would lose a node by it.
     */
    void merge();

    /**
     * Make the normals of neighbours consistent, beginning with those of the first cell of each connected part, and
     * collect what sides belong to one cell only as "boundary". If @p sides_must_meet, boundaries must not touch.
     * @throws std::invalid_argument for a surface with one side only (Moebius), for cells that are not convex, for
     * those of degree 1 that are no parallelograms, and for boundaries that touch without sharing nodes.
     */
    void finish(bool sides_must_meet);

    /**
     * Add "line u 0.5" or "line v 0.5" to the edges: the sides of cells on which that coordinate of the first patch is
     * constant.
     * @throws std::invalid_argument if the mesh has none there.
     */
    void name_line(const std::string &line);

    /** Whether the mesh has sides there. @throws std::invalid_argument if @p line is not written like that */
    bool has_line(const std::string &line) const;

    /** Numbers of the nodes of a side, along it. */
    std::vector<unsigned int> nodes_of(const Side &side) const;

    /** A side with its nodes in the direction in which an edge is walked. */
    struct Step
    {
      unsigned int              cell;
      std::vector<unsigned int> nodes;
    };
    /** The sides of a named edge one behind the other, from one of its ends if it has ends; pieces follow each other.
     */
    std::vector<Step> walk(const std::string &edge) const;

    /** Shares of the length of a side in its nodes, by the Gauss–Lobatto rule [m]; @p side as of nodes_of(). */
    std::vector<double> lengths_of(const std::vector<unsigned int> &side) const;

    /** Shares of the area of a named region, or of the length of a named edge, in its nodes, by the same rule [m^2, m].
     */
    std::map<unsigned int, double> shares_of(const std::string &edge_or_region) const;

    /** Arc lengths of the nodes of a side from its first one [m]. */
    std::vector<double> abscissae_of(const std::vector<unsigned int> &side) const;

    /** x,₁ and x,₂ of a cell at one of its nodes. */
    std::array<Vector3, 2> tangents(const Cell &cell, unsigned int node) const;

    /** Of each cell the numbers of two strips: all cells that are cut together if its first unit coordinate is to be
     * halved, for what is cut across a side is cut on both sides of it; and those for the second. */
    std::vector<std::array<unsigned int, 2>> strips() const;

    /** The meshes of the patches with the strips of these numbers cut in two. */
    std::vector<PatchMesh> refined(const std::vector<bool> &strips) const;

    /** A cell and unit coordinates in it. */
    struct PlaceInCell
    {
      unsigned int cell;
      double       xi[2];
    };
    /** Where the place of a cell is in another mesh of the same patches, or of the same cells. */
    PlaceInCell same_place(const PlaceInCell &place, const ShellMesh &other) const;

    double size() const; ///< diagonal of the box about all nodes [m]

    /** "the cell of patch 2 about (1, 2, 0)", for messages */
    std::string name_of(unsigned int cell) const;

  private:
    const ElementTable<2> &table;
    unsigned int           n_patches = 0;

    void name_edges(const ImportedMesh                                                       &mesh,
                    const std::map<std::pair<unsigned int, unsigned int>, std::vector<Side>> &sides,
                    unsigned int                                                              n);

    /** The sides of "line u 0.5"; @p nearest becomes the coordinate of the nodes nearest to it. */
    std::vector<Side> sides_of_line(const std::string &line, double &nearest) const;

    /** The derivative of the curve through the nodes of a side at a unit coordinate [m]. */
    Vector3 slope(const std::vector<unsigned int> &side, double xi) const;

    void check_shapes() const;
    void orient();
    /** Exchange the unit coordinates of these cells. */
    void turn_over(const std::vector<int> &turned);
    void check_contacts() const;

    /** Of a point from a side, given by its nodes [m]. */
    double distance(const Vector3 &x, const std::vector<unsigned int> &side) const;

    /** The sides of cells by the sorted numbers of their nodes. */
    std::map<std::vector<unsigned int>, std::vector<Side>> cells_at_sides() const;
  };

  /** "(1, 0.5, 0)", for messages. */
  std::string place_text(const Vector3 &x);

  /** The unit coordinates of Gauss–Lobatto nodes along one direction, in order. */
  std::vector<double> line_nodes(const ElementTable<2> &table);
} // namespace samara

#endif
