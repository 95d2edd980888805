#include <samara/joints/contact_terms.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** A function of a real argument, continued along imaginary steps so small that their square is lost. */
    double
    continued(const double value, const double, const double, const double)
    {
      return value;
    }
    std::complex<double>
    continued(const double value, const double slope, const std::complex<double> &x, const double at)
    {
      return value + slope * (x - at);
    }

    /** The penetration of a stop, and its rate. */
    template <typename Number>
    Number
    penetration(const Layout::Stop &stop, const Point<Number> &point)
    {
      return stop.side * (point.coordinates[stop.coordinate] - stop.place);
    }
    template <typename Number>
    Number
    penetration_rate(const Layout::Stop &stop, const Point<Number> &point)
    {
      return stop.side * point.rates[stop.coordinate];
    }
  } // namespace



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
    Friction(Layout &layout, const Layout::Friction &friction)
      : friction(friction)
      , n(friction.coordinates.size())
    {
      std::vector<unsigned int> coordinates = friction.coordinates;
      if (friction.stop >= 0)
        {
          stop = layout.stops[friction.stop];
          coordinates.push_back(stop.coordinate);
        }
      layout.couple(block, {}, coordinates, friction.multipliers);
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      if (!point.stops)
        return;
      const Number normal = normal_force(point);
      if (std::real(normal) == 0)
        return;
      const auto law = friction.law(square_of_slip(point));
      for (unsigned int i = 0; i < n; ++i)
        r[block.row(i)] += friction.arm * friction.arm * normal * law.c * point.rates[friction.coordinates[i]];
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      const double factor = factor_of_normal_force(point);
      if (factor == 0)
        return;
      if (friction.stop >= 0)
        {
          const double g = penetration(stop, point), by_gap = stop.law.slope(g) + damper(point).by_gap;
          for (unsigned int i = 0; i < n; ++i)
            block.add_entry(i, n, factor * point.rates[friction.coordinates[i]] * by_gap * stop.side, K);
        }
      const unsigned int first = n + (friction.stop >= 0 ? 1 : 0);
      const double       size  = reaction(point);
      for (unsigned int j = 0; j < friction.multipliers.size() && size > 0; ++j)
        for (unsigned int i = 0; i < n; ++i)
          block.add_entry(i,
                          first + j,
                          factor * point.rates[friction.coordinates[i]] * point.multipliers[friction.multipliers[j]] /
                            size,
                          K);
    }

    void
    damping(const Point<double> &point, SparseMatrix &C) const override
    {
      if (!point.stops)
        return;
      const double arm_2 = friction.arm * friction.arm, normal = normal_force(point);
      const auto   law = friction.law(square_of_slip(point));
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
          if (friction.stop >= 0 && normal > 0)
            block.add_entry(i, n, arm_2 * law.c * rate * damper(point).by_rate * stop.side, C);
        }
    }

  private:
    const Layout::Friction friction;
    const unsigned int     n; ///< slips
    Layout::Stop           stop{};
    Block                  block;

    template <typename Number>
    Number
    square_of_slip(const Point<Number> &point) const
    {
      Number square = 0;
      for (const auto i : friction.coordinates)
        square += friction.arm * friction.arm * point.rates[i] * point.rates[i];
      return square;
    }

    /** arm² c: what the product of the normal force and a rate is multiplied by; zero where nothing acts. */
    double
    factor_of_normal_force(const Point<double> &point) const
    {
      return point.stops ? friction.arm * friction.arm * friction.law(square_of_slip(point)).c : 0.;
    }

    ContactLaw::Damper
    damper(const Point<double> &point) const
    {
      return stop.law.damper(penetration(stop, point), penetration_rate(stop, point));
    }

    /** The size of the reactions. */
    template <typename Number>
    Number
    reaction(const Point<Number> &point) const
    {
      Number square = 0;
      for (const auto i : friction.multipliers)
        square += point.multipliers[i] * point.multipliers[i];
      return std::real(square) > 0 ? std::sqrt(square) : Number(0);
    }

    template <typename Number>
    Number
    normal_force(const Point<Number> &point) const
    {
      Number normal = friction.preload + reaction(point);
      if (friction.stop >= 0)
        {
          const Number g = penetration(stop, point), rate = penetration_rate(stop, point);
          const double g_at = std::real(g), rate_at = std::real(rate);
          const auto   d = stop.law.damper(g_at, rate_at);
          normal += continued(stop.law.force(g_at) + d.force, stop.law.slope(g_at) + d.by_gap, g, g_at) +
                    continued(0., d.by_rate, rate, rate_at);
        }
      return normal;
    }
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
    add(layout, item, std::make_unique<Friction>(layout, friction));
  }
} // namespace samara
