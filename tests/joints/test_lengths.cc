// Lengths of springs: l² is measured, and −l is a root, too, which no motion has. A mass that passes by the other end of
// its spring within a step must not be told a negative length; expected is the distance of the two ends, recomputed.

#include <samara/base/errors.h>
#include <samara/time/stage_integrator.h>
#include <samara/time/stepper.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A mass that flies by the other end of its spring at a distance of @p miss [m]. */
  std::string
  passing_by(const double miss)
  {
    return "subsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n set Inertia = .1, .1, .1\n"
           " set Position = 0.5, " +
           std::to_string(miss) +
           ", 0\n set Velocity = -10, 0, 0\n end\nend\nsubsection Joints\n subsection k\n set Type = spring\n"
           " set Body A = ground\n set Body B = b\n set Position = 0, 0, 0\n subsection length\n set Spring = 100\n"
           " set Rest = 0.5\n end\n end\nend\n";
  }

  /** A slider along x with a spring of 1 m and 100 N/m to the origin, pushed towards it. */
  std::string
  pushed(const double force)
  {
    return "set Analyses = static\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n"
           " set Inertia = .1, .1, .1\n set Position = -1, 0, 0\n end\nend\nsubsection Joints\n subsection rail\n"
           " set Type = prismatic\n set Body A = ground\n set Body B = b\n set Axis = 1, 0, 0\n end\n subsection k\n"
           " set Type = spring\n set Body A = ground\n set Body B = b\n subsection length\n set Spring = 100\n end\n end\n"
           "end\nsubsection Loads\n subsection f\n set Type = point load\n set At = b\n set Force = " +
           std::to_string(force) + ", 0, 0\n end\nend\n";
  }
} // namespace



TEST(Lengths, AreDistancesWhereTheEndsPassEachOther)
{
  for (const double miss : {0.02, 1e-3})
    {
      Scene scene(passing_by(miss));
      for (const unsigned int stages : {1, 2, 3})
        for (const double h : {0.08, 0.05, 0.02})
          {
            SCOPED_TRACE("miss " + std::to_string(miss) + ", s = " + std::to_string(stages) + ", h = " + std::to_string(h));
            StageIntegrator integrator(scene.system, Tableau(stages, 1.), 1e-10);
            Stepper         stepper(scene.system, integrator, h, 1e-12);
            State          &state = scene.context.state;
            state                 = scene.system.reference();
            scene.system.add_initial_velocities(state);
            state.held = false;
            while (state.time < 0.4)
              {
                stepper.advance(state, 0.4);
                const Vector3 x(&state.q[12]);
                EXPECT_NEAR(scene.value("k.length"), x.norm(), 1e-9);
              }
          }
    }
}



// The spring is shorter by F/k until it is gone; then the slider jumps to the other side.
TEST(Lengths, StaticsDoNotPushASpringThroughItself)
{
  Scene scene(pushed(90));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("k.length"), 0.1, 1e-9);
  for (const std::string path : {"load", "arc length"})
    {
      Scene through(pushed(1000), {"Static/Path = " + path});
      EXPECT_THROW(through.equilibrium(), NotConverged) << path;
      EXPECT_NEAR(through.value("k.length"), 0, 1e-3) << path;
    }
}
