#ifndef samara_section_section_mesh_h
#define samara_section_section_mesh_h

#include <samara/rotation/rotation.h>

#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/tria.h>

#include <functional>
#include <string>
#include <vector>

namespace samara
{
  /** The material of a cell of a section, and how it lies: the fibre is cos θ e₁ + sin θ t, t the tangent of the layer.
   */
  struct Ply
  {
    unsigned int material = 0;
    double       angle    = 0; ///< θ [rad]
  };



  /**
   * A part of a section: the image of the rectangle of parameters that @p u and @p v divide into cells. Layers run
   * along u: their tangent t is the derivative of @p place with respect to u, at each point.
   */
  struct SectionPatch
  {
    std::function<dealii::Point<2>(double u, double v)> place; ///< (x₂, x₃) [m]
    std::vector<double>                                 u, v;  ///< ends of the cells, ascending
    /** Of the cell (i, j) of the rectangle. */
    std::function<Ply(unsigned int i, unsigned int j)> ply;
    /** What it is called in complaints, if not by its number; and in tables, where what has one name is one. */
    std::string name = "", group = "";
    /** The tangent of the layers at a place, where it is not that of u. */
    std::function<Eigen::Vector2d(const dealii::Point<2> &place)> tangent = {};
    /**
     * Of a patch of a single cell the numbers of its corners, at (u, v) line by line: patches that have them hang
     * together where these are the same, others where their corners are at one place. All patches of a mesh, or none.
     */
    std::vector<unsigned int> corners = {};
  };



  /**
   * Quadrilaterals of a cross-section in the plane (x₂, x₃), from mapped patches that share their points where they
   * meet. Cells have the shape of polynomials of the degree of the elements, through the Gauss–Lobatto points of their
   * patch.
   */
  class SectionMesh
  {
  public:
    /**
     * @param tolerance within which points of different patches are one [m]
     * @throws std::invalid_argument if a cell is turned inside out, has no area or has two corners in one place, with
     * the number of the patch and the position of the cell; if the patches do not hang together; or if corners of
     * cells hang: they lie on a side, between its ends, and either corners have no numbers, or sides that do have those
     * corners lead from one end to the other.
     */
    SectionMesh(const std::vector<SectionPatch> &patches, unsigned int degree, double tolerance);

    const unsigned int       degree;
    dealii::Triangulation<2> triangulation;
    dealii::MappingQCache<2> mapping;

    /**
     * Corners that lie on free sides of cells that do not have them, as along a slit whose sides are cut differently.
     */
    unsigned int n_touching = 0;

    const Ply &
    ply(const unsigned int cell) const
    {
      return cells[cell].ply;
    }

    /**
     * The axes of the material at the point @p place of a cell, with the Jacobian @p J of its mapping: columns are the
     * fibre, the direction across it in the layer, and the normal of the layer, in the axes 1 (along the beam), 2, 3.
     */
    Matrix3 material_axes(unsigned int cell, const dealii::Point<2> &place, const Eigen::Matrix2d &J) const;

  private:
    struct Cell
    {
      unsigned int                    patch, i, j;
      std::array<dealii::Point<2>, 4> parameters; ///< of the corners, in the order of the triangulation
      Ply                             ply;
    };
    std::vector<Cell>                                                     cells;
    std::vector<std::string>                                              names;    ///< of the patches
    std::vector<std::function<Eigen::Vector2d(const dealii::Point<2> &)>> tangents; ///< likewise

    std::string      name_of(const Cell &cell) const;
    dealii::Point<2> parameters_at(const Cell &cell, const dealii::Point<2> &unit) const;
    void             check() const;
    void             check_pieces() const;
    /** Sets n_touching. */
    void check_sides(bool has_numbers);
    /** Whether a place, near the @p share of side @p face of a cell, lies on it between its ends, and at which share. */
    bool lies_on(const dealii::Triangulation<2>::active_cell_iterator &cell,
                 unsigned int                                          face,
                 const dealii::Point<2>                               &place,
                 double                                               &share) const;

    /** Parameters of the corners of a cell, line by line, with a positive area; returns their places. */
    static std::array<dealii::Point<2>, 4> set_corners(const SectionPatch &patch, Cell &cell);
    /** Let corners with one number of patches be one, or corners at one place. */
    void join_corners(const std::vector<SectionPatch>  &patches,
                      double                            tolerance,
                      std::vector<dealii::Point<2>>    &places,
                      std::vector<dealii::CellData<2>> &data) const;
    /** Let lines have one direction in all cells, and parameters follow. */
    void order_consistently(std::vector<dealii::CellData<2>> &data);
  };
} // namespace samara

#endif
