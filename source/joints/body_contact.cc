// The rows of contacts between bodies, and their derivatives.

#include <samara/joints/body_contact.h>

#include <cmath>

namespace samara
{
  /** The place of the contact and the directions of its slips at one configuration; inertial components. */
  template <typename Number>
  struct BodyContact::Geometry
  {
    const PairValues<Number>   &pair;
    Vec3<Number>                from_a, from_b; ///< to the contact from the origins of the frames [m]
    std::array<Vec3<Number>, 3> t;

    Geometry(const BodyContact &contact, const PairValues<Number> &pair)
      : pair(pair)
    {
      const Vec3<Number> E3 = pair.A.col(2), &gap = pair.gap;
      if (contact.surface == Surface::plane)
        {
          from_b = Number(-contact.radius) * E3;
          from_a = gap + from_b;
          t      = {{pair.A.col(0), pair.A.col(1), Vec3<Number>::Zero()}};
          return;
        }
      // between the surfaces in the proportion of the radii
      const double R             = contact.direction < 0 ? contact.radius : -contact.radius,
                   part          = contact.radius_a / (contact.radius_a + R);
      const bool         is_ball = contact.surface == Surface::ball;
      const Vec3<Number> radial  = is_ball ? gap : Vec3<Number>(gap - E3 * product(E3, gap)),
                         n       = radial / std::sqrt(product(radial, radial));
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

    /** Add λ_i b_i, the forces of multipliers of the slips, to those of the two nodes. */
    void
    add_forces(const unsigned int n, const Number *lambda, Number *at_a, Number *at_b) const
    {
      Vec3<Number> f = Vec3<Number>::Zero();
      for (unsigned int i = 0; i < n; ++i)
        f += lambda[i] * t[i];
      const Vec3<Number> none = Vec3<Number>::Zero(), m_a = pair.in_a(Vec3<Number>(-cross(from_a, f))),
                         m_b = pair.in_b(cross(from_b, f));
      pair.a.add_force(pair.q, Vec3<Number>(-f), none, at_a);
      pair.b.add_force(pair.q, f, none, at_b);
      for (unsigned int i = 0; i < 3; ++i)
        {
          at_a[3 + i] += m_a(i);
          at_b[3 + i] += m_b(i);
        }
    }

  private:
    static Number
    product(const Vec3<Number> &a, const Vec3<Number> &b)
    {
      return a(0) * b(0) + a(1) * b(1) + a(2) * b(2);
    }
  };



  /** The rows of the distance, and those of the slips. */
  class BodyContact::Constraints : public Evaluated<BodyContact::Constraints, Constraint>
  {
  public:
    explicit Constraints(const BodyContact &contact)
      : contact(contact)
      , n(contact.n_measures)
      , n_all(contact.n_measures + contact.n_slips)
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      const PairValues<Number> pair(contact.frame_a, contact.frame_b, point.q, false);
      const Block             &block  = contact.own_block;
      const Number *const      lambda = point.multipliers + contact.first_multiplier;
      const Number             d      = value(point, n - 1);
      PairForces<Number>       forces;
      for (unsigned int i = 0; i < n; ++i)
        {
          const PairFunction function = measured(i);
          r[block.row(12 + n_all + i)] += function_value(function, pair, point, i);
          if (!is_radius(i))
            {
              forces.add(function, pair, lambda[i]);
              r[block.row(12 + i)] -= lambda[i];
              continue;
            }
          r[block.row(12 + i)] -= lambda[i] * d / reference();
          if (contact.surface == Surface::ball)
            forces.add(function, pair, Number(0.5 / reference()) * lambda[i]);
          else
            for (const unsigned int j : {0, 1})
              r[block.row(12 + j)] += lambda[i] * value(point, j) / reference();
        }
      forces.add_to_nodes(pair, r + block.row(0), r + block.row(6));
      if (contact.n_slips == 0)
        return;
      const Geometry<Number> geometry(contact, pair);
      geometry.add_forces(contact.n_slips, lambda + n, r + block.row(0), r + block.row(6));
      for (unsigned int i = n; i < n_all; ++i)
        r[block.row(12 + i)] -= lambda[i];
    }

    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void rates(const Point<double> &point, double *rates) const override;

  private:
    const BodyContact &contact;
    const unsigned int n, n_all;

    double
    reference() const
    {
      return contact.start(2);
    }

    /** Whether row i is the last one, (… − d²)/(2 d₀). */
    bool
    is_radius(const unsigned int i) const
    {
      return contact.surface != Surface::plane && i + 1 == n;
    }

    PairFunction
    measured(const unsigned int i) const
    {
      return contact.surface == Surface::ball  ? PairFunction{PairFunction::squared_distance} :
             contact.surface == Surface::plane ? PairFunction{PairFunction::gap, 2} :
                                                 PairFunction{PairFunction::gap, i};
    }

    /** a, b, d themselves. */
    template <typename Number>
    Number
    value(const Point<Number> &point, const unsigned int i) const
    {
      return point.coordinates[contact.coordinate + i] + contact.start(i + 3 - n);
    }

    template <typename Number>
    Number
    function_value(const PairFunction       &function,
                   const PairValues<Number> &pair,
                   const Point<Number>      &point,
                   const unsigned int        i) const
    {
      const Number d = value(point, i);
      if (!is_radius(i))
        return function.value(pair) - d;
      const Number square = contact.surface == Surface::ball ?
                              function.value(pair) :
                              value(point, 0) * value(point, 0) + value(point, 1) * value(point, 1);
      return 0.5 / reference() * (square - d * d);
    }

    void add_tangent_of_slips(const Point<double>      &point,
                              const PairValues<double> &pair,
                              Matrix12                 &H,
                              SparseMatrix             &K) const;

    /** The coefficients of the twists in a slip. */
    Vector12
    coefficients(const Geometry<double> &geometry, const unsigned int i) const
    {
      double unit[3] = {0, 0, 0};
      unit[i]        = 1;
      Vector12 b     = Vector12::Zero();
      geometry.add_forces(contact.n_slips, unit, b.data(), b.data() + 6);
      return b;
    }
  };



  void
  BodyContact::Constraints::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const PairValues<double> pair(contact.frame_a, contact.frame_b, point.q, false);
    const Block             &block         = contact.own_block;
    const double *const      lambda        = point.multipliers + contact.first_multiplier;
    const auto               add_symmetric = [&](const unsigned int i, const unsigned int j, const double value) {
      block.add_entry(i, j, value, K);
      block.add_entry(j, i, value, K);
    };
    PairTangent twists(pair);
    Matrix12    H = Matrix12::Zero();
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int row = 12 + n_all + i;
        if (is_radius(i))
          {
            add_symmetric(12 + i, row, -value(point, i) / reference());
            block.add_entry(12 + i, 12 + i, -lambda[i] / reference(), K);
          }
        else
          add_symmetric(12 + i, row, -1.);
        if (is_radius(i) && contact.surface == Surface::cylinder)
          {
            for (const unsigned int j : {0, 1})
              {
                add_symmetric(12 + j, row, value(point, j) / reference());
                block.add_entry(12 + j, 12 + j, lambda[i] / reference(), K);
              }
            continue;
          }
        const double factor = is_radius(i) ? 0.5 / reference() : 1.;
        Vector12     g      = Vector12::Zero();
        measured(i).add_gradient(pair, factor, g);
        twists.add(measured(i), factor * lambda[i]);
        block.add_border(row, g, K);
      }
    twists.add_to(H);
    if (contact.n_slips > 0)
      add_tangent_of_slips(point, pair, H, K);
    block.add_twists(H, K);
  }



  void
  BodyContact::Constraints::add_tangent_of_slips(const Point<double>      &point,
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
    Complex lambda[3];
    for (unsigned int i = 0; i < contact.n_slips; ++i)
      lambda[i] = point.multipliers[contact.first_multiplier + n + i];
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
        const PairValues<Complex> moved_pair(a, b, q, false);
        Complex                   forces[12] = {};
        Geometry<Complex>(contact, moved_pair).add_forces(contact.n_slips, lambda, forces, forces + 6);
        for (unsigned int i = 0; i < 12; ++i)
          H(i, j) += forces[i].imag() / epsilon;
      }
  }



  void
  BodyContact::Constraints::rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double> pair(contact.frame_a, contact.frame_b, point.q, false);
    const PairRates          change(pair, point.y);
    const double *const      coordinate_rates = point.rates + contact.coordinate;
    double *const            g                = rates + contact.first_multiplier;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double d = value(point, i);
        if (!is_radius(i))
          g[i] = measured(i).rate(pair, change) - coordinate_rates[i];
        else if (contact.surface == Surface::ball)
          g[i] = (0.5 * measured(i).rate(pair, change) - d * coordinate_rates[i]) / reference();
        else
          g[i] =
            (value(point, 0) * coordinate_rates[0] + value(point, 1) * coordinate_rates[1] - d * coordinate_rates[i]) /
            reference();
      }
    if (contact.n_slips == 0)
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
  BodyContact::make_term()
  {
    term = std::make_unique<Constraints>(*this);
  }



  Vector3
  BodyContact::friction_on_b(const State &state) const
  {
    const PairValues<double> pair(frame_a, frame_b, state.q.data(), false);
    const Geometry<double>   geometry(*this, pair);
    Vector3                  force = Vector3::Zero();
    for (unsigned int i = 0; i < n_slips; ++i)
      force -= state.multipliers[first_multiplier + n_measures + i] * geometry.t[i];
    return pair.in_axes_of_a(force);
  }
} // namespace samara
