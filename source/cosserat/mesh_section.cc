#include <samara/base/text.h>
#include <samara/cosserat/mesh_section.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace samara
{
  MeshGroupText
  Value<MeshGroupText>::read(const std::string &text, const std::string &, const Quantities &)
  {
    const auto pieces = split_top_level(text, ',');
    if (pieces.size() < 2 || pieces.size() > 4 || pieces[0].empty() || pieces[1].empty())
      throw std::invalid_argument("<" + text +
                                  ">: a group is written <group, material>, or with the angle of its fibres and the "
                                  "direction of its layers, <spar, carbon, 30, 90>; the next one behind a semicolon.");
    MeshGroupText result{pieces[0], pieces[1]};
    if (pieces.size() > 2 && !text_to_number(pieces[2], result.angle))
      throw std::invalid_argument("<" + pieces[2] + "> in <" + text +
                                  ">: the angle of fibres is a number, in degrees.");
    if (pieces.size() > 3)
      result.layer = pieces[3];
    return result;
  }



  std::string
  Value<MeshGroupText>::write(const MeshGroupText &value)
  {
    return value.group + ", " + value.material + ", " + number_to_text(value.angle) + ", " + value.layer;
  }



  PatternPointer
  Value<MeshGroupText>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  void
  MeshSection::add_parameters(Parameters &prm)
  {
    prm.add_file("Mesh file",
                 file,
                 "Mesh of Gmsh (.msh, text) or Abaqus (.inp) of quadrilaterals and triangles, straight or of second "
                 "order; its x and y are axes 2 and 3. Relative to the .prm file that says it.");
    prm.add(
      "Merge",
      merges,
      "Whether nodes of the file at one place are one node; without it cells hang together by the nodes that they "
      "have in the file, and two nodes at one place are a slit.");
    prm.add("Length unit", scale, "One in the file is this long [m].", dealii::Patterns::Double(0));
    prm.add(
      "Groups",
      groups,
      "What the physical groups (Gmsh) or sets of elements (Abaqus) are made of: group, material, angle of the "
      "fibres, direction of the layers; ... Both angles in degrees: fibres turn from axis 1 towards the layer, and "
      "layers from axis 2 towards axis 3. In place of the second the name of a group of curves that the layers "
      "follow, counter-clockwise about the middle of the section.");
    AnalysedSection::add_parameters(prm);
  }



  namespace
  {
    using Place = dealii::Point<2>;

    /** Tangents of a group of curves, the nearest one of a place; counter-clockwise about a point. */
    class NearestTangent
    {
    public:
      NearestTangent(const std::vector<std::array<unsigned int, 2>> &lines,
                     const std::vector<Place>                       &x,
                     const Place                                    &middle)
      {
        // where two lines meet without a kink the tangent is the mean of both
        std::map<unsigned int, Eigen::Vector2d> sums;
        std::vector<Eigen::Vector2d>            own;
        for (const auto &line : lines)
          {
            Eigen::Vector2d t(x[line[1]][0] - x[line[0]][0], x[line[1]][1] - x[line[0]][1]);
            const Place     m(0.5 * (x[line[0]] + x[line[1]]) - middle);
            if (m[0] * t(1) - m[1] * t(0) < 0)
              t = -t;
            own.push_back(t.normalized());
            for (const auto v : line)
              sums.emplace(v, Eigen::Vector2d::Zero()).first->second += own.back();
          }
        constexpr double smooth = 0.95; // cosine of 18 degrees
        for (std::size_t i = 0; i < lines.size(); ++i)
          {
            Piece piece{x[lines[i][0]], x[lines[i][1]], own[i], own[i]};
            for (const unsigned int end : {0u, 1u})
              if (const Eigen::Vector2d mean = sums.at(lines[i][end]).normalized(); mean.dot(own[i]) > smooth)
                (end == 0 ? piece.t_a : piece.t_b) = mean;
            pieces.push_back(piece);
          }
      }

      Eigen::Vector2d
      operator()(const Place &x) const
      {
        double          nearest = std::numeric_limits<double>::infinity();
        Eigen::Vector2d result(1, 0);
        for (const Piece &piece : pieces)
          {
            const auto   ab       = piece.b - piece.a;
            const double u        = std::min(1., std::max(0., (x - piece.a) * ab / ab.norm_square()));
            const double distance = (x - piece.a - u * ab).norm_square();
            if (distance < nearest)
              {
                nearest = distance;
                result  = (1 - u) * piece.t_a + u * piece.t_b;
              }
          }
        return result.normalized();
      }

    private:
      struct Piece
      {
        Place           a, b;
        Eigen::Vector2d t_a, t_b;
      };
      std::vector<Piece> pieces;
    };



    std::vector<std::string>
    names_in(const std::map<std::string, std::vector<unsigned int>> &regions)
    {
      std::vector<std::string> result;
      for (const auto &[name, cells] : regions)
        result.push_back(name);
      return result;
    }



    /** The nodes of a cell: its corners, and those in the middles of its sides and in its own, if it has them. */
    struct CellNodes
    {
      std::array<unsigned int, 4> corners; ///< of a triangle the last two are one
      std::vector<unsigned int>   middles; ///< none, of the sides, or of the sides and the cell

      unsigned int
      n_corners() const
      {
        return corners[2] == corners[3] ? 3 : 4;
      }
    };

    /** Shape functions of the two ends and the middle of (0, 1), without the middle linear ones. */
    std::array<double, 3>
    of_interval(const double t, const bool has_middle)
    {
      if (!has_middle)
        return {{1 - t, 0, t}};
      return {{(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)}};
    }

    /**
     * Places of a cell over the unit square, or over the triangle (0, 0), (1, 0), (0, 1). With eight nodes the place in
     * the middle is that of the serendipity shape functions.
     */
    std::function<Place(double, double)>
    map_of(const CellNodes &cell, const std::vector<Place> &x)
    {
      const bool         is_curved = !cell.middles.empty();
      std::vector<Place> corners, sides;
      for (unsigned int i = 0; i < cell.n_corners(); ++i)
        corners.push_back(x[cell.corners[i]]);
      for (unsigned int i = 0; i < corners.size(); ++i)
        sides.push_back(is_curved ? x[cell.middles[i]] : Place(0.5 * (corners[i] + corners[(i + 1) % corners.size()])));
      if (corners.size() == 3)
        return [=](const double u, const double v) {
          const double w[3] = {1 - u - v, u, v};
          Place        result;
          for (unsigned int i = 0; i < 3; ++i)
            result +=
              is_curved ? w[i] * (2 * w[i] - 1) * corners[i] + 4 * w[i] * w[(i + 1) % 3] * sides[i] : w[i] * corners[i];
          return result;
        };
      Place middle;
      for (unsigned int i = 0; i < 4; ++i)
        middle += 0.5 * sides[i] - 0.25 * corners[i];
      if (cell.middles.size() > 4)
        middle = x[cell.middles[4]];
      return [=](const double u, const double v) {
        const Place rows[3][3] = {{corners[0], sides[0], corners[1]},
                                  {sides[3], middle, sides[1]},
                                  {corners[3], sides[2], corners[2]}};
        const auto  of_u = of_interval(u, is_curved), of_v = of_interval(v, is_curved);
        Place       result;
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int i = 0; i < 3; ++i)
            result += of_v[j] * of_u[i] * rows[j][i];
        return result;
      };
    }



    /** A cell, or the part of it between four places of its unit square or triangle, as a patch of its own. */
    SectionPatch
    patch_of_cell(const std::function<Place(double, double)> &map, const std::array<Place, 4> &unit)
    {
      SectionPatch patch;
      patch.u = patch.v = {0, 1};
      patch.place       = [map, unit](const double u, const double v) {
        const Place at((1 - v) * ((1 - u) * unit[0] + u * unit[1]) + v * ((1 - u) * unit[3] + u * unit[2]));
        return map(at[0], at[1]);
      };
      return patch;
    }



    /** Numbers of the corners of patches: those of vertices, and of what cells are divided at. */
    class CellCorners
    {
    public:
      explicit CellCorners(const unsigned int n_vertices)
        : n(n_vertices)
      {}

      unsigned int
      middle_of_side(const unsigned int a, const unsigned int b)
      {
        const auto known = of_side.emplace(std::minmax(a, b), n);
        n += known.second;
        return known.first->second;
      }

      unsigned int
      add()
      {
        return n++;
      }

    private:
      unsigned int                                                  n;
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> of_side;
    };



    /** A patch's corners: their numbers, and where they are in the unit square or triangle of the cell. */
    struct CellPiece
    {
      std::array<unsigned int, 4> numbers;
      std::array<Place, 4>        unit;
    };

    /** The whole cell; or what it is divided into, a triangle into three and a quadrilateral into four. */
    std::vector<CellPiece>
    pieces_of(const CellNodes &cell, const bool is_divided, CellCorners &corners)
    {
      const unsigned int       n = cell.n_corners();
      const std::vector<Place> unit =
        n == 3 ? std::vector<Place>{{0, 0}, {1, 0}, {0, 1}} : std::vector<Place>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      if (!is_divided)
        return {{cell.corners, {{unit[0], unit[1], unit[2], unit[3]}}}};
      Place middle;
      for (const Place &x : unit)
        middle += x / n;
      const unsigned int     number = corners.add();
      std::vector<CellPiece> result;
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int next = (i + 1) % n, last = (i + n - 1) % n;
          result.push_back(
            {{{cell.corners[i],
               corners.middle_of_side(cell.corners[i], cell.corners[next]),
               number,
               corners.middle_of_side(cell.corners[last], cell.corners[i])}},
             {{unit[i], Place(0.5 * (unit[i] + unit[next])), middle, Place(0.5 * (unit[last] + unit[i]))}}});
        }
      return result;
    }



    /** @throws std::invalid_argument if two cells have the ends of a side in common and not what is between them. */
    void
    check_middles_of_sides(const std::vector<CellNodes> &cells, const std::vector<Place> &x, const std::string &file)
    {
      constexpr double       straight = 1e-9; // of the side
      constexpr unsigned int none     = -1;
      struct Side
      {
        unsigned int cell, node;
        Place        middle;
      };
      std::map<std::pair<unsigned int, unsigned int>, Side> known;
      for (unsigned int c = 0; c < cells.size(); ++c)
        for (unsigned int i = 0, n = cells[c].n_corners(); i < n; ++i)
          {
            const unsigned int a = cells[c].corners[i], b = cells[c].corners[(i + 1) % n];
            const bool         is_curved = !cells[c].middles.empty();
            const Side         side{c,
                            is_curved ? cells[c].middles[i] : none,
                            is_curved ? x[cells[c].middles[i]] : Place(0.5 * (x[a] + x[b]))};
            const auto         first = known.emplace(std::minmax(a, b), side).first->second;
            if (first.middle.distance(side.middle) > straight * x[a].distance(x[b]) ||
                (first.node != side.node && first.node != none && side.node != none))
              throw std::invalid_argument(
                "cells " + std::to_string(first.cell + 1) + " and " + std::to_string(c + 1) + " of " + file +
                " have the ends of a side in common, and not the node in its middle: they would meet at its ends "
                "alone. Let them have all nodes of the side in common, or, at a slit, its ends only where it ends");
          }
    }
  } // namespace



  std::vector<unsigned int>
  MeshSection::groups_of_cells(const ImportedMesh &mesh) const
  {
    const unsigned int        none = groups.size(), n = mesh.quadrilaterals.size();
    std::vector<unsigned int> result(n, none);
    const auto                known = names_in(mesh.regions);
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        const auto region = mesh.regions.find(groups[g].group);
        if (region == mesh.regions.end())
          throw std::invalid_argument("there is no group <" + groups[g].group + "> of cells in " + file +
                                      did_you_mean(groups[g].group, known));
        for (const unsigned int cell : region->second)
          {
            if (result[cell] != none && result[cell] != g)
              throw std::invalid_argument("cell " + std::to_string(cell + 1) + " of " + file + " is in the groups <" +
                                          groups[result[cell]].group + "> and <" + groups[g].group + ">");
            result[cell] = g;
          }
      }
    const auto lost = std::find(result.begin(), result.end(), none);
    if (lost != result.end())
      throw std::invalid_argument(std::to_string(std::count(result.begin(), result.end(), none)) + " cells of " + file +
                                  ", the first of them cell " + std::to_string(lost - result.begin() + 1) +
                                  ", are in none of the <Groups>; the file has " +
                                  (known.empty() ? "none" : "<" + join(known, ">, <") + ">") +
                                  ": in Gmsh surfaces need a Physical Surface");
    std::set<std::array<unsigned int, 4>> corners;
    for (unsigned int c = 0; c < n; ++c)
      {
        auto sorted = mesh.quadrilaterals[c];
        std::sort(sorted.begin(), sorted.end());
        if (!corners.insert(sorted).second)
          throw std::invalid_argument("cell " + std::to_string(c + 1) + " of " + file +
                                      " is there twice: a surface must be in one physical group only");
      }
    return result;
  }



  namespace
  {
    /** Vertices of a mesh in the plane of a section. */
    struct PlaneMesh
    {
      std::vector<Place> x;
      Place              middle;
      double             size = 0;

      /** @p scale: what one in the file is [m]. @throws std::invalid_argument if they do not lie in a plane z. */
      PlaneMesh(const ImportedMesh &mesh, const double scale, const std::string &file)
      {
        for (const Vector3 &vertex : mesh.vertices)
          x.emplace_back(scale * vertex(0), scale * vertex(1));
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const auto &cell : mesh.quadrilaterals)
          for (const unsigned int v : cell)
            {
              middle += x[v] / (4. * mesh.quadrilaterals.size());
              size = std::max(size, x[v].distance(x[mesh.quadrilaterals[0][0]]));
            }
        const auto see_plane = [&](const auto &nodes) {
          for (const unsigned int v : nodes)
            {
              low  = std::min(low, scale * mesh.vertices[v](2));
              high = std::max(high, scale * mesh.vertices[v](2));
            }
        };
        for (const auto &cell : mesh.quadrilaterals)
          see_plane(cell);
        for (const auto &[cell, nodes] : mesh.middles)
          see_plane(nodes);
        if (high - low > 1e-6 * size)
          throw std::invalid_argument("the cells of " + file + " do not lie in a plane z = const");
      }
    };



    /** Of layers at a place, as a group says: at an angle in degrees, or along curves of the mesh. */
    std::function<Eigen::Vector2d(const Place &)>
    tangent_of(const std::string &layer, const ImportedMesh &mesh, const PlaneMesh &plane, const std::string &file)
    {
      double degrees = 0;
      if (text_to_number(layer, degrees))
        {
          const Eigen::Vector2d t(std::cos(degrees * M_PI / 180), std::sin(degrees * M_PI / 180));
          return [t](const Place &) { return t; };
        }
      const auto lines = mesh.lines.find(layer);
      if (lines == mesh.lines.end())
        {
          std::vector<std::string> known;
          for (const auto &line : mesh.lines)
            known.push_back(line.first);
          throw std::invalid_argument("<" + layer + "> is neither an angle nor a group of curves in " + file +
                                      did_you_mean(layer, known));
        }
      const auto nearest = std::make_shared<NearestTangent>(lines->second, plane.x, plane.middle);
      return [nearest](const Place &place) { return (*nearest)(place); };
    }
  } // namespace



  void
  MeshSection::add_cells(const ImportedMesh &mesh, Model &model, SectionShape &shape) const
  {
    const auto                                                 group_of = groups_of_cells(mesh);
    const PlaneMesh                                            plane(mesh, scale, file);
    std::vector<std::function<Eigen::Vector2d(const Place &)>> tangents;
    std::vector<Ply>                                           plies;
    for (const auto &group : groups)
      {
        plies.push_back({material_number(model, shape, "Groups", group.material), group.angle * M_PI / 180});
        tangents.push_back(tangent_of(group.layer, mesh, plane, file));
      }

    std::vector<CellNodes> cells;
    for (const auto &corners : mesh.quadrilaterals)
      cells.push_back({corners, {}});
    for (const auto &[cell, nodes] : mesh.middles)
      cells[cell].middles = nodes;
    check_middles_of_sides(cells, plane.x, file);
    const bool is_divided =
      std::any_of(cells.begin(), cells.end(), [](const CellNodes &cell) { return cell.n_corners() == 3; });
    CellCorners corners(plane.x.size());
    shape.finest = plane.size;
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const unsigned int g   = group_of[c];
        const auto         map = map_of(cells[c], plane.x);
        for (const CellPiece &piece : pieces_of(cells[c], is_divided, corners))
          {
            SectionPatch patch = patch_of_cell(map, piece.unit);
            patch.corners      = {piece.numbers[0], piece.numbers[1], piece.numbers[3], piece.numbers[2]};
            patch.name         = "cell " + std::to_string(c + 1) + " of group <" + groups[g].group + ">";
            patch.group        = groups[g].group;
            patch.tangent      = tangents[g];
            patch.ply          = [ply = plies[g]](unsigned int, unsigned int) { return ply; };
            shape.patches.push_back(patch);
            for (unsigned int i = 0; i < 4; ++i)
              {
                const Place &a = piece.unit[i], &b = piece.unit[(i + 1) % 4];
                shape.finest = std::min(shape.finest, map(a[0], a[1]).distance(map(b[0], b[1])));
              }
          }
      }
  }



  std::vector<Remark>
  MeshSection::remarks() const
  {
    std::vector<Remark> result;
    if (!of_coincident.empty())
      result.push_back({Remark::line, "section " + name + ": " + of_coincident});
    result.insert(result.end(), of_sides.begin(), of_sides.end());
    return result;
  }



  SectionShape
  MeshSection::make_shape(Model &model)
  {
    SectionShape result;
    if (!parameters.require("Mesh file", model.complaints) || !parameters.require("Groups", model.complaints) ||
        !is_positive(model, "Length unit", scale))
      return result;
    for (const char *const entry : {"Elements", "Elements per ply"})
      if (parameters.is_set(entry))
        model.complaints.add(parameters.where(entry),
                             std::string("<") + entry + "> has no effect on the mesh of a file");
    const auto  before = model.complaints.count();
    std::string blamed = "Mesh file";
    try
      {
        ImportedMesh mesh = read_mesh_file(file, true);
        of_coincident     = mesh.take_coincident(merges, file);
        blamed            = "Groups";
        add_cells(mesh, model, result);
        blamed = "Mesh file";
        if (model.complaints.count() == before)
          if (const unsigned int n = try_mesh(result); n > 0)
            of_sides.push_back({Remark::line,
                                "section " + name + ": in " + file + " " + std::to_string(n) +
                                  (n == 1 ? " corner of a cell lies on a side of another that does" :
                                            " corners of cells lie on sides of others that do") +
                                  " not have " + (n == 1 ? "it" : "them") +
                                  ": these sides are kept apart, as at a slit"});
        if (!mesh.middles.empty() && own_degree() < 2)
          of_sides.push_back({Remark::warning,
                              "section " + name +
                                ": with <Degree = 1> curved sides of cells are straight; <Degree = 2> "
                                "follows them"});
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(blamed),
                             std::string("section <") + name + ">: " + problem.what() +
                               (of_coincident.empty() ? "" : "; " + of_coincident));
        return result;
      }
    // drawn: the box around the cells
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const auto &patch : result.patches)
      for (const double u : {0., 0.5, 1.})
        for (const double v : {0., 0.5, 1.})
          for (unsigned int d = 0; d < 2; ++d)
            {
              const double at = patch.place(u, v)[d];
              low[d]          = std::min(low[d], at);
              high[d]         = std::max(high[d], at);
            }
    for (const unsigned int corner : {0u, 1u, 3u, 2u})
      result.outline.emplace_back(corner % 2 == 0 ? low[0] : high[0], corner < 2 ? low[1] : high[1]);
    return result;
  }
} // namespace samara
