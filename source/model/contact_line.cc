#include <samara/model/contact_line.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Lagrange's polynomial of node a at s, with its first two derivatives. */
    std::array<double, 3>
    polynomial(const std::vector<double> &nodes, const unsigned int a, const double s)
    {
      double value = 1, slope = 0, curvature = 0;
      for (unsigned int b = 0; b < nodes.size(); ++b)
        if (b != a)
          {
            const double g = 1 / (nodes[a] - nodes[b]), f = (s - nodes[b]) * g;
            curvature = curvature * f + 2 * g * slope;
            slope     = slope * f + g * value;
            value *= f;
          }
      return {{value, slope, curvature}};
    }
  } // namespace



  namespace
  {
    /** What turns the slope at an end of a piece by one, and nothing else: of ξ from 0 to 1 over @p length, with
     * derivatives. */
    std::array<double, 3>
    turn_of_slope(const double xi, const double length, const bool at_end)
    {
      if (at_end)
        return {{length * xi * xi * (xi - 1), (3 * xi - 2) * xi, (6 * xi - 2) / length}};
      return {{length * xi * (1 - xi) * (1 - xi), (1 - xi) * (1 - 3 * xi), (6 * xi - 4) / length}};
    }

    /** Call add(frame, N, N', N'') for all frames of a place: those of its piece, and of those beside it. */
    template <typename Add>
    void
    for_frames(const std::vector<Span> &spans, const ContactLine::Place &place, const Add &add)
    {
      const Span &span = spans[place.piece];
      for (unsigned int a = 0; a < span.frames.size(); ++a)
        {
          const auto N = polynomial(span.abscissae, a, place.s);
          add(span.frames[a], N[0], N[1], N[2]);
        }
      // Elements meet with a kink that is none of the beam. Who goes along it would have two places at once on its
      // inner side: the slope is the mean of both there.
      const double length = span.end - span.start, xi = (place.s - span.start) / length;
      for (const bool at_end : {false, true})
        {
          if (at_end ? place.piece + 1 == spans.size() : place.piece == 0)
            continue;
          const Span  &other = spans[at_end ? place.piece + 1 : place.piece - 1];
          const double s = at_end ? span.end : span.start, s_other = at_end ? other.start : other.end;
          const auto   turn = turn_of_slope(xi, length, at_end);
          const auto   half = [&](const Span &of, const double at, const double sign) {
            for (unsigned int a = 0; a < of.frames.size(); ++a)
              {
                const double w = 0.5 * sign * polynomial(of.abscissae, a, at)[1];
                add(of.frames[a], w * turn[0], w * turn[1], w * turn[2]);
              }
          };
          half(other, s_other, 1.);
          half(span, s, -1.);
        }
    }
  } // namespace



  ContactLine::Local
  ContactLine::local(const Place &place, const double *const q) const
  {
    Local result{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    for_frames(spans, place, [&](const Frame &frame, const double N, const double slope, const double curvature) {
      const Vector3 x = frame.position(q);
      result.x += N * x;
      result.slope += slope * x;
      result.curvature += curvature * x;
    });
    return result;
  }



  void
  ContactLine::add_frames(const Place                &place,
                          std::vector<WeightedFrame> &frames,
                          std::vector<double> *const  slopes) const
  {
    if (slopes != nullptr)
      slopes->resize(frames.size(), 0.);
    for_frames(spans, place, [&](const Frame &frame, const double N, const double slope, double) {
      unsigned int i = 0;
      while (i < frames.size() && !(frames[i].frame.node == frame.node && frames[i].frame.arm == frame.arm))
        ++i;
      if (i == frames.size())
        {
          frames.push_back({frame, 0.});
          if (slopes != nullptr)
            slopes->push_back(0.);
        }
      frames[i].weight += N;
      if (slopes != nullptr)
        (*slopes)[i] += slope;
    });
  }



  namespace
  {
    /** Where one side of the search is: free to move, or held at an end of its line or at a kink between two pieces. */
    struct Side
    {
      const ContactLine *line; ///< null: a point
      ContactLine::Place place;
      Vector3            point;
      ContactLine::Local at;
      bool               is_held = true;

      Side(const ContactLine *line, const ContactLine::Place &place, const Vector3 &point, const double *q)
        : line(line)
        , place(place)
        , point(point)
      {
        look(q);
      }

      void
      look(const double *q)
      {
        if (line != nullptr)
          at = line->local(place, q);
        else
          at = {point, Vector3::Zero(), Vector3::Zero()};
      }

      /** With the way @p from_other to here: find whether it can move downhill, over to the next piece if that is so.
       */
      void
      find_freedom(const Vector3 &from_other, const double *q)
      {
        is_held = line == nullptr;
        if (is_held)
          return;
        const Span  &span     = line->spans[place.piece];
        const double uphill   = from_other.dot(at.slope);
        const bool   at_start = place.s <= span.start && uphill > 0, at_end = place.s >= span.end && uphill < 0;
        if (!at_start && !at_end)
          return;
        const int next = int(place.piece) + (at_end ? 1 : -1);
        is_held        = true;
        if (next < 0 || next >= int(line->spans.size()))
          return;
        const ContactLine::Place other{static_cast<unsigned int>(next),
                                       at_end ? line->spans[next].start : line->spans[next].end};
        const auto               there = line->local(other, q);
        if (at_end ? from_other.dot(there.slope) < 0 : from_other.dot(there.slope) > 0)
          {
            place   = other;
            at      = there;
            is_held = false;
          }
      }

      /** Go along the line, at most half a piece, and not beyond its ends. */
      void
      go(const double way, const double *q)
      {
        if (is_held)
          return;
        const Span  &span = line->spans[place.piece];
        const double most = 0.5 * (span.end - span.start);
        place.s           = std::clamp(place.s + std::clamp(way, -most, most), span.start, span.end);
        look(q);
      }
    };

    /** Second derivatives of ½ |Δ|² by the two arc lengths. */
    struct Hessian
    {
      double bb, aa, ba;

      Hessian(const Side &b, const Side &a, const Vector3 &delta)
        : bb(b.at.slope.squaredNorm() + delta.dot(b.at.curvature))
        , aa(a.at.slope.squaredNorm() - delta.dot(a.at.curvature))
        , ba(-b.at.slope.dot(a.at.slope))
      {}
    };

    /** Newton's step, downhill also where the distance is not convex. */
    std::array<double, 2>
    newton_step(const Side &b, const Side &a, const Vector3 &delta)
    {
      const Hessian H(b, a, delta);
      const double  g_b = delta.dot(b.at.slope), g_a = -delta.dot(a.at.slope);
      const auto    alone = [](const double g, const double h, const double slope) {
        return g == 0 ? 0. : -g / (h > 0.1 * slope ? h : slope);
      };
      const double determinant = H.bb * H.aa - H.ba * H.ba;
      if (!b.is_held && !a.is_held && H.bb > 0 && H.aa > 0 && determinant > 1e-6 * H.bb * H.aa)
        return {{(-g_b * H.aa + g_a * H.ba) / determinant, (-g_a * H.bb + g_b * H.ba) / determinant}};
      // one after the other: by half, so that two that move together do not swing
      const double part = b.is_held || a.is_held ? 1. : 0.5;
      return {{b.is_held ? 0. : part * alone(g_b, H.bb, b.at.slope.squaredNorm()),
               a.is_held ? 0. : part * alone(g_a, H.aa, a.at.slope.squaredNorm())}};
    }
  } // namespace



  std::optional<NearestPlaces>
  nearest_places(const LinesOrPoint &lines, NearestPlaces from, const double *const q)
  {
    constexpr unsigned int most_steps = 60;
    constexpr double       parallel   = 1e-4; // square of an angle
    Side                   b(lines.b, from.b, lines.point, q), a(lines.a, from.a, Vector3::Zero(), q);
    const double           length =
      lines.a->end() - lines.a->start() + (lines.b != nullptr ? lines.b->end() - lines.b->start() : 0.);
    for (unsigned int i = 0; i < most_steps; ++i)
      {
        const Vector3 delta = b.at.x - a.at.x;
        b.find_freedom(delta, q);
        a.find_freedom(-delta, q);
        const auto step = newton_step(b, a, delta);
        b.go(step[0], q);
        a.go(step[1], q);
        // what is wanted, not what an end lets through: the next piece may go on
        if (!(std::abs(step[0]) + std::abs(step[1]) < 1e-13 * length))
          continue;
        const Vector3 there = b.at.x - a.at.x;
        const Hessian H(b, a, there);
        if ((!b.is_held && !(H.bb > 0)) || (!a.is_held && !(H.aa > 0)))
          return {}; // no minimum
        const double  determinant = H.bb * H.aa - H.ba * H.ba;
        const bool    both        = !b.is_held && !a.is_held;
        NearestPlaces result{b.place, a.place, there.norm(), both && determinant < parallel * H.bb * H.aa};
        if (both && !result.is_parallel)
          result.inverse << H.aa / determinant, -H.ba / determinant, -H.ba / determinant, H.bb / determinant;
        else if (!both)
          result.inverse.diagonal() << (b.is_held ? 0. : 1 / H.bb), (a.is_held ? 0. : 1 / H.aa);
        return result;
      }
    return {};
  }
} // namespace samara
