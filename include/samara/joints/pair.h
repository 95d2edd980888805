#ifndef samara_joints_pair_h
#define samara_joints_pair_h

#include <samara/model/frame.h>

namespace samara
{
  /** Two frames A and B of a joint at one configuration: places, axes E_i as columns, and the gap from A to B. */
  template <typename Number>
  struct PairValues
  {
    Mat3<Number> A, B;
    Vec3<Number> gap;

    PairValues(const Frame &a, const Frame &b, const Number *q)
      : A(a.triad(q))
      , B(b.triad(q))
      , gap(b.position(q) - a.position(q))
    {}
  };



  /**
   * The quadratic functions of two frames from which every joint is made, with first and second derivatives in the twists
   * (u_A, θ_A, u_B, θ_B) of the frames in their own axes. Orthonormality of the axes is not used, so that the functions
   * stay quadratic in the coordinates.
   *
   *     gap i        E_iᴬ · Δ           Δ from the origin of A to that of B
   *     cosine i j   E_iᴬ · E_jᴮ
   *     distance²    Δ · Δ
   */
  struct PairFunction
  {
    enum Kind
    {
      gap,
      cosine,
      squared_distance
    };
    Kind         kind;
    unsigned int i = 0, j = 0;

    template <typename Number>
    Number
    value(const PairValues<Number> &p) const
    {
      switch (kind)
        {
          case gap:
            return dot(p.A.col(i), p.gap);
          case cosine:
            return dot(p.A.col(i), p.B.col(j));
          default:
            return dot(p.gap, p.gap);
        }
    }

    /** Add @p factor times the gradient. */
    template <typename Number, typename Vector>
    void
    add_gradient(const PairValues<Number> &p, const Number &factor, Vector &&g) const
    {
      const Vec3<Number> ei = Vec3<Number>::Unit(i), ej = Vec3<Number>::Unit(j);
      switch (kind)
        {
          case gap:
            g.template segment<3>(0) -= factor * (p.A.transpose() * p.A.col(i));
            g.template segment<3>(3) += factor * cross(ei, (p.A.transpose() * p.gap).eval());
            g.template segment<3>(6) += factor * (p.B.transpose() * p.A.col(i));
            break;
          case cosine:
            g.template segment<3>(3) += factor * cross(ei, (p.A.transpose() * p.B.col(j)).eval());
            g.template segment<3>(9) += factor * cross(ej, (p.B.transpose() * p.A.col(i)).eval());
            break;
          default:
            g.template segment<3>(0) -= Number(2) * factor * (p.A.transpose() * p.gap);
            g.template segment<3>(6) += Number(2) * factor * (p.B.transpose() * p.gap);
        }
    }

    /** Add @p factor times the derivative of the gradient. */
    void add_second_derivative(const PairValues<double> &p, double factor, Eigen::Ref<Eigen::MatrixXd> K) const;
  };
} // namespace samara

#endif
