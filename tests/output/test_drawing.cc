/*
 * Problem:   shapes drawn about a sample at a skew place and triad
 * Reference: a closed surface has ∮ n dA = 0, and ⅓ ∮ x·n dA = V with V > 0 if the normals point outwards. The surfaces
 *            are polyhedra; their volumes are exact where a formula is given and converge with the pieces otherwise.
 */

#include <samara/model/drawing.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  const double pi = std::acos(-1.);



  Sample
  skew_sample()
  {
    Sample sample;
    sample.x        = {0.3, -2, 1.7};
    sample.D        = cayley(Vector3(0.4, -0.9, 1.3));
    sample.velocity = {4, 5, 6};
    return sample;
  }



  Drawing
  new_drawing()
  {
    Drawing drawing;
    drawing.begin_object("thing");
    return drawing;
  }



  struct Surface
  {
    Vector3 closure = Vector3::Zero(); ///< ∮ n dA [m²]
    double  area    = 0;               ///< [m²]
    double  volume  = 0;               ///< [m³]
  };



  Surface
  measure(const Drawing &drawing)
  {
    Surface surface;
    for (const Drawing::Cell &quad : drawing.cells)
      for (const unsigned int third : {2, 3}) // the triangles (0, 1, 2) and (0, 2, 3)
        {
          const auto    x = [&](const unsigned int j) { return drawing.corners[quad.corners[j]].x; };
          const Vector3 a = x(0), b = x(third - 1), c = x(third);
          const Vector3 n = 0.5 * (b - a).cross(c - a);
          surface.closure += n;
          surface.area += n.norm();
          surface.volume += n.dot(a + b + c) / 9;
        }
    EXPECT_LT(surface.closure.norm(), 1e-13 * surface.area);
    return surface;
  }



  /** Area of a regular polygon with n corners at radius r. */
  double
  polygon_area(const unsigned int n, const double r)
  {
    return 0.5 * n * r * r * std::sin(2 * pi / n);
  }
} // namespace



TEST(Drawing, Box)
{
  Drawing drawing = new_drawing();
  drawing.box(skew_sample(), {1, 2, 3});
  EXPECT_EQ(drawing.cells.size(), 6u);
  EXPECT_NEAR(measure(drawing).volume, 6, 1e-13);
  EXPECT_NEAR(measure(drawing).area, 22, 1e-13);
}



TEST(Drawing, BoxHasItsSidesAlongTheTriad)
{
  const Sample sample  = skew_sample();
  Drawing      drawing = new_drawing();
  drawing.box(sample, {1, 2, 3});
  for (const auto &corner : drawing.corners)
    EXPECT_LT(((sample.D.transpose() * (corner.x - sample.x)).cwiseAbs() - Vector3(0.5, 1, 1.5)).norm(), 1e-14);
}



TEST(Drawing, CylinderAboutEachAxis)
{
  for (const unsigned int axis : {0, 1, 2})
    {
      const Sample sample  = skew_sample();
      Drawing      drawing = new_drawing();
      drawing.cylinder(sample, axis, 0.5, 2);
      EXPECT_NEAR(measure(drawing).volume, polygon_area(24, 0.5) * 2, 1e-13);
      EXPECT_NEAR(measure(drawing).volume, pi / 2, 0.02);
      for (const auto &corner : drawing.corners)
        EXPECT_NEAR(std::abs(sample.D.col(axis).dot(corner.x - sample.x)), 1, 1e-14);
    }
}



TEST(Drawing, Sphere)
{
  const Sample sample  = skew_sample();
  Drawing      drawing = new_drawing();
  drawing.sphere(sample, 2);
  const Surface surface = measure(drawing);
  EXPECT_NEAR(surface.volume / (4. / 3 * pi * 8), 1, 0.03);
  EXPECT_NEAR(surface.area / (4 * pi * 4), 1, 0.02);
  for (const auto &corner : drawing.corners)
    EXPECT_NEAR((corner.x - sample.x).norm(), 2, 1e-14);
}



TEST(Drawing, Bar)
{
  Sample from, to;
  from.x = {1, 2, 3};
  to.x   = {4, 6, 3};

  Drawing drawing = new_drawing();
  drawing.bar(from, to, 0.1);
  EXPECT_NEAR(measure(drawing).volume, 5 * polygon_area(8, 0.1), 1e-14);
}



TEST(Drawing, BarWithoutLengthIsNothing)
{
  Drawing drawing = new_drawing();
  drawing.bar(skew_sample(), skew_sample(), 0.1);
  EXPECT_TRUE(drawing.cells.empty());
}



/** A prism along d₁ with any outline, also with an odd number of points or one that turns clockwise. */
TEST(Drawing, StraightTube)
{
  const Eigen::Vector2d                           p(0, 0), q(2, 0), r(2, 1), s(1, 2), t(0, 1);
  const std::vector<std::vector<Eigen::Vector2d>> outlines = {
    {p, q, r}, {p, q, r, t}, {p, q, r, s, t}, {t, s, r, q, p}, rectangle_outline(1, 2), ellipse_outline(1, 2, 17)};
  const double areas[] = {1, 2, 3, 3, 2, 2 * polygon_area(17, 1)};

  for (unsigned int i = 0; i < outlines.size(); ++i)
    {
      Sample start = skew_sample(), end = start;
      end.x += 3 * end.D.col(0);

      Drawing drawing = new_drawing();
      drawing.tube({start, end}, {outlines[i], outlines[i]});
      EXPECT_NEAR(measure(drawing).volume, 3 * areas[i], 1e-13) << i;
    }
}



/** A quarter of a torus has the volume of Pappus, area of the outline times way of its centroid. */
TEST(Drawing, BentTube)
{
  const double       radius = 3, r = 0.4;
  const unsigned int n = 400, n_points = 96;

  std::vector<Sample> axis(n + 1);
  for (unsigned int i = 0; i <= n; ++i)
    {
      const double angle = pi / 2 * i / n;
      axis[i].x          = {radius * std::sin(angle), radius * (1 - std::cos(angle)), 0};
      axis[i].D          = rotation_of_vector({0, 0, angle});
    }

  Drawing drawing = new_drawing();
  drawing.tube(axis, std::vector<std::vector<Eigen::Vector2d>>(n + 1, ellipse_outline(r, r, n_points)));
  EXPECT_NEAR(measure(drawing).volume, polygon_area(n_points, r) * radius * pi / 2, 1e-4);
}



TEST(Drawing, CornersCarryTheirSample)
{
  Sample from = skew_sample(), to = skew_sample();
  to.x += to.D.col(0);
  to.displacement = {7, 8, 9};

  Drawing drawing;
  drawing.begin_object("first");
  drawing.sphere(from, 1);
  drawing.begin_object("second");
  const Drawing::Place place = drawing.tube({from, to}, {rectangle_outline(1, 1), rectangle_outline(1, 1)});
  EXPECT_EQ(place.first_sample, 1u);
  EXPECT_EQ(place.first_cell, 6u * 6 * 6);

  EXPECT_EQ(drawing.objects, (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(drawing.corners.front().object, 0u);
  EXPECT_EQ(drawing.corners.back().object, 1u);
  for (const auto &corner : drawing.corners)
    {
      const bool    at_end = corner.object == 1 && from.D.col(0).dot(corner.x - from.x) > 0.5;
      const Sample &sample = drawing.samples[corner.sample];
      EXPECT_EQ(sample.displacement, at_end ? to.displacement : from.displacement);
      EXPECT_EQ(sample.velocity, from.velocity);
      EXPECT_EQ(sample.D, from.D);
    }
}



/** Points are shared: a tube of n pieces has as many rings, whatever number of quadrilaterals meets there. */
TEST(Drawing, TubeHasOnePointForEachCornerOfAnOutline)
{
  const unsigned int  n = 50, n_points = 12;
  std::vector<Sample> axis(n + 1);
  for (unsigned int i = 0; i <= n; ++i)
    axis[i].x(0) = i;
  Drawing drawing = new_drawing();
  drawing.tube(axis, std::vector<std::vector<Eigen::Vector2d>>(n + 1, ellipse_outline(1, 1, n_points)));
  EXPECT_EQ(drawing.samples.size(), n + 1);
  EXPECT_EQ(drawing.corners.size(), n_points * (n + 1));
  EXPECT_EQ(drawing.cells.size(), n_points * n + 2 * (n_points / 2 - 1));
}



/** A surface that is made by hand: quadrilaterals of order p, drawn through their nodes. */
namespace
{
  /** The nodes of one element of order p on the saddle z = u v over the unit square, in the frame of skew_sample(). */
  std::vector<Sample>
  saddle(const unsigned int p)
  {
    std::vector<Sample> nodes;
    for (unsigned int j = 0; j <= p; ++j)
      for (unsigned int i = 0; i <= p; ++i)
        {
          const double u = double(i) / p, v = double(j) / p;
          Sample       node = skew_sample();
          node.x += node.D * Vector3(u, v, u * v);
          nodes.push_back(node);
        }
    return nodes;
  }
} // namespace



/** The area of z = u v is ∫∫ √(1 + u² + v²) du dv = 1.2807…, which the pieces come near to with the square of their
 * size.
 */
TEST(Drawing, ElementsOfOrderPAreGridsOfQuadrilaterals)
{
  double exact = 0;
  for (unsigned int n = 1000, i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      exact += std::sqrt(1 + std::pow((i + 0.5) / n, 2) + std::pow((j + 0.5) / n, 2)) / n / n;
  double error = 0;
  for (const unsigned int p : {1, 2, 4, 8})
    {
      Drawing drawing = new_drawing();
      drawing.grid(p + 1, p + 1, saddle(p));
      EXPECT_EQ(drawing.samples.size(), (p + 1) * (p + 1));
      EXPECT_EQ(drawing.cells.size(), p * p);
      double area = 0;
      for (const auto &cell : drawing.cells)
        {
          ASSERT_EQ(cell.dimension, 2u);
          const auto x = [&](const unsigned int j) { return drawing.corners[cell.corners[j]].x; };
          // the corners go round: diagonals cross
          area += 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
        }
      if (p > 1)
        {
          EXPECT_NEAR(error / (area - exact), 4, 0.5) << p;
        }
      error = area - exact;
    }
  EXPECT_LT(std::abs(error), 1e-3);
}



TEST(Drawing, GridsOfLinesAndPoints)
{
  Drawing drawing = new_drawing();
  drawing.grid(3, 1, {skew_sample(), skew_sample(), skew_sample()});
  drawing.grid(1, 1, {skew_sample()});
  ASSERT_EQ(drawing.cells.size(), 3u);
  EXPECT_EQ(drawing.cells[1].dimension, 1u);
  EXPECT_EQ(drawing.cells[1].corners[0], 1u);
  EXPECT_EQ(drawing.cells[1].corners[1], 2u);
  EXPECT_EQ(drawing.cells[2].dimension, 0u);
  EXPECT_EQ(drawing.cells[2].corners[0], 3u);
}



TEST(Drawing, FieldsBelongToSamplesAndCellsByTheirNumber)
{
  Drawing      drawing = new_drawing();
  const Sample sample  = skew_sample();
  drawing.sphere(sample, 1);
  const Drawing::Place place =
    drawing.patch(2, {sample, sample, sample, sample, sample, sample}, {0, 1, 2, 3, 3, 2, 4, 5});
  Field &force = drawing.field("resultants", "N/m", {"11", "22", "12"});
  Field &layer = drawing.field("failed layers", "", {}, true);
  force.set(place.first_sample + 2, Vector3(1, 2, 3));
  layer.set(place.first_cell + 1, 7);

  EXPECT_EQ(&drawing.field("resultants", "N/m", {"11", "22", "12"}), &force);
  EXPECT_EQ(drawing.fields.size(), 2u);
  EXPECT_EQ(force(1 + 2, 1), 2.f);
  for (const unsigned int sample_without : {0, 1, 2, 4, 6, 1000})
    EXPECT_TRUE(std::isnan(force(sample_without, 0))) << sample_without;
  EXPECT_EQ(layer(place.first_cell + 1), 7.f);
  EXPECT_TRUE(std::isnan(layer(place.first_cell)));
}



/** Newtons of one object must not look like those per metre of another. */
TEST(Drawing, FieldsOfOneNameAreOfOneKind)
{
  Drawing drawing = new_drawing();
  drawing.field("load", "N", inertial_axes);
  EXPECT_THROW(drawing.field("load", "N/m", inertial_axes), dealii::ExceptionBase);
  EXPECT_THROW(drawing.field("load", "N", section_axes), dealii::ExceptionBase);
  EXPECT_THROW(drawing.field("load", "N"), dealii::ExceptionBase);
  EXPECT_THROW(drawing.field("a < b", "N"), dealii::ExceptionBase);
  EXPECT_NO_THROW(drawing.field("load", "1", {}, true)); // those of cells are others
}
