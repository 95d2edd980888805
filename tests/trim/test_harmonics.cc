/*
 * Problem:   harmonics of loads on a shaft, in standing and in turning axes
 * Reference: an unbalanced disk with a weight, closed form; what four equal blades cancel
 */

#include <samara/analysis/harmonics.h>
#include <samara/base/errors.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  // the shaft is level, along y; the disk's centre is half a metre along x of it, and 0.2 m along the shaft
  const std::string disk = R"(
set Analyses = harmonics
subsection Bodies
  subsection disk
    set Type     = rigid body
    set Mass     = 2 kg
    set Inertia  = 1, 2, 1
    set Position = 0.5, 0.2, 0
  end
end
subsection Joints
  subsection shaft
    set Type     = revolute
    set Body A   = ground
    set Body B   = disk
    set Position = 0, 0, 0
    set Axis     = 0, 1, 0
    subsection rotation
      set Prescribed = 6 rad/s*t
    end
  end
end
subsection Loads
  subsection weight
    set Type         = gravity
    set Acceleration = 0, 0, -10 m/s^2
  end
  subsection turning
    set Type  = steady rotation
    set Joint = shaft
    set Speed = 6 rad/s
  end
end
subsection Harmonics
  set Loads of  = shaft
  set Period    = 2*pi/(6 rad/s)
  set Steps     = 36
  set Harmonics = 3
end
subsection Output
  set Probes = disk.position x, disk.position z
end
)";

  const HarmonicsAnalysis::Series &
  find_series(const HarmonicsAnalysis &harmonics, const std::string &name, const std::string &axes)
  {
    for (const auto &s : harmonics.series)
      if (s.name == name && s.axes == axes)
        return s;
    throw std::invalid_argument(name);
  }
} // namespace



// The weight stands still, the pull of the centre turns: each is a mean in one kind of axes and a first harmonic in the
// other.
TEST(Harmonics, UnbalancedDisk)
{
  Scene scene(disk);
  scene.context.probes = scene.input.make_probes();
  auto &harmonics      = scene.analysis<HarmonicsAnalysis>();
  harmonics.run(scene.context);
  const double pull = 2 * 0.5 * 36, weight = 20;
  // joint axes: 3 is the shaft; where the others are is told by the pull in turning axes
  const auto of = [&](const char *what, const char *axes) { return find_series(harmonics, what, axes); };
  const auto f1 = of("shaft.force 1", "turning"), f2 = of("shaft.force 2", "turning");
  EXPECT_NEAR(std::hypot(f1.mean(), f2.mean()), pull, 1e-5 * pull);
  EXPECT_NEAR(of("shaft.force 3", "turning").mean(), 0, 1e-6 * pull);
  for (const auto &f : {f1, f2})
    {
      EXPECT_NEAR(std::hypot(f.harmonic(1, 0)[0], f.harmonic(1, 0)[1]), weight, 1e-5 * weight);
      EXPECT_NEAR(std::hypot(f.harmonic(2, 0)[0], f.harmonic(2, 0)[1]), 0, 1e-5 * weight);
    }
  const auto s1 = of("shaft.force 1", "standing"), s2 = of("shaft.force 2", "standing");
  EXPECT_NEAR(std::hypot(s1.mean(), s2.mean()), weight, 1e-5 * weight);
  for (const auto &f : {s1, s2})
    EXPECT_NEAR(std::hypot(f.harmonic(1, 0)[0], f.harmonic(1, 0)[1]), pull, 1e-5 * pull);
  // about the place of the joint, the weight turns the shaft by its arm, once a turn, and the pull bends it
  const auto m3 = of("shaft.moment 3", "standing");
  EXPECT_NEAR(std::hypot(m3.harmonic(1, 0)[0], m3.harmonic(1, 0)[1]), weight * 0.5, 1e-4);
  const auto m1 = of("shaft.moment 1", "turning"), m2 = of("shaft.moment 2", "turning");
  EXPECT_NEAR(std::hypot(m1.mean(), m2.mean()), pull * 0.2, 1e-4);
  // the moment is at a right angle to the pull
  EXPECT_NEAR(f1.mean() * m1.mean() + f2.mean() * m2.mean(), 0, 1e-3);
  // probes: x = 0.5 cos, z = -0.5 sin
  const auto x = of("disk.position x", ""), z = of("disk.position z", "");
  EXPECT_NEAR(x.harmonic(1, harmonics.phase)[0], 0.5, 1e-6);
  EXPECT_NEAR(z.harmonic(1, harmonics.phase)[1], -0.5, 1e-6);
}



TEST(Harmonics, Refusals)
{
  struct Case
  {
    std::vector<std::string> entries;
    std::string              says;
  };
  for (const Case &c : {Case{{"Harmonics/Period = 1 s"}, "lacks"},
                        Case{{"Harmonics/Harmonics = 18"}, "need more than 36"},
                        Case{{"Harmonics/Loads of = shft"}, "shft"},
                        Case{{"Joints/shaft/Type = universal", "Joints/shaft/Second axis = 1, 0, 0"}, ""},
                        Case{{"Harmonics/Period = 0 s"}, "must be positive"}})
    {
      SCOPED_TRACE(c.entries[0]);
      try
        {
          Scene scene(disk, c.entries);
          scene.analysis<HarmonicsAnalysis>().run(scene.context);
          ADD_FAILURE() << "It was not refused.";
        }
      catch (const std::runtime_error &error)
        {
          EXPECT_NE(std::string(error.what()).find(c.says), std::string::npos) << error.what();
        }
    }
}
