#ifndef samara_joints_normal_force_h
#define samara_joints_normal_force_h

#include <samara/model/slip_line.h>

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
   * The force that presses where something rubs, at the state as it is (Layout::Friction): N = preload + |reactions| +
   * force of the stop. Of reactions of what has a line of slip, what they have across it; that it turns with places is
   * left out of the slopes, as nothing slips where those are wanted. Local unknowns of who uses it are the slips, the
   * coordinate of the stop, then others, then the multipliers.
   */
  class NormalForce
  {
  public:
    NormalForce(const Layout &layout, const Layout::Friction &friction)
      : friction(friction)
      , line(friction.line)
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
      const Eigen::VectorXd across = reactions(point);
      const double          size   = across.norm();
      for (unsigned int j = 0; j < friction.multipliers.size() && size > 0; ++j)
        slopes.push_back({first_multiplier + j, across(j) / size});
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
    const HasSlipLine *const line;
    const bool               has_stop;
    Layout::Stop             stop{};

    ContactLaw::Damper
    damper(const Point<double> &point) const
    {
      return stop.law.damper(penetration(stop, point), penetration_rate(stop, point));
    }

    /** What they have across the line of the slip. */
    template <typename Number>
    Eigen::Matrix<Number, Eigen::Dynamic, 1>
    reactions(const Point<Number> &point) const
    {
      Eigen::Matrix<Number, Eigen::Dynamic, 1> result(friction.multipliers.size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result(i) = point.multipliers[friction.multipliers[i]];
      if (line != nullptr)
        {
          const Vec3<Number> along = line->direction_of_slip(point);
          result -= along.cwiseProduct(result).sum() * along;
        }
      return result;
    }

    /** Their size. */
    template <typename Number>
    Number
    reaction(const Point<Number> &point) const
    {
      const auto   across = reactions(point);
      const Number square = across.cwiseProduct(across).sum();
      return std::real(square) > 0 ? std::sqrt(square) : Number(0);
    }
  };



  /** Friction with bristles at the state as it is: its force, and the equation of its deflections. @{ */
  std::unique_ptr<Force>         bristle_force(Layout &layout, const Layout::Friction &friction);
  std::unique_ptr<StateEquation> bristle_equation(Layout &layout, const Layout::Friction &friction);
  /** @} */
} // namespace samara

#endif
