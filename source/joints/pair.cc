#include <samara/joints/pair.h>

namespace samara
{
  void
  PairFunction::add_second_derivative(const PairValues<double> &p, const double f, Eigen::Ref<Eigen::MatrixXd> K) const
  {
    const Matrix3 AA = p.A.transpose() * p.A, AB = p.A.transpose() * p.B, BB = p.B.transpose() * p.B,
                  ei = skew(Vector3::Unit(i)), ej = skew(Vector3::Unit(j));
    const Vector3 gap_A = p.A.transpose() * p.gap, gap_B = p.B.transpose() * p.gap;
    switch (kind)
      {
        case gap:
          K.block<3, 3>(0, 3) -= f * (skew(AA.col(i)) - AA * ei);
          K.block<3, 3>(3, 0) -= f * ei * AA;
          K.block<3, 3>(3, 3) += f * ei * skew(gap_A);
          K.block<3, 3>(3, 6) += f * ei * AB;
          K.block<3, 3>(6, 3) -= f * AB.transpose() * ei;
          K.block<3, 3>(6, 9) += f * skew(AB.transpose().col(i).eval());
          break;
        case cosine:
          K.block<3, 3>(3, 3) += f * ei * skew(AB.col(j));
          K.block<3, 3>(3, 9) -= f * ei * AB * ej;
          K.block<3, 3>(9, 9) += f * ej * skew(AB.transpose().col(i).eval());
          K.block<3, 3>(9, 3) -= f * ej * AB.transpose() * ei;
          break;
        default:
          K.block<3, 3>(0, 0) += 2 * f * AA;
          K.block<3, 3>(0, 3) -= 2 * f * skew(gap_A);
          K.block<3, 3>(0, 6) -= 2 * f * AB;
          K.block<3, 3>(6, 0) -= 2 * f * AB.transpose();
          K.block<3, 3>(6, 6) += 2 * f * BB;
          K.block<3, 3>(6, 9) += 2 * f * skew(gap_B);
      }
  }



  void
  PairVelocity::add_derivative(const PairValues<double> &p, const double f, Eigen::Ref<Eigen::MatrixXd> K) const
  {
    const Vector3 ei = Vector3::Unit(i);
    if (kind == rolling)
      {
        const Vector3 k  = cross(Vector3::Unit(2), ei);
        const Matrix3 BA = p.B.transpose() * p.A;
        PairFunction{PairFunction::gap, i}.add_second_derivative(p, f, K);
        K.block<3, 3>(9, 3) += f * radius * BA * skew(k);
        K.block<3, 3>(9, 9) -= f * radius * skew((BA * k).eval());
      }
    else
      {
        const Matrix3 AB = p.A.transpose() * p.B;
        const Vector3 a  = p.A.transpose() * p.gap;
        // δc = c~ θ_A − AᵀB e~ θ_B, δa = a~ θ_A − AᵀA u_A + AᵀB u_B
        const Matrix3 c = skew(AB.col(i)), c_B = -AB * skew(ei);
        K.block<3, 3>(0, 3) -= f * c;
        K.block<3, 3>(0, 9) -= f * c_B;
        K.block<3, 3>(3, 0) -= f * c * p.A.transpose() * p.A;
        K.block<3, 3>(3, 3) += f * (c * skew(a) - skew(a) * c);
        K.block<3, 3>(3, 6) += f * c * AB;
        K.block<3, 3>(3, 9) -= f * skew(a) * c_B;
      }
  }
} // namespace samara
