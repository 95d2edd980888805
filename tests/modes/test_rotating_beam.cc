// Flap and lead-lag modes of a uniform beam turning about the vertical (prm/benchmarks/rotating_beam*.prm): clamped and
// hinged, hub radii 0, 0.1, 0.5 and 1 times the length, eta = 0 ... 12.
//
// Reference: rotating_beam.inc (104 rows, 8 digits). It has neither shear nor rotary inertia nor extension, so the
// model has no rotary inertia, GA = 1e7 and EA = 1e8 EI/L² (more would cost digits by round-off). What is left,
// relative to the frequency: shear (n π)²/(2 GA) < 1.3e-5 for flap 5, extension η²(1/2 + δ)/EA < 3e-6, which both
// lengthens the beam and moves it outward. Tolerance 3e-5, absolutely 0.01 for the lag mode of a beam hinged on the
// axis, which is free to turn: a double zero splits by the root of round-off.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  struct RotatingBeam
  {
    bool                  hinged;
    double                delta, eta;
    std::array<double, 5> flap;
    std::array<double, 3> lag;
  };

  const RotatingBeam rotating_beams[] = {
#include "rotating_beam.inc"
  };

  Scene
  blade(const RotatingBeam &row, const std::vector<std::string> &more = {})
  {
    std::vector<std::string> overrides = {"Constants/delta = " + exact(row.delta), "Constants/eta = " + exact(row.eta)};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return Scene(row.hinged ? "prm/benchmarks/rotating_beam_hinged.prm" : "prm/benchmarks/rotating_beam.prm",
                 overrides);
  }
} // namespace



TEST(RotatingBeam, FlapAndLag)
{
  for (const auto &row : rotating_beams)
    {
      Scene scene = blade(row);
      scene.equilibrium();
      std::vector<double> flap, lag;
      if (row.eta == 0)
        {
          // the beam has no preferred direction: modes come in pairs, in any two directions
          for (const auto &mode : scene.modes())
            if (!is_second_of_zero(mode))
              (flap.size() == lag.size() ? flap : lag).push_back(mode.frequency());
        }
      else
        {
          flap = frequencies(scene, 2);
          lag  = frequencies(scene, 1);
        }
      const std::string which = std::string(row.hinged ? "hinged" : "clamped") + ", delta " +
                                std::to_string(row.delta) + ", eta " + std::to_string(row.eta);
      ASSERT_GE(flap.size(), 5u) << which;
      ASSERT_GE(lag.size(), 3u) << which;
      for (unsigned int n = 0; n < 5; ++n)
        EXPECT_NEAR(flap[n], row.flap[n], row.flap[n] > 0 ? 3e-5 * row.flap[n] : 0.01) << which << ", flap " << n + 1;
      for (unsigned int n = 0; n < 3; ++n)
        EXPECT_NEAR(lag[n], row.lag[n], row.lag[n] > 0 ? 3e-5 * row.lag[n] : 0.01) << which << ", lag " << n + 1;
    }
}



// Order 2p in flap frequencies 3 and 4 at eta = 4; degrees 3 and 4 come too near to what the reference neglects.
TEST(RotatingBeam, OrderOfFrequencies)
{
  const RotatingBeam *row = std::find_if(std::begin(rotating_beams),
                                         std::end(rotating_beams),
                                         [](const RotatingBeam &r) { return r.eta == 4; });
  for (const unsigned int p : {1, 2})
    {
      std::vector<double> errors[2];
      for (const unsigned int refined : {0, 1})
        {
          const unsigned int n = (p == 1 ? 24 : 6) << refined;
          Scene              scene =
            blade(*row, {"Bodies/blade/Degree = " + std::to_string(p), "Bodies/blade/Elements = " + std::to_string(n)});
          scene.equilibrium();
          const auto flap = frequencies(scene, 2);
          for (const unsigned int k : {2, 3})
            errors[refined].push_back(std::abs(flap.at(k) / row->flap[k] - 1));
        }
      for (const unsigned int k : {2, 3})
        EXPECT_NEAR(std::log2(errors[0][k - 2] / errors[1][k - 2]), 2. * p, 0.4)
          << "degree " << p << ", flap " << k + 1;
    }
}



// A blade hinged on the axis of rotation flaps at the speed of rotation: it then turns in a tilted plane. Exact on any
// mesh, for any stiffness and however far the blade has stretched (here by 25 %), if its section has no rotary inertia.
TEST(RotatingBeam, HingedOnTheAxisFlapsAtTheSpeed)
{
  for (const unsigned int p : {1, 2, 3, 4})
    {
      Scene scene = blade({true, 0, 7, {}, {}},
                          {"Bodies/blade/Degree = " + std::to_string(p),
                           "Bodies/blade/Elements = 2",
                           "Sections/slender/EA = 80",
                           "Sections/slender/GA2 = 60",
                           "Sections/slender/GA3 = 50"});
      scene.equilibrium();
      EXPECT_GT(scene.value("blade.end.displacement x"), 0.2);
      double nearest = 1e300;
      for (const double w : frequencies(scene, 2))
        nearest = std::abs(w - 7) < std::abs(nearest - 7) ? w : nearest;
      EXPECT_NEAR(nearest, 7., 7e-8) << "degree " << p;
    }
}
