// Orientation of the cells of shells, and what is refused.

#include <samara/base/text.h>
#include <samara/cosserat/shell_mesh.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  std::map<std::vector<unsigned int>, std::vector<ShellMesh::Side>>
  ShellMesh::cells_at_sides() const
  {
    std::map<std::vector<unsigned int>, std::vector<Side>> result;
    for (unsigned int i = 0; i < cells.size(); ++i)
      for (unsigned int side = 0; side < 4; ++side)
        {
          auto key = nodes_of({i, side});
          std::sort(key.begin(), key.end());
          result[key].push_back({i, side});
        }
    return result;
  }



  void
  ShellMesh::finish(const bool sides_must_meet)
  {
    check_shapes();
    orient();
    for (const auto &[key, sides] : cells_at_sides())
      if (sides.size() == 1)
        edges["boundary"].push_back(sides[0]);
    if (edges["boundary"].empty())
      edges.erase("boundary");
    else if (sides_must_meet)
      check_contacts();
  }



  void
  ShellMesh::check_shapes() const
  {
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        const Cell          &cell = cells[i];
        std::vector<Vector3> normals;
        Vector3              mean = Vector3::Zero();
        for (unsigned int a = 0; a < table.n_nodes; ++a)
          {
            const auto g = tangents(cell, a);
            normals.push_back(cross(g[0], g[1]));
            mean += normals.back() / table.n_nodes;
          }
        for (unsigned int a = 0; a < table.n_nodes; ++a)
          if (!(normals[a].dot(mean) > 1e-3 * mean.squaredNorm()))
            throw std::invalid_argument(name_of(i) +
                                        " is not convex, has no area, or turns by more than a right angle: its normal "
                                        "at " +
                                        place_text(nodes[cell.nodes[a]]) + " is not on the side of its mean");
        // the vertices come first, in the order of the unit square
        const Vector3 &x0 = nodes[cell.nodes[0]], &x1 = nodes[cell.nodes[1]], &x2 = nodes[cell.nodes[2]],
                      &x3 = nodes[cell.nodes[3]];
        if (table.degree == 1 && !takes_any_cell && (x0 - x1 - x2 + x3).norm() > 1e-6 * (x3 - x0).norm())
          throw std::invalid_argument(name_of(i) + " is no parallelogram: shells of degree 1 bend there as if they "
                                                   "were many times stiffer; take Degree = 2 or more");
      }
  }



  void
  ShellMesh::orient()
  {
    // around a cell, counter-clockwise, sides 1 and 2 go along their coordinate, 0 and 3 against it
    const auto start = [&](const Side &side) {
      const auto along = nodes_of(side);
      return side.side == 1 || side.side == 2 ? along.front() : along.back();
    };
    std::vector<std::vector<std::pair<unsigned int, bool>>> neighbours(cells.size()); // and whether they disagree
    for (const auto &[key, sides] : cells_at_sides())
      if (sides.size() == 2)
        for (unsigned int k = 0; k < 2; ++k)
          neighbours[sides[k].cell].emplace_back(sides[1 - k].cell, start(sides[0]) == start(sides[1]));

    std::vector<int> turned(cells.size(), -1);
    for (unsigned int seed = 0; seed < cells.size(); ++seed)
      {
        if (turned[seed] >= 0)
          continue;
        turned[seed] = 0;
        std::vector<unsigned int> front(1, seed);
        while (!front.empty())
          {
            const unsigned int i = front.back();
            front.pop_back();
            for (const auto &[j, disagree] : neighbours[i])
              {
                const int wanted = turned[i] ^ static_cast<int>(disagree);
                if (turned[j] < 0)
                  {
                    turned[j] = wanted;
                    front.push_back(j);
                  }
                else if (turned[j] != wanted)
                  throw std::invalid_argument("the surface has one side only, as a Moebius strip: its normal comes "
                                              "back reversed to " +
                                              name_of(j).substr(4));
              }
          }
      }
    turn_over(turned);
  }



  void
  ShellMesh::turn_over(const std::vector<int> &turned)
  {
    std::vector<unsigned int> exchanged(table.n_nodes); // the node at (η, ξ)
    for (unsigned int a = 0; a < table.n_nodes; ++a)
      for (unsigned int b = 0; b < table.n_nodes; ++b)
        if (std::abs(table.nodes[a][0] - table.nodes[b][1]) + std::abs(table.nodes[a][1] - table.nodes[b][0]) < 1e-12)
          exchanged[a] = b;
    for (unsigned int i = 0; i < cells.size(); ++i)
      if (turned[i])
        {
          const auto before = cells[i].nodes;
          for (unsigned int a = 0; a < table.n_nodes; ++a)
            cells[i].nodes[a] = before[exchanged[a]];
          cells[i].exchanged = !cells[i].exchanged;
        }
    for (auto &edge : edges)
      for (auto &side : edge.second)
        if (turned[side.cell])
          side.side = (side.side + 2) % 4;
  }



  void
  ShellMesh::check_contacts() const
  {
    struct Curve
    {
      std::vector<unsigned int> nodes;
      Vector3                   low, high;
      double                    length;
    };
    std::vector<Curve>        curves;
    std::vector<unsigned int> on_boundary;
    for (const auto &side : edges.at("boundary"))
      {
        Curve c{nodes_of(side), {}, {}, 0};
        c.low = c.high = nodes[c.nodes[0]];
        for (unsigned int k = 1; k < c.nodes.size(); ++k)
          {
            c.length += (nodes[c.nodes[k]] - nodes[c.nodes[k - 1]]).norm();
            c.low  = c.low.cwiseMin(nodes[c.nodes[k]]);
            c.high = c.high.cwiseMax(nodes[c.nodes[k]]);
          }
        on_boundary.insert(on_boundary.end(), c.nodes.begin(), c.nodes.end());
        curves.push_back(c);
      }
    std::sort(on_boundary.begin(), on_boundary.end());
    on_boundary.erase(std::unique(on_boundary.begin(), on_boundary.end()), on_boundary.end());
    for (const auto &c : curves)
      {
        const double margin = 0.02 * c.length;
        for (const auto i : on_boundary)
          {
            const Vector3 &x = nodes[i];
            if ((x - c.low).minCoeff() < -margin || (c.high - x).minCoeff() < -margin ||
                std::find(c.nodes.begin(), c.nodes.end(), i) != c.nodes.end())
              continue;
            if (distance(x, c.nodes) < 1e-4 * c.length)
              throw std::invalid_argument("edges touch at " + place_text(x) +
                                          " without sharing a node: elements on both sides must have the same corners "
                                          "and the same number of nodes there");
          }
      }
  }



  double
  ShellMesh::distance(const Vector3 &x, const std::vector<unsigned int> &side) const
  {
    // of the curve through the nodes, sampled, then refined about the nearest sample
    const std::vector<double> xi = line_nodes(table);
    const auto                at = [&](const double s) {
      Vector3 y = Vector3::Zero();
      for (unsigned int a = 0; a < side.size(); ++a)
        {
          double L = 1;
          for (unsigned int b = 0; b < side.size(); ++b)
            if (b != a)
              L *= (s - xi[b]) / (xi[a] - xi[b]);
          y += L * nodes[side[a]];
        }
      return (y - x).norm();
    };
    double best = 0, step = 1. / 16;
    for (unsigned int k = 1; k <= 16; ++k)
      if (at(k * step) < at(best))
        best = k * step;
    for (; step > 1e-6; step /= 2)
      for (const double s : {best - step / 2, best + step / 2})
        if (s >= 0 && s <= 1 && at(s) < at(best))
          best = s;
    return at(best);
  }
} // namespace samara
