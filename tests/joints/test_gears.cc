// Gears: ratio between any axes, moments on both shafts and on the housing, reflected inertia. Closed forms.

#include "../scene.h"

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A housing on a measured support, shaft A about x held by a torsional spring to the ground, shaft B about y driven. */
  const std::string gear_box = R"(
set Analyses = static
subsection Bodies
  subsection housing
    set Type = rigid body
    set Mass = 1
  end
  subsection shaft A
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
  end
  subsection shaft B
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
  end
end
subsection Joints
  subsection support
    set Type = rigid
    set Body A = ground
    set Body B = housing.centre
    set Axis = 0, 0, 1
    set Axis 1 = 1, 0, 0
    set Reaction = true
  end
  subsection bearing A
    set Type = revolute
    set Body A = housing.centre
    set Body B = shaft A.centre
    set Axis = 1, 0, 0
  end
  subsection bearing B
    set Type = revolute
    set Body A = housing.centre
    set Body B = shaft B.centre
    set Axis = 0, 1, 0
  end
  subsection holder
    set Type = flexible joint
    set Body A = ground
    set Body B = shaft A.centre
    set Axis = 1, 0, 0
    set Rotational stiffness = 100, 0, 0
  end
  subsection gears
    set Type = gear
    set Joint A = bearing A
    set Joint B = bearing B
    set Ratio = -2.5
  end
end
subsection Loads
  subsection torque
    set Type = point load
    set At = shaft B.centre
    set Moment = 0, 8, 0
  end
end
)";
} // namespace



// Virtual work: 8 N m on B times n = −2.5 arrives at A, held by k sin θ cos θ. The gear moments on the shafts return to
// the housing: the ground must hold it by (n T, −T, 0), so that the sum with the holder's (−n T, 0, 0) and the load's
// (0, T, 0) is 0.
TEST(Gears, BalanceOfMoments)
{
  Scene scene(gear_box);
  scene.equilibrium();
  const double T = 8, n = -2.5, theta = 0.5 * std::asin(2 * n * T / 100);
  EXPECT_NEAR(scene.value("bearing A.rotation"), theta * 180 / M_PI, 1e-7);
  EXPECT_NEAR(scene.value("bearing B.rotation"), n * theta * 180 / M_PI, 1e-7);
  EXPECT_NEAR(std::abs(scene.value("gears.moment")), T, 1e-8);
  EXPECT_NEAR(scene.value("support.moment 1"), n * T, 1e-8);
  EXPECT_NEAR(scene.value("support.moment 2"), -T, 1e-8);
  EXPECT_NEAR(scene.value("support.moment 3"), 0, 1e-8);
}



// The total moment on the ground balances the load, however it gets there.
TEST(Gears, GroundTakesTheLoad)
{
  Scene               scene(gear_box);
  const State        &state = scene.equilibrium();
  std::vector<double> r;
  scene.system.residual(state, state.stress, r);
  const Vector6 ground = Eigen::Map<const Vector6>(&r[scene.system.size()]);
  EXPECT_NEAR(std::abs(ground(4)), 8., 1e-8);
  EXPECT_LT(Vector6(ground - ground(4) * Vector6::Unit(4)).norm(), 1e-8);
}



// Gears multiply the inertia and the spring of what they drive: (J_A + n² J_B) θ¨ + k θ = 0.
TEST(Gears, ReflectedInertia)
{
  Scene        scene(gear_box.substr(0, gear_box.find("subsection Loads")));
  const double expected = std::sqrt(100 / (1 + 2.5 * 2.5 * 1.));
  EXPECT_NEAR(scene.modes().at(0).frequency(), expected, 1e-9 * expected);
}
