#include <samara/base/text.h>
#include <samara/section/airfoil_outline.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    using Place = dealii::Point<2>;

    double
    cross_of(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /** Angle from a to b, counter-clockwise. */
    double
    angle_between(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
    {
      return std::atan2(cross_of(a, b), a * b);
    }



    /** Points that are given twice are one; what belongs to a blunt trailing edge is cut off. */
    void
    clean(std::vector<Place> &points)
    {
      constexpr double   same = 1e-9;
      std::vector<Place> result;
      for (const Place &x : points)
        if (result.empty() || x.distance(result.back()) > same)
          result.push_back(x);
      // some files go round the trailing edge, too: there the way turns sharply
      constexpr double sharply = 60 * M_PI / 180;
      const auto       turns   = [&](const std::size_t i) {
        return result.size() > 4 && result[i][0] > 0.9 &&
               std::abs(angle_between(result[i] - result[i - 1], result[i + 1] - result[i])) > sharply;
      };
      while (result.size() > 4 && turns(1))
        result.erase(result.begin());
      while (result.size() > 4 && turns(result.size() - 2))
        result.pop_back();
      points = result;
    }



    /** Upper and lower side of the trailing edge meet when they are nearer than this [1]. */
    constexpr double closed_below = 1e-4;

    void
    close_if_nearly(std::vector<Place> &points)
    {
      const double gap = points.back()[1] - points.front()[1];
      if (std::abs(gap) > closed_below)
        return;
      const std::size_t nose =
        std::min_element(points.begin(), points.end(), [](const Place &a, const Place &b) { return a[0] < b[0]; }) -
        points.begin();
      for (std::size_t i = 0; i < points.size(); ++i)
        points[i][1] += (i < nose ? 0.5 : -0.5) * gap * points[i][0] / points.back()[0];
      points.back() = points.front();
    }
  } // namespace



  PlaneSpline::PlaneSpline(const std::vector<Place> &points)
    : s(1, 0.)
    , x(points)
    , second(points.size())
  {
    const std::size_t n = x.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      s.push_back(s.back() + x[i].distance(x[i + 1]));
    if (n < 3)
      return;
    // second derivatives m: h₀ m₀ + 2 (h₀ + h₁) m₁ + h₁ m₂ = 6 (slope₁ − slope₀); m₀ = m₁ at the ends
    std::vector<double> upper(n, 0.);
    std::vector<Place>  right(n);
    for (std::size_t i = 1; i + 1 < n; ++i)
      {
        const double h0 = s[i] - s[i - 1], h1 = s[i + 1] - s[i];
        const Place  jump(6 * ((x[i + 1] - x[i]) / h1 - (x[i] - x[i - 1]) / h0));
        const double diagonal = 2 * (h0 + h1) + (i == 1 ? h0 : 0) + (i + 2 == n ? h1 : 0);
        const double pivot    = diagonal - (i == 1 ? 0 : h0 * upper[i - 1]);
        upper[i]              = h1 / pivot;
        right[i]              = Place((jump - (i == 1 ? 0 : h0) * right[i - 1]) / pivot);
      }
    for (std::size_t i = n - 2; i >= 1; --i)
      second[i] = i + 2 == n ? right[i] : Place(right[i] - upper[i] * second[i + 1]);
    second.front() = second[1];
    second.back()  = second[n - 2];
  }



  Place
  PlaneSpline::at(const double at, const unsigned int order) const
  {
    const auto i =
      std::min<std::size_t>(std::max<std::ptrdiff_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin(), 1),
                            s.size() - 1) -
      1;
    const double h = s[i + 1] - s[i], b = (at - s[i]) / h, a = 1 - b;
    if (order == 0)
      return Place(a * x[i] + b * x[i + 1] +
                   h * h / 6 * ((a * a * a - a) * second[i] + (b * b * b - b) * second[i + 1]));
    if (order == 1)
      return Place((x[i + 1] - x[i]) / h + h / 6 * ((1 - 3 * a * a) * second[i] + (3 * b * b - 1) * second[i + 1]));
    return Place(a * second[i] + b * second[i + 1]);
  }



  AirfoilOutline::AirfoilOutline(std::vector<Place> points, const double chord, const double origin)
    : chord(chord)
    , origin(origin)
  {
    clean(points);
    if (points.size() < 8)
      throw std::invalid_argument("an airfoil needs eight points at least");
    const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const Place &a, const Place &b) { return a[0] < b[0]; });
    if (std::abs((*low)[0]) > 0.02 || std::abs(points.front()[0] - 1) > 0.02 || std::abs(points.back()[0] - 1) > 0.02 ||
        (*high)[0] > 1.02)
      throw std::invalid_argument(
        "coordinates of an airfoil are fractions of its chord, from the trailing edge at x = 1 to the nose at x = 0 and "
        "back; these begin at " +
        number_to_text("%.6g", points.front()[0]) + ", have their smallest at " + number_to_text("%.6g", (*low)[0]) +
        " and end at " + number_to_text("%.6g", points.back()[0]));
    // along the lower side first: then the area is on the right here, and on the left where the nose is at +2
    double area = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      area += 0.5 * cross_of(points[i], points[(i + 1) % points.size()]);
    if (area > 0)
      std::reverse(points.begin(), points.end());
    close_if_nearly(points);

    std::vector<Place> y;
    for (const Place &p : points)
      y.emplace_back((origin - p[0]) * chord, p[1] * chord);
    constexpr double   kink = 30 * M_PI / 180, edge = 100 * M_PI / 180, of_nose = 0.05;
    std::vector<Place> piece(1, y.front());
    starts.push_back(0);
    for (std::size_t i = 1; i < y.size(); ++i)
      {
        piece.push_back(y[i]);
        const bool   is_last = i + 1 == y.size();
        const double angle   = is_last ? 0 : angle_between(y[i] - y[i - 1], y[i + 1] - y[i]);
        if (std::abs(angle) > edge)
          throw std::invalid_argument("the airfoil has a sharp edge at x/c = " + number_to_text("%.4g", points[i][0]) +
                                      ": only the trailing edge may be one");
        if (is_last || (std::abs(angle) > kink && points[i][0] > of_nose))
          {
            pieces.emplace_back(piece);
            piece.assign(1, y[i]);
            if (!is_last)
              {
                starts.push_back(starts.back() + pieces.back().length());
                ends_within.push_back(starts.back());
                turn.push_back(std::tan(angle / 2));
              }
          }
      }
    find_nose();
    check();
  }



  unsigned int
  AirfoilOutline::piece_at(const double s) const
  {
    return std::upper_bound(starts.begin() + 1, starts.end(), s) - starts.begin() - 1;
  }



  double
  AirfoilOutline::length() const
  {
    return starts.back() + pieces.back().length();
  }



  Place
  AirfoilOutline::place(const double s) const
  {
    const unsigned int i = piece_at(s);
    return pieces[i].at(s - starts[i]);
  }



  Place
  AirfoilOutline::across(const double s) const
  {
    const unsigned int i     = piece_at(s);
    const Place        slope = pieces[i].at(s - starts[i], 1);
    const Place        tangent(slope / slope.norm());
    Place              result(-tangent[1], tangent[0]);
    // towards a kink depth leans to its bisector, over a length of some per cents of the chord
    const double reach = 0.05 * chord, own = pieces[i].length();
    const auto   near = [&](const double distance) { return std::max(0., 1 - distance / std::min(reach, own)); };
    if (i > 0)
      result += turn[i - 1] * near(s - starts[i]) * tangent;
    if (i < turn.size())
      result += -turn[i] * near(starts[i + 1] - s) * tangent;
    return result;
  }



  double
  AirfoilOutline::curvature(const double s) const
  {
    const unsigned int i = piece_at(s);
    const Place        d = pieces[i].at(s - starts[i], 1), dd = pieces[i].at(s - starts[i], 2);
    return cross_of(d, dd) / std::pow(d.norm(), 3);
  }



  double
  AirfoilOutline::x_of(const Place &place) const
  {
    return origin - place[0] / chord;
  }



  void
  AirfoilOutline::find_nose()
  {
    // where x is smallest: among samples, then by halving the slope
    const double       total = length();
    const unsigned int n     = 2000;
    unsigned int       best  = 0;
    for (unsigned int i = 1; i < n; ++i)
      if (x_of(place(total * i / n)) < x_of(place(total * best / n)))
        best = i;
    double a = total * (best - 1.) / n, b = total * (best + 1.) / n;
    for (unsigned int k = 0; k < 60; ++k)
      {
        const double       m                            = 0.5 * (a + b);
        const unsigned int i                            = piece_at(m);
        (pieces[i].at(m - starts[i], 1)[0] > 0 ? a : b) = m;
      }
    s_nose = 0.5 * (a + b);
  }



  double
  AirfoilOutline::at(const bool upper, const double x) const
  {
    double near = s_nose, far = upper ? length() : 0;
    if (x >= x_of(place(far)))
      return far;
    for (unsigned int k = 0; k < 60; ++k)
      {
        const double m                    = 0.5 * (near + far);
        (x_of(place(m)) < x ? near : far) = m;
      }
    return 0.5 * (near + far);
  }



  double
  AirfoilOutline::trailing_edge() const
  {
    const double gap = place(length()).distance(place(0));
    return gap > 0.5 * closed_below * chord ? gap : 0;
  }



  void
  AirfoilOutline::check() const
  {
    const unsigned int n = 400;
    for (const bool upper : {false, true})
      {
        const double end  = upper ? length() : 0;
        double       last = x_of(place(s_nose));
        for (unsigned int i = 1; i <= n; ++i)
          {
            const double x = x_of(place(s_nose + (end - s_nose) * i / n));
            if (x < last - 1e-4)
              throw std::invalid_argument(std::string("the ") + (upper ? "upper" : "lower") +
                                          " side of the airfoil turns back at x/c = " + number_to_text("%.4g", x));
            last = x;
          }
      }
    for (unsigned int i = 1; i < n; ++i)
      {
        const double x = double(i) / n;
        if (place(at(true, x))[1] <= place(at(false, x))[1])
          throw std::invalid_argument("the sides of the airfoil cross: at x/c = " + number_to_text("%.4g", x) +
                                      " the upper one is not above the lower one");
      }
  }
} // namespace samara
