// Buckling and flutter of columns and rings: the lowest frequency of the modes about the loaded equilibrium falls to
// zero, or two frequencies meet. Shortening and shear change a load by P/EA − P/GA; with EA = GA = 1e7 EI/L²
// nothing of the first order is left.
//
// References (L = EI = m = 1): Euler's four cases; self-weight 7.837347439 (Bessel function of order −1/3); torque 2π
// (Greenhill, moments about fixed axes); ring under pressure 3 EI/R³ if it stays normal, 4 if it keeps its direction
// (Bryan; Timoshenko & Gere); follower forces by Galerkin's method with 16 and 22 Legendre polynomials:
// Beck 20.0509536, ω 11.0155576; Leipholz 40.0537365, ω 11.030217; Hauger 150.641596, ω 11.4857136. Order of a buckling
// load: 2p.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  const std::string euler = "prm/benchmarks/euler_column.prm", beck = "prm/benchmarks/beck_column.prm";

  const std::string clamp = "subsection Joints\n subsection foot\n set Type = rigid\n set Body A = ground\n"
                            " set Body B = column.start\n end\n";
  const std::string guide = " subsection head\n set Type = prismatic\n set Body A = ground\n set Body B = column.end\n"
                            " set Axis = 1, 0, 0\n end\n";
  const std::string roller =
    " subsection head\n set Type = planar\n set Body A = ground\n set Body B = column.end\n"
    " set Axis = 0, 1, 0\n set Axis 1 = 0, 0, 1\n subsection displacement 1\n set Prescribed = 0\n"
    " end\n end\n";

  std::string
  line_load(const std::string &entries)
  {
    return "subsection Loads\n subsection force\n set Type = line load\n set Body = column\n" + entries + " end\nend\n";
  }

  struct Flutter
  {
    double load, frequency;
  };

  /** By bisection on whether any mode grows; where two frequencies meet, they part as the root of the load. */
  Flutter
  flutter(const std::string &model, double stable, double unstable)
  {
    Flutter result{0, 0};
    while (unstable - stable > 1e-8 * unstable)
      {
        const double P     = 0.5 * (stable + unstable);
        Scene        scene = with_constants(model, {"P = " + exact(P)});
        scene.equilibrium();
        const Mode *growing = nullptr;
        for (const auto &mode : scene.modes())
          if (mode.lambda.real() > 2e-4 && mode.lambda.imag() > 1.)
            growing = &mode;
        if (growing != nullptr)
          result.frequency = growing->lambda.imag();
        (growing != nullptr ? unstable : stable) = P;
      }
    result.load = unstable;
    return result;
  }
} // namespace



TEST(Buckling, EulerColumns)
{
  const double pi2 = M_PI * M_PI;
  EXPECT_NEAR(buckling_load(euler, 5, 15), pi2, 1e-6 * pi2);
  EXPECT_NEAR(buckling_load(with_part(euler, "Joints", "Loads", clamp + "end\n"), 1, 4), pi2 / 4, 1e-6 * pi2 / 4);
  EXPECT_NEAR(buckling_load(with_part(euler, "Joints", "Loads", clamp + guide + "end\n"), 30, 45), 4 * pi2, 4e-6 * pi2);
  EXPECT_NEAR(buckling_load(with_part(euler, "Joints", "Loads", clamp + roller + "end\n"), 15, 25),
              20.1907285564,
              2e-5);
}



// Statics stops just below the buckling load, if not told to pass it; the modes about this state are stable.
TEST(Buckling, StaticsStopsBelow)
{
  Scene scene(euler, {"Constants/P = 15", "Static/Stability limits = stop"});
  EXPECT_THROW(scene.equilibrium(), NotConverged);
  const double P = 15 * scene.context.state.factor;
  EXPECT_LT(P, M_PI * M_PI);
  EXPECT_GT(P, M_PI * M_PI - 15 * 2e-4);
  EXPECT_GT(smallest_square(scene.modes()), 0);
}



TEST(Buckling, Order)
{
  for (const unsigned int p : {1, 2, 3})
    {
      double error[2];
      for (const unsigned int refined : {0, 1})
        {
          const unsigned int n = (p == 1 ? 8 : 2) << refined;
          const double       P = root_of(
            [&](const double load) {
              Scene scene(euler,
                          {"Constants/P = " + exact(load),
                           "Bodies/column/Degree = " + std::to_string(p),
                           "Bodies/column/Elements = " + std::to_string(n)});
              scene.equilibrium();
              return smallest_square(scene.modes());
            },
            8,
            13);
          error[refined] = std::abs(P / (M_PI * M_PI) - 1);
        }
      EXPECT_NEAR(std::log2(error[0] / error[1]), 2. * p, 0.4) << "degree " << p;
    }
}



TEST(Buckling, SelfWeight)
{
  const std::string loads = line_load("set Force = -P, 0, 0\n");
  const std::string model = with_part(euler, "Joints", "Modal", clamp + "end\n" + loads);
  EXPECT_NEAR(buckling_load(model, 5, 10), 7.837347439, 8e-6);
}



// A shaft on two spherical bearings, twisted by moments about the fixed axis x at its ends. A soft spring holds its
// middle against turning; by the balance of moments about x nothing is in it.
TEST(Buckling, Torque)
{
  const std::string supports = R"(
subsection Joints
  subsection left
    set Type = spherical
    set Body A = ground
    set Body B = column.start
  end
  subsection right
    set Type = spherical
    set Body A = slider.centre
    set Body B = column.end
  end
  subsection guide
    set Type = prismatic
    set Body A = ground
    set Body B = slider.centre
    set Axis = 1, 0, 0
  end
  subsection holder
    set Type = flexible joint
    set Body A = ground
    set Body B = column.middle
    set Rotational stiffness = 1, 0, 0
  end
end
subsection Loads
  subsection left moment
    set Type = point load
    set At = column.start
    set Moment = -P, 0, 0
  end
  subsection right moment
    set Type = point load
    set At = column.end
    set Moment = P, 0, 0
  end
end
)";
  std::string       model    = with_part(euler, "Joints", "Modal", supports);
  model.replace(model.find("subsection Bodies\n"),
                18,
                "subsection Bodies\n subsection slider\n set Type = rigid body\n set Position = 1, 0, 0\n end\n");
  const double P = root_of(
    [&](const double torque) {
      Scene scene(
        model,
        {"Constants/P = " + exact(torque), "Sections/slender/EI3 = 1", "Sections/slender/GJ = 1e4", "Modal/Modes = 6"});
      scene.equilibrium();
      return smallest_square(scene.modes());
    },
    5.5,
    7);
  EXPECT_NEAR(P, 2 * M_PI, 1e-5);
}



TEST(Buckling, RingUnderPressure)
{
  const std::string ring = "prm/benchmarks/ring_pressure.prm";
  EXPECT_NEAR(buckling_load(ring, 2, 3.5, "p"), 3., 2e-5);
  const std::string dead =
    "subsection Loads\n subsection x\n set Type = line load\n set Body = ring\n"
    " set Force = -p, 0, 0\n set Variation = cos(s)\n end\n subsection y\n set Type = line load\n"
    " set Body = ring\n set Force = 0, -p, 0\n set Variation = sin(s)\n end\nend\n";
  EXPECT_NEAR(buckling_load(with_part(ring, "Loads", "Modal", dead), 2, 4.5, "p"), 4., 3e-5);
}



TEST(Flutter, FollowerForces)
{
  struct
  {
    std::string model;
    double      from, to, load, frequency;
  } const cases[] = {
    {beck, 15, 25, 20.0509536, 11.0155576},
    {with_part(beck, "Loads", "Modal", line_load("set Force = -P, 0, 0\n set Axes = body\n")),
     30,
     50,
     40.0537365,
     11.030217},
    {with_part(beck, "Loads", "Modal", line_load("set Force = -P, 0, 0\n set Variation = 1 - s\n set Axes = body\n")),
     120,
     180,
     150.641596,
     11.4857136}};
  for (const auto &c : cases)
    {
      const Flutter found = flutter(c.model, c.from, c.to);
      EXPECT_NEAR(found.load, c.load, 1e-5 * c.load);
      EXPECT_NEAR(found.frequency, c.frequency, 1e-4 * c.frequency);
    }
}
