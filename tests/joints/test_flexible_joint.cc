// The flexible joint: six springs between two frames, one by one, its coupling matrix, and large torsion.
//
// Strains are the gap in the axes of A and ½ (E_kᴬ·E_jᴮ − E_jᴬ·E_kᴮ), for a rotation about one axis alone its sine. The
// energy of torsion is ½ k sin²θ, the moment k sin θ cos θ = ½ k sin 2θ: largest at 45°.

#include <samara/rotation/matrix6.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const Vector3 axis_1 = Vector3(1, 2, 2) / 3., axis_2 = Vector3(2, 1, -2) / 3., axis_3 = axis_1.cross(axis_2);

  std::string
  text_of(const Vector3 &v)
  {
    std::ostringstream text;
    text.precision(17);
    text << v(0) << ", " << v(1) << ", " << v(2);
    return text.str();
  }

  /** The body's centre is at the joint, so that each load strains one spring. */
  std::string
  body_on_flexible_joint(const std::string &entries, const Vector3 &force, const Vector3 &moment)
  {
    return "set Analyses = static\nsubsection Bodies\n subsection body\n set Type = rigid body\n set Mass = 2\n"
           " set Position = 0.4, 0.3, 0.2\n set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n subsection j\n"
           " set Type = flexible joint\n set Body A = ground\n set Body B = body.centre\n set Axis = 1, 2, 2\n"
           " set Axis 2 = 2, 1, -2\n set Stiffness = 10, 20, 30\n set Rotational stiffness = 40, 50, 60\n" +
           entries +
           " end\nend\nsubsection Loads\n subsection f\n set Type = point load\n set At = body.centre\n set Force = " +
           text_of(force) + "\n set Moment = " + text_of(moment) + "\n end\nend\n";
  }

  const Vector3 start(0.4, 0.3, 0.2);
} // namespace



TEST(FlexibleJoint, DisplacementsOneByOne)
{
  const Vector3 axes[] = {axis_1, axis_2, axis_3};
  const double  k[]    = {10, 20, 30};
  for (unsigned int i = 0; i < 3; ++i)
    {
      // displacements along the axes of A are linear at any size
      Scene        scene(body_on_flexible_joint("", 5 * axes[i], Vector3::Zero()));
      const State &state = scene.equilibrium();
      EXPECT_LT((state.position(1) - start - 5 / k[i] * axes[i]).norm(), 1e-10) << i + 1;
      EXPECT_LT((state.triad(1) - Matrix3::Identity()).norm(), 1e-10) << i + 1;
      EXPECT_NEAR(scene.value("j.force " + std::to_string(i + 1)), 5., 1e-9);
      EXPECT_NEAR(scene.value("j.strain " + std::to_string(i + 1)), 5 / k[i], 1e-10);
    }
}



TEST(FlexibleJoint, RotationsOneByOne)
{
  const Vector3 axes[] = {axis_1, axis_2, axis_3};
  const double  k[]    = {40, 50, 60};
  for (unsigned int i = 0; i < 3; ++i)
    for (const double sin_2_theta : {1e-4, 0.6, -0.9})
      {
        Scene         scene(body_on_flexible_joint("", Vector3::Zero(), 0.5 * k[i] * sin_2_theta * axes[i]));
        const double  theta    = 0.5 * std::asin(sin_2_theta);
        const Matrix3 expected = Eigen::AngleAxisd(theta, axes[i]).toRotationMatrix();
        const State  &state    = scene.equilibrium();
        EXPECT_LT((state.triad(1) - expected).norm(), 1e-8) << i + 1 << ", " << sin_2_theta;
        EXPECT_LT((state.position(1) - start).norm(), 1e-10) << i + 1;
        EXPECT_NEAR(scene.value("j.strain " + std::to_string(i + 4)), std::sin(theta), 1e-8);
        EXPECT_NEAR(scene.value("j.force " + std::to_string(i + 4)), k[i] * std::sin(theta), 1e-6);
      }
}



// The energy of a spring is the work of the load that strains it: ½ F²/k, ½ k sin² θ.
TEST(FlexibleJoint, Energy)
{
  Scene stretched(body_on_flexible_joint("", 5 * axis_2, Vector3::Zero()));
  EXPECT_NEAR(stretched.system.energy(stretched.equilibrium()).strain, 0.5 * 25 / 20, 1e-10);
  Scene twisted(body_on_flexible_joint("", Vector3::Zero(), 20 * std::sin(0.8) * axis_1));
  EXPECT_NEAR(twisted.system.energy(twisted.equilibrium()).strain, 0.5 * 40 * std::pow(std::sin(0.4), 2), 1e-8);
}



// Coupling of the first two displacements and of axial displacement with torsion: the inverse of the 6×6 matrix.
TEST(FlexibleJoint, Coupling)
{
  Vector6 load;
  load << 10, 20, 30, 40, 50, 60;
  Matrix6 C = load.asDiagonal();
  C(0, 1) = C(1, 0) = 5;
  C(0, 3) = C(3, 0) = -7;
  load << 1e-4, 2e-4, 0, 3e-4, 0, 0;
  const Vector6 strain = symmetric_solution(C, load);
  Scene         scene(body_on_flexible_joint("set Coupling = 5, 0, -7, 0, 0,  0, 0, 0, 0,  0, 0, 0,  0, 0,  0\n",
                                     load(0) * axis_1 + load(1) * axis_2,
                                     load(3) * axis_1));
  scene.equilibrium();
  for (unsigned int i = 0; i < 6; ++i)
    EXPECT_NEAR(scene.value("j.strain " + std::to_string(i + 1)), strain(i), 1e-9) << i + 1; // second order of 1e-5
}



// Six dampers: with springs and dampers in proportion every mode has λ² m + λ c + k = 0 of its own axis.
TEST(FlexibleJoint, DampersOneByOne)
{
  Scene scene(
    "set Analyses = modal\nsubsection Bodies\n subsection body\n set Type = rigid body\n set Mass = 2\n"
    " set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n subsection j\n set Type = flexible joint\n"
    " set Body A = ground\n set Body B = body.centre\n set Axis = 1, 2, 2\n set Axis 2 = 2, 1, -2\n"
    " set Stiffness = 2, 8, 18\n set Rotational stiffness = 16, 25, 36\n set Damping = 0.4, 0.8, 1.2\n set Rotational damping = 0.8, 1, 0\n end\nend\n");
  const double omega[] = {1, 2, 3, 4, 5, 6}, c_over_m[] = {0.2, 0.4, 0.6, 0.8, 1, 0};
  ASSERT_EQ(scene.modes().size(), 6u);
  for (unsigned int i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(scene.modes()[i].frequency(), omega[i], 1e-9);
      EXPECT_NEAR(scene.modes()[i].damping_ratio(), c_over_m[i] / (2 * omega[i]), 1e-9);
    }
}
