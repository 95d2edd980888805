// What is reported of a motion in which laws depend on reactions: accelerations and forces are of one balance.

#include <samara/time/projection.h>

#include <gtest/gtest.h>

#include "scenes.h"
#include "started.h"

using namespace samara;

namespace
{
  /** A bar of 2 kg that hangs on a hinge, whose moment is @p factor times a reaction of the hinge. */
  std::string
  bar_with_reported_moment(const std::string &factor)
  {
    return R"(
subsection Bodies
  subsection bar
    set Type     = rigid body
    set Mass     = 2
    set Position = 0.5, 0, 0
    set Inertia  = 0.1, 0.2, 0.3
    set Angular velocity = 0, 3, 0
    set Velocity = 0, 0, -1.5
  end
end
subsection Joints
  subsection h
    set Type     = revolute
    set Axis     = 0, 1, 0
    set Body A   = ground
    set Body B   = bar.centre
    set Position = 0, 0, 0
    subsection rotation
      set Moment = )" +
           factor + R"( m * h.force 1 + 0.3 N*m
    end
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Acceleration = 1, 0, -9
  end
end
)";
  }
} // namespace



// Newton's law of the bar's centre with the reported reaction, and the balance of moments about the hinge with the law.
TEST(ReportedForces, BalanceWithLawsOfReactions)
{
  for (const std::string factor : {"0", "0.1", "-0.4", "1.5"})
    {
      const Scene scene(bar_with_reported_moment(factor));
      State       state = started(scene.system);
      Projection(scene.system).report(state);
      const auto value = [&](const std::string &probe) { return scene.input.model.probe(probe).value(state); };
      // force 1, 2, 3 of the hinge, with which the ground acts on the bar, along its own axes
      Vector3 force = Vector3::Zero();
      for (int i = 0; i < 3; ++i)
        force(i) = value("h.force " + std::to_string(i + 1));
      const double a_x = value("bar.centre.acceleration x"), a_z = value("bar.centre.acceleration z");
      EXPECT_NEAR(force.norm(), 2 * std::hypot(a_x - 1, a_z + 9), 1e-9) << factor;
      const double moment = std::stod(factor) * force(0) + 0.3, inertia = 0.2 + 2 * 0.25;
      // weight 2 (1, 0, −9) at (0.5, 0, 0): r × f about y is z f_x − x f_z
      EXPECT_NEAR(value("bar.centre.angular acceleration y") * inertia, moment + 0.5 * 2 * 9, 1e-8) << factor;
    }
}
