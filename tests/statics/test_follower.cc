// Cantilevers under forces and moments at the end that turn with it.
//
// Reference: the exact equations of the rod, integrated here. Seen from the loaded end all is known there, so that
//
//     x' = R (e₁ + Γ),  R' = R (K₀ + K)~,  m' = −x' × n,  n constant,  (Γ, K) = C⁻¹ (Rᵀn, Rᵀm)
//
// is an initial value problem from the end to the clamp, without shooting and without a finite element. The force that
// results as a dead load must give the same equilibrium.

#include <samara/base/text.h>

#include <samara/rotation/matrix6.h>

#include <gtest/gtest.h>

#include "entries.h"

using namespace samara;

namespace
{
  struct Rod
  {
    double                           length;
    Matrix6                          stiffness;
    std::function<Vector3(double s)> initial_curvature; ///< in section axes
  };

  struct End
  {
    Vector3 x; ///< seen from the clamp, in its axes
    Matrix3 D;
  };

  /** Where the end is under force @p f and moment @p m in its own axes, by the classic Runge–Kutta method. */
  End
  exact_end(const Rod &rod, const Vector3 &f, const Vector3 &m)
  {
    using State              = Eigen::Matrix<double, 3, 5>; // x, R, m
    const Matrix6 compliance = inverse6(rod.stiffness);
    const auto    derivative = [&](const double s, const State &y) {
      const Matrix3 R = y.middleCols<3>(1);
      Vector6       stress;
      stress << R.transpose() * f, R.transpose() * y.col(4);
      const Vector6 e = compliance * stress;
      State         d;
      d.col(0)           = R * (Vector3::UnitX() + e.head<3>());
      d.middleCols<3>(1) = R * skew((rod.initial_curvature(s) + e.tail<3>()).eval());
      d.col(4)           = -d.col(0).cross(f);
      return d;
    };
    State y;
    y << Vector3::Zero(), Matrix3::Identity(), m;
    const unsigned int n = 4000;
    const double       h = -rod.length / n;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double s  = rod.length + i * h;
        const State  k1 = derivative(s, y), k2 = derivative(s + h / 2, y + h / 2 * k1),
                    k3 = derivative(s + h / 2, y + h / 2 * k2), k4 = derivative(s + h, y + h * k3);
        y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
    const Matrix3 clamp = y.middleCols<3>(1);
    return {-clamp.transpose() * y.col(0), clamp.transpose()};
  }

  /** A cantilever from the origin along x there, with axis 2 along y; @p beam says what is particular. */
  std::string
  cantilever_with_tip_load(const std::string &section,
                           const std::string &beam,
                           const std::string &axes,
                           const Vector3     &f,
                           const Vector3     &m)
  {
    return "subsection Sections\n subsection s\n" + section + "\n end\nend\nsubsection Bodies\n subsection beam\n" +
           "set Type = beam\n set Section = s\n set Axis 2 = 0, 1, 0\n set Elements = 16\n set Degree = 4\n" + beam +
           "\n end\nend\nsubsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n" +
           "set Body B = beam.start\n end\nend\nsubsection Loads\n subsection p\n set Type = point load\n" +
           "set At = beam.end\n set Axes = " + axes + "\n set Force = " + text_of(f) + "\n set Moment = " + text_of(m) +
           "\n end\nend\n";
  }

  /** Distance of the end and its axes from the exact ones. */
  double
  error(const Scene &scene, const End &exact)
  {
    const State &state = scene.context.state;
    const Frame  end   = scene.system.model.frame("beam.end");
    return (end.position(state.q.data()) - exact.x).norm() + (end.triad(state.q.data()) - exact.D).norm();
  }

  /** The follower load, and from there the dead load that is the same in this place (which has other equilibria, too).
   */
  void
  expect_exact(const std::string &name,
               const Rod         &rod,
               const std::string &section,
               const std::string &beam,
               const Vector3     &f,
               const Vector3     &m)
  {
    const End exact = exact_end(rod, f, m);
    Scene     follower(cantilever_with_tip_load(section, beam, "body", f, m));
    follower.equilibrium();
    EXPECT_LT(error(follower, exact), 1e-9) << name << ", follower load";

    Scene dead(cantilever_with_tip_load(section, beam, "inertial", exact.D * f, exact.D * m));
    dead.context.state          = follower.context.state;
    dead.context.is_equilibrium = true;
    dead.equilibrium();
    EXPECT_LT(error(dead, exact), 1e-9) << name << ", dead load";
  }

  Vector3
  straight(double)
  {
    return Vector3::Zero();
  }

  const std::string full =
    "set Type = matrices\n set Stiffness = 90, 1, .5, .2, .3, .1, 70, .4, .3, .2, .6, 60, .1, .5, .2, 3, .2, .1, 2, .3, 4\n";

  Matrix6
  full_stiffness()
  {
    Matrix6 C;
    C << 90, 1, .5, .2, .3, .1, 1, 70, .4, .3, .2, .6, .5, .4, 60, .1, .5, .2, .2, .3, .1, 3, .2, .1, .3, .2, .5, .2, 2,
      .3, .1, .6, .2, .1, .3, 4;
    return C;
  }
} // namespace



TEST(EndLoads, PlanarFollowerForce)
{
  const Rod rod{1., Vector6(1e4, 5e3, 5e3, 1, 1, 1).asDiagonal(), straight};
  for (const double P : {1., 4., 8.})
    expect_exact("P = " + std::to_string(P),
                 rod,
                 "set Type = matrices\n set Stiffness = 1e4, 5e3, 5e3, 1, 1, 1",
                 "set Points = 0, 0, 0; 1, 0, 0",
                 {0, P, 0},
                 Vector3::Zero());
}



TEST(EndLoads, FullyCoupledSectionInSpace)
{
  const Rod rod{2., full_stiffness(), straight};
  expect_exact("coupled", rod, full, "set Points = 0, 0, 0; 2, 0, 0", {0.5, 0.8, -0.6}, {0.7, -0.4, 0.9});
}



TEST(EndLoads, CurvedAndTwistedBeam)
{
  const double      radius = 1.5, angle = 1.2, rate = 0.7;
  const Rod         rod{radius * angle, full_stiffness(), [=](const double s) {
                  return Vector3(rate, std::sin(rate * s) / radius, std::cos(rate * s) / radius);
                }};
  const auto        point = [=](const double a) { return text_of(radius * Vector3(std::sin(a), 1 - std::cos(a), 0)); };
  const std::string beam =
    "set Shape = arc\n set Twist = 0.7*s\n set Points = 0, 0, 0; " + point(angle / 2) + "; " + point(angle);
  // the exact triad of the end without load, which checks the signs of the initial curvatures
  const double  twist    = rate * radius * angle;
  const Matrix3 unloaded = rotation_of_vector({0, 0, angle}) * rotation_of_vector({twist, 0, 0});
  EXPECT_LT((exact_end(rod, Vector3::Zero(), Vector3::Zero()).D - unloaded).norm(), 1e-12);
  expect_exact("curved and twisted", rod, full, beam, {0.5, 0.8, -0.6}, {0.7, -0.4, 0.9});
}



// Stiffness from the definitions: strain energies of the tension centre (y₂, y₃), extension Γ₁ + y₃ K₂ − y₂ K₃, and of
// the shear centre, shears Γ₂ − y₃ K₁ and Γ₃ + y₂ K₁.
TEST(EndLoads, SectionWithOffsetCentres)
{
  const std::string section =
    "set Type = engineering constants\n set EA = 90\n set GA2 = 40\n set GA3 = 50\n set GJ = 2\n"
    " set EI2 = 3\n set EI3 = 4\n set EI23 = 0.7\n set Shear centre = 0.1, -0.15\n"
    " set Tension centre = -0.12, 0.2\n set Mass = 1\n";
  const Vector6 extension(1, 0, 0, 0, 0.2, 0.12), shear_2(0, 1, 0, 0.15, 0, 0), shear_3(0, 0, 1, 0.1, 0, 0);
  Matrix6       C = Vector6(0, 0, 0, 2, 3, 4).asDiagonal();
  C(4, 5) = C(5, 4) = 0.7;
  C += 90 * extension * extension.transpose() + 40 * shear_2 * shear_2.transpose() + 50 * shear_3 * shear_3.transpose();
  expect_exact("offset centres",
               {1.5, C, straight},
               section,
               "set Points = 0, 0, 0; 1.5, 0, 0",
               {0.5, 0.8, -0.6},
               {0.7, -0.4, 0.9});
}



TEST(EndLoads, ConvergeWithOrderTwiceTheDegree)
{
  const Vector3      f(0.5, 0.8, -0.6), m(0.7, -0.4, 0.9);
  const End          exact    = exact_end({2., full_stiffness(), straight}, f, m);
  const std::string  text     = cantilever_with_tip_load(full, "set Points = 0, 0, 0; 2, 0, 0", "body", f, m);
  const unsigned int coarse[] = {0, 24, 6, 4, 3};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      double e[2];
      for (unsigned int k = 0; k < 2; ++k)
        {
          Scene scene(text,
                      {"Bodies/beam/Degree = " + std::to_string(p),
                       "Bodies/beam/Elements = " + std::to_string(coarse[p] << k)});
          scene.equilibrium();
          e[k] = error(scene, exact);
        }
      EXPECT_NEAR(std::log2(e[0] / e[1]), 2. * p, 0.3) << "degree " << p;
    }
}
