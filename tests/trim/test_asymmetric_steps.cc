/*
 * Problem:   blades of bodies that are written one by one, whose joints choose axes of their constraints
 * Reference: the trim of whole turns with as many steps: errors of coarse steps are the same for all blades, since
 * forces of turning steps do not depend on these axes (doc/theory/steady_rotation.md, "In time")
 */

#include <samara/analysis/trim.h>
#include <samara/base/errors.h>

#include "../said_by.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  std::string
  block(const std::string &name, const std::string &entries)
  {
    return "  subsection " + name + "\n" + entries + "  end\n";
  }

  std::string
  digits(const double x)
  {
    return number_to_text("%.17g", std::abs(x) < 1e-14 ? 0. : x);
  }

  /** (x, y, 0) of a blade along x, turned by @p angle. */
  std::string
  turned(const double angle, const double x, const double y)
  {
    const double c = std::round(std::cos(angle)), s = std::round(std::sin(angle));
    return digits(c * x - s * y) + ", " + digits(s * x + c * y) + ", 0\n";
  }

  std::string
  placed(const double angle, const double x, const std::string &mass_and_inertia)
  {
    return " set Type = rigid body\n set Position = " + turned(angle, x, 0) + " set Rotation = " + digits(angle) +
           ", 0, 0\n" + mass_and_inertia +
           " set Angular velocity = 0, 0, 40\n set Velocity = " + turned(angle, 0, 40 * x);
  }

  /** Four blades in forward flight; @p damper of the lag hinge of the second, 600 of the others. */
  std::string
  written_out(const std::string &damper = "600")
  {
    std::string bodies = block("base", " set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n") +
                         block("hub",
                               " set Type = rigid body\n set Mass = 100\n set Inertia = 10, 10, 10\n"
                               " set Angular velocity = 0, 0, 40\n"),
                joints = block("hold", " set Type = rigid\n set Body A = ground\n set Body B = base\n") +
                         block("shaft",
                               " set Type = revolute\n set Body A = ground\n set Body B = hub\n subsection rotation\n"
                               " set Prescribed = 40*t\n end\n"),
                surfaces;
    for (unsigned int k = 1; k <= 4; ++k)
      {
        const double      a = k == 4 ? -M_PI / 2 : (k - 1) * M_PI / 2;
        const std::string n = " " + std::to_string(k), at = " set Position = " + turned(a, 0.3, 0);
        bodies += block("link" + n, placed(a, 0.3, " set Mass = 0.1\n set Inertia = 0.02, 0.02, 0.02\n"));
        bodies += block("rod" + n, placed(a, 2.65, " set Mass = 30\n set Inertia = 0.3, 55.225, 55.525\n"));
        bodies += block("skin" + n, placed(a, 0.3, " set Mass = 0.05\n set Inertia = 0.02, 0.02, 0.02\n"));
        joints += block("flap" + n,
                        " set Type = revolute\n set Body A = hub\n set Body B = link" + n + "\n" + at +
                          " set Axis = " + turned(a, 0, -1) + " subsection rotation\n set Spring = 0\n end\n");
        joints += block("lag" + n,
                        " set Type = revolute\n set Body A = link" + n + "\n set Body B = rod" + n + "\n" + at +
                          " set Axis = 0, 0, 1\n subsection rotation\n set Spring = 4000\n set Damper = " +
                          (k == 2 ? damper : "600") + "\n end\n");
        joints +=
          block("pitch" + n,
                " set Type = revolute\n set Body A = rod" + n + "\n set Body B = skin" + n + "\n" + at +
                  " set Axis = " + turned(a, 1, 0) +
                  " subsection rotation\n set Prescribed = collective + cosine*cos(40*t + " +
                  digits((k - 1) * M_PI / 2) + ") + sine*sin(40*t + " + digits((k - 1) * M_PI / 2) + ")\n end\n");
        std::string line = turned(a, 1, 0);
        line.pop_back();
        surfaces += block("blade" + n,
                          " set Body = skin" + n + "\n set Line = " + line + "; " + turned(a, 5, 0) +
                            " set Leading edge = " + turned(a, 0, 1) +
                            " set Upper side = 0, 0, 1\n set Chord = 0.3\n set Quarter chord = 0\n"
                            " set Twist = -10 deg*(s/5 - 0.55)\n set Stations = 4\n set Airfoils = plain\n"
                            " set Unsteady = quasi-steady\n set Inflow = flow\n");
      }
    const auto control = [](const std::string &name, const std::string &value) {
      return block(name, " set Type = control\n set Value = " + value + " rad\n set Unit = rad\n set Scale = 1 deg\n");
    };
    return "set Analyses = trim\nsubsection States\n" + control("collective", "0.15") + control("cosine", "0") +
           control("sine", "-0.05") + "end\nsubsection Bodies\n" + bodies + "end\nsubsection Joints\n" + joints +
           "end\nsubsection Airfoils\n" +
           block("plain", " set Type = analytic\n set Form = linear\n set Lift slope = 5.7\n set Drag = 0.01\n") +
           "end\nsubsection Aerodynamics\n" + block("air", " set Type = air\n set Wind = 40, 0, -2.8\n") +
           block("flow",
                 " set Type = Pitt-Peters inflow\n set Hub = base.centre\n set Axis = 0, 0, 1\n set Radius = 5\n"
                 " set Initial = 6\n") +
           "end\nsubsection Surfaces\n" + surfaces + R"(end
subsection Trim
  set Controls = collective from -10 deg to 30 deg, cosine from -15 deg to 15 deg, sine from -20 deg to 15 deg
  set Targets = flow.thrust = 23090 N, cos 1 of flap 1.rotation = 0 deg, sin 1 of flap 1.rotation = 0 deg
  set Scales = 23090 N, 1 rad, 1 rad
  set Period = 2*pi/40
end
subsection Output
  set Probes = flap 1.rotation, flap 2.rotation, flap 3.rotation, flap 4.rotation, lag 1.rotation, lag 2.rotation, lag 3.rotation, lag 4.rotation, pitch 1.rotation, pitch 2.rotation, pitch 3.rotation, pitch 4.rotation
end
)";
  }

  std::string
  symmetry()
  {
    std::string groups;
    for (const std::string name : {"link", "rod", "skin", "flap", "lag", "pitch"})
      groups += (groups.empty() ? "" : "; ") + name + " 1, " + name + " 2, " + name + " 3, " + name + " 4";
    return "Trim/Symmetry = " + groups;
  }

  std::vector<double>
  controls_of(const std::string &text, const std::vector<std::string> &entries, std::string *const said = nullptr)
  {
    Scene scene(text, entries);
    auto &trim = scene.analysis<TrimAnalysis>();
    trim.run(scene.context);
    if (said != nullptr)
      *said = scene.stream.str();
    return trim.report.controls;
  }
} // namespace



TEST(AsymmetricSteps, AreAlikeForAllBlades)
{
  const std::string text = written_out();
  for (const std::string steps : {"8", "12", "48"})
    {
      SCOPED_TRACE(steps);
      std::string said;
      const auto  by_sections =
                   controls_of(text, {symmetry(), "Trim/Turning = hub, shaft", "Trim/Steps = " + steps}, &said),
                 by_turns = controls_of(text, {"Trim/Steps = " + steps});
      for (unsigned int j = 0; j < 3; ++j)
        EXPECT_NEAR(by_sections.at(j), by_turns.at(j), 1e-9) << said;
      EXPECT_EQ(said.find("error of the steps"), std::string::npos) << said;
    }
}



// A damper of 2 % more is no error of steps.
TEST(AsymmetricSteps, HideNoUnlikeBlade)
{
  const std::string said = said_by<NotConverged>([&]() {
    controls_of(written_out("612"), {symmetry(), "Trim/Turning = hub, shaft", "Trim/Steps = 24"});
  });
  EXPECT_NE(said.find("the <Symmetry> is none"), std::string::npos) << said;
}
