#ifndef samara_model_frame_h
#define samara_model_frame_h

#include <samara/rotation/rotation.h>

namespace samara
{
  /**
   * A triad rigidly attached to a node: origin x + D r, axes D Q, with arm r [m] and rotation Q constant in the node's
   * frame. Frames are linear in the node's coordinates q = (x, D), so whatever is quadratic at nodes is at frames too.
   *
   * Coordinates of all nodes are kept as 12 numbers a node, x d₁ d₂ d₃.
   */
  struct Frame
  {
    unsigned int node     = 0;
    Vector3      arm      = Vector3::Zero();
    Matrix3      rotation = Matrix3::Identity();

    /** Whether the frame is the node itself. */
    bool
    is_node() const
    {
      return arm.isZero(0.) && rotation.isIdentity(0.);
    }

    template <typename Number>
    Vec3<Number>
    position(const Number *q) const
    {
      const Number *n = q + 12 * node;
      return Eigen::Map<const Vec3<Number>>(n) + Eigen::Map<const Mat3<Number>>(n + 3) * arm;
    }

    template <typename Number>
    Mat3<Number>
    triad(const Number *q) const
    {
      return Eigen::Map<const Mat3<Number>>(q + 12 * node + 3) * rotation;
    }

    /** The frame's twist in its own axes, from the nodal twists @p y (6 a node). */
    template <typename Number>
    Vec6<Number>
    twist(const Number *y) const
    {
      const Eigen::Map<const Vec3<Number>> v(y + 6 * node), w(y + 6 * node + 3);
      const Vec3<Number>                   r = arm.template cast<Number>();
      Vec6<Number>                         result;
      result << rotation.transpose() * (v + cross(Vec3<Number>(w), r)), rotation.transpose() * w;
      return result;
    }

    /** A frame at @p r with axes @p Q, both seen in this frame. */
    Frame
    then(const Vector3 &r, const Matrix3 &Q = Matrix3::Identity()) const
    {
      return {node, arm + rotation * r, rotation * Q};
    }
  };
} // namespace samara

#endif
