#include <samara/joints/joint.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    Vector12
    gradient(const PairFunction &function, const PairValues<double> &pair)
    {
      Vector12 g = Vector12::Zero();
      function.add_gradient(pair, 1., g);
      return g;
    }
  } // namespace



  double
  FreeMotion::rate(const PairValues<double> &pair,
                   const PairRates          &change,
                   const double              coordinate,
                   const double              coordinate_rate,
                   const bool                turns) const
  {
    if (is_angle() && is_on_both && turns)
      return coordinate_rate + change.spin_a(axis) - change.spin_b(axis);
    const auto of     = derivatives(pair, coordinate);
    double     result = of.slope * coordinate_rate + of.first * first.rate(pair, change);
    if (is_angle())
      result += of.second * second.rate(pair, change);
    return result;
  }



  /** The constraints of a joint. */
  class Joint::Constraints : public Evaluated<Joint::Constraints, Constraint>
  {
  public:
    explicit Constraints(const Joint &joint)
      : joint(joint)
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      evaluate<gaps | forces>(pair_at(point), point, r);
      if (joint.rows_on_b)
        add_rows_on_b<gaps | forces>(joint.seen_from_b(point), point, r);
    }
    void
    constraints(const Point<double> &point, double *r) const override
    {
      evaluate<gaps>(pair_at(point), point, r);
      if (joint.rows_on_b)
        add_rows_on_b<gaps>(joint.seen_from_b(point), point, r);
    }
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   rates(const Point<double> &point, double *rates) const override;
    void   forces_and_rates(const Point<double> &point, double *r, double *all_rates) const override;
    void   time_rates(const Point<double> &point, double *rates) const override;
    void   second_rates(const Point<double> &point, double *rates) const override;
    void   follow_angles(State &state) const override;
    double next_corner(double from, double to) const override;
    void   pieces(const Point<double> &point, std::vector<double> &result) const override;

  private:
    class Tangent;
    const Joint &joint;

    /** What is wanted of the residual: rows that hold constraints, and those of what the joint joins. */
    enum Wanted : unsigned int
    {
      gaps   = 1,
      forces = 2
    };

    template <typename Number>
    PairValues<Number>
    pair_at(const Point<Number> &point) const
    {
      return {joint.frame_a, joint.frame_b, point.q, point.q_of_forces(), joint.with_axes_of_b};
    }

    template <unsigned int wanted, typename Number>
    void evaluate(const PairValues<Number> &pair, const Point<Number> &point, Number *r) const;
    template <unsigned int wanted, typename Number>
    void add_rows_on_b(const PairValues<Number> &seen, const Point<Number> &point, Number *r) const;
    /** Rates of all rows but those of rows_on_b, and of those; the multipliers of the joint start at @p g. @{ */
    void set_rates(const PairValues<double> &pair, const Point<double> &point, double *g) const;
    void set_rates_on_b(const PairValues<double> &seen, const Point<double> &point, double *g) const;
    /** @} */
    /** Of the rows on B, @p value of their functions; those of the joint start at @p rows. */
    template <typename Value>
    void
    set_rows_on_b(double *rows, const Value &value) const
    {
      for (unsigned int row = 0; row < joint.locked.size(); ++row)
        if (joint.is_row_on_b(joint.locked[row]))
          rows[row] = value(joint.locked[row].function);
    }
    template <typename Number>
    void add_no_slip_forces(const PairValues<Number> &pair, const Number *lambda, Number *r) const;
  };



  void
  Joint::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    // in a drawing a flexible joint holds its two bodies like a weld: beside it nothing is to be closed
    const bool is_held = gaps == Gaps::open && frame_a.node == frame_b.node &&
                         (frame_a.arm - frame_b.arm).norm() < 1e-9 * (1 + frame_a.arm.norm());
    if (is_held || !check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    used.clear();
    // two rows that hold an axis of A along one of B leave a turn about both
    const auto turns_held = [](const Locked &l) { return l.function.kind == PairFunction::cosine; };
    const bool has_hinge  = std::count_if(locked.begin(), locked.end(), turns_held) == 2;
    for (auto &motion : free)
      {
        motion.is_on_both = motion.is_angle() && has_hinge;
        if (motion.coordinate >= 0)
          used.push_back(&motion);
      }
    const auto place_held = [](const Locked &l) { return l.function.kind == PairFunction::gap; };
    rows_on_b =
      frame_a.node == 0 && bearing_length == 0 && std::count_if(locked.begin(), locked.end(), place_held) == 3;
    number_rows(layout);
    add_stops(layout);
    if (!rows.empty())
      add_constraints(layout);
    add_springs(layout);
    add_friction(layout);
  }



  std::vector<Frame>
  Joint::connected_frames() const
  {
    return {frame_a, frame_b};
  }



  void
  Joint::number_rows(Layout &layout)
  {
    rows.clear();
    for (const auto &l : locked)
      rows.push_back(l.name);
    for (const auto *motion : used)
      rows.push_back("measure of the " + motion->name);
    for (const auto *motion : used)
      if (motion->is_prescribed)
        rows.push_back("prescribed " + motion->name);
    if (is_screw)
      rows.push_back("pitch");
    for (const auto &s : no_slip)
      rows.push_back(s.name);

    first_multiplier = layout.add_multipliers(*this, rows);
    first_row        = layout.of_multiplier(first_multiplier);
    std::vector<unsigned int> coordinates, multipliers(rows.size());
    for (const auto *motion : used)
      coordinates.push_back(motion->coordinate);
    for (unsigned int i = 0; i < rows.size(); ++i)
      multipliers[i] = first_multiplier + i;
    // derivatives are in the twists of the nodes themselves
    layout.couple(block, {{frame_a.node}, {frame_b.node}}, coordinates, multipliers);
  }



  void
  Joint::add_stops(Layout &layout)
  {
    stops.clear();
    contacts.clear();
    for (unsigned int i = 0; i < used.size(); ++i)
      for (const double side : {-1., 1.})
        {
          const FreeMotion &m = *used[i];
          if (!(side < 0 ? m.has_lower_stop : m.has_upper_stop))
            continue;
          const double place = side < 0 ? m.lower_stop : m.upper_stop;
          if (m.stop_law.is_linear())
            stops.push_back({i, place, side});
          contacts.add_stop(layout,
                            *this,
                            {static_cast<unsigned int>(m.coordinate),
                             place,
                             side,
                             m.stop_law,
                             !m.stop_law.is_linear(),
                             "joint " + name + (side > 0 ? ", upper" : ", lower") + " stop of the " + m.name});
        }
  }



  void
  FreeMotion::add_bristles(Model &model, const std::string &joint)
  {
    if (friction.is_given() && friction_law.has_bristles())
      bristles = model.add_state(joint + "." + name + " bristles", "m", 0., 1.);
  }



  void
  Joint::add_friction(Layout &layout)
  {
    for (const auto *m : used)
      if (m->friction.is_given())
        {
          Layout::Friction friction;
          friction.coordinates = {static_cast<unsigned int>(m->coordinate)};
          if (m->bristles >= 0)
            friction.states = {static_cast<unsigned int>(m->bristles)};
          friction.coordinates.insert(friction.coordinates.end(), m->beside.begin(), m->beside.end());
          friction.states.insert(friction.states.end(), m->bristles_beside.begin(), m->bristles_beside.end());
          friction.arm     = m->is_angle() ? m->friction.radius : 1.;
          friction.law     = m->friction_law;
          friction.preload = m->friction.preload;
          friction.name    = "joint " + name + ", friction of the " + m->name;
          add_pressing(friction.multipliers);
          contacts.add_friction(layout, *this, friction);
        }
  }



  void
  Joint::add_constraints(Layout &layout)
  {
    with_axes_of_b = !no_slip.empty() || std::any_of(used.begin(), used.end(), [](auto *m) { return m->is_angle(); }) ||
                     std::any_of(locked.begin(), locked.end(), [](const Locked &l) {
                       return l.function.kind == PairFunction::cosine;
                     });
    unsigned int row = first_multiplier + locked.size() + used.size();
    for (auto *motion : used)
      if (motion->is_prescribed)
        {
          if (motion->drive)
            motion->drive->connect(layout, {{}, {}, {}, {row}});
          model->prescribed[motion->coordinate] = row++;
        }
    for (const auto *motion : used)
      if (motion->is_length())
        model->lengths[motion->coordinate] = motion->reference;
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_angle())
        {
          const unsigned int multiplier = first_multiplier + locked.size() + i;
          layout.angles.push_back(multiplier);
          if (!used[i]->is_prescribed)
            layout.corrections.push_back({multiplier, static_cast<unsigned int>(used[i]->coordinate)});
        }
    for (unsigned int i = rows.size() - no_slip.size(); i < rows.size(); ++i)
      layout.nonholonomic.push_back(first_multiplier + i);
    constraints = std::make_unique<Constraints>(*this);
    layout.add(*this, *constraints);
  }



  double
  Joint::Constraints::next_corner(const double from, const double to) const
  {
    double corner = std::numeric_limits<double>::infinity();
    for (const auto *m : joint.used)
      corner = std::min(corner, m->prescribed.next_corner(from, to));
    return corner;
  }



  void
  Joint::Constraints::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    for (const auto *m : joint.used)
      if (m->drive)
        m->drive->pieces(point, result);
  }



  template <unsigned int wanted, typename Number>
  void
  Joint::Constraints::evaluate(const PairValues<Number> &pair, const Point<Number> &point, Number *r) const
  {
    constexpr bool      with_gaps = wanted & gaps, with_forces = wanted & Wanted::forces;
    PairForces<Number>  forces;
    const Number *const lambda = point.multipliers + joint.first_multiplier;
    Number *const       g      = r + joint.first_row;
    const auto         &used   = joint.used;
    const Block        &block  = joint.block;
    unsigned int        row    = 0;

    for (const auto &l : joint.locked)
      {
        if (!joint.is_row_on_b(l))
          {
            if constexpr (with_gaps)
              g[row] += l.measure(pair) - l.value;
            if constexpr (with_forces)
              if (lambda[row] != Number(0)) // most of a joint's rows may be left out
                l.add_forces(pair, lambda[row], forces);
          }
        ++row;
      }
    for (unsigned int i = 0; i < used.size(); ++i, ++row)
      {
        const FreeMotion &m          = *used[i];
        const Number     &coordinate = point.coordinates[m.coordinate];
        if constexpr (with_gaps)
          g[row] += m.measure(pair, coordinate);
        if constexpr (with_forces)
          r[block.row(12 + i)] += m.add_forces(pair, coordinate, lambda[row], forces);
      }
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_prescribed)
        {
          const FreeMotion &m = *used[i];
          if constexpr (with_gaps)
            g[row] += point.coordinates[m.coordinate] + m.reference - m.prescribed_at(point);
          if constexpr (with_forces)
            r[block.row(12 + i)] += lambda[row];
          ++row;
        }
    if (joint.is_screw)
      {
        if constexpr (with_gaps)
          g[row] += point.coordinates[used[0]->coordinate] - joint.pitch * point.coordinates[used[1]->coordinate];
        if constexpr (with_forces)
          {
            r[block.row(12)] += lambda[row];
            r[block.row(13)] -= joint.pitch * lambda[row];
          }
        ++row;
      }
    if constexpr (with_forces)
      {
        add_no_slip_forces(pair, lambda + row, r);
        forces.add_to_nodes(pair, r + block.row(0), r + block.row(6));
      }
  }



  template <unsigned int wanted, typename Number>
  void
  Joint::Constraints::add_rows_on_b(const PairValues<Number> &seen, const Point<Number> &point, Number *r) const
  {
    constexpr bool      with_gaps = wanted & gaps, with_forces = wanted & Wanted::forces;
    const Number *const lambda = point.multipliers + joint.first_multiplier;
    PairForces<Number>  forces;
    for (unsigned int row = 0; row < joint.locked.size(); ++row)
      if (const Locked &l = joint.locked[row]; joint.is_row_on_b(l))
        {
          if constexpr (with_gaps)
            r[joint.first_row + row] -= l.measure(seen);
          if constexpr (with_forces)
            l.add_forces(seen, Number(-lambda[row]), forces);
        }
    if constexpr (with_forces)
      forces.add_to_nodes(seen, r + joint.block.row(6), r + joint.block.row(0));
  }



  template <typename Number>
  void
  Joint::Constraints::add_no_slip_forces(const PairValues<Number> &pair, const Number *lambda, Number *r) const
  {
    if (joint.no_slip.empty())
      return;
    using Twists = Eigen::Matrix<Number, 12, 1>;
    Twists force = Twists::Zero();
    for (const auto &s : joint.no_slip)
      s.velocity.add_coefficients(pair, *lambda++, force);
    Eigen::Map<Vec6<Number>>(r + joint.block.row(0)) += force.template head<6>();
    Eigen::Map<Vec6<Number>>(r + joint.block.row(6)) += force.template tail<6>();
  }



  /** The tangent of the constraints at one point: rows and columns of multipliers, and Gᵀλ by the twists. */
  class Joint::Constraints::Tangent
  {
  public:
    Tangent(const Joint &joint, const Point<double> &point, SparseMatrix &K)
      : joint(joint)
      , point(point)
      , K(K)
      , pair(joint.frame_a, joint.frame_b, point.q, joint.with_axes_of_b)
      , seen_from_b(joint.frame_b, joint.frame_a, point.q, false)
      , twists(pair)
      , twists_from_b(seen_from_b)
      , lambda(point.multipliers + joint.first_multiplier)
      , row(12 + joint.used.size())
    {}

    void
    add()
    {
      const double *const first = lambda;
      for (const auto &l : joint.locked)
        add_locked(l);
      for (unsigned int i = 0; i < joint.used.size(); ++i)
        add_coordinate(i, *joint.used[i]);
      for (unsigned int i = 0; i < joint.used.size(); ++i)
        if (joint.used[i]->is_prescribed)
          add_prescribed(i, *joint.used[i]);
      if (joint.is_screw)
        {
          add_symmetric(12, 1.);
          add_symmetric(13, -joint.pitch);
          next_row();
        }
      for (const auto &s : joint.no_slip)
        {
          Vector12 coefficients = Vector12::Zero();
          s.velocity.add_coefficients(pair, 1., coefficients);
          s.velocity.add_derivative(pair, *lambda, H);
          joint.block.add_border(row, coefficients, K);
          next_row();
        }
      // without forces the constraints alone are wanted
      if (std::all_of(first, first + joint.rows.size(), [](const double l) { return l == 0.; }))
        return;
      twists.add_to(H);
      if (joint.rows_on_b)
        {
          Matrix12 from_b = Matrix12::Zero();
          twists_from_b.add_to(from_b);
          H += exchanged(exchanged(from_b).transpose()).transpose();
        }
      joint.block.add_twists(H, K);
    }

  private:
    const Joint             &joint;
    const Point<double>     &point;
    SparseMatrix            &K;
    const PairValues<double> pair, seen_from_b;
    PairTangent              twists, twists_from_b;
    Matrix12                 H = Matrix12::Zero();
    const double            *lambda; ///< of the row that is being added
    unsigned int             row;

    void
    next_row()
    {
      ++lambda;
      ++row;
    }

    /** The derivative of this row by the coordinate @p i of the block. */
    void
    add_symmetric(const unsigned int i, const double value)
    {
      joint.block.add_entry(i, row, value, K);
      joint.block.add_entry(row, i, value, K);
    }

    /** Rows of the twists of B and A in the order of A and B. */
    template <typename Matrix>
    static Eigen::Matrix<double, 12, Matrix::ColsAtCompileTime>
    exchanged(const Matrix &of_b_and_a)
    {
      Eigen::Matrix<double, 12, Matrix::ColsAtCompileTime> result;
      result << of_b_and_a.template bottomRows<6>(), of_b_and_a.template topRows<6>();
      return result;
    }

    void
    add_locked(const Locked &l)
    {
      if (joint.is_row_on_b(l))
        {
          twists_from_b.add(l.function, -*lambda);
          joint.block.add_border(row, Vector12(-exchanged(gradient(l.function, seen_from_b))), K);
          return next_row();
        }
      Vector12 g = gradient(l.function, pair);
      if (l.less)
        {
          g -= gradient(*l.less, pair);
          twists.add(*l.less, -*lambda);
        }
      twists.add(l.function, *lambda);
      joint.block.add_border(row, g, K);
      next_row();
    }

    /** The row that tells what the joint coordinate @p i is. */
    void
    add_coordinate(const unsigned int i, const FreeMotion &m)
    {
      const auto     of    = m.derivatives(pair, point.coordinates[m.coordinate]);
      const Vector12 first = gradient(m.first, pair);
      Vector12       g     = of.first * first;
      joint.block.add_entry(12 + i, 12 + i, *lambda * of.curvature, K);
      add_symmetric(12 + i, of.slope);
      twists.add(m.first, *lambda * of.first);
      if (m.is_angle())
        {
          const Vector12 second = gradient(m.second, pair);
          g += of.second * second;
          twists.add(m.second, *lambda * of.second);
          H += first * (*lambda * (of.first_first * first + of.first_second * second)).transpose() +
               second * (*lambda * (of.first_second * first + of.second_second * second)).transpose();
        }
      joint.block.add_border(row, g, K);
      next_row();
    }

    void
    add_prescribed(const unsigned int i, const FreeMotion &m)
    {
      if (m.drive)
        m.drive->add_tangent(point, Eigen::VectorXd::Constant(1, -point.factor), K);
      add_symmetric(12 + i, 1.);
      next_row();
    }
  };



  void
  Joint::Constraints::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    Tangent(joint, point, K).add();
  }



  void
  Joint::Constraints::rates(const Point<double> &point, double *rates) const
  {
    double *const g = rates + joint.first_multiplier;
    set_rates({joint.frame_a, joint.frame_b, point.q, joint.with_axes_of_b}, point, g);
    if (joint.rows_on_b)
      set_rates_on_b({joint.frame_b, joint.frame_a, point.q, false}, point, g);
  }



  void
  Joint::Constraints::forces_and_rates(const Point<double> &point, double *r, double *all_rates) const
  {
    if (!joint.no_slip.empty()) // the rates of their rows are not seen in reciprocal axes
      return Constraint::forces_and_rates(point, r, all_rates);
    double *const            g    = all_rates + joint.first_multiplier;
    const PairValues<double> pair = pair_at(point);
    evaluate<forces>(pair, point, r);
    set_rates(pair, point, g);
    if (!joint.rows_on_b)
      return;
    const PairValues<double> seen = joint.seen_from_b(point);
    add_rows_on_b<forces>(seen, point, r);
    set_rates_on_b(seen, point, g);
  }



  void
  Joint::Constraints::set_rates_on_b(const PairValues<double> &seen, const Point<double> &point, double *g) const
  {
    const PairRates change(seen, point.y);
    set_rows_on_b(g, [&](const PairFunction &gap) { return -gap.rate(seen, change); });
  }



  void
  Joint::Constraints::set_rates(const PairValues<double> &pair, const Point<double> &point, double *g) const
  {
    const PairRates change(pair, point.y);
    const auto     &used = joint.used;
    for (const auto &l : joint.locked)
      {
        if (!joint.is_row_on_b(l))
          *g = l.function.rate(pair, change) - (l.less ? l.less->rate(pair, change) : 0.);
        ++g;
      }
    for (const auto *m : used)
      *g++ = m->rate(
        pair, change, point.coordinates[m->coordinate], point.rates[m->coordinate], point.reciprocal != nullptr);
    for (const auto *m : used)
      if (m->is_prescribed)
        *g++ = point.rates[m->coordinate] - m->prescribed_rate(point);
    if (joint.is_screw)
      *g++ = point.rates[used[0]->coordinate] - joint.pitch * point.rates[used[1]->coordinate];
    if (joint.no_slip.empty())
      return;
    for (const auto &s : joint.no_slip)
      {
        Vector12 b = Vector12::Zero();
        s.velocity.add_coefficients(pair, 1., b);
        *g++ = b.head<6>().dot(Eigen::Map<const Vector6>(point.y + 6 * joint.frame_a.node)) +
               b.tail<6>().dot(Eigen::Map<const Vector6>(point.y + 6 * joint.frame_b.node));
      }
  }



  void
  Joint::Constraints::time_rates(const Point<double> &point, double *rates) const
  {
    unsigned int row = joint.first_multiplier + joint.locked.size() + joint.used.size();
    for (const auto *m : joint.used)
      if (m->is_prescribed)
        rates[row++] = -m->prescribed_rate(point);
  }



  void
  Joint::Constraints::second_rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double> pair(joint.frame_a, joint.frame_b, point.q, joint.with_axes_of_b);
    const PairRates          change(pair, point.y);
    const PairSecondRates    second(pair, change, point.y, joint.with_axes_of_b);
    double                  *g = rates + joint.first_multiplier;
    if (joint.rows_on_b)
      {
        const PairValues<double> seen = joint.seen_from_b(point);
        const PairRates          change_of_seen(seen, point.y);
        const PairSecondRates    second_of_seen(seen, change_of_seen, point.y, false);
        set_rows_on_b(g,
                      [&](const PairFunction &gap) { return -gap.second_rate(seen, change_of_seen, second_of_seen); });
      }
    for (const auto &l : joint.locked)
      {
        if (!joint.is_row_on_b(l))
          *g = l.function.second_rate(pair, change, second) - (l.less ? l.less->second_rate(pair, change, second) : 0.);
        ++g;
      }
    for (const auto *m : joint.used)
      {
        const auto   of   = m->derivatives(pair, point.coordinates[m->coordinate]);
        const double rate = point.rates[m->coordinate];
        *g                = of.curvature * rate * rate + of.first * m->first.second_rate(pair, change, second);
        if (m->is_angle())
          {
            const double a = m->first.rate(pair, change), b = m->second.rate(pair, change);
            *g += of.second * m->second.second_rate(pair, change, second) + of.first_first * a * a +
                  2 * of.first_second * a * b + of.second_second * b * b;
          }
        ++g;
      }
    for (const auto *m : joint.used)
      if (m->is_prescribed)
        *g++ = -m->prescribed_second_rate(point);
    if (joint.is_screw)
      ++g; // the rate is that of coordinates alone
    if (joint.no_slip.empty())
      return;
    Vector12 y;
    y << Eigen::Map<const Vector6>(point.y + 6 * joint.frame_a.node),
      Eigen::Map<const Vector6>(point.y + 6 * joint.frame_b.node);
    for (const auto &s : joint.no_slip)
      {
        Matrix12 H = Matrix12::Zero();
        s.velocity.add_derivative(pair, 1., H);
        *g++ = y.dot(H * y);
      }
  }



  void
  Joint::Constraints::follow_angles(State &state) const
  {
    const auto &used = joint.used;
    if (std::none_of(used.begin(), used.end(), [](const FreeMotion *m) { return m->is_angle(); }))
      return;
    const PairValues<double> pair(joint.frame_a, joint.frame_b, state.q.data());
    for (const auto *m : used)
      if (m->is_angle())
        {
          double &angle = state.coordinates[m->coordinate];
          angle         = in_turn_of(m->angle(pair), angle);
        }
  }
} // namespace samara
