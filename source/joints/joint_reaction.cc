// Forces and moments of a joint as signals that laws may depend on.

#include <samara/joints/joint.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  /**
   * A sum of multipliers, some of them times a cosine between axes of the two frames; or the tension along the line
   * between two points, a multiplier times a lever.
   */
  class Joint::Reaction : public Signal
  {
  public:
    /** Of a tension without an axis. */
    Reaction(const Joint &joint, const bool is_moment, const std::optional<unsigned int> &axis)
      : joint(joint)
      , is_moment(is_moment)
      , along(axis)
    {
      multipliers = {0}; // not known yet, but there are some
    }

    void
    resolve(const Model &) override
    {
      summands.clear();
      along ? find(*along) : find_tension();
      multipliers.clear();
      bool has_cosines = false;
      for (const Summand &s : summands)
        {
          multipliers.push_back(joint.first_multiplier + s.row);
          has_cosines = has_cosines || s.has_cosine;
        }
      frames.clear();
      if (has_cosines)
        frames = {joint.frame_a, joint.frame_b};
      if (length != nullptr)
        coordinates = {static_cast<unsigned int>(length->coordinate)};
    }

    double
    value(const Point<double> &point) const override
    {
      return value_at(point);
    }
    std::complex<double>
    value(const Point<std::complex<double>> &point) const override
    {
      return value_at(point);
    }

    void
    add_gradient(const Point<double> &point, double *const by_place, double *) const override
    {
      if (length != nullptr)
        {
          by_place[0] += point.multipliers[multipliers[0]] / length->reference;
          by_place[1] += lever(point);
          return;
        }
      const PairValues<double> pair(joint.frame_a, joint.frame_b, point.q);
      Vector12                 of_frames = Vector12::Zero();
      for (unsigned int k = 0; k < summands.size(); ++k)
        {
          const Summand &s = summands[k];
          by_place[6 * frames.size() + k] += s.factor * (s.has_cosine ? s.cosine.value(pair) : 1.);
          if (s.has_cosine)
            s.cosine.add_gradient(pair, s.factor * point.multipliers[multipliers[k]], of_frames);
        }
      if (!frames.empty())
        Eigen::Map<Vector12>(by_place) += of_frames;
    }

  private:
    struct Summand
    {
      unsigned int row; ///< of the joint
      double       factor;
      bool         has_cosine = false;
      PairFunction cosine{};
    };

    const Joint                      &joint;
    const bool                        is_moment;
    const std::optional<unsigned int> along;
    std::vector<Summand>              summands;
    const FreeMotion                 *length = nullptr; ///< of a tension, if it may change

    void
    find_tension()
    {
      if (joint.used.empty())
        return summands.push_back({0, 2 * std::sqrt(joint.locked[0].value)});
      length = joint.used[0];
      summands.push_back({static_cast<unsigned int>(joint.locked.size()), 1.});
    }

    template <typename Number>
    Number
    lever(const Point<Number> &point) const
    {
      return length->lever(point.coordinates[length->coordinate]);
    }

    /** See action(). */
    void
    find(const unsigned int axis)
    {
      const auto &locked = joint.locked;
      for (unsigned int i = 0; i < joint.used.size(); ++i)
        if (joint.used[i]->is_angle() == is_moment && joint.used[i]->axis == axis)
          return summands.push_back({static_cast<unsigned int>(locked.size()) + i, is_moment ? 1. : -1.});
      for (unsigned int i = 0; i < joint.no_slip.size(); ++i)
        if (!is_moment && joint.no_slip[i].axis == axis)
          return summands.push_back({static_cast<unsigned int>(joint.rows.size() - joint.no_slip.size()) + i, -1.});
      const auto is_rotation = [](const Locked &l) { return l.function.kind == PairFunction::cosine; };
      const bool is_sum = std::any_of(locked.begin(), locked.end(), [](const Locked &l) { return l.less.has_value(); });
      if (!is_moment || (!is_sum && std::count_if(locked.begin(), locked.end(), is_rotation) == 1))
        {
          for (unsigned int i = 0; i < locked.size(); ++i)
            if (!is_moment && joint.is_row_on_b(locked[i])) // in the axes of B
              summands.push_back({i, locked[i].sign, true, {PairFunction::cosine, axis, locked[i].function.i}});
            else if (locked[i].axis == axis && is_rotation(locked[i]) == is_moment)
              summands.push_back({i, locked[i].sign});
          return;
        }
      // Σ λ E_axisᴬ·(E_iᴬ × E_jᴮ), and E_axis × E_i is an axis of A again
      const auto add = [&](const unsigned int row, const PairFunction &f, const double factor) {
        if (f.i != axis)
          summands.push_back(
            {row, next_axis(axis) == f.i ? factor : -factor, true, {PairFunction::cosine, 3 - f.i - axis, f.j}});
      };
      for (unsigned int k = 0; k < locked.size(); ++k)
        if (is_rotation(locked[k]))
          {
            add(k, locked[k].function, 1.);
            if (locked[k].less)
              add(k, *locked[k].less, -1.);
          }
    }

    template <typename Number>
    Number
    value_at(const Point<Number> &point) const
    {
      if (length != nullptr)
        return lever(point) * point.multipliers[multipliers[0]];
      const PairValues<Number> pair(joint.frame_a, joint.frame_b, point.q);
      Number                   sum(0);
      for (unsigned int k = 0; k < summands.size(); ++k)
        sum += summands[k].factor * point.multipliers[multipliers[k]] *
               (summands[k].has_cosine ? summands[k].cosine.value(pair) : Number(1));
      return sum;
    }
  };



  std::shared_ptr<Signal>
  Joint::tension()
  {
    const bool is_locked = locked.size() == 1 && locked[0].function.kind == PairFunction::squared_distance,
               is_free   = free.size() == 1 && free.front().is_length();
    if (is_free)
      use_coordinate(*model, free.front().name);
    return is_locked || is_free ? std::make_shared<Reaction>(*this, false, std::nullopt) : nullptr;
  }



  std::shared_ptr<Signal>
  Joint::reaction(const bool is_moment, const unsigned int axis)
  {
    const auto acts_there = [&](const auto &of_one) { return of_one.axis == axis; };
    const auto is_locked  = [&](const Locked &l) {
      return (l.function.kind == PairFunction::cosine) == is_moment && (acts_there(l) || l.less);
    };
    bool exists = std::any_of(locked.begin(), locked.end(), is_locked) ||
                  (!is_moment && std::any_of(no_slip.begin(), no_slip.end(), acts_there));
    for (auto &motion : free)
      if (motion.is_angle() == is_moment && motion.axis == axis && !motion.is_length())
        {
          use_coordinate(*model, motion.name);
          exists = true;
        }
    return exists ? std::make_shared<Reaction>(*this, is_moment, axis) : nullptr;
  }
} // namespace samara
