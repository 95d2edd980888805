// Shells on grids of deal.II's GridGenerator.

#include <samara/cosserat/shell_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <stdexcept>

namespace samara
{
  namespace
  {
    /** The last line that tells something of deal.II's long messages. */
    std::string
    reason(const dealii::ExceptionBase &error)
    {
      std::string text = error.get_exc_name();
      if (const char *what = error.what())
        {
          const std::string all = what, mark = "Additional information:";
          const auto        at = all.find(mark);
          if (at != std::string::npos)
            {
              text             = all.substr(at + mark.size());
              const auto begin = text.find_first_not_of(" \n"), end = text.find("\n\n", begin);
              text = text.substr(begin, end == std::string::npos ? end : end - begin);
            }
        }
      for (auto &c : text)
        c = c == '\n' ? ' ' : c;
      return text;
    }
  } // namespace



  void
  ShellMesh::add_grid(const std::string &function, const std::string &arguments, const unsigned int refinements)
  {
    dealii::Triangulation<2, 3> triangulation;
    try
      {
        dealii::GridGenerator::generate_from_name_and_arguments(triangulation, function, arguments);
      }
    catch (const dealii::ExceptionBase &error)
      {
        throw std::invalid_argument("GridGenerator::" + function + "(" + arguments +
                                    ") makes no surface: " + reason(error));
      }
    triangulation.refine_global(refinements);
    add_triangulation(triangulation);
  }



  void
  ShellMesh::add_triangulation(const dealii::Triangulation<2, 3> &triangulation)
  {
    const dealii::FE_Q<2, 3>     fe(table.degree);
    const dealii::MappingQ<2, 3> mapping(table.degree);
    dealii::DoFHandler<2, 3>     dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);
    const unsigned int first = nodes.size();
    nodes.resize(first + dof_handler.n_dofs());
    std::vector<dealii::types::global_dof_index> dofs(table.n_nodes);
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const unsigned int index = cells.size();
        cells.emplace_back();
        cells.back().patch = n_patches;
        regions["region " + std::to_string(cell->material_id())].push_back(index);
        for (unsigned int a = 0; a < table.n_nodes; ++a)
          {
            const dealii::Point<3> x = mapping.transform_unit_to_real_cell(cell, table.nodes[a]);
            nodes[first + dofs[a]]   = Vector3(x[0], x[1], x[2]);
            cells.back().nodes.push_back(first + dofs[a]);
          }
        for (unsigned int side = 0; side < 4; ++side)
          if (cell->at_boundary(side))
            edges["edge " + std::to_string(cell->face(side)->boundary_id())].push_back({index, side});
      }
    ++n_patches;
  }
} // namespace samara
