// Nodes and cells of shells: patches, merging, orientation, and what is refused.

#include <samara/base/text.h>
#include <samara/cosserat/shell_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace samara
{
  namespace
  {
    std::string
    place(const Vector3 &x)
    {
      return "(" + number_to_text("%.4g", x(0)) + ", " + number_to_text("%.4g", x(1)) + ", " +
             number_to_text("%.4g", x(2)) + ")";
    }

    /** The unit coordinates of Gauss–Lobatto nodes along one direction. */
    std::vector<double>
    line_nodes(const ElementTable<2> &table)
    {
      std::vector<double> xi;
      for (const auto &node : table.nodes)
        if (node[1] < 1e-12)
          xi.push_back(node[0]);
      std::sort(xi.begin(), xi.end());
      return xi;
    }
  } // namespace



  PatchElements
  Value<PatchElements>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    const auto words = split_top_level(text, ',');
    if (words.size() != 2)
      throw std::invalid_argument("<" + text + ">: write two numbers of elements, along u and along v: 4, 8");
    const PatchElements result{Value<unsigned int>::read(words[0], "", quantities),
                               Value<unsigned int>::read(words[1], "", quantities)};
    for (const unsigned int n : {result.u, result.v})
      if (n == 0 || n > 2000)
        throw std::invalid_argument("<" + text + ">: a patch has 1 to 2000 elements along u and along v");
    return result;
  }



  std::string
  Value<PatchElements>::write(const PatchElements &value)
  {
    return std::to_string(value.u) + ", " + std::to_string(value.v);
  }



  PatternPointer
  Value<PatchElements>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  void
  ShellMesh::add_patch(const ShellPatch &patch)
  {
    const std::vector<double> xi = line_nodes(table);
    const unsigned int        p = table.degree, n_u = patch.elements.u * p + 1, n_v = patch.elements.v * p + 1;
    const unsigned int        number     = n_patches++;
    const unsigned int        first      = nodes.size();
    const auto                coordinate = [&](const unsigned int i, const unsigned int n) {
      return i == n * p ? 1. : (i / p + xi[i % p]) / n;
    };
    for (unsigned int j = 0; j < n_v; ++j)
      for (unsigned int i = 0; i < n_u; ++i)
        {
          const double  u = coordinate(i, patch.elements.u), v = coordinate(j, patch.elements.v);
          const Vector3 x(patch.position[0](u, v), patch.position[1](u, v), patch.position[2](u, v));
          if (!x.allFinite())
            throw std::invalid_argument("patch " + std::to_string(number + 1) + " has no place at u = " +
                                        number_to_text(u) + ", v = " + number_to_text(v) + ": it is not finite there");
          origins.push_back({number, u, v, static_cast<unsigned int>(nodes.size())});
          nodes.push_back(x);
        }
    const std::string prefix = number == 0 ? "" : "patch " + std::to_string(number + 1) + " ";
    for (unsigned int j = 0; j < patch.elements.v; ++j)
      for (unsigned int i = 0; i < patch.elements.u; ++i)
        {
          const unsigned int index = cells.size();
          cells.emplace_back();
          cells.back().patch = number;
          for (const auto &at : table.nodes)
            {
              const auto along = [&](const unsigned int d) {
                return std::lower_bound(xi.begin(), xi.end(), at[d] - 1e-9) - xi.begin();
              };
              cells.back().nodes.push_back(first + i * p + along(0) + n_u * (j * p + along(1)));
            }
          if (i == 0)
            edges[prefix + "edge u0"].push_back({index, 0});
          if (i + 1 == patch.elements.u)
            edges[prefix + "edge u1"].push_back({index, 1});
          if (j == 0)
            edges[prefix + "edge v0"].push_back({index, 2});
          if (j + 1 == patch.elements.v)
            edges[prefix + "edge v1"].push_back({index, 3});
        }
  }



  double
  ShellMesh::size() const
  {
    if (nodes.empty())
      return 0;
    Vector3 low = nodes[0], high = nodes[0];
    for (const auto &x : nodes)
      {
        low  = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    return (high - low).norm();
  }



  void
  ShellMesh::merge()
  {
    const double tolerance = 1e-6 * size();
    if (tolerance == 0)
      throw std::invalid_argument("all of the surface is at one point");
    // cubes of twice the tolerance; what is near is in a cube or one of its neighbours
    using Cube = std::array<long, 3>;
    struct Hash
    {
      std::size_t
      operator()(const Cube &c) const
      {
        return c[0] * 73856093l ^ c[1] * 19349663l ^ c[2] * 83492791l;
      }
    };
    const Vector3                                             corner = nodes[0];
    std::unordered_map<Cube, std::vector<unsigned int>, Hash> cubes;
    std::vector<unsigned int>                                 kept_as(nodes.size());
    std::vector<Vector3>                                      kept;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Cube cube;
        for (unsigned int d = 0; d < 3; ++d)
          cube[d] = std::lround((nodes[i](d) - corner(d)) / (2 * tolerance));
        int found = -1;
        for (unsigned int k = 0; k < 27 && found < 0; ++k)
          {
            const auto near = cubes.find({cube[0] + k % 3 - 1, cube[1] + k / 3 % 3 - 1, cube[2] + k / 9 - 1});
            if (near != cubes.end())
              for (const unsigned int j : near->second)
                if ((kept[j] - nodes[i]).norm() <= tolerance)
                  found = j;
          }
        if (found < 0)
          {
            found = kept.size();
            kept.push_back(nodes[i]);
            cubes[cube].push_back(found);
          }
        kept_as[i] = found;
      }
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        for (auto &node : cells[i].nodes)
          node = kept_as[node];
        auto sorted = cells[i].nodes;
        std::sort(sorted.begin(), sorted.end());
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        if (twice != sorted.end())
          throw std::invalid_argument("the cell of patch " + std::to_string(cells[i].patch + 1) + " near " +
                                      place(kept[*twice]) +
                                      " has two nodes at one place: leave a hole there, or cover it by other patches");
      }
    for (auto &origin : origins)
      origin.node = kept_as[origin.node];
    nodes = kept;
  }



  std::vector<unsigned int>
  ShellMesh::nodes_of(const Side &side) const
  {
    const unsigned int                           across = side.side / 2;
    std::vector<std::pair<double, unsigned int>> along;
    for (unsigned int a = 0; a < table.n_nodes; ++a)
      if (std::abs(table.nodes[a][across] - side.side % 2) < 1e-12)
        along.emplace_back(table.nodes[a][1 - across], cells[side.cell].nodes[a]);
    std::sort(along.begin(), along.end());
    std::vector<unsigned int> result;
    for (const auto &node : along)
      result.push_back(node.second);
    return result;
  }



  std::vector<ShellMesh::Step>
  ShellMesh::walk(const std::string &edge) const
  {
    std::vector<Step>                                 steps;
    std::map<unsigned int, std::vector<unsigned int>> at_end; // steps by the nodes at their ends
    for (const auto &side : edges.at(edge))
      {
        steps.push_back({side.cell, nodes_of(side)});
        for (const auto node : {steps.back().nodes.front(), steps.back().nodes.back()})
          at_end[node].push_back(steps.size() - 1);
      }
    std::vector<bool> is_walked(steps.size(), false);
    std::vector<Step> result;
    const auto        go = [&](unsigned int i, unsigned int from) {
      for (;;)
        {
          is_walked[i] = true;
          result.push_back(steps[i]);
          auto &nodes = result.back().nodes;
          if (nodes.front() != from)
            std::reverse(nodes.begin(), nodes.end());
          from = nodes.back();
          const auto next =
            std::find_if(at_end[from].begin(), at_end[from].end(), [&](const unsigned int j) { return !is_walked[j]; });
          if (next == at_end[from].end())
            return;
          i = *next;
        }
    };
    // first what begins at an end, then what is closed
    for (const bool at_ends : {true, false})
      for (unsigned int i = 0; i < steps.size(); ++i)
        for (const auto node : {steps[i].nodes.front(), steps[i].nodes.back()})
          if (!is_walked[i] && (!at_ends || at_end[node].size() == 1))
            go(i, node);
    return result;
  }



  Vector3
  ShellMesh::slope(const std::vector<unsigned int> &side, const double s) const
  {
    const std::vector<double> xi  = line_nodes(table);
    Vector3                   sum = Vector3::Zero();
    for (unsigned int a = 0; a < side.size(); ++a)
      {
        double dL = 0;
        for (unsigned int m = 0; m < side.size(); ++m)
          {
            double term = 1;
            for (unsigned int b = 0; b < side.size(); ++b)
              if (b != a)
                term *= (b == m ? 1. : s - xi[b]) / (xi[a] - xi[b]);
            dL += m == a ? 0. : term;
          }
        sum += dL * nodes[side[a]];
      }
    return sum;
  }



  std::vector<double>
  ShellMesh::lengths_of(const std::vector<unsigned int> &side) const
  {
    const std::vector<double>      xi = line_nodes(table);
    const dealii::QGaussLobatto<1> lobatto(table.degree + 1);
    std::vector<double>            lengths;
    for (unsigned int a = 0; a < side.size(); ++a)
      lengths.push_back(lobatto.weight(a) * slope(side, xi[a]).norm());
    return lengths;
  }



  std::vector<double>
  ShellMesh::abscissae_of(const std::vector<unsigned int> &side) const
  {
    const std::vector<double> xi = line_nodes(table);
    const dealii::QGauss<1>   gauss(10);
    std::vector<double>       s(1, 0.);
    for (unsigned int a = 1; a < side.size(); ++a)
      {
        s.push_back(s.back());
        for (unsigned int g = 0; g < gauss.size(); ++g)
          s.back() += gauss.weight(g) * (xi[a] - xi[a - 1]) *
                      slope(side, xi[a - 1] + gauss.point(g)[0] * (xi[a] - xi[a - 1])).norm();
      }
    return s;
  }



  std::array<Vector3, 2>
  ShellMesh::tangents(const Cell &cell, const unsigned int node) const
  {
    std::array<Vector3, 2> g = {{Vector3::Zero(), Vector3::Zero()}};
    for (unsigned int a = 0; a < table.n_nodes; ++a)
      for (unsigned int d = 0; d < 2; ++d)
        g[d] += table.gradient_at_nodes[d](node, a) * nodes[cell.nodes[a]];
    return g;
  }



  std::string
  ShellMesh::name_of(const unsigned int cell) const
  {
    Vector3 middle = Vector3::Zero();
    for (const auto node : cells[cell].nodes)
      middle += nodes[node] / cells[cell].nodes.size();
    return "the cell " + (n_patches > 1 ? "of patch " + std::to_string(cells[cell].patch + 1) + " " : std::string()) +
           "about " + place(middle);
  }



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
                                        place(nodes[cell.nodes[a]]) + " is not on the side of its mean");
        // the vertices come first, in the order of the unit square
        const Vector3 &x0 = nodes[cell.nodes[0]], &x1 = nodes[cell.nodes[1]], &x2 = nodes[cell.nodes[2]],
                      &x3 = nodes[cell.nodes[3]];
        if (table.degree == 1 && (x0 - x1 - x2 + x3).norm() > 1e-6 * (x3 - x0).norm())
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
              throw std::invalid_argument("edges touch at " + place(x) +
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
