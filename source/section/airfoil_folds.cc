// Skins that are thicker than the outline of an airfoil is round: the line at their depth runs back and crosses itself.

#include <samara/base/text.h>
#include <samara/section/airfoil_mesh.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    using Place = dealii::Point<2>;

    /** How far two segments are run through where they cross, fractions of their lengths; (−1, −1): they do not. */
    Place
    crossing_of(const Place &a, const Place &b, const Place &c, const Place &d)
    {
      const Place none(-1, -1);
      if (std::max(a[0], b[0]) < std::min(c[0], d[0]) || std::max(c[0], d[0]) < std::min(a[0], b[0]) ||
          std::max(a[1], b[1]) < std::min(c[1], d[1]) || std::max(c[1], d[1]) < std::min(a[1], b[1]))
        return none;
      const auto   p = b - a, q = d - c, r = c - a;
      const double whole = p[0] * q[1] - p[1] * q[0];
      if (whole == 0)
        return none;
      const double u = (r[0] * q[1] - r[1] * q[0]) / whole, v = (r[0] * p[1] - r[1] * p[0]) / whole;
      return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? Place(u, v) : none;
    }



    /** @p n + 1 values that cut @p line, points at @p s, into pieces of one length. */
    std::vector<double>
    cut_evenly(const std::vector<double> &s, const std::vector<Place> &line, const unsigned int n)
    {
      std::vector<double> sum(1, 0.), result(1, s.front());
      for (std::size_t i = 1; i < s.size(); ++i)
        sum.push_back(sum.back() + line[i].distance(line[i - 1]));
      for (std::size_t k = 1, i = 0; k < n; ++k)
        {
          const double at = sum.back() * k / n;
          while (sum[i + 1] < at)
            ++i;
          result.push_back(s[i] + (at - sum[i]) / (sum[i + 1] - sum[i]) * (s[i + 1] - s[i]));
        }
      result.push_back(s.back());
      return result;
    }
  } // namespace



  AirfoilOutline::Fold
  AirfoilOutline::find_fold(const double a, const double b, const double tightest, const double thickness) const
  {
    // the line at the depth of the wall, in front of the tightest point and behind it; a parabola with a third of the
    // thickness as radius folds within 3.5 thicknesses
    constexpr unsigned int n     = 600;
    const double           reach = 4 * thickness;
    const auto s_before = [&](const unsigned int i) { return tightest - std::min(reach, tightest - a) * i / n; };
    const auto s_behind = [&](const unsigned int i) { return tightest + std::min(reach, b - tightest) * i / n; };
    const auto inner    = [&](const double s) { return Place(place(s) + thickness * across(s)); };
    std::vector<Place> before, behind;
    for (unsigned int i = 0; i <= n; ++i)
      {
        before.push_back(inner(s_before(i)));
        behind.push_back(inner(s_behind(i)));
      }
    // its outermost crossing; where it has none it is only too short there
    double last = tightest, first = tightest;
    for (unsigned int i = n; i > 0 && last == first; --i)
      for (unsigned int j = n; j > 0; --j)
        {
          const Place at = i + j == 2 ? Place(-1, -1) : crossing_of(before[i - 1], before[i], behind[j - 1], behind[j]);
          if (at[0] >= 0)
            {
              last  = s_before(i - 1) + at[0] * (s_before(i) - s_before(i - 1));
              first = s_behind(j - 1) + at[1] * (s_behind(j) - s_behind(j - 1));
              break;
            }
        }
    // a wall that ends before its inner face meets itself has no corner; finer than the steps here nobody sees one
    constexpr double seen = 1e-3;
    if (last == first && thickness * curvature(tightest) > 1 + seen)
      return {a, b, last, first, tightest, thickness, 0};
    // as wide as cells on the inner face keep enough of their length
    constexpr double enough = 0.4;
    Fold             result{last, first, last, first, tightest, thickness, 0};
    const double     step   = reach / n;
    double           length = 0;
    while (result.part < enough && (result.from > a || result.to < b))
      {
        const double from = std::max(a, result.from - step), to = std::min(b, result.to + step);
        const double more = inner(from).distance(inner(result.from)), and_more = inner(to).distance(inner(result.to));
        result.from = from;
        result.to   = to;
        length += more + and_more;
        result.part = length / (to - from);
      }
    double in_front = 0;
    for (unsigned int i = 0; i < n; ++i)
      in_front += inner(result.from + (last - result.from) * i / n)
                    .distance(inner(result.from + (last - result.from) * (i + 1) / n));
    result.corner = length > 0 ? result.from + std::min(1., in_front / length) * (result.to - result.from) : tightest;
    return result;
  }



  void
  AirfoilOutline::add_fold(const Fold &fold)
  {
    constexpr unsigned int n    = 400;
    const auto             even = [&](const double a, const double b) {
      std::vector<double> s;
      std::vector<Place>  line;
      for (unsigned int i = 0; i <= n; ++i)
        {
          s.push_back(a + (b - a) * i / n);
          line.push_back(Place(place(s.back()) + fold.thickness * across(s.back())));
        }
      return cut_evenly(s, line, n);
    };
    folds.push_back({fold, even(fold.from, fold.last), even(fold.first, fold.to)});
  }



  Place
  AirfoilOutline::of_inner_face(const EvenFold &even, const double s) const
  {
    const Fold       &fold      = even.fold;
    const bool        is_before = s <= fold.corner;
    const auto       &at        = is_before ? even.before : even.behind;
    const double      begin = is_before ? fold.from : fold.corner, end = is_before ? fold.corner : fold.to;
    const double      index = (s - begin) / (end - begin) * (at.size() - 1);
    const std::size_t i     = std::min<std::size_t>(at.size() - 2, std::max(0., std::floor(index)));
    const double      of    = at[i] + (index - i) * (at[i + 1] - at[i]);
    return Place(place(of) + fold.thickness * across(of));
  }



  Place
  AirfoilOutline::inwards(const double s) const
  {
    for (const EvenFold &even : folds)
      if (s > even.fold.from && s < even.fold.to)
        return Place((of_inner_face(even, s) - place(s)) / even.fold.thickness);
    return across(s);
  }



  void
  AirfoilMesh::fail_at_fold(const Strip &strip, const double tightest) const
  {
    const double radius = 1 / outline->curvature(tightest);
    unsigned int ply    = 0;
    for (double sum = 0; ply < strip.wall.size() && sum < radius; ++ply)
      sum += strip.wall[ply].thickness;
    const auto wanted = outline->find_fold(begin, end, tightest, strip.thickness);
    fail("the skin is " + number_to_text("%.4g", strip.thickness) + " m thick " + at_x(tightest) +
           ", where the radius of the outline, " + number_to_text("%.4g", radius) + " m, is within ply " +
           std::to_string(ply) + " of " + std::to_string(strip.wall.size()) + ", so that its inner face folds. " +
           (wanted.part < AirfoilOutline::least_part ?
              "There is no room for that: let it be thinner" :
              "Let it be thinner, or one skin without webs from " + at_x(wanted.from).substr(3) + " to " +
                at_x(wanted.to).substr(3)),
         outline->place(tightest));
  }



  bool
  AirfoilMesh::add_fold_of(const Strip &strip, std::vector<Strip> &pieces)
  {
    // what is left of the radius on the inner face; that cells there have an area the mesh finds out
    constexpr double       least_left = 1e-3;
    constexpr unsigned int n          = 400; // in a strip: splines of points turn sharply between them
    double                 tightest   = 0.5 * (strip.a + strip.b);
    for (unsigned int i = 0; i <= n; ++i)
      {
        const double s = strip.a + (strip.b - strip.a) * (i + 0.5) / (n + 1);
        if (outline->curvature(s) > outline->curvature(tightest))
          tightest = s;
      }
    if (strip.thickness * outline->curvature(tightest) <= 1 - least_left)
      return false;
    const auto fold = outline->find_fold(strip.a, strip.b, tightest, strip.thickness);
    if (fold.part < AirfoilOutline::least_part)
      fail_at_fold(strip, tightest);
    const auto leaning = std::make_shared<AirfoilOutline>(*outline);
    leaning->add_fold(fold);
    outline = leaning;
    // beside it there may be others
    const auto piece = [&](const double a, const double b, const bool is_done) {
      Strip result = strip;
      result.a     = a;
      result.b     = b;
      if (b > a && (is_done || !add_fold_of(result, pieces)))
        pieces.push_back(result);
    };
    piece(strip.a, fold.from, false);
    piece(fold.from, fold.corner, true);
    piece(fold.corner, fold.to, true);
    piece(fold.to, strip.b, false);
    return true;
  }



  void
  AirfoilMesh::add_folds()
  {
    std::vector<Strip> pieces;
    for (const Strip &strip : strips)
      if (!add_fold_of(strip, pieces))
        pieces.push_back(strip);
    strips = pieces;
  }
} // namespace samara
