// Joints that hold what slides only as long as it is on the beam.

#include <samara/joints/sliding.h>
#include <samara/model/signal.h>

#include <algorithm>
#include <complex>
#include <limits>

namespace samara
{
  /** S − S₀; of what has left, a constant. */
  class SlidingJoint::Displacement : public Signal
  {
  public:
    explicit Displacement(const SlidingJoint &joint)
      : joint(joint)
    {
      coordinates = {joint.coordinate()};
    }

    double
    value(const Point<double> &point) const override
    {
      return joint.displacement(point.coordinates[coordinates[0]]);
    }
    std::complex<double>
    value(const Point<std::complex<double>> &point) const override
    {
      const std::complex<double> sigma = point.coordinates[coordinates[0]];
      return joint.is_far(sigma.real()) ? joint.displacement(sigma.real()) : sigma;
    }
    void
    add_gradient(const Point<double> &point, double *const by_place, double *) const override
    {
      if (!joint.is_far(point.coordinates[coordinates[0]]))
        by_place[0] += 1;
    }

  private:
    const SlidingJoint &joint;
  };



  std::shared_ptr<Signal>
  SlidingJoint::displacement_signal() const
  {
    if (may_leave())
      return std::make_shared<Displacement>(*this);
    return coordinate_signal(coordinate(), 0.);
  }



  void
  SlidingJoint::check_leaving(Model &m)
  {
    FreeMotion &motion = free.front();
    const auto &prm    = parameters.subsection("displacement");
    for (const std::string entry : {"Spring", "Spring force"})
      if (prm.is_set(entry))
        m.complaints.add(prm.where(entry),
                         "joint <" + name +
                           ">: a spring along the beam would hold what has left it; <At the ends = leave> has none");
    for (const std::string of : {"displacement", "rotation", "thread"})
      if (const bool is_there = of == "displacement" || (of == "rotation" ? ball.is_declared() : has_thread); is_there)
        if (const auto &rubs = parameters.subsection(of); rubs.is_set("Bristle stiffness"))
          m.complaints.add(rubs.where("Bristle stiffness"),
                           "joint <" + name +
                             ">: bristles keep what they have stored; with <At the ends = leave> friction "
                             "needs a <Sticking speed>");
    if (motion.has_lower_stop && motion.has_upper_stop)
      complain(m, "At the ends", "joint <" + name + ">: with stops on both sides nothing leaves");
  }



  CanLeave::Exits
  SlidingJoint::exits() const
  {
    constexpr double  never  = std::numeric_limits<double>::infinity();
    const FreeMotion &motion = free.front();
    return {coordinate(),
            may_leave() && !motion.has_lower_stop ? rail->start() - start : -never,
            may_leave() && !motion.has_upper_stop ? rail->end() - start : never,
            rail->length()};
  }



  bool
  SlidingJoint::has_left(const State &state) const
  {
    return !state.held && is_far(state.coordinates[coordinate()]);
  }



  void
  SlidingJoint::leave(State &state) const
  {
    double &sigma             = state.coordinates[coordinate()];
    sigma                     = parked(2 * (start + sigma) > rail->start() + rail->end());
    state.rates[coordinate()] = 0;
    std::fill_n(&state.multipliers[first_multiplier], rows.size(), 0.);
  }



  double
  SlidingJoint::displacement(const double sigma) const
  {
    if (!is_far(sigma))
      return sigma;
    return (has_left_at_end(sigma) ? rail->end() : rail->start()) - start;
  }



  std::string
  SlidingJoint::text_of_leaving() const
  {
    return "joint <" + name + ">: <" + body_b + "> has left <" + body_a + ">";
  }
} // namespace samara
