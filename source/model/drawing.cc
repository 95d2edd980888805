#include <samara/model/drawing.h>
#include <samara/model/model.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>

/*
 * Corners of a quadrilateral go round it, counter-clockwise for who looks from outside: the normal
 * (corner 1 − corner 0) × (corner 3 − corner 0) points outwards. All solid shapes are closed surfaces.
 */
namespace samara
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /** How many sides a drawn circle has, how many pieces an edge of the cube that is blown up to a sphere. */
    constexpr unsigned int sides_of_cylinder = 24, sides_of_bar = 8, pieces_of_sphere = 6;

    using Ring = std::vector<Vector3>;



    unsigned int
    add_sample(Drawing &drawing, const Sample &sample)
    {
      Assert(drawing.n_objects() > 0, dealii::ExcMessage("Call begin_object() before drawing."));
      drawing.samples.push_back(sample);
      return drawing.samples.size() - 1;
    }



    /** Add points of a sample; returns the number of the first one. */
    unsigned int
    add_corners(Drawing &drawing, const unsigned int sample, const Ring &places)
    {
      const unsigned int object = drawing.objects.empty() ? 0 : drawing.objects.size() - 1;
      for (const Vector3 &x : places)
        drawing.corners.push_back({x, sample, object});
      return drawing.corners.size() - places.size();
    }



    /**
     * Fill a ring of @p n corners with strips from one side of it to the other: this is right for all convex outlines
     * and, when they begin at the trailing edge, for airfoils, whose middle may lie outside. A ring with an odd number
     * of points ends with a triangle, which is a quadrilateral with two corners at one place.
     */
    void
    add_lid(Drawing &drawing, const unsigned int first, const unsigned int n, const bool reversed)
    {
      const auto corner = [&](const unsigned int j) { return first + (reversed ? n - 1 - j : j); };
      for (unsigned int low = 0, high = n - 1; low + 1 < high; ++low, --high)
        drawing.cells.push_back({2, {corner(low), corner(low + 1), corner(high - 1), corner(high)}});
    }



    /** Room for @p more: of much, exactly so much; of little, what appending gets anyway. */
    template <typename T>
    void
    reserve_more(std::vector<T> &list, const std::size_t more)
    {
      if (const std::size_t size = list.size() + more; size > list.capacity() && more > list.size())
        list.reserve(size);
    }



    /** Whether a tube of so many rings of @p n corners each is only counted: its sides, and strips of its two lids. */
    bool
    is_tube_left_out(Drawing &drawing, const std::size_t n_rings, const std::size_t n)
    {
      return drawing.leaves_out(n_rings * n, (n_rings - 1) * n + 2 * ((n - 1) / 2));
    }



    /**
     * A closed surface through rings that turn counter-clockwise for who looks against the way they are stacked, of
     * samples that are in the drawing.
     */
    void
    add_tube(Drawing &drawing, const std::vector<unsigned int> &samples, const std::vector<Ring> &rings)
    {
      const unsigned int        n = rings[0].size();
      std::vector<unsigned int> first;
      first.reserve(rings.size());
      reserve_more(drawing.corners, rings.size() * n);
      reserve_more(drawing.cells, rings.size() * n);
      for (unsigned int i = 0; i < rings.size(); ++i)
        first.push_back(add_corners(drawing, samples[i], rings[i]));
      for (unsigned int i = 0; i + 1 < rings.size(); ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const unsigned int next = (j + 1) % n;
            drawing.cells.push_back({2, {first[i] + j, first[i] + next, first[i + 1] + next, first[i + 1] + j}});
          }
      add_lid(drawing, first.front(), n, true);
      add_lid(drawing, first.back(), n, false);
    }



    /** A circle about @p centre that turns from @p e towards @p f. */
    Ring
    circle(const Vector3 &centre, const Vector3 &e, const Vector3 &f, const double radius, const unsigned int n_points)
    {
      Ring ring;
      for (unsigned int j = 0; j < n_points; ++j)
        {
          const double angle = 2 * pi * j / n_points;
          ring.push_back(centre + radius * (std::cos(angle) * e + std::sin(angle) * f));
        }
      return ring;
    }



    /**
     * The faces of the cube [−1, 1]³, cut into n × n pieces, each corner sent through @p place. The cuts are at equal
     * angles from the middle of the cube, so that a sphere gets pieces of nearly equal size.
     */
    template <typename Place>
    void
    add_cube(Drawing &drawing, const Sample &sample, const unsigned int n, const Place &place)
    {
      const auto         cut = [n](const unsigned int i) { return std::tan(pi / 4 * (2. * i / n - 1)); };
      const unsigned int own = add_sample(drawing, sample);
      if (drawing.leaves_out(6 * (n + 1) * (n + 1), 6 * n * n))
        return;
      for (unsigned int axis = 0; axis < 3; ++axis)
        for (const double side : {-1., 1.})
          {
            const Vector3 normal = side * Vector3::Unit(axis), e = Vector3::Unit((axis + 1) % 3), f = normal.cross(e);
            Ring          face;
            for (unsigned int j = 0; j <= n; ++j)
              for (unsigned int i = 0; i <= n; ++i)
                face.push_back(sample.x + sample.D * place(Vector3(normal + cut(i) * e + cut(j) * f)));
            const unsigned int first = add_corners(drawing, own, face);
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int i = 0; i < n; ++i)
                {
                  const unsigned int corner = first + i + j * (n + 1);
                  drawing.cells.push_back({2, {corner, corner + 1, corner + n + 2, corner + n + 1}});
                }
          }
    }



    /** Twice the area inside, negative if the outline turns clockwise. */
    double
    turning_sense(const std::vector<Eigen::Vector2d> &outline)
    {
      double sum = 0;
      for (unsigned int j = 0; j < outline.size(); ++j)
        {
          const Eigen::Vector2d &a = outline[j], &b = outline[(j + 1) % outline.size()];
          sum += a(0) * b(1) - a(1) * b(0);
        }
      return sum;
    }
  } // namespace



  void
  Drawing::begin_object(const std::string &name)
  {
    if (has_corners())
      objects.push_back(name);
    else
      ++objects_left_out;
  }



  Drawing
  Drawing::only(const Content content) const
  {
    if (content == Content::everything)
      return *this;
    Drawing part(model, content);
    part.samples          = samples;
    part.items            = items;
    part.corners_left_out = n_corners();
    part.cells_left_out   = n_cells();
    part.objects_left_out = n_objects();
    if (part.has_fields())
      for (const Field &field : fields)
        part.fields.push_back(field);
    return part;
  }



  bool
  Drawing::leaves_out(const std::size_t n_corners, const std::size_t n_cells)
  {
    if (has_corners())
      return false;
    corners_left_out += n_corners;
    cells_left_out += n_cells;
    return true;
  }



  Sample
  Drawing::sample(const Frame &frame, const State &state) const
  {
    Assert(model != nullptr, dealii::ExcMessage("A drawing without a model knows no reference positions."));
    const Model::Node &node = model->nodes[frame.node];
    Sample             sample;
    sample.x            = frame.position(state.q.data());
    sample.D            = frame.triad(state.q.data());
    sample.displacement = sample.x - (node.x + node.D * frame.arm);
    const Vector6 twist = frame.twist(state.y.data());
    sample.velocity     = sample.D * twist.head<3>();
    sample.spin         = sample.D * twist.tail<3>();
    sample.node         = frame.node;
    return sample;
  }



  void
  Drawing::attach(const Frame &frame, const State &state)
  {
    if (has_corners())
      attachments.push_back(sample(frame, state));
  }



  Drawing::Place
  Drawing::patch(const unsigned int               dimension,
                 const std::vector<Sample>       &of_patch,
                 const std::vector<unsigned int> &of_cells)
  {
    AssertIndexRange(dimension, 3);
    const unsigned int n_of_cell = 1u << dimension, object = n_objects() - 1, first_corner = corners.size();
    const Place        place = {static_cast<unsigned int>(samples.size()), static_cast<unsigned int>(n_cells())};
    Assert(of_cells.size() % n_of_cell == 0, dealii::ExcMessage("The last cell of a patch is not complete."));
    for (const Sample &sample : of_patch)
      {
        const unsigned int number = add_sample(*this, sample);
        if (has_corners())
          corners.push_back({sample.x, number, object});
      }
    if (leaves_out(of_patch.size(), of_cells.size() / n_of_cell))
      return place;
    for (unsigned int i = 0; i < of_cells.size(); i += n_of_cell)
      {
        Cell cell{dimension, {}};
        for (unsigned int j = 0; j < n_of_cell; ++j)
          {
            AssertIndexRange(of_cells[i + j], of_patch.size());
            cell.corners[j] = first_corner + of_cells[i + j];
          }
        cells.push_back(cell);
      }
    return place;
  }



  Drawing::Place
  Drawing::grid(const unsigned int n_1, const unsigned int n_2, const std::vector<Sample> &nodes)
  {
    AssertDimension(nodes.size(), std::size_t(n_1) * n_2);
    const unsigned int        dimension = n_2 > 1 ? 2 : n_1 > 1 ? 1 : 0;
    std::vector<unsigned int> of_cells;
    Assert(n_1 > 1 || dimension == 0, dealii::ExcMessage("A grid of one row of nodes has them along direction 1."));
    if (dimension == 0)
      of_cells = {0};
    for (unsigned int i = 0; dimension == 1 && i + 1 < n_1; ++i)
      of_cells.insert(of_cells.end(), {i, i + 1});
    for (unsigned int j = 0; j + 1 < n_2; ++j)
      for (unsigned int i = 0; i + 1 < n_1; ++i)
        {
          const unsigned int corner = i + j * n_1;
          of_cells.insert(of_cells.end(), {corner, corner + 1, corner + 1 + n_1, corner + n_1});
        }
    return patch(dimension, nodes, of_cells);
  }



  Field &
  Drawing::field(const std::string              &name,
                 const std::string              &unit,
                 const std::vector<std::string> &components,
                 const bool                      is_on_cells)
  {
    for (Field &field : fields)
      if (field.is_on_cells == is_on_cells && field.name == name)
        {
          AssertThrow(field.unit == unit && field.components == components,
                      dealii::ExcMessage("Two fields of a picture, with different units or components, are called <" +
                                         name + ">."));
          return field;
        }
    AssertThrow((name + unit).find_first_of("<>&\"") == std::string::npos,
                dealii::ExcMessage("The field <" + name + "> [" + unit + "] has a name that files cannot hold."));
    return fields.emplace_back(name, unit, components, is_on_cells);
  }



  Drawing::Place
  Drawing::tube(const std::vector<Sample> &axis, const std::vector<std::vector<Eigen::Vector2d>> &outlines)
  {
    Assert(axis.size() == outlines.size(), dealii::ExcDimensionMismatch(outlines.size(), axis.size()));
    return tube(axis, [&](const unsigned int i) { return outlines[i]; });
  }



  Drawing::Place
  Drawing::tube(const std::vector<Sample>                                               &axis,
                const std::function<std::vector<Eigen::Vector2d>(const unsigned int i)> &outline)
  {
    AssertThrow(axis.size() >= 2, dealii::ExcMessage("A tube has two samples at least."));
    const Place               place = {static_cast<unsigned int>(samples.size()), static_cast<unsigned int>(n_cells())};
    std::vector<unsigned int> own;
    own.reserve(axis.size());
    reserve_more(samples, axis.size());
    for (const Sample &sample : axis)
      own.push_back(add_sample(*this, sample));
    if (!has_corners())
      {
        is_tube_left_out(*this, axis.size(), outline(0).size());
        return place;
      }
    std::vector<std::vector<Eigen::Vector2d>> outlines;
    outlines.reserve(axis.size());
    for (unsigned int i = 0; i < axis.size(); ++i)
      outlines.push_back(outline(i));

    // An outline at a pointed tip may have no area, so the sense of turning is that of all of them.
    double sense = 0;
    for (const auto &outline : outlines)
      sense += turning_sense(outline);

    std::vector<Ring> rings;
    rings.reserve(axis.size());
    for (unsigned int i = 0; i < axis.size(); ++i)
      {
        Assert(outlines[i].size() == outlines[0].size() && outlines[i].size() >= 3,
               dealii::ExcMessage("All outlines of a tube have the same number of points, at least 3."));
        Ring ring;
        ring.reserve(outlines[i].size());
        for (const Eigen::Vector2d &point : outlines[i])
          ring.push_back(axis[i].x + axis[i].D.col(1) * point(0) + axis[i].D.col(2) * point(1));
        if (sense < 0)
          std::reverse(ring.begin(), ring.end());
        rings.push_back(std::move(ring));
      }
    add_tube(*this, own, rings);
    return place;
  }



  void
  Drawing::cylinder(const Sample &centre, const unsigned int axis, const double radius, const double length)
  {
    AssertIndexRange(axis, 3);
    const unsigned int own = add_sample(*this, centre);
    if (is_tube_left_out(*this, 2, sides_of_cylinder))
      return;
    const Vector3 direction = centre.D.col(axis), e = centre.D.col((axis + 1) % 3), f = centre.D.col((axis + 2) % 3);
    add_tube(*this,
             {own, own},
             {circle(centre.x - length / 2 * direction, e, f, radius, sides_of_cylinder),
              circle(centre.x + length / 2 * direction, e, f, radius, sides_of_cylinder)});
  }



  void
  Drawing::sphere(const Sample &centre, const double radius)
  {
    add_cube(*this, centre, pieces_of_sphere, [radius](const Vector3 &p) -> Vector3 {
      return radius * p.normalized();
    });
  }



  void
  Drawing::box(const Sample &centre, const Vector3 &sides)
  {
    add_cube(*this, centre, 1, [&sides](const Vector3 &p) -> Vector3 { return sides.cwiseProduct(p) / 2; });
  }



  void
  Drawing::bar(const Sample &from, const Sample &to, const double radius)
  {
    const Vector3 span = to.x - from.x;
    if (span.norm() == 0)
      return; // a joint whose ends coincide has no bar

    // the axes of its ends are those of the bar, so that its corners keep their places in them
    const Vector3 direction = span.normalized(), e = direction.unitOrthogonal(), f = direction.cross(e);
    Sample        a = from, b = to;
    a.D << direction, e, f;
    b.D = a.D;
    const std::vector<unsigned int> own = {add_sample(*this, a), add_sample(*this, b)};
    if (is_tube_left_out(*this, 2, sides_of_bar))
      return;
    add_tube(*this, own, {circle(a.x, e, f, radius, sides_of_bar), circle(b.x, e, f, radius, sides_of_bar)});
  }



  std::vector<Eigen::Vector2d>
  ellipse_outline(const double radius_2, const double radius_3, const unsigned int n_points)
  {
    // a beam asks for one at each sample
    static thread_local std::vector<Eigen::Vector2d> circle;
    if (circle.size() != n_points)
      {
        circle.clear();
        for (unsigned int j = 0; j < n_points; ++j)
          circle.emplace_back(std::cos(2 * pi * j / n_points), std::sin(2 * pi * j / n_points));
      }
    std::vector<Eigen::Vector2d> outline;
    outline.reserve(n_points);
    for (const Eigen::Vector2d &point : circle)
      outline.emplace_back(radius_2 * point(0), radius_3 * point(1));
    return outline;
  }



  std::vector<Eigen::Vector2d>
  rectangle_outline(const double width_2, const double width_3)
  {
    const double a = width_2 / 2, b = width_3 / 2;
    return {{a, -b}, {a, b}, {-a, b}, {-a, -b}};
  }
} // namespace samara
