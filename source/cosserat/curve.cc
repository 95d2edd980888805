#include <samara/cosserat/curve.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    Matrix3
    first_triad(const Vector3 &tangent, const Vector3 &near_axis_2)
    {
      if (!near_axis_2.isZero(0.))
        return triad(tangent, near_axis_2);
      const Vector3 horizontal = Vector3::UnitZ().cross(tangent.normalized());
      return triad(tangent, horizontal.norm() > 1e-6 ? horizontal : Vector3(Vector3::UnitY()));
    }

    /** The smallest rotation that takes the first axis of @p D to the direction @p tangent. */
    Matrix3
    carried(const Matrix3 &D, const Vector3 &tangent)
    {
      const Vector3 t = tangent.normalized();
      return Eigen::Quaterniond::FromTwoVectors(D.col(0), t).toRotationMatrix() * D;
    }



    class Polyline : public Curve
    {
    public:
      Polyline(const std::vector<Vector3> &points, const Vector3 &near_axis_2)
        : points(points)
        , ends(1, 0.)
      {
        if (points.size() < 2)
          throw std::invalid_argument("a polyline needs at least two points");
        for (unsigned int i = 0; i + 1 < points.size(); ++i)
          {
            const Vector3 side = points[i + 1] - points[i];
            if (side.norm() == 0.)
              throw std::invalid_argument("points " + std::to_string(i + 1) + " and " + std::to_string(i + 2) +
                                          " are the same");
            triads.push_back(i == 0 ? first_triad(side, near_axis_2) : carried(triads.back(), side));
            ends.push_back(ends.back() + side.norm());
          }
      }

      double
      length() const override
      {
        return ends.back();
      }

      Vector3
      position(const double s) const override
      {
        const unsigned int i = side_of(s);
        return points[i] + (s - ends[i]) / (ends[i + 1] - ends[i]) * (points[i + 1] - points[i]);
      }

      Matrix3
      triad(const double, const double inside) const override
      {
        return triads[side_of(inside)];
      }

      std::vector<double>
      corners() const override
      {
        return {ends.begin() + 1, ends.end() - 1};
      }

    private:
      std::vector<Vector3> points;
      std::vector<double>  ends; // arc lengths of the points
      std::vector<Matrix3> triads; // of the sides

      unsigned int
      side_of(const double s) const
      {
        const auto next = std::upper_bound(ends.begin() + 1, ends.end() - 1, s);
        return next - ends.begin() - 1;
      }
    };



    class Arc : public Curve
    {
    public:
      Arc(const std::vector<Vector3> &points, const Vector3 &near_axis_2)
      {
        if (points.size() != 3)
          throw std::invalid_argument("an arc is given by three points: start, one in between, end");
        const Vector3 a = points[1] - points[0], b = points[2] - points[0], n = a.cross(b);
        if (n.norm() < 1e-12 * a.norm() * b.norm())
          throw std::invalid_argument("the three points of an arc must not lie on a line");
        axis   = n.normalized();
        centre = points[0] + (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) / (2 * n.squaredNorm());
        arm    = points[0] - centre;
        const Vector3 last = points[2] - centre;
        angle              = std::atan2(axis.dot(arm.cross(last)), arm.dot(last));
        if (angle <= 0)
          angle += 2 * M_PI;
        start = first_triad(axis.cross(arm), near_axis_2);
      }

      double
      length() const override
      {
        return arm.norm() * angle;
      }

      Vector3
      position(const double s) const override
      {
        return centre + rotation(s) * arm;
      }

      Matrix3
      triad(const double s, const double) const override
      {
        return rotation(s) * start;
      }

    private:
      Vector3 axis, centre, arm;
      double  angle;
      Matrix3 start;

      Matrix3
      rotation(const double s) const
      {
        return Eigen::AngleAxisd(s / arm.norm(), axis).toRotationMatrix();
      }
    };



    /**
     * A curve by expressions, sampled finely once: arc length by Gauss quadrature between samples, triads carried along
     * by double reflection (Wang, Jüttler, Zheng, Liu 2008), which is of fourth order in the distance of samples. At
     * corners, where the tangent jumps, there are samples, too.
     */
    class ExpressionCurve : public Curve
    {
    public:
      ExpressionCurve(const std::array<Expression, 3> &expressions, const Vector3 &near_axis_2)
        : expressions(expressions)
      {
        find_samples();
        const unsigned int n = samples.size() - 1;
        arc_length.assign(n + 1, 0.);
        triads.push_back(first_triad(tangent(0., 0), near_axis_2));
        for (unsigned int i = 0; i < n; ++i)
          {
            arc_length[i + 1] = arc_length[i] + distance(samples[i], samples[i + 1]);
            triads.push_back(reflected(i, samples[i + 1]));
            if (is_corner(i + 1))
              triads.back() = carried(triads.back(), tangent(samples[i + 1], i + 1));
          }
        if (!(arc_length.back() > 0))
          throw std::invalid_argument("the expressions do not describe a curve: its length is not positive");
      }

      double
      length() const override
      {
        return arc_length.back();
      }

      Vector3
      position(const double s) const override
      {
        return at(parameter(s, interval_of(s)));
      }

      Matrix3
      triad(const double s, const double inside) const override
      {
        const unsigned int i = interval_of(s + 1e-9 * (inside - s));
        return reflected(i, parameter(s, i));
      }

      std::vector<double>
      corners() const override
      {
        std::vector<double> result;
        for (unsigned int i = 1; i + 1 < samples.size(); ++i)
          if (is_corner(i))
            result.push_back(arc_length[i]);
        return result;
      }

    private:
      std::array<Expression, 3> expressions;
      std::vector<double>       samples, corner_parameters, arc_length;
      std::vector<Matrix3>      triads; // of samples; at corners of the side beyond

      void
      find_samples()
      {
        constexpr unsigned int n = 1000;
        for (unsigned int i = 0; i <= n; ++i)
          samples.push_back(double(i) / n);
        const auto next = [&](const double from) {
          return std::min({expressions[0].next_corner(from, 1.),
                           expressions[1].next_corner(from, 1.),
                           expressions[2].next_corner(from, 1.)});
        };
        for (double u = next(0.); u < 1.; u = next(u))
          {
            const double  beside = 1e-9;
            const Vector3 before = derivative(u - beside), after = derivative(u + beside);
            if ((before.normalized() - after.normalized()).norm() > 1e-6)
              corner_parameters.push_back(u);
            if (corner_parameters.size() > n)
              throw std::invalid_argument("the curve has more than 1000 corners");
          }
        samples.insert(samples.end(), corner_parameters.begin(), corner_parameters.end());
        std::sort(samples.begin(), samples.end());
        // of two samples that are nearly one, the corner stays
        const auto is_double = [&](const unsigned int i) {
          const auto near = [&](const unsigned int j) { return is_corner(j) && std::abs(samples[j] - samples[i]) < 1e-9; };
          return (i > 0 && near(i - 1)) || (!is_corner(i) && i + 1 < samples.size() && near(i + 1));
        };
        std::vector<double> kept;
        for (unsigned int i = 0; i < samples.size(); ++i)
          if (!is_double(i))
            kept.push_back(samples[i]);
        samples = kept;
      }

      bool
      is_corner(const unsigned int i) const
      {
        return std::binary_search(corner_parameters.begin(), corner_parameters.end(), samples[i]);
      }

      /** The interval between samples in which an arc length lies. */
      unsigned int
      interval_of(const double s) const
      {
        return std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, s) - arc_length.begin() - 1;
      }

      Vector3
      at(const double u) const
      {
        return {expressions[0](u), expressions[1](u), expressions[2](u)};
      }

      Vector3
      derivative(const double u) const
      {
        return {expressions[0].derivative(u), expressions[1].derivative(u), expressions[2].derivative(u)};
      }

      /** The direction at @p u seen from within the interval @p i. */
      Vector3
      tangent(const double u, const unsigned int i) const
      {
        const bool begins = i < samples.size() && is_corner(i) && u - samples[i] < 1e-9,
                   ends   = i + 1 < samples.size() && is_corner(i + 1) && samples[i + 1] - u < 1e-9;
        return derivative(begins ? samples[i] + 1e-9 : ends ? samples[i + 1] - 1e-9 : u);
      }

      /** Arc length between two parameters, by the four-point Gauss rule. */
      double
      distance(const double a, const double b) const
      {
        static const double x[] = {0.339981043584856, 0.861136311594053}, w[] = {0.652145154862546, 0.347854845137454};
        double              sum = 0;
        for (unsigned int k = 0; k < 2; ++k)
          for (const int sign : {-1, 1})
            sum += w[k] * derivative(0.5 * (a + b) + sign * x[k] * 0.5 * (b - a)).norm();
        return 0.5 * (b - a) * sum;
      }

      /** Of the arc length @p s in the interval @p i. */
      double
      parameter(const double s, const unsigned int i) const
      {
        const double a = samples[i], b = samples[i + 1];
        double       u = a + (s - arc_length[i]) / (arc_length[i + 1] - arc_length[i]) * (b - a);
        for (unsigned int iteration = 0; iteration < 3; ++iteration)
          u -= (arc_length[i] + distance(a, u) - s) / tangent(u, i).norm();
        return std::min(is_corner(i + 1) ? b : 1., std::max(is_corner(i) ? a : 0., u));
      }

      /** The triad at the parameter @p u, which lies in the interval @p i. */
      Matrix3
      reflected(const unsigned int i, const double u) const
      {
        const Matrix3 &D     = triads[i];
        const Vector3  chord = at(u) - at(samples[i]), t = tangent(u, i).normalized();
        if (chord.norm() < 1e-14)
          return carried(D, t);
        const auto    mirror = [](const Vector3 &v, const Vector3 &n) { return Vector3(v - 2 * n.dot(v) / n.dot(n) * n); };
        const Vector3 d2 = mirror(D.col(1), chord), t_mirrored = mirror(D.col(0), chord), n = t - t_mirrored;
        return samara::triad(t, n.norm() < 1e-14 ? d2 : mirror(d2, n));
      }
    };
  } // namespace



  std::unique_ptr<Curve>
  make_polyline(const std::vector<Vector3> &points, const Vector3 &near_axis_2)
  {
    return std::make_unique<Polyline>(points, near_axis_2);
  }

  std::unique_ptr<Curve>
  make_arc(const std::vector<Vector3> &points, const Vector3 &near_axis_2)
  {
    return std::make_unique<Arc>(points, near_axis_2);
  }

  std::unique_ptr<Curve>
  make_expression_curve(const std::array<Expression, 3> &position, const Vector3 &near_axis_2)
  {
    return std::make_unique<ExpressionCurve>(position, near_axis_2);
  }
} // namespace samara
