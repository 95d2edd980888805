// Cells of imported meshes: straight ones, or curved between the normals at their corners.

#include <samara/cosserat/imported_mesh.h>
#include <samara/cosserat/shell_mesh.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace samara
{
  namespace
  {
    double
    angle_between(const Vector3 &a, const Vector3 &b)
    {
      return std::atan2(cross(a, b).norm(), a.dot(b));
    }

    /**
     * Normals of straight cells at their corners, averaged over those that differ by less than the crease angle, on the
     * side of the cell's own.
     */
    std::vector<std::array<Vector3, 4>>
    corner_normals(const ImportedMesh &mesh, const double crease)
    {
      const auto own = [&](const unsigned int cell, const unsigned int i) {
        const auto    &q = mesh.quadrilaterals[cell];
        const Vector3 &x = mesh.vertices[q[i]];
        return Vector3(cross(mesh.vertices[q[(i + 1) % 4]] - x, mesh.vertices[q[(i + 3) % 4]] - x).normalized());
      };
      std::vector<std::vector<std::array<unsigned int, 2>>> at_vertex(mesh.vertices.size());
      for (unsigned int cell = 0; cell < mesh.quadrilaterals.size(); ++cell)
        for (unsigned int i = 0; i < 4; ++i)
          at_vertex[mesh.quadrilaterals[cell][i]].push_back({{cell, i}});
      std::vector<std::array<Vector3, 4>> result(mesh.quadrilaterals.size());
      for (const auto &corners : at_vertex)
        for (const auto &[cell, i] : corners)
          {
            const Vector3 n   = own(cell, i);
            Vector3       sum = Vector3::Zero();
            for (const auto &[other, j] : corners)
              {
                Vector3 m = own(other, j);
                if (m.dot(n) < 0) // cells of a file may be on either side
                  m = -m;
                if (angle_between(n, m) <= crease)
                  sum += m;
              }
            result[cell][i] = sum.normalized();
          }
      return result;
    }



    /** A side with what is known of the surface at its ends. */
    struct SideCurve
    {
      Vector3              x[2];
      std::vector<Vector3> normals[2]; ///< of the cells there, those that differ

      void
      add_normal(const unsigned int end, const Vector3 &n)
      {
        for (const auto &other : normals[end])
          if (std::min(angle_between(n, other), angle_between(-n, other)) < 1e-6)
            return;
        normals[end].push_back(n);
      }

      /** Direction of the curve at an end: in the tangent plane there, or along the line where two of them meet. */
      Vector3
      direction(const unsigned int end) const
      {
        const Vector3 chord = (x[1] - x[0]).normalized();
        const auto   &n     = normals[end];
        Vector3       t     = chord;
        if (n.size() == 1)
          t = chord - n[0] * n[0].dot(chord);
        else if (n.size() == 2)
          {
            t = cross(n[0], n[1]);
            if (t.dot(chord) < 0)
              t = -t;
          }
        // more meet at a corner of corners; what leaves the chord far is no smooth curve
        return t.norm() > 0 && angle_between(t, chord) < 0.8 ? Vector3(t.normalized()) : chord;
      }

      /** At s from 0 to 1: a cubic with the length of an arc of a circle for slope, of fourth order on circles. */
      Vector3
      at(const double s) const
      {
        const Vector3 t[2] = {direction(0), direction(1)};
        const double  half = 0.5 * angle_between(t[0], t[1]), chord = (x[1] - x[0]).norm();
        const double  length = half > 1e-9 ? chord * half / std::sin(half) : chord;
        return (1 + 2 * s) * (1 - s) * (1 - s) * x[0] + s * s * (3 - 2 * s) * x[1] +
               length * (s * (1 - s) * (1 - s) * t[0] - s * s * (1 - s) * t[1]);
      }
    };



    using Ends = std::pair<unsigned int, unsigned int>;

    Ends
    ends_of(const unsigned int a, const unsigned int b)
    {
      return {std::min(a, b), std::max(a, b)};
    }

    /** Corners of a cell in the order of its sides: along the second coordinate at 0 and 1, then along the first. */
    constexpr unsigned int ends[4][2] = {{0, 3}, {1, 2}, {0, 1}, {3, 2}};

    /** Where a node of a cell lies: in it, on a side, or at a corner. */
    struct PlaceOfFile
    {
      double u, v;
      bool   on_u, on_v;

      PlaceOfFile(const double u, const double v)
        : u(u)
        , v(v)
        , on_u(u < 1e-12 || u > 1 - 1e-12)
        , on_v(v < 1e-12 || v > 1 - 1e-12)
      {}

      unsigned int
      corner() const
      {
        return u < 0.5 ? (v < 0.5 ? 0 : 3) : (v < 0.5 ? 1 : 2);
      }
      unsigned int
      side() const
      {
        return on_u ? (u < 0.5 ? 0 : 1) : (v < 0.5 ? 2 : 3);
      }
    };



    /** The nodes that are made of a mesh: those at corners and on sides once for all cells that have them, those inside
     * of a cell of the file once for all that it is cut into. */
    class SharedNodes
    {
    public:
      explicit SharedNodes(std::vector<Vector3> &nodes)
        : nodes(nodes)
      {}

      /** The node of the cell @p c of the file at a place, which is at @p x unless it is a corner. */
      unsigned int
      number(const ImportedMesh &mesh, const unsigned int c, const PlaceOfFile &at, const Vector3 &x)
      {
        const auto &q = mesh.quadrilaterals[c];
        if (at.on_u && at.on_v)
          return once(of_vertex, q[at.corner()], mesh.vertices[q[at.corner()]]);
        if (!at.on_u && !at.on_v)
          return once(of_cell[c], {whole(at.u), whole(at.v)}, x);
        const unsigned int i = q[ends[at.side()][0]], j = q[ends[at.side()][1]];
        const double       s = at.on_u ? at.v : at.u;
        // Gauss–Lobatto nodes are symmetric
        return once(of_side[ends_of(i, j)], whole(i < j ? s : 1 - s), x);
      }

      /** The node at a vertex of the file, -1 if no cell has it. */
      int
      at_vertex(const unsigned int vertex) const
      {
        const auto found = of_vertex.find(vertex);
        return found == of_vertex.end() ? -1 : static_cast<int>(found->second);
      }

    private:
      template <typename Key>
      using Numbers = std::map<Key, unsigned int>;
      std::vector<Vector3>                                  &nodes;
      Numbers<unsigned int>                                  of_vertex;
      std::map<Ends, Numbers<long>>                          of_side; ///< by the place along it
      std::map<unsigned int, Numbers<std::pair<long, long>>> of_cell;

      static long
      whole(const double s)
      {
        return std::lround(1e8 * s);
      }

      template <typename Key>
      unsigned int
      once(Numbers<Key> &numbers, const Key &key, const Vector3 &x)
      {
        const auto found = numbers.find(key);
        if (found != numbers.end())
          return found->second;
        nodes.push_back(x);
        return numbers[key] = nodes.size() - 1;
      }
    };



    /** The curves of all sides. */
    std::map<Ends, SideCurve>
    curves_of_sides(const ImportedMesh &mesh, const double crease)
    {
      std::map<Ends, SideCurve> curves;
      const auto                normals = corner_normals(mesh, crease);
      for (unsigned int c = 0; c < mesh.quadrilaterals.size(); ++c)
        for (const auto &side : ends)
          {
            const auto  &q = mesh.quadrilaterals[c];
            unsigned int i = side[0], j = side[1];
            if (q[i] == q[j])
              throw std::invalid_argument("a cell has a corner twice: it is a triangle");
            const Ends key = ends_of(q[i], q[j]);
            if (q[i] != key.first)
              std::swap(i, j);
            auto &curve = curves[key];
            curve.x[0]  = mesh.vertices[key.first];
            curve.x[1]  = mesh.vertices[key.second];
            curve.add_normal(0, normals[c][i]);
            curve.add_normal(1, normals[c][j]);
          }
      return curves;
    }
    /** With cells that are there once for each of their groups as one. */
    ImportedMesh
    once(ImportedMesh mesh)
    {
      std::map<std::array<unsigned int, 4>, unsigned int> first;
      std::vector<unsigned int>                           kept_as;
      std::vector<std::array<unsigned int, 4>>            kept;
      for (const auto &cell : mesh.quadrilaterals)
        {
          auto sorted = cell;
          std::sort(sorted.begin(), sorted.end());
          const auto [found, is_new] = first.insert({sorted, static_cast<unsigned int>(kept.size())});
          if (is_new)
            kept.push_back(cell);
          kept_as.push_back(found->second);
        }
      mesh.quadrilaterals = kept;
      for (auto &region : mesh.regions)
        {
          auto &numbers = region.second;
          for (auto &cell : numbers)
            cell = kept_as[cell];
          std::sort(numbers.begin(), numbers.end());
          numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        }
      return mesh;
    }
  } // namespace



  void
  ShellMesh::add_cells(const ImportedMesh &given,
                       const bool          curved,
                       const double        crease,
                       const unsigned int  refinements)
  {
    const ImportedMesh                mesh   = once(given);
    const unsigned int                before = cells.size();
    const std::map<Ends, SideCurve>   curves = curves_of_sides(mesh, crease);
    const unsigned int                n      = 1u << refinements; // cells along each side of one of the file
    std::map<Ends, std::vector<Side>> sides;                      // n of each cell that has it
    SharedNodes                       shared(nodes);
    for (unsigned int c = 0; c < mesh.quadrilaterals.size(); ++c)
      {
        const auto &q     = mesh.quadrilaterals[c];
        const auto  along = [&](const unsigned int side, const double from_first) {
          const unsigned int i = q[ends[side][0]], j = q[ends[side][1]];
          const SideCurve   &curve = curves.at(ends_of(i, j));
          const double       s     = i < j ? from_first : 1 - from_first;
          return curved ? curve.at(s) : Vector3((1 - s) * curve.x[0] + s * curve.x[1]);
        };
        // of the four sides (Coons)
        const auto place = [&](const double u, const double v) {
          return Vector3((1 - u) * along(0, v) + u * along(1, v) + (1 - v) * along(2, u) + v * along(3, u) -
                         (1 - u) * (1 - v) * mesh.vertices[q[0]] - u * (1 - v) * mesh.vertices[q[1]] -
                         u * v * mesh.vertices[q[2]] - (1 - u) * v * mesh.vertices[q[3]]);
        };
        const unsigned int first = cells.size();
        for (unsigned int side = 0; side < 4; ++side)
          for (unsigned int k = 0; k < n; ++k)
            {
              const unsigned int across = side % 2 == 0 ? 0 : n - 1;
              sides[ends_of(q[ends[side][0]], q[ends[side][1]])].push_back(
                {first + (side < 2 ? across + n * k : k + n * across), side});
            }
        for (unsigned int k = 0; k < n * n; ++k)
          {
            cells.emplace_back();
            cells.back().patch = n_patches;
            for (const auto &unit : table.nodes)
              {
                const PlaceOfFile at((k % n + unit[0]) / n, (k / n + unit[1]) / n);
                cells.back().nodes.push_back(shared.number(mesh, c, at, place(at.u, at.v)));
              }
          }
      }
    name_edges(mesh, sides, n);
    for (const auto &[name, numbers] : mesh.regions)
      for (const unsigned int c : numbers)
        for (unsigned int k = 0; k < n * n; ++k)
          regions["region " + name].push_back(before + c * n * n + k);
    for (const auto &[name, vertices] : mesh.points)
      {
        auto &at = points["point " + name]; // empty if no cell has it
        for (const unsigned int vertex : vertices)
          if (const int node = shared.at_vertex(vertex); node >= 0)
            at.push_back(node);
      }
    ++n_patches;
  }



  void
  ShellMesh::name_edges(const ImportedMesh                                                       &mesh,
                        const std::map<std::pair<unsigned int, unsigned int>, std::vector<Side>> &sides,
                        const unsigned int                                                        n)
  {
    const auto add = [&](const std::string &name, const std::vector<Side> &of_first) {
      auto &edge = edges["edge " + name];
      edge.insert(edge.end(), of_first.begin(), of_first.begin() + n);
    };
    for (const auto &[name, lines] : mesh.lines)
      for (const auto &line : lines)
        {
          const auto found = sides.find(std::minmax(line[0], line[1]));
          if (found == sides.end())
            throw std::invalid_argument("a line of <" + name + "> is no side of a quadrilateral");
          add(name, found->second);
        }
    for (const auto &[name, vertices] : mesh.sets)
      {
        const std::set<unsigned int> in_set(vertices.begin(), vertices.end());
        bool                         has_boundary = false;
        // those of one cell; where there is none, those inside
        for (const bool inside : {false, true})
          for (const auto &[key, of_cells] : sides)
            if ((of_cells.size() > n) == inside && in_set.count(key.first) > 0 && in_set.count(key.second) > 0 &&
                (!inside || !has_boundary))
              {
                add(name, of_cells);
                has_boundary = has_boundary || !inside;
              }
      }
  }
} // namespace samara
