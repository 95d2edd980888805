// What files of meshes name: physical groups of Gmsh, sets of Abaqus. A plate of two halves with layups of their own is
// that of two patches; forces on regions and through regions are in equilibrium; what is not there is refused by name.

#include <gtest/gtest.h>

#include <cstdio>

#include "models.h"

using namespace samara;

namespace
{
  /** A file beside the model, for as long as it is needed. */
  struct FileOfMesh
  {
    std::string name;

    FileOfMesh(const std::string &ending, const std::string &text)
      : name("regions_" + std::to_string(getpid()) + ending)
    {
      std::ofstream(name) << text;
    }
    ~FileOfMesh()
    {
      std::remove(name.c_str());
    }
  };

  /** A plate of 2 m x 1 m, 4 x 2 cells: the halves <left> and <right>, the curves <root> and <middle>, the point <tip>
   * at (2, 0.5), and <pad>, the last column of <right>. */
  unsigned int
  number(const unsigned int i, const unsigned int j)
  {
    return 1 + i + 5 * j;
  }

  void
  write_nodes(std::ostream &out, const std::string &separator)
  {
    for (unsigned int j = 0; j <= 2; ++j)
      for (unsigned int i = 0; i <= 4; ++i)
        out << number(i, j) << separator << 0.5 * i << separator << 0.5 * j << separator << "0\n";
  }

  std::string
  cell(const unsigned int i, const unsigned int j, const std::string &separator)
  {
    std::ostringstream out;
    out << number(i, j) << separator << number(i + 1, j) << separator << number(i + 1, j + 1) << separator
        << number(i, j + 1) << '\n';
    return out.str();
  }

  /** Format 2.2: the cells of the pad are there twice, once for each of their groups. */
  std::string
  gmsh_2()
  {
    std::ostringstream out;
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n0 9 \"tip\"\n1 1 \"root\"\n1 2 \"middle\"\n"
           "2 1 \"left\"\n2 2 \"right\"\n2 3 \"pad\"\n$EndPhysicalNames\n$Nodes\n15\n";
    write_nodes(out, " ");
    out << "$EndNodes\n$Elements\n15\n1 15 2 9 1 " << number(4, 1) << '\n';
    unsigned int element = 1;
    for (unsigned int line = 0; line < 2; ++line)
      for (unsigned int j = 0; j < 2; ++j)
        out << ++element << " 1 2 " << line + 1 << " 1 " << number(2 * line, j) << ' ' << number(2 * line, j + 1)
            << '\n';
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int i = 0; i < 4; ++i)
        out << ++element << " 3 2 " << (i < 2 ? 1 : 2) << " 1 " << cell(i, j, " ");
    for (unsigned int j = 0; j < 2; ++j)
      out << ++element << " 3 2 3 1 " << cell(3, j, " ");
    out << "$EndElements\n";
    return out.str();
  }

  /** Format 4.1: surface 3 is in two groups. */
  std::string
  gmsh_4()
  {
    std::ostringstream out;
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n0 9 \"tip\"\n1 1 \"root\"\n1 2 \"middle\"\n"
           "2 1 \"left\"\n2 2 \"right\"\n2 3 \"pad\"\n$EndPhysicalNames\n$Entities\n1 2 3 0\n7 2 0.5 0 1 9 \n"
           "1 0 0 0 0 1 0 1 1 0 \n2 1 0 0 1 1 0 1 2 0 \n"
           "1 0 0 0 1 1 0 1 1 0 \n2 1 0 0 1.5 1 0 1 2 0 \n3 1.5 0 0 2 1 0 2 2 3 0 \n$EndEntities\n$Nodes\n1 15 1 15\n"
           "2 1 0 15\n";
    for (unsigned int i = 1; i <= 15; ++i)
      out << i << '\n';
    for (unsigned int j = 0; j <= 2; ++j)
      for (unsigned int i = 0; i <= 4; ++i)
        out << 0.5 * i << ' ' << 0.5 * j << " 0\n";
    out << "$EndNodes\n$Elements\n6 13 1 13\n0 7 15 1\n1 " << number(4, 1) << '\n';
    unsigned int element = 1;
    for (unsigned int line = 0; line < 2; ++line)
      {
        out << "1 " << line + 1 << " 1 2\n";
        for (unsigned int j = 0; j < 2; ++j)
          out << ++element << ' ' << number(2 * line, j) << ' ' << number(2 * line, j + 1) << '\n';
      }
    const unsigned int first[4] = {0, 2, 3, 4};
    for (unsigned int surface = 0; surface < 3; ++surface)
      {
        out << "2 " << surface + 1 << " 3 " << 2 * (first[surface + 1] - first[surface]) << '\n';
        for (unsigned int j = 0; j < 2; ++j)
          for (unsigned int i = first[surface]; i < first[surface + 1]; ++i)
            out << ++element << ' ' << cell(i, j, " ");
      }
    out << "$EndElements\n";
    return out.str();
  }

  std::string
  abaqus()
  {
    std::ostringstream out;
    out << "*NODE\n";
    write_nodes(out, ", ");
    for (unsigned int half = 0; half < 2; ++half)
      {
        out << "*ELEMENT, TYPE=S4, ELSET=" << (half == 0 ? "left" : "right") << '\n';
        for (unsigned int j = 0; j < 2; ++j)
          for (unsigned int i = 2 * half; i < 2 * half + 2; ++i)
            out << 1 + i + 4 * j << ", " << cell(i, j, ", ");
      }
    out << "*ELSET, ELSET=pad\n4, 8\n*NSET, NSET=root, GENERATE\n1, 11, 5\n*NSET, NSET=middle\n3, 8, 13\n"
           "*NSET, NSET=tip\n10\n";
    return out.str();
  }

  /** A cantilever of two halves under a pressure on the second, a line load at its root and a force at its tip. */
  std::string
  cantilever(const std::string &surface,
             const std::string &root,
             const std::string &second,
             const std::string &edge,
             const std::string &tip)
  {
    return R"(
subsection Materials
  subsection ply
    set Type    = orthotropic
    set E1      = 100e9
    set E2      = 10e9
    set G12     = 5e9
    set nu12    = 0.3
    set Density = 1500
  end
end
subsection Layups
  subsection thick
    set Plies = ply, 0, 5 mm; ply, 90, 5 mm; ply, 0, 5 mm
  end
  subsection oblique
    set Plies = ply, 30, 4 mm; ply, 0, 4 mm
  end
end
subsection Bodies
  subsection s
    set Type   = shell
    set Degree = 2
    set Axis 1 = 1, 0, 0
)" + surface +
           R"(  end
end
subsection Joints
  subsection root
    set Type  = support
    set Along = s.)" +
           root + R"(
  end
end
subsection Loads
  subsection wind
    set Type     = pressure
    set Body     = s
    set Region   = )" +
           second + R"(
    set Pressure = 200
  end
  subsection snow
    set Type   = area load
    set Body   = s
    set Region = )" +
           second + R"(
    set Force  = 30, 0, -100
  end
  subsection seam
    set Type  = line load
    set Body  = s
    set Edge  = )" +
           edge + R"(
    set Force = 0, 20, 50
  end
  subsection pull
    set Type  = point load
    set At    = s.)" +
           tip + R"(
    set Force = 0, 30, -40
  end
end
)";
  }

  std::vector<double>
  bent(const std::string &model, const std::string &tip)
  {
    Scene scene(model);
    scene.equilibrium();
    std::vector<double> result;
    for (const std::string quantity : {"displacement x", "displacement y", "displacement z", "angle 1", "angle 2"})
      result.push_back(scene.value("s." + tip + "." + quantity));
    return result;
  }

  const std::string of_regions = "    set Region layups = left, thick; right, oblique\n";
} // namespace



TEST(RegionsOfMeshes, AreThePatchesTheyCover)
{
  const std::string patches = "    set Patches = u, v, 0; 1 + u, v, 0\n    set Elements = 2, 2\n"
                              "    set Patch layups = thick, oblique\n    set Frames = tip at 2 0.5 0\n";
  const auto        wanted  = bent(cantilever(patches, "edge u0", "patch 2", "edge u1", "tip"), "tip");
  EXPECT_GT(std::abs(wanted[2]), 1e-3);
  for (const auto &[ending, text] : {std::pair<std::string, std::string>(".msh", gmsh_2()),
                                     std::pair<std::string, std::string>(".msh", gmsh_4()),
                                     std::pair<std::string, std::string>(".inp", abaqus())})
    {
      const FileOfMesh  file(ending, text);
      const std::string surface = "    set Mesh file = " + file.name + "\n";
      const auto        found =
        bent(cantilever(surface + of_regions, "edge root", "region right", "edge middle", "point tip"), "point tip");
      // a layup of the rest, and a frame with a name of its own
      const auto other =
        bent(cantilever(surface + "    set Layup = thick\n    set Region layups = region right, oblique\n"
                                  "    set Frames = end at point tip\n",
                        "edge root",
                        "right",
                        "edge middle",
                        "end"),
             "end");
      for (unsigned int i = 0; i < wanted.size(); ++i)
        {
          EXPECT_NEAR(found[i], wanted[i], 1e-8 * std::abs(wanted[2])) << ending << ", number " << i;
          EXPECT_NEAR(other[i], wanted[i], 1e-8 * std::abs(wanted[2])) << ending << ", number " << i;
        }
    }
}



// Forces on the pad and on the halves go through a region to the ground: their sum, and their moment about its
// centroid, in the deformed state, which differs by little. Held by the region <left>, whose centroid is at (0.5, 0.5).
TEST(RegionsOfMeshes, AreInEquilibrium)
{
  const FileOfMesh file(".msh", gmsh_4());
  Scene            scene("subsection Bodies\n subsection s\n  set Type = shell\n  set Mesh file = " + file.name +
              "\n  set Degree = 2\n  set E = 1e12\n  set Thickness = 0.05\n  set Density = 1\n end\nend\n"
                         "subsection Joints\n subsection hold\n  set Type = distributing\n  set Along = s.region left\n"
                         "  set Body = ground\n end\nend\n"
                         "subsection Loads\n subsection pad\n  set Type = area load\n  set Body = s\n  set Region = pad\n"
                         "  set Force = 0, 0, 100\n end\n subsection right\n  set Type = pressure\n  set Body = s\n"
                         "  set Region = right\n  set Pressure = 10\n end\nend\n");
  scene.equilibrium();
  const double forces = 100 * 0.5 + 10 * 1, moments = 100 * 0.5 * (1.75 - 0.5) + 10 * 1 * (1.5 - 0.5);
  EXPECT_NEAR(std::abs(scene.value("hold.force 3")), forces, 1e-5 * forces);
  EXPECT_NEAR(std::abs(scene.value("hold.moment 2")), moments, 1e-5 * moments);
  EXPECT_NEAR(scene.value("hold.moment 1"), 0., 1e-5 * moments);
}



// Two rigid regions with a hinge to the ground at one: what is between them bends, they do not.
TEST(RegionsOfMeshes, CanBeRigid)
{
  const FileOfMesh file(".msh", gmsh_2());
  Scene            scene("subsection Bodies\n subsection s\n  set Type = shell\n  set Mesh file = " + file.name +
              "\n  set Degree = 2\n  set E = 1e9\n  set Thickness = 0.02\n  set Density = 1\n"
                         "  set Rigid edges = end at region pad, seat at region left\n end\nend\n"
                         "subsection Joints\n subsection hold\n  set Type = rigid\n  set Body A = ground\n"
                         "  set Body B = s.seat\n end\nend\n"
                         "subsection Loads\n subsection pull\n  set Type = point load\n  set At = s.end\n"
                         "  set Force = 0, 0, 10\n end\nend\n");
  EXPECT_NEAR(scene.value("s.end.position x"), 1.75, 1e-12);
  EXPECT_NEAR(scene.value("s.seat.position x"), 0.5, 1e-12);
  scene.equilibrium();
  // a beam of 0.5 m, clamped at both ends but for what moves: w and angle at the pad's inner edge under a force at its
  // centre, a quarter of a metre further; a plate as wide as long is between a beam's EI and that over 1 - nu^2
  const double l = 0.5, a = 0.25, F = 10, EI = 1e9 * std::pow(0.02, 3) / 12,
               w = F * l * l * l / (3 * EI) + F * a * l * l / (2 * EI), angle = F * l * l / (2 * EI) + F * a * l / EI;
  EXPECT_LT(std::abs(scene.value("s.end.displacement z")), 1.03 * (w + a * angle));
  EXPECT_GT(std::abs(scene.value("s.end.displacement z")), 0.91 * (w + a * angle));
  const auto from_end = [&](const std::string &axis) {
    return scene.value("s.point tip.position " + axis) - scene.value("s.end.position " + axis);
  };
  EXPECT_GT(from_end("z"), 0.25 * angle / 2);
  EXPECT_NEAR(std::hypot(from_end("x"), from_end("z")), 0.25, 1e-12);
}



TEST(RegionsOfMeshes, WhatIsNotThereIsRefused)
{
  const FileOfMesh  file(".msh", gmsh_4());
  const std::string surface = "    set Mesh file = " + file.name + "\n";
  const std::string groups =
    " has the point <tip>, the curves <middle>, <root>, and the surfaces <left>, <pad>, <right>";
  const auto expect = [&](const std::string &model, const std::vector<std::string> &parts) {
    const std::string complaint = complaint_of(model);
    for (const auto &part : parts)
      EXPECT_NE(complaint.find(part), std::string::npos) << complaint << "\nwithout\n" << part;
  };
  const auto model =
    [&](const std::string &layups, const std::string &root, const std::string &region, const std::string &tip) {
      return cantilever(surface + layups, root, region, "edge middle", tip);
    };
  const std::string r = "edge root", t = "point tip";
  expect(model(of_regions, "edge roots", "right", t), {"has no point <edge roots>", "<edge middle>, <edge root>"});
  expect(model(of_regions, r, "rigth", t), {"has no region <rigth>; known: region left", groups});
  expect(model(of_regions, r, "right", "point tips"), {"has no point <point tips>; did you mean <point tip>?", groups});
  expect(model("    set Region layups = left, thick\n", r, "right", t),
         {"is in none of the regions that have a layup", groups});
  expect(model("    set Region layups = left, thick; right, oblique; pad, thick\n", r, "right", t),
         {"is in the regions <right> and <pad>"});
  expect(model("    set Region layups = left, thick; wing, oblique\n", r, "right", t),
         {"has no region <wing>", groups});
  expect(model("    set Region layups = left, thick; right, oblong\n", r, "right", t), {"there is no layup <oblong>"});
  expect(model("    set Region layups = left\n", r, "right", t), {"is written <region, layup>"});

  std::string bare = gmsh_2();
  for (const std::string part : {"$PhysicalNames", "$Elements"})
    bare.erase(bare.find(part), bare.find("$End" + part.substr(1)) - bare.find(part));
  bare += "$Elements\n2\n1 3 2 0 1 " + cell(0, 0, " ") + "2 3 2 0 1 " + cell(1, 0, " ") + "$EndElements\n";
  const FileOfMesh none("_bare.msh", bare);
  expect(
    cantilever("    set Layup = thick\n    set Mesh file = " + none.name + "\n", r, "right", "edge middle", "at 1 0 0"),
    {"has no region <right>", " has no physical groups and no sets"});
}
