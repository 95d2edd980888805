/*
 * Problem:   stiffness of laminates by warping of dimension 1
 * Reference: classical lamination (tests/reference/sections/laminate_ABD_*.csv, analytic); simply supported plates
 * under a sinusoidal load solved as 3D solids (tests/reference/sections/pagano_plates.csv, here for stresses across);
 * 5/6 of a homogeneous plate.
 */

#include <samara/base/dense.h>
#include <samara/section/elasticity.h>
#include <samara/section/laminate.h>

#include "../reference.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  Laminate
  laminate(const std::vector<double>      &degrees,
           const elasticity::Orthotropic  &material,
           const double                    total,
           const Laminate::TransverseShear rule = Laminate::TransverseShear::equilibrium)
  {
    std::vector<Lamina> plies;
    for (const double angle : degrees)
      plies.push_back({elasticity::stiffness(material), angle * M_PI / 180, total / degrees.size(), 1.});
    return Laminate(plies, rule);
  }



  /** A, B and D of a row of laminate_ABD_*.csv. */
  void
  compare_with_list(const Laminate &own, const std::map<std::string, std::string> &row)
  {
    // the file's order is 11 22 12
    const int         of[3]    = {0, 2, 1};
    const char *const block[3] = {"A", "B", "D"};
    const char *const name[3]  = {"1", "2", "6"};
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
          {
            const double value = own.ABD(of[i] + (b == 2 ? 3 : 0), of[j] + (b > 0 ? 3 : 0));
            const double size  = own.ABD(0, 0) * std::pow(own.thickness, b);
            EXPECT_NEAR(value, std::stod(row.at(std::string(block[b]) + name[i] + name[j])), 1e-9 * size)
              << row.at("layup_bottom_to_top") << " " << block[b] << name[i] << name[j];
          }
  }



  const elasticity::Orthotropic AS4 = {142e9, 9.8e9, 9.8e9, 6e9, 6e9, 4.8e9, 0.3, 0.3, 0.3};

  /** The material of Pagano's plates: E₁ = 25 E₂, G₁₂ = G₁₃ = E₂/2, G₂₃ = E₂/5, ν = 1/4. */
  const elasticity::Orthotropic pagano = {25, 1, 1, 0.5, 0.5, 0.2, 0.25, 0.25, 0.25};



  /** Mean deflection of a square, simply supported plate of side a under sin sin, by Navier's solution with shear. */
  double
  deflection(const Matrix6 &ABD, const Eigen::Matrix2d &G, const double a)
  {
    // unknowns U cos sin, V sin cos, W sin sin, and the rotations φ₁ cos sin, φ₂ sin cos; the energy is a quadratic
    // form
    const double                k = M_PI / a;
    Eigen::Matrix<double, 8, 5> B; // strains: ε₁₁ γ₁₂ ε₂₂ κ₁₁ 2κ₁₂ κ₂₂ γ₁₃ γ₂₃
    Eigen::Matrix<double, 8, 8> C = Eigen::Matrix<double, 8, 8>::Zero();
    B << -k, 0, 0, 0, 0, k, k, 0, 0, 0, 0, -k, 0, 0, 0, 0, 0, 0, -k, 0, 0, 0, 0, k, k, 0, 0, 0, 0, -k, 0, 0, k, 1, 0, 0,
      0, k, 0, 1;
    C.topLeftCorner<6, 6>()          = ABD;
    C.bottomRightCorner<2, 2>()      = G;
    Eigen::Matrix<double, 5, 1> load = Eigen::Matrix<double, 5, 1>::Zero();
    load(2)                          = 1;
    return Cholesky(B.transpose() * C * B).solve(load)(2);
  }
} // namespace



TEST(Laminate, IsClassicalLamination)
{
  unsigned int n = 0;
  for (const auto &row : reference_rows("sections/laminate_ABD_AS4.csv"))
    {
      const auto angles = layup_angles(row.at("layup_bottom_to_top"));
      compare_with_list(laminate(angles, AS4, angles.size() * 0.127e-3), row);
      ++n;
    }
  EXPECT_EQ(n, 12u);
  // of the shells of Sze, Liu & Lo, "Sze3.8 roof h=12.7 0/90/0"
  for (const auto &row : reference_rows("sections/laminate_ABD_sze.csv"))
    {
      const std::string            &name     = row.at("layup_bottom_to_top");
      const elasticity::Orthotropic cylinder = {2068.5, 517.125, 517.125, 795.6, 795.6, 198.894, 0.3, 0.3, 0.3},
                                    roof     = {3300, 1100, 1100, 660, 660, 440, 0.25, 0.25, 0.25};
      compare_with_list(laminate(layup_angles(name.substr(name.rfind(' ') + 1)),
                                 name.find("Sze3.7") == 0 ? cylinder : roof,
                                 std::stod(row.at("h"))),
                        row);
      ++n;
    }
  EXPECT_EQ(n, 18u);
}



TEST(Laminate, HomogeneousPlateHasFiveSixths)
{
  for (const unsigned int n : {1u, 4u})
    {
      const Laminate own = laminate(std::vector<double>(n, 0.), pagano, 0.2);
      EXPECT_NEAR(own.shear(0, 0) / (pagano.G13 * 0.2), 5. / 6, 1e-14);
      EXPECT_NEAR(own.shear(1, 1) / (pagano.G23 * 0.2), 5. / 6, 1e-14);
      EXPECT_NEAR(own.shear(0, 1), 0, 1e-15);
    }
}



TEST(Laminate, PlatesAgreeWithThreeDimensionalElasticity)
{
  unsigned int n = 0;
  for (const auto &row : reference_rows("sections/pagano_plates.csv"))
    {
      const std::string &layup = row.at("layup");
      if (layup.find("sandwich") != std::string::npos)
        continue;
      const Laminate own = laminate(layup_angles(layup), pagano, 1);
      EXPECT_NEAR(own.shear(0, 0), std::stod(row.at("G11_rule")), 2e-8) << layup;
      EXPECT_NEAR(own.shear(1, 1), std::stod(row.at("G22_rule")), 2e-8) << layup;
      const double a = std::stod(row.at("a_over_h"));
      const double w = 100 * deflection(own.ABD, own.shear, a) / std::pow(a, 4);
      EXPECT_NEAR(w / std::stod(row.at("w_mean")),
                  1,
                  a < 5  ? 0.11 :
                  a < 15 ? 0.017 :
                  a < 50 ? 4e-3 :
                           2e-4)
        << layup << " " << a;
      ++n;
    }
  EXPECT_EQ(n, 16u);
}



/**
 * Faces of a tenth of the thickness on a core whose shear stiffness is a hundredth of theirs: 0.5 % of the
 * deflection at a/h = 10.
 */
TEST(Laminate, SandwichAgreesWithThreeDimensionalElasticity)
{
  const auto face = elasticity::stiffness(pagano),
             core =
               elasticity::stiffness({0.04, 0.04, 0.5, 0.016, 0.06, 0.06, 0.25, 0.02 * 0.04 / 0.5, 0.02 * 0.04 / 0.5});
  const std::vector<Lamina> layers = {{face, 0, 0.1, 1.}, {core, 0, 0.8, 1.}, {face, 0, 0.1, 1.}};
  const Laminate            by_equilibrium(layers), asymptotic(layers, Laminate::TransverseShear::asymptotic);
  unsigned int              n = 0;
  for (const auto &row : reference_rows("sections/pagano_plates.csv"))
    if (row.at("layup") == "sandwich .1/.8/.1")
      {
        const double a = std::stod(row.at("a_over_h")), bound = a < 5 ? 0.03 : a < 15 ? 5e-3 : a < 50 ? 1.1e-3 : 1e-4;
        for (const Laminate &own : {by_equilibrium, asymptotic})
          EXPECT_NEAR(100 * deflection(own.ABD, own.shear, a) / std::pow(a, 4) / std::stod(row.at("w_mean")), 1, bound)
            << a;
        EXPECT_NEAR(by_equilibrium.shear(0, 0), std::stod(row.at("G11_rule")), 2e-8);
        EXPECT_NEAR(by_equilibrium.shear(1, 1), std::stod(row.at("G22_rule")), 2e-8);
        EXPECT_NEAR(asymptotic.shear(0, 0), std::stod(row.at("G11_vam")), 1e-4 * asymptotic.shear(0, 0));
        ++n;
      }
  EXPECT_EQ(n, 4u);
}



/** Nearer to the plates solved as solids than the rule of equilibrium; values of another program (numpy, dense). */
TEST(Laminate, AsymptoticShear)
{
  const auto asymptotic = Laminate::TransverseShear::asymptotic;
  for (const auto &row : reference_rows("sections/pagano_plates.csv"))
    {
      const std::string &layup = row.at("layup");
      if (layup.find("sandwich") != std::string::npos)
        continue;
      const double   a = std::stod(row.at("a_over_h")), exact = std::stod(row.at("w_mean")) * std::pow(a, 4) / 100;
      const Laminate own   = laminate(layup_angles(layup), pagano, 1, asymptotic),
                     other = laminate(layup_angles(layup), pagano, 1);
      if (a < 50)
        {
          EXPECT_LT(deflection(own.ABD, own.shear, a) - exact, 0.99 * (deflection(other.ABD, other.shear, a) - exact))
            << layup << " " << a;
        }
      EXPECT_GT(deflection(own.ABD, own.shear, a), exact);
    }
  const Eigen::Matrix2d G = laminate({0, 90, 0}, pagano, 1, asymptotic).shear;
  EXPECT_NEAR(G(0, 0) / 0.4, 0.583221, 2e-6);
  EXPECT_NEAR(G(1, 1) / 0.3, 0.848599, 2e-6);
  EXPECT_NEAR(G(0, 1), 0, 1e-12);
  // turned by 90 degrees, thickness and moduli in other units
  elasticity::Orthotropic m = pagano;
  for (double *const modulus : {&m.E1, &m.E2, &m.E3, &m.G12, &m.G13, &m.G23})
    *modulus *= 1e9;
  const Eigen::Matrix2d turned = laminate({90, 0, 90}, m, 1e-3, asymptotic).shear;
  EXPECT_NEAR(turned(1, 1) / (G(0, 0) * 1e6), 1, 1e-8);
  EXPECT_NEAR(turned(0, 0) / (G(1, 1) * 1e6), 1, 1e-8);
}



/** Stresses are in balance: their resultants are the forces, and shear vanishes on both faces. */
TEST(Laminate, StressesHaveTheForcesAsResultants)
{
  const Laminate        own = laminate(layup_angles("[0/±45/90_2]"), AS4, 1e-3);
  const Eigen::Vector2d Q(120, -70);
  Vector6               strains;
  strains << 1e-4, -2e-4, 3e-4, 0.5, -0.7, 0.2;
  const Vector6   forces = own.ABD * strains;
  Vector6         sum    = Vector6::Zero();
  Eigen::Vector2d shear  = Eigen::Vector2d::Zero();
  for (unsigned int i = 0; i < 5; ++i)
    {
      const auto [bottom, top] = own.heights(i);
      const double middle = (bottom + top) / 2, half = (top - bottom) / 2;
      for (const double x : {-std::sqrt(0.6), 0., std::sqrt(0.6)})
        {
          const double  z = middle + half * x, w = half * (x == 0 ? 8. / 9 : 5. / 9);
          const Vector6 s = own.stress(i, z, strains, Q);
          const Vector3 plane(s(0), s(5), s(1));
          sum.head<3>() += w * plane;
          sum.tail<3>() += w * z * plane;
          shear += w * Eigen::Vector2d(s(4), s(3));
        }
    }
  EXPECT_LT((sum - forces).norm(), 1e-12 * forces.norm());
  EXPECT_LT((own.stress(0, own.heights(0)[0], strains, Q)).segment<2>(3).norm(), 1e-9);
  EXPECT_LT((own.stress(4, own.heights(4)[1], strains, Q)).segment<2>(3).norm(), 1e-6);
  // moments that grow along 1 and 2 by Q give the force Q only where no other forces change; here to the rule's own sum
  EXPECT_GT(shear(0), 0);
  EXPECT_LT(shear(1), 0);
}



TEST(Laminate, SymmetricLaminateCarriesItsShearForce)
{
  const Laminate        own = laminate(layup_angles("[0/90]s"), AS4, 1e-3);
  const Eigen::Vector2d Q(120, -70);
  Eigen::Vector2d       sum = Eigen::Vector2d::Zero();
  for (unsigned int i = 0; i < 4; ++i)
    for (const double x : {-std::sqrt(0.6), 0., std::sqrt(0.6)})
      {
        const auto [bottom, top] = own.heights(i);
        const double  half       = (top - bottom) / 2;
        const Vector6 s          = own.stress(i, (bottom + top) / 2 + half * x, Vector6::Zero(), Q);
        sum += half * (x == 0 ? 8. / 9 : 5. / 9) * Eigen::Vector2d(s(4), s(3));
      }
  EXPECT_LT((sum - Q).norm(), 1e-12 * Q.norm());
}



namespace
{
  /**
   * Cylindrical bending of plies along or across (0, 1) under the pressure sin(πx/a) on the top, in plane strain, as a
   * solid (Pagano, J. Composite Materials 3, 1969): displacements U cos and W sin, stresses S sin = σ₃₃ and T cos = σ₁₃
   * obey y' = A y in each ply. The thickness is one.
   */
  class CylindricalBending
  {
  public:
    CylindricalBending(const std::vector<double> &degrees, const double a)
      : h(1. / degrees.size())
    {
      const double    k     = M_PI / a;
      Eigen::Matrix4d whole = Eigen::Matrix4d::Identity();
      for (const double angle : degrees)
        {
          const Matrix6 C   = elasticity::stiffness(pagano);
          const double  C11 = angle == 0 ? C(0, 0) : C(1, 1), C13 = angle == 0 ? C(0, 2) : C(1, 2), C33 = C(2, 2),
                       C55 = angle == 0 ? C(4, 4) : C(3, 3);
          Eigen::Matrix4d A;
          A << 0, -k, 0, 1 / C55,         //
            k * C13 / C33, 0, 1 / C33, 0, //
            0, 0, 0, k,                   //
            k * k * (C11 - C13 * C13 / C33), 0, -k * C13 / C33, 0;
          plies.push_back(A);
          whole = exponential(A * h) * whole;
        }
      at_bottom.setZero();
      at_bottom.head<2>() = whole.bottomLeftCorner<2, 2>().inverse() * Eigen::Vector2d(-1, 0);
    }

    /** σ₃₃ over the sine at the height @p z above the bottom of a ply. */
    double
    stress(const unsigned int ply, const double z) const
    {
      Eigen::Vector4d y = at_bottom;
      for (unsigned int i = 0; i < ply; ++i)
        y = exponential(plies[i] * h) * y;
      return (exponential(plies[ply] * z) * y)(2);
    }

  private:
    double                       h;
    std::vector<Eigen::Matrix4d> plies;
    Eigen::Vector4d              at_bottom;

    static Eigen::Matrix4d
    exponential(const Eigen::Matrix4d &A)
    {
      Eigen::Matrix4d sum = Eigen::Matrix4d::Identity(), term = sum;
      for (unsigned int n = 1; n < 40; ++n)
        {
          term = (term * A / n).eval();
          sum += term;
        }
      return sum;
    }
  };

  /** The largest difference of σ₃₃ to that, by equilibrium: M₁₁,₁₁ = Q₁,₁ = sin, N = 0. */
  double
  difference_across(const std::vector<double> &degrees, const double a)
  {
    const Laminate           own = laminate(degrees, pagano, 1.);
    const CylindricalBending exact(degrees, a);
    Eigen::Matrix2d          in_plane;
    in_plane << own.ABD(0, 0), own.ABD(0, 3), own.ABD(3, 0), own.ABD(3, 3);
    const Eigen::Vector2d e = in_plane.inverse() * Eigen::Vector2d(0, -a * a / (M_PI * M_PI));
    Vector6               strains;
    strains << e(0), 0, 0, e(1), 0, 0;
    Laminate::Across across;
    across.shear_gradient(0, 0) = 1;
    across.top                  = 1;
    double largest              = 0;
    for (unsigned int ply = 0; ply < degrees.size(); ++ply)
      for (const double part : {0., 0.2, 0.4, 0.6, 0.8, 1.})
        {
          const auto [bottom, top] = own.heights(ply);
          const double z           = part * (top - bottom);
          largest =
            std::max(largest, std::abs(own.stress_across(ply, bottom + z, strains, across) - exact.stress(ply, z)));
        }
    return largest;
  }
} // namespace



// Across the plies the stress by equilibrium is that of the solid: of second order in thickness over length where the
// plate is homogeneous.
TEST(Laminate, StressAcrossAgreesWithThreeDimensionalElasticity)
{
  double last = 0;
  for (const double a : {5., 10., 20., 40.})
    {
      const double now = difference_across({0}, a);
      if (last > 0)
        EXPECT_GT(last / now, 3.5) << a;
      last = now;
    }
  EXPECT_LT(difference_across({0}, 10), 5e-3);
  for (const std::vector<double> &degrees : {std::vector<double>{0, 90, 0}, {0, 90}, {0, 90, 90, 0}})
    {
      EXPECT_LT(difference_across(degrees, 10), 0.015);
      EXPECT_LT(difference_across(degrees, 20), 0.004);
    }
}



// It begins with the pressure at the bottom, ends with that at the top, and grows in between as the other stresses say.
TEST(Laminate, StressAcrossIsInBalance)
{
  std::vector<Lamina> plies;
  for (const double angle : {0., 45., -45., 90., 90.})
    plies.push_back({elasticity::stiffness(AS4), angle * M_PI / 180, 2e-4, plies.empty() ? 3000. : 1500.});
  const Laminate own(plies);
  Vector6        strains;
  strains << 1e-4, -2e-4, 3e-4, 0.5, -0.7, 0.2;
  Laminate::Across across;
  across.shear_gradient << 1e5, -3e5, 2e5, 4e5;
  across.curvature << 0.5, -0.3, 0.8;
  across.bottom   = 2e5;
  across.top      = 5e4;
  across.inertia  = 3e5;
  const Vector3 N = (own.ABD * strains).head<3>();
  across.balance(N);
  const double size = 1e6;
  EXPECT_NEAR(own.stress_across(0, own.heights(0)[0], strains, across), -across.bottom, 1e-12 * size);
  EXPECT_NEAR(own.stress_across(4, own.heights(4)[1], strains, across), -across.top, 1e-9 * size);
  for (unsigned int i = 0; i < 5; ++i)
    {
      const auto [bottom, top] = own.heights(i);
      if (i > 0)
        EXPECT_NEAR(own.stress_across(i, bottom, strains, across),
                    own.stress_across(i - 1, bottom, strains, across),
                    1e-9 * size);
      // at the Gauss points of the parabola whose integral is the growth
      double growth = 0;
      for (const double x : {-std::sqrt(1. / 3), std::sqrt(1. / 3)})
        {
          const double  z   = (bottom + top) / 2 + x * (top - bottom) / 2;
          const Vector6 s   = own.stress(i, z, strains, Eigen::Vector2d::Zero()),
                        f_1 = own.stress(i, z, Vector6::Zero(), {1, 0}),
                        f_2 = own.stress(i, z, Vector6::Zero(), {0, 1});
          const auto &G     = across.shear_gradient;
          growth += (top - bottom) / 2 *
                    (Vector3(s(0), s(5), s(1)).dot(across.curvature) -
                     (f_1(4) * G(0, 0) + f_1(3) * G(1, 0) + f_2(4) * G(0, 1) + f_2(3) * G(1, 1)) +
                     plies[i].density / own.mass * across.inertia);
        }
      EXPECT_NEAR(own.stress_across(i, top, strains, across) - own.stress_across(i, bottom, strains, across),
                  growth,
                  1e-9 * size)
        << i;
    }
}



TEST(Laminate, ShorthandOfLayups)
{
  using Angles = std::vector<double>;
  EXPECT_EQ(layup_angles("0"), Angles({0}));
  EXPECT_EQ(layup_angles("0/90"), Angles({0, 90}));
  EXPECT_EQ(layup_angles("[0/45/-45/90]s"), Angles({0, 45, -45, 90, 90, -45, 45, 0}));
  EXPECT_EQ(layup_angles("[0/±45_2]"), Angles({0, 45, -45, 45, -45}));
  EXPECT_EQ(layup_angles("[0_3 / +-30]_2"), Angles({0, 0, 0, 30, -30, 0, 0, 0, 30, -30}));
  EXPECT_EQ(layup_angles("[0/90~]s"), Angles({0, 90, 0}));
  EXPECT_EQ(layup_angles("[45/[0/90]s/-45]"), Angles({45, 0, 90, 90, 0, -45}));
  EXPECT_EQ(layup_angles("[22.5/-67.5]_2s"), Angles({22.5, -67.5, 22.5, -67.5, -67.5, 22.5, -67.5, 22.5}));
  for (const std::string wrong :
       {"", "[0/90", "0/90]", "0//90", "0/x", "0_0", "0_2000", "[0/90~]", "[0~/90]s", "900", "nan"})
    EXPECT_THROW(layup_angles(wrong), std::invalid_argument) << wrong;
}



TEST(Laminate, RefusesWhatIsNone)
{
  EXPECT_THROW(Laminate({}), std::invalid_argument);
  EXPECT_THROW(laminate({0}, AS4, 0.), std::invalid_argument);
  EXPECT_THROW(Laminate({{Matrix6::Zero(), 0, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(elasticity::stiffness({142e9, 9.8e9, 9.8e9, 6e9, 6e9, 4.8e9, 4., 4., 0.3}), std::invalid_argument);
}
