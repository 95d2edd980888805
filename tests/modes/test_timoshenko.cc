// Frequencies of shear flexible beams at rest.
//
// Simply supported Timoshenko beam (prm/benchmarks/timoshenko_beam.prm), E/G = 2.6, slenderness L/r 10, 20, 50: exact
// roots of s r² ω⁴ − (1 + a² (r² + s)) ω² + a⁴ = 0, a = n π, s = EI/(κ G A L²), in units of sqrt(EI/(m L⁴)). The two
// shear factors tell rotary inertia from shear. Expected: order 2p.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  const std::string stubby_beam = "prm/benchmarks/timoshenko_beam.prm";

  struct StubbyBeam
  {
    double                slenderness, kappa;
    std::array<double, 4> omega;
  };
  const StubbyBeam stubby_beams[] = {{10, 5. / 6., {8.38735763266, 25.3458803025, 44.1265715521, 63.0949419417}},
                                     {10, 0.85, {8.40466332982, 25.4617012648, 44.4005100872, 63.5531729397}},
                                     {20, 5. / 6., {9.41059792322, 33.5494305306, 65.6466582976, 101.38352121}},
                                     {20, 0.85, {9.41692642596, 33.6186533193, 65.87198061, 101.846805059}},
                                     {50, 5. / 6., {9.79053586029, 38.2667607342, 83.0865210446, 141.226166556}},
                                     {50, 0.85, {9.79169501335, 38.2838929004, 83.1634056228, 141.435483504}}};

  /** The same supports made of other joints: the start on a universal joint, the end hinged to a massless slider. */
  const std::string other_supports = R"(  subsection slider
    set Type = rigid body
    set Position = 1, 0, 0
  end
  subsection beam
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Section = stubby
    set Elements = 8
    set Degree = 4
  end
end
subsection Joints
  subsection hinge
    set Type = universal
    set Body A = ground
    set Body B = beam.start
    set Axis = 1, 0, 0
    set Second axis = 0, 1, 0
    subsection rotation 1
      set Prescribed = 0
    end
  end
  subsection guide
    set Type = prismatic
    set Body A = ground
    set Body B = slider.centre
    set Axis = 1, 0, 0
  end
  subsection roller
    set Type = revolute
    set Body A = slider.centre
    set Body B = beam.end
    set Axis = 0, 1, 0
  end
end
)";

  Scene
  beam(const StubbyBeam &row, const unsigned int degree, const unsigned int elements)
  {
    return Scene(stubby_beam,
                 {"Constants/r = " + exact(1 / row.slenderness),
                  "Constants/kappa = " + exact(row.kappa),
                  "Bodies/beam/Degree = " + std::to_string(degree),
                  "Bodies/beam/Elements = " + std::to_string(elements)});
  }
} // namespace



TEST(Timoshenko, AllSlendernesses)
{
  for (const auto &row : stubby_beams)
    {
      Scene      scene = beam(row, 4, 16);
      const auto omega = frequencies(scene, 2);
      for (unsigned int n = 0; n < 4; ++n)
        EXPECT_NEAR(omega.at(n), row.omega[n], 1e-8 * row.omega[n])
          << "L/r = " << row.slenderness << ", kappa = " << row.kappa << ", mode " << n + 1;
    }
}



TEST(Timoshenko, Order)
{
  for (const unsigned int p : {1, 2, 3, 4})
    {
      std::vector<double> errors[2];
      for (const unsigned int refined : {0, 1})
        {
          const unsigned int n[]   = {0, 24, 12, 6, 4};
          Scene              scene = beam(stubby_beams[0], p, n[p] << refined);
          const auto         omega = frequencies(scene, 2);
          for (const unsigned int k : {0, 1, 2})
            errors[refined].push_back(std::abs(omega.at(k) / stubby_beams[0].omega[k] - 1));
        }
      for (const unsigned int k : {1, 2})
        EXPECT_NEAR(std::log2(errors[0][k] / errors[1][k]), 2. * p, 0.35) << "degree " << p << ", mode " << k + 1;
    }
}



// The supports of a simply supported beam can be made of different joints.
TEST(Timoshenko, SupportsOfOtherJoints)
{
  std::ifstream     in(std::string(SAMARA_SOURCE_DIR) + "/" + stubby_beam);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all    = text.str();
  const auto        bodies = all.find("subsection Bodies") + 18, modal = all.find("subsection Modal");
  ASSERT_NE(modal, std::string::npos);
  Scene      scene(all.substr(0, bodies) + other_supports + all.substr(modal));
  const auto omega = frequencies(scene, 2);
  for (unsigned int n = 0; n < 4; ++n)
    EXPECT_NEAR(omega.at(n), stubby_beams[0].omega[n], 2e-7 * stubby_beams[0].omega[n]) << n + 1;
}
