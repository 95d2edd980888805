/*
 * Problem:   multipliers of random models: beams with springs, dampers, rotating parts and coefficients in time
 * Reference: all columns of the same map
 */

#include <samara/analysis/floquet.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace samara;

namespace
{
  /** A beam from the ground with a tip body on it that slides and turns on springs which change in time. */
  std::string
  random_model(const unsigned int seed)
  {
    std::mt19937 generator(seed);
    const auto   between = [&](const double a, const double b) {
      return number_to_text("%.6g", std::uniform_real_distribution<double>(a, b)(generator));
    };
    const auto law = [&](const char *what, const double largest) {
      return "-(" + between(0.2 * largest, largest) + " + " + between(-0.3 * largest, 0.3 * largest) + "*cos(5*t) + " +
             between(-0.2 * largest, 0.2 * largest) + "*sin(10*t))*" + what;
    };
    return R"(
set Analyses = floquet
subsection Sections
  subsection s
    set Type = engineering constants
    set EA  = 4e3
    set GA2 = 1e3
    set GA3 = 1e3
    set GJ  = )" +
           between(5, 40) + "\n    set EI2 = " + between(5, 60) + "\n    set EI3 = " + between(5, 60) + R"(
    set Mass = )" +
           between(0.5, 2) + R"(
    set I2 = 1e-2
    set I3 = 2e-2
  end
end
subsection Bodies
  subsection arm
    set Type     = beam
    set Points   = 0, 0, 0; )" +
           between(0.8, 1.5) + ", " + between(-0.3, 0.3) + ", 0" + R"(
    set Section  = s
    set Elements = 2
    set Degree   = 2
    set Damping ratio     = )" +
           between(0.005, 0.05) + R"(
    set Damping frequency = 10
  end
  subsection tip
    set Type     = rigid body
    set Mass     = )" +
           between(0.5, 3) + R"(
    set Inertia  = 0.3, 0.2, 0.4
    set Position = 2, 0.1, 0.2
  end
end
subsection Joints
  subsection root
    set Type   = revolute
    set Body A = ground
    set Body B = arm.start
    set Axis   = 0, )" +
           between(0.2, 1) + ", " + between(-1, 1) + R"(
    subsection rotation
      set Moment = )" +
           law("root.rotation", 60) + "\n      set Damper = " + between(0.1, 2) + R"(
    end
  end
  subsection slide
    set Type   = cylindrical
    set Body A = arm.end
    set Body B = tip
    set Axis   = )" +
           between(-1, 1) + ", 1, " + between(-1, 1) + R"(
    subsection displacement
      set Force  = )" +
           law("slide.displacement", 80) + "\n      set Damper = " + between(0.1, 2) + R"(
    end
    subsection rotation
      set Moment = )" +
           law("slide.rotation", 15) + "\n      set Damper = " + between(0.05, 0.5) + R"(
    end
  end
end
subsection Floquet
  set Period     = 2*pi/5
  set Steps      = 16
  set Stages     = 2
  set Spectral radius = )" +
           between(0, 1) + R"(
  set Settle     = 1
  set Wanted     = 6
  set Tolerance  = 1e-11
  set Animations = 0
end
)";
  }

  std::vector<FloquetMode>
  modes_by(const std::string &model, const std::string &method)
  {
    Scene scene(model, {"Floquet/Method = " + method});
    auto &floquet = scene.analysis<FloquetAnalysis>();
    floquet.run(scene.context);
    return floquet.modes;
  }
} // namespace



TEST(RandomModels, ArnoldiFindsTheLargestOfAllColumns)
{
  for (const unsigned int seed : {1, 2, 3}) // of 60, which have all passed
    {
      SCOPED_TRACE(seed);
      const std::string model = random_model(seed);
      const auto        all = modes_by(model, "classical"), some = modes_by(model, "implicit");
      ASSERT_GE(some.size(), 3u);
      ASSERT_LE(some.size(), all.size());
      EXPECT_GT(std::abs(some[0].multiplier), 0.05);
      for (unsigned int i = 0; i < some.size(); ++i)
        {
          // of equal size in either order
          double nearest = 1;
          for (const auto &mode : all)
            nearest = std::min({nearest,
                                std::abs(mode.multiplier - some[i].multiplier),
                                std::abs(mode.multiplier - std::conj(some[i].multiplier))});
          EXPECT_LT(nearest, 1e-8) << i;
          EXPECT_NEAR(std::abs(some[i].multiplier), std::abs(all[i].multiplier), 1e-8) << i;
        }
    }
}
