// Closed loops: redundant constraints are found, named and dropped; a slider-crank with a massless rod.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A planar four-bar, a parallelogram with cranks of length 1 and a coupler of length 2; more joints follow. */
  const std::string bars = R"(
set Analyses = static
subsection Bodies
  subsection crank
    set Type = rigid body
    set Mass = 1
    set Inertia = 0.1, 0.1, 0.1
    set Position = 0, 0.5, 0
    set Frames = end at 0 1 0
  end
  subsection coupler
    set Type = rigid body
    set Mass = 2
    set Inertia = 0.1, 0.1, 0.1
    set Position = 1, 1, 0
    set Frames = end at 2 1 0
  end
  subsection rocker
    set Type = rigid body
    set Mass = 1
    set Inertia = 0.1, 0.1, 0.1
    set Position = 2, 0.5, 0
    set Frames = foot at 2 0 0
  end
end
subsection Loads
  subsection weight
    set Type = gravity
    set Acceleration = 0, -9.81, 0
  end
end
)";

  std::string
  joint_about_z(const std::string &name,
                const std::string &kind,
                const std::string &a,
                const std::string &b,
                const std::string &at)
  {
    return "  subsection " + name + "\n set Type = " + kind + "\n set Body A = " + a + "\n set Body B = " + b +
           "\n set Position = " + at + "\n set Axis = 0, 0, 1\n" +
           (name == "foot" ? " subsection rotation\n set Spring = 50\n end\n" : "") + " end\n";
  }

  std::string
  four_bar(const std::string &elbow, const std::string &heel)
  {
    return bars + "subsection Joints\n" + joint_about_z("foot", "revolute", "ground", "crank.centre", "0, 0, 0") +
           joint_about_z("knee", "revolute", "crank.end", "coupler.centre", "0, 1, 0") +
           joint_about_z("elbow", elbow, "coupler.end", "rocker.centre", "2, 1, 0") +
           joint_about_z("heel", heel, "ground", "rocker.foot", "2, 0, 0") + "end\n";
  }

  /** All of the weight at the height cos θ of the cranks' ends: k θ = (½ + 2 + ½) g sin θ, θ ≠ 0 under a side force. */
  void
  expect_equilibrium(Scene &scene)
  {
    scene.equilibrium();
    const double theta = scene.value("foot.rotation") * M_PI / 180;
    EXPECT_NEAR(50 * theta, 3 * 9.81 * std::sin(theta) - 4 * std::cos(theta), 1e-7);
    EXPECT_LT(theta, -0.1);
    EXPECT_NEAR(scene.value("coupler.rotation z"), 0, 1e-7);
    EXPECT_NEAR(scene.value("rocker.rotation z"), theta * 180 / M_PI, 1e-7);
    EXPECT_NEAR(scene.value("coupler.end.position x"), 2 - std::sin(theta), 1e-9);
  }

  const std::string push =
    "  subsection push\n set Type = point load\n set At = coupler.centre\n set Force = 4, 0, 0\n end\n";

  std::string
  pushed_below(std::string text)
  {
    return text.replace(text.find("  subsection weight"), 0, push);
  }
} // namespace



TEST(ClosedLoops, FourRevolutesAreRedundant)
{
  Scene      scene(four_bar("revolute", "revolute"));
  const auto check = check_model(scene.system);
  // 3 bodies × 6 − 4 × 5 = −2, but it has one motion: three constraints too many
  EXPECT_EQ(check.redundant_multipliers.size(), 3u);
  EXPECT_EQ(check.n_free_motions, 0u) << "the spring at its foot holds it";
  Scene without_spring(four_bar("revolute", "revolute"), {"Joints/foot/rotation/Spring = 0"});
  EXPECT_EQ(check_model(without_spring.system).n_free_motions, 1u);
  EXPECT_EQ(check_model(without_spring.system).redundant_multipliers.size(), 3u);
  ASSERT_EQ(check.redundant.size(), 1u);
  const std::string text = check.redundant[0];
  for (const std::string name : {"foot", "knee", "elbow", "heel"})
    EXPECT_NE(text.find("joint " + name), std::string::npos) << text;
}



TEST(ClosedLoops, RunsWithoutTheRedundantOnes)
{
  Scene scene(pushed_below(four_bar("revolute", "revolute")));
  expect_equilibrium(scene);
}



// With a spherical and a cylindrical joint in the loop nothing is redundant, and the motion is the same.
TEST(ClosedLoops, SphericalAndCylindricalAreNot)
{
  Scene      scene(pushed_below(four_bar("spherical", "cylindrical")));
  const auto check = check_model(scene.system);
  EXPECT_TRUE(check.redundant.empty());
  EXPECT_EQ(check.n_free_motions, 0u);
  expect_equilibrium(scene);
}



// One degree of freedom, whatever was dropped: (½ + ...) J_eff ω² = k − 3 g with J_eff = 2 (J + m/4) + 2 of the
// translating coupler, the cranks turning about their ends.
TEST(ClosedLoops, FrequencyOfAFourBar)
{
  const double J        = 2 * (0.1 + 0.25) + 2;
  const double expected = std::sqrt((50 - 3 * 9.81) / J);
  for (const bool redundant : {true, false})
    {
      Scene scene(redundant ? four_bar("revolute", "revolute") : four_bar("spherical", "cylindrical"));
      scene.equilibrium();
      EXPECT_NEAR(scene.modes().at(0).frequency(), expected, 1e-8) << redundant;
    }
}



namespace
{
  /** Crank of length 1 at 1 rad above x, turning about −y (lifting x to z), rod of length 2.5, slider along x. */
  const std::string slider_crank = R"(
set Analyses = static
subsection Constants
  set x0 = cos(1)
  set z0 = sin(1)
end
subsection Bodies
  subsection crank
    set Type = rigid body
    set Mass = 1
    set Position = x0, 0, z0
    set Inertia = 0.1, 0.1, 0.1
  end
  subsection slider
    set Type = rigid body
    set Mass = 1
    set Position = x0 + sqrt(6.25 - z0^2), 0, 0
    set Inertia = 0.1, 0.1, 0.1
  end
end
subsection Joints
  subsection main
    set Type = revolute
    set Body A = ground
    set Body B = crank.centre
    set Position = 0, 0, 0
    set Axis = 0, -1, 0
    subsection rotation
      set Spring = 30
    end
  end
  subsection guide
    set Type = prismatic
    set Body A = ground
    set Body B = slider.centre
    set Axis = 1, 0, 0
  end
  subsection rod
    set Type = distance
    set Body A = crank.centre
    set Body B = slider.centre
  end
end
subsection Loads
  subsection force
    set Type = point load
    set At = slider.centre
    set Force = 12, 0, 0
  end
end
)";
} // namespace



// Virtual work: k (α − 1) = F dx/dα with x = cos α + sqrt(l² − sin² α), l = 2.5, solved here by bisection.
TEST(ClosedLoops, SliderCrank)
{
  const double l   = 2.5;
  const auto   out = [&](const double alpha) {
    const double s = std::sin(alpha), c = std::cos(alpha);
    return 30 * (alpha - 1) - 12 * (-s - s * c / std::sqrt(l * l - s * s));
  };
  double low = 0, high = 1;
  while (high - low > 1e-14)
    (out(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
  Scene        scene(slider_crank);
  const State &state = scene.equilibrium();
  EXPECT_NEAR(1 + scene.value("main.rotation") * M_PI / 180, low, 1e-9);
  EXPECT_NEAR((state.position(2) - state.position(1)).norm(), l, 1e-10);
  EXPECT_NEAR(state.position(2)(0), std::cos(low) + std::sqrt(l * l - std::pow(std::sin(low), 2)), 1e-9);
  // the slider pulls the crank's end outward
  const double tension = 12 / std::sqrt(1 - std::pow(std::sin(low) / l, 2));
  EXPECT_NEAR(scene.value("rod.force"), tension, 1e-7);
}



// A rod whose length is not the distance in the reference configuration: statics assembles the mechanism.
TEST(ClosedLoops, RodOfAnotherLength)
{
  Scene        scene(slider_crank, {"Joints/rod/Length = 2.6", "Loads/force/Force = 0, 0, 0"});
  const State &state = scene.equilibrium();
  EXPECT_NEAR((state.position(2) - state.position(1)).norm(), 2.6, 1e-10);
  EXPECT_NEAR(scene.value("main.rotation"), 0, 1e-7);
}
