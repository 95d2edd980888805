#ifndef samara_cosserat_curve_h
#define samara_cosserat_curve_h

#include <samara/base/function_of_time.h>
#include <samara/rotation/rotation.h>

#include <array>
#include <memory>
#include <vector>

namespace samara
{
  /**
   * The reference line of a beam by its arc length s [m], with a triad: d₁ the tangent, d₂ and d₃ carried along without
   * turning about the tangent.
   */
  class Curve
  {
  public:
    virtual ~Curve() = default;

    virtual double  length() const            = 0;
    virtual Vector3 position(double s) const = 0;

    /** Triad at s; where the line has a corner, the one of the side on which @p inside lies. */
    virtual Matrix3 triad(double s, double inside) const = 0;

    /** Arc lengths of corners, where an element must end; without the ends. */
    virtual std::vector<double>
    corners() const
    {
      return {};
    }
  };

  /**
   * @name The kinds of curves
   * @p near_axis_2 says in which half plane d₂ lies at the start; if zero, d₂ is horizontal (along z × d₁), or along y
   * where d₁ is vertical.
   * All throw std::invalid_argument if the points do not make a curve.
   * @{
   */
  std::unique_ptr<Curve> make_polyline(const std::vector<Vector3> &points, const Vector3 &near_axis_2);

  /** A circular arc from the first through the second to the third point. */
  std::unique_ptr<Curve> make_arc(const std::vector<Vector3> &points, const Vector3 &near_axis_2);

  /** x(s), y(s), z(s) for a parameter s from 0 to 1. */
  std::unique_ptr<Curve> make_expression_curve(const std::array<Expression, 3> &position, const Vector3 &near_axis_2);
  /** @} */
} // namespace samara

#endif
