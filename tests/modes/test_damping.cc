// Damping of beams and joints against closed forms. Stiffness-proportional damping β gives every mode λ² + β ω² λ + ω²
// = 0: |λ| = ω and the damping ratio β ω/2, exactly, whatever the mesh. A damper at a joint with one degree of freedom:
// J λ² + c λ + k = 0.

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  const std::string timoshenko_beam = "prm/benchmarks/timoshenko_beam.prm";

  const double omega[] = {8.38735763266, 25.3458803025, 44.1265715521, 63.0949419417}; // L/r = 10, exact

  /** Bending modes in the plane x z of the simply supported beam. */
  std::vector<Mode>
  modes_in_plane(const std::string &override)
  {
    Scene scene(timoshenko_beam, {override, "Bodies/beam/Damping frequency = 20", "Bodies/beam/Degree = 4"});
    std::vector<Mode> result;
    for (const auto &mode : scene.modes())
      if (share(scene.system, mode, 2) > 0.5)
        result.push_back(mode);
    return result;
  }

  const std::string flywheel = R"(
set Analyses = modal
subsection Bodies
  subsection wheel
    set Type = rigid body
    set Mass = 3
    set Inertia = 2, 2, 2
  end
end
subsection Joints
  subsection bearing
    set Type = revolute
    set Body A = ground
    set Body B = wheel.centre
    set Axis = 1, 2, 3
    subsection rotation
      set Spring = 50
      set Damper = 4
    end
  end
end
)";
} // namespace



TEST(Damping, ProportionalToStiffness)
{
  const double beta  = 0.004;
  const auto   modes = modes_in_plane("Bodies/beam/Damping = " + exact(beta));
  for (unsigned int n = 0; n < 4; ++n)
    {
      EXPECT_NEAR(modes.at(n).frequency(), omega[n], 1e-6 * omega[n]);
      EXPECT_NEAR(modes[n].damping_ratio(), beta * modes[n].frequency() / 2, 1e-8);
    }
}



TEST(Damping, RatioAtAFrequency)
{
  // ζ = 0.03 at 20 rad/s grows in proportion to the frequency
  const auto modes = modes_in_plane("Bodies/beam/Damping ratio = 0.03");
  for (unsigned int n = 0; n < 4; ++n)
    EXPECT_NEAR(modes.at(n).damping_ratio(), 0.03 * omega[n] / 20, 1e-7);
}



// Damping of shear only, on a beam in which shear and bending work together, is less than that of both and not zero.
TEST(Damping, OfSingleStrains)
{
  const double beta    = 0.004;
  const auto   shear   = modes_in_plane("Bodies/beam/Damping = 0, 0, 0.004, 0, 0, 0");
  const auto   bending = modes_in_plane("Bodies/beam/Damping = 0, 0, 0, 0, 0.004, 0");
  const auto   others  = modes_in_plane("Bodies/beam/Damping = 0.004, 0.004, 0, 0.004, 0, 0.004");
  // to first order the energies of shear and bending share the damping: the ratios add up to that of all
  for (unsigned int n = 0; n < 4; ++n)
    {
      EXPECT_GT(shear.at(n).damping_ratio(), 1e-3);
      EXPECT_GT(bending.at(n).damping_ratio(), 1e-3);
      EXPECT_NEAR((shear[n].damping_ratio() + bending[n].damping_ratio()) / (beta * omega[n] / 2), 1., 0.02);
      EXPECT_NEAR(others.at(n).damping_ratio(), 0., 1e-8);
    }
}



TEST(Damping, DamperOfAJoint)
{
  Scene       scene(flywheel);
  const auto &modes = scene.modes();
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].frequency(), 5., 1e-10);              // sqrt(k/J)
  EXPECT_NEAR(modes[0].damping_ratio(), 0.2, 1e-10);         // c/(2 sqrt(k J))
  EXPECT_NEAR(modes[0].lambda.imag(), std::sqrt(24.), 1e-9); // ω sqrt(1 − ζ²)
}



// More than critical: two real roots, −4 and −6.25 for c = 20.5.
TEST(Damping, Overcritical)
{
  Scene       scene(flywheel, {"Joints/bearing/rotation/Damper = 20.5"});
  const auto &modes = scene.modes();
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_NEAR(modes[0].lambda.real(), -4., 1e-9);
  EXPECT_NEAR(modes[1].lambda.real(), -6.25, 1e-9);
  EXPECT_NEAR(modes[0].damping_ratio(), 1., 1e-12);
}



// Equal oscillators of 2 kg, 18 N/m and 20 N s/m on a cart: n − 1 of their motions leave it at rest, with −1 and −9
// each. Roots that are there so often come out of round-off as pairs, of which both are modes.
TEST(Damping, EqualRealRoots)
{
  for (unsigned int n = 2; n <= 12; ++n)
    {
      const auto slide =
        [](const std::string &name, const std::string &a, const std::string &b, const std::string &entries) {
          return "subsection " + name + "\n set Type = prismatic\n set Axis = 1, 0.7, -0.4\n set Body A = " + a +
                 "\n set Body B = " + b + ".centre\n subsection displacement\n" + entries + " end\nend\n";
        };
      const auto body = [](const std::string &mass) {
        return " set Type = rigid body\n set Inertia = 1, 1, 1\n set Mass = " + mass;
      };
      std::string bodies = "subsection cart\n" + body("3") + "\n set Frames = ", masses,
                  joints = slide("rail", "ground", "cart", "set Spring = 50\n");
      for (unsigned int i = 0; i < n; ++i)
        {
          const std::string at = std::to_string(i + 1), name = "mass" + at;
          bodies += (i > 0 ? ", " : "") + name + " at " + at + " 0.3 0.1";
          masses += "subsection " + name + "\n" + body("2") + "\n set Position = " + at + ", 0.3, 0.1\nend\n";
          joints += slide("j" + at, "cart." + name, name, "set Spring = 18\nset Damper = 20\n");
        }
      Scene        scene("set Analyses = modal\nsubsection Bodies\n" + bodies + "\nend\n" + masses +
                  "end\nsubsection Joints\n" + joints +
                  "end\nsubsection Modal\n set Modes = " + std::to_string(2 * n + 2) + "\nend\n");
      unsigned int slow = 0, fast = 0;
      for (const auto &mode : scene.modes())
        {
          slow += std::abs(mode.lambda + 1.) < 1e-9;
          fast += std::abs(mode.lambda + 9.) < 1e-8;
        }
      EXPECT_EQ(slow, n - 1) << n;
      EXPECT_EQ(fast, n - 1) << n;
    }
}



// The mode nearest to the shift, not the slowest one.
TEST(Damping, NearestToTheShift)
{
  for (const auto &[shift, expected] : {std::pair<std::string, double>{"-7", -6.25}, {"-3.5", -4.}})
    {
      Scene scene(flywheel, {"Joints/bearing/rotation/Damper = 20.5", "Modal/Modes = 1", "Modal/Shift = " + shift});
      ASSERT_EQ(scene.modes().size(), 1u);
      EXPECT_NEAR(scene.modes()[0].lambda.real(), expected, 1e-9);
    }
}



// Material damping does not slow a rigid rotation: the hinged blade flaps undamped, at the frequency it has without it.
TEST(Damping, NotOfRigidMotion)
{
  Scene scene("prm/benchmarks/rotating_beam_hinged.prm", {"Constants/eta = 7", "Bodies/blade/Damping = 0.001"});
  scene.equilibrium();
  unsigned int n = 0;
  for (const auto &mode : scene.modes())
    {
      const bool is_rigid_flap = std::abs(mode.frequency() - 7) < 1e-4;
      n += is_rigid_flap;
      EXPECT_TRUE(!is_rigid_flap || std::abs(mode.damping_ratio()) < 1e-7) << mode.damping_ratio();
      EXPECT_TRUE(mode.frequency() < 8 || mode.damping_ratio() > 1e-4) << mode.damping_ratio();
    }
  EXPECT_EQ(n, 1u);
}
