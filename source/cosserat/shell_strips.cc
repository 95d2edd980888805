// Refinement of the meshes of shells by strips: cells that can only be cut together.

#include <samara/base/disjoint_sets.h>
#include <samara/cosserat/shell_mesh.h>

namespace samara
{
  std::vector<std::array<unsigned int, 2>>
  ShellMesh::strips() const
  {
    // a cut that halves the first unit coordinate goes through sides 2 and 3, one that halves the second through 0, 1
    DisjointSets cuts(2 * cells.size());
    for (const auto &[nodes, sides] : cells_at_sides())
      for (const auto &side : sides)
        cuts.join(2 * side.cell + (side.side < 2), 2 * sides[0].cell + (sides[0].side < 2));
    std::map<unsigned int, unsigned int>     numbers;
    std::vector<std::array<unsigned int, 2>> result(cells.size());
    for (unsigned int i = 0; i < cells.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        result[i][d] = numbers.try_emplace(cuts.root_of(2 * i + d), numbers.size()).first->second;
    return result;
  }



  std::vector<PatchMesh>
  ShellMesh::refined(const std::vector<bool> &cut) const
  {
    const auto             of_cells = strips();
    std::vector<PatchMesh> result;
    for (const auto &patch : patch_cells)
      {
        // all cells of a column are in one strip, and so are those of a row
        const auto is_cut = [&](const unsigned int i, const unsigned int j, const unsigned int d) {
          const unsigned int cell = patch.number(i, j);
          return cut[of_cells[cell][cells[cell].exchanged ? 1 - d : d]];
        };
        std::vector<bool> columns, rows;
        for (unsigned int i = 0; i < patch.mesh.u.n(); ++i)
          columns.push_back(is_cut(i, 0, 0));
        for (unsigned int j = 0; j < patch.mesh.v.n(); ++j)
          rows.push_back(is_cut(0, j, 1));
        result.push_back({patch.mesh.u.halved(columns), patch.mesh.v.halved(rows)});
      }
    return result;
  }



  ShellMesh::PlaceInCell
  ShellMesh::same_place(const PlaceInCell &place, const ShellMesh &other) const
  {
    if (patch_cells.empty())
      return place;
    const Cell       &cell = cells[place.cell];
    const PatchCells &from = patch_cells[cell.patch], &to = other.patch_cells[cell.patch];
    const Division   *own[2] = {&from.mesh.u, &from.mesh.v}, *others[2] = {&to.mesh.u, &to.mesh.v};
    unsigned int      at[2]; // column and row, there
    double            xi[2];
    for (unsigned int d = 0; d < 2; ++d)
      {
        const unsigned int index = place.cell - from.first;
        const double       x =
          own[d]->at(d == 0 ? index % own[0]->n() : index / own[0]->n(), place.xi[cell.exchanged ? 1 - d : d]);
        at[d] = others[d]->piece(x);
        xi[d] = (x - others[d]->start(at[d])) / others[d]->length(at[d]);
      }
    PlaceInCell result{to.number(at[0], at[1]), {xi[0], xi[1]}};
    if (other.cells[result.cell].exchanged)
      std::swap(result.xi[0], result.xi[1]);
    return result;
  }
} // namespace samara
