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
     * by double reflection (Wang, Jüttler, Zheng, Liu 2008), which is of fourth order in the distance of samples.
     */
    class ExpressionCurve : public Curve
    {
    public:
      ExpressionCurve(const std::array<Expression, 3> &expressions, const Vector3 &near_axis_2)
        : expressions(expressions)
        , arc_length(n_samples + 1, 0.)
        , triads(n_samples + 1)
      {
        triads[0] = first_triad(derivative(0.), near_axis_2);
        for (unsigned int i = 0; i < n_samples; ++i)
          {
            const double a = double(i) / n_samples, b = double(i + 1) / n_samples;
            arc_length[i + 1] = arc_length[i] + distance(a, b);
            triads[i + 1]     = reflected(triads[i], a, b);
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
        return at(parameter(s));
      }

      Matrix3
      triad(const double s, const double) const override
      {
        const double       u = parameter(s);
        const unsigned int i = std::min(n_samples, static_cast<unsigned int>(u * n_samples));
        return reflected(triads[i], double(i) / n_samples, u);
      }

    private:
      static constexpr unsigned int n_samples = 1000;
      std::array<Expression, 3>     expressions;
      std::vector<double>           arc_length;
      std::vector<Matrix3>          triads;

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

      double
      parameter(const double s) const
      {
        const auto         next = std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, s);
        const unsigned int i    = next - arc_length.begin() - 1;
        const double       a    = double(i) / n_samples;
        double             u    = a + (s - arc_length[i]) / (arc_length[i + 1] - arc_length[i]) / n_samples;
        for (unsigned int iteration = 0; iteration < 3; ++iteration)
          u -= (arc_length[i] + distance(a, u) - s) / derivative(u).norm();
        return std::min(1., std::max(0., u));
      }

      Matrix3
      reflected(const Matrix3 &D, const double a, const double b) const
      {
        const Vector3 chord = at(b) - at(a), t = derivative(b).normalized();
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
