// Relative motions that joints leave free, for steady motions.

#include <samara/joints/flexible_joint.h>
#include <samara/joints/lower_pairs.h>
#include <samara/joints/other_joints.h>

namespace samara
{
  namespace
  {
    /** The gradient of the coordinate of a free motion, whether it is in use or not. */
    Vector12
    gradient_of(const FreeMotion &motion, const PairValues<double> &pair)
    {
      Vector12     g = Vector12::Zero();
      const double f = motion.first.value(pair);
      if (motion.is_length()) // l = √first
        motion.first.add_gradient(pair, 0.5 / std::sqrt(f), g);
      else if (!motion.is_angle())
        motion.first.add_gradient(pair, 1., g);
      else // atan2(s, c)
        {
          const double s = motion.second.value(pair), r_2 = s * s + f * f;
          motion.first.add_gradient(pair, -s / r_2, g);
          motion.second.add_gradient(pair, f / r_2, g);
        }
      return g;
    }

    RelativeRate
    rate_of(const std::string &name, const Frame &a, const Frame &b, const Vector12 &g)
    {
      RelativeRate rate;
      rate.name = name;
      rate.a    = a.node;
      rate.b    = b.node;
      rate.on_a = g.head<6>();
      rate.on_b = g.tail<6>();
      return rate;
    }
  } // namespace



  void
  Joint::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    const PairValues<double> pair(frame_a, frame_b, q);
    for (const auto &motion : free)
      {
        RelativeRate rate = rate_of(name + "." + motion.name, frame_a, frame_b, gradient_of(motion, pair));
        rate.in_metres    = !motion.is_angle();
        if (!motion.is_length())
          {
            const Frame &frame = motion.is_on_b ? frame_b : frame_a;
            rate.line          = motion.is_angle() ? RelativeRate::axis : RelativeRate::direction;
            rate.node          = frame.node;
            rate.along         = frame.triad(q).col(motion.axis);
            rate.through       = frame.position(q);
          }
        rates.push_back(rate);
      }
  }



  void
  Joint::add_tilts(const double *q, std::vector<RelativeRate> &rates) const
  {
    const PairValues<double> pair(frame_a, frame_b, q);
    const double             length = pair.gap.norm();
    const Matrix3            E      = triad_about(pair.gap, Vector3::Zero());
    for (const bool of_a : {true, false})
      for (const unsigned int i : {0, 1})
        {
          // the far end seen from A, the near end seen from B
          const Frame  &seat = of_a ? frame_a : frame_b, &other = of_a ? frame_b : frame_a;
          const Vector3 n = E.col(i) / length;
          Vector6       on_seat, on_other;
          const Vector3 n_seat = seat.in_node<double>(q, n), n_other = other.in_node<double>(q, n),
                        place = seat.arm + seat.in_node<double>(q, of_a ? pair.gap : Vector3(-pair.gap));
          on_seat << -n_seat, -place.cross(n_seat);
          on_other << n_other, other.arm.cross(n_other);
          Vector12 g;
          g << (of_a ? on_seat : on_other), (of_a ? on_other : on_seat);
          rates.push_back(rate_of(name + (of_a ? ".tilt against A" : ".tilt against B"), frame_a, frame_b, g));
        }
  }



  void
  Joint::add_turns(const double *q, std::vector<RelativeRate> &rates) const
  {
    add_turns(frame_a, 3, q, rates);
  }



  void
  Joint::add_turns(const Frame &a, const unsigned int n, const double *q, std::vector<RelativeRate> &rates) const
  {
    const Matrix3 E = a.triad(q);
    for (unsigned int i = 0; i < n; ++i)
      {
        const Vector3 e = E.col(i);
        Vector12      g = Vector12::Zero();
        g.segment<3>(3) = -a.in_node<double>(q, e);
        g.segment<3>(9) = frame_b.in_node<double>(q, e);
        rates.push_back(rate_of(name + ".rotation " + std::to_string(i + 1), a, frame_b, g));
        rates.back().line    = RelativeRate::axis;
        rates.back().node    = a.node;
        rates.back().along   = e;
        rates.back().through = frame_b.position(q);
      }
  }



  void
  Spherical::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    add_turns(q, rates);
  }

  void
  Spring::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    Joint::add_relative_rates(q, rates);
    add_tilts(q, rates);
  }

  void
  Distance::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    add_tilts(q, rates);
  }



  void
  FlexibleJoint::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    // a bushing that is free in a direction is a joint there; strains of small motions will do for the rates
    for (unsigned int i = 0; i < 6; ++i)
      if (C.col(i).isZero(0.))
        {
          const bool    turns = i >= 3;
          const Vector3 e = frame_a.triad(q).col(i % 3), n_a = frame_a.in_node<double>(q, e),
                        n_b   = frame_b.in_node<double>(q, e);
          const Vector3 place = frame_a.arm + frame_a.in_node<double>(q, frame_b.position(q) - frame_a.position(q));
          Vector12      g;
          if (turns)
            g << Vector3::Zero(), -n_a, Vector3::Zero(), n_b;
          else
            g << -n_a, -place.cross(n_a), n_b, frame_b.arm.cross(n_b);
          rates.push_back(
            rate_of(name + (turns ? ".rotation " : ".displacement ") + std::to_string(i % 3 + 1), frame_a, frame_b, g));
          rates.back().in_metres = !turns;
          rates.back().line      = turns ? RelativeRate::axis : RelativeRate::direction;
          rates.back().node      = frame_a.node;
          rates.back().along     = e;
          rates.back().through   = frame_a.position(q);
        }
  }
} // namespace samara
