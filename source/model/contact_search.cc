// Which pairs of a contact group are near.

#include <samara/model/contact_group.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace samara
{
  namespace
  {
    namespace bg    = boost::geometry;
    using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
    using TreeBox   = bg::model::box<TreePoint>;

    /** So much more than its speed says may something come nearer in a step, and this part of its radius. */
    constexpr double more_than_speed = 1.5, part_of_radius = 0.1;

    /** The box around points, with a margin. */
    TreeBox
    box_about(const Vector3 &low, const Vector3 &high, const double r)
    {
      return {TreePoint(low(0) - r, low(1) - r, low(2) - r), TreePoint(high(0) + r, high(1) + r, high(2) + r)};
    }
  } // namespace



  /** What is searched among: balls, and pieces of lines. */
  struct ContactGroup::Search
  {
    struct Object
    {
      unsigned int number; ///< of the ball, or of the line
      int          piece;  ///< −1: a ball
    };
    const double                                 *q;
    const Margins                                &margins;
    const std::vector<Vector3>                   &x; ///< centres of beads
    std::vector<Object>                           objects;
    std::vector<std::pair<TreeBox, unsigned int>> boxes;

    void
    add(const Object &object, const TreeBox &box)
    {
      boxes.emplace_back(box, objects.size());
      objects.push_back(object);
    }
  };



  void
  ContactGroup::find_bounded(const Search &search, std::vector<Pair> &pairs) const
  {
    const bg::index::rtree<std::pair<TreeBox, unsigned int>, bg::index::quadratic<16>> tree(search.boxes);
    std::vector<std::pair<TreeBox, unsigned int>>                                      found;
    for (const auto &[box, i] : search.boxes)
      {
        found.clear();
        tree.query(bg::index::intersects(box), std::back_inserter(found));
        for (const auto &[other_box, j] : found)
          {
            const auto &a = search.objects[i], &b = search.objects[j];
            if (j <= i)
              continue;
            if (a.piece >= 0 || b.piece >= 0)
              {
                find_on_lines(search, i, j, pairs);
                continue;
              }
            const Pair   pair{a.number, b.number, false};
            const double near = beads[a.number].radius + beads[b.number].radius + search.margins.beads[a.number] +
                                search.margins.beads[b.number];
            if (is_possible(pair) && (search.x[a.number] - search.x[b.number]).squaredNorm() < near * near)
              pairs.push_back(pair);
          }
      }
  }



  void
  ContactGroup::find_on_lines(const Search      &search,
                              const unsigned int i,
                              const unsigned int j,
                              std::vector<Pair> &pairs) const
  {
    // balls come before pieces of lines: j is one
    const auto &first = search.objects[i], &second = search.objects[j];
    Pair        pair{first.number, second.number, false, first.piece >= 0, true};
    if (!is_possible(pair))
      return;
    const ContactLine &line_a = lines[second.number], *const line_b = pair.b_is_line ? &lines[first.number] : nullptr;
    const double       near  = pair.b_is_line ? line_b->radius + search.margins.lines[first.number] :
                                                beads[first.number].radius + search.margins.beads[first.number];
    const double       least = near + line_a.radius + search.margins.lines[second.number];
    const LinesOrPoint between{line_b, line_b != nullptr ? Vector3::Zero() : search.x[first.number], &line_a};
    // from several places of both pieces, their ends among them
    constexpr std::array<double, 4> parts{{0., 0.3, 0.7, 1.}};
    const auto                      place = [&](const ContactLine &line, const int piece, const double part) {
      const Span &span = line.spans[piece];
      return ContactLine::Place{static_cast<unsigned int>(piece), span.start + part * (span.end - span.start)};
    };
    NearestPlaces best; // of the starts
    bool          is_any = false;
    best.distance        = std::numeric_limits<double>::infinity();
    for (const double part_a : parts)
      for (const double part_b : parts)
        {
          if (line_b == nullptr && part_b > 0)
            break;
          NearestPlaces from;
          from.a = place(line_a, second.piece, part_a);
          if (line_b != nullptr)
            from.b = place(*line_b, first.piece, part_b);
          const Vector3 x_b = line_b != nullptr ? line_b->local(from.b, search.q).x : between.point;
          from.distance     = (x_b - line_a.local(from.a, search.q).x).norm();
          if (from.distance < best.distance)
            best = from;
          const auto found = nearest_places(between, from, search.q);
          is_any           = is_any || found;
          if (!found || !(found->distance < least))
            continue;
          pair.nearest = *found;
          pairs.push_back(pair);
        }
    if (is_any || !(best.distance < least))
      return;
    // near, and no start leads to a minimum: who uses the pair finds that, and says so
    pair.nearest = best;
    pairs.push_back(pair);
  }



  namespace
  {
    auto
    order_of(const ContactGroup::Pair &p)
    {
      return std::make_tuple(p.with_surface, p.a_is_line, p.b_is_line, p.bead, p.other, p.nearest.b.s, p.nearest.a.s);
    }

    /** Whether two pairs are places of the same lines, found from different starts. */
    bool
    are_same(const ContactGroup::Pair &a, const ContactGroup::Pair &b, const double size)
    {
      return a.a_is_line &&
             std::make_tuple(b.a_is_line, b.b_is_line, b.bead, b.other) ==
               std::make_tuple(a.a_is_line, a.b_is_line, a.bead, a.other) &&
             std::abs(a.nearest.a.s - b.nearest.a.s) < size && std::abs(a.nearest.b.s - b.nearest.b.s) < size;
    }
  } // namespace



  void
  ContactGroup::find_pairs(const double *const q,
                           const double *const y,
                           const double        h,
                           std::vector<Pair>  &pairs,
                           Margins            &margins) const
  {
    pairs.clear();
    std::vector<Vector3> x(beads.size());
    margins.beads.assign(beads.size(), 0.);
    margins.surfaces.assign(surfaces.size(), 0.);
    margins.lines.assign(lines.size(), 0.);
    margins.reach       = 0;
    double least_radius = beads.empty() ? 0. : beads[0].radius;
    for (unsigned int i = 0; i < beads.size(); ++i)
      {
        x[i]         = position(beads[i], q);
        least_radius = std::min(least_radius, beads[i].radius);
        if (h > 0)
          margins.beads[i] = more_than_speed * h * velocity(beads[i], q, y).norm() + part_of_radius * beads[i].radius;
      }
    for (unsigned int j = 0; j < surfaces.size(); ++j)
      {
        const Frame  &frame = surfaces[j].frame;
        const Vector3 at    = frame.position(q);
        double        reach = 0;
        for (const Vector3 &place : x)
          reach = std::max(reach, (place - at).norm());
        margins.reach = std::max(margins.reach, reach);
        if (h > 0)
          {
            const Vector3                   speed = frame.twist(y).template head<3>();
            const Eigen::Map<const Vector3> spin(y + 6 * frame.node + 3);
            margins.surfaces[j] =
              more_than_speed * h * (speed.norm() + spin.norm() * reach) + part_of_radius * least_radius;
          }
        for (unsigned int i = 0; i < beads.size(); ++i)
          if (const Pair pair{i, j, true};
              is_possible(pair) && gap(pair, q) > -(margins.beads[i] + margins.surfaces[j]))
            pairs.push_back(pair);
      }
    if (balls_touch_balls)
      find_among_bounded(q, y, h, x, pairs, margins);
    std::sort(pairs.begin(), pairs.end(), [](const Pair &a, const Pair &b) { return order_of(a) < order_of(b); });
    const double size = lines.empty() ? 0. : 1e-6 * (lines[0].end() - lines[0].start());
    pairs.erase(std::unique(pairs.begin(),
                            pairs.end(),
                            [=](const Pair &a, const Pair &b) { return are_same(a, b, size); }),
                pairs.end());
  }



  void
  ContactGroup::find_among_bounded(const double *const         q,
                                   const double *const         y,
                                   const double                h,
                                   const std::vector<Vector3> &x,
                                   std::vector<Pair>          &pairs,
                                   Margins                    &margins) const
  {
    Search search{q, margins, x, {}, {}};
    for (unsigned int i = 0; i < beads.size(); ++i)
      if (beads[i].is_ball)
        search.add({i, -1}, box_about(x[i], x[i], beads[i].radius + margins.beads[i]));
    for (unsigned int l = 0; l < lines.size(); ++l)
      {
        for (const Span &span : lines[l].spans)
          for (const Frame &frame : span.frames)
            if (h > 0)
              margins.lines[l] =
                std::max(margins.lines[l], more_than_speed * h * frame.twist(y).template head<3>().norm());
        if (h > 0)
          margins.lines[l] += part_of_radius * lines[l].radius;
        for (unsigned int piece = 0; piece < lines[l].spans.size(); ++piece)
          {
            const Span &span = lines[l].spans[piece];
            Vector3     low = span.frames[0].position(q), high = low;
            for (const Frame &frame : span.frames)
              {
                low  = low.cwiseMin(frame.position(q));
                high = high.cwiseMax(frame.position(q));
              }
            // polynomials leave the box of their nodes a little
            search.add({l, int(piece)},
                       box_about(low, high, lines[l].radius + margins.lines[l] + 0.2 * (high - low).norm()));
          }
      }
    find_bounded(search, pairs);
  }



  double
  ContactGroup::energy(const double *const q) const
  {
    thread_local std::vector<Pair> pairs;
    thread_local Margins           margins;
    find_pairs(q, nullptr, 0, pairs, margins);
    double sum = 0;
    for (const Pair &pair : pairs)
      sum += part_of(pair) * law_of(pair).energy(gap(pair, q));
    return sum;
  }
} // namespace samara
