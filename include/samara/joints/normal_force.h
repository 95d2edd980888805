#ifndef samara_joints_normal_force_h
#define samara_joints_normal_force_h

#include <samara/model/pressing.h>

#include <cmath>

namespace samara
{
  /** A function of a real argument, continued along imaginary steps so small that their square is lost. */
  inline double
  continued(const double value, const double, const double, const double)
  {
    return value;
  }
  inline std::complex<double>
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



  /**
   * The force that presses where something rubs, at the state as it is (Layout::Friction): N = preload + Σ |reactions|
   * + force of the stop, the sum over the places at which they press (HasPressing). That these turn with places is left
   * out of the slopes, as nothing slips where those are wanted. Local unknowns of who uses it are the slips, the
   * coordinate of the stop, then others, then the multipliers.
   *
   * Friction is pressed by reactions of the item that adds it. Others are not asked: those that are not connected yet
   * do not know their multipliers.
   */
  class NormalForce
  {
  public:
    NormalForce(const Layout &layout, const Item &item, const Layout::Friction &friction)
      : friction(friction)
      , pressing(pressing_by(item, friction))
      , has_stop(friction.stop >= 0)
    {
      if (has_stop)
        stop = layout.stops[friction.stop];
    }

    /** Of the slips, and of the stop. */
    std::vector<unsigned int>
    coordinates() const
    {
      std::vector<unsigned int> result = friction.coordinates;
      if (has_stop)
        result.push_back(stop.coordinate);
      return result;
    }

    /** How many of them are behind the slips. */
    unsigned int
    n_gaps() const
    {
      return has_stop ? 1 : 0;
    }

    template <typename Number>
    Number
    square_of_slip(const Point<Number> &point) const
    {
      Number square = 0;
      for (const auto i : friction.coordinates)
        square += friction.arm * friction.arm * point.rates[i] * point.rates[i];
      return square;
    }

    template <typename Number>
    Number
    force(const Point<Number> &point) const
    {
      Number normal = friction.preload + reaction(point);
      if (has_stop)
        {
          const Number g = penetration(stop, point), rate = penetration_rate(stop, point);
          const double g_at = std::real(g), rate_at = std::real(rate);
          const auto   d = stop.law.damper(g_at, rate_at);
          normal += continued(stop.law.force(g_at) + d.force, stop.law.slope(g_at) + d.by_gap, g, g_at) +
                    continued(0., d.by_rate, rate, rate_at);
        }
      return normal;
    }

    /** A local unknown, and the derivative of the force by it. */
    struct Slope
    {
      unsigned int unknown;
      double       value;
    };

    /** By the coordinate of the stop and by the multipliers, whose first local unknown is @p first_multiplier. */
    std::vector<Slope>
    by_places(const Point<double> &point, const unsigned int first_multiplier) const
    {
      std::vector<Slope> slopes;
      if (has_stop)
        {
          const double g = penetration(stop, point);
          slopes.push_back({static_cast<unsigned int>(friction.coordinates.size()),
                            (stop.law.slope(g) + damper(point).by_gap) * stop.side});
        }
      const unsigned int n     = friction.multipliers.size();
      const auto         parts = parts_at(point);
      Eigen::VectorXd    slope = Eigen::VectorXd::Zero(n);
      for (unsigned int p = 0; p < parts.n; ++p)
        {
          const Vector3 force = force_of(parts.of[p], point);
          if (const double size = force.norm(); size > 0)
            slope += parts.of[p].transpose() * force / size;
        }
      for (unsigned int j = 0; j < n && !slope.isZero(0.); ++j)
        slopes.push_back({first_multiplier + j, slope(j)});
      return slopes;
    }

    /** By the rate of the stop's coordinate, where there is a stop. */
    double
    by_gap_rate(const Point<double> &point) const
    {
      return damper(point).by_rate * stop.side;
    }

  private:
    const Layout::Friction   friction;
    const HasPressing *const pressing;
    const bool               has_stop;
    Layout::Stop             stop{};

    ContactLaw::Damper
    damper(const Point<double> &point) const
    {
      return stop.law.damper(penetration(stop, point), penetration_rate(stop, point));
    }

    template <typename Number>
    PressingParts<Number>
    parts_at(const Point<Number> &point) const
    {
      return pressing != nullptr ? pressing->pressing_parts(friction, point) :
                                   PressingParts<Number>(friction.multipliers.size());
    }

    /** That presses at one of the places. */
    template <typename Number>
    Vec3<Number>
    force_of(const typename PressingParts<Number>::Part &part, const Point<Number> &point) const
    {
      Vec3<Number> force = Vec3<Number>::Zero();
      for (unsigned int i = 0; i < friction.multipliers.size(); ++i)
        force += point.multipliers[friction.multipliers[i]] * part.col(i);
      return force;
    }

    /** Their sizes, added up. */
    template <typename Number>
    Number
    reaction(const Point<Number> &point) const
    {
      Number     sum(0);
      const auto parts = parts_at(point);
      for (unsigned int p = 0; p < parts.n; ++p)
        {
          const Vec3<Number> force  = force_of(parts.of[p], point);
          const Number       square = force.cwiseProduct(force).sum();
          if (std::real(square) > 0)
            sum += std::sqrt(square);
        }
      return sum;
    }
  };



  /** Friction with bristles at the state as it is: its force, and the equation of its deflections. @{ */
  std::unique_ptr<Force>         bristle_force(Layout &layout, const Item &item, const Layout::Friction &friction);
  std::unique_ptr<StateEquation> bristle_equation(Layout &layout, const Item &item, const Layout::Friction &friction);
  /** @} */
} // namespace samara

#endif
