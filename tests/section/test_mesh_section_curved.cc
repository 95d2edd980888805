/*
 * Problem:   sections of meshes of second order, and of meshes whose sides meet with different nodes
 * Reference: round bar: area π r², G J = G π r⁴/2, E I = E π r⁴/4; a slit ring: J of Prandtl's function of the radius,
 * φ = (a² − r²)/2 + (b² − a²) ln(r/a)/(2 ln(b/a)), J = 2 ∫φ dA, less 0.21 t⁴ of the two ends (Timoshenko); its shear
 * centre lies 2 R beside the middle, away from the slit
 */

#include <samara/cosserat/mesh_section.h>
#include <samara/section/section_constants.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace samara;

namespace
{
  using Block = std::function<Eigen::Vector2d(double, double)>;

  enum class CellKind
  {
    quadrilateral_8,
    quadrilateral_9,
    triangle_6
  };

  /** Blocks of n × m cells of second order, whose nodes are one where they are at one place in one layer of nodes. */
  class CurvedMesh
  {
  public:
    explicit CurvedMesh(const CellKind kind)
      : kind(kind)
    {}

    void
    add(const Block &block, const unsigned int n, const unsigned int m, const std::function<int(double)> &layer)
    {
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto at = [&](const double a, const double b) {
              const double u = (i + a) / n, v = (j + b) / m;
              return node(block(u, v), layer(u));
            };
            const unsigned int c[4] = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
                               s[4] = {at(.5, 0), at(1, .5), at(.5, 1), at(0, .5)};
            if (kind == CellKind::triangle_6)
              {
                const unsigned int middle = at(.5, .5);
                cells.push_back({c[0], c[1], c[2], s[0], s[1], middle});
                cells.push_back({c[2], c[3], c[0], s[2], s[3], middle});
                continue;
              }
            cells.push_back({c[0], c[1], c[2], c[3], s[0], s[1], s[2], s[3]});
            if (kind == CellKind::quadrilateral_9)
              cells.back().push_back(at(.5, .5));
          }
    }

    std::string
    gmsh() const
    {
      const char *const  type = kind == CellKind::triangle_6 ? "9" : kind == CellKind::quadrilateral_8 ? "16" : "10";
      std::ostringstream out;
      out.precision(17);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"all\"\n$EndPhysicalNames\n$Nodes\n"
          << places.size() << '\n';
      for (unsigned int i = 0; i < places.size(); ++i)
        out << i + 1 << ' ' << places[i](0) << ' ' << places[i](1) << " 0\n";
      out << "$EndNodes\n$Elements\n" << cells.size() << '\n';
      for (unsigned int i = 0; i < cells.size(); ++i)
        {
          out << i + 1 << ' ' << type << " 2 1 1";
          for (const unsigned int number : cells[i])
            out << ' ' << number + 1;
          out << '\n';
        }
      out << "$EndElements\n";
      return out.str();
    }

    std::string
    abaqus() const
    {
      std::ostringstream out;
      out.precision(17);
      out << "*NODE\n";
      for (unsigned int i = 0; i < places.size(); ++i)
        out << i + 1 << ", " << places[i](0) << ", " << places[i](1) << '\n';
      out << "*ELEMENT, TYPE=" << (kind == CellKind::triangle_6 ? "CPS6" : "CPS8") << ", ELSET=all\n";
      for (unsigned int i = 0; i < cells.size(); ++i)
        {
          out << i + 1;
          for (const unsigned int number : cells[i])
            out << ", " << number + 1;
          out << '\n';
        }
      return out.str();
    }

  private:
    CellKind                                    kind;
    std::map<std::array<long, 3>, unsigned int> known;
    std::vector<Eigen::Vector2d>                places;
    std::vector<std::vector<unsigned int>>      cells;

    unsigned int
    node(const Eigen::Vector2d &x, const int layer)
    {
      const auto number =
        known.emplace(std::array<long, 3>{{std::lround(x(0) * 1e9), std::lround(x(1) * 1e9), layer}}, places.size());
      if (number.second)
        places.push_back(x);
      return number.first->second;
    }
  };

  const double elastic = 2.6, in_shear = 1, density_of_bar = 3;

  std::string
  curved_model(const std::string &ending, const std::string &text, const std::string &entries)
  {
    const std::string name = ::testing::TempDir() + "curved_mesh" + ending;
    std::ofstream(name) << text;
    return "subsection Materials\n  subsection iso\n    set Type = isotropic\n    set E = 2.6\n    set Poisson ratio = "
           "0.3\n    set Density = 3\n  end\nend\nsubsection Sections\n  subsection s\n    set Type = mesh\n    set Mesh "
           "file = " +
           name + "\n    set Groups = all, iso\n" + entries +
           "  end\nend\nsubsection Bodies\n  subsection b\n    set Type = rigid body\n    set Mass = 1\n"
           "    set Inertia = 1, 1, 1\n  end\nend\n";
  }

  SectionValues
  values_of_curved(const std::string &model)
  {
    const Scene scene(model);
    return scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero());
  }

  std::vector<Remark>
  remarks_of_curved(const std::string &model)
  {
    const Scene scene(model);
    return dynamic_cast<const HasRemarks &>(scene.input.model.find<Section>("s", "section")).remarks();
  }

  /** A disc of radius 1: a square in the middle and four blocks around it, n cells a side. */
  CurvedMesh
  disc(const CellKind kind, const unsigned int n)
  {
    CurvedMesh   result(kind);
    const double a        = 0.45;
    const auto   no_layer = [](double) { return 0; };
    result.add([a](const double u, const double v) { return Eigen::Vector2d(a * (2 * u - 1), a * (2 * v - 1)); },
               n,
               n,
               no_layer);
    for (int quarter = 0; quarter < 4; ++quarter)
      {
        const Eigen::Rotation2Dd turn(quarter * M_PI / 2);
        result.add(
          [turn, a](const double u, const double v) {
            const double          angle = M_PI / 2 * (v - 0.5);
            const Eigen::Vector2d inner(a, a * (2 * v - 1)), outer(std::cos(angle), std::sin(angle));
            return Eigen::Vector2d(turn * ((1 - u) * inner + u * outer));
          },
          n,
          n,
          no_layer);
      }
    return result;
  }

  constexpr double inner_radius = 0.95, outer_radius = 1.05;

  /** Slit along +2, with nodes of its own on both sides; with @p shift ≠ 0 they are at different radii. */
  CurvedMesh
  ring_with_slit(const CellKind kind, const double shift)
  {
    CurvedMesh result(kind);
    result.add(
      [shift](const double u, const double v) {
        const double depth = v + shift * u * v * (1 - v), r = outer_radius - (outer_radius - inner_radius) * depth,
                     // short cells at the ends
          turn = u - 0.7 * std::sin(2 * M_PI * u) / (2 * M_PI);
        return Eigen::Vector2d(r * std::cos(2 * M_PI * turn), r * std::sin(2 * M_PI * turn));
      },
      60,
      4,
      [](const double u) { return u > 0.5 ? 1 : 0; });
    return result;
  }
} // namespace



TEST(MeshSectionCurved, RoundBarsAreRound)
{
  const std::string degree = "    set Degree = 2\n";
  const auto        check  = [](const SectionValues &values, const std::string &what) {
    EXPECT_NEAR(values.inertia(0, 0) / (density_of_bar * M_PI), 1, 1e-6) << what;
    EXPECT_NEAR(values.stiffness(3, 3) / (in_shear * M_PI / 2), 1, 1e-6) << what;
    EXPECT_NEAR(values.stiffness(4, 4) / (elastic * M_PI / 4), 1, 1e-6) << what;
    EXPECT_NEAR(values.stiffness(0, 0) / (elastic * M_PI), 1, 1e-6) << what;
  };
  for (const CellKind kind : {CellKind::quadrilateral_8, CellKind::quadrilateral_9, CellKind::triangle_6})
    {
      const CurvedMesh mesh = disc(kind, 14);
      check(values_of_curved(curved_model(".msh", mesh.gmsh(), degree)), "gmsh " + std::to_string(int(kind)));
      if (kind != CellKind::quadrilateral_9)
        check(values_of_curved(curved_model(".inp", mesh.abaqus(), degree)), "abaqus " + std::to_string(int(kind)));
    }
  // the error falls with the fourth power of the length of sides
  double last = 0;
  for (const unsigned int n : {2u, 4u, 8u})
    {
      const double miss = std::abs(
        values_of_curved(curved_model(".msh", disc(CellKind::quadrilateral_8, n).gmsh(), degree)).inertia(0, 0) /
          (density_of_bar * M_PI) -
        1);
      if (last > 0)
        EXPECT_NEAR(std::log2(last / miss), 4, 0.2) << n;
      last = miss;
    }
  // straight elements lose it, and say so
  const auto remarks =
    remarks_of_curved(curved_model(".msh", disc(CellKind::quadrilateral_8, 4).gmsh(), "    set Degree = 1\n"));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].text.find("<Degree = 2>"), std::string::npos) << remarks[0].text;
}



TEST(MeshSectionCurved, SlitsStayOpenWithAnyNodes)
{
  const double       a = inner_radius, b = outer_radius, t = b - a, C = (b * b - a * a) / (2 * std::log(b / a));
  double             J = -0.21006 * std::pow(t, 4);
  const unsigned int n = 2000;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double r = a + t * (i + 0.5) / n;
      J += 2 * ((a * a - r * r) / 2 + C * std::log(r / a)) * 2 * M_PI * r * t / n;
    }
  for (const auto &[kind, shift] : {std::make_pair(CellKind::quadrilateral_9, 0.),
                                    std::make_pair(CellKind::quadrilateral_9, 0.4),
                                    std::make_pair(CellKind::triangle_6, 0.4)})
    {
      const std::string      model = curved_model(".msh", ring_with_slit(kind, shift).gmsh(), "    set Degree = 3\n");
      const SectionConstants constants(values_of_curved(model).stiffness.inverse(), Matrix6::Zero());
      const auto             number = [&](const std::string &name) {
        for (const auto &one : constants.list())
          if (one.name == name)
            return one.number;
        return std::nan("");
      };
      EXPECT_NEAR(number("GJ") / J, 1, 5e-4) << shift;
      EXPECT_NEAR(number("shear centre 2"), -2, 0.01) << shift;
      EXPECT_NEAR(number("shear centre 3"), 0, 0.01) << shift;
      const auto remarks = remarks_of_curved(model);
      ASSERT_EQ(remarks.size(), shift == 0 ? 1u : 2u);
      EXPECT_NE(remarks[0].text.find(shift == 0 ? "9 nodes lie at the places of others" :
                                                  "2 nodes lie at the places of others"),
                std::string::npos)
        << remarks[0].text;
      // triangles are divided at the middles of their sides
      const std::string n_touching = kind == CellKind::triangle_6 ? " 14" : " 6";
      if (shift != 0)
        EXPECT_NE(remarks[1].text.find(n_touching + " corners of cells lie on sides of others that do not have them"),
                  std::string::npos)
          << remarks[1].text;
    }
}



TEST(MeshSectionCurved, SaysWhatDoesNotHangTogether)
{
  const std::string of_file = "*ELEMENT, TYPE=CPS4, ELSET=all\n", curved = "*ELEMENT, TYPE=CPS8, ELSET=all\n";
  // a corner in the middle of a side whose ends it is joined with, and cells above that hold both together
  const std::string hanging = complaint_of(
    curved_model(".inp",
                 "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n5, 2, 0\n6, 2, 0.5\n7, 2, 1\n8, 1, 0.5\n9, 0, 2\n10, 1, "
                 "2\n11, 2, 2\n" +
                   of_file + "1, 1, 2, 3, 4\n2, 2, 5, 6, 8\n3, 8, 6, 7, 3\n4, 4, 3, 10, 9\n5, 3, 7, 11, 10\n",
                 "    set Degree = 2\n"));
  EXPECT_NE(hanging.find("cells must meet with whole sides"), std::string::npos) << hanging;
  // the same side curved: 9 is in its middle, 10 to 19 in those of others
  const std::string also = complaint_of(curved_model(
    ".inp",
    "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n5, 2, 0\n6, 2, 0.5\n7, 2, 1\n8, 1.1, 0.5\n9, 1.1, 0.5\n10, 0.5, "
    "0\n11, 0.5, 1\n12, 0, 0.5\n13, 1.5, 0\n14, 2, 0.25\n15, 1.55, 0.5\n16, 1.075, 0.25\n17, 2, 0.75\n18, 1.5, "
    "1\n19, 1.075, 0.75\n20, 0, 2\n21, 1, 2\n22, 2, 2\n" +
      curved + "1, 1, 2, 3, 4, 10, 9, 11, 12\n2, 2, 5, 6, 8, 13, 14, 15, 16\n3, 8, 6, 7, 3, 15, 17, 18, 19\n" +
      of_file + "4, 4, 3, 21, 20\n5, 3, 7, 22, 21\n",
    "    set Degree = 2\n"));
  EXPECT_NE(also.find("cells must meet with whole sides"), std::string::npos) << also;
  // a side with common ends and two middles
  const std::string two_middles =
    complaint_of(curved_model(".inp",
                              "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n5, 2, 0\n6, 2, 1\n7, 0.5, 0\n8, 1.1, 0.5\n9, "
                              "0.5, 1\n10, 0, 0.5\n" +
                                std::string("*ELEMENT, TYPE=CPS8, ELSET=all\n1, 1, 2, 3, 4, 7, 8, 9, 10\n") + of_file +
                                "2, 2, 5, 6, 3\n",
                              "    set Degree = 2\n"));
  EXPECT_NE(two_middles.find("cells 1 and 2"), std::string::npos) << two_middles;
  EXPECT_NE(two_middles.find("not the node in its middle"), std::string::npos) << two_middles;
  // third order
  std::string third = disc(CellKind::quadrilateral_9, 1).gmsh();
  third.replace(third.find("\n1 10 2"), 7, "\n1 36 2");
  EXPECT_NE(complaint_of(curved_model(".msh", third, "")).find("third or higher order (type 36)"), std::string::npos);
}
