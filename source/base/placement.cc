#include <samara/base/placement.h>

#include <cmath>

namespace samara
{
  Eigen::Vector3d
  Placement::point(const Eigen::Vector3d &x) const
  {
    return origin + rotation * x;
  }



  Placement
  Placement::of(const Placement &inner) const
  {
    return {without_round_off(rotation * inner.rotation), point(inner.origin)};
  }



  bool
  Placement::is_identity() const
  {
    return rotation == Eigen::Matrix3d::Identity() && origin.isZero(0.);
  }



  Eigen::Matrix3d
  Placement::without_round_off(const Eigen::Matrix3d &R)
  {
    return R.unaryExpr([](const double r) { return std::abs(r - std::round(r)) < 1e-15 ? std::round(r) + 0. : r; });
  }



  Eigen::Matrix3d
  Placement::turn(const Eigen::Vector3d &axis, const double angle)
  {
    return without_round_off(Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix());
  }
} // namespace samara
