// Meshes of Gmsh and Abaqus: what they give is what patches give, and what is refused.

#include <gtest/gtest.h>

#include <cstdio>

#include "models.h"

using namespace samara;

namespace
{
  /** A file beside the model, for as long as it is needed. */
  struct MeshFile
  {
    std::string name;

    MeshFile(const std::string &ending, const std::string &text)
      : name("mesh_" + std::to_string(getpid()) + ending)
    {
      std::ofstream(name) << text;
    }
    ~MeshFile()
    {
      std::remove(name.c_str());
    }
  };

  /** A quarter of a cylinder of radius 2 and length 3, n × n cells, some given the wrong way round. */
  struct Quarter
  {
    unsigned int n;

    Vector3
    at(const unsigned int i, const unsigned int j) const
    {
      const double angle = M_PI / 2 * j / n;
      return {3. * i / n, 2 * std::sin(angle), 2 * std::cos(angle)};
    }
    unsigned int
    number(const unsigned int i, const unsigned int j) const
    {
      return 1 + i + (n + 1) * j;
    }

    std::string
    gmsh(const std::string &cell_type = "3") const
    {
      std::ostringstream out;
      out.precision(17);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"root\"\n2 1 \"skin\"\n$EndPhysicalNames\n"
          << "$Nodes\n"
          << (n + 1) * (n + 1) << '\n';
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          out << number(i, j) << ' ' << at(i, j).transpose() << '\n';
      out << "$EndNodes\n$Elements\n" << n * n + n << '\n';
      for (unsigned int j = 0; j < n; ++j)
        out << j + 1 << " 1 2 7 1 " << number(0, j) << ' ' << number(0, j + 1) << '\n';
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            out << n + 1 + i + n * j << ' ' << cell_type << " 2 1 1 ";
            if ((i + j) % 2 == 0)
              out << number(i, j) << ' ' << number(i + 1, j) << ' ' << number(i + 1, j + 1) << ' ' << number(i, j + 1)
                  << '\n';
            else
              out << number(i + 1, j) << ' ' << number(i, j) << ' ' << number(i, j + 1) << ' ' << number(i + 1, j + 1)
                  << '\n';
          }
      out << "$EndElements\n";
      return out.str();
    }

    std::string
    abaqus() const
    {
      std::ostringstream out;
      out.precision(17);
      out << "*HEADING\nquarter\n*NODE\n";
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          out << number(i, j) << ", " << at(i, j)(0) << ", " << at(i, j)(1) << ", " << at(i, j)(2) << '\n';
      out << "*ELEMENT, TYPE=S4R, ELSET=skin\n";
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          out << 1 + i + n * j << ", " << number(i, j) << ", " << number(i + 1, j) << ", " << number(i + 1, j + 1)
              << ", " << number(i, j + 1) << '\n';
      out << "*NSET, NSET=root\n";
      for (unsigned int j = 0; j <= n; ++j)
        out << number(0, j) << ",\n";
      return out.str();
    }
  };

  /** The text of a model with this source of its surface in place of patches, bent by a load along a generator. */
  std::string
  model(const std::string &source, const std::string &root)
  {
    ShellModel model;
    model.patches    = "0, 0, 0";
    model.elements   = "4, 4";
    model.E          = 1e6;
    model.entries    = "";
    model.joints     = support("root", "s." + root, "all");
    model.loads      = " subsection f\n  set Type = area load\n  set Body = s\n  set Force = 0, 0, -1e-4\n end\n";
    std::string text = model.text();
    const auto  at   = text.find("  set Patches");
    text.replace(at, text.find('\n', at) - at, "  set " + source);
    return text;
  }

  double
  tip(const std::string &text)
  {
    Scene scene(text);
    scene.equilibrium();
    return scene.value("s.at 3 0 2.displacement z");
  }
} // namespace



// Normals at a free boundary are those of the straight cells there: the places are of second order.
TEST(ImportedShells, ConvergeToThoseOfPatches)
{
  const double   patch = tip(model("Patches = 3*u, 2*sin(pi/2*v), 2*cos(pi/2*v)", "edge u0"));
  const MeshFile coarse(".msh", Quarter{4}.gmsh()), same(".inp", Quarter{4}.abaqus());
  const double   four = tip(model("Mesh file = " + coarse.name, "edge root"));
  EXPECT_NEAR(tip(model("Mesh file = " + same.name, "edge root")), four, 1e-9 * std::abs(four));
  double eight = 0;
  {
    const MeshFile fine("_fine.msh", Quarter{8}.gmsh());
    eight = tip(model("Mesh file = " + fine.name, "edge root"));
  }
  EXPECT_LT(std::abs(eight / patch - 1), 0.5 * std::abs(four / patch - 1));
  EXPECT_LT(std::abs(eight / patch - 1), 0.1);
}



TEST(ImportedShells, SayWhatIsWrong)
{
  const auto expect = [](const std::string &ending, const std::string &text, const std::string &part) {
    const MeshFile    file(ending, text);
    const std::string complaint = complaint_of(model("Mesh file = " + file.name, "edge root"));
    EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
  };
  expect(".msh", Quarter{2}.gmsh("10"), "higher order (type 10)");
  expect(".msh", Quarter{2}.gmsh("2"), "there is a triangle");
  expect(".msh", "nothing\n", "no $MeshFormat");
  expect(".msh", "$MeshFormat\n2.2 1 8\n$EndMeshFormat\n", "binary");
  std::string text = Quarter{2}.gmsh();
  text.replace(text.find("$Nodes\n9\n1 0"), 12, "$Nodes\n9\n1 x");
  expect(".msh", text, ":11: <x> is not a number");
  text = Quarter{2}.abaqus();
  expect(".inp", text.substr(0, text.find("*NSET")) + "*ELEMENT, TYPE=S3\n9, 1, 2, 4\n", "there is a triangle (S3)");
  expect(".inp", text.substr(0, text.find("*ELEMENT")), "has no quadrilaterals");
  expect(".obj", text, "ends with .msh");

  // a band with a half turn: twelve cells, the last joined to the first the other way round
  std::ostringstream moebius;
  moebius << "*NODE\n";
  const unsigned int n = 12;
  for (unsigned int i = 0; i < n; ++i)
    for (const double side : {-1., 1.})
      {
        const double phi = 2 * M_PI * i / n, r = 3 + side * std::cos(phi / 2);
        moebius << 1 + 2 * i + (side > 0) << ", " << r * std::cos(phi) << ", " << r * std::sin(phi) << ", "
                << side * std::sin(phi / 2) << '\n';
      }
  moebius << "*ELEMENT, TYPE=S4\n";
  for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int a = 1 + 2 * i, b = a + 1, c = i + 1 < n ? a + 2 : 2, d = i + 1 < n ? a + 3 : 1;
      moebius << i + 1 << ", " << a << ", " << c << ", " << d << ", " << b << '\n';
    }
  expect(".inp", moebius.str(), "one side only");
}
