// Meshes of other programs: Gmsh and Abaqus.

#include <samara/base/number_in_file.h>
#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/cosserat/imported_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** The lines of a file with their numbers, and numbers read from them one after the other. */
    class Lines
    {
    public:
      explicit Lines(const std::string &file)
        : file(file)
        , in(text_of_file(file))
      {}

      bool
      next(std::string &line)
      {
        if (!std::getline(in, line))
          return false;
        ++number;
        line = trim(line);
        return true;
      }

      /** So many numbers, on as many lines as they take; with 0, those of one line. */
      std::vector<double>
      numbers(const std::size_t n)
      {
        std::vector<double> result;
        std::string         line;
        do
          {
            if (!next(line))
              fail("the file ends too early");
            const auto of_line = numbers_of(line, ' ');
            result.insert(result.end(), of_line.begin(), of_line.end());
          }
        while (result.size() < n);
        if (n > 0 && result.size() != n)
          fail("there are " + std::to_string(result.size()) + " numbers in place of " + std::to_string(n));
        return result;
      }

      std::vector<double>
      numbers_of(std::string line, const char separator)
      {
        std::replace(line.begin(), line.end(), separator, ' ');
        std::istringstream  words(line);
        std::vector<double> result;
        std::string         word;
        double              value = 0;
        while (words >> word)
          {
            if (const std::string fault = fault_of_number(word, value); !fault.empty())
              fail("<" + word + "> " + fault);
            result.push_back(value);
          }
        return result;
      }

      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw std::invalid_argument(file + ":" + std::to_string(number) + ": " + what);
      }

    private:
      std::string        file;
      std::istringstream in;
      unsigned int       number = 0;
    };



    /** Vertices by the numbers they have in the file. */
    class Vertices
    {
    public:
      Vertices(ImportedMesh &mesh, const Lines &lines)
        : mesh(mesh)
        , lines(lines)
      {}

      void
      add(const double number, const Vector3 &x)
      {
        if (!numbers.emplace(std::lround(number), mesh.vertices.size()).second)
          lines.fail("there are two nodes " + std::to_string(std::lround(number)));
        mesh.vertices.push_back(x);
      }

      unsigned int
      at(const double number) const
      {
        const auto found = numbers.find(std::lround(number));
        if (found == numbers.end())
          lines.fail("there is no node " + std::to_string(std::lround(number)));
        return found->second;
      }

    private:
      ImportedMesh                &mesh;
      const Lines                 &lines;
      std::map<long, unsigned int> numbers;
    };



    /** Of an element of Gmsh: how many of its nodes are corners, which come first; those in the middle follow. */
    struct NodesOfType
    {
      long         type;
      unsigned int corners, all;
    };

    /** Null for elements that are not read. */
    const NodesOfType *
    nodes_of_type(const long type)
    {
      static const NodesOfType all[] = {{1, 2, 2}, // lines, triangles, quadrilaterals of first order, a point
                                        {2, 3, 3},
                                        {3, 4, 4},
                                        {15, 1, 1},
                                        {8, 2, 3}, // of second order
                                        {9, 3, 6},
                                        {10, 4, 9},
                                        {16, 4, 8}};
      for (const NodesOfType &one : all)
        if (one.type == type)
          return &one;
      return nullptr;
    }



    class GmshReader
    {
    public:
      GmshReader(ImportedMesh &mesh, Lines &lines, const bool of_section)
        : mesh(mesh)
        , lines(lines)
        , of_section(of_section)
        , vertices(mesh, lines)
      {}

      void
      read()
      {
        std::string line;
        while (lines.next(line))
          if (line == "$MeshFormat")
            read_format();
          else if (line == "$PhysicalNames")
            read_names();
          else if (line == "$Entities")
            read_entities();
          else if (line == "$Nodes")
            version < 3 ? read_nodes_2() : read_nodes_4();
          else if (line == "$Elements")
            version < 3 ? read_elements_2() : read_elements_4();
        if (version == 0)
          lines.fail("this is no mesh of Gmsh: it has no $MeshFormat");
      }

    private:
      ImportedMesh &mesh;
      Lines        &lines;
      bool          of_section;
      Vertices      vertices;
      double        version = 0;
      // of physical points, curves and surfaces; and the groups of points, curves and surfaces of format 4
      std::map<long, std::string>       names[3];
      std::map<long, std::vector<long>> physical_of[3];

      void
      read_format()
      {
        const auto format = lines.numbers(0);
        version           = format.at(0);
        if (std::abs(version - 2.2) > 1e-9 && std::abs(version - 4.1) > 1e-9)
          lines.fail("formats 2.2 and 4.1 of Gmsh are read, not " + number_to_text(version));
        if (format.size() > 1 && format[1] != 0)
          lines.fail("the file is binary: save it as text (Mesh.Binary = 0)");
      }

      void
      read_names()
      {
        const long  n = std::lround(lines.numbers(1)[0]);
        std::string line;
        for (long i = 0; i < n && lines.next(line); ++i)
          {
            std::istringstream words(line);
            long               dimension = 0, number = 0;
            words >> dimension >> number;
            const auto first = line.find('"'), last = line.rfind('"');
            if (!words || last <= first || last == std::string::npos)
              lines.fail("a physical name is written <1 2 \"root\">");
            if (dimension >= 0 && dimension <= 2)
              names[dimension][number] = line.substr(first + 1, last - first - 1);
          }
      }

      void
      read_entities()
      {
        const auto n = lines.numbers(4);
        for (unsigned int dimension = 0; dimension < 4; ++dimension)
          for (long i = 0; i < std::lround(n[dimension]); ++i)
            {
              const auto         of_line = lines.numbers(0);
              const unsigned int at      = dimension == 0 ? 4 : 7;
              if (of_line.size() <= at)
                lines.fail("an entity has a number, its box, and its physical groups");
              if (dimension == 3)
                continue;
              for (std::size_t k = at + 1; k < of_line.size() && k <= at + std::max(0., of_line[at]); ++k)
                physical_of[dimension][std::lround(of_line[0])].push_back(std::abs(std::lround(of_line[k])));
            }
      }

      void
      read_nodes_2()
      {
        const long n = std::lround(lines.numbers(1)[0]);
        for (long i = 0; i < n; ++i)
          {
            const auto x = lines.numbers(4);
            vertices.add(x[0], {x[1], x[2], x[3]});
          }
      }

      void
      read_nodes_4()
      {
        const auto n = lines.numbers(4);
        for (long block = 0; block < std::lround(n[0]); ++block)
          {
            const auto          of_block = lines.numbers(4);
            std::vector<double> tags;
            for (long i = 0; i < std::lround(of_block[3]); ++i)
              tags.push_back(lines.numbers(1)[0]);
            for (const double tag : tags)
              {
                const auto x = lines.numbers(0);
                if (x.size() < 3)
                  lines.fail("a node has three coordinates");
                vertices.add(tag, {x[0], x[1], x[2]});
              }
          }
      }

      void
      add_element(const long type, const double *nodes, const std::size_t n_nodes, const std::vector<long> &groups)
      {
        const auto at   = [&](const unsigned int i) { return vertices.at(nodes[i]); };
        const auto name = [&](const long group, const unsigned int dimension) {
          const auto found = names[dimension].find(group);
          return found != names[dimension].end() ? found->second : std::to_string(group);
        };
        const NodesOfType *const of_type = nodes_of_type(type);
        if ((type == 2 || type == 9) && !of_section)
          lines.fail("there is a triangle: shells have quadrilaterals (Recombine Surface, Mesh.RecombineAll = 1)");
        if ((type >= 4 && type <= 7) || (type >= 11 && type <= 14) || (type >= 17 && type <= 19))
          lines.fail("there is a solid element, where surfaces are wanted");
        if (of_type == nullptr || (of_type->all > of_type->corners && !of_section))
          lines.fail("there is an element of " + std::string(of_section ? "third or " : "") + "higher order (type " +
                     std::to_string(type) + "): save the mesh with Mesh.ElementOrder = " + (of_section ? "2" : "1") +
                     ", and choose the <Degree> here");
        if (n_nodes < of_type->all)
          lines.fail("an element has too few nodes");
        const bool is_cell = of_type->corners > 2;
        for (const long group : groups)
          if (type == 15)
            mesh.points[name(group, 0)].push_back(at(0));
          else if (type == 1)
            mesh.lines[name(group, 1)].push_back({{at(0), at(1)}});
          else if (!is_cell)
            for (const unsigned int end : {0u, 1u})
              mesh.lines[name(group, 1)].push_back({{at(end), at(2)}});
          else
            mesh.regions[name(group, 2)].push_back(mesh.quadrilaterals.size());
        if (!is_cell)
          return;
        for (unsigned int i = of_type->corners; i < of_type->all; ++i)
          mesh.middles[mesh.quadrilaterals.size()].push_back(at(i));
        mesh.quadrilaterals.push_back({{at(0), at(1), at(2), at(of_type->corners - 1)}});
      }

      void
      read_elements_2()
      {
        const long n = std::lround(lines.numbers(1)[0]);
        for (long i = 0; i < n; ++i)
          {
            const auto e = lines.numbers(0);
            if (e.size() < 3 || e.size() < 3 + static_cast<std::size_t>(std::max(0., e[2])))
              lines.fail("an element is written <number type n-tags tags nodes>");
            const auto        first = 3 + static_cast<std::size_t>(e[2]);
            std::vector<long> groups;
            if (e[2] > 0 && std::lround(e[3]) > 0) // zero: in none
              groups.push_back(std::lround(e[3]));
            add_element(std::lround(e[1]), e.data() + first, e.size() - first, groups);
          }
      }

      void
      read_elements_4()
      {
        const auto n = lines.numbers(4);
        for (long block = 0; block < std::lround(n[0]); ++block)
          {
            const auto        of_block = lines.numbers(4);
            std::vector<long> groups;
            if (of_block[0] >= 0 && of_block[0] <= 2)
              groups = physical_of[std::lround(of_block[0])][std::lround(of_block[1])];
            for (long i = 0; i < std::lround(of_block[3]); ++i)
              {
                const auto e = lines.numbers(0);
                if (e.empty())
                  lines.fail("an element is missing");
                add_element(std::lround(of_block[2]), e.data() + 1, e.size() - 1, groups);
              }
          }
      }
    };



    std::string
    upper(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::toupper(c); });
      return text;
    }

    /** The value of "NSET = root" among the options of a keyword; "" if it is not there. */
    std::string
    option(const std::string &line, const std::string &name)
    {
      for (const auto &part : split_top_level(line, ','))
        {
          const auto equal = part.find('=');
          if (equal != std::string::npos && upper(trim(part.substr(0, equal))) == name)
            return trim(part.substr(equal + 1));
        }
      return "";
    }

    /** An element, its number first. */
    void
    add_abaqus_element(ImportedMesh              &mesh,
                       const Lines               &lines,
                       const Vertices            &vertices,
                       const std::vector<double> &numbers,
                       const std::string         &type,
                       const bool                 of_section)
    {
      const std::size_t n = numbers.size() - 1;
      if ((n == 3 || n == 6) && !of_section)
        lines.fail("there is a triangle (" + type + "): shells have quadrilaterals");
      const bool is_of_second_order = of_section && (n == 6 || n == 8 || n == 9);
      if (n != 3 && n != 4 && !is_of_second_order)
        lines.fail("there is an element of " + std::to_string(n) + " nodes (" + type +
                   "): cells are quadrilaterals of " +
                   (of_section ? "four, eight or nine nodes, or triangles of three or six" : "four"));
      const unsigned int n_corners = n == 3 || n == 6 ? 3 : 4;
      for (unsigned int i = n_corners; i < n; ++i)
        mesh.middles[mesh.quadrilaterals.size()].push_back(vertices.at(numbers[i + 1]));
      mesh.quadrilaterals.push_back(
        {{vertices.at(numbers[1]), vertices.at(numbers[2]), vertices.at(numbers[3]), vertices.at(numbers[n_corners])}});
    }

    /** The numbers that a line of a set names. */
    std::vector<double>
    numbers_of_set(const Lines &lines, const std::vector<double> &numbers, const bool is_generated)
    {
      if (!is_generated)
        return numbers;
      if (numbers.size() < 2 || (numbers.size() > 2 && numbers[2] < 1))
        lines.fail("a set is generated by its first number, its last one, and a step");
      std::vector<double> result;
      for (double i = numbers[0]; i <= numbers[1]; i += numbers.size() > 2 ? numbers[2] : 1)
        result.push_back(i);
      return result;
    }

    void
    read_abaqus(ImportedMesh &mesh, Lines &lines, const bool of_section)
    {
      Vertices                     vertices(mesh, lines);
      std::map<long, unsigned int> elements;
      std::string                  line, keyword, set, type;
      bool                         is_generated = false;
      while (lines.next(line))
        {
          if (line.empty() || line.substr(0, 2) == "**")
            continue;
          if (line[0] == '*')
            {
              keyword = upper(trim(line.substr(0, line.find(','))));
              set     = option(line, keyword == "*NSET" || keyword == "*NODE" ? "NSET" : "ELSET");
              if (set.empty() && (keyword == "*NSET" || keyword == "*ELSET"))
                lines.fail("a set has a name: " + keyword + ", " + keyword.substr(1) + " = root");
              type         = upper(option(line, "TYPE"));
              is_generated = upper(line).find("GENERATE") != std::string::npos;
              continue;
            }
          if (keyword != "*NODE" && keyword != "*ELEMENT" && keyword != "*NSET" && keyword != "*ELSET")
            continue;
          const auto numbers = lines.numbers_of(line, ',');
          if (keyword == "*NODE")
            {
              if (numbers.size() != 4 && numbers.size() != 3)
                lines.fail("a node has a number and two or three coordinates");
              vertices.add(numbers[0], {numbers[1], numbers[2], numbers.size() > 3 ? numbers[3] : 0});
              if (!set.empty())
                mesh.sets[set].push_back(mesh.vertices.size() - 1);
            }
          else if (keyword == "*ELEMENT")
            {
              add_abaqus_element(mesh, lines, vertices, numbers, type, of_section);
              elements[std::lround(numbers[0])] = mesh.quadrilaterals.size() - 1;
              if (!set.empty())
                mesh.regions[set].push_back(mesh.quadrilaterals.size() - 1);
            }
          else if (keyword == "*NSET")
            for (const double i : numbers_of_set(lines, numbers, is_generated))
              mesh.sets[set].push_back(vertices.at(i));
          else
            for (const double i : numbers_of_set(lines, numbers, is_generated))
              {
                const auto found = elements.find(std::lround(i));
                if (found == elements.end())
                  lines.fail("there is no element " + std::to_string(std::lround(i)));
                mesh.regions[set].push_back(found->second);
              }
        }
    }
  } // namespace



  std::string
  ImportedMesh::groups() const
  {
    const auto list = [](const std::string &kind, const auto &groups, const auto &others) {
      std::vector<std::string> names;
      for (const auto &group : groups)
        names.push_back(group.first);
      for (const auto &other : others)
        if (groups.count(other.first) == 0)
          names.push_back(other.first);
      return names.empty() ? "no " + kind + "s" :
                             "the " + kind + (names.size() > 1 ? "s" : "") + " <" + join(names, ">, <") + ">";
    };
    if (points.empty() && lines.empty() && sets.empty() && regions.empty())
      return "no physical groups and no sets";
    const std::map<std::string, int> none;
    return list("point", points, none) + ", " + list("curve", lines, sets) + ", and " + list("surface", regions, none);
  }



  namespace
  {
    /** For each vertex of cells itself, or the first one at its place; the number of the vertex for all others. */
    std::vector<unsigned int>
    first_at_place(const ImportedMesh &mesh)
    {
      constexpr double          one      = 1e-6; // of the shortest side
      double                    shortest = std::numeric_limits<double>::infinity();
      std::vector<unsigned int> used, first(mesh.vertices.size());
      for (const auto &cell : mesh.quadrilaterals)
        for (unsigned int i = 0; i < 4; ++i)
          {
            used.push_back(cell[i]);
            if (const unsigned int next = cell[(i + 1) % 4]; next != cell[i])
              shortest = std::min(shortest, (mesh.vertices[next] - mesh.vertices[cell[i]]).norm());
          }
      for (const auto &[cell, nodes] : mesh.middles)
        used.insert(used.end(), nodes.begin(), nodes.end());
      std::sort(used.begin(), used.end());
      used.erase(std::unique(used.begin(), used.end()), used.end());
      std::iota(first.begin(), first.end(), 0);

      // sorted along a direction that no mesh has, those at one place are near each other
      const Vector3 direction(1, 0.3719, 0.1273);
      const auto    along = [&](const unsigned int v) { return direction.dot(mesh.vertices[v]); };
      std::sort(used.begin(), used.end(), [&](const unsigned int a, const unsigned int b) {
        return along(a) < along(b);
      });
      const double near = one * shortest;
      for (std::size_t i = 0; i < used.size(); ++i)
        for (std::size_t j = i + 1; j < used.size() && along(used[j]) - along(used[i]) <= near * direction.norm(); ++j)
          if ((mesh.vertices[used[j]] - mesh.vertices[used[i]]).norm() <= near)
            {
              const unsigned int both = std::min(first[used[i]], first[used[j]]);
              first[used[i]] = first[used[j]] = both;
            }
      return first;
    }
  } // namespace



  unsigned int
  ImportedMesh::n_coincident() const
  {
    const auto   first = first_at_place(*this);
    unsigned int n     = 0;
    for (unsigned int v = 0; v < first.size(); ++v)
      n += first[v] != v;
    return n;
  }



  unsigned int
  ImportedMesh::merge()
  {
    const auto   first = first_at_place(*this);
    unsigned int n     = 0;
    for (unsigned int v = 0; v < first.size(); ++v)
      n += first[v] != v;
    const auto replace = [&](auto &numbers) {
      for (unsigned int &v : numbers)
        v = first[v];
    };
    for (auto &cell : quadrilaterals)
      replace(cell);
    for (auto &[cell, nodes] : middles)
      replace(nodes);
    for (auto *const groups : {&sets, &points})
      for (auto &[name, vertices_of_group] : *groups)
        {
          replace(vertices_of_group);
          std::sort(vertices_of_group.begin(), vertices_of_group.end());
          vertices_of_group.erase(std::unique(vertices_of_group.begin(), vertices_of_group.end()),
                                  vertices_of_group.end());
        }
    for (auto &[name, sides] : lines)
      for (auto &side : sides)
        replace(side);
    return n;
  }



  std::string
  ImportedMesh::take_coincident(const bool wanted, const std::string &file)
  {
    const unsigned int n = wanted ? merge() : n_coincident();
    if (n == 0)
      return "";
    const std::string what =
      "in " + file + " " + std::to_string(n) +
      (n == 1 ? " node lies at the place of another and is " : " nodes lie at the places of others and are ");
    return what +
           (wanted ? "joined with them, as <Merge> wants" : "kept apart, as at a slit; <Merge = true> joins them");
  }



  ImportedMesh
  read_mesh_file(const std::string &file, const bool of_section)
  {
    Lines             lines(file);
    ImportedMesh      mesh;
    const std::string ending = file.size() > 4 ? upper(file.substr(file.size() - 4)) : "";
    if (ending == ".MSH")
      GmshReader(mesh, lines, of_section).read();
    else if (ending == ".INP")
      read_abaqus(mesh, lines, of_section);
    else
      throw std::invalid_argument("the name of a mesh ends with .msh (Gmsh) or .inp (Abaqus), not as <" + file + ">");
    if (mesh.quadrilaterals.empty())
      throw std::invalid_argument(file + " has no quadrilaterals");
    for (auto set = mesh.sets.begin(); set != mesh.sets.end();)
      if (set->second.size() == 1)
        {
          mesh.points[set->first] = set->second;
          set                     = mesh.sets.erase(set);
        }
      else
        ++set;
    return mesh;
  }
} // namespace samara
