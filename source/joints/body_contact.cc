// The rows of contacts between bodies, and their derivatives.

#include <samara/joints/body_contact.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** Three slips, as many rates of rolling, and one about the normal. */
    constexpr unsigned int max_rates = 7;
  } // namespace



  /** The place of the contact and the directions of its slips at one configuration; inertial components. */
  template <typename Number>
  struct BodyContact::Geometry
  {
    const BodyContact          &contact;
    const PairValues<Number>   &pair;
    Vec3<Number>                from_a, from_b; ///< to the contact from the origins of the frames [m]
    std::array<Vec3<Number>, 3> t;
    Vec3<Number>                n; ///< normal of the surfaces

    Geometry(const BodyContact &contact, const PairValues<Number> &pair)
      : contact(contact)
      , pair(pair)
    {
      const Vec3<Number> E3 = pair.A.col(2), &gap = pair.gap;
      if (contact.surface == Surface::plane || contact.surface == Surface::ellipsoid)
        {
          n      = E3;
          from_b = Number(-contact.radius) * E3;
          if (contact.surface == Surface::ellipsoid)
            from_b -= lowest();
          from_a = gap + from_b;
          t      = {{pair.A.col(0), pair.A.col(1), Vec3<Number>::Zero()}};
          return;
        }
      // between the surfaces in the proportion of the radii
      const double R             = contact.direction < 0 ? contact.radius : -contact.radius,
                   part          = contact.radius_a / (contact.radius_a + R);
      const bool         is_ball = contact.surface == Surface::ball;
      const Vec3<Number> radial  = is_ball ? gap : Vec3<Number>(gap - E3 * product(E3, gap));
      n                          = radial / std::sqrt(product(radial, radial));
      from_b                     = Number(part - 1) * radial;
      from_a                     = gap + from_b;
      if (is_ball)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Vec3<Number> E = pair.A.col(i);
            t[i]                 = E - n * product(n, E);
          }
      else
        t = {{cross(E3, n), E3, Vec3<Number>::Zero()}};
    }

    /** Add λ_i b_i, the forces and moments of multipliers of what is resisted, to those of the two nodes. */
    void
    add_forces(const Number *lambda, Number *at_a, Number *at_b) const
    {
      const unsigned int first_roll = contact.n_slips, first_turn = first_roll + contact.n_rolls;
      Vec3<Number>       f = Vec3<Number>::Zero(), m = Vec3<Number>::Zero();
      for (unsigned int i = 0; i < contact.n_slips; ++i)
        f += lambda[i] * t[i];
      for (unsigned int i = 0; i < contact.n_rolls; ++i)
        m += lambda[first_roll + i] * t[i];
      if (contact.n_turns > 0)
        m += lambda[first_turn] * n;
      const Vec3<Number> none = Vec3<Number>::Zero(), m_a = pair.in_a(Vec3<Number>(-cross(from_a, f) - m)),
                         m_b = pair.in_b(Vec3<Number>(cross(from_b, f) + m));
      pair.a.add_force(pair.q_of_forces, Vec3<Number>(-f), none, at_a);
      pair.b.add_force(pair.q_of_forces, f, none, at_b);
      for (unsigned int i = 0; i < 3; ++i)
        {
          at_a[3 + i] += m_a(i);
          at_b[3 + i] += m_b(i);
        }
    }

  private:
    /** Σ a_j² m_j B_j/h, from the lowest point of the ellipsoid to its centre. */
    Vec3<Number>
    lowest() const
    {
      const Mat3<Number> B = pair.b.triad(pair.q);
      Vec3<Number>       x = Vec3<Number>::Zero();
      Number             h_2(0);
      for (unsigned int j = 0; j < 3; ++j)
        {
          const Number m   = pair.cosines(2, j);
          const double a_2 = contact.semi_axes(j) * contact.semi_axes(j);
          x += (a_2 * m) * B.col(j);
          h_2 += a_2 * m * m;
        }
      return x / std::sqrt(h_2);
    }

    static Number
    product(const Vec3<Number> &a, const Vec3<Number> &b)
    {
      return a(0) * b(0) + a(1) * b(1) + a(2) * b(2);
    }
  };



  /** The rows of the distance, and those of what is resisted. */
  class BodyContact::Constraints : public Evaluated<BodyContact::Constraints, Constraint>
  {
  public:
    explicit Constraints(const BodyContact &contact)
      : contact(contact)
      , n(contact.n_measures())
      , n_all(contact.n_measures() + contact.n_rates())
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      // A measure u of the distance is an unknown, by a row f − u (− another) = 0, or (f + Σ w v² − u²)/(2 u_0) = 0
      // where it is a root, which keeps rows quadratic; a rate that is resisted is one, too, by b·y − u̇ = 0.
      const PairValues<Number> pair   = values(point.q, point.q_of_forces());
      const Block             &block  = contact.own_block;
      const Number *const      lambda = point.multipliers + contact.first_multiplier;
      PairForces<Number>       forces;
      for (unsigned int i = 0; i < n; ++i)
        {
          const Measure &m      = contact.measures[i];
          const double   factor = m.is_root ? 0.5 / m.start : 1.;
          r[block.row(12 + n_all + i)] += factor * gap(m, i, pair, point);
          if (m.function)
            forces.add(*m.function, pair, Number(factor) * lambda[i]);
          if (m.is_root)
            {
              r[block.row(12 + i)] -= lambda[i] * value(point, i) / m.start;
              for (const auto &[j, w] : m.squares)
                r[block.row(12 + j)] += w * lambda[i] * value(point, j) / m.start;
              continue;
            }
          r[block.row(12 + i)] -= lambda[i];
          if (m.less >= 0)
            r[block.row(12 + m.less)] -= lambda[i];
        }
      forces.add_to_nodes(pair, r + block.row(0), r + block.row(6));
      if (n_all == n)
        return;
      const Geometry<Number> geometry(contact, pair);
      geometry.add_forces(lambda + n, r + block.row(0), r + block.row(6));
      for (unsigned int i = n; i < n_all; ++i)
        r[block.row(12 + i)] -= lambda[i];
    }

    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void rates(const Point<double> &point, double *rates) const override;
    void second_rates(const Point<double> &point, double *rates) const override;

  private:
    const BodyContact &contact;
    const unsigned int n, n_all;

    template <typename Number>
    PairValues<Number>
    values(const Number *q, const Number *q_of_forces) const
    {
      return {contact.frame_a, contact.frame_b, q, q_of_forces, contact.surface == Surface::ellipsoid};
    }

    /** The unknowns that measure, themselves. */
    template <typename Number>
    Number
    value(const Point<Number> &point, const unsigned int i) const
    {
      return point.coordinates[contact.coordinate + i] + contact.measures[i].start;
    }

    /** What the row says, but for the factor of roots. */
    template <typename Number>
    Number
    gap(const Measure &m, const unsigned int i, const PairValues<Number> &pair, const Point<Number> &point) const
    {
      Number       sum = m.function ? m.function->value(pair) : Number(0);
      const Number u   = value(point, i);
      if (!m.is_root)
        return sum - u - (m.less >= 0 ? value(point, m.less) : Number(0));
      for (const auto &[j, w] : m.squares)
        sum += w * value(point, j) * value(point, j);
      return sum - u * u;
    }

    void add_tangent_of_measures(const Point<double> &point, SparseMatrix &K) const;
    void add_tangent_of_rates(const Point<double>      &point,
                              const PairValues<double> &pair,
                              Matrix12                 &H,
                              SparseMatrix             &K) const;

    void add_second_rates_of_slips(const Point<double> &point, const PairValues<double> &pair, double *g) const;

    /** The coefficients of the twists in a rate that is resisted. */
    Vector12
    coefficients(const Geometry<double> &geometry, const unsigned int i) const
    {
      double unit[max_rates] = {};
      unit[i]                = 1;
      Vector12 b             = Vector12::Zero();
      geometry.add_forces(unit, b.data(), b.data() + 6);
      return b;
    }
  };



  void
  BodyContact::Constraints::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const PairValues<double> pair   = values(point.q, point.q);
    const Block             &block  = contact.own_block;
    const double *const      lambda = point.multipliers + contact.first_multiplier;
    PairTangent              twists(pair);
    Matrix12                 H = Matrix12::Zero();
    add_tangent_of_measures(point, K);
    for (unsigned int i = 0; i < n; ++i)
      if (const Measure &m = contact.measures[i]; m.function)
        {
          const double factor = m.is_root ? 0.5 / m.start : 1.;
          Vector12     g      = Vector12::Zero();
          m.function->add_gradient(pair, factor, g);
          twists.add(*m.function, factor * lambda[i]);
          block.add_border(12 + n_all + i, g, K);
        }
    twists.add_to(H);
    if (n_all > n)
      add_tangent_of_rates(point, pair, H, K);
    block.add_twists(H, K);
  }



  /** By the unknowns that measure. */
  void
  BodyContact::Constraints::add_tangent_of_measures(const Point<double> &point, SparseMatrix &K) const
  {
    const Block        &block         = contact.own_block;
    const double *const lambda        = point.multipliers + contact.first_multiplier;
    const auto          add_symmetric = [&](const unsigned int i, const unsigned int j, const double value) {
      block.add_entry(i, j, value, K);
      block.add_entry(j, i, value, K);
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        const Measure     &m   = contact.measures[i];
        const unsigned int row = 12 + n_all + i;
        if (!m.is_root)
          {
            add_symmetric(12 + i, row, -1.);
            if (m.less >= 0)
              add_symmetric(12 + m.less, row, -1.);
            continue;
          }
        add_symmetric(12 + i, row, -value(point, i) / m.start);
        block.add_entry(12 + i, 12 + i, -lambda[i] / m.start, K);
        for (const auto &[j, w] : m.squares)
          {
            add_symmetric(12 + j, row, w * value(point, j) / m.start);
            block.add_entry(12 + j, 12 + j, w * lambda[i] / m.start, K);
          }
      }
  }



  void
  BodyContact::Constraints::add_tangent_of_rates(const Point<double>      &point,
                                                 const PairValues<double> &pair,
                                                 Matrix12                 &H,
                                                 SparseMatrix             &K) const
  {
    const Block           &block = contact.own_block;
    const Geometry<double> geometry(contact, pair);
    for (unsigned int i = n; i < n_all; ++i)
      {
        block.add_border(12 + n_all + i, coefficients(geometry, i - n), K);
        block.add_entry(12 + i, 12 + n_all + i, -1., K);
        block.add_entry(12 + n_all + i, 12 + i, -1., K);
      }
    // The derivative of the forces by complex steps along the twists: exact to round-off.
    using Complex            = std::complex<double>;
    constexpr double epsilon = 1e-100;
    Frame            a = pair.a, b = pair.b;
    a.node = 0;
    b.node = 1;
    Complex lambda[max_rates];
    for (unsigned int i = n; i < n_all; ++i)
      lambda[i - n] = point.multipliers[contact.first_multiplier + i];
    for (unsigned int j = 0; j < 12; ++j)
      {
        Complex q[24];
        for (unsigned int i = 0; i < 24; ++i)
          q[i] = pair.q[12 * (i < 12 ? pair.a.node : pair.b.node) + i % 12];
        Complex *const                  moved = q + (j < 6 ? 0 : 12);
        const Eigen::Map<const Matrix3> D(pair.q + 12 * (j < 6 ? pair.a.node : pair.b.node) + 3);
        const Vector3                   e = Vector3::Unit(j % 3);
        if (j % 6 < 3)
          for (unsigned int i = 0; i < 3; ++i)
            moved[i] += Complex(0, epsilon * (D * e)(i));
        else
          {
            const Matrix3 change = D * skew(e);
            for (unsigned int i = 0; i < 9; ++i)
              moved[3 + i] += Complex(0, epsilon * change.data()[i]);
          }
        const PairValues<Complex> moved_pair(a, b, q, contact.surface == Surface::ellipsoid);
        Complex                   forces[12] = {};
        Geometry<Complex>(contact, moved_pair).add_forces(lambda, forces, forces + 6);
        for (unsigned int i = 0; i < 12; ++i)
          H(i, j) += forces[i].imag() / epsilon;
      }
  }



  void
  BodyContact::Constraints::rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double> pair = values(point.q, point.q);
    const PairRates          change(pair, point.y);
    const double *const      coordinate_rates = point.rates + contact.coordinate;
    double *const            g                = rates + contact.first_multiplier;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Measure &m        = contact.measures[i];
        const double   function = m.function ? m.function->rate(pair, change) : 0.;
        if (!m.is_root)
          {
            g[i] = function - coordinate_rates[i] - (m.less >= 0 ? coordinate_rates[m.less] : 0.);
            continue;
          }
        double sum = 0.5 * function - value(point, i) * coordinate_rates[i];
        for (const auto &[j, w] : m.squares)
          sum += w * value(point, j) * coordinate_rates[j];
        g[i] = sum / m.start;
      }
    if (n_all == n)
      return;
    const Geometry<double>          geometry(contact, pair);
    const Eigen::Map<const Vector6> y_a(point.y + 6 * pair.a.node), y_b(point.y + 6 * pair.b.node);
    for (unsigned int i = n; i < n_all; ++i)
      {
        const Vector12 b = coefficients(geometry, i - n);
        g[i]             = b.head<6>().dot(y_a) + b.tail<6>().dot(y_b) - coordinate_rates[i];
      }
  }



  void
  BodyContact::Constraints::second_rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double> pair = values(point.q, point.q);
    const PairRates          change(pair, point.y);
    const PairSecondRates    second(pair, change, point.y, contact.surface == Surface::ellipsoid);
    const double *const      u_rates = point.rates + contact.coordinate;
    double *const            g       = rates + contact.first_multiplier;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Measure &m   = contact.measures[i];
        double         sum = m.function ? m.function->second_rate(pair, change, second) : 0.;
        if (m.is_root)
          {
            sum = 0.5 * sum - u_rates[i] * u_rates[i];
            for (const auto &[j, w] : m.squares)
              sum += w * u_rates[j] * u_rates[j];
            sum /= m.start;
          }
        g[i] = sum;
      }
    if (n_all > n)
      add_second_rates_of_slips(point, pair, g);
  }



  /** The derivative of b y along the motion by one complex step: exact to round-off. */
  void
  BodyContact::Constraints::add_second_rates_of_slips(const Point<double>      &point,
                                                      const PairValues<double> &pair,
                                                      double                   *g) const
  {
    using Complex            = std::complex<double>;
    constexpr double epsilon = 1e-100;
    Frame            a = pair.a, b = pair.b;
    a.node = 0;
    b.node = 1;
    Complex  q[24];
    Vector12 y;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int              node = k == 0 ? pair.a.node : pair.b.node;
        const Eigen::Map<const Vector3> v(point.y + 6 * node), spin(point.y + 6 * node + 3);
        const Eigen::Map<const Matrix3> D(point.q + 12 * node + 3);
        Eigen::Matrix<double, 3, 4>     change;
        change << D * v, D * skew(Vector3(spin));
        for (unsigned int i = 0; i < 12; ++i)
          q[12 * k + i] = Complex(point.q[12 * node + i], epsilon * change.data()[i]);
        y.segment<6>(6 * k) << v, spin;
      }
    const PairValues<Complex> moved_pair(a, b, q, contact.surface == Surface::ellipsoid);
    const Geometry<Complex>   moved(contact, moved_pair);
    for (unsigned int i = n; i < n_all; ++i)
      {
        Complex unit[max_rates] = {}, forces[12] = {};
        unit[i - n] = 1;
        moved.add_forces(unit, forces, forces + 6);
        for (unsigned int k = 0; k < 12; ++k)
          g[i] += forces[k].imag() / epsilon * y(k);
      }
  }



  void
  BodyContact::make_term()
  {
    term = std::make_unique<Constraints>(*this);
  }



  Vector3
  BodyContact::resistance_on_b(const State &state, const bool is_moment) const
  {
    const PairValues<double> pair(frame_a, frame_b, state.q.data());
    const Geometry<double>   geometry(*this, pair);
    const double *const      lambda = &state.multipliers[first_multiplier + n_measures()];
    Vector3                  sum    = Vector3::Zero();
    for (unsigned int i = 0; i < (is_moment ? n_rolls : n_slips); ++i)
      sum -= lambda[is_moment ? n_slips + i : i] * geometry.t[i];
    if (is_moment && n_turns > 0)
      sum -= lambda[n_slips + n_rolls] * geometry.n;
    return pair.in_axes_of_a(sum);
  }
} // namespace samara
