// Fields of velocities and displacements with which beams start: a mode that is kicked, a shape that is let go.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  // a steel strip of 2 m between two pins, 1 cm thick: ω = (π/L)² √(EI/m), shear and rotatory inertia take 3e-5 of it
  const double E = 210e9, thickness = 0.01, width = 0.04, L = 2, density = 7800,
               omega = std::pow(M_PI / L, 2) * std::sqrt(E * thickness * thickness / (12 * density));

  std::string
  strip(const std::string &fields, const std::string &rest = "")
  {
    return "set Analyses = dynamic\nsubsection Sections\n subsection strip\n set Type = rectangle\n set E = 210 GPa\n"
           " set Density = 7800\n set Width 2 = 0.04\n set Width 3 = 0.01\n end\nend\nsubsection Bodies\n subsection beam\n"
           " set Type = beam\n set Points = 0, 0, 0; 2, 0, 0\n set Axis 2 = 0, 1, 0\n set Section = strip\n" +
           fields +
           " end\nend\nsubsection Joints\n subsection left\n set Type = revolute\n set Body A = ground\n set Body B = beam.start\n"
           " set Axis = 0, 1, 0\n end\n subsection right\n set Type = cylindrical\n set Body A = ground\n set Body B = beam.end\n"
           " set Axis = 0, 1, 0\n end\nend\nsubsection Dynamic\n set Step = " +
           number_to_text(M_PI / omega / 40) + "\n set End time = " + number_to_text(0.75 * M_PI / omega) + "\nend\n" +
           rest;
  }

  void
  run(Scene &scene)
  {
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.start(scene.context);
    dynamic.run(scene.context);
  }
} // namespace



TEST(InitialFields, AKickedMode)
{
  const std::string kick = "set Velocity field = 0, 0, 1e-3*sin(pi*s/2)\n";
  Scene             start(strip(kick));
  start.system.add_initial_velocities(start.context.state);
  EXPECT_NEAR(start.value("beam.middle.velocity z"), 1e-3, 1e-15);
  // sections stay normal to the line
  EXPECT_NEAR(start.value("beam.start.angular velocity y"), -1e-3 * M_PI / 2, 1e-15);
  EXPECT_NEAR(start.value("beam.middle.angular velocity y"), 0, 1e-15);

  Scene scene(strip(kick));
  run(scene);
  const double t = 0.75 * M_PI / omega;
  EXPECT_NEAR(scene.value("beam.middle.displacement z"), 1e-3 / omega * std::sin(omega * t), 2e-3 * 1e-3 / omega);

  Scene given(strip(kick + "set Angular velocity field = 0, 0.3, 0\n"));
  given.system.add_initial_velocities(given.context.state);
  EXPECT_NEAR(given.value("beam.middle.angular velocity y"), 0.3, 1e-15);
}



// In addition to a rigid motion: v + ω × r + field.
TEST(InitialFields, AreAddedToARigidMotion)
{
  const std::string free =
    strip("set Velocity = 1, 2, 3\n set Angular velocity = 0, 0, 5\n set Velocity field = 0, s, 0\n");
  Scene scene(free.substr(0, free.find("subsection Joints")) + free.substr(free.find("subsection Dynamic")));
  scene.system.add_initial_velocities(scene.context.state);
  EXPECT_NEAR(scene.value("beam.end.velocity y"), 2 + 10 + 2, 1e-13);
  EXPECT_NEAR(scene.value("beam.end.angular velocity z"), 5 + 1, 1e-13); // t × dv/ds
}



TEST(InitialFields, AShapeThatIsLetGo)
{
  Scene scene(strip("set Displacement field = 0, 0, 1e-4*sin(pi*s/2)\n"));
  run(scene);
  const double t = 0.75 * M_PI / omega;
  EXPECT_NEAR(scene.value("beam.middle.displacement z"), 1e-4 * std::cos(omega * t), 2e-3 * 1e-4);
}



TEST(InitialFields, Refusals)
{
  const auto clamped = [](const std::string &fields) {
    std::string text = strip(fields);
    text.replace(text.find("revolute"), 8, "rigid");
    return complaint_of(text);
  };
  EXPECT_EQ(clamped("set Velocity field = 0, 0, s^2\n"), "");
  EXPECT_NE(clamped("set Velocity field = 0, 0, 1 + s\n").find("welded to the ground at s = 0 m"), std::string::npos);
  EXPECT_NE(clamped("set Displacement field = 0, 0, 1/s\n").find("not finite"), std::string::npos);
  EXPECT_NE(clamped("set Velocity field = 0, 0, s\n set Rigid = true\n"), "");
  // a shape that the joints do not allow
  Scene scene(strip("set Displacement field = 0, 0, 1e-3*s\n"));
  EXPECT_THROW(run(scene), InputError);
  // and one beside a static analysis
  Scene both(strip("set Displacement field = 0, 0, 1e-4*sin(pi*s/2)\n"));
  both.equilibrium();
  EXPECT_THROW(run(both), InputError);
}
