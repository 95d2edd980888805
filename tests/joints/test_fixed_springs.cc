// Springs in fixed axes: their forces in any state, and a rotor on them.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A rotor of 2 kg that a motor turns with 30 rad/s through a coupling; springs in fixed axes hold its point p. */
  std::string
  rotor(const std::string &p, const std::string &inertia, const double stiffness_2)
  {
    return R"(
set Analyses = static, modal
subsection Bodies
  subsection drive
    set Type    = rigid body
    set Mass    = 1
    set Inertia = 1, 1, 1
  end
  subsection rotor
    set Type     = rigid body
    set Mass     = 2
    set Position = 1, 0, 0
    set Inertia  = )" +
           inertia + "\n    set Frames = p at " + p + R"(
  end
end
subsection Joints
  subsection motor
    set Type   = revolute
    set Body A = ground
    set Body B = drive
    set Axis   = 1, 0, 0
  end
  subsection coupling
    set Type                 = flexible joint
    set Body A               = drive
    set Body B               = rotor
    set Rotational stiffness = 1e3, 1e3, 1e3
  end
  subsection mount
    set Type      = springs in fixed axes
    set Body A    = ground
    set Body B    = rotor.p
    set Stiffness = 5000, )" +
           number_to_text(stiffness_2) + R"(, 3000
  end
end
subsection Loads
  subsection turning
    set Type  = steady rotation
    set Joint = motor
    set Speed = 30
  end
end
)";
  }

  bool
  has_frequency(Scene &scene, const double frequency)
  {
    const auto &modes = scene.modes();
    return std::any_of(modes.begin(), modes.end(), [&](const Mode &mode) {
      return std::abs(mode.frequency() - frequency) < 1e-8 * frequency;
    });
  }
} // namespace



// −Σ k_i E_i·(Δ − Δ₀) E_i on B at its point, the opposite on A at its own, however the bodies have turned.
TEST(FixedSprings, Forces)
{
  Scene scene(
    "subsection Bodies\n subsection a\n set Type = rigid body\n set Mass = 3\n set Inertia = 1, 2, 2.5\n"
    " set Position = 0.2, -0.1, 0.4\n set Frames = tip at 0.5 0.1 -0.2\n end\n subsection b\n set Type = rigid body\n"
    " set Mass = 2\n set Inertia = 1, 1.5, 2\n set Position = 1, 0.7, 0.3\n set Frames = eye at 0.8 0.9 0.5\n end\nend\n"
    "subsection Joints\n subsection j\n set Type = springs in fixed axes\n set Body A = a.tip\n set Body B = b.eye\n"
    " set Axis = 1, 2, 2\n set Axis 2 = 2, 1, -2\n set Stiffness = 7, 11, 13\n end\nend\n");
  const State         start = scene.system.reference();
  State               state = start;
  std::vector<double> z(scene.system.size());
  for (unsigned int i = 0; i < z.size(); ++i)
    z[i] = 0.5 * std::sin(1.3 * i + 0.2);
  scene.system.update(state, z);
  scene.system.stresses(state, state.stress);
  const auto moved = [&](const unsigned int node, const Vector3 &x) {
    return Vector3(state.position(node) +
                   state.triad(node) * start.triad(node).transpose() * (x - start.position(node)));
  };
  const Vector3 tip(0.5, 0.1, -0.2), eye(0.8, 0.9, 0.5), e1 = Vector3(1, 2, 2) / 3., e2 = Vector3(2, 1, -2) / 3.;
  Matrix3       E;
  E << e1, e2, e1.cross(e2);
  const Vector3 strain = E.transpose() * (moved(2, eye) - moved(1, tip) - (eye - tip)),
                force  = -E * Vector3(7, 11, 13).cwiseProduct(strain);
  std::vector<double> r(scene.system.size() + 6, 0.);
  scene.system.residual(state, state.stress, r);
  for (const unsigned int node : {1, 2})
    {
      const int     i        = scene.system.layout.of_node(node);
      const Matrix3 D        = state.triad(node);
      const Vector3 expected = node == 2 ? force : Vector3(-force), f = -D * Eigen::Map<const Vector3>(&r[i]),
                    m = -D * Eigen::Map<const Vector3>(&r[i + 3]);
      EXPECT_LT((f - expected).norm(), 1e-13);
      EXPECT_LT((m - (moved(node, node == 2 ? eye : tip) - state.position(node)).cross(expected)).norm(), 1e-13);
    }
  for (unsigned int i = 0; i < 3; ++i)
    {
      const std::string axis = std::to_string(i + 1);
      EXPECT_NEAR(scene.input.model.probe("j.strain " + axis).value(state), strain(i), 1e-14);
      EXPECT_NEAR(scene.input.model.probe("j.force " + axis).value(state), -E.col(i).dot(force), 1e-13);
    }
}



// On the axis of a round rotor the springs may differ: its modes are those of a body that does not turn, √(k/m). Off
// the axis, or with a rotor that is not round, nothing is steady.
TEST(FixedSprings, HoldARotor)
{
  Scene round(rotor("1 0 0", "0.02, 0.01, 0.01", 1000));
  round.equilibrium();
  EXPECT_TRUE(has_frequency(round, std::sqrt(1000 / 2.)));
  EXPECT_TRUE(has_frequency(round, std::sqrt(3000 / 2.)));
  EXPECT_TRUE(has_frequency(round, std::sqrt(5000 / 2.)));
  Scene off_axis(rotor("1 0.1 0", "0.02, 0.01, 0.01", 3000));
  off_axis.equilibrium();
  EXPECT_NE(off_axis.stream.str().find("do not turn steadily"), std::string::npos);
  EXPECT_THROW(off_axis.modes(), InputError);
  Scene flat(rotor("1 0 0", "0.02, 0.01, 0.015", 1000));
  flat.equilibrium();
  EXPECT_THROW(flat.modes(), InputError);
}
