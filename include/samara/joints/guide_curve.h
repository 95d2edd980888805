#ifndef samara_joints_guide_curve_h
#define samara_joints_guide_curve_h

#include <samara/base/function_of_time.h>
#include <samara/rotation/rotation.h>

#include <array>
#include <complex>
#include <vector>

namespace samara
{
  /**
   * A smooth curve x(s), y(s), z(s), s from 0 to 1, by its arc length σ [m]: a point with its first two derivatives.
   * Arc lengths are integrated by Gauss's rule between a thousand samples. A curve whose ends meet without a corner is
   * closed: σ may go round any number of times; others go on straight beyond their ends.
   */
  class GuideCurve
  {
  public:
    /** @throws std::invalid_argument if the expressions have a corner, stand still, or are no curve. */
    explicit GuideCurve(const std::array<Expression, 3> &expressions);

    struct At
    {
      Vector3 x;         ///< [m]
      Vector3 tangent;   ///< dx/dσ, of unit length
      Vector3 curvature; ///< d²x/dσ² [1/m]
    };
    At at(double sigma) const;

    double
    length() const
    {
      return arc_lengths.back();
    }

    /** Arc length of the point nearest to @p x. */
    double nearest(const Vector3 &x) const;

  private:
    std::array<Expression, 3> expressions;
    std::vector<double>       arc_lengths; ///< at the samples
    bool                      closed = false;

    Vector3 position(double s) const;
    Vector3 derivative(double s) const;
    Vector3 second_derivative(double s) const;
    double  distance(double a, double b) const;

    /** Of the arc length @p sigma on the curve. */
    double parameter(double sigma) const;
  };
} // namespace samara

#endif
