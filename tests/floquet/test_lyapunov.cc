/*
 * Problem:   Lyapunov exponents
 * Reference: damped masses, closed form; a double pendulum, tests/reference/stability/double_pendulum_lyapunov.csv
 */

#include <samara/analysis/lyapunov.h>
#include <samara/base/errors.h>

#include "../reference.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  // a mass that creeps back, and a filter that follows it
  const std::string creeping = R"(
set Analyses = lyapunov
subsection Bodies
  subsection mass
    set Type    = rigid body
    set Mass    = 2 kg
    set Inertia = 1, 1, 1
  end
end
subsection Joints
  subsection slide
    set Type   = prismatic
    set Body A = ground
    set Body B = mass
    set Axis   = 1, 0, 0
    subsection displacement
      set Spring = 8 N/m
      set Damper = 10 N*s/m
      set Force  = 3 N*sin(2 rad/s*t)
    end
  end
end
subsection States
  subsection filter
    set Type = first order
    set Rate = (slide.displacement/(1 m) - filter)/(0.4 s)
  end
  subsection idle
    set Type = control
  end
end
subsection Lyapunov
  set Exponents = 3
  set Step      = 0.05 s
  set Settle    = 20 s
  set Duration  = 5 s
end
)";
} // namespace



// λ = −1, −2.5 of the filter, −4: of a linear system they do not depend on its motion.
TEST(Lyapunov, DampedMassInClosedForm)
{
  Scene scene(creeping);
  auto &lyapunov = scene.analysis<LyapunovAnalysis>();
  lyapunov.run(scene.context);
  ASSERT_EQ(lyapunov.exponents.size(), 3u);
  EXPECT_NEAR(lyapunov.exponents[0], -1, 1e-7);
  EXPECT_NEAR(lyapunov.exponents[1], -2.5, 1e-6);
  EXPECT_NEAR(lyapunov.exponents[2], -4, 1e-6);
  EXPECT_LT(lyapunov.scatter[0], 1e-6);
  EXPECT_TRUE(std::isnan(lyapunov.dimension()) || lyapunov.dimension() == 0);
}



// There are three changes that can be told apart: the control is none.
TEST(Lyapunov, MoreThanThereAre)
{
  Scene scene(creeping, {"Lyapunov/Exponents = 4"});
  EXPECT_THROW(scene.analysis<LyapunovAnalysis>().run(scene.context), NotConverged);
}



// Nothing is lost, so that exponents come in pairs; the largest is that of another program, within the scatter of so
// short a time.
TEST(Lyapunov, DoublePendulum)
{
  Scene scene("prm/examples/floquet/double_pendulum.prm",
              {"Lyapunov/Settle = 2", "Lyapunov/Duration = 20", "Lyapunov/Stages = 2", "Lyapunov/Exponents = 4"});
  auto &lyapunov = scene.analysis<LyapunovAnalysis>();
  lyapunov.run(scene.context);
  const double expected = std::stod(reference_rows("stability/double_pendulum_lyapunov.csv")[0].at("exponent"));
  EXPECT_GT(lyapunov.exponents[0], expected / 3);
  EXPECT_LT(lyapunov.exponents[0], 3 * expected);
  double sum = 0;
  for (const double lambda : lyapunov.exponents)
    sum += lambda;
  EXPECT_NEAR(sum, 0, 0.5 * lyapunov.exponents[0]);
}
