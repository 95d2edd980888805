#ifndef samara_joints_pair_h
#define samara_joints_pair_h

#include <samara/model/frame.h>

namespace samara
{
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  using Matrix12 = Eigen::Matrix<double, 12, 12>;

  /** 1 after 0, 2 after 1, 0 after 2. */
  constexpr unsigned int
  next_axis(const unsigned int i)
  {
    return i == 2 ? 0 : i + 1;
  }



  /**
   * Two frames A and B of a joint at one configuration, Δ from the origin of A to that of B. Frames and coordinates
   * must outlive it.
   */
  template <typename Number>
  struct PairValues
  {
    const Frame  &a, &b;
    const Number *q;
    Vec3<Number>  gap;     ///< Δ, inertial components [m]
    Mat3<Number>  A;       ///< axes E_i as columns
    Vec3<Number>  gaps;    ///< AᵀΔ
    Mat3<Number>  cosines; ///< AᵀB, not set where the axes of B are not wanted

    /** @name What forces see, in the reciprocal axes A⁻ᵀ, B⁻ᵀ; set only where these are not A and B @{ */
    const Number *q_of_forces; ///< see Point::q_of_forces()
    Vec3<Number>  gaps_on_a;   ///< A⁻¹Δ
    Mat3<Number>  on_a, on_b;  ///< A⁻¹B, AᵀB⁻ᵀ
    /** @} */

    PairValues(const Frame &a, const Frame &b, const Number *q, const bool with_axes_of_b = true)
      : PairValues(a, b, q, q, with_axes_of_b)
    {}

    PairValues(const Frame  &a,
               const Frame  &b,
               const Number *q,
               const Number *q_of_forces,
               const bool    with_axes_of_b = true)
      : a(a)
      , b(b)
      , q(q)
      , gap(b.position(q) - a.position(q))
      , A(a.triad(q))
      , gaps(in_axes_of_a(gap))
      , q_of_forces(q_of_forces)
    {
      if (is_reciprocal())
        gaps_on_a = in_axes(a.triad(q_of_forces), gap);
      if (!with_axes_of_b)
        return;
      const Mat3<Number> B = b.triad(q);
      set_cosines(A, B, cosines);
      if (!is_reciprocal())
        return;
      set_cosines(a.triad(q_of_forces), B, on_a);
      set_cosines(A, b.triad(q_of_forces), on_b);
    }

    bool
    is_reciprocal() const
    {
      return q_of_forces != q;
    }

    /**
     * The same with A⁻¹B in place of AᵀB: angles that are about no axis of both bodies are taken from it, their rates
     * and their moments. These are constant where both turn steadily with one another.
     */
    PairValues
    for_angles() const
    {
      PairValues result  = *this;
      result.cosines     = on_a;
      result.q_of_forces = q;
      return result;
    }

    /** A vector of inertial components in the axes of the nodes, or in those where forces take them. */
    Vec3<Number>
    in_a(const Vec3<Number> &v) const
    {
      return a.in_node(q_of_forces, v);
    }
    Vec3<Number>
    in_b(const Vec3<Number> &v) const
    {
      return b.in_node(q_of_forces, v);
    }

    /** Aᵀ v */
    Vec3<Number>
    in_axes_of_a(const Vec3<Number> &v) const
    {
      return in_axes(A, v);
    }

  private:
    static Vec3<Number>
    in_axes(const Mat3<Number> &A, const Vec3<Number> &v)
    {
      return {A(0, 0) * v(0) + A(1, 0) * v(1) + A(2, 0) * v(2),
              A(0, 1) * v(0) + A(1, 1) * v(1) + A(2, 1) * v(2),
              A(0, 2) * v(0) + A(1, 2) * v(1) + A(2, 2) * v(2)};
    }

    static void
    set_cosines(const Mat3<Number> &A, const Mat3<Number> &B, Mat3<Number> &cosines)
    {
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          cosines(i, j) = A(0, i) * B(0, j) + A(1, i) * B(1, j) + A(2, i) * B(2, j);
    }
  };



  /** How a pair moves at the nodal twists @p y (6 a node). */
  struct PairRates
  {
    Vector3 gap;            ///< rate of Δ, inertial components [m/s]
    Vector3 gaps;           ///< rate of AᵀΔ
    Vector3 spin_a, spin_b; ///< angular velocities in the axes of A and B [rad/s]

    PairRates(const PairValues<double> &pair, const double *y);
  };



  /** How its rates change while the twists stay as they are: second derivatives, of Δ, of AᵀΔ and of AᵀB. */
  struct PairSecondRates
  {
    Vector3 gap;     ///< inertial components [m/s²]
    Vector3 gaps;    ///< [m/s²]
    Matrix3 cosines; ///< [1/s²]; not set where the axes of B are not wanted

    PairSecondRates(const PairValues<double> &pair,
                    const PairRates          &rates,
                    const double             *y,
                    bool                      with_axes_of_b = true);
  };



  /**
   * The quadratic functions of two frames from which every joint is made. Orthonormality of the axes is not used, so
   * that the functions stay quadratic in the coordinates.
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
            return p.gaps(i);
          case cosine:
            return p.cosines(i, j);
          default:
            return p.gap(0) * p.gap(0) + p.gap(1) * p.gap(1) + p.gap(2) * p.gap(2);
        }
    }

    double
    rate(const PairValues<double> &p, const PairRates &rates) const
    {
      switch (kind)
        {
          case gap:
            return rates.gaps(i);
          case cosine:
            {
              // (ω_A × e_i)·AᵀE_jᴮ + (ω_B × e_j)·BᵀE_iᴬ
              const unsigned int i1 = next_axis(i), i2 = next_axis(i1), j1 = next_axis(j), j2 = next_axis(j1);
              return p.cosines(i1, j) * rates.spin_a(i2) - p.cosines(i2, j) * rates.spin_a(i1) +
                     p.cosines(i, j1) * rates.spin_b(j2) - p.cosines(i, j2) * rates.spin_b(j1);
            }
          default:
            return 2 * (p.gap(0) * rates.gap(0) + p.gap(1) * rates.gap(1) + p.gap(2) * rates.gap(2));
        }
    }

    double
    second_rate(const PairValues<double> &p, const PairRates &rates, const PairSecondRates &second) const
    {
      switch (kind)
        {
          case gap:
            return second.gaps(i);
          case cosine:
            return second.cosines(i, j);
          default:
            return 2 * (rates.gap.dot(rates.gap) + p.gap.dot(second.gap));
        }
    }

    /** Add @p factor times the gradient in the twists (u_A, θ_A, u_B, θ_B) of the nodes. */
    template <typename Number>
    void add_gradient(const PairValues<Number> &p, const Number &factor, Eigen::Matrix<Number, 12, 1> &g) const;
  };



  /** The gradient of a sum of functions: what holds the two bodies if the factors are multipliers. */
  template <typename Number>
  struct PairForces
  {
    Vec3<Number> gaps       = Vec3<Number>::Zero(); ///< factors of the three gaps: the force along the axes of A
    Vec3<Number> moment_a   = Vec3<Number>::Zero(); ///< of the cosines, in the axes of A
    Vec3<Number> moment_b   = Vec3<Number>::Zero(); ///< the same on B, in the axes of B
    Number       distance_2 = 0;                    ///< factor of the squared distance

    /** Add @p factor times a function to the sum. */
    void
    add(const PairFunction &function, const PairValues<Number> &p, const Number &factor)
    {
      const unsigned int i = function.i, j = function.j;
      switch (function.kind)
        {
          case PairFunction::gap:
            gaps(i) += factor;
            break;
          case PairFunction::cosine:
            {
              // e_i × AᵀE_jᴮ and e_j × BᵀE_iᴬ
              const unsigned int  i1 = next_axis(i), i2 = next_axis(i1), j1 = next_axis(j), j2 = next_axis(j1);
              const Mat3<Number> &on_a = p.is_reciprocal() ? p.on_a : p.cosines,
                                 &on_b = p.is_reciprocal() ? p.on_b : p.cosines;
              moment_a(i1) -= factor * on_a(i2, j);
              moment_a(i2) += factor * on_a(i1, j);
              moment_b(j1) -= factor * on_b(i, j2);
              moment_b(j2) += factor * on_b(i, j1);
              break;
            }
          default:
            distance_2 += factor;
        }
    }

    /** The derivative in Δ: a force on B [N], inertial components. */
    Vec3<Number>
    on_b(const PairValues<Number> &p) const
    {
      Vec3<Number> f;
      for (int k = 0; k < 3; ++k)
        f(k) = p.A(k, 0) * gaps(0) + p.A(k, 1) * gaps(1) + p.A(k, 2) * gaps(2) + Number(2) * distance_2 * p.gap(k);
      return f;
    }

    /** Add the gradient of the sum in the twists of the two nodes, 6 numbers each. */
    void
    add_to_nodes(const PairValues<Number> &p, Number *at_a, Number *at_b) const
    {
      const Vec3<Number>  f    = on_b(p);
      const Vec3<Number> &seen = p.is_reciprocal() ? p.gaps_on_a : p.gaps;
      p.a.add_force(p.q_of_forces, Vec3<Number>(-f), Vec3<Number>(moment_a + cross(gaps, seen)), at_a);
      p.b.add_force(p.q_of_forces, f, moment_b, at_b);
    }
  };



  /** The derivative of the gradient of a sum of functions, 12×12 in the twists of the nodes; it is not symmetric. */
  class PairTangent
  {
  public:
    explicit PairTangent(const PairValues<double> &pair);

    /** Add @p factor times a function to the sum. */
    void add(const PairFunction &function, double factor);

    /** Add the derivative to @p K. */
    void add_to(Matrix12 &K) const;

  private:
    const PairValues<double> &pair;
    PairForces<double>        forces;
    bool                      has_cosines = false;
    Matrix3                   factors     = Matrix3::Zero(); ///< of the cosines
    Matrix3                   turns       = Matrix3::Zero(); ///< their second derivative in θ_A, θ_B of the frames

    void add_gaps(Matrix12 &K) const;
    void add_distance(Matrix12 &K) const;
  };



  /**
   * Velocities of body B seen from body A, linear in the twists of the nodes, b(q)·(u_A, θ_A, u_B, θ_B), but rates of
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
    template <typename Number>
    void add_coefficients(const PairValues<Number> &p, const Number &factor, Eigen::Matrix<Number, 12, 1> &b) const;

    /** Add @p factor times the derivative of b, which is not symmetric. */
    void add_derivative(const PairValues<double> &p, double factor, Matrix12 &K) const;
  };



  template <typename Number>
  void
  PairFunction::add_gradient(const PairValues<Number> &p, const Number &factor, Eigen::Matrix<Number, 12, 1> &g) const
  {
    if (kind == cosine)
      {
        // the moments in the axes of the frames are those that the nodes feel
        const Vec3<Number> B_j = (p.is_reciprocal() ? p.on_a : p.cosines).col(j),
                           A_i = (p.is_reciprocal() ? p.on_b : p.cosines).row(i).transpose();
        g.template segment<3>(3) += factor * (p.a.rotation * cross(Vector3::Unit(i), B_j));
        g.template segment<3>(9) += factor * (p.b.rotation * cross(Vector3::Unit(j), A_i));
        return;
      }
    const Vec3<Number> f   = kind == gap ? Vec3<Number>(factor * p.A.col(i)) : Vec3<Number>(Number(2) * factor * p.gap);
    const Vec3<Number> u_a = p.in_a(f), u_b = p.in_b(f);
    g.template segment<3>(0) -= u_a;
    g.template segment<3>(3) -= cross(p.a.arm, u_a);
    g.template segment<3>(6) += u_b;
    g.template segment<3>(9) += cross(p.b.arm, u_b);
    if (kind == gap)
      g.template segment<3>(3) +=
        factor * (p.a.rotation * cross(Vector3::Unit(i), p.is_reciprocal() ? p.gaps_on_a : p.gaps));
  }



  template <typename Number>
  void
  PairVelocity::add_coefficients(const PairValues<Number>     &p,
                                 const Number                 &factor,
                                 Eigen::Matrix<Number, 12, 1> &b) const
  {
    if (kind == rolling)
      {
        // the rate of E_iᴬ·Δ less R k·(ω_B − ω_A), k = E₃ × E_i
        const Vector3      k  = cross(Vector3::Unit(2), Vector3::Unit(i));
        const Vec3<Number> kA = p.A.col(0) * k(0) + p.A.col(1) * k(1);
        PairFunction{PairFunction::gap, i}.add_gradient(p, factor, b);
        b.template segment<3>(3) += factor * radius * (p.a.rotation * k);
        b.template segment<3>(9) -= factor * radius * p.in_b(kA);
      }
    else
      {
        const Vec3<Number> c = factor * (p.a.rotation * (p.is_reciprocal() ? p.on_a : p.cosines).col(i));
        b.template segment<3>(0) -= c;
        b.template segment<3>(3) += cross(c, p.in_a(p.gap)) - cross(p.a.arm, c);
        b.template segment<3>(6) += factor * p.b.rotation.col(i);
        b.template segment<3>(9) += factor * cross(p.b.arm, p.b.rotation.col(i));
      }
  }
} // namespace samara

#endif
