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
   * The quadratic functions of two frames from which every joint is made, with first and second derivatives in the
   * twists (u_A, θ_A, u_B, θ_B) of the frames in their own axes. Orthonormality of the axes is not used, so that the
   * functions stay quadratic in the coordinates.
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



  /**
   * Velocities of body B seen from body A, linear in the twists of the frames, b(q)·(u_A, θ_A, u_B, θ_B), but rates of
   * no function of their places. With w the velocity of the material of B at a place against that of A at the same
   * place:
   *
   *     rolling i    E_iᴬ·w at the place x_B − R E₃ᴬ, i = 1, 2
   *     skating j    E_jᴮ·w at the place x_B
   */
  struct PairVelocity
  {
    enum Kind
    {
      rolling,
      skating
    };
    Kind         kind;
    unsigned int i      = 0;
    double       radius = 0; ///< R [m]

    /** Add @p factor times b. */
    template <typename Number, typename Vector>
    void
    add_coefficients(const PairValues<Number> &p, const Number &factor, Vector &&b) const
    {
      const Vec3<Number> ei = Vec3<Number>::Unit(i);
      if (kind == rolling)
        {
          // the rate of E_iᴬ·Δ less R k·(ω_B − ω_A), k = E₃ × E_i
          const Vec3<Number> k = cross(Vec3<Number>::Unit(2), ei);
          PairFunction{PairFunction::gap, i}.add_gradient(p, factor, b);
          b.template segment<3>(3) += factor * radius * k;
          b.template segment<3>(9) -= factor * radius * (p.B.transpose() * (p.A * k));
        }
      else
        {
          const Vec3<Number> c = p.A.transpose() * p.B.col(i);
          b.template segment<3>(0) -= factor * c;
          b.template segment<3>(3) += factor * cross(c, (p.A.transpose() * p.gap).eval());
          b.template segment<3>(6) += factor * ei;
        }
    }

    /** Add @p factor times the derivative of b, which is not symmetric. */
    void add_derivative(const PairValues<double> &p, double factor, Eigen::Ref<Eigen::MatrixXd> K) const;
  };
} // namespace samara

#endif
