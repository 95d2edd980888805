/*
 * Problem:   boxes of random walls: what a stiffness must be whatever the section is
 * Reference: theory. The energy does not change when the section is turned, moved or mirrored with its fibres, nor when
 * plies are written otherwise; finer spaces make it softer; inertia is that of nested rectangles; a thin tube of
 * helical plies couples tension and torsion as its membrane does.
 */

#include <samara/cosserat/section_kinds.h>

#include <samara/base/dense.h>
#include <samara/rotation/matrix6.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stiffness.h"

using namespace samara;

namespace
{
  const std::string two_composites = R"(
subsection Materials
  subsection carbon
    set Type    = orthotropic
    set E1      = 135e9
    set E2      = 9e9
    set G12     = 5e9
    set nu12    = 0.3
    set nu23    = 0.4
    set Density = 1580
  end
  subsection glass
    set Type    = orthotropic
    set E1      = 42e9
    set E2      = 12e9
    set G12     = 4.5e9
    set nu12    = 0.28
    set nu23    = 0.4
    set Density = 1950
  end
end
)";

  struct RandomPly
  {
    std::string material;
    int         angle; ///< [deg]
    double      thickness;
  };
  using RandomWall = std::vector<RandomPly>;

  /** Four walls of two plies each, bottom, right, top, left. */
  std::array<RandomWall, 4>
  random_walls(const unsigned int seed)
  {
    std::mt19937                       generator(seed);
    std::uniform_int_distribution<int> angle(-89, 90), tenths(4, 20), material(0, 1);
    std::array<RandomWall, 4>          walls;
    for (auto &wall : walls)
      for (unsigned int i = 0; i < 2; ++i)
        wall.push_back({material(generator) == 0 ? "carbon" : "glass", angle(generator), tenths(generator) * 1e-4});
    return walls;
  }

  std::string
  text_of_wall(const RandomWall &wall)
  {
    std::string text;
    for (const auto &ply : wall)
      text += (text.empty() ? "" : "; ") + ply.material + ", " + std::to_string(ply.angle) + ", " +
              number_to_text(ply.thickness);
    return text;
  }

  std::string
  box_of(const std::array<RandomWall, 4> &walls, const std::string &entries)
  {
    const std::array<std::string, 4> names = {{"bottom", "right", "top", "left"}};
    std::string                      layups, section;
    for (unsigned int i = 0; i < 4; ++i)
      {
        layups += "  subsection " + names[i] + "\n    set Plies = " + text_of_wall(walls[i]) + "\n  end\n";
        section += "    set Layup of " + names[i] + " = " + names[i] + "\n";
      }
    return two_composites + "subsection Layups\n" + layups +
           "end\nsubsection Sections\n  subsection s\n    set Type = box\n    set Layup = bottom\n" + section +
           entries +
           "  end\nend\n"
           "subsection Bodies\n  subsection b\n    set Type = rigid body\n    set Mass = 1\n"
           "    set Inertia = 1, 1, 1\n  end\nend\n";
  }

  SectionValues
  values_of_box(const std::array<RandomWall, 4> &walls,
                const std::string               &entries,
                const Vector3                   &curvature = Vector3::Zero())
  {
    const Scene scene(box_of(walls, entries));
    return scene.input.model.find<Section>("s", "section").at(0, curvature);
  }

  const std::string size   = "    set Width 2 = 0.12\n    set Width 3 = 0.07\n",
                    coarse = "    set Elements = 4\n    set Degree = 2\n";

  /** Strains (Γ, K) at a section that lies at @p place, turned by @p angle about axis 1, from those of the line. */
  Matrix6
  moved_strains(const Vector3 &place, const double angle)
  {
    const Matrix3 D = Eigen::AngleAxisd(angle, Vector3::UnitX()).toRotationMatrix();
    Matrix6       T = Matrix6::Zero();
    T << D.transpose(), -D.transpose() * skew(place), Matrix3::Zero(), D.transpose();
    return T;
  }
} // namespace



TEST(Symmetries, StiffnessIsSymmetricAndPositive)
{
  for (const unsigned int seed : {1, 2, 3})
    {
      const Matrix6 K = values_of_box(random_walls(seed), size + coarse, Vector3(0.3, -0.5, 0.8)).stiffness;
      EXPECT_LT(difference(K, K.transpose()), 1e-12);
      const Vector6 scale = K.diagonal().cwiseSqrt().cwiseInverse();
      EXPECT_GT(cholesky_upper(scale.asDiagonal() * K * scale.asDiagonal()).diagonal().minCoeff(), 0.01);
    }
}



// Turned, with twist and curvature, which turn against it; and moved along both axes.
TEST(Symmetries, TurnedAndMoved)
{
  const auto    walls = random_walls(4);
  const Vector3 k(0.4, 0.7, -0.3);
  const double  angle = 35 * M_PI / 180;
  const Matrix6 turn  = moved_strains(Vector3::Zero(), angle);
  const Matrix6 own   = values_of_box(walls, size + coarse, turn.topLeftCorner<3, 3>() * k).stiffness;
  EXPECT_LT(difference(values_of_box(walls, size + coarse + "    set Rotation = 35 deg\n", k).stiffness,
                       turn.transpose() * own * turn),
            1e-7);

  const auto    plain = values_of_box(walls, size + coarse);
  const Matrix6 move  = moved_strains(Vector3(0, 0.05, -0.02), angle);
  const auto    moved =
    values_of_box(walls, size + coarse + "    set Rotation = 35 deg\n    set Position = 0.05, -0.02\n");
  EXPECT_LT(difference(moved.stiffness, move.transpose() * plain.stiffness * move), 1e-7);
  EXPECT_LT(difference(moved.inertia, move.transpose() * plain.inertia * move), 1e-12);
}



namespace
{
  /** A C that is open and thin, of 71 by 29 mm, with walls of two plies. */
  SectionValues
  values_of_thin_C(const std::string &ply, const std::string &entries)
  {
    const Scene scene(two_composites + "subsection Layups\n  subsection wall\n    set Plies = carbon, 35, " + ply +
                      "; glass, -20, " + ply +
                      "\n  end\nend\nsubsection Sections\n  subsection s\n    set Type = C\n    set Height = 71 mm\n"
                      "    set Width = 29 mm\n    set Upper layup = wall\n    set Lower layup = wall\n"
                      "    set Web layup = wall\n    set Elements = 5\n    set Degree = 2\n" +
                      entries +
                      "  end\nend\nsubsection Bodies\n  subsection b\n    set Type = rigid body\n    set Mass = 1\n"
                      "    set Inertia = 1, 1, 1\n  end\nend\n");
    return scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero());
  }
} // namespace



// An open section is soft in torsion, and the farther the line is the more of its motion in shear is torsion: none of
// its digits may be lost.
TEST(Symmetries, ThinOpenSectionsFarFromTheLine)
{
  const double  angle = 65 * M_PI / 180;
  const Matrix6 own   = values_of_thin_C("0.28 mm", "").stiffness;
  for (const double distance : {0.07, 7., 700.})
    {
      const Vector3     place(0, 0.8 * distance, -0.6 * distance);
      const Matrix6     move = moved_strains(place, angle);
      const std::string text = "    set Rotation = 65 deg\n    set Position = " + number_to_text(place(1)) + ", " +
                               number_to_text(place(2)) + "\n";
      EXPECT_LT(difference(values_of_thin_C("0.28 mm", text).stiffness, move.transpose() * own * move), 1e-6)
        << distance;
    }
}



// The lines of one curved beam: that at the distance c from the first has 1 − k₃ c₂ + k₂ c₃ of its length, and its own
// curvature and strains by length.
TEST(Symmetries, AnotherLineOfACurvedBeam)
{
  const auto    walls = random_walls(8);
  const Vector3 k(0, 1.1, -0.7), c(0, 0.4, -0.25);
  const double  length = 1 - k(2) * c(1) + k(1) * c(2);
  const Matrix6 own = values_of_box(walls, size + coarse, k / length).stiffness, move = moved_strains(c, 0);
  EXPECT_LT(difference(values_of_box(walls, size + coarse + "    set Position = 0.4, -0.25\n", k).stiffness,
                       move.transpose() * own * move / length),
            1e-7);
}



// In a mirror the right wall is the left one, and a fibre at +θ, seen along the wall, is one at −θ.
TEST(Symmetries, Mirrored)
{
  auto          walls = random_walls(5);
  const Matrix6 K     = values_of_box(walls, size + coarse, Vector3(0.4, 0.7, -0.3)).stiffness;
  std::swap(walls[1], walls[3]);
  for (auto &wall : walls)
    for (auto &ply : wall)
      ply.angle = -ply.angle;
  Vector6 sign;
  sign << 1, -1, 1, -1, 1, -1;
  const Matrix6 mirrored = values_of_box(walls, size + coarse, Vector3(-0.4, 0.7, 0.3)).stiffness;
  EXPECT_LT(difference(mirrored, sign.asDiagonal() * K * sign.asDiagonal()), 1e-7);
  EXPECT_GT(std::abs(K(0, 3)), 0.01 * std::sqrt(K(0, 0) * K(3, 3))) << "there is something to change its sign";
}



// A ply of 2 t, and two of t.
TEST(Symmetries, PliesWrittenOtherwise)
{
  auto walls = random_walls(6); // all alike: where they differ cells are cut at the faces of all, in other ways
  walls.fill(walls[0]);
  auto halved = walls;
  for (auto &wall : halved)
    {
      RandomWall twice;
      for (auto ply : wall)
        {
          ply.thickness /= 2;
          twice.insert(twice.end(), 2, ply);
        }
      wall = twice;
    }
  const Vector3 k(0.4, 0.7, -0.3);
  const auto    one = values_of_box(walls, size + coarse + "    set Elements per ply = 2\n", k),
             two    = values_of_box(halved, size + coarse, k);
  EXPECT_LT(difference(two.stiffness, one.stiffness), 1e-8);
  EXPECT_LT(difference(two.inertia, one.inertia), 1e-12);
}



// Warping found in a larger space leaves less energy at given tension, torsion and bending: with forces along F₁, M₁,
// M₂, M₃, which do not change along the beam, compliances grow, as quadratic forms.
TEST(Symmetries, FinerSectionsAreSofter)
{
  const auto                               walls = random_walls(7);
  const std::array<int, 4>                 rows  = {{0, 3, 4, 5}};
  std::vector<Eigen::Matrix<double, 4, 4>> compliances;
  for (const unsigned int degree : {1, 2, 3, 4})
    {
      const Matrix6 F = inverse6(
        values_of_box(walls, size + "    set Elements = 4\n    set Degree = " + std::to_string(degree) + "\n").stiffness);
      Eigen::Matrix4d C;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          C(i, j) = F(rows[i], rows[j]);
      compliances.push_back(C);
    }
  const Eigen::Vector4d scale  = compliances.back().diagonal().cwiseSqrt().cwiseInverse();
  double                before = 1e300;
  for (unsigned int i = 1; i < compliances.size(); ++i)
    {
      const Eigen::Matrix4d change = scale.asDiagonal() * (compliances[i] - compliances[i - 1]) * scale.asDiagonal();
      const Eigen::Vector4d values = symmetric_eigenvalues(Eigen::MatrixXd(change));
      EXPECT_GT(values.minCoeff(), -1e-10) << "degree " << i + 1;
      EXPECT_LT(values.maxCoeff(), before / 2) << "degree " << i + 1;
      before = values.maxCoeff();
    }
}



// With one layup all round plies are nested frames; mass, first and second moments of rectangles.
TEST(Symmetries, InertiaOfNestedFrames)
{
  std::array<RandomWall, 4> walls;
  walls.fill({{"carbon", 20, 2e-3}, {"glass", -45, 1e-3}, {"carbon", 0, 0.5e-3}});
  const Matrix6 M = values_of_box(walls, size + coarse + "    set Position = 0.03, 0.01\n", Vector3(0.4, 0, 0)).inertia;
  double        mass = 0, about_2 = 0, about_3 = 0, depth = 0;
  for (const auto &ply : walls[0])
    {
      const double density = ply.material == "carbon" ? 1580 : 1950;
      for (const double sign : {1., -1.})
        {
          const double d = depth + (sign > 0 ? 0 : ply.thickness), b = 0.12 - 2 * d, h = 0.07 - 2 * d;
          mass += sign * density * b * h;
          about_2 += sign * density * b * h * h * h / 12;
          about_3 += sign * density * h * b * b * b / 12;
        }
      depth += ply.thickness;
    }
  EXPECT_NEAR(M(0, 0) / mass, 1, 1e-12);
  EXPECT_NEAR(M(4, 4) / (about_2 + mass * 1e-4), 1, 1e-12);
  EXPECT_NEAR(M(5, 5) / (about_3 + mass * 9e-4), 1, 1e-12);
  EXPECT_NEAR(M(3, 3) / (M(4, 4) + M(5, 5)), 1, 1e-12);
  EXPECT_NEAR(M(4, 5) / (-mass * 3e-4), 1, 1e-12);
}



// Fibres that climb to the right as one goes round from axis 2 to axis 3: pulled, they unwind. Membrane of a thin tube
// whose hoop stress vanishes: A = Q − Q(:, 2) Q(2, :)/Q22 for (ε₁, γ₁t), EA = 2π r t A₁₁, coupling 2π r² t A₁₆, GJ = 2π
// r³ t A₆₆.
TEST(Symmetries, SignOfHelicalFibres)
{
  const double  radius = 0.1, t = 1e-3;
  const Scene   scene(two_composites +
                    "subsection Layups\n  subsection helix\n    set Plies = carbon, 25, 1 mm\n  end\nend\n"
                      "subsection Sections\n  subsection s\n    set Type = tube\n    set Outer radius = 100.5 mm\n"
                      "    set Layup = helix\n  end\nend\nsubsection Bodies\n  subsection b\n    set Type = rigid body\n"
                      "    set Mass = 1\n    set Inertia = 1, 1, 1\n  end\nend\n");
  const Matrix6 K  = scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero()).stiffness;
  const double  E1 = 135e9, E2 = 9e9, G = 5e9, nu = 0.3, c = std::cos(25 * M_PI / 180), s = std::sin(25 * M_PI / 180),
               w = 1 / (1 - nu * nu * E2 / E1), q1 = E1 * w, q2 = E2 * w, q12 = nu * E2 * w;
  Matrix3 own, to_ply;
  own << q1, q12, 0, q12, q2, 0, 0, 0, G;
  to_ply << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s; // of ε₁ εₜ γ₁ₜ
  const Matrix3 Q = to_ply.transpose() * own * to_ply;
  const auto    A = [&](const int i, const int j) { return Q(i, j) - Q(i, 1) * Q(1, j) / Q(1, 1); };
  EXPECT_NEAR(K(0, 0) / (2 * M_PI * radius * t * A(0, 0)), 1, 1e-3);
  EXPECT_NEAR(K(0, 3) / (2 * M_PI * radius * radius * t * A(0, 2)), 1, 3e-3);
  EXPECT_NEAR(K(3, 3) / (2 * M_PI * std::pow(radius, 3) * t * A(2, 2)), 1, 3e-3);
  EXPECT_GT(K(0, 3), 0);
}
