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

    // Products are written out: the compiler keeps them in registers, which it does not with Eigen's of this size.

    template <typename Number>
    Vec3<Number>
    position(const Number *q) const
    {
      const Number *const n = q + 12 * node;
      Vec3<Number>        x;
      for (int i = 0; i < 3; ++i)
        x(i) = n[i] + n[3 + i] * arm(0) + n[6 + i] * arm(1) + n[9 + i] * arm(2);
      return x;
    }

    template <typename Number>
    Mat3<Number>
    triad(const Number *q) const
    {
      const Number *const D = q + 12 * node + 3;
      Mat3<Number>        E;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          E(i, j) = D[i] * rotation(0, j) + D[3 + i] * rotation(1, j) + D[6 + i] * rotation(2, j);
      return E;
    }

    /** Dᵀ v: a vector [any unit] of inertial components in the axes of the node, not of the frame. */
    template <typename Number>
    Vec3<Number>
    in_node(const Number *q, const Vec3<Number> &v) const
    {
      const Number *const D = q + 12 * node + 3;
      return {D[0] * v(0) + D[1] * v(1) + D[2] * v(2),
              D[3] * v(0) + D[4] * v(1) + D[5] * v(2),
              D[6] * v(0) + D[7] * v(1) + D[8] * v(2)};
    }

    /** The frame's twist in its own axes, from the nodal twists @p y (6 a node). */
    template <typename Number>
    Vec6<Number>
    twist(const Number *y) const
    {
      const Number *const v = y + 6 * node, *const w = v + 3;
      const Vec3<Number> u(v[0] + w[1] * arm(2) - w[2] * arm(1),
                           v[1] + w[2] * arm(0) - w[0] * arm(2),
                           v[2] + w[0] * arm(1) - w[1] * arm(0));
      Vec6<Number>       result;
      for (int i = 0; i < 3; ++i)
        {
          result(i)     = rotation(0, i) * u(0) + rotation(1, i) * u(1) + rotation(2, i) * u(2);
          result(3 + i) = rotation(0, i) * w[0] + rotation(1, i) * w[1] + rotation(2, i) * w[2];
        }
      return result;
    }

    /**
     * Add a force [N], inertial components, at the origin of the frame and a moment [N m] in its own axes to the six
     * forces @p r that do work on the twist of the node.
     */
    template <typename Number>
    void
    add_force(const Number *q, const Vec3<Number> &force, const Vec3<Number> &moment, Number *r) const
    {
      const Vec3<Number> f = in_node(q, force);
      for (int i = 0; i < 3; ++i)
        {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          r[i] += f(i);
          r[3 + i] += rotation(i, 0) * moment(0) + rotation(i, 1) * moment(1) + rotation(i, 2) * moment(2) +
                      (arm(j) * f(k) - arm(k) * f(j));
        }
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
