#ifndef samara_rotation_rotation_h
#define samara_rotation_rotation_h

#include <Eigen/Dense>

#include <string>

namespace samara
{
  template <typename Number>
  using Vec3 = Eigen::Matrix<Number, 3, 1>;
  template <typename Number>
  using Mat3 = Eigen::Matrix<Number, 3, 3>;
  template <typename Number>
  using Vec6 = Eigen::Matrix<Number, 6, 1>;

  using Vector3 = Vec3<double>;
  using Matrix3 = Mat3<double>;
  using Vector6 = Vec6<double>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  /**
   * @name Products that do not conjugate
   *
   * Eigen's dot() and cross() conjugate complex numbers; the complex-step check of the tangents needs the plain
   * polynomials.
   * @{
   */
  template <typename A, typename B>
  auto
  dot(const Eigen::MatrixBase<A> &a, const Eigen::MatrixBase<B> &b)
  {
    return (a.transpose() * b)(0, 0);
  }

  template <typename A, typename B>
  auto
  cross(const Eigen::MatrixBase<A> &a, const Eigen::MatrixBase<B> &b)
  {
    using Number = decltype(typename A::Scalar() * typename B::Scalar());
    return Vec3<Number>(a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0));
  }
  /** @} */

  /** Aᵀ B written out: the compiler keeps it in registers, which it does not with Eigen's product of this size. */
  inline Matrix3
  transpose_times(const Matrix3 &A, const Matrix3 &B)
  {
    Matrix3 C;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        C(i, j) = A(0, i) * B(0, j) + A(1, i) * B(1, j) + A(2, i) * B(2, j);
    return C;
  }

  /**
   * A⁻ᵀ: the axes reciprocal to the columns of @p A, d² × d³/det A and so on, written out as above. Those of a rotation
   * are its columns.
   */
  template <typename Number>
  Mat3<Number>
  reciprocal_axes(const Mat3<Number> &A)
  {
    Mat3<Number> result;
    for (int j = 0; j < 3; ++j)
      {
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        for (int i = 0; i < 3; ++i)
          {
            const int m = (i + 1) % 3, n = (i + 2) % 3;
            result(i, j) = A(m, k) * A(n, l) - A(n, k) * A(m, l);
          }
      }
    const Number factor = Number(1) / (A(0, 0) * result(0, 0) + A(1, 0) * result(1, 0) + A(2, 0) * result(2, 0));
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        result(i, j) *= factor;
    return result;
  }

  /** The matrix a~ with a~ b = a × b. */
  template <typename A>
  Mat3<typename A::Scalar>
  skew(const Eigen::MatrixBase<A> &a)
  {
    using Number = typename A::Scalar;
    Mat3<Number> s;
    s << Number(0), -a(2), a(1), a(2), Number(0), -a(0), -a(1), a(0), Number(0);
    return s;
  }

  /** The axial vector of the skew part of @p R: axial(a~) = a. */
  template <typename A>
  Vec3<typename A::Scalar>
  axial(const Eigen::MatrixBase<A> &R)
  {
    return 0.5 * Vec3<typename A::Scalar>(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  }

  /** Cayley map cay(r) = I + (r~ + ½ r~r~)/(1 + |r|²/4): a rotation by 2 atan(|r|/2) about r. */
  template <typename Number>
  Mat3<Number>
  cayley(const Vec3<Number> &r)
  {
    const Mat3<Number> s = skew(r);
    return Mat3<Number>::Identity() + (s + Number(0.5) * s * s) / (Number(1) + Number(0.25) * dot(r, r));
  }

  /** Inverse of cayley(); R must not be a half turn. */
  Vector3 inverse_cayley(const Matrix3 &R);

  /** Rotation by |r| [rad] about r. */
  Matrix3 rotation_of_vector(const Vector3 &r);

  /** The rotation vector [rad] of R, of length at most π. */
  Vector3 vector_of_rotation(const Matrix3 &R);

  /**
   * Angles [rad] of R = R_a(φ₁) R_b(φ₂) R_c(φ₃) for a sequence such as "321" or "123" (each rotation about the axis
   * that the ones before have turned).
   * @throws std::invalid_argument if @p sequence is not of three digits 1..3 with neighbours different.
   */
  Vector3 angles_of_rotation(const Matrix3 &R, const std::string &sequence);

  /** The rotation of three angles [rad] in the named sequence; inverse of angles_of_rotation(). */
  Matrix3 rotation_of_angles(const Vector3 &angles, const std::string &sequence);

  /** Nearest orthonormal triad, against round-off only (one Newton step of the polar decomposition). */
  Matrix3 renormalised(const Matrix3 &R);

  /** A triad whose first axis is along @p axis_1 and whose second lies in the plane of it and @p near_axis_2. */
  Matrix3 triad(const Vector3 &axis_1, const Vector3 &near_axis_2);

  /** The triad with third axis along @p axis_3 and first axis nearest to @p near_axis_1 (any when zero). */
  Matrix3 triad_about(const Vector3 &axis_3, const Vector3 &near_axis_1 = Vector3::Zero());

  /**
   * @name Twists y = (v, Ω) in a frame of their own
   * ad_y ζ = (Ω×u + v×θ, Ω×θ) and its transpose ad*_y p = (−Ω×p_lin, −Ω×p_ang − v×p_lin).
   * @{
   */
  Matrix6 ad(const Vector6 &y);

  template <typename Number>
  Vec6<Number>
  ad_star(const Vec6<Number> &y, const Vec6<Number> &p)
  {
    const Vec3<Number> v = y.template head<3>(), w = y.template tail<3>(), l = p.template head<3>(),
                       a = p.template tail<3>();
    Vec6<Number> result;
    result << -cross(w, l), -cross(w, a) - cross(v, l);
    return result;
  }

  /** The matrix A with A δy = −δ(ad*_y M y): how the gyroscopic force changes with the twist. */
  Matrix6 gyroscopic_tangent(const Matrix6 &M, const Vector6 &y);

  /**
   * How a twist is seen at a point of the same rigid body: a frame at arm @p r with axes @p Q (both in the first
   * frame) moves with the twist T y, T = [Qᵀ, −Qᵀr~; 0, Qᵀ]; forces return by Tᵀ.
   */
  Matrix6 twist_transfer(const Vector3 &r, const Matrix3 &Q);
  /** @} */
} // namespace samara

#endif
