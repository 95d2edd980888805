// Elements that turn by more than they represent are told. The deep arch with 10 cubic elements follows a wrong path
// beyond its limit load: at the end the crown is 90 from where it is with 16 or more elements (doc/theory/element.md).

#include <samara/analysis/dynamic.h>

#include <gtest/gtest.h>

#include "entries.h"

using namespace samara;

namespace
{
  bool
  warns(const Scene &scene)
  {
    return scene.stream.str().find("turns by") != std::string::npos;
  }
} // namespace



TEST(CoarseMeshes, TheWrongPathOfTheDeepArchIsTold)
{
  const auto crown = [](Scene &scene) {
    scene.equilibrium();
    return Vector3(scene.value("arch.middle.displacement x"), scene.value("arch.middle.displacement y"), 0);
  };
  const std::string file = "prm/benchmarks/stability/deep_arch_path.prm";
  Scene             coarse(file, mesh("arch", 3, 10)), fine(file, mesh("arch", 3, 16));
  const Vector3     x = crown(coarse), exact(-6.0257, -207.7465, 0);
  EXPECT_GT((x - exact).norm(), 50);
  EXPECT_TRUE(warns(coarse));
  EXPECT_NE(coarse.stream.str().find("static, load factor "), std::string::npos);
  EXPECT_NE(coarse.stream.str().find("beam <arch> from 0."), std::string::npos) << coarse.stream.str();
  EXPECT_LT((crown(fine) - exact).norm(), 0.1);
  EXPECT_FALSE(warns(fine)) << fine.stream.str();
}



// A rod bent to a circle by a moment: angles of elements are about 2π/n.
TEST(CoarseMeshes, ByTheAngleOfAnElementOfEachDegree)
{
  for (const auto &[degree, coarse, fine] : {std::array<unsigned int, 3>{{1, 24, 30}}, {{2, 6, 8}}})
    {
      Scene a("prm/benchmarks/roll_up.prm", mesh("beam", degree, coarse)),
        b("prm/benchmarks/roll_up.prm", mesh("beam", degree, fine));
      a.equilibrium();
      b.equilibrium();
      EXPECT_TRUE(warns(a)) << degree;
      EXPECT_FALSE(warns(b)) << degree << b.stream.str();
    }
}



// A single quadratic element that swings like an S: its ends are parallel, in between it turns.
TEST(CoarseMeshes, BySectionsThatTurnInBetween)
{
  const std::string model =
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 1e4\n set GA2 = 1e4\n"
    " set GA3 = 1e4\n set GJ = 1\n set EI2 = 1\n set EI3 = 1\n set Mass = 1\n end\nend\nsubsection Bodies\n"
    " subsection rod\n set Type = beam\n set Points = 0, 0, 0; 1, 0, 0\n set Section = s\n set Elements = 1\n"
    " set Degree = 2\n end\n subsection block\n set Type = rigid body\n set Mass = 1\n set Position = 1, 0, 0\n end\nend\n"
    "subsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = rod.start\n end\n"
    " subsection hold\n set Type = rigid\n set Body A = rod.end\n set Body B = block.centre\n end\n"
    " subsection guide\n set Type = planar\n set Body A = ground\n set Body B = block.centre\n set Axis = 0, 1, 0\n"
    " subsection rotation\n set Prescribed = 0\n end\n end\nend\n"
    "subsection Loads\n subsection p\n set Type = point load\n set At = rod.end\n set Force = 0, 0, P\n end\nend\n";
  for (const double force : {0.1, 2.})
    {
      std::string text = model;
      text.replace(text.find(", P"), 3, ", " + std::to_string(force));
      Scene scene(text);
      scene.equilibrium();
      EXPECT_EQ(warns(scene), force > 1) << force << scene.stream.str();
    }
}



// The strip of doc/theory/element.md: 0.7 kN in tension, N (h/p)²/EI = 16.8 with 4 elements of degree 3.
TEST(CoarseMeshes, UnderStrongTension)
{
  const std::string model =
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 7e6\n set GA2 = 2.2e6\n"
    " set GA3 = 2.2e6\n set GJ = 0.4\n set EI2 = 0.29\n set EI3 = 2400\n set Mass = 0.27\n end\nend\n"
    "subsection Bodies\n subsection strip\n set Type = beam\n set Points = 0, 0, 0; 1, 0, 0\n set Section = s\n"
    " set Elements = 4\n set Degree = 3\n end\nend\n"
    "subsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = strip.start\n end\n"
    "end\nsubsection Loads\n subsection pull\n set Type = point load\n set At = strip.end\n"
    " set Force = 700, 0, 0\n end\nend\n";
  for (const unsigned int elements : {4, 8})
    {
      Scene scene(model, mesh("strip", 3, elements));
      scene.equilibrium();
      const bool told = scene.stream.str().find("N (h/p)^2/EI = 16.8") != std::string::npos;
      EXPECT_EQ(told, elements == 4) << scene.stream.str();
      EXPECT_EQ(scene.stream.str().find("too soft in bending") != std::string::npos, elements == 4);
    }
}
