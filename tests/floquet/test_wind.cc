// Winds and gusts that are periodic make periodic coefficients; others have no multipliers.

#include <samara/analysis/floquet.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace samara;

namespace
{
  /** A wing of 2 m² that heaves on a spring in the @p air, leading edge to −x; the entries of floquet are @p more. */
  std::string
  heaving_wing(const std::string &air, const std::string &more)
  {
    return R"(
set Analyses = floquet
subsection Bodies
  subsection wing
    set Type     = rigid body
    set Mass     = 5
    set Inertia  = 2, 1, 2.5
  end
end
subsection Joints
  subsection rail
    set Type   = prismatic
    set Body A = ground
    set Body B = wing.centre
    set Axis   = 0, 0, 1
    subsection displacement
      set Spring = 80
    end
  end
end
subsection Airfoils
  subsection plate
    set Type       = analytic
    set Lift slope = 6
    set Drag       = 0.02, 0, 0
  end
end
subsection Aerodynamics
  subsection air
    set Type    = air
    set Density = 0.1
)" + air + R"(
  end
end
subsection Surfaces
  subsection it
    set Body         = wing
    set Line         = 0, 0, 0; 0, 4, 0
    set Leading edge = -1, 0, 0
    set Upper side   = 0, 0, 1
    set Chord        = 0.5
    set Airfoils     = plate
    set Unsteady     = quasi-steady
  end
end
subsection Floquet
  set Steps = 40
)" + more + "end\n";
  }

  /** Multipliers of m z̈ + b (1 + ε cos 2t) ż + k z = 0 over π by Runge and Kutta's method: their sum and product. */
  std::array<double, 2>
  sum_and_product(const double m, const double b, const double epsilon, const double k)
  {
    double             columns[2][2] = {{1, 0}, {0, 1}};
    const unsigned int n             = 2000;
    const double       h             = M_PI / n;
    for (auto &y : columns)
      for (unsigned int i = 0; i < n; ++i)
        {
          const auto f = [&](const double t, const double z, const double v) {
            return std::array<double, 2>{{v, -(b * (1 + epsilon * std::cos(2 * t)) * v + k * z) / m}};
          };
          const double t  = i * h;
          const auto   k1 = f(t, y[0], y[1]), k2 = f(t + h / 2, y[0] + h / 2 * k1[0], y[1] + h / 2 * k1[1]),
                     k3 = f(t + h / 2, y[0] + h / 2 * k2[0], y[1] + h / 2 * k2[1]),
                     k4 = f(t + h, y[0] + h * k3[0], y[1] + h * k3[1]);
          for (unsigned int j = 0; j < 2; ++j)
            y[j] += h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
        }
    return {{columns[0][0] + columns[1][1], columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0]}};
  }

  std::string
  said_in_wind(const std::string &air, const std::string &more)
  {
    try
      {
        Scene scene(heaving_wing(air, more));
        scene.analysis<FloquetAnalysis>().run(scene.context);
      }
    catch (const NotConverged &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



// The lift's damping ½ρcl U (c_l,α + c_d) follows the wind: a wind in time, and a wave of it that passes.
TEST(WindOfPeriods, HeavingWing)
{
  const double b = 0.5 * 0.1 * 2 * 8 * 6.02;
  for (const std::string air : {"    set Wind = 8*(1 + 0.6*cos(2*t)), 0, 0",
                                "    set Wind = 8, 0, 0\n    set Gust = 4.8*cos(0.5*(x - 4*t)), 0, 0"})
    {
      Scene scene(heaving_wing(air, "  set Period = pi\n"));
      auto &floquet = scene.analysis<FloquetAnalysis>();
      floquet.run(scene.context);
      ASSERT_EQ(floquet.modes.size(), 1u); // a pair
      const auto wanted = sum_and_product(5, b, 0.6, 80);
      // the wave passes three quarters of the chord, at x = 0.25 m, later: another start, the same multipliers
      const auto   multiplier = floquet.modes[0].multiplier;
      const double sum = 2 * multiplier.real(), product = std::norm(multiplier);
      EXPECT_LT(std::abs(sum - wanted[0]), 1e-7) << air;
      EXPECT_LT(std::abs(product - wanted[1]), 1e-6 * wanted[1]) << air;
      EXPECT_NEAR(wanted[1], std::exp(-b * M_PI / 5), 1e-9 * wanted[1]); // Liouville
    }
}



// What the wing sees has another period than was said, or none.
TEST(WindOfPeriods, RefusesOthers)
{
  // at rest for any period, with coefficients of another one
  EXPECT_NE(said_in_wind("    set Wind = 8*(1 + 0.6*cos(2*t)), 0, 0", "  set Period = 2\n").find("in the next period"),
            std::string::npos);
  EXPECT_NE(said_in_wind("    set Wind = 8, 0, 0\n    set Gust = 4.8*cos(0.5*(x - 4*t)) + 2*cos(3.1*t), 0, 0",
                         "  set Period = pi\n")
              .find("in the next period"),
            std::string::npos);
  // a gust that lifts, and never comes the same way again; it hardly changes the coefficients
  EXPECT_NE(said_in_wind("    set Wind = 8, 0, 0\n    set Gust = 0, 0, 0.001*(cos(2*t) + cos(2*sqrt(2)*t))",
                         "  set Period = pi\n")
              .find("in the next period"),
            std::string::npos);
  // one gust that passes while the motion is looked at
  EXPECT_NE(said_in_wind("    set Wind = 8, 0, 0\n    set Gust = -6*exp(-((x - 8 m/s*(t - 2))/(2 m))^2), 0, 0",
                         "  set Period = 2\n")
              .find("in the next period"),
            std::string::npos);
}
