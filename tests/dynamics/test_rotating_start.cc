// Motion in time that begins in a steady rotation, found by statics or in the reference configuration: nothing but the
// angle of the rotor changes. Free shafts keep their speed, as nothing resists.

#include <samara/analysis/dynamic.h>

#include "../modes/rotors.h"
#include "../scene.h"
#include "motion.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** Largest change of a probe while the dynamic analysis runs. */
  double
  change(Scene &scene, const std::string &probe)
  {
    auto       &dynamic = scene.analysis<DynamicAnalysis>();
    const Probe p       = scene.input.model.probe(probe);
    double      lowest = 1e300, highest = -1e300;
    dynamic.observer = [&](const State &state) {
      lowest  = std::min(lowest, p.value(state));
      highest = std::max(highest, p.value(state));
    };
    State start = scene.context.state;
    dynamic.run(scene.context);
    scene.context.state          = start;
    scene.context.is_equilibrium = true;
    return highest - lowest;
  }

  const std::string half_a_turn = "subsection Dynamic\n  set End time = pi/Omega\n  set Step = pi/Omega/40\nend\n";
} // namespace



// On a mast that bends and twists, three blades with flap and lag hinges, weight along the axis: hinges keep their
// angles, the mast its place.
TEST(RotatingStart, ArticulatedRotorOnAFlexibleMast)
{
  std::string bodies, joints;
  for (unsigned int k = 0; k < 3; ++k)
    {
      const double phi = 2 * M_PI * k / 3, c = std::cos(phi), s = std::sin(phi);
      char         text[1000];
      std::snprintf(text,
                    sizeof text,
                    "  subsection blade %u\n    set Type = beam\n    set Points = %.17g, %.17g, 1; %.17g, %.17g, 1\n"
                    "    set Axis 2 = %.17g, %.17g, 0\n    set Elements = 2\n    set Section = blade\n  end\n",
                    k,
                    .1 * c,
                    .1 * s,
                    2 * c,
                    2 * s,
                    -s,
                    c);
      bodies += text;
      std::snprintf(
        text,
        sizeof text,
        "  subsection root %u\n    set Type = universal\n    set Body A = hub\n    set Body B = blade %u.start\n"
        "    set Axis = %.17g, %.17g, 0\n    set Second axis = 0, 0, 1\n  end\n",
        k,
        k,
        -s,
        c);
      joints += text;
    }
  Scene scene(R"(
set Analyses = static, dynamic
subsection Constants
  set Omega = 30
end
subsection Sections
  subsection blade
    set Type = engineering constants
    set EA = 1e7
    set GA2 = 3e6
    set GA3 = 2e6
    set GJ = 400
    set EI2 = 300
    set EI3 = 3000
    set Mass = 2
    set I2 = 1e-4
    set I3 = 1e-3
  end
  subsection mast
    set Copy of = blade
    set EI2 = 2e4
    set EI3 = 2e4
    set GJ = 1e4
  end
end
subsection Bodies
  subsection mast
    set Type = beam
    set Points = 0, 0, 0; 0, 0, 1
    set Axis 2 = 0, 1, 0
    set Elements = 2
    set Section = mast
  end
  subsection hub
    set Type = rigid body
    set Position = 0, 0, 1
    set Mass = 5
    set Inertia = 0.1, 0.1, 0.2
  end
)" + bodies + R"(
end
subsection Joints
  subsection foot
    set Type = rigid
    set Body A = ground
    set Body B = mast.start
  end
  subsection shaft
    set Type = revolute
    set Body A = mast.end
    set Body B = hub
  end
)" + joints + R"(
end
subsection Loads
  subsection weight
    set Type = gravity
  end
  subsection turning
    set Type = steady rotation
    set Joint = shaft
    set Speed = Omega
  end
end
)" + half_a_turn);
  scene.equilibrium();
  EXPECT_EQ(scene.stream.str().find("warning"), std::string::npos) << scene.stream.str();
  EXPECT_NEAR(scene.value("blade 0.end.angular velocity z"), 30, 1e-9);
  // blades droop: centrifugal against gravity, about g times the distance of the tip over its centripetal acceleration
  EXPECT_LT(scene.value("blade 1.end.displacement z"), -1e-3);
  EXPECT_LT(change(scene, "root 0.rotation 1"), 1e-6); // degrees
  EXPECT_LT(change(scene, "root 1.rotation 2"), 1e-6);
  EXPECT_LT(change(scene, "mast.end.displacement z"), 1e-9);
  EXPECT_LT(change(scene, "hub.angular velocity z"), 1e-7);
}



TEST(RotatingStart, HingedAndTeeteringRotors)
{
  for (const std::string kind : {"hinged", "teetering"})
    {
      Scene scene(rotor(kind, Turned::by_joint) + half_a_turn);
      scene.equilibrium();
      EXPECT_LT(change(scene, "hub.angular velocity z"), 1e-7) << kind;
      EXPECT_LT(change(scene, kind == "hinged" ? "root 1.rotation 1" : "teeter.rotation"), 1e-6) << kind;
    }
}



// The Puma's rotor: equilibrium, modes, motion. Lag and flap of rigid blades about hinges at e: ω² = Ω² e S/I and Ω² (1
// + e S/I), S and I the first and second moments of mass about the hinge, integrated from the same tables. Elastic
// blades are lower, by 3e-3 and 1e-4.
TEST(RotatingStart, Puma)
{
  Scene scene("prm/rotorcraft/puma.prm", {"Modal/Modes = 8", "Dynamic/End time = 10 ms"});
  scene.equilibrium();
  const auto  &modes = scene.modes();
  const double lag   = 28 * std::sqrt(.269 * 249.4724 / 1188.8078),
               flap  = 28 * std::sqrt(1 + .289 * 247.6302 / 1178.8475);
  ASSERT_EQ(modes.size(), 8u);
  for (unsigned int i = 0; i < 4; ++i)
    {
      EXPECT_NEAR(modes[i].frequency(), lag, 5e-3 * lag);
      EXPECT_NEAR(modes[4 + i].frequency(), flap, 3e-4 * flap);
    }
  EXPECT_LT(change(scene, "blade 1:flap.rotation"), 1e-7);
  EXPECT_LT(change(scene, "hub.angular velocity z"), 28e-9);
}



// From a rotation of the whole model: a body on a bearing, and one on nothing, go on turning; the ground stands still.
// What is clamped to the ground cannot.
TEST(RotatingStart, FromTheWholeModelTurning)
{
  const std::string text = R"(
set Analyses = dynamic
subsection Constants
  set Omega = 5
end
subsection Bodies
  subsection on bearing
    set Type = rigid body
    set Mass = 2
    set Inertia = 1, 1, 2
    set Position = 0.5, 0, 0
  end
  subsection flying
    set Type = rigid body
    set Mass = 3
    set Inertia = 1, 2, 3
    set Position = 0, 2, 0
  end
end
subsection Joints
  subsection bearing
    set Type = revolute
    set Body A = ground
    set Body B = on bearing
    set Position = 0, 0, 0
    subsection rotation
      set Damper = 1e-9
    end
  end
end
subsection Loads
  subsection turning
    set Type = steady rotation
    set Speed = Omega
  end
end
)" + half_a_turn;
  Scene             turning(text);
  turning.analysis<DynamicAnalysis>().run(turning.context);
  EXPECT_NEAR(turning.value("on bearing.angular velocity z"), 5, 1e-7);
  EXPECT_NEAR(turning.value("bearing.rotation"), 180, 1e-5);
  EXPECT_NEAR(turning.value("bearing.rotation rate"), 5, 1e-7);
  EXPECT_NEAR(turning.value("flying.angular velocity z"), 5, 1e-7);
  EXPECT_NEAR(turning.value("flying.position x"), -10 * M_PI / 5, 1e-6); // straight on, with v = −5·2

  Scene slanted(text, {"Joints/bearing/Axis = 0, 1, 1"});
  try
    {
      slanted.analysis<DynamicAnalysis>().run(slanted.context);
      FAIL() << "turned about another axis";
    }
  catch (const InputError &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("joint bearing"), std::string::npos) << problem.what();
    }
  // a hub clamped to the ground is the ground; its blades cannot leave it behind
  Scene hingeless(rotor("hingeless", Turned::as_a_whole) + half_a_turn);
  try
    {
      hingeless.analysis<DynamicAnalysis>().run(hingeless.context);
      FAIL() << "blades turn, their roots do not";
    }
  catch (const InputError &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("<blade 1>"), std::string::npos) << problem.what();
    }
}



// A blade with a swept tip under a force in its plane: the plane motion is unstable, a force of 1e-13 across it grows to a
// quarter of an inch at 0.15 s, with any step. A start in the plane, with no round-off across, stays in it.
TEST(RotatingStart, PlaneMotionStaysPlane)
{
  const Motion motion("../swept_tip_dynamics", {"Dynamic/End time = 0.15"}, {"tip.end.position z"});
  EXPECT_EQ(motion.report.n_steps, 600u);
  for (const auto &row : motion.values)
    EXPECT_LT(std::abs(row[0]), 1e-20);
}
