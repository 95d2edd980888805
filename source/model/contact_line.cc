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



  ContactLine::Local
  ContactLine::local(const Place &place, const double *const q) const
  {
    const Span &span = spans[place.piece];
    Local       result{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    for (unsigned int a = 0; a < span.frames.size(); ++a)
      {
        const auto    N = polynomial(span.abscissae, a, place.s);
        const Vector3 x = span.frames[a].position(q);
        result.x += N[0] * x;
        result.slope += N[1] * x;
        result.curvature += N[2] * x;
      }
    return result;
  }



  void
  ContactLine::add_frames(const Place &place, std::vector<WeightedFrame> &frames) const
  {
    const Span &span = spans[place.piece];
    for (unsigned int a = 0; a < span.frames.size(); ++a)
      frames.push_back({span.frames[a], polynomial(span.abscissae, a, place.s)[0]});
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

      /** Go along the line, at most half a piece, and not beyond its ends. Returns how far it was. */
      double
      go(double way, const double *q)
      {
        if (is_held)
          return 0;
        const Span  &span = line->spans[place.piece];
        const double most = 0.5 * (span.end - span.start), before = place.s;
        place.s = std::clamp(place.s + std::clamp(way, -most, most), span.start, span.end);
        look(q);
        return std::abs(place.s - before);
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
        const auto   step = newton_step(b, a, delta);
        const double gone = b.go(step[0], q) + a.go(step[1], q);
        if (!(gone < 1e-13 * length))
          continue;
        const Vector3 there = b.at.x - a.at.x;
        const Hessian H(b, a, there);
        if ((!b.is_held && !(H.bb > 0)) || (!a.is_held && !(H.aa > 0)))
          return {}; // no minimum
        const bool is_parallel = !b.is_held && !a.is_held && H.bb * H.aa - H.ba * H.ba < parallel * H.bb * H.aa;
        return NearestPlaces{b.place, a.place, there.norm(), is_parallel};
      }
    return {};
  }
} // namespace samara
