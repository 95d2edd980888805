#include <samara/section/section_mesh.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Twice the area of a quadrilateral whose corners come line by line. */
    double
    turning_sense(const std::array<dealii::Point<2>, 4> &x)
    {
      const dealii::Tensor<1, 2> a = x[3] - x[0], b = x[2] - x[1];
      return a[0] * b[1] - a[1] * b[0];
    }
  } // namespace



  SectionMesh::SectionMesh(const std::vector<SectionPatch> &patches, const unsigned int degree, const double tolerance)
    : degree(degree)
    , mapping(degree)
  {
    std::vector<dealii::Point<2>>    places;
    std::vector<dealii::CellData<2>> data;
    for (unsigned int k = 0; k < patches.size(); ++k)
      {
        names.push_back(patches[k].name);
        tangents.push_back(patches[k].tangent);
        for (unsigned int j = 0; j + 1 < patches[k].v.size(); ++j)
          for (unsigned int i = 0; i + 1 < patches[k].u.size(); ++i)
            {
              cells.push_back({k, i, j, {}, patches[k].ply(i, j)});
              const auto          corners = set_corners(patches[k], cells.back());
              dealii::CellData<2> corner_numbers(4);
              for (unsigned int c = 0; c < 4; ++c)
                {
                  corner_numbers.vertices[c] = places.size();
                  places.push_back(corners[c]);
                }
              data.push_back(corner_numbers);
            }
      }
    if (cells.empty())
      throw std::invalid_argument("a section without cells");

    join_corners(patches, tolerance, places, data);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        auto corners = data[c].vertices;
        std::sort(corners.begin(), corners.end());
        if (std::adjacent_find(corners.begin(), corners.end()) != corners.end())
          throw std::invalid_argument(name_of(cells[c]) + " has two corners in one place");
      }
    order_consistently(data);
    triangulation.create_triangulation(places, data, {});

    const auto unit_points = dealii::FE_Q<2>(degree).get_unit_support_points();
    mapping.initialize(triangulation, [&](const dealii::Triangulation<2>::cell_iterator &cell) {
      const Cell                   &own = cells[cell->index()];
      std::vector<dealii::Point<2>> support;
      for (const auto &unit : unit_points)
        {
          const auto uv = parameters_at(own, unit);
          support.push_back(patches[own.patch].place(uv[0], uv[1]));
        }
      return support;
    });
    check();
    check_pieces();
    check_sides(!patches.front().corners.empty());
  }



  void
  SectionMesh::join_corners(const std::vector<SectionPatch>  &patches,
                            const double                      tolerance,
                            std::vector<dealii::Point<2>>    &places,
                            std::vector<dealii::CellData<2>> &data) const
  {
    if (patches.front().corners.empty())
      {
        dealii::SubCellData       nothing;
        std::vector<unsigned int> all;
        return dealii::GridTools::delete_duplicated_vertices(places, data, nothing, all, tolerance);
      }
    std::map<unsigned int, unsigned int> known; // by the number in the file
    std::vector<dealii::Point<2>>        kept;
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const SectionPatch &patch = patches[cells[c].patch];
          AssertDimension(patch.corners.size(), 4);
          const auto        &uv     = cells[c].parameters[k];
          const unsigned int number = patch.corners[(uv[0] == patch.u[0] ? 0 : 1) + (uv[1] == patch.v[0] ? 0 : 2)];
          const auto         first  = known.emplace(number, kept.size());
          if (first.second)
            kept.push_back(places[data[c].vertices[k]]);
          data[c].vertices[k] = first.first->second;
        }
    places = kept;
  }



  std::array<dealii::Point<2>, 4>
  SectionMesh::set_corners(const SectionPatch &patch, Cell &cell)
  {
    std::array<dealii::Point<2>, 4> corners;
    for (unsigned int c = 0; c < 4; ++c)
      {
        cell.parameters[c] = {patch.u[cell.i + c % 2], patch.v[cell.j + c / 2]};
        corners[c]         = patch.place(cell.parameters[c][0], cell.parameters[c][1]);
      }
    if (turning_sense(corners) < 0)
      {
        // the patch is mirrored: go round the other way
        std::swap(corners[1], corners[2]);
        std::swap(cell.parameters[1], cell.parameters[2]);
      }
    return corners;
  }



  void
  SectionMesh::order_consistently(std::vector<dealii::CellData<2>> &data)
  {
    // lines must have the same direction in both cells they belong to; corners change their order, parameters with them
    AssertDimension(data.size(), cells.size());
    const std::vector<dealii::CellData<2>> before = data;
    dealii::GridTools::consistently_order_cells(data);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const auto old = cells[c].parameters;
        for (unsigned int k = 0; k < 4; ++k)
          {
            const auto &from       = before[c].vertices;
            cells[c].parameters[k] = old[std::find(from.begin(), from.end(), data[c].vertices[k]) - from.begin()];
          }
      }
  }



  std::string
  SectionMesh::name_of(const Cell &cell) const
  {
    const std::string &name = names[cell.patch];
    return "cell (" + std::to_string(cell.i) + ", " + std::to_string(cell.j) + ") of " +
           (name.empty() ? "patch " + std::to_string(cell.patch) : name);
  }



  dealii::Point<2>
  SectionMesh::parameters_at(const Cell &cell, const dealii::Point<2> &unit) const
  {
    const auto            &p = cell.parameters;
    const dealii::Point<2> uv(p[0] + unit[0] * (p[1] - p[0]) + unit[1] * (p[2] - p[0]));
    return uv; // cells are rectangles in the parameters
  }



  Matrix3
  SectionMesh::material_axes(const unsigned int cell, const dealii::Point<2> &place, const Eigen::Matrix2d &J) const
  {
    AssertIndexRange(cell, cells.size());
    const auto     &p = cells[cell].parameters;
    Eigen::Vector2d t;
    if (const auto &tangent = tangents[cells[cell].patch])
      t = tangent(place).normalized();
    else
      {
        Eigen::Matrix2d W; // derivative of the parameters
        for (unsigned int d = 0; d < 2; ++d)
          {
            W(d, 0) = p[1][d] - p[0][d];
            W(d, 1) = p[2][d] - p[0][d];
          }
        t = (J * W.inverse().col(0)).normalized();
      }
    const double c = std::cos(cells[cell].ply.angle), s = std::sin(cells[cell].ply.angle);
    Matrix3      R;
    R.col(0) << c, s * t(0), s * t(1);
    R.col(1) << -s, c * t(0), c * t(1);
    R.col(2) << 0, -t(1), t(0);
    return R;
  }



  void
  SectionMesh::check() const
  {
    // Jacobians at the points of integration
    const dealii::FE_Q<2>   fe(degree);
    const dealii::QGauss<2> quadrature(degree + 1);
    dealii::FEValues<2>     values(mapping, fe, quadrature, dealii::update_jacobians);
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        values.reinit(cell);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          if (!(values.jacobian(q).determinant() > 0))
            {
              const Cell &own = cells[cell->active_cell_index()];
              throw std::invalid_argument(name_of(own) + " is turned inside out somewhere");
            }
      }
  }



  void
  SectionMesh::check_pieces() const
  {
    std::vector<unsigned int> piece(triangulation.n_active_cells(), 0), queue(1, 0);
    piece[0] = 1;
    std::vector<dealii::Triangulation<2>::active_cell_iterator> by_index;
    for (const auto &cell : triangulation.active_cell_iterators())
      by_index.push_back(cell);
    while (!queue.empty())
      {
        const auto cell = by_index[queue.back()];
        queue.pop_back();
        for (const unsigned int f : cell->face_indices())
          if (!cell->at_boundary(f) && piece[cell->neighbor(f)->active_cell_index()] == 0)
            {
              piece[cell->neighbor(f)->active_cell_index()] = 1;
              queue.push_back(cell->neighbor(f)->active_cell_index());
            }
      }
    const auto lost = std::find(piece.begin(), piece.end(), 0u);
    if (lost != piece.end())
      {
        const Cell &own = cells[lost - piece.begin()];
        throw std::invalid_argument("the section is not in one piece: " + name_of(own) +
                                    " does not hang together with the first cell");
      }
  }
} // namespace samara
