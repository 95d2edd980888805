#include <samara/rotation/rotation.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <stdexcept>

namespace samara
{
  Vector3
  inverse_cayley(const Matrix3 &R)
  {
    Assert(!(R.trace() < -1 + 1e-12), dealii::ExcMessage("A half turn has no Cayley vector."));
    return 4. / (1. + R.trace()) * axial(R);
  }



  Matrix3
  rotation_of_vector(const Vector3 &r)
  {
    const double angle = r.norm();
    if (angle < 1e-8)
      return cayley<double>(r);
    return cayley<double>(Vector3(2. * std::tan(angle / 2.) / angle * r));
  }



  Vector3
  vector_of_rotation(const Matrix3 &R)
  {
    Assert(!((R.transpose() * R - Matrix3::Identity()).norm() > 1e-6), dealii::ExcMessage("This is no rotation."));
    const Eigen::Quaterniond q(R);
    const double             sign = q.w() < 0 ? -1. : 1., sine = q.vec().norm();
    if (sine < 1e-12)
      return 2. * sign * q.vec();
    return 2. * std::atan2(sine, sign * q.w()) / sine * sign * q.vec();
  }



  namespace
  {
    Eigen::Vector3i
    axes_of(const std::string &sequence)
    {
      const auto digit = [](const char c) { return c >= '1' && c <= '3'; };
      if (sequence.size() != 3 || !digit(sequence[0]) || !digit(sequence[1]) || !digit(sequence[2]) ||
          sequence[0] == sequence[1] || sequence[1] == sequence[2])
        throw std::invalid_argument("<" + sequence +
                                    "> is not a sequence of rotation axes; write three digits such as 321 or 313");
      return {sequence[0] - '1', sequence[1] - '1', sequence[2] - '1'};
    }
  } // namespace



  Vector3
  angles_of_rotation(const Matrix3 &R, const std::string &sequence)
  {
    const Eigen::Vector3i a = axes_of(sequence);
    Vector3               angles = R.eulerAngles(a(0), a(1), a(2));
    // Eigen keeps the first angle in [0, π]; engineers expect the middle one of three different axes within ±90°
    if (a(0) != a(2) && std::abs(angles(1)) > M_PI / 2)
      angles = Vector3(angles(0) + M_PI, M_PI - angles(1), angles(2) + M_PI);
    return angles.unaryExpr([](const double angle) { return std::remainder(angle, 2 * M_PI); });
  }



  Matrix3
  rotation_of_angles(const Vector3 &angles, const std::string &sequence)
  {
    const Eigen::Vector3i a = axes_of(sequence);
    Matrix3               R = Matrix3::Identity();
    for (unsigned int i = 0; i < 3; ++i)
      R = R * Eigen::AngleAxisd(angles(i), Vector3::Unit(a(i))).toRotationMatrix();
    return R;
  }



  Matrix3
  renormalised(const Matrix3 &R)
  {
    return R * (1.5 * Matrix3::Identity() - 0.5 * R.transpose() * R);
  }



  Matrix3
  triad(const Vector3 &axis_1, const Vector3 &near_axis_2)
  {
    Matrix3       D;
    const Vector3 d1 = axis_1.normalized(), normal = d1.cross(near_axis_2);
    if (normal.norm() < 1e-10 * near_axis_2.norm() || normal.norm() == 0.)
      throw std::invalid_argument("the two axes that should span a triad are parallel");
    D.col(0) = d1;
    D.col(2) = normal.normalized();
    D.col(1) = D.col(2).cross(d1);
    return D;
  }



  Matrix3
  triad_about(const Vector3 &axis_3, const Vector3 &near_axis_1)
  {
    const Vector3 e3 = axis_3.normalized();
    Vector3       e1 = near_axis_1 - near_axis_1.dot(e3) * e3;
    if (e1.norm() < 1e-10 * (1. + near_axis_1.norm()))
      {
        // the coordinate axis that is most nearly normal to e3
        Vector3::Index k;
        e3.cwiseAbs().minCoeff(&k);
        e1 = Vector3::Unit(k) - e3(k) * e3;
      }
    Matrix3 D;
    D.col(2) = e3;
    D.col(0) = e1.normalized();
    D.col(1) = e3.cross(D.col(0));
    return D;
  }



  Matrix6
  ad(const Vector6 &y)
  {
    Matrix6 A             = Matrix6::Zero();
    A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = skew(y.tail<3>());
    A.topRightCorner<3, 3>()                              = skew(y.head<3>());
    return A;
  }



  Matrix6
  gyroscopic_tangent(const Matrix6 &M, const Vector6 &y)
  {
    // −ad*_y p = (Ω×l, Ω×a + v×l) with p = (l, a) = M y; first the part that varies y at fixed p, then −ad*_y δp
    const Vector6 p = M * y;
    Matrix6       A = Matrix6::Zero();
    A.topRightCorner<3, 3>() = A.bottomLeftCorner<3, 3>() = -skew(p.head<3>());
    A.bottomRightCorner<3, 3>()                           = -skew(p.tail<3>());
    return A + ad(y).transpose() * -M;
  }



  Matrix6
  twist_transfer(const Vector3 &r, const Matrix3 &Q)
  {
    Matrix6 T                 = Matrix6::Zero();
    T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() = Q.transpose();
    T.topRightCorner<3, 3>()                              = -Q.transpose() * skew(r);
    return T;
  }
} // namespace samara
