// Sections: centres, tables, and the engineering stiffnesses of simple shapes.
//
// References: closed forms of straight members that hold for displacements and rotations of any size, because nothing
// but extension, twist or a plane rotation comes about: u = ∫ F/EA, angle of twist ∫ M/GJ, angle of bending ∫ M/EI.

#include <samara/cosserat/beam.h>
#include <samara/cosserat/section.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A cantilever of length 2 along x with axis 2 along y; the load acts on a plate at its end, at (2, y, z). */
  std::string
  cantilever_with_plate(const std::string &sections, const std::string &load, const std::string &y_z = "0 0")
  {
    return "subsection Sections\n" + sections + "\nend\nsubsection Bodies\n subsection beam\n set Type = beam\n" +
           " set Points = 0, 0, 0; 2, 0, 0\n set Axis 2 = 0, 1, 0\n set Section = s\n set Elements = 4\n end\n" +
           " subsection plate\n set Type = rigid body\n set Position = 2, 0, 0\n set Frames = point at 2 " + y_z +
           "\n end\nend\nsubsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n" +
           " set Body B = beam.start\n end\n subsection weld\n set Type = rigid\n set Body A = beam.end\n" +
           " set Body B = plate.centre\n end\nend\nsubsection Loads\n subsection p\n set Type = point load\n" +
           " set At = plate.point\n set " + load + "\n end\nend\n";
  }

  std::string
  constants(const std::string &name, const double factor, const std::string &centres = "")
  {
    std::string text = "subsection " + name + "\n set Type = engineering constants\n set Mass = 1\n";
    for (const auto &[entry, value] :
         {std::make_pair("EA", 100.), {"GA2", 80.}, {"GA3", 70.}, {"GJ", 2.}, {"EI2", 3.}, {"EI3", 4.}})
      text += std::string(" set ") + entry + " = " + std::to_string(factor * value) + "\n";
    return text + centres + " end\n";
  }

  double
  value(const std::string &text, const std::string &probe, const std::vector<std::string> &overrides = {})
  {
    Scene scene(text, overrides);
    scene.equilibrium();
    return scene.value(probe);
  }
} // namespace



// A force through the tension centre stretches and does nothing else: Γ₁ = F/EA.
// (Much larger forces reach a stability limit: twist about the shear centre, once F d² is of the size of GJ.)
TEST(Sections, ForceAtTheTensionCentreDoesNotBend)
{
  Scene scene(cantilever_with_plate(
    constants("s", 1, " set Tension centre = 0.2, -0.3\n set Shear centre = 0.1, 0.4\n set EI23 = 0.5\n"),
    "Force = 4, 0, 0",
    "0.2 -0.3"));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("beam.end.displacement x"), 2 * 4. / 100, 1e-13);
  for (const std::string probe : {"displacement y", "displacement z", "rotation x", "rotation y", "rotation z"})
    EXPECT_NEAR(scene.value("beam.end." + probe), 0., 1e-11) << probe;
  // away from it, it bends: by the moment F (y₃ K₂ − y₂ K₃) about the tension centre
  EXPECT_GT(std::abs(
              value(cantilever_with_plate(constants("s", 1, " set Tension centre = 0.2, -0.3\n"), "Force = 0.2, 0, 0"),
                    "beam.end.rotation y")),
            1.);
}



// With both centres at y₂ = 0.3, a force along axis 3 there bends in one plane without twist, at any size; at the
// reference line it twists. (A shift of the reference line changes the discretisation, so this is of order 2p.)
TEST(Sections, ForceAtTheShearCentreDoesNotTwist)
{
  const std::string section = constants("s", 1, " set Tension centre = 0.3, 0\n set Shear centre = 0.3, 0\n");
  const auto        angle   = [&](const std::string &elements) {
    return value(cantilever_with_plate(section, "Force = 0, 0, 2", "0.3 0"),
                 "beam.end.angle 1",
                 {"Bodies/beam/Elements = " + elements});
  };
  EXPECT_NEAR(angle("64"), 0., 1e-11);
  EXPECT_NEAR(std::log2(angle("8") / angle("16")), 6., 0.3);
  EXPECT_LT(value(cantilever_with_plate(section, "Force = 0, 0, 2", "0.3 0"), "beam.end.rotation y"), -20.);
  EXPECT_LT(value(cantilever_with_plate(section, "Force = 0, 0, 2"), "beam.end.angle 1"), -5.);
}



// Stiffness from 1 to 1/4 linearly: ∫ dx/(1 − 3 x/(4 L)) = (4/3) L ln 4. The compliance is integrated, so that constant
// section forces have exact displacements with any elements.
TEST(Sections, TaperedTable)
{
  const std::string sections = constants("a", 1) + constants("b", 0.25) +
                               "subsection s\n set Type = table\n set Stations = a at 0, b at 1\n end\n";
  const double integral = 4. / 3. * 2 * std::log(4.);
  const auto   ratio    = [&](const std::string &load,
                         const std::string &probe,
                         const double       expected,
                         const unsigned int degree,
                         const unsigned int elements) {
    return value(cantilever_with_plate(sections, load),
                 probe,
                 {"Bodies/beam/Degree = " + std::to_string(degree),
                  "Bodies/beam/Elements = " + std::to_string(elements)}) /
           expected;
  };
  for (const unsigned int p : {1, 2, 3, 4})
    for (const unsigned int elements : {1, 3, 16})
      EXPECT_NEAR(ratio("Force = 0.1, 0, 0", "beam.end.displacement x", 1e-3 * integral, p, elements), 1, 1e-10)
        << "degree " << p << ", " << elements << " elements";
  // rotations of one radian
  EXPECT_NEAR(ratio("Moment = 1, 0, 0", "beam.end.rotation x", integral / 2 * 180 / M_PI, 4, 32), 1, 1e-10);
  EXPECT_NEAR(ratio("Moment = 0, 1, 0", "beam.end.rotation y", integral / 3 * 180 / M_PI, 4, 32), 1, 1e-10);
}



// A jump at 0.3 of the length, where an element ends whatever the mesh: exact.
TEST(Sections, TableWithAJump)
{
  const std::string sections =
    constants("a", 1) + constants("b", 0.25) +
    "subsection s\n set Type = table\n set Stations = a at 0, a at 0.3, b at 0.3, b at 1\n end\n";
  const double integral = 2 * (0.3 + 0.7 * 4);
  EXPECT_NEAR(value(cantilever_with_plate(sections, "Force = 10, 0, 0"), "beam.end.displacement x"),
              0.1 * integral,
              1e-13);
  EXPECT_NEAR(value(cantilever_with_plate(sections, "Moment = 0.5, 0, 0"), "beam.end.rotation x") * M_PI / 180,
              0.5 * integral / 2,
              1e-5);
}



TEST(Sections, TableFromAFile)
{
  const std::string name = "sections_" + std::to_string(getpid()) + ".csv";
  std::ofstream(name)
    << "x, EA, GA2, GA3, GJ, EI2, EI3, mass, y2 tension, y3 tension\n0, 100, 80, 70, 2, 3, 4, 1, 0.2, -0.3\n"
       "1, 25, 20, 17.5, 0.5, 0.75, 1, 0.25, 0.2, -0.3\n";
  Scene scene(cantilever_with_plate("subsection s\n set Type = table\n set File = " + name + "\n end",
                                    "Force = 5, 0, 0",
                                    "0.2 -0.3"),
              {"Bodies/beam/Elements = 48"});
  std::remove(name.c_str());
  scene.equilibrium();
  EXPECT_NEAR(scene.value("beam.end.displacement x") / (0.05 * 4. / 3. * 2 * std::log(4.)), 1., 1e-9);
  EXPECT_NEAR(scene.value("beam.end.displacement z"), 0., 1e-10);
}



// Torsion constants of Saint-Venant: 0.140577014955 a⁴ for a square, 0.228681643 a b³ for 2:1. Shear factor of Cowper
// (1966): 6 (1 + ν)/(7 + 6 ν) for a rod, 2 (1 + ν)/(4 + 3 ν) for a thin tube.
TEST(Sections, StiffnessOfSimpleShapes)
{
  const auto stiffness = [](const std::string &entries) {
    Scene scene(cantilever_with_plate("subsection s\n set Density = 1\n set E = 260\n set Poisson ratio = 0.3\n " +
                                        entries + "\n end",
                                      "Force = 1, 0, 0"));
    return scene.system.model.find<Section>("s", "section").at(0, Vector3::Zero()).stiffness;
  };
  const auto expect = [](const Matrix6 &C, const Vector6 &diagonal, const double tolerance) {
    EXPECT_LT((C - Matrix6(diagonal.asDiagonal())).norm(), tolerance * diagonal.norm());
  };
  expect(stiffness("set Type = rectangle\n set Width 2 = 2\n set Width 3 = 2"),
         Vector6(260 * 4, 500 / 6. * 4, 500 / 6. * 4, 100 * 0.140577014955 * 16, 260 * 16 / 12., 260 * 16 / 12.),
         1e-6);
  expect(stiffness("set Type = rectangle\n set Width 2 = 2\n set Width 3 = 1"),
         Vector6(260 * 2, 500 / 6. * 2, 500 / 6. * 2, 100 * 0.228681643 * 2, 260 * 2 / 12., 260 * 8 / 12.),
         1e-6);
  const double I = M_PI / 4 * 16;
  expect(stiffness("set Type = tube\n set Outer radius = 2"),
         Vector6(260 * M_PI * 4, 0, 0, 200 * I, 260 * I, 260 * I) + 7.8 / 8.8 * 400 * M_PI * Vector6(0, 1, 1, 0, 0, 0),
         1e-14);
  const double A = M_PI * (1 - 0.998001), I_thin = M_PI / 4 * (1 - std::pow(0.999, 4));
  expect(stiffness("set Type = tube\n set Outer radius = 1\n set Inner radius = 0.999"),
         Vector6(260 * A, 0, 0, 200 * I_thin, 260 * I_thin, 260 * I_thin) +
           2.6 / 4.9 * 100 * A * Vector6(0, 1, 1, 0, 0, 0),
         1e-6);
}



namespace
{
  /** Soft up to 0.37, stiff beyond, then soft again in a short piece, with other masses; or "s" everywhere. */
  std::string
  stepped(const double ratio, const double mass = 1)
  {
    std::string heavy = constants("b", ratio);
    heavy.replace(heavy.find("Mass = 1"), 8, "Mass = " + std::to_string(mass));
    return constants("a", 1) + heavy +
           "subsection s\n set Type = table\n set Stations = a at 0, a at 0.37, b at 0.37, b at 0.61, a at 0.61, a at 1\nend\n";
  }
} // namespace



// Stations inside of elements: forces F at the end of a cantilever give u = ∫ F (L − s)²/EI ds + ∫ F/GA ds in linear
// theory, exact for p ≥ 3 whatever the stations, since the section's compliance is integrated against the polynomials
// of the section forces; the rotation ∫ F (L − s)/EI ds for p ≥ 2.
TEST(Sections, StationsInsideOfElementsAreIntegrated)
{
  const double L = 2, a = 0.37 * L, b = 0.61 * L, F = 1e-6;
  for (const double ratio : {5., 0.3})
    {
      const auto   sum   = [&](const auto &f) { return f(a) - f(0) + (f(b) - f(a)) / ratio + f(L) - f(b); };
      const double u     = F * (sum([&](const double s) { return -std::pow(L - s, 3) / 3; }) / 3 +
                            sum([](const double s) { return s; }) / 70);
      const double angle = F * sum([&](const double s) { return -std::pow(L - s, 2) / 2; }) / 3;
      for (const std::string degree : {"1", "2", "3", "5"})
        for (const std::string elements : {"1", "2", "3"})
          {
            const std::vector<std::string> mesh = {"Bodies/beam/Degree = " + degree,
                                                   "Bodies/beam/Elements = " + elements};
            const std::string force = cantilever_with_plate(stepped(ratio), "Force = 0, 0, " + std::to_string(F));
            const std::string where =
              "degree " + degree + ", " + elements + " elements, ratio " + std::to_string(ratio);
            Scene scene(force, mesh);
            scene.equilibrium();
            if (degree > "2")
              {
                EXPECT_NEAR(scene.value("beam.end.displacement z") / u, 1, 1e-8) << where;
              }
            if (degree > "1")
              {
                EXPECT_NEAR(scene.value("beam.end.rotation y") * M_PI / 180 / -angle, 1, 1e-8) << where;
              }
            EXPECT_EQ(dynamic_cast<const Beam &>(*scene.input.model.items[3]).n_elements(), std::stoul(elements));
          }
    }
}



// Extension ∫ F/EA at any size, for all degrees, also where a short piece is so soft that the polynomials of a degree
// would make a compliance negative. Masses and their centre are those of the stations.
TEST(Sections, StationsInsideOfElementsAtAnySize)
{
  const double L = 2, F = 1e-3;
  for (const double ratio : {3., 0.3, 1e-3})
    for (const std::string degree : {"1", "2", "3", "4", "6"})
      for (const std::string elements : {"1", "2"})
        {
          const std::string where = "degree " + degree + ", " + elements + " elements, ratio " + std::to_string(ratio);
          Scene             scene(cantilever_with_plate(stepped(ratio, 2), "Force = 1e-3, 0, 0"),
                      {"Bodies/beam/Degree = " + degree, "Bodies/beam/Elements = " + elements});
          scene.equilibrium();
          EXPECT_NEAR(scene.value("beam.end.displacement x") / (L * F / 100 * (0.76 + 0.24 / ratio)), 1, 1e-10)
            << where;
          const auto   mass     = scene.system.mass_properties(scene.system.reference());
          const double expected = L * (0.76 + 0.24 * 2);
          EXPECT_NEAR(mass.mass, expected, 1e-12) << where;
          EXPECT_NEAR(mass.centre(0) * expected, L * L / 2 * (1 + 0.61 * 0.61 - 0.37 * 0.37), 1e-12) << where;
        }
}



// A piece of a hundredth of the length that is 4000 times as heavy or as soft: nodes keep positive masses, points
// positive compliances, with the right totals.
TEST(Sections, ExtremeStationsStayPositive)
{
  std::string heavy = constants("b", 1. / 4000);
  heavy.replace(heavy.find("Mass = 1"), 8, "Mass = 4000");
  const std::string sections =
    constants("a", 1) + heavy +
    "subsection s\n set Type = table\n set Stations = a at 0, a at 0.95, b at 0.95, b at 0.96, "
    "a at 0.96, a at 1\nend\n";
  for (const std::string degree : {"1", "2", "3", "4", "5", "6"})
    {
      Scene scene(cantilever_with_plate(sections, "Force = 1e-3, 0, 0"),
                  {"Bodies/beam/Degree = " + degree, "Bodies/beam/Elements = 1"});
      scene.equilibrium();
      EXPECT_NEAR(scene.value("beam.end.displacement x") / (2e-3 / 100 * (0.99 + 0.01 * 4000)), 1, 1e-10) << degree;
      double total = 0;
      for (const auto &node : scene.system.model.nodes)
        {
          EXPECT_GE(node.inertia(0, 0), 0) << degree;
          total += node.inertia(0, 0);
        }
      EXPECT_NEAR(total, 2 * (0.99 + 0.01 * 4000), 1e-11) << degree;
    }
}
