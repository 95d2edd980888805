// Rough drawings are assembled: places against plane geometry, the nearest of all places, what stays as it is.

#include <gtest/gtest.h>

#include "drawings.h"

using namespace samara;
using namespace drawings;

namespace
{
  using Vector2 = Eigen::Vector2d;

  /** Where two circles meet, to the left of the line from the first centre to the second. */
  Vector2
  intersection(const Vector2 &a, const double r_a, const Vector2 &b, const double r_b)
  {
    const double  d = (b - a).norm(), x = (d * d + r_a * r_a - r_b * r_b) / (2 * d), y = std::sqrt(r_a * r_a - x * x);
    const Vector2 e = (b - a) / d;
    return a + x * e + y * Vector2(-e(1), e(0));
  }

  Vector2
  place(const Scene &scene, const std::string &point)
  {
    return {scene.value(point + ".position x"), scene.value(point + ".position y")};
  }

  /** Largest gap of any constraint in the reference state of a scene [m or 1]. */
  double
  largest_gap(const Scene &scene)
  {
    std::vector<double> r(scene.system.size() + 6, 0.);
    scene.system.add_gaps(scene.system.reference().point(), r.data());
    double largest = 0;
    for (unsigned int i = 0; i < scene.system.layout.n_multipliers; ++i)
      largest = std::max(largest, std::abs(r[scene.system.layout.of_multiplier(i)]));
    return largest;
  }

  /** What a run would write of a model, and a run of that would assemble again. */
  void
  expect_used_model_fits(const Scene &scene)
  {
    std::ostringstream used;
    scene.input.print(used);
    const Scene again(used.str());
    ASSERT_TRUE(again.input.assembled != nullptr);
    EXPECT_LT(again.input.assembled->distance, 1e-12);
    const State a = scene.system.reference(), b = again.system.reference();
    ASSERT_EQ(a.q.size(), b.q.size());
    for (unsigned int i = 0; i < a.q.size(); ++i)
      EXPECT_NEAR(a.q[i], b.q[i], 1e-11);
  }
} // namespace



TEST(Drawings, FourBarAgainstPlaneGeometry)
{
  // elbow up and elbow down: the branch is that of the drawing
  for (const double side : {1., -1.})
    {
      const Scene scene(four_bar(Bars(), 0.5 * side, "set Fixed bodies = crank"));
      ASSERT_TRUE(scene.input.assembled && scene.input.assembled->has_moved());
      const Vector2 a(0.3, 0.4), d(1.15, 0);
      // seen from the crank's end to the rocker's foot, the left is above
      const Vector2 expected = side > 0 ? intersection(a, 1., d, 0.7) : intersection(d, 0.7, a, 1.);
      EXPECT_LT((place(scene, "coupler.end") - expected).norm(), 1e-11) << side;
      EXPECT_LT((place(scene, "rocker.end") - expected).norm(), 1e-11);
      EXPECT_LT((place(scene, "crank.end") - a).norm(), 1e-15);
      EXPECT_LT((place(scene, "rocker.foot") - d).norm(), 1e-11);
      EXPECT_NEAR(scene.value("coupler.end.position z"), 0, 1e-12);
      EXPECT_LT(largest_gap(scene), 1e-13);
      expect_used_model_fits(scene);
    }
}



// With the crank free there is a family of places; the nearest is found by trying all of them.
TEST(Drawings, NearestOfAllPlaces)
{
  const Bars bars;
  for (const double weight : {1., 20.})
    {
      const Scene   scene(four_bar(bars, 0.5, "set Weights = rocker: " + std::to_string(weight)));
      const double  found = scene.input.assembled->distance;
      double        least = 1e9;
      const Vector2 d(1.15, 0);
      // squares of displacements of the middles and angles of a bar from its drawing; held at its ends, with its centre
      const auto square =
        [](const Vector2 &p, const Vector2 &q, const Vector2 &p_0, const Vector2 &q_0, const double z) {
          const Vector2 e = q - p, e_0 = q_0 - p_0;
          const double  angle  = std::atan2(e_0(0) * e(1) - e_0(1) * e(0), e_0.dot(e));
          const double  length = std::sqrt(2 * 0.25 * e.squaredNorm() / 3);
          return (0.5 * (p + q - p_0 - q_0)).squaredNorm() + z * z + std::pow(length * angle, 2);
        };
      for (double angle = 0.6; angle < 1.2; angle += 1e-5)
        {
          const Vector2 a = 0.5 * Vector2(std::cos(angle), std::sin(angle)), c = intersection(a, 1., d, 0.7);
          const double  all = square({0, 0}, a, {0, 0}, {0.3, 0.4}, 0) +
                             square(a, c, bars.start(), bars.end(0.5), bars.off_plane) +
                             weight * square(d, c, {1.2, 0}, {1.2, 0.7}, 0);
          least = std::min(least, std::sqrt(all));
        }
      EXPECT_NEAR(found, least, 1e-9) << weight;
      EXPECT_LT(largest_gap(scene), 1e-13);
    }
}



// Turned and moved as a whole, and in another order of bodies, the same has to come out.
TEST(Drawings, TurnedAndMovedAsAWhole)
{
  const Scene straight(four_bar(Bars(), 0.5, "")), turned(in_subsystem(four_bar(Bars(), 0.5, "")));
  EXPECT_NEAR(straight.input.assembled->distance, turned.input.assembled->distance, 1e-9);
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3::UnitZ()).toRotationMatrix() *
                    Eigen::AngleAxisd(0.3, Vector3::UnitY()).toRotationMatrix() *
                    Eigen::AngleAxisd(-0.4, Vector3::UnitX()).toRotationMatrix();
  for (const std::string point : {"coupler.start", "coupler.end", "rocker.end", "crank.end"})
    {
      Vector3 x, X;
      for (int i = 0; i < 3; ++i)
        {
          const std::string axis = std::string(".position ") + "xyz"[i];
          x(i)                   = straight.value(point + axis);
          X(i)                   = turned.value("part:" + point + axis);
        }
      EXPECT_LT((R * x + Vector3(3, -2, 1) - X).norm(), 1e-8) << point;
    }
  EXPECT_LT(largest_gap(turned), 1e-12);
}



// What fits is not touched by so much as a bit.
TEST(Drawings, WhatFitsStays)
{
  Bars fitting;
  fitting.fits = true;
  const Scene assembled(four_bar(fitting, 0.5, "set Gaps = closed")),
    plain(four_bar(fitting, 0.5, ""), {"Assembly/Gaps = refused"});
  ASSERT_TRUE(assembled.input.assembled != nullptr);
  EXPECT_FALSE(assembled.input.assembled->has_moved());
  const State a = assembled.system.reference(), b = plain.system.reference();
  EXPECT_EQ(a.q, b.q);
}



// A body that must not move does not, however the others have to; one that matters much moves little.
TEST(Drawings, WeightsAndFixedBodies)
{
  const auto moved = [](const Scene &scene, const std::string &body) {
    for (const auto &b : scene.input.assembled->bodies)
      if (b.name == body)
        return b.distance;
    return -1.;
  };
  const Scene plain(four_bar(Bars(), 0.5, "")), heavy(four_bar(Bars(), 0.5, "set Weights = crank: 1e6")),
    fixed(four_bar(Bars(), 0.5, "set Fixed bodies = crank"));
  EXPECT_GT(moved(plain, "crank"), 1e-3);
  EXPECT_LT(moved(heavy, "crank"), 1e-6);
  EXPECT_EQ(moved(fixed, "crank"), 0);
  EXPECT_NEAR(fixed.input.assembled->distance, heavy.input.assembled->distance, 1e-5);
}



// Beams move as rigid bodies: assembled they are free of strain, and have the modes of a drawing that fits.
TEST(Drawings, BeamsAreNotStrained)
{
  Scene rough(portal(true)), fine(portal(false));
  ASSERT_TRUE(rough.input.assembled && rough.input.assembled->has_moved());
  std::vector<double> e(rough.system.layout.n_strains);
  rough.system.strains(rough.system.reference(), e);
  for (const double strain : e)
    EXPECT_NEAR(strain, 0, 1e-12);
  const auto &a = rough.modes(), &b = fine.modes();
  ASSERT_GE(a.size(), 4u);
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NEAR(std::abs(a[i].lambda), std::abs(b[i].lambda), 1e-7 * std::abs(b[i].lambda)) << i;
}



// In space, with axes that the drawing turns: each body is turned at random, and its axis with it.
TEST(Drawings, SpaceLinkageWithTurnedAxes)
{
  const Scene scene(bennett(0.05));
  ASSERT_TRUE(scene.input.assembled && scene.input.assembled->has_moved());
  EXPECT_LT(scene.input.assembled->gap, 1e-12);
  EXPECT_LT(largest_gap(scene), 1e-12);
  ModelCheck check;
  find_redundant(scene.system, check);
  EXPECT_EQ(check.redundant_multipliers.size(), 3u); // Bennett's linkage moves though Grübler says it should not
  find_free_motions(scene.system, check);
  EXPECT_EQ(check.n_free_motions, 1u);
  expect_used_model_fits(scene);
}



// Joints whose axes on the two bodies differ keep each on its own.
TEST(Drawings, UniversalAndConstantVelocity)
{
  for (const std::string kind :
       {"universal", "constant velocity", "spherical", "cylindrical", "prismatic", "planar", "in line"})
    {
      SCOPED_TRACE(kind);
      const Scene scene(two_rods(kind));
      ASSERT_TRUE(scene.input.assembled && scene.input.assembled->has_moved());
      EXPECT_LT(largest_gap(scene), 1e-13);
      expect_used_model_fits(scene);
    }
}
