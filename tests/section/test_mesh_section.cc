/*
 * Problem:   sections of a mesh of Gmsh or Abaqus, with groups of materials and fibres
 * Reference: the same bodies as shapes of their own
 */

#include <samara/cosserat/mesh_section.h>
#include <samara/section/section_constants.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "stiffness.h"

using namespace samara;

namespace
{
  const std::string of_meshes = R"(
subsection Materials
  subsection metal
    set Type          = isotropic
    set E             = 100
    set Poisson ratio = 0.2
    set Density       = 3
  end
  subsection soft
    set Copy of = metal
    set E       = 10
  end
  subsection ply
    set Type = orthotropic
    set E1   = 140
    set E2   = 10
    set G12  = 5
    set nu12 = 0.3
    set nu23 = 0.4
    set Density = 1
  end
end
subsection Layups
  subsection hybrid
    set Plies = metal, 0, 0.1; soft, 0, 0.1
  end
  subsection helix
    set Plies = ply, 20, 0.05; ply, -40, 0.05
  end
end
)";

  std::string
  mesh_model(const std::string &entries)
  {
    return of_meshes + "subsection Sections\n  subsection s\n" + entries +
           "  end\nend\nsubsection Bodies\n  subsection b\n    set Type = rigid body\n    set Mass = 1\n"
           "    set Inertia = 1, 1, 1\n  end\nend\n";
  }

  Matrix6
  stiffness_of_mesh(const std::string &entries)
  {
    const Scene scene(mesh_model(entries));
    return scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero()).stiffness;
  }

  /** A grid of cells n × m, places by (i/n, j/m), in two groups: the lower and the upper half. */
  struct Grid
  {
    unsigned int                                   n, m;
    bool                                           is_ring;
    std::function<Eigen::Vector2d(double, double)> place;

    unsigned int
    node(const unsigned int i, const unsigned int j) const
    {
      return 1 + (is_ring ? i % n : i) + (is_ring ? n : n + 1) * j;
    }

    std::string
    nodes(const std::string &separator, const bool with_z) const
    {
      std::ostringstream out;
      out.precision(17);
      for (unsigned int j = 0; j <= m; ++j)
        for (unsigned int i = 0; i < n + (is_ring ? 0 : 1); ++i)
          {
            const auto x = place(double(i) / n, double(j) / m);
            out << node(i, j) << separator << x(0) << separator << x(1) << (with_z ? separator + "0" : "") << '\n';
          }
      return out.str();
    }

    unsigned int
    n_nodes() const
    {
      return (m + 1) * (n + (is_ring ? 0 : 1));
    }

    /** Format 2.2; the outer line is j = 0. */
    std::string
    gmsh(const bool triangles) const
    {
      std::ostringstream cells;
      unsigned int       number = 0;
      for (unsigned int i = 0; i < n; ++i)
        cells << ++number << " 1 2 9 1 " << node(i, 0) << ' ' << node(i + 1, 0) << '\n';
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int group = 2 * j < m ? 1 : 2, a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1),
                               d = node(i, j + 1);
            // every second quadrilateral as two triangles
            if (triangles && (i + j) % 2 == 0)
              {
                cells << ++number << " 2 2 " << group << " 1 " << a << ' ' << b << ' ' << c << '\n';
                cells << ++number << " 2 2 " << group << " 1 " << c << ' ' << a << ' ' << d << '\n';
              }
            else
              cells << ++number << " 3 2 " << group << " 1 " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
          }
      return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 9 \"outer\"\n2 1 \"lower\"\n2 2 \"upper\"\n"
             "$EndPhysicalNames\n$Nodes\n" +
             std::to_string(n_nodes()) + "\n" + nodes(" ", true) + "$EndNodes\n$Elements\n" + std::to_string(number) +
             "\n" + cells.str() + "$EndElements\n";
    }

    std::string
    abaqus() const
    {
      std::ostringstream cells, upper;
      unsigned int       number = 0;
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            cells << ++number << ", " << node(i, j) << ", " << node(i, j + 1) << ", " << node(i + 1, j + 1) << ", "
                  << node(i + 1, j) << '\n';
            if (2 * j >= m)
              upper << number << ",\n";
          }
      return "*NODE\n" + nodes(", ", false) + "*ELEMENT, TYPE=CPS4\n" + cells.str() + "*ELSET, ELSET=upper\n" +
             upper.str() + "*ELSET, ELSET=lower, GENERATE\n1, " + std::to_string(n * (m / 2)) + "\n";
    }
  };

  std::string
  mesh_file(const std::string &ending, const std::string &text)
  {
    const std::string name = ::testing::TempDir() + "section_mesh" + ending;
    std::ofstream(name) << text;
    return "    set Type = mesh\n    set Mesh file = " + name + "\n";
  }

  const Grid strip{4, 4, false, [](const double u, const double v) { return Eigen::Vector2d(u - 0.5, 0.2 * v - 0.1); }};
} // namespace



TEST(MeshSection, IsTheStripOfItsCells)
{
  const Matrix6     wanted = stiffness_of_mesh("    set Type = rectangle\n    set Width 2 = 1\n    set Layup = hybrid\n"
                                               "    set Elements = 4\n    set Elements per ply = 2\n");
  const std::string groups = "    set Groups = lower, metal; upper, soft\n";
  EXPECT_LT(difference(stiffness_of_mesh(mesh_file(".msh", strip.gmsh(false)) + groups), wanted), 1e-10);
  EXPECT_LT(difference(stiffness_of_mesh(mesh_file(".inp", strip.abaqus()) + groups), wanted), 1e-10)
    << "cells that are given clockwise";
  EXPECT_LT(difference(stiffness_of_mesh(mesh_file(".msh", strip.gmsh(true)) + groups + "    set Degree = 4\n"),
                       wanted),
            5e-3)
    << "triangles, divided";
  EXPECT_NEAR(stiffness_of_mesh(mesh_file(".msh", strip.gmsh(true)) + groups)(0, 0), 0.1 * 110, 1e-9) << "E A";
  // in millimetres
  Grid in_mm  = strip;
  in_mm.place = [](const double u, const double v) { return Eigen::Vector2d(1000 * (u - 0.5), 200 * v - 100); };
  EXPECT_LT(difference(stiffness_of_mesh(mesh_file(".msh", in_mm.gmsh(false)) + groups +
                                         "    set Length unit = 1 mm\n"),
                       wanted),
            1e-10);
}



// A tube of helical plies: layers follow the outer circle; moved and turned as well.
TEST(MeshSection, LayersFollowACurve)
{
  const Grid        ring{64, 4, true, [](const double u, const double v) {
                    const double r = 0.5 - 0.1 * v;
                    return Eigen::Vector2d(r * std::cos(2 * M_PI * u), r * std::sin(2 * M_PI * u));
                  }};
  const std::string groups = "    set Groups = lower, ply, 20, outer; upper, ply, -40, outer\n    set Degree = 2\n",
                    tube =
                      "    set Type = tube\n    set Outer radius = 0.5\n    set Layup = helix\n    set Degree = 2\n"
                      "    set Elements = 16\n",
                    place = "    set Position = 0.3, -0.2\n    set Rotation = 25 deg\n";
  const std::string file  = mesh_file(".msh", ring.gmsh(false));
  EXPECT_LT(difference(stiffness_of_mesh(file + groups), stiffness_of_mesh(tube)), 6e-3) << "straight cells";
  EXPECT_LT(difference(stiffness_of_mesh(file + groups + place), stiffness_of_mesh(tube + place)), 6e-3);
  // a strip whose layers stand upright is one that is turned
  const Matrix6 upright = stiffness_of_mesh(mesh_file(".msh", strip.gmsh(false)) +
                                            "    set Groups = lower, ply, 30, 90; upper, ply, 30, 90\n"),
                lying   = stiffness_of_mesh(mesh_file(".msh", strip.gmsh(false)) +
                                          "    set Groups = lower, ply, 30, 0; upper, ply, 30, 0\n");
  EXPECT_GT(difference(upright, lying), 0.1);
}



namespace
{
  /** A ring of radius 1 and thickness 0.1 whose ends, at u = 0 and 1, have nodes of their own at the same places. */
  const Grid slit_ring{60, 2, false, [](const double u, const double v) {
                         const double r = 1.05 - 0.1 * v;
                         return Eigen::Vector2d(r * std::cos(2 * M_PI * u), r * std::sin(2 * M_PI * u));
                       }};
} // namespace



// A ring that is slit: GJ = G 2πR t³/3 (less 0.63 t⁴/3 of the ends), and its shear centre lies 2 R beside the middle,
// away from the slit (Timoshenko). Closed, its GJ is 2πR³t G, 300 times as much.
TEST(MeshSection, SlitsStayOpen)
{
  const double      G = 100 / 2.4, t = 0.1;
  const std::string groups = "    set Groups = lower, metal; upper, metal\n";
  for (const bool triangles : {false, true})
    {
      const std::string file = mesh_file(".msh", slit_ring.gmsh(triangles)) + groups;
      const Matrix6     open = stiffness_of_mesh(file), closed = stiffness_of_mesh(file + "    set Merge = true\n");
      const SectionConstants of_open(open.inverse(), Matrix6::Zero());
      const auto             number = [&](const std::string &name) {
        for (const auto &one : of_open.list())
          if (one.name == name)
            return one.number;
        return std::nan("");
      };
      EXPECT_NEAR(number("GJ") / (G * (2 * M_PI * t * t * t / 3 - 0.21 * std::pow(t, 4))), 1, 1e-2) << triangles;
      EXPECT_NEAR(number("shear centre 2"), -2, 0.02) << triangles;
      EXPECT_NEAR(number("shear centre 3"), 0, 1e-2) << triangles;
      EXPECT_NEAR(closed(3, 3) / (G * 2 * M_PI * t), 1, 2e-2) << triangles;
    }
  // said by number
  const Scene scene(mesh_model(mesh_file(".msh", slit_ring.gmsh(false)) + groups));
  const auto  remarks = dynamic_cast<const HasRemarks &>(scene.input.model.find<Section>("s", "section")).remarks();
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].text.find("3 nodes lie at the places of others and are kept apart"), std::string::npos)
    << remarks[0].text;
  // parts that do not hang together say what would join them
  const std::string apart = complaint_of(mesh_model(
    mesh_file(".inp",
              "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n5, 1, 0\n6, 2, 0\n7, 2, 1\n8, 1, 1\n"
              "*ELEMENT, TYPE=CPS4, ELSET=lower\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=CPS4, ELSET=upper\n2, 5, 6, 7, 8\n") +
    groups));
  EXPECT_NE(apart.find("<Merge = true>"), std::string::npos) << apart;
}



TEST(MeshSection, SaysWhatIsWrong)
{
  const auto says = [](const std::string &entries, const std::string &wanted) {
    const std::string text = complaint_of(mesh_model(entries));
    EXPECT_NE(text.find(wanted), std::string::npos) << wanted << ", not " << text;
    EXPECT_NE(text.find(".prm:"), std::string::npos) << text;
  };
  const std::string good = strip.gmsh(false), both = "    set Groups = lower, metal; upper, soft\n";
  const auto        changed = [&](const std::string &from, const std::string &to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return mesh_file(".msh", text);
  };
  says(mesh_file(".msh", good) + "    set Groups = lower, metal\n", "8 cells of");
  says(mesh_file(".msh", good) + "    set Groups = lower, metal; uper, soft\n", "did you mean <upper>");
  says(mesh_file(".msh", good) + "    set Groups = lower, metal; upper, soap\n", "did you mean <soft>");
  says(mesh_file(".msh", good) + "    set Groups = lower, metal; upper, ply, 30, out\n",
       "neither an angle nor a group");
  says(mesh_file(".msh", good) + "    set Groups = lower, metal; upper, ply, 30 deg\n", "a number, in degrees");
  says(mesh_file(".msh", good), "<Groups>");
  says(mesh_file(".msh", good) + both + "    set Elements = 3\n", "no effect");
  says("    set Type = mesh\n" + both, "<Mesh file>");
  says(changed("3 2 1 1 1 2 7 6", "3 2 1 1 1 2 6 7") + both, "turned inside out");
  says(changed("3 2 1 1 1 2 7 6", "3 2 1 1 2 3 8 7") + both, "is there twice");
  says(changed("\n7 -0.25", "\n7 -0.6") + both, "of group <lower> is turned inside out");
  says(changed("\n1 -0.5 -0.10000000000000001 0\n", "\n1 -0.5 -0.1 0.3\n") + both, "do not lie in a plane");
  says(changed("3 2 1 1 1 2 7 6", "36 2 1 1 1 2 7 6") + both, "higher order");
}
