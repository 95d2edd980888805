// Nodes and cells of shells: patches, merging, edges.

#include <samara/base/text.h>
#include <samara/cosserat/shell_mesh.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace samara
{
  std::string
  place_text(const Vector3 &x)
  {
    return "(" + number_to_text("%.4g", x(0)) + ", " + number_to_text("%.4g", x(1)) + ", " +
           number_to_text("%.4g", x(2)) + ")";
  }



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



  void
  ShellMesh::add_patch(const ShellPatch &patch)
  {
    const std::vector<double> xi  = line_nodes(table);
    const PatchMesh          &cut = patch.mesh;
    const unsigned int        p = table.degree, n_u = cut.u.n() * p + 1, n_v = cut.v.n() * p + 1;
    const unsigned int        number     = n_patches++;
    const unsigned int        first      = nodes.size();
    const auto                coordinate = [&](const unsigned int i, const Division &division) {
      return i == division.n() * p ? 1. : division.at(i / p, xi[i % p]);
    };
    for (unsigned int j = 0; j < n_v; ++j)
      for (unsigned int i = 0; i < n_u; ++i)
        {
          const double  u = coordinate(i, cut.u), v = coordinate(j, cut.v);
          const Vector3 x(patch.position[0](u, v), patch.position[1](u, v), patch.position[2](u, v));
          if (!x.allFinite())
            throw std::invalid_argument("patch " + std::to_string(number + 1) + " has no place at u = " +
                                        number_to_text(u) + ", v = " + number_to_text(v) + ": it is not finite there");
          origins.push_back({number, u, v, static_cast<unsigned int>(nodes.size())});
          nodes.push_back(x);
        }
    patch_cells.push_back({static_cast<unsigned int>(cells.size()), cut});
    const std::string prefix = number == 0 ? "" : "patch " + std::to_string(number + 1) + " ";
    for (unsigned int j = 0; j < cut.v.n(); ++j)
      for (unsigned int i = 0; i < cut.u.n(); ++i)
        {
          const unsigned int index = cells.size();
          cells.emplace_back();
          cells.back().patch = number;
          regions["patch " + std::to_string(number + 1)].push_back(index);
          for (const auto &at : table.nodes)
            {
              const auto along = [&](const unsigned int d) {
                return std::lower_bound(xi.begin(), xi.end(), at[d] - 1e-9) - xi.begin();
              };
              cells.back().nodes.push_back(first + i * p + along(0) + n_u * (j * p + along(1)));
            }
          if (i == 0)
            edges[prefix + "edge u0"].push_back({index, 0});
          if (i + 1 == cut.u.n())
            edges[prefix + "edge u1"].push_back({index, 1});
          if (j == 0)
            edges[prefix + "edge v0"].push_back({index, 2});
          if (j + 1 == cut.v.n())
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
                                      place_text(kept[*twice]) +
                                      " has two nodes at one place: leave a hole there, or cover it by other patches");
      }
    for (auto &origin : origins)
      origin.node = kept_as[origin.node];
    for (auto &point : points)
      for (auto &node : point.second)
        node = kept_as[node];
    nodes = kept;
  }



  std::vector<ShellMesh::Side>
  ShellMesh::sides_of_line(const std::string &line, double &nearest) const
  {
    double     place   = 0;
    const bool along_v = line.compare(0, 7, "line u ") == 0;
    if ((!along_v && line.compare(0, 7, "line v ") != 0) || !text_to_number(line.substr(7), place))
      throw std::invalid_argument("a line on a shell is written <line u 0.5> or <line v 0.5>, not <" + line + ">");
    constexpr double  rounding = 1e-6;
    std::vector<bool> is_on(nodes.size(), false);
    nearest = std::numeric_limits<double>::infinity();
    for (const Origin &origin : origins)
      if (origin.patch == 0)
        {
          const double at    = along_v ? origin.u : origin.v;
          is_on[origin.node] = is_on[origin.node] || std::abs(at - place) < rounding;
          if (std::abs(at - place) < std::abs(nearest - place))
            nearest = at;
        }
    std::vector<Side> sides;
    for (const auto &[numbers, of_cells] : cells_at_sides())
      if (std::all_of(numbers.begin(), numbers.end(), [&](const unsigned int node) { return is_on[node]; }))
        sides.push_back(of_cells.front());
    return sides;
  }



  bool
  ShellMesh::has_line(const std::string &line) const
  {
    double nearest = 0;
    return !sides_of_line(line, nearest).empty();
  }



  void
  ShellMesh::name_line(const std::string &line)
  {
    if (edges.count(line) > 0)
      return;
    double                  nearest = 0;
    const std::vector<Side> sides   = sides_of_line(line, nearest);
    if (sides.empty())
      throw std::invalid_argument("no sides of cells of the first patch are on <" + line + ">" +
                                  (std::isfinite(nearest) ? ": the nearest nodes have " + line.substr(5, 1) + " = " +
                                                              number_to_text("%.6g", nearest) :
                                                            ", which has no coordinates u and v"));
    edges[line] = sides;
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



  std::map<unsigned int, double>
  ShellMesh::shares_of(const std::string &edge_or_region) const
  {
    std::map<unsigned int, double> shares;
    const auto                     region = regions.find(edge_or_region);
    if (region != regions.end())
      for (const unsigned int i : region->second)
        for (unsigned int a = 0; a < table.n_nodes; ++a)
          {
            const auto g = tangents(cells[i], a);
            shares[cells[i].nodes[a]] += table.node_weights(a) * cross(g[0], g[1]).norm();
          }
    else
      for (const auto &step : walk(edge_or_region))
        {
          const auto lengths = lengths_of(step.nodes);
          for (unsigned int a = 0; a < lengths.size(); ++a)
            shares[step.nodes[a]] += lengths[a];
        }
    return shares;
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
           "about " + place_text(middle);
  }
} // namespace samara
