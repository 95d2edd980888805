// Friction with bristles at a state as it is: in statics, in modes, in what is reported (base/friction_law.h).

#include <samara/joints/normal_force.h>

#include <array>

namespace samara
{
  namespace
  {
    /**
     * With which bristles that are not moved straighten [1/s]. Where nothing slips their rate would depend on nothing,
     * and statics would have no solution; in the lifetime of what is computed it does nothing.
     */
    constexpr double creeping_back = 1e-6;
    /** The same of those that nothing presses. */
    constexpr double straightening = 1.;



    /**
     * The forces f_i against slips w_i, and the rates of deflections z_i, of up to three slips. Local unknowns: slips,
     * the coordinate of the stop, the states, the multipliers.
     */
    class BristleEquations
    {
    public:
      BristleEquations(Layout &layout, const Item &item, const Layout::Friction &friction)
        : friction(friction)
        , pressing(layout, item, friction)
        , n(friction.coordinates.size())
        , first_state(n + pressing.n_gaps())
      {
        layout.couple(block, {}, pressing.coordinates(), friction.multipliers, friction.states);
      }

      /** What there is, and what follows; forces on coordinates. */
      template <typename Number>
      struct Values
      {
        std::array<Number, 3> slip{}, deflection{};
        Number                normal = 0;
        std::array<Number, 3> force{}, rate{};
      };

      template <typename Number>
      Values<Number>
      values_at(const Point<Number> &point) const
      {
        Values<Number> v;
        for (unsigned int i = 0; i < n; ++i)
          {
            v.slip[i]       = friction.arm * point.rates[friction.coordinates[i]];
            v.deflection[i] = point.states[friction.states[i]];
          }
        v.normal = pressing.force(point);
        complete(v);
        return v;
      }

      template <typename Number>
      void
      complete(Values<Number> &v) const
      {
        // ż = w − σ₀ |w| z/G and f = σ₀ z + σ₁(w) ż with the largest friction G; the bounded σ₁(w) = 4 G σ₁/(4 G + σ₁
        // |w|) makes the power that is lost not negative (doc/theory/contact.md)
        const FrictionLaw &law = friction.law;
        Number             square(0);
        for (unsigned int i = 0; i < n; ++i)
          square += v.slip[i] * v.slip[i];
        const Number size = std::real(square) > 0 ? std::sqrt(square) : Number(0),
                     G    = v.normal * law.coefficient(square).c;
        for (unsigned int i = 0; i < n; ++i)
          {
            v.force[i] = v.rate[i] = Number(0);
            if (!(std::real(G) > 0))
              {
                v.rate[i] = -straightening * v.deflection[i];
                continue;
              }
            v.rate[i] = v.slip[i] - (law.bristle_stiffness * size / G + creeping_back) * v.deflection[i];
            v.force[i] =
              friction.arm * (law.bristle_stiffness * v.deflection[i] +
                              4. * law.bristle_damping * G / (4. * G + law.bristle_damping * size) * v.rate[i]);
          }
      }

      /**
       * Add to @p to the derivatives of forces or rates, times @p sign, by what is moved: places (deflections and
       * normal forces) or slips. By complex steps, exact to round-off.
       */
      void
      add_slopes(const Point<double> &point, const bool of_rates, const bool by_slips, SparseMatrix &to) const
      {
        using Complex            = std::complex<double>;
        constexpr double epsilon = 1e-100;
        const auto       at      = values_at(point);
        Values<Complex>  moved;
        for (unsigned int i = 0; i < n; ++i)
          {
            moved.slip[i]       = at.slip[i];
            moved.deflection[i] = at.deflection[i];
          }
        moved.normal                 = at.normal;
        const unsigned int first_row = of_rates ? first_state : 0;
        // derivatives by what is moved, into the columns where it stands
        const auto add = [&](Complex &value, const std::vector<NormalForce::Slope> &columns) {
          const Complex before = value;
          value += Complex(0, epsilon);
          complete(moved);
          value = before;
          for (unsigned int i = 0; i < n; ++i)
            for (const auto &[column, slope] : columns)
              block.add_entry(first_row + i,
                              column,
                              slope * (of_rates ? -moved.rate[i].imag() : moved.force[i].imag()) / epsilon,
                              to);
        };
        if (by_slips)
          {
            for (unsigned int i = 0; i < n; ++i)
              add(moved.slip[i], {{i, friction.arm}});
            if (pressing.n_gaps() > 0 && at.normal > 0)
              add(moved.normal, {{n, pressing.by_gap_rate(point)}});
            return;
          }
        for (unsigned int i = 0; i < n; ++i)
          add(moved.deflection[i], {{first_state + i, 1.}});
        add(moved.normal, pressing.by_places(point, first_state + n));
      }

      const Layout::Friction friction;
      const NormalForce      pressing;
      const unsigned int     n, first_state;
      Block                  block;
    };



    /** The forces of bristles, or the rates of their deflections. */
    template <typename Kind, bool is_rate>
    class BristleTerm : public Evaluated<BristleTerm<Kind, is_rate>, Kind>
    {
    public:
      BristleTerm(Layout &layout, const Item &item, const Layout::Friction &friction)
        : equations(layout, item, friction)
      {}

      template <typename Number>
      void
      residual_at(const Point<Number> &point, Number *r) const
      {
        if (!point.stops)
          return;
        const auto values = equations.values_at(point);
        for (unsigned int i = 0; i < equations.n; ++i)
          if (is_rate)
            r[equations.block.row(equations.first_state + i)] -= values.rate[i];
          else
            r[equations.block.row(i)] += values.force[i];
      }

      void
      tangent(const Point<double> &point, SparseMatrix &K) const override
      {
        if (point.stops)
          equations.add_slopes(point, is_rate, false, K);
      }

      void
      damping(const Point<double> &point, SparseMatrix &C) const override
      {
        if (point.stops)
          equations.add_slopes(point, is_rate, true, C);
      }

    protected:
      BristleEquations equations;
    };



    using BristleRate = BristleTerm<StateEquation, true>;

    class BristleForce : public BristleTerm<Force, false>
    {
    public:
      using BristleTerm::BristleTerm;

      bool
      has_potential() const override
      {
        return true;
      }

      /** ½ σ₀ |z|² */
      double
      potential_energy(const Point<double> &point) const override
      {
        double square = 0;
        for (const auto i : equations.friction.states)
          square += point.states[i] * point.states[i];
        return 0.5 * equations.friction.law.bristle_stiffness * square;
      }
    };
  } // namespace



  std::unique_ptr<Force>
  bristle_force(Layout &layout, const Item &item, const Layout::Friction &friction)
  {
    return std::make_unique<BristleForce>(layout, item, friction);
  }



  std::unique_ptr<StateEquation>
  bristle_equation(Layout &layout, const Item &item, const Layout::Friction &friction)
  {
    return std::make_unique<BristleRate>(layout, item, friction);
  }
} // namespace samara
