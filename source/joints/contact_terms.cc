#include <samara/joints/contact_terms.h>
#include <samara/joints/normal_force.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  /** U'(g), with the potential U. */
  class ContactTerms::Elastic : public Evaluated<ContactTerms::Elastic, Force>
  {
  public:
    Elastic(Layout &layout, const Layout::Stop &stop)
      : stop(stop)
    {
      layout.couple(block, {}, {stop.coordinate});
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      if (!point.stops)
        return;
      const Number g  = penetration(stop, point);
      const double at = std::real(g);
      r[block.row(0)] += stop.side * continued(stop.law.force(at), stop.law.slope(at), g, at);
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      if (point.stops)
        block.add_entry(0, 0, stop.law.slope(penetration(stop, point)), K);
    }

    bool
    has_potential() const override
    {
      return true;
    }

    double
    potential_energy(const Point<double> &point) const override
    {
      return stop.law.energy(penetration(stop, point));
    }

  private:
    const Layout::Stop stop;
    Block              block;
  };



  /** The part of the damping. */
  class ContactTerms::Damper : public Evaluated<ContactTerms::Damper, Force>
  {
  public:
    Damper(Layout &layout, const Layout::Stop &stop)
      : stop(stop)
    {
      layout.couple(block, {}, {stop.coordinate});
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      if (!point.stops)
        return;
      const Number g = penetration(stop, point), rate = penetration_rate(stop, point);
      const double g_at = std::real(g), rate_at = std::real(rate);
      const auto   d = stop.law.damper(g_at, rate_at);
      r[block.row(0)] += stop.side * (continued(d.force, d.by_gap, g, g_at) + continued(0., d.by_rate, rate, rate_at));
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      if (point.stops)
        block.add_entry(0, 0, stop.law.damper(penetration(stop, point), penetration_rate(stop, point)).by_gap, K);
    }

    void
    damping(const Point<double> &point, SparseMatrix &C) const override
    {
      if (point.stops)
        block.add_entry(0, 0, stop.law.damper(penetration(stop, point), penetration_rate(stop, point)).by_rate, C);
    }

  private:
    const Layout::Stop stop;
    Block              block;
  };



  /** N c(|w|²) w against the slip; local unknowns are the slips, the coordinate of the stop, the multipliers. */
  class ContactTerms::Friction : public Evaluated<ContactTerms::Friction, Force>
  {
  public:
    Friction(Layout &layout, const Item &item, const Layout::Friction &friction)
      : friction(friction)
      , pressing(layout, item, friction)
      , n(friction.coordinates.size())
    {
      layout.couple(block, {}, pressing.coordinates(), friction.multipliers);
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      if (!point.stops)
        return;
      const Number normal = pressing.force(point);
      if (std::real(normal) == 0)
        return;
      const auto law = friction.law(pressing.square_of_slip(point));
      for (unsigned int i = 0; i < n; ++i)
        r[block.row(i)] += friction.arm * friction.arm * normal * law.c * point.rates[friction.coordinates[i]];
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      if (!point.stops)
        return;
      const double factor = friction.arm * friction.arm * friction.law(pressing.square_of_slip(point)).c;
      for (const auto &[j, slope] : pressing.by_places(point, n + pressing.n_gaps()))
        for (unsigned int i = 0; i < n; ++i)
          block.add_entry(i, j, factor * point.rates[friction.coordinates[i]] * slope, K);
    }

    void
    damping(const Point<double> &point, SparseMatrix &C) const override
    {
      if (!point.stops)
        return;
      const double arm_2 = friction.arm * friction.arm, normal = pressing.force(point);
      const auto   law = friction.law(pressing.square_of_slip(point));
      for (unsigned int i = 0; i < n; ++i)
        {
          const double rate = point.rates[friction.coordinates[i]];
          for (unsigned int j = 0; j < n; ++j)
            block.add_entry(i,
                            j,
                            arm_2 * normal *
                              ((i == j ? law.c : 0.) +
                               2 * law.slope * arm_2 * rate * point.rates[friction.coordinates[j]]),
                            C);
          if (pressing.n_gaps() > 0 && normal > 0)
            block.add_entry(i, n, arm_2 * law.c * rate * pressing.by_gap_rate(point), C);
        }
    }

  private:
    const Layout::Friction friction;
    const NormalForce      pressing;
    const unsigned int     n; ///< slips
    Block                  block;
  };



  void
  ContactTerms::add(Layout &layout, const Item &item, std::unique_ptr<Force> term)
  {
    layout.add(item, *term);
    terms.push_back(std::move(term));
  }



  unsigned int
  ContactTerms::add_stop(Layout &layout, const Item &item, const Layout::Stop &stop)
  {
    if (stop.is_load)
      {
        add(layout, item, std::make_unique<Elastic>(layout, stop));
        if (stop.law.has_damping())
          add(layout, item, std::make_unique<Damper>(layout, stop));
      }
    layout.stops.push_back(stop);
    return layout.stops.size() - 1;
  }



  void
  ContactTerms::add_friction(Layout &layout, const Item &item, const Layout::Friction &friction)
  {
    layout.frictions.push_back(friction);
    layout.frictions.back().owner = &item;
    if (friction.states.empty())
      return add(layout, item, std::make_unique<Friction>(layout, item, friction));
    add(layout, item, bristle_force(layout, item, friction));
    equations.push_back(bristle_equation(layout, item, friction));
    layout.add(item, *equations.back());
  }
} // namespace samara
